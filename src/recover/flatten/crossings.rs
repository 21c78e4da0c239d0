//! Edges that cross in the projection of a polygon: which of them divide it.
//!
//! A sweep along the longer side of the figure's bounding box, in which only edges whose boxes meet are compared; every
//! comparison is exact. O(k log k) for k edges that are short compared with the figure, O(k²) at worst.

use super::figure::Figure;
use crate::mesh::VertexId;
use crate::predicate::PointStore;
use rustc_hash::FxHashMap;

/// Which of two crossing edges is chosen.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Preference {
    /// The lower one, so that f runs below all shims.
    Lower,
    /// The upper one.
    Upper,
    /// The shorter one: where f is on the convex hull, an edge on the wrong side may be any, and cross many good ones.
    Shorter,
}

/// Edges between vertices of f that pass through no vertex of it, and cross no edge of its boundary.
pub(super) struct Crossings {
    edges: Vec<[VertexId; 2]>,
    /// Pairs of edges that cross, by index, the lower one first. Sorted.
    pub(super) pairs: Vec<[usize; 2]>,
}

/// What the sweep passes.
struct Item {
    low: [f64; 2],
    high: [f64; 2],
    ends: [VertexId; 2],
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// A vertex of f, twice an end.
    Vertex,
    /// An edge of its boundary.
    Boundary,
    /// An edge that may divide it, by index.
    Candidate(usize),
}

impl Item {
    fn new<P: PointStore>(figure: &Figure<P>, ends: [VertexId; 2], kind: Kind) -> Item {
        let (a, b) = (figure.plane.rounded(ends[0]), figure.plane.rounded(ends[1]));
        let range = |k: usize| {
            let slack = 4.0 * f64::EPSILON * a[k].abs().max(b[k].abs());
            (a[k].min(b[k]) - slack, a[k].max(b[k]) + slack)
        };
        let (x, y) = (range(0), range(1));
        Item {
            low: [x.0, y.0],
            high: [x.1, y.1],
            ends,
            kind,
        }
    }
}

impl Crossings {
    /// Of the candidates those that divide f, and how they cross each other.
    pub(super) fn new<P: PointStore>(
        figure: &Figure<P>,
        candidates: Vec<[VertexId; 2]>,
    ) -> Crossings {
        if candidates.is_empty() {
            return Crossings {
                edges: candidates,
                pairs: Vec::new(),
            };
        }
        let plane = &figure.plane;
        let (items, axis) = sorted_items(figure, &candidates);
        let mut blocked = vec![false; candidates.len()];
        let mut pairs: Vec<[usize; 2]> = Vec::new();
        for (n, item) in items.iter().enumerate() {
            let beside = items[n + 1..].iter();
            for other in beside.take_while(|other| other.low[axis] <= item.high[axis]) {
                let across = 1 - axis;
                if other.high[across] < item.low[across] || item.high[across] < other.low[across] {
                    continue;
                }
                let (e, g) = (item.ends, other.ends);
                match (item.kind, other.kind) {
                    (Kind::Candidate(i), Kind::Candidate(j)) => {
                        let matters = !blocked[i] && !blocked[j];
                        if matters && plane.cross(e, g) {
                            let is_above = plane.passes_above(e, g);
                            pairs.push(if is_above { [j, i] } else { [i, j] });
                        }
                    }
                    (Kind::Candidate(i), Kind::Vertex) => {
                        blocked[i] = blocked[i] || plane.is_between(e[0], e[1], g[0]);
                    }
                    (Kind::Vertex, Kind::Candidate(i)) => {
                        blocked[i] = blocked[i] || plane.is_between(g[0], g[1], e[0]);
                    }
                    (Kind::Candidate(i), _) | (_, Kind::Candidate(i)) => {
                        blocked[i] = blocked[i] || plane.cross(e, g);
                    }
                    _ => {}
                }
            }
        }
        let mut new_index = vec![usize::MAX; candidates.len()];
        let mut edges = Vec::with_capacity(candidates.len());
        for (i, e) in candidates.into_iter().enumerate() {
            if !blocked[i] {
                new_index[i] = edges.len();
                edges.push(e);
            }
        }
        pairs.retain(|pair| pair.iter().all(|&i| !blocked[i]));
        for pair in &mut pairs {
            *pair = pair.map(|i| new_index[i]);
        }
        pairs.sort_unstable();
        Crossings { edges, pairs }
    }

    /// As many edges as possible of which no two cross.
    pub(super) fn without<P: PointStore>(
        &self,
        points: &P,
        preference: Preference,
    ) -> Vec<[VertexId; 2]> {
        if self.pairs.is_empty() {
            return self.edges.clone();
        }
        let n = self.edges.len();
        let mut opponents: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
        for &[i, j] in &self.pairs {
            opponents.entry(i).or_default().push(j);
            opponents.entry(j).or_default().push(i);
        }
        let mut accepted = vec![preference != Preference::Shorter; n];
        for &[lower, upper] in &self.pairs {
            match preference {
                Preference::Lower => accepted[upper] = false,
                Preference::Upper => accepted[lower] = false,
                Preference::Shorter => {}
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        if preference == Preference::Shorter {
            let length = |i: usize| {
                let [a, b] = self.edges[i].map(|v| points.rounded(v));
                (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>()
            };
            order.sort_by(|&i, &j| length(i).total_cmp(&length(j)).then(i.cmp(&j)));
        }
        // Those that give way to none of the accepted ones after all.
        for i in order {
            if !accepted[i] {
                let mut against = opponents.get(&i).into_iter().flatten();
                accepted[i] = against.all(|&j| !accepted[j]);
            }
        }
        let chosen = self.edges.iter().zip(accepted);
        chosen
            .filter(|(_, accepted)| *accepted)
            .map(|(&e, _)| e)
            .collect()
    }
}

/// Vertices, boundary and candidates in the order in which a sweep meets them, and the coordinate in which it goes.
fn sorted_items<P: PointStore>(
    figure: &Figure<P>,
    candidates: &[[VertexId; 2]],
) -> (Vec<Item>, usize) {
    let vertices = figure.vertices.iter().map(|&v| ([v, v], Kind::Vertex));
    let boundary = figure.boundary.iter().map(|&e| (e, Kind::Boundary));
    let candidates = candidates.iter().enumerate();
    let candidates = candidates.map(|(i, &e)| (e, Kind::Candidate(i)));
    let all = vertices.chain(boundary).chain(candidates);
    let mut items: Vec<Item> = all
        .map(|(ends, kind)| Item::new(figure, ends, kind))
        .collect();
    let vertices = &items[..figure.vertices.len()];
    let extent = |k: usize| {
        let low = vertices.iter().map(|item| item.low[k]);
        let high = vertices.iter().map(|item| item.high[k]);
        high.fold(f64::NEG_INFINITY, f64::max) - low.fold(f64::INFINITY, f64::min)
    };
    let axis = usize::from(extent(1) > extent(0));
    items.sort_unstable_by(|x, y| x.low[axis].total_cmp(&y.low[axis]));
    (items, axis)
}
