//! The order of edges around their vertices, in the plane of two axes.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::verify::signs::points::Points;
use std::cmp::Ordering;

/// For each half-edge the next one around the face to its left: at its head, the one just clockwise of its twin. And
/// an edge, if there is one, that is a point in the plane although there are two others at one of its ends: what lies
/// between those is not known then.
pub(crate) fn next_around_faces(
    points: &Points,
    axes: [usize; 2],
    half_edges: &[[VertexId; 2]],
) -> (Vec<usize>, Option<[VertexId; 2]>) {
    let mut out: Vec<usize> = (0..half_edges.len()).collect();
    out.sort_by(|&g, &h| {
        let ([a, p], [b, q]) = (half_edges[g], half_edges[h]);
        a.cmp(&b)
            .then_with(|| counterclockwise(points, axes, a, p, q))
    });
    let mut next = vec![0; half_edges.len()];
    let mut upright = None;
    for around in out.chunk_by(|&g, &h| half_edges[g][0] == half_edges[h][0]) {
        for (i, &h) in around.iter().enumerate() {
            // h leaves the vertex; its twin arrives.
            next[h ^ 1] = around[(i + around.len() - 1) % around.len()];
        }
        // Such edges come first.
        let [v, p] = half_edges[around[0]];
        if around.len() > 2 && direction(points, axes, v, p) == Direction::None {
            upright.get_or_insert([v, p]);
        }
    }
    (next, upright)
}

/// A direction in the plane, roughly, counterclockwise from the first axis.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Direction {
    /// The two points are one in the plane.
    None,
    Upper,
    Lower,
}

/// The direction from v to w.
fn direction(points: &Points, axes: [usize; 2], v: VertexId, w: VertexId) -> Direction {
    let [x, y] = axes.map(|i| points.order(i, w, v));
    match y.then(x) {
        Ordering::Less => Direction::Lower,
        Ordering::Equal => Direction::None,
        Ordering::Greater => Direction::Upper,
    }
}

/// The order of the directions from v to p and q, counterclockwise from the first axis; points at v come first.
fn counterclockwise(
    points: &Points,
    axes: [usize; 2],
    v: VertexId,
    p: VertexId,
    q: VertexId,
) -> Ordering {
    let [to_p, to_q] = [p, q].map(|w| direction(points, axes, v, w));
    to_p.cmp(&to_q)
        .then_with(|| match points.orient2d(axes, [v, p, q]) {
            Sign::Positive => Ordering::Less,
            Sign::Negative => Ordering::Greater,
            Sign::Zero => p.cmp(&q),
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::lookup::area::Area;

    /// The vertex in the middle of a fan is above another one: any order of vertices makes an order of directions.
    #[test]
    fn upright_edges_are_noticed() {
        for n in [2, 3, 40] {
            let at = |i: usize| [[1., 0., 0.], [0., 1., 0.], [-1., 0., 0.], [0., -1., 0.]][i % 4];
            let scaled = |i: usize| at(i).map(|x| x * (1 + i / 4) as f64);
            for place in 0..=n {
                let mut p: Vec<[f64; 3]> = (0..n).map(scaled).collect();
                p.insert(place, [0., 0., 1.]);
                p.push([0., 0., 0.]);
                let centre = VertexId::new(n + 1);
                let edges: Vec<_> = (0..=n).map(|i| [VertexId::new(i), centre]).collect();
                let points = Points::new(p);
                let area = Area::new(&points, [0, 1], &edges, &[]);
                assert_eq!(area.upright, Some([centre, VertexId::new(place)]));
                let path = [edges[place], edges[usize::from(place == 0)]];
                assert_eq!(Area::new(&points, [0, 1], &path, &[]).upright, None);
                let others: Vec<_> = edges
                    .iter()
                    .copied()
                    .filter(|e| *e != edges[place])
                    .collect();
                assert_eq!(Area::new(&points, [0, 1], &others, &[]).upright, None);
            }
        }
    }
}
