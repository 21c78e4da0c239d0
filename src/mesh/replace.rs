//! Tetrahedra replaced by others that fill the same space: the one change of topology behind flips and grafts.

use super::{Corner, FACET, TetId, TetMesh, VertexId};
use rustc_hash::FxHashMap;

impl TetMesh {
    /// Replaces the tetrahedra `old` by `new`, which fill the same space: every facet of the new ones is a facet of
    /// another new one or of the boundary of the old ones. Returns the new ids, in order.
    ///
    /// All bistellar flips and the grafting of cavities are this one operation. Time linear in the sizes.
    pub fn replace(&mut self, old: &[TetId], new: &[[VertexId; 4]]) -> Vec<TetId> {
        let mut open = OpenFacets::with_capacity(4 * old.len().max(new.len()));
        for &t in old {
            for slot in 0..4 {
                let outside = self.twin(t.corner(slot));
                if !old.contains_fast(outside.tet()) {
                    open.insert(self.facet(t.corner(slot)), outside);
                }
            }
        }
        for &t in old {
            self.remove(t);
        }
        let ids: Vec<TetId> = new.iter().map(|&v| self.add(v)).collect();
        for &t in &ids {
            for slot in 0..4 {
                let c = t.corner(slot);
                let facet = self.facet(c);
                match open.take(facet) {
                    Some(d) => self.glue(c, d),
                    None => open.insert(facet, c),
                }
            }
        }
        assert!(
            open.is_empty(),
            "new tetrahedra fill the space of the old ones"
        );
        ids
    }

    /// Whether [`TetMesh::replace`] would find that `new` fills the space of `old`: the facets that only one of the new
    /// tetrahedra has are those of the boundary of the old ones.
    pub fn can_replace(&self, old: &[TetId], new: &[[VertexId; 4]]) -> bool {
        let mut open: FxHashMap<[VertexId; 3], i32> = FxHashMap::default();
        for &t in old {
            for c in (0..4).map(|slot| t.corner(slot)) {
                if !old.contains_fast(self.neighbor(c)) {
                    *open.entry(sorted(self.facet(c))).or_insert(0) += 1;
                }
            }
        }
        for v in new {
            for others in FACET {
                *open.entry(sorted(others.map(|i| v[i]))).or_insert(0) += 1;
            }
        }
        open.values().all(|&n| n == 2)
    }
}

/// Three vertices in ascending order.
#[inline]
fn sorted([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), low.max(high.min(c)), high.max(c)]
}

/// Membership in a short list by scan, in a long one that is sorted by binary search.
trait ContainsFast {
    fn contains_fast(&self, t: TetId) -> bool;
}

impl ContainsFast for [TetId] {
    fn contains_fast(&self, t: TetId) -> bool {
        if self.len() <= 8 {
            self.contains(&t)
        } else {
            debug_assert!(self.is_sorted());
            self.binary_search(&t).is_ok()
        }
    }
}

/// Facets seen once so far, by their three vertices: a short list, or a hash table.
enum OpenFacets {
    Few(Vec<([VertexId; 3], Corner)>),
    Many(FxHashMap<[VertexId; 3], Corner>),
}

impl OpenFacets {
    fn with_capacity(n: usize) -> OpenFacets {
        if n <= 32 {
            OpenFacets::Few(Vec::with_capacity(n))
        } else {
            OpenFacets::Many(FxHashMap::with_capacity_and_hasher(n, Default::default()))
        }
    }

    fn insert(&mut self, facet: [VertexId; 3], c: Corner) {
        let facet = sorted(facet);
        match self {
            OpenFacets::Few(list) => list.push((facet, c)),
            OpenFacets::Many(map) => {
                map.insert(facet, c);
            }
        }
    }

    fn take(&mut self, facet: [VertexId; 3]) -> Option<Corner> {
        let facet = sorted(facet);
        match self {
            OpenFacets::Few(list) => {
                let i = list.iter().position(|(f, _)| *f == facet)?;
                Some(list.swap_remove(i).1)
            }
            OpenFacets::Many(map) => map.remove(&facet),
        }
    }

    fn is_empty(&self) -> bool {
        match self {
            OpenFacets::Few(list) => list.is_empty(),
            OpenFacets::Many(map) => map.is_empty(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_vertices_are_sorted() {
        for p in [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ] {
            assert_eq!(sorted(p.map(VertexId)), [0, 1, 2].map(VertexId));
        }
    }
}
