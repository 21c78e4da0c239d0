//! Whether the polygons in the mesh meet as those of a PLC may: in common vertices and segments only.
//!
//! Recovery notices intersections only where they are in its way. Others leave no trace in the tetrahedra: a wall whose foot
//! no floor declares is recovered like any other, and of two polygons that overlap the second takes the triangles of the
//! first. But the mesh is a simplicial complex, so that polygons made of its triangles intersect in vertices, edges and
//! triangles of it. A polygon f is as it was given, and meets the others as it may, if
//!
//! - each subsegment that bounds it has as many triangles of f as f is on sides of it, and each other edge of its triangles has
//!   two: nobody else has taken one;
//! - no other edge of its triangles is a subsegment, or has triangles of another polygon;
//! - its triangles have no vertices but those of f and Steiner points on its segments.
//!
//! Of a polygon that is flat only to rounding each piece counts for itself. A segment, or the foot of a wall, that lies
//! along one of its cuts without being declared there is therefore not refused. Nothing is lost: where a polygon like that
//! lies is known only to rounding, the cut is a chain of edges of the mesh, and both constraints are unions of simplices of
//! it, as if it had been declared. ([`crate::check`] refuses it if its own triangulation of the polygon has that diagonal.)
//!
//! All of it is combinatorial, hence exact. O(k log k) for k triangles on polygons.

use super::polygons::{Subpolygons, boundary_subsegments};
use super::segments::{SegmentIndex, Subsegments};
use crate::error::InvalidPlc;
use crate::mesh::VertexId;
use crate::plc::Complex;

/// An edge with a triangle of a polygon at it, or with a side of a polygon that it bounds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    edge: [VertexId; 2],
    polygon: u32,
    /// Whether it comes from the boundary, not from a triangle.
    bounds: bool,
}

/// Looks for polygons, of those `inserted`, that intersect.
///
/// # Errors
/// The first intersection in the order of the vertices.
pub fn check_embedding(
    complex: &Complex,
    subsegments: &Subsegments,
    index: &SegmentIndex,
    subpolygons: &Subpolygons,
    inserted: &[bool],
) -> Result<(), InvalidPlc> {
    let mut sides = Vec::with_capacity(6 * subpolygons.len());
    for (f, polygon) in complex.polygons.iter().enumerate() {
        if inserted[f] {
            let boundary = boundary_subsegments(subsegments, index, polygon);
            sides.extend(boundary.into_iter().map(|[a, b]| Side {
                edge: [a.min(b), a.max(b)],
                polygon: f as u32,
                bounds: true,
            }));
        }
    }
    // The order of the table does not matter: what comes of it is sorted.
    for (&[a, b, c], &polygon) in subpolygons {
        for edge in [[a, b], [a, c], [b, c]] {
            let bounds = false;
            sides.push(Side {
                edge,
                polygon,
                bounds,
            });
        }
    }
    sides.sort_unstable();
    let facets = |f: u32| complex.polygons[f as usize].facets.clone();
    for at_edge in sides.chunk_by(|s, t| s.edge == t.edge) {
        let edge = at_edge[0].edge;
        // Polygons that are there by their boundary or by triangles.
        let first = at_edge[0].polygon;
        let other = |f: u32| at_edge.iter().map(|s| s.polygon).find(|&g| g != f);
        for of_polygon in at_edge.chunk_by(|s, t| s.polygon == t.polygon) {
            let f = of_polygon[0].polygon;
            let bounds = of_polygon.iter().filter(|s| s.bounds).count();
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
    check_vertices(complex, subsegments, &sides)
}

/// Whether the vertices of the polygons' triangles are theirs.
fn check_vertices(
    complex: &Complex,
    subsegments: &Subsegments,
    sides: &[Side],
) -> Result<(), InvalidPlc> {
    // Steiner points on the segments of a polygon are ends of its boundary's subsegments.
    let ends = |s: &Side| s.edge.map(|v| (s.polygon, v));
    let mut own: Vec<(u32, VertexId)> = sides.iter().filter(|s| s.bounds).flat_map(ends).collect();
    let mut all: Vec<(u32, VertexId)> = sides.iter().filter(|s| !s.bounds).flat_map(ends).collect();
    for list in [&mut own, &mut all] {
        list.sort_unstable();
        list.dedup();
    }
    let is_own = |item: &(u32, VertexId)| {
        let polygon = &complex.polygons[item.0 as usize];
        own.binary_search(item).is_ok() || polygon.vertices.binary_search(&item.1).is_ok()
    };
    let Some(&(f, vertex)) = all.iter().find(|item| !is_own(item)) else {
        return Ok(());
    };
    let facets = complex.polygons[f as usize].facets.clone();
    Err(match subsegments.segment_of_steiner(vertex) {
        Some(s) => InvalidPlc::SegmentThroughPolygon {
            facets,
            segment: complex.segments[s as usize].ends,
        },
        None => InvalidPlc::VertexOnPolygon { facets, vertex },
    })
}
