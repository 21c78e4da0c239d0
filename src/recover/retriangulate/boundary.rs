//! The boundary of a cavity, the *walls*, found in the Delaunay tetrahedralization D of the cavity's vertices, and what
//! they enclose.
//!
//! A wall is known by its vertices, by the corner of the mesh outside, and, once found, by the corner of D inside of
//! it. So the tetrahedra of D that the walls enclose are flooded from the walls, each walled facet is recognised by a
//! bit of its tetrahedron, and the enclosed tetrahedra can be glued to each other as they are in D, and to what is
//! outside: nothing is looked up by its vertices but the walls.
//!
//! Complexity: linear in the sizes of the boundary and of D; [`Walls::find_again`] in the degrees of the vertices.

use super::Gluing;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::recover::subpolygons::{Face, face};
use rustc_hash::{FxHashMap, FxHashSet};

/// A triangle of a cavity's boundary.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    /// Oriented outwards.
    pub facet: [VertexId; 3],
    /// The corner of the mesh outside; none for a triangle of f.
    outside: Corner,
    /// The corner of D that sees `facet`, in the tetrahedron on its inner side, or none where D lacks the triangle.
    inside: Corner,
    is_removed: bool,
}

impl Wall {
    /// A facet of the mesh that is to be looked for in D.
    pub fn new(facet: [VertexId; 3], outside: Corner) -> Wall {
        Wall {
            facet,
            outside,
            inside: Corner::NONE,
            is_removed: false,
        }
    }

    /// A triangle of f, with its corner in D if that is known.
    pub fn of_polygon(facet: [VertexId; 3], inside: Corner) -> Wall {
        Wall {
            inside,
            ..Wall::new(facet, Corner::NONE)
        }
    }

    /// Whether this is a triangle of f.
    pub fn is_of_polygon(&self) -> bool {
        self.outside == Corner::NONE
    }

    /// Whether there is a tetrahedron of D on its inner side.
    pub fn has_inside(&self, d: &TetMesh) -> bool {
        self.inside != Corner::NONE && !d.is_ghost(self.inside.tet())
    }

    /// Notes the corner of D that sees the same triangle, or the opposite one.
    fn found(&mut self, d: &TetMesh, c: Corner) {
        let [a, b, p] = self.facet;
        let seen = d.facet(c);
        let is_inside = [[a, b, p], [b, p, a], [p, a, b]].contains(&seen);
        self.inside = if is_inside { c } else { d.twin(c) };
    }
}

/// The walls of one cavity.
#[derive(Clone, Debug, Default)]
pub struct Walls {
    /// In order of discovery.
    list: Vec<Wall>,
    /// Those that have not been removed.
    by_face: FxHashMap<Face, u32>,
}

impl Walls {
    /// The given walls.
    pub fn new(list: Vec<Wall>) -> Walls {
        let faces = list.iter().map(|wall| face(wall.facet));
        Walls {
            by_face: faces.zip(0..).collect(),
            list,
        }
    }

    /// The wall with the given vertices.
    #[inline]
    pub fn find(&self, face: Face) -> Option<u32> {
        self.by_face.get(&face).copied()
    }

    /// One more wall.
    pub fn add(&mut self, wall: Wall) -> u32 {
        let i = u32::try_from(self.list.len()).expect("fewer than 2^32 facets");
        self.list.push(wall);
        self.by_face.insert(face(wall.facet), i);
        i
    }

    /// Removes a wall.
    pub fn remove(&mut self, wall: u32) {
        let wall = &mut self.list[wall as usize];
        wall.is_removed = true;
        self.by_face.remove(&face(wall.facet));
    }

    /// Forgets where a wall is in D.
    pub fn lose(&mut self, wall: u32) {
        self.list[wall as usize].inside = Corner::NONE;
    }

    /// All walls.
    pub fn current(&self) -> impl Iterator<Item = &Wall> {
        self.list.iter().filter(|wall| !wall.is_removed)
    }

    /// Looks for all walls in D, by one look at each of D's facets.
    pub fn find_all(&mut self, d: &TetMesh) {
        for t in d.all() {
            for c in (0..4).map(|slot| t.corner(slot)) {
                if c < d.twin(c)
                    && let Some(wall) = self.find(face(d.facet(c)))
                {
                    self.list[wall as usize].found(d, c);
                }
            }
        }
    }

    /// The corners outside of the walls that D lacks, those of f left out.
    pub fn missing(&self) -> Vec<Corner> {
        let missing = self.current().filter(|wall| wall.inside == Corner::NONE);
        let outside = missing.map(|wall| wall.outside);
        outside.filter(|&c| c != Corner::NONE).collect()
    }

    /// Looks for some walls in D around their vertices, and returns the corners outside of those that D lacks. `tet_at`
    /// knows a tetrahedron of D at each vertex.
    pub fn find_again(
        &mut self,
        unknown: &[u32],
        d: &TetMesh,
        tet_at: &dyn Fn(VertexId) -> Option<TetId>,
    ) -> Vec<Corner> {
        let mut unknown = unknown.to_vec();
        unknown.sort_unstable();
        unknown.dedup();
        let mut missing = Vec::new();
        for i in unknown {
            let wall = &mut self.list[i as usize];
            if wall.is_removed {
                continue;
            }
            match corner_with(d, wall.facet, tet_at) {
                Some(c) => wall.found(d, c),
                None if !wall.is_of_polygon() => missing.push(wall.outside),
                None => {}
            }
        }
        missing
    }

