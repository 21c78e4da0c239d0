//! Whether faces cover a group of facets: one face at every edge of the boundary, two at every other one, and the
//! areas.

use crate::mesh::VertexId;
use crate::number::{Dyadic, Number, Sign};
use crate::verify::claims::facets::group::Group;
use crate::verify::lookup::area::Area;
use crate::verify::lookup::tables::sorted2;
use crate::verify::signs::sums::Areas;

/// How a set of faces fails to cover a group.
pub(crate) enum Misfit {
    Edge([VertexId; 2], usize, usize),
    Area(f64, f64),
}

impl Group<'_> {
    /// How many faces each edge of the boundary has, by edges; an edge between two facets of the group is in the
    /// boundary of both.
    pub(crate) fn expected(&self) -> Vec<([VertexId; 2], usize)> {
        let boundary = self.areas.iter().flat_map(Area::boundary);
        let mut edges: Vec<[VertexId; 2]> = boundary.map(sorted2).collect();
        edges.sort_unstable();
        let counted = edges.chunk_by(|x, y| x == y);
        counted.map(|same| (same[0], same.len())).collect()
    }

    /// Why the faces do not cover the group, if they do not.
    pub(crate) fn misfit(
        &self,
        faces: &[usize],
        expected: &[([VertexId; 2], usize)],
    ) -> Option<Misfit> {
        let keys = || faces.iter().map(|&f| self.case.tables.faces[f].key);
        // (edge, faces that it should have, faces that it has)
        let mut edges: Vec<([VertexId; 2], usize, usize)> =
            expected.iter().map(|&(edge, n)| (edge, n, 0)).collect();
        edges.extend(keys().flat_map(|[a, b, c]| [[a, b], [b, c], [a, c]].map(|e| (e, 0, 1))));
        edges.sort_unstable_by_key(|e| e.0);
        for same in edges.chunk_by(|x, y| x.0 == y.0) {
            let edge = same[0].0;
            let sum = |(n, m), e: &([VertexId; 2], usize, usize)| (n + e.1, m + e.2);
            match same.iter().fold((0, 0), sum) {
                (1, 1) | (2, 0) => {}
                (1, faces) => return Some(Misfit::Edge(edge, faces, 1)),
                (_, 2) => {}
                (_, faces) => return Some(Misfit::Edge(edge, faces, 2)),
            }
        }
        let points = self.case.points;
        let cover = |sum: &mut Areas| {
            for [a, b, c] in keys() {
                match points.orient2d(self.axes, [a, b, c]) {
                    Sign::Positive => sum.add(points, [a, b, c]),
                    Sign::Negative => sum.add(points, [a, c, b]),
                    Sign::Zero => {}
                }
            }
        };
        let mut sum = Areas::new(self.axes);
        cover(&mut sum);
        self.areas.iter().for_each(|a| a.subtract_from(&mut sum));
        if sum.sign().is_zero() {
            return None;
        }
        sum.take_twice();
        cover(&mut sum);
        let covered = sum.take_twice().to_f64();
        let areas = self.areas.iter().map(Area::twice_area);
        let area = areas.fold(Dyadic::ZERO, |sum, a| sum + &a).to_f64();
        Some(Misfit::Area(covered / 2.0, area / 2.0))
    }

    /// Whether some vertex of the faces is not exactly on the plane, although the input vertices are.
    pub(crate) fn is_rounded(&self, faces: &[usize]) -> bool {
        let [f] = self.facets[..] else { return false };
        let facet = &self.case.input.facets[f];
        let Some([a, b, c]) = facet.frame.filter(|_| facet.flat) else {
            return false;
        };
        let vertices = faces.iter().flat_map(|&f| self.case.tables.faces[f].key);
        let mut vertices: Vec<VertexId> = vertices.collect();
        vertices.sort_unstable();
        vertices.dedup();
        let points = self.case.points;
        vertices
            .into_iter()
            .any(|v| !points.is_on_plane([a, b, c], v))
    }
}
