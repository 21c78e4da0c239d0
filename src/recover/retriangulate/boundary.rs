//! The boundary of a cavity, found in the Delaunay tetrahedralization D of the cavity's vertices, and what it encloses.
//!
//! A triangle of the boundary is known by its vertices, by the corner of the mesh outside, and, once found, by the
//! corner of D inside of it. So the tetrahedra of D that the boundary encloses are flooded from it, each facet on it is
//! recognised by a bit of its tetrahedron, and the enclosed tetrahedra can be glued to each other as they are in D, and
//! to what is outside: nothing is looked up by its vertices but the boundary.
//!
//! Complexity: linear in the sizes of the boundary and of D; [`Boundary::find_again`] in the degrees of the vertices.

use super::Gluing;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::recover::subpolygons::{Face, face};
use rustc_hash::{FxHashMap, FxHashSet};

/// A triangle of a cavity's boundary.
#[derive(Clone, Copy, Debug)]
pub struct BoundaryFacet {
    /// Oriented outwards.
    pub facet: [VertexId; 3],
    /// The corner of the mesh outside; none for a triangle of f.
    outside: Corner,
    /// The corner of D that sees `facet`, in the tetrahedron on its inner side, or none where D lacks the triangle.
    inside: Corner,
    is_removed: bool,
}

impl BoundaryFacet {
    /// A facet of the mesh that is to be looked for in D.
    pub fn new(facet: [VertexId; 3], outside: Corner) -> BoundaryFacet {
        BoundaryFacet {
            facet,
            outside,
            inside: Corner::NONE,
            is_removed: false,
        }
    }

    /// A triangle of f, with its corner in D if that is known.
    pub fn of_polygon(facet: [VertexId; 3], inside: Corner) -> BoundaryFacet {
        BoundaryFacet {
            inside,
            ..BoundaryFacet::new(facet, Corner::NONE)
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

/// The triangles of one cavity.
#[derive(Clone, Debug, Default)]
pub struct Boundary {
    /// In order of discovery.
    list: Vec<BoundaryFacet>,
    /// Those that have not been removed.
    by_face: FxHashMap<Face, u32>,
}

impl Boundary {
    /// The given triangles.
    pub fn new(list: Vec<BoundaryFacet>) -> Boundary {
        let faces = list.iter().map(|triangle| face(triangle.facet));
        Boundary {
            by_face: faces.zip(0..).collect(),
            list,
        }
    }

    /// The triangle with the given vertices.
    #[inline]
    pub fn find(&self, face: Face) -> Option<u32> {
        self.by_face.get(&face).copied()
    }

    /// One more triangle.
    pub fn add(&mut self, triangle: BoundaryFacet) -> u32 {
        let i = u32::try_from(self.list.len()).expect("fewer than 2^32 facets");
        self.list.push(triangle);
        self.by_face.insert(face(triangle.facet), i);
        i
    }

    /// Removes a triangle.
    pub fn remove(&mut self, triangle: u32) {
        let triangle = &mut self.list[triangle as usize];
        triangle.is_removed = true;
        self.by_face.remove(&face(triangle.facet));
    }

    /// Forgets where a triangle is in D.
    pub fn lose(&mut self, triangle: u32) {
        self.list[triangle as usize].inside = Corner::NONE;
    }

    /// All triangles.
    pub fn current(&self) -> impl Iterator<Item = &BoundaryFacet> {
        self.list.iter().filter(|triangle| !triangle.is_removed)
    }

    /// Looks for all triangles in D, by one look at each of D's facets.
    pub fn find_all(&mut self, d: &TetMesh) {
        for t in d.all() {
            for c in (0..4).map(|slot| t.corner(slot)) {
                if c < d.twin(c)
                    && let Some(triangle) = self.find(face(d.facet(c)))
                {
                    self.list[triangle as usize].found(d, c);
                }
            }
        }
    }

    /// The corners outside of the triangles that D lacks, those of f left out.
    pub fn missing(&self) -> Vec<Corner> {
        let missing = self
            .current()
            .filter(|triangle| triangle.inside == Corner::NONE);
        let outside = missing.map(|triangle| triangle.outside);
        outside.filter(|&c| c != Corner::NONE).collect()
    }

    /// Looks for some triangles in D around their vertices, and returns the corners outside of those that D lacks.
    /// `tet_at` knows a tetrahedron of D at each vertex.
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
            let triangle = &mut self.list[i as usize];
            if triangle.is_removed {
                continue;
            }
            match corner_with(d, triangle.facet, tet_at) {
                Some(c) => triangle.found(d, c),
                None if !triangle.is_of_polygon() => missing.push(triangle.outside),
                None => {}
            }
        }
        missing
    }

    /// Adds the tetrahedra of D that the boundary encloses: those reached from its inner side. `None` if its triangles
    /// are not all in D, or do not enclose anything.
    pub fn fill(&self, d: &TetMesh, filled: &mut Filled) -> Option<()> {
        let mut bounds = vec![0u8; d.capacity()];
        for triangle in self.current() {
            if !triangle.has_inside(d) {
                return None;
            }
            for c in [triangle.inside, d.twin(triangle.inside)] {
                bounds[c.tet().index()] |= 1 << c.slot();
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
        for triangle in self.current() {
            enter(triangle.inside.tet(), &mut inside);
        }
        let mut next = 0;
        while let Some(&t) = inside.get(next) {
            let (&vertices, twins) = d.tet(t);
            let mut across = [Corner::NONE; 4];
            for (slot, across) in across.iter_mut().enumerate() {
                if bounds[t.index()] >> slot & 1 == 0 {
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
        for triangle in self.current() {
            if number[d.neighbor(triangle.inside).index()] != 0 {
                return None;
            }
            let t = TetId(number[triangle.inside.tet().index()] - 1);
            let inside = t.corner(triangle.inside.slot());
            filled
                .boundary
                .push((inside, triangle.outside, face(triangle.facet)));
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
    /// What is across their facets, by index instead of id; none at the boundary.
    across: Vec<[Corner; 4]>,
    /// The corners on the boundary, by index instead of id, what is outside, and the triangles.
    boundary: Vec<(Corner, Corner, Face)>,
}

impl Filled {
    /// None yet, but room for so many.
    pub fn with_capacity(tets: usize) -> Filled {
        Filled {
            tets: Vec::with_capacity(tets),
            across: Vec::with_capacity(tets),
            boundary: Vec::with_capacity(tets),
        }
    }

    /// The tetrahedra of both cavities, and what is across their facets: triangles of f, and others beyond which there
    /// are old tetrahedra, must be common to both, or `None` is returned.
    pub fn join(mut self, is_old: &dyn Fn(TetId) -> bool) -> Option<(Vec<[VertexId; 4]>, Gluing)> {
        let mut outside = Vec::with_capacity(self.boundary.len());
        let mut open: FxHashMap<Face, Corner> = FxHashMap::default();
        for (c, old, face) in self.boundary {
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
