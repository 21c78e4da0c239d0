//! Vertices with numbers, as TetGen's files list them.

use super::ahead::Rows;
use crate::exchange::{Attributes, Plc};
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

/// The vertices read so far.
#[derive(Default)]
pub(super) struct Vertices {
    /// The number of the first one.
    first: Option<i64>,
    /// Whether these are from the middle of a list.
    is_piece: bool,
    /// Once numbers do not follow one another: all of them, and the last one.
    numbered: Option<(FxHashMap<i64, VertexId>, i64)>,
    /// The coordinates.
    pub points: Vec<[f64; 3]>,
    /// Attributes, as many for each.
    pub attributes: Vec<f64>,
    /// Markers, if there are any.
    pub markers: Vec<i64>,
}

impl Vertices {
    /// The number that the next one should have, once there is one.
    pub fn expected(&self) -> Option<i64> {
        match self.numbered {
            Some((_, last)) => last.checked_add(1),
            None => self.first?.checked_add(self.points.len() as i64),
        }
    }

    /// Whether the next one may have the number: that after the last one.
    pub fn may_have(&self, number: i64) -> bool {
        self.first.is_none() || self.expected() == Some(number)
    }

    /// Whether there are vertices before these, whose numbers are not known.
    pub fn is_piece(&self) -> bool {
        self.is_piece
    }

    /// Numbers need not follow one another from now on.
    pub fn allow_any_numbers(&mut self) {
        if self.numbered.is_none() {
            let first = self.first.unwrap_or_default();
            let last = first + (self.points.len() as i64 - 1);
            let ids = (0..self.points.len()).map(VertexId::new);
            self.numbered = Some(((first..=last).zip(ids).collect(), last));
        }
    }

    /// Adds one; false if there is one of that number.
    pub fn push(&mut self, number: i64, point: [f64; 3]) -> bool {
        self.first.get_or_insert(number);
        self.points.push(point);
        let Some((ids, last)) = &mut self.numbered else {
            return true;
        };
        *last = number;
        let id = VertexId::new(self.points.len() - 1);
        ids.insert(number, id).is_none()
    }

    /// The number of the first, if it is a small one and the others follow.
    fn successive_from(&self) -> Option<u32> {
        let first = self.first.unwrap_or(0);
        let end = first.checked_add(self.points.len() as i64)?;
        let first = u32::try_from(first).ok()?;
        (self.numbered.is_none() && end <= i64::from(u32::MAX)).then_some(first)
    }

    /// The number of the first, 0 if there is none; nothing if the numbers do not follow one another.
    pub fn first_index(&self) -> Option<u32> {
        self.successive_from()
    }

    /// The PLC of the vertices alone, each of which has so many attributes, and the vertices of the numbers.
    pub fn into_plc(mut self, attributes: usize) -> (Plc, Numbering) {
        let first = self.successive_from();
        let mut numbers = Vec::new();
        if first.is_none() {
            self.allow_any_numbers();
        }
        let ids = self.numbered.map(|(ids, _)| ids).unwrap_or_default();
        if first.is_none() {
            numbers = vec![0; self.points.len()];
            ids.iter()
                .for_each(|(&number, id)| numbers[id.index()] = number);
        }
        let least = numbers.iter().copied().min();
        let first_index = first.unwrap_or(u32::from(least.is_some_and(|least| least > 0)));
        let marked = self.markers.iter().any(|&marker| marker != 0);
        let numbering = Numbering {
            first: i64::from(first_index),
            count: self.points.len(),
            ids,
        };
        let plc = Plc {
            first_index,
            numbers,
            vertices: self.points,
            attributes: Attributes {
                per_vertex: attributes,
                values: self.attributes,
            },
            vertex_markers: if marked { self.markers } else { Vec::new() },
            ..Plc::default()
        };
        (plc, numbering)
    }
}

impl Rows for Vertices {
    fn piece(&self) -> Vertices {
        Vertices {
            is_piece: true,
            ..Vertices::default()
        }
    }

    fn len(&self) -> u64 {
        self.points.len() as u64
    }

    fn append(&mut self, next: Vertices) -> bool {
        let Some(number) = next.first else {
            return true;
        };
        let fits = self.may_have(number) && self.numbered.is_none();
        if fits {
            self.first.get_or_insert(number);
            self.points.extend(next.points);
            self.attributes.extend(next.attributes);
            self.markers.extend(next.markers);
        }
        fits
    }
}

/// Which number is which vertex.
pub(super) struct Numbering {
    /// The number of the first.
    first: i64,
    count: usize,
    /// The vertices by their numbers, if those do not follow one another.
    ids: FxHashMap<i64, VertexId>,
}

impl Numbering {
    /// The vertex of a number.
    pub fn vertex(&self, number: i64) -> Option<VertexId> {
        if !self.ids.is_empty() {
            return self.ids.get(&number).copied();
        }
        let place = number.checked_sub(self.first)?;
        let place = usize::try_from(place).ok()?;
        (place < self.count).then(|| VertexId::new(place))
    }

    /// The least and the greatest number.
    pub fn range(&self) -> (i64, i64) {
        let numbers = self.ids.keys().copied();
        let least = numbers.clone().min().unwrap_or(self.first);
        let last = self.first + self.count as i64 - 1;
        (least, numbers.max().unwrap_or(last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(numbers: &[i64]) -> Option<(Plc, Numbering)> {
        let mut vertices = Vertices::default();
        for &number in numbers {
            if !vertices.may_have(number) {
                vertices.allow_any_numbers();
            }
            if !vertices.push(number, [0.0; 3]) {
                return None;
            }
        }
        Some(vertices.into_plc(0))
    }

    #[test]
    fn numbers_from_anywhere_and_with_gaps() {
        for (numbers, first, are_kept) in [
            (&[5, 6, 7][..], 5, false),
            (&[0, 1], 0, false),
            (&[1, 2, 4], 1, true),
            (&[3, 0, 9], 0, true),
            (&[-2, -1, 0], 0, true),
            (&[i64::from(u32::MAX), i64::from(u32::MAX) + 1], 1, true),
        ] {
            let (plc, numbering) = read(numbers).expect("different numbers");
            assert_eq!(plc.first_index, first);
            assert_eq!(plc.numbers, if are_kept { numbers } else { &[] });
            for (i, &number) in numbers.iter().enumerate() {
                assert_eq!(numbering.vertex(number), Some(VertexId::new(i)));
            }
            assert_eq!(numbering.vertex(8), None);
            let range = (numbers.iter().min(), numbers.iter().max());
            let (least, most) = numbering.range();
            assert_eq!(range, (Some(&least), Some(&most)));
        }
        assert!(read(&[1, 2, 1]).is_none());
        assert!(read(&[2, 1, 3, 2]).is_none());
    }
}
