//! Polygon insertion by cavity retriangulation (paper §3.1; Si & Gärtner 2005).
//!
//! R is divided by f into a right and a left cavity. For each, the Delaunay tetrahedralization D of its vertices is
//! built; where D lacks a triangle of the cavity's boundary, the cavity swallows the tetrahedron beyond it, until D has
//! them all; the tetrahedra of D inside the cavity take its place. D ignores other polygons, so some of their triangles
//! may vanish; those polygons are reinserted.
//!
//! # The gap, closed
//! The expansion may swallow a vertex on the other side of f, and then D need not expose f any more (Diazzi, Panozzo,
//! Vaxman & Attene 2023). We refuse to ([`Refused::OtherSide`]), and the caller inserts the region by flips in exact
//! order, which always succeed for a flat polygon, and end in the same tetrahedra.
//!
//! # The triangulation of f
//! f's triangles are read off the hull of the right D; the left D must have them. If f is flat they agree, because both
//! are the canonical Delaunay triangulation of f's vertices in its plane. If f is flat only to rounding, the hull of
//! the right D takes all *shim* tetrahedra with it, and where the left D disagrees the two sides are incompatible
//! (paper, Fig. 4).
//!
//! Nothing of the mesh is changed until both triangulations are complete.
//!
//! # Complexity
//! Expected O(n log n) for D, of n vertices, and linear time for the rest: D is searched for the facets of the boundary
//! once (`Boundary`), and after a tetrahedron has been swallowed only for those whose part of D has changed. What is
//! inside is glued as it is in D.

use super::Retriangulation;
use super::boundary::{Boundary, BoundaryFacet, Filled};
use crate::clock::{Task, TaskClock};
use crate::delaunay::{Delaunay, delaunay};
use crate::mesh::{Corner, FACET, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::region::{Region, Side, Sides, corners};
use crate::recover::subpolygons::{Face, face};
use crate::recover::tables::Table;
use rustc_hash::{FxHashMap, FxHashSet};

/// Why cavity retriangulation is not possible here.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Refused {
    /// The cavity would have to swallow a vertex on the other side of f.
    OtherSide,
    /// The cavity would have to grow beyond the convex hull, or into the other cavity.
    NoRoom,
    /// The hull of the right cavity's D does not have f's triangles.
    NotExposed,
    /// The left cavity's D does not have f's triangles.
    Incompatible,
}

/// Memory that is kept from region to region.
#[derive(Clone, Debug, Default)]
pub struct CavityScratch {
    /// Which side has swallowed a tetrahedron.
    swallowed_by: Table<Option<Side>>,
    /// The vertices of D, each with a tetrahedron of D once D has been indexed.
    tet_at: Table<Option<TetId>>,
    /// Which task takes how long, if somebody asks.
    pub(crate) clock: TaskClock,
}

/// Retriangulates the region R of f. `is_subpolygon` tells the triangles of polygons that are in the mesh, if there are
/// any.
///
/// # Errors
/// [`Refused`]; the mesh is not touched in any case.
pub fn retriangulate<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    region: &Region,
    is_subpolygon: Option<&dyn Fn(Face) -> bool>,
    scratch: &mut CavityScratch,
) -> Result<Retriangulation, Refused> {
    scratch.swallowed_by.clear();
    scratch.clock.begin();
    let around = Surroundings {
        mesh,
        sides,
        region,
    };
    let [below, above] = around.boundaries()?;
    let [below_f, on_f, above_f] = around.vertices(scratch);

    let mut filled = Filled::with_capacity(region.tets.len());
    // Only one of the cavities is there at a time: the second one uses the memory of the first one again.
    let (faces, mut swallowed) = {
        let vertices = [below_f.as_slice(), &on_f];
        let mut right = Cavity::new(around, Side::Right, vertices, below, scratch)?;
        let border = right.open_edges();
        right.expand()?;
        right.scratch.clock.end(Task::CavityFaces);
        let (faces, corners) = right.faces_on_hull(&border)?;
        right.scratch.clock.end(Task::PolygonFaces);
        for (&facet, &corner) in faces.iter().zip(&corners) {
            right.boundary.add(BoundaryFacet::of_polygon(facet, corner));
        }
        right.fill(&mut filled)?;
        (faces, right.swallowed)
    };

    let mut above = above;
    let turned = |&[a, b, c]: &[VertexId; 3]| BoundaryFacet::of_polygon([b, a, c], Corner::NONE);
    above.extend(faces.iter().map(turned));
    let vertices = [above_f.as_slice(), &on_f];
    let mut left = Cavity::new(around, Side::Left, vertices, above, scratch)?;
    left.expand()?;
    left.scratch.clock.end(Task::CavityFaces);
    if !left.has_polygon() {
        return Err(Refused::Incompatible);
    }
    left.fill(&mut filled)?;
    swallowed.append(&mut left.swallowed);

    let mut old = region.tets.clone();
    old.extend(&swallowed);
    old.sort_unstable();
    let is_old = |t: TetId| region.contains(t) || scratch.swallowed_by.get(t.index()).is_some();
    let (new, gluing) = filled.join(&is_old).ok_or(Refused::NotExposed)?;
    let displaced = is_subpolygon.map_or_else(Vec::new, |is_subpolygon| {
        vanishing(around, &old, &new, &is_old, is_subpolygon)
    });
    scratch.clock.end(Task::Merging);
    Ok(Retriangulation {
        old,
        new,
        gluing: Some(gluing),
        faces,
        displaced,
        swallowed: swallowed.len(),
    })
}

