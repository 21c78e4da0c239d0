//! What polygon insertion counts.

use crate::recover::flips::FlipCounts;
use serde::Serialize;

/// What polygon insertion did.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct PolygonCounts {
    /// Polygons inserted, reinsertions not counted; where a polygon is not exactly flat, its pieces.
    pub polygons: u64,
    /// Polygons that were already in the mesh when their turn came.
    pub already_present: u64,
    /// Missing regions inserted, with those of reinsertions.
    pub regions: u64,
    /// Crossing tetrahedra of all regions.
    pub crossing_tets: u64,
    /// The largest number of crossing tetrahedra of one region.
    pub largest_region: u64,
    /// Subpolygons that cover the regions: triangles that were missing.
    pub recovered: u64,
    /// The largest number of such subpolygons of one region.
    pub most_recovered: u64,
    /// Cavities: tetrahedra swallowed in expansions.
    pub swallowed: u64,
    /// Cavities: subpolygons of other polygons that an insertion displaced.
    pub displaced: u64,
    /// Cavities: polygons inserted again because they were displaced.
    pub reinserted: u64,
    /// Cavities: regions in which retriangulation was refused.
    pub cavity_fallbacks: u64,
    /// Cavities: regions inserted by gift wrapping for that reason.
    pub gift_wrap_fallbacks: u64,
    /// Cavities and gift wrapping: regions left to exact flips because gift wrapping was refused, too.
    pub flip_fallbacks: u64,
    /// Polygons with vertices that are not exactly on one plane, which are inserted in exactly flat pieces.
    pub not_flat: u64,
    /// Shim tetrahedra left: all four vertices on one polygon that is flat only to rounding and was not cut.
    pub shims: u64,
    /// The flips.
    pub flips: FlipCounts,
    /// Flips of faces that were not locally Delaunay next to polygons that were inserted whole.
    pub repairs: RepairCounts,
}

/// Flips that repair faces that are not locally Delaunay.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct RepairCounts {
    /// 2-3 flips.
    pub two_three: u64,
    /// 3-2 flips.
    pub three_two: u64,
    /// 4-4 flips.
    pub four_four: u64,
}
