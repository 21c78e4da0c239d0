//! Insertion by several threads.
//!
//! The Hilbert curve is cut into as many pieces as there are threads, and the tetrahedralization of the first rounds
//! into as many parts ([`TetMesh::split`]): a tetrahedron belongs where most of its vertices are. Each thread inserts
//! the vertices of its piece into its part. A vertex whose conflict zone contains a tetrahedron with a neighbour in
//! another part is left over; so these tetrahedra stay as they are, and the parts fit together in the end. What is left
//! over follows then, in one thread.
//!
//! The parts together are at any time the Delaunay tetrahedralization of all vertices inserted so far. For the conflict
//! zone of p is connected, and the search for it, from a tetrahedron in conflict, sees all its neighbours: if all of
//! them are in the part then the zone is that in the whole, and it is replaced as in the whole. The threads' insertions
//! do not share a tetrahedron that they look at, since what one thread changes has all its neighbours in that thread's
//! part: so any interleaving is a serial order. Since that tetrahedralization is unique, the result does not depend on
//! the number of threads, except for the ids of its tetrahedra and the order of their vertices.
//!
//! For uniform points the interface has O(m^(2/3)) tetrahedra after m vertices in the first rounds, and the part of the
//! others that are left over is O(m^(−1/3)).

use super::Delaunay;
use super::order::Rounds;
use crate::mesh::{TetMesh, VertexId, WALL};
use crate::predicate::PointStore;
use rayon::prelude::*;

/// The first rounds, which one thread inserts, have at least one vertex in so many.
const FIRST: usize = 20;
/// For so many stretches of its piece of the curve each thread knows where to start a walk.
const STRETCHES: usize = 256;

/// Where the vertices of an order, renamed by their place in it, are to be inserted.
pub(super) struct Plan {
    /// [`Rounds::cuts`].
    cuts: Vec<Vec<usize>>,
    pieces: usize,
    /// The number of the first rounds.
    first: usize,
}

impl Plan {
    /// For so many threads.
    pub fn new(rounds: &Rounds, pieces: u16) -> Plan {
        let pieces = usize::from(pieces);
        let cuts = rounds.cuts(pieces);
        let end = |round: &Vec<usize>| round[pieces];
        let all = cuts.last().map_or(0, end);
        let first = 1 + cuts.partition_point(|round| end(round) < all / FIRST);
        Plan {
            cuts,
            pieces,
            first,
        }
    }

    /// How many vertices the first rounds have.
    pub fn prefix(&self) -> usize {
        let last = self.cuts[..self.first].last();
        last.map_or(0, |round| round[self.pieces])
    }

    /// The round of a vertex.
    fn round(&self, v: VertexId) -> usize {
        let end = |round: &Vec<usize>| round[self.pieces];
        self.cuts.partition_point(|round| end(round) <= v.index())
    }

    /// The piece of a vertex.
    fn piece(&self, v: VertexId) -> usize {
        self.cuts[self.round(v)][1..self.pieces].partition_point(|&cut| cut <= v.index())
    }

    /// How many vertices of a piece are not in the first rounds.
    fn count(&self, piece: usize) -> usize {
        let later = self.cuts[self.first..].iter();
        later.map(|round| round[piece + 1] - round[piece]).sum()
    }

    /// Inserts all vertices that are not in the first rounds, except `seed`, into the tetrahedralization of these and
    /// `seed`.
    ///
    /// # Errors
    /// Two vertices at one place.
    pub fn insert_rest<P: PointStore>(
        &self,
        first: Delaunay,
        points: &P,
        seed: [VertexId; 4],
    ) -> Result<Delaunay, [VertexId; 2]> {
        let tets = |vertices: usize| 7 * vertices + 64;
        let mut room: Vec<usize> = (0..self.pieces)
            .map(|k| tets(self.prefix() / self.pieces + self.count(k)))
            .collect();
        // The others join the first part in the end.
        room[0] = tets(points.len());
        let known = (0..self.prefix()).map(VertexId::new);
        let known: Vec<u16> = known.map(|v| self.piece(v) as u16).collect();
        let piece = |v: VertexId| match known.get(v.index()) {
            Some(&piece) => usize::from(piece),
            // One of the seed.
            None => self.piece(v),
        };
        let (parts, interface) = first.mesh.split(&room, |vertices| part(vertices, piece));
        let grow = |(piece, mesh)| self.grow(piece, mesh, points, seed);
        let grown: Vec<(TetMesh, Vec<VertexId>)> =
            parts.into_par_iter().enumerate().map(grow).collect();
        let (parts, left): (Vec<TetMesh>, Vec<Vec<VertexId>>) = grown.into_iter().unzip();
        let mut left = left.concat();
        left.sort_unstable();
        let mut whole = Delaunay::from_mesh(TetMesh::unite(parts, &interface));
        for v in left {
            whole.insert_new(points, v)?;
        }
        Ok(whole)
    }

    /// Inserts the vertices of a piece into a part of the mesh; returns those left over, too.
    fn grow<P: PointStore>(
        &self,
        piece: usize,
        mesh: TetMesh,
        points: &P,
        seed: [VertexId; 4],
    ) -> (TetMesh, Vec<VertexId>) {
        // Where a walk may start, by the stretch of the piece: a walk from far away may end at the border of the part.
        let mut starts = vec![WALL; STRETCHES];
        for t in mesh.finite() {
            let v = mesh.vertices(t)[0];
            let round = &self.cuts[self.round(v)];
            let (begin, end) = (round[piece], round[piece + 1]);
            if (begin..end).contains(&v.index()) {
                starts[(v.index() - begin) * STRETCHES / (end - begin)] = t;
            }
        }
        let is_empty = mesh.all().next().is_none();
        let mut part = Delaunay::from_mesh(mesh);
        let mut left = Vec::new();
        for round in &self.cuts[self.first..] {
            let (begin, end) = (round[piece], round[piece + 1]);
            for v in (begin..end)
                .map(VertexId::new)
                .filter(|v| !seed.contains(v))
            {
                if is_empty {
                    left.push(v);
                    continue;
                }
                let known = &mut starts[(v.index() - begin) * STRETCHES / (end - begin)];
                let mut start = part.locate(points, v);
                if start == WALL && *known != WALL {
                    part.start_at(*known);
                    start = part.locate(points, v);
                }
                if part.insert_within(points, v, start) {
                    *known = part.created()[0];
                } else {
                    left.push(v);
                }
            }
        }
        (part.mesh, left)
    }
}

/// Where a tetrahedron goes: to the piece of two of its vertices, or of the first.
fn part(vertices: [VertexId; 4], piece: impl Fn(VertexId) -> usize) -> usize {
    let mut seen = [usize::MAX; 4];
    let finite = vertices.iter().filter(|v| !v.is_infinite());
    for (i, &v) in finite.enumerate() {
        let piece = piece(v);
        if seen.contains(&piece) {
            return piece;
        }
        seen[i] = piece;
    }
    seen[0]
}