/// The triangles of polygons between two of the `old` tetrahedra that the `new` ones do not have. Crossing triangles
/// are known to be of no polygon.
fn vanishing<P: PointStore>(
    around: Surroundings<P>,
    old: &[TetId],
    new: &[[VertexId; 4]],
    is_old: &dyn Fn(TetId) -> bool,
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Vec<Face> {
    let mesh = around.mesh;
    let mut polygons: Vec<Face> = Vec::new();
    for &t in old {
        let crossing = around.sides.crossing_facets(&mesh.vertices(t));
        let others = corners(t, !crossing & 0b1111);
        let inner = others.filter(|&c| c < mesh.twin(c) && is_old(mesh.neighbor(c)));
        let facets = inner.map(|c| face(mesh.facet(c)));
        polygons.extend(facets.filter(|&f| is_subpolygon(f)));
    }
    if polygons.is_empty() {
        return polygons;
    }
    let kept: FxHashSet<Face> = new
        .iter()
        .flat_map(|&[a, b, c, d]| [[b, c, d], [a, c, d], [a, b, d], [a, b, c]])
        .map(face)
        .collect();
    polygons.into_iter().filter(|f| !kept.contains(f)).collect()
}

/// Where a cavity is.
struct Surroundings<'a, P> {
    mesh: &'a TetMesh,
    sides: &'a Sides<'a, P>,
    region: &'a Region,
}

impl<P> Clone for Surroundings<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Surroundings<'_, P> {}

impl<P: PointStore> Surroundings<'_, P> {
    /// The facets of R's boundary on the right and on the left side of f: oriented outwards, with the corner outside of
    /// each.
    fn boundaries(&self) -> Result<[Vec<BoundaryFacet>; 2], Refused> {
        let expected = self.region.tets.len() / 2;
        let mut boundaries = [Vec::with_capacity(expected), Vec::with_capacity(expected)];
        for &t in &self.region.tets {
            let (vertices, twins) = self.mesh.tet(t);
            let [left, right] = self.sides.left_and_right(vertices);
            for (slot, &twin) in twins.iter().enumerate() {
                if self.region.contains(twin.tet()) {
                    continue;
                }
                let others = !(1 << slot);
                if (left | right) & others == 0 {
                    // A triangle on f already, though f is missing here: f is not flat, and would be covered twice.
                    return Err(Refused::NotExposed);
                }
                let [i, j, k] = FACET[slot];
                let triangle = BoundaryFacet::new([vertices[i], vertices[j], vertices[k]], twin);
                if right & others != 0 {
                    boundaries[0].push(triangle);
                }
                if left & others != 0 {
                    boundaries[1].push(triangle);
                }
            }
        }
        Ok(boundaries)
    }

    /// The vertices of R that are right of f, on f, and left of it.
    fn vertices(&self, scratch: &mut CavityScratch) -> [Vec<VertexId>; 3] {
        let seen = &mut scratch.tet_at;
        seen.clear();
        let (mut right, mut on, mut left) = (Vec::new(), Vec::new(), Vec::new());
        for &t in &self.region.tets {
            for &v in self.mesh.tet(t).0 {
                if seen.get(v.index()).is_none() {
                    seen.set(v.index(), Some(NOT_INDEXED));
                    match self.sides.of(v) {
                        Side::Right => right.push(v),
                        Side::On => on.push(v),
                        Side::Left => left.push(v),
                        Side::Stray | Side::Infinite => {}
                    }
                }
            }
        }
        [right, on, left]
    }
}

