//! What a run did: counts and seconds per phase, as plain documented structs. (The library reads a clock here and in
//! [`crate::clock`], for the tasks of polygon insertion, and nowhere else.)

pub use crate::plc::MergeCounts;
pub use crate::recover::flatten::FlatteningCounts;
pub use crate::recover::flips::FlipCounts;
pub use crate::recover::polygons::PolygonCounts;

use crate::exchange::{Note, Precision};
use crate::predicate::Steiner;
use crate::recover::polygons::Insertion;
use serde::Serialize;
use std::time::Instant;

/// The phases of the pipeline, in order.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// From the PLC to its checked complex.
    Complex,
    /// The Delaunay tetrahedralization of the vertices.
    Delaunay,
    /// Segment recovery.
    Segments,
    /// Polygons that are flat only to rounding are cut into flat pieces.
    Flattening,
    /// Polygon insertion.
    Polygons,
    /// Inside and outside, and the arrays for output.
    Domain,
}

/// Wall clock seconds per phase.
#[derive(Clone, Copy, Default, Debug, Serialize)]
pub struct Seconds {
    /// From the PLC to its checked complex.
    pub complex: f64,
    /// The Delaunay tetrahedralization of the vertices.
    pub delaunay: f64,
    /// Segment recovery.
    pub segments: f64,
    /// Polygons that are flat only to rounding are cut into flat pieces.
    pub flattening: f64,
    /// Polygon insertion.
    pub polygons: f64,
    /// Inside and outside, and the arrays for output.
    pub domain: f64,
}

/// Counts and seconds of one run.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// The algorithm, and the number type of its flip times.
    pub insertion: Option<Insertion>,
    /// Vertices of the input, duplicates included.
    pub input_vertices: usize,
    /// Vertices that have the coordinates of an earlier one.
    pub duplicate_vertices: usize,
    /// The precision of the input's coordinates, and what it follows from.
    pub precision: Precision,
    /// Vertices that were moved to others, because they are one to that precision.
    pub welded_vertices: usize,
    /// What has been merged because it is coplanar to that precision, or by an angle.
    pub merged_near: MergeCounts,
    /// Facets of the input.
    pub input_facets: usize,
    /// Segments after coplanar facets were merged.
    pub segments: usize,
    /// Polygons after coplanar facets were merged.
    pub polygons: usize,
    /// Tetrahedra of the Delaunay tetrahedralization of the input's vertices, without ghosts.
    pub delaunay_tets: usize,
    /// Steiner points, on segments and on polygons.
    pub steiner_points: usize,
    /// Those that lie exactly on their segment: where coordinates have bits to spare, rounding changes nothing.
    pub steiner_points_on_segment: usize,
    /// How Steiner points are represented.
    pub steiner: Steiner,
    /// Exact Steiner points whose coordinates are no doubles, so that output rounds them.
    pub steiner_not_doubles: usize,
    /// Polygons flat only to rounding that were divided into triangles, because Steiner points are exact.
    pub triangulated_polygons: usize,
    /// What it took to make all polygons exactly flat.
    pub flattening: FlatteningCounts,
    /// What polygon insertion did.
    pub insertion_counts: PolygonCounts,
    /// Tetrahedra of the output.
    pub output_tets: usize,
    /// Subpolygons of the output (and hull faces, where the hull is kept).
    pub output_faces: usize,
    /// Regions of the output: parts of the domain that facets divide.
    pub output_regions: usize,
    /// Segments of the domain that are edges of one polygon only, on one side: those of fins, cracks and sheets that
    /// float.
    pub open_edges: usize,
    /// Exact Steiner points that output does not round to the nearest doubles, so that tetrahedra stay positive.
    pub moved_by_rounding: usize,
    /// Tetrahedra that are positive with the exact Steiner points but not with the rounded ones, by index in the
    /// output, counting from 0.
    pub spoilt_by_rounding: Vec<usize>,
    /// How many signs the verifier had to decide by integers ([`crate::verify::Counts::exact_signs`]), if it was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verified_by_integers: Option<usize>,
    /// What was forgiven, assumed, dropped or ignored.
    pub notes: Vec<Note>,
    /// Seconds per phase; a phase that was not reached has 0.
    pub seconds: Seconds,
}

impl Report {
    /// Runs one phase and adds its time.
    pub(crate) fn time<T>(&mut self, phase: Phase, run: impl FnOnce(&mut Report) -> T) -> T {
        let start = Instant::now();
        let result = run(self);
        let elapsed = start.elapsed().as_secs_f64();
        let seconds = &mut self.seconds;
        *match phase {
            Phase::Complex => &mut seconds.complex,
            Phase::Delaunay => &mut seconds.delaunay,
            Phase::Segments => &mut seconds.segments,
            Phase::Flattening => &mut seconds.flattening,
            Phase::Polygons => &mut seconds.polygons,
            Phase::Domain => &mut seconds.domain,
        } += elapsed;
        result
    }
}
