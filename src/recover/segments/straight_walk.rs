//! What lies between two vertices a and b of a tetrahedralization: the edge ab, another vertex, or crossing tetrahedra.

use crate::mesh::{TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::tables::Stamps;

/// What lies ahead of a in the direction of b.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ahead {
    /// The edge ab is in the mesh; a tetrahedron that has it.
    Edge(TetId),
    /// The ray runs along an edge to this vertex, which lies between a and b.
    Vertex(VertexId),
    /// The ray enters this tetrahedron, and leaves it by the facet opposite a.
    Crosses(TetId),
}

/// Looks from a towards b, starting in `t`, a finite tetrahedron at a. A visibility walk within the star of a; the mesh
/// must be Delaunay, so that it cannot cycle.
pub fn look_ahead<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    mut t: TetId,
    a: VertexId,
    b: VertexId,
) -> Ahead {
    'walk: loop {
        let v = mesh.vertices(t);
        if v.contains(&b) {
            return Ahead::Edge(t);
        }
        let at_a = mesh.slot_of(t, a).expect("the walk stays in the star of a");
        let mut along = [true; 4];
        for slot in (0..4).filter(|&slot| slot != at_a) {
            let mut moved = v;
            moved[slot] = b;
            let side = points.orient3d(moved);
            if side.is_negative() {
                t = mesh.neighbor(t.corner(slot));
                continue 'walk;
            }
            along[slot] = side.is_zero();
        }
        let mut off = (0..4).filter(|&slot| slot != at_a && !along[slot]);
        return match (off.next(), off.next()) {
            (Some(slot), None) => Ahead::Vertex(v[slot]),
            _ => Ahead::Crosses(t),
        };
    }
}

/// What a segment passes through. Memory is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Crossed {
    /// The finite tetrahedra from the star of its first end on. Those that it touches only along an edge or a facet may
    /// be missing: for choosing a reference point, not for deciding.
    pub tets: Vec<TetId>,
    /// Their vertices; some may be named more than once.
    pub vertices: Vec<VertexId>,
    seen: Stamps,
}

impl Crossed {
    /// Forgets what was found.
    pub(super) fn clear(&mut self) {
        self.tets.clear();
        self.vertices.clear();
    }

    /// A tetrahedron at about this part of the way.
    pub(super) fn at(&self, part: f64) -> Option<TetId> {
        let last = self.tets.len().checked_sub(1)?;
        let i = (part * self.tets.len() as f64) as usize;
        Some(self.tets[i.min(last)])
    }

    /// Finds what ab crosses. `first` is the tetrahedron at a that it enters.
    pub(super) fn follow<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        first: TetId,
        a: VertexId,
        b: VertexId,
    ) {
        self.begin(mesh, first);
        if !self.walk(points, mesh, first, a, b) {
            self.begin(mesh, first);
            self.search(points, mesh, a, b);
        }
    }

    fn begin(&mut self, mesh: &TetMesh, first: TetId) {
        self.clear();
        self.tets.push(first);
        self.vertices.extend(mesh.vertices(first));
    }

    /// Goes from facet to facet as long as ab passes through their interiors: three signs per tetrahedron. Whether it
    /// does so all along.
    fn walk<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        first: TetId,
        a: VertexId,
        b: VertexId,
    ) -> bool {
        let mut exit = mesh.corner_of(first, a);
        // ab passes to the left of the edges x→y, y→z and z→x.
        let [mut x, mut y, mut z] = mesh.facet(exit);
        let side = |v, w| points.orient3d([a, b, v, w]);
        let is_left = |v, w| side(v, w).is_positive();
        if !(is_left(x, y) && is_left(y, z) && is_left(z, x)) {
            return false;
        }
        loop {
            let across = mesh.twin(exit);
            let (t, apex) = (across.tet(), mesh.vertex(across));
            if apex.is_infinite() {
                return false;
            }
            self.tets.push(t);
            self.vertices.push(apex);
            if apex == b {
                return true;
            }
            let [of_x, of_y, of_z] = [side(x, apex), side(y, apex), side(z, apex)];
            if of_x.is_zero() || of_y.is_zero() || of_z.is_zero() {
                return false;
            }
            let behind = if of_y.is_positive() && of_x.is_negative() {
                std::mem::replace(&mut z, apex)
            } else if of_z.is_positive() && of_y.is_negative() {
                std::mem::replace(&mut x, apex)
            } else {
                std::mem::replace(&mut y, apex)
            };
            exit = mesh.corner_of(t, behind);
        }
    }

    /// Looks at all neighbours of what is crossed.
    fn search<P: PointStore>(&mut self, points: &P, mesh: &TetMesh, a: VertexId, b: VertexId) {
        self.seen.clear(mesh.capacity());
        self.seen.insert(self.tets[0].index());
        let mut next = 0;
        while let Some(&t) = self.tets.get(next) {
            next += 1;
            for slot in 0..4 {
                let c = t.corner(slot);
                let across = mesh.twin(c);
                let n = across.tet();
                if !self.seen.contains(n.index())
                    && !mesh.is_ghost(n)
                    && crosses_facet(points, a, b, mesh.facet(c))
                {
                    self.seen.insert(n.index());
                    self.tets.push(n);
                    self.vertices.push(mesh.vertex(across));
                }
            }
        }
    }
}

/// Whether the open segment ab meets the closed triangle pqr in one point.
pub fn crosses_facet<P: PointStore>(
    points: &P,
    a: VertexId,
    b: VertexId,
    facet: [VertexId; 3],
) -> bool {
    let [p, q, r] = facet;
    if facet.contains(&a) || facet.contains(&b) {
        return false;
    }
    let sides = points.orient3d([a, p, q, r]) * points.orient3d([b, p, q, r]);
    if !sides.is_negative() {
        return false;
    }
    let turns = [[p, q], [q, r], [r, p]].map(|[x, y]| points.orient3d([a, b, x, y]));
    turns.iter().all(|s| !s.is_negative()) || turns.iter().all(|s| !s.is_positive())
}
