//! Vertices that are one up to the precision of the input: a surface that is closed only to rounding, and facets that
//! are smaller than the precision.
//!
//! Only vertices of open edges, or of facets whose vertices are all within 2δ of each other, are welded. Those that are
//! linked by distances of at most 2δ, along each axis, are a cluster; it is welded if it is no larger than that itself,
//! so that nothing drifts along a row of vertices, and if the next vertex of any kind is ten times as far away, so that
//! nothing is near by chance. All of its vertices move to the first one.
//!
//! The surface stays what it is. A cluster is left if welding it would
//! - make facets the same, or give an edge more facets than two or than it had;
//! - make surfaces touch in a vertex that did not: the facets around it were more than one fan then;
//! - leave nothing of a connected part of the surface;
//! - close a handle: the facets and edges that vanish inside of it would have to be contractible, or fill a hole.
//!
//! Linear time in the number of vertices and facets, as long as few vertices are near each other.

mod surface;

use crate::exchange::{Note, NoteCode, Plc};
use crate::mesh::VertexId;
use crate::plc::{VertexName, undirected};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use surface::Surface;

/// How much farther than 2δ the next vertex must be.
const GAP: f64 = 10.0;

/// What there is to weld, and what came of it.
#[derive(Clone, Debug, Default)]
pub struct Welding {
    /// The PLC with clusters welded, if there are any.
    pub plc: Option<Plc>,
    /// The clusters that are welded, each with its vertices in increasing order.
    pub welded: Vec<Vec<VertexId>>,
    /// The clusters that are left, and why.
    pub left: Vec<(Vec<VertexId>, Refusal)>,
}

/// Why vertices that are near each other are not welded.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Refusal {
    /// They are a row or a cloud that is larger than 2δ.
    Large,
    /// Other vertices are nearly as near.
    NoGap,
    /// The surface would not be what it is: parts of it would vanish, touch, or lose a handle.
    Topology,
    /// There is no mesh of the surface then.
    NoMesh,
}

impl Refusal {
    fn words(self) -> &'static str {
        match self {
            Refusal::Large => "they are farther apart than twice the precision",
            Refusal::NoGap => "other vertices are less than ten times as far away",
            Refusal::NoMesh => "there is no mesh then",
            Refusal::Topology => "parts of the surface would vanish, touch, or lose a handle",
        }
    }
}

impl Welding {
    /// Welds what is one to a precision.
    pub fn of(plc: &Plc, delta: f64) -> Welding {
        let in_range = |v: &VertexId| v.index() < plc.vertices.len();
        let corners = plc.facets.iter().flat_map(|f| &f.polygons).flatten();
        let finite = plc.vertices.iter().flatten().all(|x| x.is_finite());
        // Whatever is wrong with an input is said elsewhere.
        if delta <= 0.0 || !delta.is_finite() || !finite || !corners.clone().all(in_range) {
            return Welding::default();
        }
        let surface = Surface::new(plc);
        let movable = surface.movable(plc, 2.0 * delta);
        if movable.is_empty() {
            return Welding::default();
        }
        let mut welding = Welding::default();
        let mut clusters = Vec::new();
        for (cluster, refusal) in clusters_of(plc, &surface.representative, &movable, delta) {
            match refusal {
                None => clusters.push(cluster),
                Some(refusal) => welding.left.push((cluster, refusal)),
            }
        }
        loop {
            let wrong = surface.changes(&clusters);
            if !wrong.contains(&true) {
                break;
            }
            let mut kept = Vec::new();
            for (cluster, wrong) in clusters.into_iter().zip(wrong) {
                match wrong {
                    true => welding.left.push((cluster, Refusal::Topology)),
                    false => kept.push(cluster),
                }
            }
            clusters = kept;
        }
        if !clusters.is_empty() {
            welding.plc = Some(moved(plc, &surface.representative, &clusters));
        }
        welding.welded = clusters;
        welding
    }

