//! How segments are divided into subsegments by their Steiner points.

use crate::mesh::VertexId;
use crate::plc::{Complex, Polygon};
use crate::predicate::{Parameter, PointStore};
use rustc_hash::FxHashMap;

const ON_SEGMENT: &str = "this Steiner point is on a segment";

/// The segments of a complex and how they are divided into subsegments.
#[derive(Clone, Debug, Default)]
pub struct Subsegments {
    /// The segment of each subsegment, by its vertices in ascending order.
    of: FxHashMap<[VertexId; 2], u32>,
    /// For each segment its vertices with their parameters; from end to end once recovery is finished.
    chains: Vec<Vec<(Parameter, VertexId)>>,
    /// For each Steiner point, the segment it lies on and its parameter there, or `None` if it lies on a polygon; indexed
    /// from `first_steiner`.
    steiner: Vec<Option<(u32, Parameter)>>,
    first_steiner: usize,
    ends: Vec<[VertexId; 2]>,
    /// The segments that were split since the chains were last brought into order.
    out_of_order: Vec<u32>,
}

impl Subsegments {
    pub(super) fn new(complex: &Complex, first_steiner: usize) -> Subsegments {
        let ends: Vec<[VertexId; 2]> = complex.segments.iter().map(|s| s.ends).collect();
        Subsegments {
            of: ends
                .iter()
                .enumerate()
                .map(|(i, &[a, b])| (key(a, b), i as u32))
                .collect(),
            chains: ends
                .iter()
                .map(|&[a, b]| vec![(0.0.into(), a), (1.0.into(), b)])
                .collect(),
            steiner: Vec::new(),
            first_steiner,
            ends,
            out_of_order: Vec::new(),
        }
    }

    /// The segment that ab is a subsegment of, as an index in [`Complex::segments`].
    pub fn segment_of(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.of.get(&key(a, b)).copied()
    }

    /// The segment that a Steiner point lies on; `None` for vertices of the input and for Steiner points on polygons.
    pub fn segment_of_steiner(&self, v: VertexId) -> Option<u32> {
        let i = v.index().checked_sub(self.first_steiner)?;
        let place = self.steiner.get(i).copied().flatten();
        place.map(|(s, _)| s)
    }

    /// Whether a and b are vertices of one segment of the input.
    pub fn share_segment(&self, index: &SegmentIndex, a: VertexId, b: VertexId) -> bool {
        let is_on = |s: u32, v: VertexId| {
            self.ends[s as usize].contains(&v) || self.segment_of_steiner(v) == Some(s)
        };
        let place = |v: VertexId| self.segment_of_steiner(v);
        match place(a).or(place(b)) {
            Some(s) => is_on(s, a) && is_on(s, b),
            None => index.find(a, b).is_some(),
        }
    }

    /// The ends of the segment that a Steiner point lies on and its parameter there; `None` for other vertices.
    pub fn place_of_steiner(&self, v: VertexId) -> Option<([VertexId; 2], Parameter)> {
        let i = v.index().checked_sub(self.first_steiner)?;
        let (s, t) = self.steiner.get(i).copied().flatten()?;
        Some((self.ends[s as usize], t))
    }

