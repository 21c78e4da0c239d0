//! How segments are divided into subsegments by their Steiner points.
//!
//! The vertices of a segment are linked from its first end to its second: each Steiner point knows the two next to it,
//! and each segment the two next to its ends. So a pair of vertices is a subsegment if one names the other, which takes
//! one look-up, and a division changes four links. Pairs of vertices of the input, and only those, are searched for
//! ([`SegmentIndex`]).

use super::segment_index::{SegmentIndex, key};
use crate::mesh::VertexId;
use crate::number::Parameter;
use crate::plc::{Complex, Polygon};
use crate::predicate::{GrowingStore, PointStore};

const ON_SEGMENT: &str = "this Steiner point is on a segment";

/// The segments of a complex and how they are divided into subsegments.
#[derive(Clone, Debug, Default)]
pub struct Subsegments {
    index: SegmentIndex,
    segments: Vec<Chain>,
    /// For each Steiner point the vertices before and after it on its segment; twice the vertex at infinity if it lies
    /// on a polygon. Indexed from `first_steiner`, like `places`.
    around: Vec<[VertexId; 2]>,
    /// For each Steiner point, the segment it lies on and its parameter there, or `None` if it lies on a polygon.
    places: Vec<Option<(u32, Parameter)>>,
    first_steiner: usize,
}

/// One segment.
#[derive(Clone, Copy, Debug)]
struct Chain {
    ends: [VertexId; 2],
    /// The vertex after the first end and the vertex before the second.
    inner: [VertexId; 2],
    /// The number of vertices, the ends included.
    vertices: u32,
}

impl Subsegments {
    pub(super) fn new(complex: &Complex, first_steiner: usize) -> Subsegments {
        let chain = |ends: [VertexId; 2]| Chain {
            ends,
            inner: [ends[1], ends[0]],
            vertices: 2,
        };
        Subsegments {
            index: SegmentIndex::new(complex),
            segments: complex.segments.iter().map(|s| chain(s.ends)).collect(),
            around: Vec::new(),
            places: Vec::new(),
            first_steiner,
        }
    }

    /// The segments of the input, by their ends.
    pub(crate) fn index(&self) -> &SegmentIndex {
        &self.index
    }

    /// The segment of the input with the ends a and b.
    pub(super) fn segment_with_ends(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.index.find(a, b)
    }

    /// The segment that ab is a subsegment of, as an index in [`Complex::segments`].
    #[inline]
    pub fn segment_of(&self, a: VertexId, b: VertexId) -> Option<u32> {
        let [low, high] = key(a, b);
        match high.index().checked_sub(self.first_steiner) {
            Some(i) => {
                let is_next = self.around.get(i)?.contains(&low);
                is_next.then(|| self.place(i).0)
            }
            None => {
                let s = self.index.find(low, high)?;
                (self.segments[s as usize].vertices == 2).then_some(s)
            }
        }
    }

    /// The segment and the parameter of the Steiner point with index i, which is on a segment.
    fn place(&self, i: usize) -> (u32, Parameter) {
        self.places[i].expect(ON_SEGMENT)
    }

    /// The segment that a Steiner point lies on; `None` for vertices of the input and for Steiner points on polygons.
    #[inline]
    pub fn segment_of_steiner(&self, v: VertexId) -> Option<u32> {
        let i = v.index().checked_sub(self.first_steiner)?;
        let place = self.places.get(i).copied().flatten();
        place.map(|(s, _)| s)
    }

    /// Whether a and b are vertices of one segment of the input.
    pub fn share_segment(&self, a: VertexId, b: VertexId) -> bool {
        let is_on = |s: u32, v: VertexId| {
            self.ends(s).contains(&v) || self.segment_of_steiner(v) == Some(s)
        };
        let segment = |v: VertexId| self.segment_of_steiner(v);
        match segment(a).or(segment(b)) {
            Some(s) => is_on(s, a) && is_on(s, b),
            None => self.index.find(a, b).is_some(),
        }
    }

    /// The ends of the segment that a Steiner point lies on and its parameter there; `None` for other vertices.
    pub fn place_of_steiner(&self, v: VertexId) -> Option<([VertexId; 2], Parameter)> {
        let i = v.index().checked_sub(self.first_steiner)?;
        let (s, t) = self.places.get(i).copied().flatten()?;
        Some((self.ends(s), t))
    }

