//! Polygon insertion by gift wrapping (Shewchuk 2002, "CDTs and provably good boundary recovery"; paper §3.1): delete
//! the tetrahedra whose interiors f cuts, and wrap the cavity on each side, which triangulates f on the way. The
//! baseline of the comparisons, and the fallback of cavity retriangulation, as in Diazzi, Panozzo, Vaxman & Attene
//! 2023: the cavities are not expanded, so the gap of expansion is not there.
//!
//! # The algorithm
//! The *walls* of one cavity are the facets of the tetrahedra of R that do not cross f and lie on its side. Each is to
//! be finished on the sides on which R is. To finish a facet abc is to find the tetrahedron abcv of the CDT in front of
//! it: among the vertices in front, those that f's side and f itself have, v is the one first reached by the growing
//! sphere through a, b, c, invisible ones not counted. The other facets of abcv match facets that wait to be finished,
//! or wait themselves; a facet with all vertices on f is a triangle of f, and is left. Both cavities must leave the
//! same.
//!
//! # Why all facets of R that do not cross are walls
//! They are in the new CDT, so it does no harm to demand them, and other polygons in R cannot be displaced. The flips
//! of paper §3.2 turn the old CDT into the new one and only remove facets that have ceased to be locally regular.
//! Vertices rise at the rate r = max(0, d), d the distance from f. On a facet that does not cross, r equals an affine
//! function, d or 0, that r is nowhere below; so the facet sinks relative to all other vertices, and stays locally
//! regular.
//!
//! # Visibility
//! Let p be the centroid of abc. A vertex u is taken as *visible* if the open segment pu touches no wall, not even the
//! border of one.
//! - The apex v is visible: pv is in the interior of the tetrahedron abcv of the CDT, where no wall is.
//! - A vertex u in front of abc and inside the sphere of abcv is not: from no point q in the interior of abcv is it
//!   visible, so each segment qu meets a wall. Let q go to p: one wall meets the closed segment pu. If it does so at p
//!   it is abc, but then u is behind abc. If it does so at u alone, the points where it meets qu tend to u, so its cone
//!   at u, which is closed, holds the direction to p, and it meets the open segment, too.
//!
//! So v is the first visible vertex in the order in which the growing sphere reaches them. Perturbed weights make
//! that a strict order (`insphere` is not zero, as v is not coplanar with abc); positions, and so visibility, are not
//! perturbed. f itself need be no wall: pu is strictly on one side of it, but for u.
//!
//! # What is certain
//! Every sign is exact. If f is flat, in an edge-protected PLC, the CDT exists and is found. Otherwise gift wrapping
//! may be [`Refused`]. What is returned has positive tetrahedra that match facet by facet, inside a boundary that is
//! that of R: they fill R, once. Across facets that are no subpolygons they are checked to be locally Delaunay.
//!
//! Complexity: each of the n_f facets finished costs a scan of the n_v vertices and, for the apex and for each vertex
//! found invisible before it, one of the n_w walls: O(n_f·(n_v + k·n_w)), k near 1 in practice. Quadratic in the size
//! of R.

use super::Retriangulation;
use super::visibility::Visibility;
use crate::mesh::{TetMesh, VertexId, canonical_face};
use crate::predicate::PointStore;
use crate::recover::region::{Region, Side, Sides};
use crate::recover::subpolygons::{Face, face};
use rustc_hash::{FxHashMap, FxHashSet};

/// A facet with an orientation: v is *in front* if orient3d(v, a, b, c) is positive. The smallest vertex comes first.
type Facet = [VertexId; 3];

/// Why a region cannot be gift wrapped. None of these happens if f is flat and the PLC valid.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Refused {
    /// No vertex of the cavity is visible from the front of this facet.
    NoApex([VertexId; 3]),
    /// Two tetrahedra would be in front of this facet.
    Overlap([VertexId; 3]),
    /// The two cavities do not have the same triangles on f.
    Incompatible,
    /// As many facets of the result are not locally Delaunay.
    NotDelaunay(usize),
}

/// Gift wraps both cavities of the region R of f. `is_subpolygon` tells the triangles of polygons that are in the mesh.
///
/// # Errors
/// [`Refused`]; the mesh is not touched in any case.
pub fn gift_wrap<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    region: &Region,
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Result<Retriangulation, Refused> {
    let right = Cavity::new(mesh, sides, region, Side::Right).wrap(sides)?;
    let left = Cavity::new(mesh, sides, region, Side::Left).wrap(sides)?;
    let sorted = |mut faces: Vec<Facet>| {
        faces.sort_unstable();
        faces
    };
    let faces = sorted(right.faces);
    if faces != sorted(left.faces.into_iter().map(reversed).collect()) {
        return Err(Refused::Incompatible);
    }
    let new = [right.tets, left.tets].concat();
    let wrapped = Retriangulation {
        old: region.tets.clone(),
        new,
        gluing: None,
        faces,
        displaced: Vec::new(),
        swallowed: 0,
    };
    match not_locally_delaunay(mesh, sides.points(), region, &wrapped, is_subpolygon) {
        0 => Ok(wrapped),
        bad => Err(Refused::NotDelaunay(bad)),
    }
}