    /// The vertices of segment `s` from its first end to its second.
    pub fn chain(&self, s: u32) -> impl DoubleEndedIterator<Item = VertexId> + '_ {
        self.chains[s as usize].iter().map(|&(_, v)| v)
    }

    /// Appends the directed subsegments that bound a polygon, edge by edge. An edge that is no segment of the input is there
    /// itself: it is an edge of a polygon that has been cut.
    pub(super) fn append_boundary(
        &self,
        index: &SegmentIndex,
        polygon: &Polygon,
        boundary: &mut Vec<[VertexId; 2]>,
    ) {
        for &[a, b] in &polygon.edges {
            let Some(s) = index.find(a, b) else {
                boundary.push([a, b]);
                continue;
            };
            let chain = &self.chains[s as usize];
            let steps = chain.windows(2).map(|w| [w[0].1, w[1].1]);
            if self.ends[s as usize][0] == a {
                boundary.extend(steps);
            } else {
                boundary.extend(steps.rev().map(|[p, q]| [q, p]));
            }
        }
    }

    /// How many Steiner points there are.
    pub fn steiner_count(&self) -> usize {
        self.steiner.len()
    }

    /// How many Steiner points lie exactly on their segment.
    pub fn count_exact<P: PointStore>(&self, points: &P) -> usize {
        let on_segment = |&(i, place): &(usize, &Option<(u32, Parameter)>)| {
            place.is_some_and(|(s, _)| {
                let [p, q] = self.ends(s);
                points.collinear([p, q, VertexId::new(self.first_steiner + i)])
            })
        };
        self.steiner.iter().enumerate().filter(on_segment).count()
    }

    /// The parameter of a vertex of segment s.
    pub(super) fn parameter(&self, s: u32, v: VertexId) -> Parameter {
        match v.index().checked_sub(self.first_steiner) {
            Some(i) => self.steiner[i].expect(ON_SEGMENT).1,
            None if v == self.ends[s as usize][0] => 0.0.into(),
            None => 1.0.into(),
        }
    }

    /// Divides the subsegment ab of segment s at v, which has the parameter t.
    pub(super) fn split(
        &mut self,
        s: u32,
        [a, b]: [VertexId; 2],
        t: Parameter,
        v: VertexId,
    ) -> [[VertexId; 2]; 2] {
        self.of.remove(&key(a, b));
        self.of.insert(key(a, v), s);
        self.of.insert(key(v, b), s);
        debug_assert_eq!(v.index(), self.first_steiner + self.steiner.len());
        self.steiner.push(Some((s, t)));
        self.chains[s as usize].push((t, v));
        self.out_of_order.push(s);
        [[a, v], [v, b]]
    }

    /// Notes that the next Steiner point lies on a polygon.
    pub(super) fn push_on_polygon(&mut self) {
        self.steiner.push(None);
    }

    /// The ends of segment s.
    pub(super) fn ends(&self, s: u32) -> [VertexId; 2] {
        self.ends[s as usize]
    }

    /// The ends of all segments.
    pub(super) fn all_ends(&self) -> &[[VertexId; 2]] {
        &self.ends
    }

    /// The number of vertices on segment s, its ends included.
    pub(super) fn vertices_on(&self, s: u32) -> usize {
        self.chains[s as usize].len()
    }

    /// The first Steiner point.
    pub(super) fn first_steiner(&self) -> usize {
        self.first_steiner
    }

    /// The vertices before and after the Steiner point v on its segment; once the chains are in order.
    pub(super) fn around(&self, v: VertexId) -> [VertexId; 2] {
        let i = self.position(v);
        let (s, _) = self.steiner[v.index() - self.first_steiner].expect(ON_SEGMENT);
        let chain = &self.chains[s as usize];
        [chain[i - 1].1, chain[i + 1].1]
    }

    /// Joins the two subsegments that meet in the Steiner point v; once the chains are in order.
    pub(super) fn join_at(&mut self, v: VertexId) {
        let [a, b] = self.around(v);
        let i = self.position(v);
        let (s, _) = self.steiner[v.index() - self.first_steiner].expect(ON_SEGMENT);
        self.chains[s as usize].remove(i);
        self.of.remove(&key(a, v));
        self.of.remove(&key(v, b));
        self.of.insert(key(a, b), s);
    }

    /// Adds the Steiner points, all of which are on segments, to a store that has the other vertices only.
    pub(super) fn place<P: PointStore>(&self, points: &mut P) {
        for place in &self.steiner {
            let (s, t) = place.expect(ON_SEGMENT);
            let [p, q] = self.ends(s);
            points.push_on_segment(p, q, t);
        }
    }

    fn position(&self, v: VertexId) -> usize {
        let (s, t) = self.steiner[v.index() - self.first_steiner].expect(ON_SEGMENT);
        let chain = &self.chains[s as usize];
        let found = chain.binary_search_by(|x| Parameter::order(&x.0, &t));
        found.expect("a Steiner point is on its segment")
    }

    /// Numbers the Steiner points anew, without those that are gone. Returns the new ids by old place;
    /// where a point is gone, none.
    pub(super) fn compact(&mut self, gone: &[bool]) -> Vec<Option<VertexId>> {
        let mut kept = Vec::new();
        let mut ids: Vec<Option<VertexId>> = Vec::new();
        for (i, &place) in self.steiner.iter().enumerate() {
            ids.push((!gone[i]).then(|| VertexId::new(self.first_steiner + kept.len())));
            if !gone[i] {
                kept.push(place);
            }
        }
        let first = self.first_steiner;
        let renamed = |v: VertexId| match v.index().checked_sub(first) {
            Some(i) => ids[i].expect("chains hold what is kept"),
            None => v,
        };
        for (_, v) in self.chains.iter_mut().flatten() {
            *v = renamed(*v);
        }
        let of = self
            .of
            .iter()
            .map(|(&[a, b], &s)| (key(renamed(a), renamed(b)), s));
        self.of = of.collect();
        self.steiner = kept;
        ids
    }

    /// Brings the chains into order, once all Steiner points are there.
    pub(super) fn finish(&mut self) {
        self.out_of_order.sort_unstable();
        self.out_of_order.dedup();
        for s in self.out_of_order.drain(..) {
            self.chains[s as usize].sort_unstable_by(|x, y| Parameter::order(&x.0, &y.0));
        }
    }
}

/// Finds a segment of the input by its ends.
#[derive(Clone, Debug)]
pub struct SegmentIndex(FxHashMap<[VertexId; 2], u32>);

impl SegmentIndex {
    /// The index of a complex.
    pub fn new(complex: &Complex) -> SegmentIndex {
        let segments = complex.segments.iter().enumerate();
        SegmentIndex(
            segments
                .map(|(i, s)| (key(s.ends[0], s.ends[1]), i as u32))
                .collect(),
        )
    }

    pub(super) fn find(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.0.get(&key(a, b)).copied()
    }
}

pub(super) fn key(a: VertexId, b: VertexId) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}
