//! The insertion of one vertex.

use super::star::{BoundaryFacet, Star};
use crate::mesh::{Corner, FACET, TetId, TetMesh, VertexId, WALL, any_infinite, is_wall};
use crate::predicate::PointStore;

/// A Delaunay tetrahedralization that grows.
#[derive(Clone, Debug, Default)]
pub struct Delaunay {
    /// The tetrahedra, ghosts included.
    pub mesh: TetMesh,
    /// Where the next walk starts.
    hint: Option<TetId>,
    scratch: Scratch,
}

/// What one insertion leaves for the next, so that nothing is allocated in the loop.
#[derive(Clone, Debug, Default)]
struct Scratch {
    /// The conflict zone; reused or removed at the end of the insertion.
    conflict: Vec<TetId>,
    /// The facets of the conflict zone's boundary.
    boundary: Vec<BoundaryFacet>,
    /// The star of the new vertex.
    created: Vec<TetId>,
    star: Star,
}

impl Delaunay {
    /// The positive tetrahedron abcd and its four ghosts.
    pub(super) fn from_tetrahedron(seed: [VertexId; 4]) -> Delaunay {
        let mut mesh = TetMesh::new();
        let inner = mesh.add(seed);
        let mirror = mesh.add([seed[1], seed[0], seed[2], seed[3]]);
        for slot in 0..4 {
            let c = inner.corner(slot);
            let d = mesh.corner_of(mirror, mesh.vertex(c));
            mesh.glue(c, d);
        }
        let ghosts = [0, 1, 2, 3].map(|slot: usize| {
            let mut v = mesh.vertices(mirror);
            v[slot] = VertexId::INFINITE;
            v
        });
        mesh.replace(&[mirror], &ghosts);
        Delaunay {
            mesh,
            hint: Some(inner),
            scratch: Scratch::default(),
        }
    }

    /// A tetrahedralization that is already Delaunay, to be grown further.
    pub fn from_mesh(mesh: TetMesh) -> Delaunay {
        Delaunay {
            mesh,
            hint: None,
            scratch: Scratch::default(),
        }
    }

    /// Lets the next walk start at `t`.
    pub fn start_at(&mut self, t: TetId) {
        self.hint = Some(t);
    }

    /// The conflict zone that [`Delaunay::find_conflicts`] found.
    pub fn conflicts(&self) -> &[TetId] {
        &self.scratch.conflict
    }

