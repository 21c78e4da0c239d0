//! Which tetrahedra share a face: the uses of all faces with one smallest vertex are put together, for one vertex
//! after the other.
//!
//! O(n) for n tetrahedra, where no vertex has very many: the faces of such a one are sorted.

use crate::machine::prefetch;
use crate::mesh::VertexId;
use crate::threads;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A corner of a tetrahedron and the face opposite: 4·tetrahedron + corner, and [`BELOW`] if the orientation of the
/// tetrahedron has the corner below the face with its vertices in increasing order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Corner(u32);

const BELOW: u32 = 1 << 31;
/// No corner.
const NONE: Corner = Corner(u32::MAX);

impl Corner {
    fn new(tet: u32, corner: u8, below: bool) -> Corner {
        Corner(tet << 2 | u32::from(corner) | if below { BELOW } else { 0 })
    }

    /// The tetrahedron.
    #[inline(always)]
    pub(crate) fn tet(self) -> usize {
        ((self.0 & !BELOW) >> 2) as usize
    }

    /// The corner in it.
    #[inline(always)]
    pub(crate) fn corner(self) -> usize {
        (self.0 & 3) as usize
    }

    /// Whether the corner is below the face with its vertices in increasing order, if its tetrahedron is positive.
    #[inline(always)]
    pub(crate) fn is_below(self) -> bool {
        self.0 & BELOW != 0
    }
}

/// A face and the tetrahedra that have it.
#[derive(Clone, Copy)]
pub(crate) struct Face {
    /// The vertices, sorted.
    pub(crate) key: [VertexId; 3],
    /// The vertices opposite, of the first two tetrahedra; the second is there only if the face is shared.
    pub(crate) apexes: [VertexId; 2],
    /// The corners of these.
    corners: [Corner; 2],
}

impl Face {
    /// Whether two tetrahedra have it, or more.
    #[inline(always)]
    pub(crate) fn is_shared(&self) -> bool {
        self.corners[1] != NONE
    }

    /// The first corner opposite.
    #[inline(always)]
    pub(crate) fn first(&self) -> Corner {
        self.corners[0]
    }

    /// The first two corners, if there are two.
    #[inline(always)]
    pub(crate) fn both(&self) -> Option<[Corner; 2]> {
        self.is_shared().then_some(self.corners)
    }
}

/// How many faces are looked through one by one.
pub(crate) const FEW: usize = 64;

/// A tetrahedron's use of a face, of which the smallest vertex is known.
#[derive(Clone, Copy)]
pub(crate) struct Use {
    /// The second and third vertex.
    others: [VertexId; 2],
    apex: VertexId,
    corner: Corner,
}

/// Tetrahedra in the order of one of their vertices, those with the same one in increasing order.
pub(crate) struct Ordered {
    /// Those of vertex v: `order[start[v]..start[v + 1]]`.
    start: Vec<u32>,
    /// Atomic, for several threads write it.
    order: Vec<AtomicU32>,
}

/// How many threads share the counting at most, since each has counters of its own for all vertices; and the least
/// that is shared.
const SHARES: usize = 8;
const SHARED: usize = 1 << 15;

impl Ordered {
    /// In the order of the least, and of the second least vertices.
    ///
    /// Several threads do so for parts of the tetrahedra: each counts what it will put at each vertex, and knows from
    /// what the parts before it have counted where to put it.
    pub(crate) fn by_two_least(tets: &[[VertexId; 4]], vertices: usize) -> [Ordered; 2] {
        let shares = match tets.len() < 2 * SHARED {
            true => 1,
            false => rayon::current_num_threads().min(SHARES),
        };
        let share = tets.len().div_ceil(shares);
        let parts = || tets.chunks(share.max(1)).enumerate();
        let mut next: Vec<[Vec<u32>; 2]> = threads::each(parts(), 2, |(_, tets)| {
            let mut counts = [vec![0u32; vertices], vec![0u32; vertices]];
            for tet in tets {
                let least = two_least(tet);
                counts[0][least[0].index()] += 1;
                counts[1][least[1].index()] += 1;
            }
            counts
        });
        let start = [0, 1].map(|i| {
            let mut start = Vec::with_capacity(vertices + 1);
            let mut sum = 0;
            for v in 0..vertices {
                start.push(sum);
                for counts in &mut next {
                    let place = &mut counts[i][v];
                    sum += std::mem::replace(place, sum);
                }
            }
            start.push(sum);
            start
        });
        let blank = || (0..tets.len()).map(|_| AtomicU32::new(0)).collect();
        let order: [Vec<AtomicU32>; 2] = [blank(), blank()];
        threads::each(parts().zip(&mut next), 2, |((part, tets), next)| {
            for (t, tet) in (part * share..).zip(tets) {
                for (i, v) in two_least(tet).into_iter().enumerate() {
                    let place = &mut next[i][v.index()];
                    order[i][*place as usize].store(t as u32, Relaxed);
                    *place += 1;
                }
            }
        });
        let [s0, s1] = start;
        let [o0, o1] = order;
        [(s0, o0), (s1, o1)].map(|(start, order)| Ordered { start, order })
    }

