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
    /// Polygons with pieces that are not flat, and are inserted whole.
    pub whole: u64,
    /// Those pieces.
    pub whole_pieces: u64,
    /// Polygons that got Steiner points because a piece could not be inserted whole, by reason.
    pub refused: RefusedCounts,
    /// How often all pieces were inserted into a copy of the mesh to find out which cannot be.
    pub trials: usize,
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

/// Why polygons with pieces that are not flat could not be inserted whole.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Refusal {
    /// The mesh does not tell where the surface of a piece is.
    Ambiguous,
    /// The two sides of a piece want different triangulations of it (paper, Fig. 4).
    Incompatible,
    /// A segment or another polygon crosses a piece, because of rounding only.
    Crossed,
    /// With it, a polygon that is flat could not be inserted.
    Blamed,
}

/// How many polygons could not be inserted whole, for each reason.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct RefusedCounts {
    /// The mesh did not tell where the surface of a piece is.
    pub ambiguous: u64,
    /// The two sides of a piece wanted different triangulations of it (paper, Fig. 4).
    pub incompatible: u64,
    /// A segment or another polygon crossed a piece, because of rounding only.
    pub crossed: u64,
    /// With them, a polygon that is flat could not be inserted.
    pub blamed: u64,
}

impl RefusedCounts {
    /// One more.
    pub(super) fn add(&mut self, refusal: Refusal) {
        *match refusal {
            Refusal::Ambiguous => &mut self.ambiguous,
            Refusal::Incompatible => &mut self.incompatible,
            Refusal::Crossed => &mut self.crossed,
            Refusal::Blamed => &mut self.blamed,
        } += 1;
    }
}