/// One of the two cavities.
struct Cavity<'a, P> {
    around: Surroundings<'a, P>,
    side: Side,
    /// The boundary, and where it is in D.
    boundary: Boundary,
    /// The Delaunay tetrahedralization D of the cavity's vertices.
    d: Delaunay,
    is_indexed: bool,
    scratch: &'a mut CavityScratch,
    swallowed: Vec<TetId>,
}

impl<'a, P: PointStore> Cavity<'a, P> {
    /// The part of R on one side of f, and D. `vertices` are those there and on f, `boundary` is that of R there, and
    /// the triangles of f if they are known.
    fn new(
        around: Surroundings<'a, P>,
        side: Side,
        vertices: [&[VertexId]; 2],
        boundary: Vec<BoundaryFacet>,
        scratch: &'a mut CavityScratch,
    ) -> Result<Self, Refused> {
        scratch.tet_at.clear();
        let mut vertices = vertices.concat();
        for v in &vertices {
            scratch.tet_at.set(v.index(), Some(NOT_INDEXED));
        }
        vertices.sort_unstable();
        scratch.clock.end(Task::CavityFaces);
        let d = delaunay(around.sides.points(), &vertices).map_err(|_| Refused::NotExposed)?;
        scratch.clock.end(Task::CavityDelaunay);
        let mut boundary = Boundary::new(boundary);
        boundary.find_all(&d.mesh);
        Ok(Cavity {
            around,
            side,
            boundary,
            d,
            is_indexed: false,
            scratch,
            swallowed: Vec::new(),
        })
    }

    /// The edges that f must close: f's boundary in this region, each directed so that f, seen as part of the cavity's
    /// outward oriented boundary, has it. A facet that is not part of the cavity's boundary is on the other side, so
    /// that neither end of its edge is on this one.
    fn open_edges(&self) -> Vec<[VertexId; 2]> {
        let on_this_side = |&v: &VertexId| self.around.sides.of(v) == self.side;
        let facets = self.boundary.current().map(|triangle| triangle.facet);
        let directed = facets.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        let edges: Vec<[VertexId; 2]> = directed.filter(|e| !e.iter().any(on_this_side)).collect();
        let all: FxHashSet<[VertexId; 2]> = edges.iter().copied().collect();
        let edges = edges.into_iter().map(|[a, b]| [b, a]);
        edges.filter(|e| !all.contains(e)).collect()
    }

    /// Adds the tetrahedra of D inside.
    fn fill(&mut self, filled: &mut Filled) -> Result<(), Refused> {
        let filling = self.boundary.fill(&self.d.mesh, filled);
        self.scratch.clock.end(Task::Merging);
        filling.ok_or(Refused::NotExposed)
    }

    /// Swallows tetrahedra until every boundary facet is in D.
    fn expand(&mut self) -> Result<(), Refused> {
        let mut missing = self.boundary.missing();
        while !missing.is_empty() {
            self.index();
            // Boundary triangles that D may have or not: new ones, and those whose tetrahedron has gone from D.
            let mut unknown = Vec::new();
            for outside in missing {
                self.swallow(outside.tet(), &mut unknown)?;
            }
            let tet_at = |v: VertexId| self.scratch.tet_at.get(v.index());
            missing = self.boundary.find_again(&unknown, &self.d.mesh, &tet_at);
        }
        Ok(())
    }

