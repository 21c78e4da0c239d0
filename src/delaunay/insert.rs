//! The insertion of one vertex.

use crate::mesh::{Corner, TetId, TetMesh, VertexId};
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
    /// `marks[t]` is 2·stamp if t was found in conflict in insertion `stamp`, 2·stamp + 1 if found not in conflict.
    marks: Vec<u32>,
    stamp: u32,
    /// The conflict zone; removed at the end of the insertion.
    conflict: Vec<TetId>,
    /// The facets of the conflict zone's boundary, as corners of conflicting tetrahedra.
    boundary: Vec<Corner>,
    /// The star of the new vertex.
    created: Vec<TetId>,
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

    /// Whether a tetrahedron is in that conflict zone.
    #[inline]
    pub fn is_in_conflict(&self, t: TetId) -> bool {
        self.scratch.verdict(t) == Some(true)
    }

    /// The facets between that conflict zone and the rest, as corners of tetrahedra in the zone.
    pub fn conflict_boundary(&self) -> &[Corner] {
        &self.scratch.boundary
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

    /// The second half of an insertion: replaces the conflict zone of p, found just before by
    /// [`Delaunay::find_conflicts`], by the star of p.
    pub fn replace_conflicts(&mut self, p: VertexId) {
        self.make_star(p);
        self.glue_star(p);
        self.remove_conflicts();
    }

    /// A tetrahedron in conflict with p: the finite one that contains it, or the ghost beyond whose facet it lies.
    /// The visibility walk cannot cycle in a Delaunay tetrahedralization (Edelsbrunner 1990).
    pub fn locate<P: PointStore>(&self, points: &P, p: VertexId) -> TetId {
        let mesh = &self.mesh;
        let start = self.hint.filter(|&t| mesh.is_alive(t));
        let mut t = start.unwrap_or_else(|| mesh.all().next().expect("the mesh has tetrahedra"));
        if let Some(slot) = mesh.slot_of(t, VertexId::INFINITE) {
            t = mesh.neighbor(t.corner(slot));
        }
        let mut entered = 4;
        'walk: loop {
            let v = mesh.vertices(t);
            for slot in 0..4 {
                if slot == entered {
                    continue;
                }
                let mut moved = v;
                moved[slot] = p;
                if points.orient3d(moved).is_negative() {
                    let across = mesh.twin(t.corner(slot));
                    t = across.tet();
                    entered = across.slot();
                    if mesh.is_ghost(t) {
                        return t;
                    }
                    continue 'walk;
                }
            }
            return t;
        }
    }

    fn in_conflict<P: PointStore>(&self, points: &P, t: TetId, p: VertexId) -> bool {
        let [a, b, c, d] = self.mesh.vertices(t);
        let Some(slot) = self.mesh.slot_of(t, VertexId::INFINITE) else {
            return points.insphere([a, b, c, d, p]).is_positive();
        };
        let mut moved = [a, b, c, d];
        moved[slot] = p;
        let side = points.orient3d(moved);
        if !side.is_zero() {
            return side.is_positive();
        }
        let [a, b, c, d] = self.mesh.vertices(self.mesh.neighbor(t.corner(slot)));
        points.insphere([a, b, c, d, p]).is_positive()
    }

    /// The first half of an insertion: the conflict zone of p, all tetrahedra whose circumsphere contains p, grown from
    /// `start`, one of them. Read it with [`Delaunay::conflicts`].
    pub fn find_conflicts<P: PointStore>(&mut self, points: &P, p: VertexId, start: TetId) {
        self.scratch.begin(self.mesh.capacity());
        self.scratch.mark_conflict(start);
        let mut next = 0;
        while let Some(&t) = self.scratch.conflict.get(next) {
            next += 1;
            for slot in 0..4 {
                let c = t.corner(slot);
                let n = self.mesh.neighbor(c);
                match self.scratch.verdict(n) {
                    Some(true) => {}
                    Some(false) => self.scratch.boundary.push(c),
                    None if self.in_conflict(points, n, p) => self.scratch.mark_conflict(n),
                    None => {
                        self.scratch.mark_clear(n);
                        self.scratch.boundary.push(c);
                    }
                }
            }
        }
    }

    /// One tetrahedron for every boundary facet. The boundary corners, which belong to tetrahedra about to be removed,
    /// are left pointing at the new tetrahedra for [`Delaunay::glue_star`].
    fn make_star(&mut self, p: VertexId) {
        self.scratch.created.clear();
        for &c in &self.scratch.boundary {
            let mut v = self.mesh.vertices(c.tet());
            v[c.slot()] = p;
            let outside = self.mesh.twin(c);
            let star = self.mesh.add(v);
            self.mesh.glue(star.corner(c.slot()), outside);
            self.mesh.set_twin(c, star.corner(c.slot()));
            self.scratch.created.push(star);
        }
    }

    /// Glues the star's tetrahedra to each other: for each edge of the boundary, turn around it through the old
    /// conflict zone, from one boundary facet to the other.
    fn glue_star(&mut self, p: VertexId) {
        for (&c, &star) in self.scratch.boundary.iter().zip(&self.scratch.created) {
            for slot in (0..4).filter(|&slot| slot != c.slot()) {
                let mine = star.corner(slot);
                if self.mesh.twin(mine) != Corner::NONE {
                    continue;
                }
                // The edge is opposite both slots; `apex` is the vertex that the turn leaves behind.
                let mut exit = c.tet().corner(slot);
                let mut behind = self.mesh.vertex(c);
                loop {
                    let across = self.mesh.twin(exit);
                    let ahead = self.mesh.vertex(across);
                    let next = self.mesh.corner_of(across.tet(), behind);
                    if ahead == p {
                        // `exit` is a boundary corner and points at its star tetrahedron.
                        self.mesh.glue(mine, next);
                        break;
                    }
                    exit = next;
                    behind = ahead;
                }
            }
        }
    }

    fn remove_conflicts(&mut self) {
        for &t in &self.scratch.conflict {
            self.mesh.remove(t);
        }
        self.hint = self.scratch.created.last().copied();
    }
}

impl Scratch {
    fn begin(&mut self, capacity: usize) {
        if self.stamp >= u32::MAX / 2 - 1 {
            self.marks.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.marks.resize(capacity.max(self.marks.len()), 0);
        self.conflict.clear();
        self.boundary.clear();
    }

    fn mark_conflict(&mut self, t: TetId) {
        self.marks[t.index()] = 2 * self.stamp;
        self.conflict.push(t);
    }

    fn mark_clear(&mut self, t: TetId) {
        self.marks[t.index()] = 2 * self.stamp + 1;
    }

    /// Whether t is known to be in conflict in this insertion.
    fn verdict(&self, t: TetId) -> Option<bool> {
        let mark = self.marks.get(t.index()).copied().unwrap_or(0);
        (mark >> 1 == self.stamp).then_some(mark & 1 == 0)
    }
}
