//! Whether the polygons in the mesh meet as those of a PLC may: in common vertices and segments only.
//!
//! Recovery notices intersections only where they are in its way. Others leave no trace in the tetrahedra: a wall whose
//! foot no floor declares is recovered like any other, and of two polygons that overlap the second takes the triangles
//! of the first. But the mesh is a simplicial complex, so that polygons made of its triangles intersect in vertices,
//! edges and triangles of it. A polygon f is as it was given, and meets the others as it may, if
//!
//! - each subsegment that bounds it has as many triangles of f as f is on sides of it, and each other edge of its
//!   triangles has two: nobody else has taken one;
//! - no other edge of its triangles is a subsegment, or has triangles of another polygon;
//! - its triangles have no vertices but those of f and Steiner points on its segments.
//!
//! Of a polygon that is flat only to rounding each piece counts for itself. A segment, or the foot of a wall, that lies
//! along one of its cuts without being declared there is therefore not refused. Nothing is lost: where a polygon like
//! that lies is known only to rounding, the cut is a chain of edges of the mesh, and both constraints are unions of
//! simplices of it, as if it had been declared. ([`crate::check`] refuses it if its own triangulation of the polygon
//! has that diagonal.)
//!
//! All of it is combinatorial, hence exact. Edges are grouped by their lesser ends: O(n + k) for k triangles on
//! polygons, of n vertices with few edges each.

use crate::error::InvalidPlc;
use crate::mesh::{Groups, VertexId};
use crate::plc::Complex;
use crate::recover::segments::Subsegments;
use crate::recover::subpolygons::{Face, Subpolygons};

/// An edge, by its greater end, with a triangle of a polygon at it, or with a side of a polygon that it bounds; as one
/// number, for sorting.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct EdgeUse(u64);

impl EdgeUse {
    fn new(end: VertexId, polygon: u32, bounds: bool) -> EdgeUse {
        EdgeUse(u64::from(end.0) << 32 | u64::from(polygon << 1 | u32::from(bounds)))
    }

    fn end(self) -> VertexId {
        VertexId((self.0 >> 32) as u32)
    }

    fn polygon(self) -> u32 {
        self.0 as u32 >> 1
    }

    /// Whether it comes from the boundary, not from a triangle.
    fn bounds(self) -> bool {
        self.0 & 1 == 1
    }
}

/// What polygons consist of.
struct Parts {
    /// The directed subsegments that bound each polygon, one after the other, and where those of each one end.
    boundary: Vec<[VertexId; 2]>,
    ends: Vec<usize>,
    /// The triangles of all polygons, in no order.
    triangles: Vec<(Face, u32)>,
}

impl Parts {
    fn boundary_of(&self, f: usize) -> &[[VertexId; 2]] {
        let start = f.checked_sub(1).map_or(0, |g| self.ends[g]);
        &self.boundary[start..self.ends[f]]
    }
}

/// Looks for polygons, of those `inserted`, that intersect. `n` is the number of vertices.
///
/// # Errors
/// The first intersection in the order of the vertices.
pub fn check_embedding(
    complex: &Complex,
    subsegments: &Subsegments,
    (subpolygons, n): (&Subpolygons, usize),
    inserted: &[bool],
) -> Result<(), InvalidPlc> {
    assert!(complex.polygons.len() < 1 << 31, "fewer than 2^31 polygons");
    // The order of the table does not matter: what comes of it is sorted.
    let mut parts = Parts {
        boundary: Vec::with_capacity(3 * complex.polygons.len()),
        ends: Vec::with_capacity(complex.polygons.len()),
        triangles: subpolygons.iter().map(|(&t, &f)| (t, f)).collect(),
    };
    for (polygon, inserted) in complex.polygons.iter().zip(inserted) {
        if *inserted {
            subsegments.append_boundary(polygon, &mut parts.boundary);
        }
        parts.ends.push(parts.boundary.len());
    }
    check_edges(complex, subsegments, &parts, n)?;
    check_vertices(complex, subsegments, &parts, n)
}

