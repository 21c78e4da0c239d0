//! A PLC in the making, whose facets know where they come from.

use super::Refused;
use crate::exchange::{Facet, Plc};
use crate::mesh::VertexId;
use crate::plc::{FacetInput, representatives, undirected};

/// A PLC in the making.
pub(super) struct Draft {
    /// The PLC, with its origins.
    pub plc: Plc,
    /// The first vertex with the coordinates of each.
    pub representative: Vec<VertexId>,
    /// How far vertices may be from the planes of their facets.
    pub delta: f64,
}

/// A facet that takes the place of others.
pub(super) struct Replacement {
    /// The facet.
    pub facet: Facet,
    /// The directed edges that its area must have on their left, seen from one side or the other.
    pub edges: Vec<[VertexId; 2]>,
    /// The facets that it comes from, by their indices before; it takes the place of the lowest.
    pub from: Vec<usize>,
}

impl Draft {
    /// A copy of the input.
    pub fn of(plc: &Plc, delta: f64) -> Draft {
        let mut plc = plc.clone();
        if plc.origins.is_empty() {
            plc.origins = (0..plc.facets.len()).map(|i| vec![i]).collect();
        }
        Draft {
            representative: representatives(&plc.vertices),
            plc,
            delta,
        }
    }

    /// A facet with representatives for corners, which is known to be valid for itself up to here.
    pub fn facet(&self, index: usize) -> Result<FacetInput<'_>, Refused> {
        Ok(FacetInput::new(
            &self.plc,
            index,
            &self.representative,
            self.delta,
        )?)
    }

    /// Drops the facets that are `gone`, and puts others in their places.
    ///
    /// # Errors
    /// If a new facet has not the area that it must have: the hole points that doubles allow are not good enough.
    pub fn replace(
        &mut self,
        gone: &[bool],
        replacements: Vec<Replacement>,
    ) -> Result<(), Refused> {
        let place = |new: Replacement| (new.from.iter().copied().min(), new);
        let mut replacements: Vec<_> = replacements.into_iter().map(place).collect();
        replacements.sort_by_key(|&(place, _)| place);
        let old = std::mem::take(&mut self.plc.facets);
        let origins = std::mem::take(&mut self.plc.origins);
        let mut new = replacements.into_iter().peekable();
        let mut areas = Vec::new();
        for (i, facet) in old.into_iter().enumerate() {
            while let Some((_, replacement)) = new.next_if(|&(place, _)| place == Some(i)) {
                let from = replacement.from.iter().flat_map(|&f| &origins[f]);
                let mut from: Vec<usize> = from.copied().collect();
                from.sort_unstable();
                from.dedup();
                areas.push((self.plc.facets.len(), replacement.edges));
                self.plc.facets.push(replacement.facet);
                self.plc.origins.push(from);
            }
            if !gone[i] {
                self.plc.facets.push(facet);
                self.plc.origins.push(origins[i].clone());
            }
        }
        for (index, mut edges) in areas {
            edges.sort_unstable();
            let found = self.facet(index)?.polygon()?.edges;
            let mut reversed: Vec<_> = found.iter().map(|&[a, b]| [b, a]).collect();
            reversed.sort_unstable();
            if edges != found && edges != reversed {
                return Err(Refused::NeedsVertex);
            }
        }
        Ok(())
    }

    /// All edges of facets and segments once, with increasing ends, sorted.
    pub fn edges(&self) -> Vec<[VertexId; 2]> {
        let of = |v: VertexId| self.representative[v.index()];
        let polygons = self.plc.facets.iter().flat_map(|f| &f.polygons);
        let sides = polygons.flat_map(|p| {
            let edges = match p.len() {
                0 | 1 => 0,
                2 => 1,
                n => n,
            };
            (0..edges).map(move |i| [p[i], p[(i + 1) % p.len()]])
        });
        let segments = self.plc.segments.iter().map(|s| s.ends);
        let all = sides.chain(segments);
        let mut all: Vec<_> = all.map(|ends| undirected(ends.map(of))).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}