    /// A coarser precision at which more vertices of open edges are welded, and how many are then.
    ///
    /// It is half the distance at which each of them has another one that it shares no edge with; of the largest such
    /// distance, of that of nine in ten, and of that of half of them, the one that welds most.
    pub fn coarser(plc: &Plc, delta: f64) -> Option<(f64, usize)> {
        let in_range = |v: &VertexId| {
            plc.vertices
                .get(v.index())
                .is_some_and(|p| p.iter().all(|x| x.is_finite()))
        };
        if !plc
            .facets
            .iter()
            .flat_map(|f| &f.polygons)
            .flatten()
            .all(in_range)
        {
            return None;
        }
        let surface = Surface::new(plc);
        let open = surface.edges.iter().filter(|(_, count)| **count == 1);
        let mut ends: Vec<VertexId> = open.flat_map(|(ends, _)| *ends).collect();
        let at = |v: VertexId| plc.vertices[v.index()];
        ends.sort_unstable();
        ends.dedup();
        ends.sort_by(|&v, &w| at(v)[0].total_cmp(&at(w)[0]));
        let nearest = |i: usize| {
            let v = ends[i];
            let mut best = f64::INFINITY;
            let mut look = |side: &mut dyn Iterator<Item = VertexId>| {
                for w in side {
                    if (at(v)[0] - at(w)[0]).abs() >= best {
                        break;
                    }
                    if !surface.edges.contains_key(&undirected([v, w])) {
                        best = best.min(distance(at(v), at(w)));
                    }
                }
            };
            look(&mut ends[..i].iter().rev().copied());
            look(&mut ends[i + 1..].iter().copied());
            best
        };
        let all = (0..ends.len()).map(nearest);
        let mut all: Vec<f64> = all.filter(|d| d.is_finite()).collect();
        all.sort_by(f64::total_cmp);
        let last = all.len().checked_sub(1)?;
        let welded = |precision: f64| {
            let clusters = Welding::of(plc, precision).welded;
            clusters.iter().map(|c| c.len() - 1).sum::<usize>()
        };
        let now = welded(delta);
        let places = [last, last * 9 / 10, last / 2];
        let tried = places.map(|i| 0.5 * all[i] * 1.01).map(|p| (p, welded(p)));
        let better = tried.into_iter().filter(|&(p, n)| p > delta && n > now);
        better.max_by_key(|&(_, n)| n)
    }

    /// Welds nothing after all, because there is no mesh of what comes of it.
    pub fn give_up(&mut self) {
        self.plc = None;
        let welded = std::mem::take(&mut self.welded);
        self.left
            .extend(welded.into_iter().map(|cluster| (cluster, Refusal::NoMesh)));
    }

    /// What has been welded and what has not, with the numbers of the input.
    pub fn notes(&self, plc: &Plc, delta: f64) -> Vec<Note> {
        let number = |v: &VertexId| VertexName::new(plc, *v).number;
        let mut notes = Vec::new();
        if !self.welded.is_empty() {
            let vertices: usize = self.welded.iter().map(|c| c.len() - 1).sum();
            let onto = self.welded.len();
            let example: Vec<i64> = self.welded[0].iter().take(4).map(number).collect();
            let text = format!(
                "{vertices} vertices are welded to {onto} others up to {:e} away, twice the precision: {example:?}{}; \
                 --precision exact welds nothing",
                2.0 * delta,
                if onto > 1 || vertices > 3 {
                    ", …"
                } else {
                    ""
                }
            );
            let listed = self.welded.iter().flatten().map(number);
            notes.push(Note::new(NoteCode::Welded, vertices, text).on_vertices(listed));
        }
        let mut kinds: BTreeMap<Refusal, Vec<&Vec<VertexId>>> = BTreeMap::new();
        for (cluster, refusal) in &self.left {
            kinds.entry(*refusal).or_default().push(cluster);
        }
        for (refusal, clusters) in kinds {
            let example: Vec<i64> = clusters[0].iter().take(4).map(number).collect();
            let text = format!(
                "{} groups of vertices at most {:e} from each other are not welded, as {}: {example:?}, …",
                clusters.len(),
                2.0 * delta,
                refusal.words()
            );
            let listed = clusters.iter().copied().flatten().map(number);
            notes.push(Note::new(NoteCode::NotWelded, clusters.len(), text).on_vertices(listed));
        }
        notes
    }
}