    /// The facets between that conflict zone and the rest, as corners of tetrahedra in the zone.
    pub fn conflict_boundary(&self) -> impl Iterator<Item = Corner> + '_ {
        self.scratch.boundary.iter().map(|facet| facet.inside)
    }

    /// The tetrahedra that the last insertion created: all those around the new vertex, ghosts included.
    pub fn created(&self) -> &[TetId] {
        &self.scratch.created
    }

    /// Inserts p, which differs from every vertex of the mesh. Expected O(1) after a short walk.
    pub fn insert<P: PointStore>(&mut self, points: &P, p: VertexId) {
        let start = self.locate(points, p);
        self.find_conflicts(points, p, start);
        self.replace_conflicts(p);
    }

    /// Inserts p, if no vertex of the mesh is at its place.
    ///
    /// # Errors
    /// That vertex, and p.
    #[inline]
    pub(super) fn insert_new<P: PointStore>(
        &mut self,
        points: &P,
        p: VertexId,
    ) -> Result<(), [VertexId; 2]> {
        let start = self.locate(points, p);
        if let Some(v) = self.vertex_at(points, p, start) {
            return Err([v, p]);
        }
        self.find_conflicts(points, p, start);
        self.replace_conflicts(p);
        Ok(())
    }

    /// The vertex at the place of p, if there is one; p was located in `t`, which then has it.
    #[inline]
    pub(super) fn vertex_at<P: PointStore>(
        &self,
        points: &P,
        p: VertexId,
        t: TetId,
    ) -> Option<VertexId> {
        let v = self.mesh.vertices(t);
        if any_infinite(v) {
            // Beyond a facet of the hull, where no vertex is.
            return None;
        }
        v.into_iter().find(|&v| points.coincide(v, p))
    }

    /// Inserts p into a part of a mesh, from `start`, where it was located, unless what is to be replaced touches
    /// other parts ([`WALL`]), or a vertex is at the place of p: then nothing changes, and the answer is no.
    pub(super) fn insert_within<P: PointStore>(
        &mut self,
        points: &P,
        p: VertexId,
        start: TetId,
    ) -> bool {
        if start == WALL || self.vertex_at(points, p, start).is_some() {
            return false;
        }
        self.find_conflicts(points, p, start);
        let facets = self.scratch.boundary.iter();
        if facets.map(BoundaryFacet::behind).any(|t| t == WALL) {
            self.hint = Some(start);
            return false;
        }
        self.replace_conflicts(p);
        true
    }

    /// The second half of an insertion: replaces the conflict zone of p, found just before by
    /// [`Delaunay::find_conflicts`], by the star of p. The star takes the memory of the zone, which is in the cache.
    pub fn replace_conflicts(&mut self, p: VertexId) {
        let scratch = &mut self.scratch;
        scratch.created.clear();
        scratch
            .created
            .extend(scratch.conflict.iter().take(scratch.boundary.len()));
        for _ in scratch.created.len()..scratch.boundary.len() {
            scratch.created.push(self.mesh.add([VertexId::INFINITE; 4]));
        }
        scratch
            .star
            .fill(&mut self.mesh, p, &mut scratch.boundary, &scratch.created);
        for &t in scratch.conflict.iter().skip(scratch.boundary.len()) {
            self.mesh.remove(t);
        }
        self.hint = scratch.created.last().copied();
    }

    /// A tetrahedron in conflict with p: the finite one that contains it, or the ghost beyond whose facet it lies.
    /// The visibility walk cannot cycle in a Delaunay tetrahedralization (Edelsbrunner 1990).
    pub fn locate<P: PointStore>(&self, points: &P, p: VertexId) -> TetId {
        let mesh = &self.mesh;
        let start = self.hint.filter(|&t| mesh.is_alive(t));
        let mut t = start.unwrap_or_else(|| mesh.all().next().expect("the mesh has tetrahedra"));
        if let Some(slot) = mesh.slot_of(t, VertexId::INFINITE) {
            t = mesh.neighbor(t.corner(slot));
            if mesh.is_ghost(t) {
                // The other side is in another part of the mesh.
                return t;
            }
        }
        while let Some(slot) = points.facet_towards(mesh.vertices(t), p) {
            t = mesh.neighbor(t.corner(slot));
            if mesh.is_ghost(t) {
                break;
            }
        }
        t
    }

    /// Whether the circumsphere of `t`, with vertices `v`, contains p.
    #[inline]
    fn in_conflict<P: PointStore>(
        &self,
        points: &P,
        t: TetId,
        v: [VertexId; 4],
        p: VertexId,
    ) -> bool {
        let [a, b, c, d] = v;
        if any_infinite(v) {
            return self.ghost_in_conflict(points, t, v, p);
        }
        points.insphere([a, b, c, d, p]).is_positive()
    }

    #[cold]
    fn ghost_in_conflict<P: PointStore>(
        &self,
        points: &P,
        t: TetId,
        mut v: [VertexId; 4],
        p: VertexId,
    ) -> bool {
        if is_wall(v) {
            return false;
        }
        let ghost = v.iter().position(|v| v.is_infinite());
        let slot = ghost.expect("a ghost has the vertex at infinity");
        v[slot] = p;
        let side = points.orient3d(v);
        if !side.is_zero() {
            return side.is_positive();
        }
        // On the plane of the hull facet: as the finite neighbour, which may be marked already.
        let (marked, v) = self.mesh.unless_marked(self.mesh.neighbor(t.corner(slot)));
        let [a, b, c, d] = v;
        // Where that is in another part, in conflict: so p is left for later.
        marked || is_wall(v) || points.insphere([a, b, c, d, p]).is_positive()
    }

    /// The first half of an insertion: the conflict zone of p, all tetrahedra whose circumsphere contains p, grown from
    /// `start`, one of them, breadth first. Read it with [`Delaunay::conflicts`].
    pub fn find_conflicts<P: PointStore>(&mut self, points: &P, p: VertexId, start: TetId) {
        // As many as tetrahedra: two bits of the ids in the mesh are free for its marks.
        assert!(p.0 < 1 << 30, "fewer than 2^30 vertices");
        self.scratch.conflict.clear();
        self.scratch.boundary.clear();
        self.join_conflicts(start);
        let mut next = 0;
        while let Some(&t) = self.scratch.conflict.get(next) {
            next += 1;
            let (v, twins) = self.mesh.marked(t);
            for slot in 0..4 {
                let outside = twins[slot];
                let n = outside.tet();
                let (marked, vertices) = self.mesh.unless_marked(n);
                if marked {
                    continue;
                }
                if self.in_conflict(points, n, vertices, p) {
                    self.join_conflicts(n);
                } else {
                    let [i, j, k] = FACET[slot];
                    let facet = [v[i], v[j], v[k]];
                    let facet = BoundaryFacet::new(facet, t.corner(slot), outside);
                    self.scratch.boundary.push(facet);
                }
            }
        }
        for &t in &self.scratch.conflict {
            self.mesh.toggle_mark(t);
        }
    }

    /// Adds `t` to the conflict zone.
    #[inline]
    fn join_conflicts(&mut self, t: TetId) {
        self.mesh.prefetch_neighbors(t);
        self.mesh.toggle_mark(t);
        self.scratch.conflict.push(t);
    }
}
