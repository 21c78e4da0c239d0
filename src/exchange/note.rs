//! Notes: what was forgiven, repaired, assumed, dropped or ignored, without being an error.

use serde::{Serialize, Serializer};
use std::fmt;

/// The kind of a note: a stable word, which scripts may rely on. This is the one table of them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[non_exhaustive]
pub enum NoteCode {
    /// Rounded Steiner points have no solution, so they are exact (`exact-steiner`).
    ExactSteiner,
    /// Tetrahedra that are positive with exact Steiner points only, not with their rounded coordinates
    /// (`spoilt-by-rounding`).
    SpoiltByRounding,
    /// All tetrahedra of a mesh are negative, and are read with the other orientation (`negative-tetrahedra`).
    NegativeTetrahedra,
    /// Facets without an area claim nothing (`degenerate-facets`).
    DegenerateFacets,
    /// Facets that are equal to others are one with them (`repeated-facets`).
    RepeatedFacets,
    /// A mesh has markers where the input has none (`missing-markers`).
    MissingMarkers,
    /// Facets were verified as merged that are not exactly coplanar (`merged-by-angle`).
    MergedByAngle,
    /// Facets that are coplanar to the precision of the input are one polygon (`flat-to-precision`).
    FlatToPrecision,
    /// Facets that would be one polygon to the precision of the input are left apart, as the mesh could not be made
    /// with it (`left-apart`).
    LeftApart,
    /// Vertices that are one to the precision of the input (`welded`).
    Welded,
    /// Vertices that are near each other to the precision of the input, but are not welded (`not-welded`).
    NotWelded,
    /// Facets that are farther from flat than the precision of the input are divided into triangles (`facets-divided`).
    FacetsDivided,
    /// Vertices of open edges that a coarser precision would weld (`near-vertices`).
    NearVertices,
    /// A mesh fills the convex hull although the facets enclose less (`fills-hull`).
    FillsHull,
    /// Delaunayhood was not checked (`any-triangulation`).
    AnyTriangulation,
    /// Files of a collection that are no models (`skipped-files`).
    SkippedFiles,
    /// Rows that several tables of a survey have, all the same (`repeated-rows`).
    RepeatedRows,
    /// A vertex lies exactly on an edge that does not have it; the edge is divided there (`vertex-on-edge`).
    VertexOnEdge,
    /// A vertex lies exactly on a facet that does not have it; the facet gets it (`vertex-on-facet`).
    VertexOnFacet,
    /// An edge lies exactly inside a facet that does not have it; the facet gets it as a segment (`edge-in-facet`).
    EdgeInFacet,
    /// Coplanar facets overlap; they are divided along each other (`facets-overlap`).
    FacetsOverlap,
    /// A polygon has the same corner several times in a row; one of them is left (`repeated-corner`).
    RepeatedCorner,
    /// Vertices that have other numbers in the mesh than in the input (`renumbered`).
    Renumbered,
    /// Edges of one facet only, inside the domain: fins, cracks, floating sheets (`open-edges`).
    OpenEdges,
    /// Facets of which nothing is in the mesh, since both sides of them are outside (`facets-outside`).
    FacetsOutside,
    /// Hole points outside of everything that the facets enclose (`hole-outside`).
    HoleOutside,
    /// Hole points, where the whole convex hull is kept (`hole-ignored`).
    HoleIgnored,
    /// Region points outside of the domain (`region-outside`).
    RegionOutside,
    /// Bounds of volumes, which are not applied, as nothing is refined (`region-volume`).
    RegionVolume,
    /// A number has an exponent as Fortran writes it, `1.0D+00` (`fortran-exponent`).
    FortranExponent,
    /// Commas between numbers are read as blanks (`comma-separator`).
    CommaSeparator,
    /// A comment of a kind that the format does not have is skipped (`foreign-comment`).
    ForeignComment,
    /// A keyword that is missing, or in two words, is taken as read: `end solid` in STL, no `End` in Medit
    /// (`keywords`).
    Keywords,
    /// What follows the end of the data is ignored (`trailing-data`).
    TrailingData,
    /// A section of a Medit file with an unknown keyword is skipped (`unknown-section`).
    UnknownSection,
    /// Solid elements of a Medit file are ignored, because its surface counts (`volume-elements`).
    VolumeElements,
    /// The file has a version that its format does not have (`format-version`).
    FormatVersion,
    /// Vertices are not numbered one after the other; corners are vertices of those numbers (`vertex-numbers`).
    VertexNumbers,
    /// A polygon that ends with its first corner is read without it (`closed-ring`).
    ClosedRing,
    /// Attributes or markers of vertices that the header announces are missing, and read as 0 (`missing-columns`).
    MissingColumns,
    /// Columns after those that the header announces are ignored (`extra-columns`).
    ExtraColumns,
    /// Lines do not begin with rows of the table, so its words are read one by one (`line-breaks`).
    LineBreaks,
    /// The name of a file says no format, so its content does (`format-by-content`).
    FormatByContent,
}