/// How many facets of a retriangulation of R, other than those of polygons, are not locally Delaunay.
fn not_locally_delaunay<P: PointStore>(
    mesh: &TetMesh,
    points: &P,
    region: &Region,
    wrapped: &Retriangulation,
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> usize {
    let inner = wrapped.new.iter().flat_map(apexes);
    // The boundary of R, seen from outside.
    let outer = region.boundary(mesh).into_iter().map(|c| {
        let facet = canonical_face(mesh.facet(mesh.twin(c)));
        (facet, mesh.apex_across(c))
    });
    let apex_in_front: FxHashMap<Facet, VertexId> = inner.chain(outer).collect();
    let on_f: FxHashSet<Face> = wrapped.faces.iter().map(|&t| face(t)).collect();
    let is_constrained = |f: Face| on_f.contains(&f) || is_subpolygon(f);
    let bad = |&([a, b, c], v): &(Facet, VertexId)| {
        apex_in_front
            .get(&reversed([a, b, c]))
            .is_some_and(|&u| !u.is_infinite() && points.insphere([v, a, b, c, u]).is_positive())
    };
    let facets = wrapped.new.iter().flat_map(apexes);
    // From both sides, perhaps.
    let faces: FxHashSet<Face> = facets.filter(bad).map(|(f, _)| face(f)).collect();
    faces.into_iter().filter(|&f| !is_constrained(f)).count()
}

/// The same facet seen from behind.
fn reversed([a, b, c]: Facet) -> Facet {
    [a, c, b]
}

/// The facets of a positive tetrahedron, each with the vertex in front.
fn apexes(&[a, b, c, d]: &[VertexId; 4]) -> [(Facet, VertexId); 4] {
    [
        (canonical_face([b, c, d]), a),
        (canonical_face([a, d, c]), b),
        (canonical_face([a, b, d]), c),
        (canonical_face([a, c, b]), d),
    ]
}

/// One of the two cavities, and its front.
struct Cavity<'a, P> {
    /// The vertices of the tetrahedra of R on this side and on f.
    vertices: Vec<VertexId>,
    visibility: Visibility<'a, P>,
    /// Whether the tetrahedron in front of a facet has been found. A facet that is not here was not met yet.
    finished: FxHashMap<Facet, bool>,
    /// The facets to be finished, and some that already are.
    waiting: Vec<Facet>,
}

/// A tetrahedralized cavity.
#[derive(Default)]
struct Wrapped {
    tets: Vec<[VertexId; 4]>,
    /// The triangles of f, with the cavity in front.
    faces: Vec<Facet>,
}

impl<'a, P: PointStore> Cavity<'a, P> {
    fn new(mesh: &TetMesh, sides: &Sides<'a, P>, region: &Region, side: Side) -> Cavity<'a, P> {
        let is_here = |v: VertexId| sides.of(v) == side || sides.of(v) == Side::On;
        let mut vertices: Vec<VertexId> =
            region.tets.iter().flat_map(|&t| mesh.vertices(t)).collect();
        vertices.retain(|&v| is_here(v));
        vertices.sort_unstable();
        vertices.dedup();
        // A crossing tetrahedron has at most two vertices on f, so each facet on this side has one that is not.
        let corners = region
            .tets
            .iter()
            .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
        let waiting: Vec<Facet> = corners
            .map(|c| canonical_face(mesh.facet(c)))
            .filter(|facet| facet.iter().all(|&v| is_here(v)))
            .collect();
        let finished: FxHashMap<Facet, bool> = waiting.iter().map(|&s| (s, false)).collect();
        // A wall between two tetrahedra of R has two orientations.
        let is_twice = |&s: &Facet| s[1] > s[2] && finished.contains_key(&reversed(s));
        let walls = waiting.iter().copied().filter(|s| !is_twice(s)).collect();
        Cavity {
            visibility: Visibility::new(sides.points(), walls),
            vertices,
            finished,
            waiting,
        }
    }

    fn wrap(mut self, sides: &Sides<P>) -> Result<Wrapped, Refused> {
        let mut wrapped = Wrapped::default();
        while let Some(s) = self.waiting.pop() {
            if self.finished[&s] {
                continue;
            }
            let v = self.apex(s).ok_or(Refused::NoApex(s))?;
            let [a, b, c] = s;
            wrapped.tets.push([v, a, b, c]);
            for (facet, _) in apexes(&[v, a, b, c]) {
                match self.finished.insert(facet, true) {
                    Some(true) => return Err(Refused::Overlap(facet)),
                    Some(false) => {}
                    None if facet.iter().all(|&v| sides.of(v) == Side::On) => {
                        wrapped.faces.push(facet);
                    }
                    None => {
                        let behind = reversed(facet);
                        if self.finished.insert(behind, false).is_some() {
                            return Err(Refused::Overlap(facet));
                        }
                        self.waiting.push(behind);
                    }
                }
            }
        }
        Ok(wrapped)
    }

    /// The vertex that the growing sphere through `s` reaches first in front, of those visible.
    fn apex(&self, s: Facet) -> Option<VertexId> {
        let points = self.visibility.points();
        let [a, b, c] = s;
        let mut invisible: Vec<VertexId> = Vec::new();
        loop {
            let candidates = self.vertices.iter().copied();
            let first = candidates
                .filter(|u| !s.contains(u) && !invisible.contains(u))
                .filter(|&u| points.orient3d([u, a, b, c]).is_positive())
                .reduce(|v, u| {
                    if points.insphere([v, a, b, c, u]).is_positive() {
                        u
                    } else {
                        v
                    }
                })?;
            if self.visibility.is_visible(first, s) {
                return Some(first);
            }
            invisible.push(first);
        }
    }
}
