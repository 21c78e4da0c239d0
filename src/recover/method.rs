//! Which algorithm inserts polygons, with which numbers, and what it counts.

use super::flips::FlipCounts;
use serde::Serialize;

/// The number type of the flip queue.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Times {
    /// Quotients rounded to single precision.
    F32,
    /// Quotients rounded to double precision: the paper's own.
    F64,
    /// Float enclosures, exact dyadic numbers where they overlap, and the perturbation: the exact order, mostly at the
    /// price of floats.
    Filtered,
    /// Exact dyadic numbers, and the perturbation.
    Exact,
    /// GMP rationals, and the perturbation.
    #[cfg(feature = "rug")]
    Rug,
}

/// The algorithm that inserts a polygon.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Insertion {
    /// Cavity retriangulation (paper §3.1).
    Cavity,
    /// Gift wrapping of the two cavities (Shewchuk 2002; paper §3.1): the baseline, in quadratic time.
    #[serde(rename = "gift-wrap")]
    GiftWrap,
    /// Bistellar flips in order of their times (paper §3.2).
    Flip(Times),
}

/// What polygon insertion did.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct PolygonCounts {
    /// Polygons inserted, reinsertions not counted.
    pub polygons: u64,
    /// Polygons that were already in the mesh when their turn came.
    pub already_present: u64,
    /// Missing regions inserted, with those of reinsertions.
    pub regions: u64,
    /// Crossing tetrahedra of all regions.
    pub crossing_tets: u64,
    /// The largest number of crossing tetrahedra of one region.
    pub largest_region: u64,
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
    /// Polygons with vertices that are not exactly on one plane.
    pub not_flat: u64,
    /// Shim tetrahedra left: all four vertices on one polygon that is flat only to rounding.
    pub shims: u64,
    /// The flips.
    pub flips: FlipCounts,
}
