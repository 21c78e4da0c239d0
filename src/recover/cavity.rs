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
//! are the canonical Delaunay triangulation of f's vertices in its plane. If f is flat only to rounding, the hull of the
//! right D takes all *shim* tetrahedra with it, and where the left D disagrees the two sides are incompatible
//! (paper, Fig. 4).
//!
//! Nothing of the mesh is changed until both triangulations are complete.

use super::region::Region;
use super::side::{Side, Sides};
use crate::delaunay::{Delaunay, delaunay};
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use rustc_hash::{FxHashMap, FxHashSet};

/// The vertices of a triangle in ascending order.
pub type Face = [VertexId; 3];

/// A triangle's vertices in ascending order.
pub fn face(mut facet: [VertexId; 3]) -> Face {
    facet.sort_unstable();
    facet
}

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
    /// Triangles of other polygons would vanish, and the caller did not allow it.
    Displaces,
}

/// A retriangulation of R and of what the cavities swallowed, ready to be grafted.
#[derive(Clone, Debug)]
pub struct Retriangulation {
    /// The tetrahedra to remove, sorted.
    pub old: Vec<TetId>,
    /// The tetrahedra that take their place.
    pub new: Vec<[VertexId; 4]>,
    /// The triangles of f.
    pub faces: Vec<[VertexId; 3]>,
    /// The triangles of other polygons that vanish.
    pub displaced: Vec<Face>,
    /// How many tetrahedra the cavities swallowed.
    pub swallowed: usize,
}

/// Retriangulates the region R of f. `is_subpolygon` tells the triangles of polygons that are in the mesh.
///
/// # Errors
/// [`Refused`]; the mesh is not touched in any case.
pub fn retriangulate<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    region: &Region,
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Result<Retriangulation, Refused> {
    let mut right = Cavity::new(mesh, sides, region, Side::Right)?;
    let border = right.open_edges();
    right.expand(mesh, sides, region, Side::Left, &[])?;
    let faces = right.faces_on_hull(sides, &border)?;
    let below = right.inside(&faces)?;

    let mut left = Cavity::new(mesh, sides, region, Side::Left)?;
    left.expand(mesh, sides, region, Side::Right, &right.swallowed)?;
    let turned: Vec<[VertexId; 3]> = faces.iter().map(|&[a, b, c]| [b, a, c]).collect();
    if turned.iter().any(|&f| left.corner_of(f).is_none()) {
        return Err(Refused::Incompatible);
    }
    let above = left.inside(&turned)?;

    let mut old = region.tets.clone();
    old.extend(right.swallowed.iter().chain(&left.swallowed));
    old.sort_unstable();
    let new = [below, above].concat();
    let displaced = vanishing(mesh, &old, &new, is_subpolygon);
    Ok(Retriangulation {
        old,
        new,
        faces,
        displaced,
        swallowed: right.swallowed.len() + left.swallowed.len(),
    })
}

