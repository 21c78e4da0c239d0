//! Finds segments of the input by their ends: the segments in order of the end with the smaller id, and where those of
//! each vertex begin.

use crate::mesh::VertexId;
use crate::plc::Complex;
use std::sync::Arc;

/// Finds a segment of the input by its ends. Cheap to clone.
#[derive(Clone, Debug, Default)]
pub struct SegmentIndex(Arc<Pairs>);

/// For each vertex the segments of which it is the end with the smaller id.
#[derive(Debug, Default)]
struct Pairs {
    /// Where those of vertex i begin in `list`; one more at the end.
    starts: Vec<u32>,
    /// The other end and the segment, by the other end.
    list: Vec<(VertexId, u32)>,
}

/// From how many segments at a vertex on they are searched by bisection.
const MANY: usize = 16;

impl SegmentIndex {
    /// The index of a complex. Time linear in its segments and vertices, but for the sorting at vertices of many.
    pub fn new(complex: &Complex) -> SegmentIndex {
        let ends = || complex.segments.iter().map(|s| key(s.ends[0], s.ends[1]));
        let n = ends().map(|[low, _]| low.index() + 1).max().unwrap_or(0);
        // First the numbers of segments, then where the next one goes.
        let mut starts = vec![0; n + 1];
        ends().for_each(|[low, _]| starts[low.index() + 1] += 1);
        for i in 0..n {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut list = vec![(VertexId::INFINITE, 0); complex.segments.len()];
        for (s, [low, high]) in ends().enumerate() {
            list[next[low.index()] as usize] = (high, s as u32);
            next[low.index()] += 1;
        }
        for range in starts.windows(2) {
            list[range[0] as usize..range[1] as usize].sort_unstable();
        }
        SegmentIndex(Arc::new(Pairs { starts, list }))
    }

    #[inline]
    pub(super) fn find(&self, a: VertexId, b: VertexId) -> Option<u32> {
        let [low, high] = key(a, b);
        let Pairs { starts, list } = &*self.0;
        let (&start, &end) = (starts.get(low.index())?, starts.get(low.index() + 1)?);
        let at_low = &list[start as usize..end as usize];
        let found = if at_low.len() < MANY {
            at_low.iter().position(|(v, _)| *v == high)
        } else {
            at_low.binary_search_by_key(&high, |(v, _)| *v).ok()
        };
        found.map(|i| at_low[i].1)
    }
}

#[inline]
pub(super) fn key(a: VertexId, b: VertexId) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}
