//! Where a complex is open: edges that have one polygon on one side and nothing else.

use super::Complex;
use crate::mesh::VertexId;

impl Complex {
    /// The open edges, those that exactly one polygon has, on one side only, divided into connected boundaries.
    ///
    /// An edge that floats in a polygon has that polygon on both sides, so that a wall whose foot is an edge of the
    /// floor is not open there. Each boundary is sorted, and the boundaries are in the order of their first edges. An
    /// open surface has at least one; a closed one may have a fin or a floating sheet, and then has some, too.
    ///
    /// O(n log n) for n edges of polygons.
    pub fn open_boundaries(&self) -> Vec<Vec<[VertexId; 2]>> {
        let sides = self.polygons.iter().flat_map(|polygon| &polygon.edges);
        let mut sides: Vec<[VertexId; 2]> = sides.map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        sides.sort_unstable();
        let groups = sides.chunk_by(|e, f| e == f);
        connected(
            groups
                .filter(|group| group.len() == 1)
                .map(|group| group[0])
                .collect(),
        )
    }
}

/// Sorted edges, divided into those that are connected by common ends.
pub(crate) fn connected(edges: Vec<[VertexId; 2]>) -> Vec<Vec<[VertexId; 2]>> {
    let mut at: Vec<(VertexId, usize)> = edges
        .iter()
        .enumerate()
        .flat_map(|(i, &[a, b])| [(a, i), (b, i)])
        .collect();
    at.sort_unstable();
    let around = |v: VertexId| {
        let first = at.partition_point(|&(w, _)| w < v);
        at[first..].iter().take_while(move |&&(w, _)| w == v)
    };
    let mut seen = vec![false; edges.len()];
    let mut boundaries = Vec::new();
    for start in 0..edges.len() {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let (mut boundary, mut stack) = (Vec::new(), vec![start]);
        while let Some(i) = stack.pop() {
            boundary.push(edges[i]);
            for &(_, j) in edges[i].into_iter().flat_map(around) {
                if !seen[j] {
                    seen[j] = true;
                    stack.push(j);
                }
            }
        }
        boundary.sort_unstable();
        boundaries.push(boundary);
    }
    boundaries
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::{Facet, Plc};

    fn complex(vertices: &[[f64; 3]], facets: &[&[&[u32]]]) -> Complex {
        let polygon = |p: &&[u32]| p.iter().map(|&v| VertexId(v)).collect();
        let facet = |polygons: &&[&[u32]]| Facet {
            polygons: polygons.iter().map(polygon).collect(),
            ..Facet::default()
        };
        let plc = Plc {
            vertices: vertices.to_vec(),
            facets: facets.iter().map(facet).collect(),
            ..Plc::default()
        };
        Complex::new(&plc, true).unwrap()
    }

    /// A floor, two floating vertices 4 and 5 in it, and two more above these.
    const POINTS: [[f64; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 3.0, 0.0],
        [0.0, 3.0, 0.0],
        [1.0, 1.0, 0.0],
        [2.0, 1.0, 0.0],
        [2.0, 1.0, 1.0],
        [1.0, 1.0, 1.0],
    ];

    #[test]
    fn the_foot_of_a_wall_is_not_open() {
        let floor: &[&[u32]] = &[&[0, 1, 2, 3], &[4, 5]];
        let found = complex(&POINTS, &[floor, &[&[4, 5, 6, 7]]]).open_boundaries();
        let edges = |list: &[[u32; 2]]| list.iter().map(|e| e.map(VertexId)).collect::<Vec<_>>();
        let square = edges(&[[0, 1], [0, 3], [1, 2], [2, 3]]);
        let wall = edges(&[[4, 7], [5, 6], [6, 7]]);
        assert_eq!(found, [square, wall]);
    }

    #[test]
    fn a_closed_surface_has_no_boundary() {
        let facets: [&[&[u32]]; 4] = [&[&[0, 1, 2]], &[&[0, 1, 7]], &[&[1, 2, 7]], &[&[2, 0, 7]]];
        assert!(complex(&POINTS, &facets).open_boundaries().is_empty());
        assert_eq!(complex(&POINTS, &facets[1..]).open_boundaries()[0].len(), 3);
    }
}
