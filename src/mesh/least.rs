//! Simplices grouped by their least vertex: sorted and found without comparing or hashing them all.
//!
//! Vertices are small numbers, and few simplices have the same least vertex, so that a counting sort does nearly all of
//! the work. O(n + k log d) for k simplices on n vertices, of which d at most have the same least vertex; O(log d) for
//! a look-up.

use super::VertexId;
use crate::threads;

/// Items of which `start[v]..start[v + 1]` have the least vertex v.
#[derive(Clone, Debug, Default)]
pub(crate) struct Groups<T> {
    start: Vec<u32>,
    items: Vec<T>,
}

/// Fewer items are sorted by one thread.
const FEW: usize = 1 << 15;

impl<T: Copy + Send> Groups<T> {
    /// Groups items, each with its least vertex, which is below `n`; they keep their order in each group.
    pub(crate) fn new(n: usize, items: impl Iterator<Item = (VertexId, T)> + Clone) -> Groups<T> {
        // Two places ahead, so that the places one ahead can move from the starts of the groups to their ends.
        let mut start = vec![0u32; n + 2];
        let mut filler = None;
        for (v, item) in items.clone() {
            start[v.index() + 2] += 1;
            filler = Some(item);
        }
        let mut sum = 0u32;
        for count in &mut start {
            sum = sum.checked_add(*count).expect("fewer than 2^32 simplices");
            *count = sum;
        }
        let mut grouped = filler.map_or(Vec::new(), |filler| vec![filler; sum as usize]);
        for (v, item) in items {
            let next = &mut start[v.index() + 1];
            grouped[*next as usize] = item;
            *next += 1;
        }
        start.pop();
        Groups {
            start,
            items: grouped,
        }
    }

    /// The items with least vertex v.
    #[inline]
    pub(crate) fn of(&self, v: VertexId) -> &[T] {
        match self.start.get(v.index()..v.index() + 2) {
            Some(&[from, to]) => &self.items[from as usize..to as usize],
            _ => &[],
        }
    }

    /// The items of all groups, for the last time, sorted by key in each group.
    pub(crate) fn into_sorted<K: Ord>(mut self, key: impl Fn(&T) -> K + Sync) -> Vec<T> {
        self.sort_groups(key);
        self.items
    }

    /// Sorts the items of each group; several threads share the groups.
    pub(crate) fn sort_groups<K: Ord>(&mut self, key: impl Fn(&T) -> K + Sync) {
        let sort = |(start, items): (&[u32], &mut [T])| {
            for range in start.windows(2) {
                let [from, to] = [range[0] - start[0], range[1] - start[0]];
                let group = &mut items[from as usize..to as usize];
                if group.len() > 1 {
                    group.sort_unstable_by_key(&key);
                }
            }
        };
        let mut parts = Vec::new();
        let (mut start, mut items) = (&self.start[..], &mut self.items[..]);
        while items.len() >= 2 * FEW {
            let cut = start.partition_point(|&s| ((s - start[0]) as usize) < FEW);
            let (own, rest) = items.split_at_mut((start[cut] - start[0]) as usize);
            parts.push((&start[..=cut], own));
            (start, items) = (&start[cut..], rest);
        }
        parts.push((start, items));
        threads::each(parts.into_iter(), 2, sort);
    }
}

/// Sorts simplices on n vertices by a key of which their least vertex, which `least` returns, is the first part.
pub(crate) fn sort_by_least<T: Copy + Send, K: Ord>(
    items: &mut Vec<T>,
    n: usize,
    least: impl Fn(&T) -> VertexId,
    key: impl Fn(&T) -> K + Sync,
) {
    // Few of many vertices.
    if items.len() < n / 8 {
        items.sort_unstable_by_key(key);
        return;
    }
    let groups = Groups::new(n, items.iter().map(|item| (least(item), *item)));
    *items = groups.into_sorted(key);
}

/// A number for each of some simplices, found by their vertices; K is their number without the least one.
#[derive(Clone, Debug)]
pub(crate) struct SimplexIndex<const K: usize>(Groups<([VertexId; K], u32)>);

/// Groups that are larger than this are searched by bisection.
const MOST_IN_A_ROW: usize = 8;