    /// The vertices of segment `s` from its first end to its second.
    pub fn chain(&self, s: u32) -> impl Iterator<Item = VertexId> + '_ {
        self.walk(s, 0)
    }

    /// The vertices of segment `s` from its end `from` to the other one.
    fn walk(&self, s: u32, from: usize) -> impl Iterator<Item = VertexId> + '_ {
        let Chain { ends, inner, .. } = self.segments[s as usize];
        let last = ends[1 - from];
        let mut next = Some(ends[from]);
        std::iter::from_fn(move || {
            let v = next?;
            next = if v == last {
                None
            } else if v == ends[from] {
                Some(inner[from])
            } else {
                Some(self.around[v.index() - self.first_steiner][1 - from])
            };
            Some(v)
        })
    }

    /// The directed subsegments that bound a polygon.
    pub fn boundary(&self, polygon: &Polygon) -> Vec<[VertexId; 2]> {
        let mut boundary = Vec::with_capacity(polygon.edges.len());
        self.append_boundary(polygon, &mut boundary);
        boundary
    }

    /// Appends the directed subsegments that bound a polygon, edge by edge. An edge that is no segment of the input
    /// is there itself: it is an edge of a polygon that has been cut.
    pub(crate) fn append_boundary(&self, polygon: &Polygon, boundary: &mut Vec<[VertexId; 2]>) {
        for &[a, b] in &polygon.edges {
            let segment = self.index.find(a, b);
            let Some(s) = segment.filter(|&s| self.vertices_on(s) > 2) else {
                boundary.push([a, b]);
                continue;
            };
            let mut chain = self.walk(s, usize::from(self.ends(s)[0] != a));
            let mut last = chain.next().expect("a chain has two ends");
            boundary.extend(chain.map(|v| [std::mem::replace(&mut last, v), v]));
        }
    }

    /// How many Steiner points there are.
    pub fn steiner_count(&self) -> usize {
        self.places.len()
    }

    /// How many Steiner points lie exactly on their segment.
    pub fn count_exact<P: PointStore>(&self, points: &P) -> usize {
        let on_segment = |&(i, place): &(usize, &Option<(u32, Parameter)>)| {
            place.is_some_and(|(s, _)| {
                let [p, q] = self.ends(s);
                points.collinear([p, q, VertexId::new(self.first_steiner + i)])
            })
        };
        self.places.iter().enumerate().filter(on_segment).count()
    }

    /// The parameter of a vertex of segment s.
    pub(super) fn parameter(&self, s: u32, v: VertexId) -> Parameter {
        match v.index().checked_sub(self.first_steiner) {
            Some(i) => self.place(i).1,
            None if v == self.ends(s)[0] => 0.0.into(),
            None => 1.0.into(),
        }
    }

    /// The subsegment ab of segment s in the direction of the segment.
    pub(super) fn directed(&self, s: u32, [a, b]: [VertexId; 2]) -> [VertexId; 2] {
        let forward = match a.index().checked_sub(self.first_steiner) {
            Some(i) => self.around[i][1] == b,
            None => a == self.ends(s)[0],
        };
        if forward { [a, b] } else { [b, a] }
    }

    /// Divides the subsegment ab of segment s at v, which has the parameter t.
    pub(super) fn split(
        &mut self,
        s: u32,
        [a, b]: [VertexId; 2],
        t: Parameter,
        v: VertexId,
    ) -> [[VertexId; 2]; 2] {
        debug_assert_eq!(v.index(), self.first_steiner + self.places.len());
        let [p, q] = self.directed(s, [a, b]);
        self.places.push(Some((s, t)));
        self.around.push([p, q]);
        self.link(s, p, 1, v);
        self.link(s, q, 0, v);
        self.segments[s as usize].vertices += 1;
        [[a, v], [v, b]]
    }

    /// Lets v be next to p on segment s, before (0) or after (1) it.
    fn link(&mut self, s: u32, p: VertexId, side: usize, v: VertexId) {
        match p.index().checked_sub(self.first_steiner) {
            Some(i) => self.around[i][side] = v,
            None => self.segments[s as usize].inner[1 - side] = v,
        }
    }

    /// Notes that the next Steiner point lies on a polygon.
    pub(super) fn push_on_polygon(&mut self) {
        self.places.push(None);
        self.around.push([VertexId::INFINITE; 2]);
    }

    /// The ends of segment s.
    #[inline]
    pub(super) fn ends(&self, s: u32) -> [VertexId; 2] {
        self.segments[s as usize].ends
    }

    /// The ends of all segments.
    pub(super) fn all_ends(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.segments.iter().map(|chain| chain.ends)
    }

    /// The number of vertices on segment s, its ends included.
    pub(super) fn vertices_on(&self, s: u32) -> usize {
        self.segments[s as usize].vertices as usize
    }

    /// The first Steiner point.
    pub(crate) fn first_steiner(&self) -> usize {
        self.first_steiner
    }

    /// The vertices before and after the Steiner point v on its segment.
    pub(super) fn around(&self, v: VertexId) -> [VertexId; 2] {
        self.around[v.index() - self.first_steiner]
    }

    /// Joins the two subsegments that meet in the Steiner point v.
    pub(super) fn join_at(&mut self, v: VertexId) {
        let [p, q] = self.around(v);
        let (s, _) = self.place(v.index() - self.first_steiner);
        self.link(s, p, 1, q);
        self.link(s, q, 0, p);
        self.segments[s as usize].vertices -= 1;
    }

    /// Adds the Steiner points, all of which are on segments, to a store that has the other vertices only.
    pub(super) fn push_all<P: GrowingStore>(&self, points: &mut P) {
        for place in &self.places {
            let (s, t) = place.expect(ON_SEGMENT);
            let [p, q] = self.ends(s);
            points.push_on_segment(p, q, t);
        }
    }

    /// Numbers the Steiner points anew, without those that are gone. Returns the new ids by old place;
    /// where a point is gone, none.
    pub(super) fn compact(&mut self, gone: &[bool]) -> Vec<Option<VertexId>> {
        let first = self.first_steiner;
        let mut kept = 0;
        let mut ids: Vec<Option<VertexId>> = Vec::with_capacity(gone.len());
        for (i, &gone) in gone.iter().enumerate() {
            ids.push((!gone).then(|| VertexId::new(first + kept)));
            if !gone {
                self.places[kept] = self.places[i];
                self.around[kept] = self.around[i];
                kept += 1;
            }
        }
        self.places.truncate(kept);
        self.around.truncate(kept);
        let chains = self.segments.iter_mut().map(|chain| &mut chain.inner);
        for v in chains.chain(&mut self.around).flatten() {
            if let Some(i) = v.index().checked_sub(first) {
                *v = ids[i].expect("links name what is kept");
            }
        }
        ids
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::Segment;
    use rustc_hash::FxHashMap;

    /// The subsegments after many divisions and joins are those that a list of each segment's vertices tells.
    #[test]
    fn links_agree_with_lists() {
        let ends = [[0, 1], [2, 1], [5, 3], [0, 4], [4, 2]].map(|e| e.map(VertexId::new));
        let spokes = (7..40).map(|i| [VertexId::new(i), VertexId::new(6)]);
        let segments = ends
            .into_iter()
            .chain(spokes)
            .map(|ends| Segment { ends, marker: 0 });
        let complex = Complex {
            segments: segments.collect(),
            ..Complex::default()
        };
        let mut subsegments = Subsegments::new(&complex, 40);
        let mut lists: Vec<Vec<VertexId>> =
            complex.segments.iter().map(|s| s.ends.into()).collect();
        let check = |subsegments: &Subsegments, lists: &[Vec<VertexId>]| {
            let mut expected = FxHashMap::default();
            for (s, list) in lists.iter().enumerate() {
                assert_eq!(&subsegments.chain(s as u32).collect::<Vec<_>>(), list);
                let polygon = Polygon {
                    edges: vec![
                        complex.segments[s].ends,
                        [VertexId::new(9), VertexId::new(30)],
                    ],
                    vertices: Vec::new(),
                    frame: [VertexId::new(0); 3],
                    flat: true,
                    facets: Vec::new(),
                    marker: 0,
                };
                let mut boundary = Vec::new();
                subsegments.append_boundary(&polygon, &mut boundary);
                let mut steps: Vec<_> = list.windows(2).map(|w| [w[0], w[1]]).collect();
                steps.push(polygon.edges[1]);
                assert_eq!(boundary, steps);
                let backwards: Vec<VertexId> = list.iter().rev().copied().collect();
                assert_eq!(subsegments.walk(s as u32, 1).collect::<Vec<_>>(), backwards);
                expected.extend(list.windows(2).map(|w| (key(w[0], w[1]), s as u32)));
            }
            let n = 40 + subsegments.steiner_count();
            for [a, b] in (0..n).flat_map(|a| (0..n).map(move |b| [a, b].map(VertexId::new))) {
                let s = expected.get(&key(a, b)).copied();
                assert_eq!(subsegments.segment_of(a, b), s);
            }
        };
        for i in 0..30 {
            let s = i * i % 7;
            let at = 1 + i * 5 % (lists[s].len() - 1);
            let (p, q) = (lists[s][at - 1], lists[s][at]);
            let [low, high] = [p, q].map(|v| subsegments.parameter(s as u32, v));
            let t = Parameter::middle(low, high).expect("far apart");
            let v = VertexId::new(40 + i);
            let ab = if i % 2 == 0 { [p, q] } else { [q, p] };
            subsegments.split(s as u32, ab, t, v);
            lists[s].insert(at, v);
        }
        check(&subsegments, &lists);
        let mut gone = [false; 30];
        for i in [29, 3, 4, 12] {
            let v = VertexId::new(40 + i);
            subsegments.join_at(v);
            lists.iter_mut().for_each(|list| list.retain(|&w| w != v));
            gone[i] = true;
        }
        let ids = subsegments.compact(&gone);
        for v in lists.iter_mut().flatten().filter(|v| v.index() >= 40) {
            *v = ids[v.index() - 40].expect("it is left");
        }
        assert_eq!(subsegments.steiner_count(), 26);
        check(&subsegments, &lists);
    }
}
