//! What it took to make polygons flat, and what became of the flat tetrahedra on them.

use serde::Serialize;

/// What it took to make all polygons exactly flat.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct FlatteningCounts {
    /// Polygons with vertices that are not exactly on one plane.
    pub not_flat: u64,
    /// The exactly flat pieces into which those were cut.
    pub pieces: u64,
    /// Pairs of crossing edges, opposite edges of shims, of which one was chosen.
    pub choices: u64,
    /// Steiner points inserted in the interiors of polygons.
    pub points_on_polygons: u64,
    /// Steiner points inserted on segments instead.
    pub points_on_segments: u64,
    /// How often Steiner points were inserted.
    pub rounds: usize,
    /// Polygons left as they are, because too many Steiner points would have been necessary.
    pub left_whole: u64,
    /// Shims of the domain: repaired ([`shims`](super::super::output::shims)), and left in the output.
    pub shims: ShimCounts,
}

/// How many shims the domain had, and what became of them.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct ShimCounts {
    /// Shims of the domain before repair: all four vertices on one polygon that was cut.
    pub found: u64,
    /// Shims left outside by a 2-2 flip of the domain's boundary.
    pub two_two: u64,
    /// 3-2 flips that removed shims.
    pub three_two: u64,
    /// 4-4 flips that removed shims.
    pub four_four: u64,
    /// Shims of the output.
    pub kept: u64,
}
