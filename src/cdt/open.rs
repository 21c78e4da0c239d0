//! Where a complex is open, and whether that alone shows that it encloses nothing.
//!
//! A polygon with an open edge has one and the same component of space on both sides (see [`super::inside`]). So
//! without it the others divide space into the same components, and more edges may be open. Where nothing is left in
//! the end, all of space is one component, the outside, and all edges that were open at first are open to it. This is
//! known before there are any tetrahedra, in linear time.

use crate::error::DomainError;
use crate::mesh::VertexId;
use crate::plc::Complex;
use crate::recover::segments::SegmentIndex;

/// How many sides of polygons are at each segment, counting those that are `there`.
pub(super) fn sides(
    complex: &Complex,
    index: &SegmentIndex,
    there: impl Fn(usize) -> bool,
) -> Vec<u32> {
    let mut sides = vec![0; complex.segments.len()];
    for f in (0..complex.polygons.len()).filter(|&f| there(f)) {
        segments_of(complex, index, f).for_each(|s| sides[s] += 1);
    }
    sides
}

/// The segments of the edges of polygon f, one of both directions twice.
fn segments_of<'a>(
    complex: &'a Complex,
    index: &'a SegmentIndex,
    f: usize,
) -> impl Iterator<Item = usize> + 'a {
    let edges = complex.polygons[f].edges.iter();
    edges.map(|&[a, b]| {
        let s = index.find(a, b).expect("edges of polygons are segments");
        s as usize
    })
}

/// The ends of a segment, the lesser first.
pub(super) fn ends_of(complex: &Complex, s: usize) -> [VertexId; 2] {
    let [a, b] = complex.segments[s].ends;
    [a.min(b), a.max(b)]
}

/// The error of a complex whose polygons enclose nothing, wherever their vertices are; `None` if they may enclose
/// something.
pub(super) fn encloses_nothing(complex: &Complex) -> Option<DomainError> {
    let index = SegmentIndex::new(complex);
    let mut sides = sides(complex, &index, |_| true);
    let open: Vec<usize> = (0..sides.len()).filter(|&s| sides[s] == 1).collect();
    if open.is_empty() && !complex.polygons.is_empty() {
        return None;
    }
    // The sum of the polygons at a segment, modulo 2 in each bit: where there is one side, it is that polygon.
    let mut at = vec![0; sides.len()];
    for f in 0..complex.polygons.len() {
        segments_of(complex, &index, f).for_each(|s| at[s] ^= f);
    }
    let mut left = complex.polygons.len();
    let mut stack = open.clone();
    while let Some(s) = stack.pop() {
        if sides[s] != 1 {
            continue;
        }
        let f = at[s];
        left -= 1;
        for s in segments_of(complex, &index, f) {
            sides[s] -= 1;
            at[s] ^= f;
            if sides[s] == 1 {
                stack.push(s);
            }
        }
    }
    if left > 0 {
        return None;
    }
    let mut edges: Vec<[VertexId; 2]> = open.into_iter().map(|s| ends_of(complex, s)).collect();
    edges.sort_unstable();
    Some(match edges.is_empty() {
        true => DomainError::NothingEnclosed,
        false => DomainError::Open { edges },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::{Facet, Plc};

    fn complex(triangles: &[[u32; 3]]) -> Complex {
        let facet = |corners: &[u32; 3]| Facet {
            polygons: vec![corners.map(VertexId).to_vec()],
            ..Facet::default()
        };
        let plc = Plc {
            vertices: vec![
                [0., 0., 0.],
                [1., 0., 0.],
                [0., 1., 0.],
                [0., 0., 1.],
                [2., 2., 2.],
            ],
            facets: triangles.iter().map(facet).collect(),
            ..Plc::default()
        };
        Complex::new(&plc, true).expect("a valid PLC")
    }

    #[test]
    fn what_is_open_all_over_is_taken_apart() {
        let closed = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
        assert_eq!(encloses_nothing(&complex(&closed)), None);
        // A fin keeps nothing from being enclosed.
        let fin = [&closed[..], &[[1, 2, 4]]].concat();
        assert_eq!(encloses_nothing(&complex(&fin)), None);
        let edges = [[0, 1], [0, 2], [1, 2]].map(|e| e.map(VertexId)).into();
        assert_eq!(
            encloses_nothing(&complex(&closed[1..])),
            Some(DomainError::Open { edges })
        );
        assert_eq!(
            encloses_nothing(&complex(&[])),
            Some(DomainError::NothingEnclosed)
        );
    }
}