/// The distance along each axis.
fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max)
}

/// The clusters among movable vertices, and why each cannot be welded, if it cannot.
fn clusters_of(
    plc: &Plc,
    representative: &[VertexId],
    movable: &FxHashSet<VertexId>,
    delta: f64,
) -> Vec<(Vec<VertexId>, Option<Refusal>)> {
    let near = 2.0 * delta;
    let cell = GAP * near;
    let key = |p: [f64; 3]| p.map(|x| (x / cell).floor());
    let bits = |key: [f64; 3]| key.map(|x| (x + 0.0).to_bits());
    let at = |v: VertexId| plc.vertices[v.index()];
    let around = |v: VertexId| {
        let [x, y, z] = key(at(v));
        let steps = [-1.0, 0.0, 1.0];
        let cells = steps.into_iter().flat_map(move |i| steps.map(|j| (i, j)));
        cells.flat_map(move |(i, j)| steps.map(|k| bits([x + i, y + j, z + k])))
    };
    // Only the cells around movable vertices are of interest.
    let mut grid: FxHashMap<[u64; 3], Vec<VertexId>> = FxHashMap::default();
    for &v in movable {
        for cell in around(v) {
            grid.entry(cell).or_default();
        }
    }
    for (i, &first) in representative.iter().enumerate() {
        if first.index() == i
            && let Some(list) = grid.get_mut(&bits(key(at(first))))
        {
            list.push(first);
        }
    }
    let within = |v: VertexId, most: f64| {
        let all = around(v).flat_map(|cell| grid.get(&cell).into_iter().flatten().copied());
        let mut found: Vec<VertexId> = all.filter(|&w| distance(at(v), at(w)) <= most).collect();
        found.sort_unstable();
        found
    };
    let mut order: Vec<VertexId> = movable.iter().copied().collect();
    order.sort_unstable();
    let mut seen: FxHashSet<VertexId> = FxHashSet::default();
    let mut clusters = Vec::new();
    for v in order {
        if !seen.insert(v) {
            continue;
        }
        let mut cluster = vec![v];
        let mut next = 0;
        while let Some(&w) = cluster.get(next) {
            next += 1;
            for x in within(w, near) {
                if movable.contains(&x) && seen.insert(x) {
                    cluster.push(x);
                }
            }
        }
        if cluster.len() < 2 {
            continue;
        }
        cluster.sort_unstable();
        let extent = |k: usize| {
            let values = || cluster.iter().map(|&v| at(v)[k]);
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
        };
        let is_large = (0..3).any(|k| extent(k) > near);
        let other = |w: &VertexId| cluster.binary_search(w).is_err();
        let has_gap = || {
            !cluster
                .iter()
                .any(|&v| within(v, GAP * near).iter().any(other))
        };
        let refusal = match (is_large, is_large || has_gap()) {
            (true, _) => Some(Refusal::Large),
            (_, false) => Some(Refusal::NoGap),
            _ => None,
        };
        clusters.push((cluster, refusal));
    }
    clusters
}

/// The PLC with the vertices of each cluster, and those at their places, at its first.
fn moved(plc: &Plc, representative: &[VertexId], clusters: &[Vec<VertexId>]) -> Plc {
    let mut onto: FxHashMap<VertexId, VertexId> = FxHashMap::default();
    for cluster in clusters {
        onto.extend(cluster.iter().map(|&v| (v, cluster[0])));
    }
    let mut moved = plc.clone();
    for (i, first) in representative.iter().enumerate() {
        if let Some(target) = onto.get(first) {
            moved.vertices[i] = plc.vertices[target.index()];
        }
    }
    moved
}

#[cfg(test)]
mod tests;