    /// Adds the tetrahedra of D that the walls enclose: those reached from their inner sides. `None` if the walls are
    /// not all in D, or do not enclose anything.
    pub fn fill(&self, d: &TetMesh, filled: &mut Filled) -> Option<()> {
        let mut walled = vec![0u8; d.capacity()];
        for wall in self.current() {
            if !wall.has_inside(d) {
                return None;
            }
            for c in [wall.inside, d.twin(wall.inside)] {
                walled[c.tet().index()] |= 1 << c.slot();
            }
        }
        // 1 + the number of each enclosed tetrahedron.
        let mut number = vec![0u32; d.capacity()];
        let mut inside: Vec<TetId> = Vec::with_capacity(d.len());
        let first = filled.tets.len() as u32;
        let mut enter = |t: TetId, inside: &mut Vec<TetId>| {
            let number = &mut number[t.index()];
            if *number == 0 {
                inside.push(t);
                *number = first + inside.len() as u32;
            }
            TetId(*number - 1)
        };
        for wall in self.current() {
            enter(wall.inside.tet(), &mut inside);
        }
        let mut next = 0;
        while let Some(&t) = inside.get(next) {
            let (&vertices, twins) = d.tet(t);
            let mut across = [Corner::NONE; 4];
            for (slot, across) in across.iter_mut().enumerate() {
                if walled[t.index()] >> slot & 1 == 0 {
                    let twin = twins[slot];
                    if d.is_ghost(twin.tet()) {
                        return None;
                    }
                    *across = enter(twin.tet(), &mut inside).corner(twin.slot());
                }
            }
            filled.tets.push(vertices);
            filled.across.push(across);
            next += 1;
        }
        for wall in self.current() {
            if number[d.neighbor(wall.inside).index()] != 0 {
                return None;
            }
            let t = TetId(number[wall.inside.tet().index()] - 1);
            let inside = t.corner(wall.inside.slot());
            filled.walls.push((inside, wall.outside, face(wall.facet)));
        }
        Some(())
    }
}

/// A corner of D that sees a triangle, by a search of the stars of its vertices in turn: time linear in the size of the
/// smallest one.
fn corner_with(
    d: &TetMesh,
    facet: [VertexId; 3],
    tet_at: &dyn Fn(VertexId) -> Option<TetId>,
) -> Option<Corner> {
    let mut stars = facet.map(|v| {
        let found: Vec<TetId> = tet_at(v).into_iter().collect();
        let seen: FxHashSet<TetId> = found.iter().copied().collect();
        (v, found, seen)
    });
    for next in 0.. {
        for (v, found, seen) in &mut stars {
            let &t = found.get(next)?;
            if d.has_vertices(t, &facet) {
                let opposite = d.vertices(t).iter().position(|v| !facet.contains(v));
                return Some(t.corner(opposite.expect("four vertices")));
            }
            for c in (0..4).map(|slot| t.corner(slot)) {
                if d.vertex(c) != *v && seen.insert(d.neighbor(c)) {
                    found.push(d.neighbor(c));
                }
            }
        }
    }
    None
}

/// The tetrahedra that fill two cavities.
#[derive(Clone, Debug)]
pub struct Filled {
    tets: Vec<[VertexId; 4]>,
    /// What is across their facets, by index instead of id; none at walls.
    across: Vec<[Corner; 4]>,
    /// The walled corners, by index instead of id, what is outside, and the triangles.
    walls: Vec<(Corner, Corner, Face)>,
}

impl Filled {
    /// None yet, but room for so many.
    pub fn with_capacity(tets: usize) -> Filled {
        Filled {
            tets: Vec::with_capacity(tets),
            across: Vec::with_capacity(tets),
            walls: Vec::with_capacity(tets),
        }
    }

    /// The tetrahedra of both cavities, and what is across their facets: triangles of f, and others beyond which there
    /// are old tetrahedra, must be common to both, or `None` is returned.
    pub fn join(mut self, is_old: &dyn Fn(TetId) -> bool) -> Option<(Vec<[VertexId; 4]>, Gluing)> {
        let mut outside = Vec::with_capacity(self.walls.len());
        let mut open: FxHashMap<Face, Corner> = FxHashMap::default();
        for (c, old, face) in self.walls {
            if old != Corner::NONE && !is_old(old.tet()) {
                outside.push((c, old));
                continue;
            }
            match open.remove(&face) {
                Some(d) => {
                    self.across[c.tet().index()][c.slot()] = d;
                    self.across[d.tet().index()][d.slot()] = c;
                }
                None => {
                    open.insert(face, c);
                }
            }
        }
        let gluing = Gluing {
            across: self.across,
            outside,
        };
        open.is_empty().then_some((self.tets, gluing))
    }
}