    /// How many tetrahedra have a smaller vertex there.
    pub(crate) fn before(&self, v: usize) -> usize {
        self.start[v] as usize
    }

    pub(crate) fn range(&self, v: usize) -> Range<usize> {
        self.before(v)..self.before(v + 1)
    }

    /// A tetrahedron by its place in the order.
    #[inline(always)]
    pub(crate) fn tet(&self, place: usize) -> u32 {
        self.order[place].load(Relaxed)
    }

    /// The same, if there are so many.
    #[inline(always)]
    pub(crate) fn get(&self, place: usize) -> Option<u32> {
        self.order.get(place).map(|t| t.load(Relaxed))
    }
}

/// The two smallest of four, in order.
#[inline(always)]
fn two_least(&[a, b, c, d]: &[VertexId; 4]) -> [VertexId; 2] {
    let (p, q) = (a.min(b), a.max(b));
    let (r, s) = (c.min(d), c.max(d));
    [p.min(r), p.max(r).min(if p < r { q } else { s })]
}

impl Use {
    /// `below`: whether the apex of a positive tetrahedron is below the three vertices in increasing order.
    #[inline(always)]
    pub(crate) fn new(tet: u32, others: [VertexId; 2], apex: (VertexId, u8), below: bool) -> Use {
        Use {
            others,
            apex: apex.0,
            corner: Corner::new(tet, apex.1, below),
        }
    }
}

/// Puts the uses of one face together, for one smallest vertex after the other.
pub(crate) struct Gatherer {
    /// Those of the last vertex.
    pub(crate) faces: Vec<Face>,
    /// For each of them: one more than the previous one with the same second vertex, or 0.
    links: Vec<u32>,
    /// The last of them for each second vertex; all 0 between calls.
    heads: Vec<u32>,
    /// Those among them with more than two uses, perhaps with repetitions.
    pub(crate) crowded: Vec<usize>,
}

impl Gatherer {
    /// For so many vertices.
    pub(crate) fn new(vertices: usize) -> Gatherer {
        Gatherer {
            faces: Vec::new(),
            links: Vec::new(),
            heads: vec![0; vertices],
            crowded: Vec::new(),
        }
    }

    /// Lets the processor fetch what a use with this second vertex will want.
    #[inline(always)]
    pub(crate) fn prefetch(&self, second: VertexId) {
        prefetch(&self.heads, second.index());
    }

    /// Of all faces whose smallest vertex is v.
    pub(crate) fn gather(&mut self, v: VertexId, uses: &mut [Use]) {
        self.faces.clear();
        self.crowded.clear();
        if uses.len() > FEW {
            // Chains might be long.
            uses.sort_by_key(|u| u.others);
            for group in uses.chunk_by(|x, y| x.others == y.others) {
                self.push(v, &group[0]);
                group[1..]
                    .iter()
                    .for_each(|u| self.meet(self.faces.len() - 1, u));
            }
            return;
        }
        self.links.clear();
        for u in uses.iter() {
            let head = self.heads[u.others[0].index()];
            let mut place = head;
            while place > 0 && self.faces[place as usize - 1].key[2] != u.others[1] {
                place = self.links[place as usize - 1];
            }
            if place > 0 {
                self.meet(place as usize - 1, u);
            } else {
                self.push(v, u);
                self.links.push(head);
                self.heads[u.others[0].index()] = self.links.len() as u32;
            }
        }
        for face in &self.faces {
            self.heads[face.key[1].index()] = 0;
        }
    }

    #[inline(always)]
    fn push(&mut self, v: VertexId, u: &Use) {
        self.faces.push(Face {
            key: [v, u.others[0], u.others[1]],
            apexes: [u.apex; 2],
            corners: [u.corner, NONE],
        });
    }

    #[inline(always)]
    fn meet(&mut self, f: usize, u: &Use) {
        let face = &mut self.faces[f];
        if face.is_shared() {
            self.crowded.push(f);
        } else {
            face.apexes[1] = u.apex;
            face.corners[1] = u.corner;
        }
    }
}

/// The vertices of a tetrahedron in increasing order, with their corners, and whether that is an odd permutation of
/// them.
#[inline(always)]
pub(crate) fn with_corners(tet: &[VertexId; 4]) -> ([(VertexId, u8); 4], bool) {
    // One number each, so that no branch depends on their order.
    let mut sorted = [0, 1, 2, 3].map(|i| u64::from(tet[i].0) << 2 | i as u64);
    let mut odd = false;
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        let (x, y) = (sorted[i], sorted[j]);
        odd ^= x > y;
        (sorted[i], sorted[j]) = (x.min(y), x.max(y));
    }
    (
        sorted.map(|x| (VertexId((x >> 2) as u32), (x & 3) as u8)),
        odd,
    )
}