    /// Swallows one tetrahedron, unless that has been done.
    fn swallow(&mut self, t: TetId, unknown: &mut Vec<u32>) -> Result<(), Refused> {
        let Surroundings {
            mesh,
            sides,
            region,
        } = self.around;
        let swallowed_by = self.scratch.swallowed_by.get(t.index());
        if swallowed_by == Some(self.side) {
            return Ok(());
        }
        if mesh.is_ghost(t) || region.contains(t) || swallowed_by.is_some() {
            return Err(Refused::NoRoom);
        }
        let is_other = |&v: &VertexId| ![self.side, Side::On, Side::Stray].contains(&sides.of(v));
        if mesh.vertices(t).iter().any(is_other) {
            return Err(Refused::OtherSide);
        }
        self.scratch.swallowed_by.set(t.index(), Some(self.side));
        self.swallowed.push(t);
        for c in (0..4).map(|slot| t.corner(slot)) {
            let facet = mesh.facet(c);
            match self.boundary.find(face(facet)) {
                Some(triangle) => self.boundary.remove(triangle),
                None => unknown.push(self.boundary.add(BoundaryFacet::new(facet, mesh.twin(c)))),
            }
        }
        for v in mesh.vertices(t) {
            if self.scratch.tet_at.get(v.index()).is_none() {
                self.insert(v, unknown);
            }
        }
        Ok(())
    }

    /// Inserts a vertex into D.
    fn insert(&mut self, v: VertexId, unknown: &mut Vec<u32>) {
        let points = self.around.sides.points();
        let start = self.d.locate(points, v);
        self.d.find_conflicts(points, v, start);
        for &t in self.d.conflicts() {
            for c in (0..4).map(|slot| t.corner(slot)) {
                if let Some(triangle) = self.boundary.find(face(self.d.mesh.facet(c))) {
                    self.boundary.lose(triangle);
                    unknown.push(triangle);
                }
            }
        }
        self.d.replace_conflicts(v);
        for &t in self.d.created() {
            note_vertices(&mut self.scratch.tet_at, &self.d.mesh, t);
        }
    }

    /// Notes a tetrahedron of D at each of its vertices.
    fn index(&mut self) {
        if !std::mem::replace(&mut self.is_indexed, true) {
            for t in self.d.mesh.finite() {
                note_vertices(&mut self.scratch.tet_at, &self.d.mesh, t);
            }
        }
    }

    /// Whether D has all triangles of f, with a tetrahedron on their inner side.
    fn has_polygon(&self) -> bool {
        let mut of_polygon = self
            .boundary
            .current()
            .filter(|triangle| triangle.is_of_polygon());
        of_polygon.all(|triangle| triangle.has_inside(&self.d.mesh))
    }

    /// The triangles of f: the facets on the hull of D that `border` encloses, oriented outwards, with the corners on
    /// their inner sides.
    fn faces_on_hull(
        &self,
        border: &[[VertexId; 2]],
    ) -> Result<(Vec<[VertexId; 3]>, Vec<Corner>), Refused> {
        let mesh = &self.d.mesh;
        let mut across: FxHashMap<[VertexId; 2], (Corner, VertexId)> = FxHashMap::default();
        for t in mesh.all() {
            if let Some(slot) = mesh.slot_of(t, VertexId::INFINITE) {
                let inner = mesh.twin(t.corner(slot));
                let [a, b, c] = mesh.facet(inner);
                if [a, b, c]
                    .iter()
                    .all(|&v| self.around.sides.of(v) == Side::On)
                {
                    for (edge, apex) in [([a, b], c), ([b, c], a), ([c, a], b)] {
                        across.insert(edge, (inner, apex));
                    }
                }
            }
        }
        let closed_by_border: FxHashSet<[VertexId; 2]> = border.iter().copied().collect();
        let mut corners = Vec::new();
        let mut open: Vec<[VertexId; 2]> = border.to_vec();
        let mut closed: FxHashSet<[VertexId; 2]> = FxHashSet::default();
        while let Some([a, b]) = open.pop() {
            if !closed.insert([a, b]) {
                continue;
            }
            let &(inner, v) = across.get(&[a, b]).ok_or(Refused::NotExposed)?;
            corners.push(inner);
            for [p, q] in [[b, v], [v, a]] {
                closed.insert([p, q]);
                if !closed_by_border.contains(&[p, q]) {
                    open.push([q, p]);
                }
            }
        }
        let faces = corners.iter().map(|&c| mesh.facet(c)).collect();
        Ok((faces, corners))
    }
}

/// Stands for a tetrahedron of D at a vertex of D before they are known.
const NOT_INDEXED: TetId = TetId(u32::MAX);

fn note_vertices(tet_at: &mut Table<Option<TetId>>, mesh: &TetMesh, t: TetId) {
    for v in mesh.vertices(t).into_iter().filter(|v| !v.is_infinite()) {
        tet_at.set(v.index(), Some(t));
    }
}