impl NoteCode {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            NoteCode::ExactSteiner => "exact-steiner",
            NoteCode::SpoiltByRounding => "spoilt-by-rounding",
            NoteCode::NegativeTetrahedra => "negative-tetrahedra",
            NoteCode::DegenerateFacets => "degenerate-facets",
            NoteCode::RepeatedFacets => "repeated-facets",
            NoteCode::MissingMarkers => "missing-markers",
            NoteCode::MergedByAngle => "merged-by-angle",
            NoteCode::FlatToPrecision => "flat-to-precision",
            NoteCode::LeftApart => "left-apart",
            NoteCode::Welded => "welded",
            NoteCode::NotWelded => "not-welded",
            NoteCode::FacetsDivided => "facets-divided",
            NoteCode::NearVertices => "near-vertices",
            NoteCode::FillsHull => "fills-hull",
            NoteCode::AnyTriangulation => "any-triangulation",
            NoteCode::SkippedFiles => "skipped-files",
            NoteCode::RepeatedRows => "repeated-rows",
            NoteCode::VertexOnEdge => "vertex-on-edge",
            NoteCode::VertexOnFacet => "vertex-on-facet",
            NoteCode::EdgeInFacet => "edge-in-facet",
            NoteCode::FacetsOverlap => "facets-overlap",
            NoteCode::RepeatedCorner => "repeated-corner",
            NoteCode::Renumbered => "renumbered",
            NoteCode::OpenEdges => "open-edges",
            NoteCode::FacetsOutside => "facets-outside",
            NoteCode::HoleOutside => "hole-outside",
            NoteCode::HoleIgnored => "hole-ignored",
            NoteCode::RegionOutside => "region-outside",
            NoteCode::RegionVolume => "region-volume",
            NoteCode::FortranExponent => "fortran-exponent",
            NoteCode::CommaSeparator => "comma-separator",
            NoteCode::ForeignComment => "foreign-comment",
            NoteCode::Keywords => "keywords",
            NoteCode::TrailingData => "trailing-data",
            NoteCode::UnknownSection => "unknown-section",
            NoteCode::VolumeElements => "volume-elements",
            NoteCode::FormatVersion => "format-version",
            NoteCode::VertexNumbers => "vertex-numbers",
            NoteCode::ClosedRing => "closed-ring",
            NoteCode::MissingColumns => "missing-columns",
            NoteCode::ExtraColumns => "extra-columns",
            NoteCode::LineBreaks => "line-breaks",
            NoteCode::FormatByContent => "format-by-content",
        }
    }
}

impl fmt::Display for NoteCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

impl Serialize for NoteCode {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

/// One note. It displays as `note[code]: text`.
///
/// What it is about has the numbers that the input gives it, at most [`Note::LISTED`] of each kind; `count` tells how
/// many there are.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Note {
    /// Which kind of note.
    pub code: NoteCode,
    /// A sentence or two for people, without a full stop at the end.
    pub text: String,
    /// How many things it is about.
    pub count: usize,
    /// Lines of the file, from 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<usize>,
    /// Facets.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub facets: Vec<i64>,
    /// Vertices.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub vertices: Vec<i64>,
    /// Hole points and region points by their numbers in their lists, or places that no vertex has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub points: Vec<[f64; 3]>,
}

impl Note {
    /// How many things of one kind a note lists at most.
    pub const LISTED: usize = 20;

    /// A note about `count` things, none of them listed.
    pub fn new(code: NoteCode, count: usize, text: impl Into<String>) -> Note {
        Note {
            code,
            text: text.into(),
            count,
            lines: Vec::new(),
            facets: Vec::new(),
            vertices: Vec::new(),
            points: Vec::new(),
        }
    }

    /// The note with lines of the file, the first [`Note::LISTED`] of them.
    pub fn at_lines(mut self, lines: impl IntoIterator<Item = usize>) -> Note {
        self.lines = lines.into_iter().take(Note::LISTED).collect();
        self
    }

    /// The note with facets, the first [`Note::LISTED`] of them.
    pub fn on_facets(mut self, facets: impl IntoIterator<Item = i64>) -> Note {
        self.facets = facets.into_iter().take(Note::LISTED).collect();
        self
    }

    /// The note with vertices, the first [`Note::LISTED`] of them.
    pub fn on_vertices(mut self, vertices: impl IntoIterator<Item = i64>) -> Note {
        self.vertices = vertices.into_iter().take(Note::LISTED).collect();
        self
    }

    /// The note with points, the first [`Note::LISTED`] of them.
    pub fn at_points(mut self, points: impl IntoIterator<Item = [f64; 3]>) -> Note {
        self.points = points.into_iter().take(Note::LISTED).collect();
        self
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "note[{}]: {}", self.code, self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_displays_with_its_code() {
        let note = Note::new(NoteCode::FacetsOutside, 1, "facet 3 is left out").on_facets([3]);
        assert_eq!(
            note.to_string(),
            "note[facets-outside]: facet 3 is left out"
        );
        assert_eq!(note.facets, [3]);
    }

    #[test]
    fn lists_are_cut_but_counts_are_not() {
        let note = Note::new(NoteCode::ExactSteiner, 100, "").at_lines(1..=100);
        assert_eq!((note.lines.len(), note.count), (Note::LISTED, 100));
    }
}