/// The triangles of polygons between two of the `old` tetrahedra that the `new` ones do not have.
fn vanishing(
    mesh: &TetMesh,
    old: &[TetId],
    new: &[[VertexId; 4]],
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Vec<Face> {
    let corners = old
        .iter()
        .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
    let inner =
        corners.filter(|&c| c < mesh.twin(c) && old.binary_search(&mesh.neighbor(c)).is_ok());
    let polygons: Vec<Face> = inner
        .map(|c| face(mesh.facet(c)))
        .filter(|&f| is_subpolygon(f))
        .collect();
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

/// One of the two cavities.
struct Cavity {
    /// The boundary facets without f, in order of discovery: oriented outwards, with the corner outside of each.
    boundary: Vec<([VertexId; 3], Corner)>,
    /// Their faces. A facet of `boundary` that is no longer here has been swallowed.
    faces: FxHashSet<Face>,
    /// The Delaunay tetrahedralization D of the cavity's vertices.
    d: Delaunay,
    vertices: FxHashSet<VertexId>,
    /// The facets of D, each by one of its two corners.
    facets: FxHashMap<Face, Corner>,
    swallowed: Vec<TetId>,
}

impl Cavity {
    /// The part of R on one side of f, and D.
    fn new<P: PointStore>(
        mesh: &TetMesh,
        sides: &Sides<P>,
        region: &Region,
        side: Side,
    ) -> Result<Cavity, Refused> {
        let boundary: Vec<([VertexId; 3], Corner)> = region
            .boundary(mesh)
            .into_iter()
            .map(|c| (mesh.facet(c), mesh.twin(c)))
            .filter(|(facet, _)| facet.iter().any(|&v| sides.of(v) == side))
            .collect();
        let mut vertices: Vec<VertexId> =
            region.tets.iter().flat_map(|&t| mesh.vertices(t)).collect();
        vertices.retain(|&v| sides.of(v) == side || sides.of(v) == Side::On);
        vertices.sort_unstable();
        vertices.dedup();
        let d = delaunay(sides.points(), &vertices).map_err(|_| Refused::NotExposed)?;
        let mut cavity = Cavity {
            faces: boundary.iter().map(|&(facet, _)| face(facet)).collect(),
            boundary,
            d,
            vertices: vertices.into_iter().collect(),
            facets: FxHashMap::default(),
            swallowed: Vec::new(),
        };
        cavity.index_facets();
        Ok(cavity)
    }

    fn index_facets(&mut self) {
        self.facets.clear();
        for t in self.d.mesh.finite() {
            for slot in 0..4 {
                let c = t.corner(slot);
                self.facets.insert(face(self.d.mesh.facet(c)), c);
            }
        }
    }

    /// The edges that f must close: f's boundary in this region, each directed so that f, seen as part of the cavity's
    /// outward oriented boundary, has it.
    fn open_edges(&self) -> Vec<[VertexId; 2]> {
        let directed = |&([a, b, c], _): &([VertexId; 3], Corner)| [[a, b], [b, c], [c, a]];
        let all: FxHashSet<[VertexId; 2]> = self.boundary.iter().flat_map(directed).collect();
        let edges = self.boundary.iter().flat_map(directed);
        edges
            .map(|[a, b]| [b, a])
            .filter(|e| !all.contains(e))
            .collect()
    }

    /// Swallows tetrahedra until every boundary facet is in D.
    fn expand<P: PointStore>(
        &mut self,
        mesh: &TetMesh,
        sides: &Sides<P>,
        region: &Region,
        other: Side,
        taken: &[TetId],
    ) -> Result<(), Refused> {
        loop {
            let current = self
                .boundary
                .iter()
                .filter(|(facet, _)| self.faces.contains(&face(*facet)));
            let missing: Vec<Corner> = current
                .filter(|(facet, _)| !self.facets.contains_key(&face(*facet)))
                .map(|&(_, c)| c)
                .collect();
            if missing.is_empty() {
                return Ok(());
            }
            for outside in missing {
                let t = outside.tet();
                if self.swallowed.contains(&t) {
                    continue;
                }
                if mesh.is_ghost(t) || region.contains(t) || taken.contains(&t) {
                    return Err(Refused::NoRoom);
                }
                if mesh.vertices(t).iter().any(|&v| sides.of(v) == other) {
                    return Err(Refused::OtherSide);
                }
                self.swallow(mesh, sides.points(), t);
            }
            self.index_facets();
            self.boundary
                .retain(|(facet, _)| self.faces.contains(&face(*facet)));
        }
    }

    fn swallow<P: PointStore>(&mut self, mesh: &TetMesh, points: &P, t: TetId) {
        self.swallowed.push(t);
        for slot in 0..4 {
            let c = t.corner(slot);
            let key = face(mesh.facet(c));
            if !self.faces.remove(&key) {
                self.faces.insert(key);
                self.boundary.push((mesh.facet(c), mesh.twin(c)));
            }
        }
        for v in mesh.vertices(t) {
            if self.vertices.insert(v) {
                self.d.insert(points, v);
            }
        }
    }

    /// The triangles of f: the facets on the hull of D that `border` encloses, oriented outwards.
    fn faces_on_hull<P: PointStore>(
        &self,
        sides: &Sides<P>,
        border: &[[VertexId; 2]],
    ) -> Result<Vec<[VertexId; 3]>, Refused> {
        let mesh = &self.d.mesh;
        let mut across: FxHashMap<[VertexId; 2], ([VertexId; 3], VertexId)> = FxHashMap::default();
        for t in mesh.all() {
            if let Some(slot) = mesh.slot_of(t, VertexId::INFINITE) {
                let [a, b, c] = mesh.facet(mesh.twin(t.corner(slot)));
                for (edge, apex) in [([a, b], c), ([b, c], a), ([c, a], b)] {
                    across.insert(edge, ([a, b, c], apex));
                }
            }
        }
        let closed_by_border: FxHashSet<[VertexId; 2]> = border.iter().copied().collect();
        let mut faces = Vec::new();
        let mut open: Vec<[VertexId; 2]> = border.to_vec();
        let mut closed: FxHashSet<[VertexId; 2]> = FxHashSet::default();
        while let Some([a, b]) = open.pop() {
            if !closed.insert([a, b]) {
                continue;
            }
            let &(facet, v) = across.get(&[a, b]).ok_or(Refused::NotExposed)?;
            if facet.iter().any(|&v| sides.of(v) != Side::On) {
                return Err(Refused::NotExposed);
            }
            faces.push(facet);
            for [p, q] in [[b, v], [v, a]] {
                closed.insert([p, q]);
                if !closed_by_border.contains(&[p, q]) {
                    open.push([q, p]);
                }
            }
        }
        Ok(faces)
    }

    /// The corner in D of an outward oriented facet, in the tetrahedron on its inner side.
    fn corner_of(&self, facet: [VertexId; 3]) -> Option<Corner> {
        let c = *self.facets.get(&face(facet))?;
        let [a, b, p] = facet;
        let seen = self.d.mesh.facet(c);
        let same = [[a, b, p], [b, p, a], [p, a, b]].contains(&seen);
        let inner = if same { c } else { self.d.mesh.twin(c) };
        (!self.d.mesh.is_ghost(inner.tet())).then_some(inner)
    }

    /// The tetrahedra of D inside the cavity that the boundary and `f` enclose: those reached from their inner sides.
    fn inside(&self, f: &[[VertexId; 3]]) -> Result<Vec<[VertexId; 4]>, Refused> {
        let mesh = &self.d.mesh;
        let walls: FxHashSet<Face> = self
            .faces
            .iter()
            .copied()
            .chain(f.iter().map(|&t| face(t)))
            .collect();
        // All facets of the boundary are oriented outwards, those found on swallowing a tetrahedron, too.
        let outer = self.boundary.iter().map(|&(facet, _)| facet);
        let mut inside: Vec<TetId> = Vec::new();
        let mut seen = vec![false; mesh.capacity()];
        for facet in outer.chain(f.iter().copied()) {
            let t = self.corner_of(facet).ok_or(Refused::NotExposed)?.tet();
            if !std::mem::replace(&mut seen[t.index()], true) {
                inside.push(t);
            }
        }
        let mut next = 0;
        while let Some(&t) = inside.get(next) {
            next += 1;
            for slot in 0..4 {
                let c = t.corner(slot);
                if walls.contains(&face(mesh.facet(c))) {
                    continue;
                }
                let n = mesh.neighbor(c);
                if mesh.is_ghost(n) {
                    return Err(Refused::NotExposed);
                }
                if !std::mem::replace(&mut seen[n.index()], true) {
                    inside.push(n);
                }
            }
        }
        Ok(inside.into_iter().map(|t| mesh.vertices(t)).collect())
    }
}
