//! Which facets of a triangulated sphere are next to each other, if it has many vertices.
//!
//! As in the smaller table, each directed edge has a place by the numbers of its ends; what is not on this sphere is
//! left over from others, and is not read. There are many more places than edges, but only those of edges are ever
//! touched. Beyond [`MOST`] vertices a hash table is used.

use crate::mesh::{Corner, TetId, VertexId};
use rustc_hash::FxHashMap;

/// The largest number of vertices for which there is a table: 4 MiB.
const MOST: usize = 1024;

/// A table of directed edges. Memory is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Large {
    /// The number of a vertex, if `members` says so; by id plus one, so that the vertex at infinity is the first.
    numbers: Vec<u32>,
    /// The vertices, by number.
    members: Vec<VertexId>,
    /// For each facet the numbers of its vertices.
    facets: Vec<[u32; 3]>,
    /// For the directed edge from the vertex with number i to that with number j, at the number of vertices times i,
    /// plus j, the new corner opposite the facet that it spans with the new vertex.
    opposite: Vec<Corner>,
    /// The same, for more vertices.
    hashed: FxHashMap<[u32; 2], Corner>,
}

impl Large {
    /// Learns the edges of facets, of which those at slots 1, 2, 3 of the given tetrahedra are opposite to their
    /// vertices.
    pub(super) fn fill(&mut self, facets: impl Iterator<Item = [VertexId; 3]>, new: &[TetId]) {
        self.members.clear();
        self.facets.clear();
        for [a, b, c] in facets {
            let numbers = [self.number(a), self.number(b), self.number(c)];
            self.facets.push(numbers);
        }
        let n = self.members.len();
        self.hashed.clear();
        if n <= MOST && self.opposite.len() < n * n {
            let size = n.next_power_of_two();
            self.opposite = vec![Corner::NONE; size * size];
        }
        for (&[i, j, k], t) in self.facets.iter().zip(new) {
            let corners = [t.corner(1), t.corner(2), t.corner(3)];
            let edges = [[j, k], [k, i], [i, j]];
            if n <= MOST {
                for slot in 0..3 {
                    let [from, to] = edges[slot];
                    self.opposite[from as usize * n + to as usize] = corners[slot];
                }
            } else {
                self.hashed.extend(edges.into_iter().zip(corners));
            }
        }
    }

    /// What is across the edges of the facet with this index, opposite to its vertices.
    pub(super) fn across(&self, facet: usize) -> [Corner; 3] {
        let [i, j, k] = self.facets[facet];
        [self.find(k, j), self.find(i, k), self.find(j, i)]
    }

    #[inline]
    fn find(&self, from: u32, to: u32) -> Corner {
        let n = self.members.len();
        if n <= MOST {
            self.opposite[from as usize * n + to as usize]
        } else {
            self.hashed[&[from, to]]
        }
    }

    #[inline]
    fn number(&mut self, v: VertexId) -> u32 {
        let i = v.0.wrapping_add(1) as usize;
        if i >= self.numbers.len() {
            self.numbers.resize(i + 1 + i / 8, 0);
        }
        let known = self.numbers[i];
        if self.members.get(known as usize) == Some(&v) {
            return known;
        }
        let number = self.members.len() as u32;
        self.numbers[i] = number;
        self.members.push(v);
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Double pyramids over polygons of few and of many corners.
    #[test]
    fn finds_what_is_next_to_a_facet() {
        let mut large = Large::default();
        for n in [100, 7, MOST as u32 + 1, 100] {
            let apexes = [VertexId::INFINITE, VertexId(7000)];
            let facets = || {
                (0..n).flat_map(|i| {
                    let (a, b) = (VertexId(40 + i), VertexId(40 + (i + 1) % n));
                    [[a, b, apexes[0]], [b, a, apexes[1]]]
                })
            };
            let new: Vec<TetId> = (0..2 * n as usize).map(|i| TetId::new(3 * i)).collect();
            large.fill(facets(), &new);
            let all: Vec<[VertexId; 3]> = facets().collect();
            for (f, [a, b, c]) in facets().enumerate() {
                let edges = [[c, b], [a, c], [b, a]];
                for (found, edge) in large.across(f).into_iter().zip(edges) {
                    let there = all[found.tet().index() / 3];
                    let [i, j] = [found.slot() % 3, (found.slot() + 1) % 3];
                    assert_eq!([there[i], there[j]], edge);
                }
            }
        }
    }
}