/// Whether the edges of the polygons' triangles are theirs alone, but for the boundary.
fn check_edges(
    complex: &Complex,
    subsegments: &Subsegments,
    parts: &Parts,
    n: usize,
) -> Result<(), InvalidPlc> {
    let bounds = (0..complex.polygons.len()).flat_map(|f| {
        let edges = parts.boundary_of(f).iter();
        edges.map(move |&[a, b]| (a.min(b), EdgeUse::new(a.max(b), f as u32, true)))
    });
    let inner = parts.triangles.iter().flat_map(|&([a, b, c], f)| {
        let edges = [[a, b], [a, c], [b, c]];
        edges.map(|[a, b]| (a, EdgeUse::new(b, f, false)))
    });
    let mut sides = Groups::new(n, bounds.chain(inner));
    sides.sort_groups(|&side| side);
    let facets = |f: u32| complex.polygons[f as usize].facets.clone();
    for least in (0..n).map(VertexId::new) {
        for at_edge in sides.of(least).chunk_by(|s, t| s.end() == t.end()) {
            let edge = [least, at_edge[0].end()];
            // Polygons that are there by their boundary or by triangles.
            let first = at_edge[0].polygon();
            let other = |f: u32| at_edge.iter().map(|s| s.polygon()).find(|&g| g != f);
            for of_polygon in at_edge.chunk_by(|s, t| s.polygon() == t.polygon()) {
                let f = of_polygon[0].polygon();
                let bounds = of_polygon.iter().filter(|s| s.bounds()).count();
                let triangles = of_polygon.len() - bounds;
                let wanted = if bounds > 0 { bounds } else { 2 };
                if triangles != wanted {
                    return Err(InvalidPlc::PolygonsIntersect {
                        first: facets(f),
                        second: facets(other(f).unwrap_or(f)),
                    });
                }
                if bounds > 0 {
                    continue;
                }
                if let Some(s) = subsegments.segment_of(edge[0], edge[1]) {
                    return Err(InvalidPlc::SegmentThroughPolygon {
                        facets: facets(f),
                        segment: complex.segments[s as usize].ends,
                    });
                }
                if let Some(g) = other(first).map(|g| if g == f { first } else { g }) {
                    return Err(InvalidPlc::PolygonsIntersect {
                        first: facets(f.min(g)),
                        second: facets(f.max(g)),
                    });
                }
            }
        }
    }
    Ok(())
}

/// Whether the vertices of the polygons' triangles are theirs.
fn check_vertices(
    complex: &Complex,
    subsegments: &Subsegments,
    parts: &Parts,
    n: usize,
) -> Result<(), InvalidPlc> {
    let polygons = complex.polygons.len();
    let triangles = parts.triangles.iter();
    // Polygons take the place of vertices here.
    let by_polygon = Groups::new(polygons, triangles.map(|&(t, f)| (VertexId(f), t)));
    // The last polygon that each vertex was found to belong to.
    let mut owner = vec![u32::MAX; n];
    for f in 0..polygons {
        let triangles = by_polygon.of(VertexId::new(f));
        if triangles.is_empty() {
            continue;
        }
        // Steiner points on the segments of a polygon are ends of its boundary's subsegments.
        let ends = parts.boundary_of(f).iter().flatten();
        for v in ends.chain(&complex.polygons[f].vertices) {
            owner[v.index()] = f as u32;
        }
        let foreign = triangles.iter().flatten().copied();
        let Some(vertex) = foreign.filter(|v| owner[v.index()] != f as u32).min() else {
            continue;
        };
        let facets = complex.polygons[f].facets.clone();
        return Err(match subsegments.segment_of_steiner(vertex) {
            Some(s) => InvalidPlc::SegmentThroughPolygon {
                facets,
                segment: complex.segments[s as usize].ends,
            },
            None => InvalidPlc::VertexOnPolygon { facets, vertex },
        });
    }
    Ok(())
}
