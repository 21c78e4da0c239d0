//! Points by their coordinates: a hash table of indices, with linear probing.

use crate::mesh::VertexId;

/// Which points are where.
pub(crate) struct Places {
    /// One more than an index, or 0.
    slots: Vec<u32>,
}

impl Places {
    /// Room for so many points.
    pub(crate) fn new(points: usize) -> Places {
        Places {
            slots: vec![0; (2 * points + 1).next_power_of_two()],
        }
    }

    /// The point that is already at a place of `coordinates`, or else the given one, which is there now. (−0 is 0.)
    pub(crate) fn first_at(
        &mut self,
        coordinates: &[[f64; 3]],
        place: [f64; 3],
        new: VertexId,
    ) -> VertexId {
        let slot = self.slot(coordinates, place);
        match self.slots[slot] {
            0 => {
                self.slots[slot] = new.0 + 1;
                new
            }
            found => VertexId(found - 1),
        }
    }

    /// The point at a place.
    pub(crate) fn at(&self, coordinates: &[[f64; 3]], place: [f64; 3]) -> Option<VertexId> {
        let found = self.slots[self.slot(coordinates, place)];
        (found > 0).then(|| VertexId(found - 1))
    }

    /// The slot of the point there, or where it belongs.
    fn slot(&self, coordinates: &[[f64; 3]], place: [f64; 3]) -> usize {
        let mask = self.slots.len() - 1;
        let mix = |h: u64, x: f64| {
            // Adding zero turns −0 into 0. Multiplication carries upwards only, and round doubles have high bits only.
            let h = (h ^ (x + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            h ^ h >> 32
        };
        let mut slot = place.into_iter().fold(0, mix) as usize & mask;
        while self.slots[slot] > 0 && coordinates[self.slots[slot] as usize - 1] != place {
            slot = (slot + 1) & mask;
        }
        slot
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_several_is_found() {
        let side = 0..12;
        let all = side.flat_map(|x| (0..144).map(move |i| [x, i / 12, i % 12].map(f64::from)));
        let mut coordinates: Vec<[f64; 3]> = all.collect();
        coordinates.push([-0.0, 0.0, 11.0]);
        let mut places = Places::new(coordinates.len());
        for (i, &p) in coordinates.iter().enumerate() {
            let first = places.first_at(&coordinates, p, VertexId::new(i));
            let expected = if i + 1 == coordinates.len() { 11 } else { i };
            assert_eq!(first.index(), expected);
        }
        assert_eq!(
            places.at(&coordinates, [0.0, -0.0, 11.0]),
            Some(VertexId(11))
        );
        assert_eq!(places.at(&coordinates, [0.5, 0.0, 0.0]), None);
    }
}