impl<const K: usize> SimplexIndex<K> {
    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.items.is_empty()
    }

    fn new(
        n: usize,
        items: impl Iterator<Item = (VertexId, ([VertexId; K], u32))> + Clone,
    ) -> Self {
        let mut groups = Groups::new(n, items);
        groups.sort_groups(|item| item.0);
        SimplexIndex(groups)
    }

    #[inline]
    fn find(&self, least: VertexId, others: [VertexId; K]) -> Option<u32> {
        let group = self.0.of(least);
        if group.len() > MOST_IN_A_ROW {
            let found = group.binary_search_by(|item| item.0.cmp(&others));
            return found.ok().map(|i| group[i].1);
        }
        let found = group.iter().find(|item| item.0 == others);
        found.map(|&(_, number)| number)
    }
}

impl SimplexIndex<1> {
    /// Edges among n vertices, with their place in the iteration.
    pub(crate) fn of_edges(n: usize, edges: &[[VertexId; 2]]) -> Self {
        let edges = edges.iter().zip(0..);
        SimplexIndex::new(n, edges.map(|(&[a, b], i)| (a.min(b), ([a.max(b)], i))))
    }

    /// The number of an edge.
    #[inline]
    pub(crate) fn edge(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.find(a.min(b), [a.max(b)])
    }
}

impl SimplexIndex<2> {
    /// Triangles among n vertices, in ascending order of their vertices, with a number for each.
    pub(crate) fn of_triangles<'a>(
        n: usize,
        triangles: impl Iterator<Item = (&'a [VertexId; 3], &'a u32)> + Clone,
    ) -> Self {
        SimplexIndex::new(
            n,
            triangles.map(|(&[a, b, c], &number)| (a, ([b, c], number))),
        )
    }

    /// The number of a triangle, with its vertices in any order.
    #[inline]
    pub(crate) fn triangle(&self, [a, b, c]: [VertexId; 3]) -> Option<u32> {
        let (low, high) = (a.min(b), a.max(b));
        let (least, rest) = (low.min(c), low.max(c));
        self.find(least, [rest.min(high), rest.max(high)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    const N: usize = 12;

    fn triangle() -> impl Strategy<Value = [VertexId; 3]> {
        (0..N, 1..N, 1..N).prop_filter_map("distinct", |(a, i, j)| {
            let (b, c) = ((a + i) % N, (a + j) % N);
            (b != c).then(|| [a, b, c].map(VertexId::new))
        })
    }

    proptest! {
        /// Groups of all sizes, those that are bisected included.
        #[test]
        fn as_with_comparisons(triangles in prop::collection::vec(triangle(), 0..200), asked in triangle()) {
            let sorted = |mut t: [VertexId; 3]| {
                t.sort_unstable();
                t
            };
            let numbers: BTreeMap<[VertexId; 3], u32> =
                triangles.iter().zip(0..).map(|(&t, i)| (sorted(t), i)).collect();
            let index = SimplexIndex::of_triangles(N, numbers.iter());
            prop_assert_eq!(index.triangle(asked), numbers.get(&sorted(asked)).copied());
            for &t in &triangles {
                prop_assert_eq!(index.triangle(t), numbers.get(&sorted(t)).copied());
            }
            let [a, b, _] = asked;
            let edges: Vec<[VertexId; 2]> = numbers.keys().map(|&[a, b, _]| [b, a]).collect();
            let position = edges.iter().rposition(|e| e.contains(&a) && e.contains(&b));
            let index = SimplexIndex::of_edges(N, &edges);
            prop_assert_eq!(index.edge(a, b).is_some(), position.is_some());

            let mut items: Vec<([VertexId; 3], usize)> = triangles.iter().map(|&t| sorted(t)).zip(0..).collect();
            let mut expected = items.clone();
            expected.sort_unstable();
            sort_by_least(&mut items, N, |item| item.0[0], |&item| item);
            prop_assert_eq!(&items, &expected);
            sort_by_least(&mut items, 100 * N * 200, |item| item.0[0], |&item| item);
            prop_assert_eq!(items, expected);
        }
    }
}
