//! Notes on what was forgiven or assumed.

use crate::exchange::{Note, NoteCode};
use crate::verify::case::Case;
use crate::verify::options::Domain;
use crate::verify::verdict::Findings;

/// What the counts of a verification have to say.
pub(crate) fn collect(case: &Case, findings: &mut Findings) {
    let counts = findings.counts.clone();
    let mut note = |code: NoteCode, count: usize, text: String| {
        if count > 0 {
            findings.notes.push(Note::new(code, count, text));
        }
    };
    note(
        NoteCode::NegativeTetrahedra,
        usize::from(counts.turned),
        "all tetrahedra of the mesh are negative: it is read with the other orientation".to_owned(),
    );
    note(
        NoteCode::DegenerateFacets,
        counts.facets_degenerate,
        format!(
            "{} facets of the input have no area, and claim nothing",
            counts.facets_degenerate
        ),
    );
    note(
        NoteCode::RepeatedFacets,
        counts.facets_repeated,
        format!(
            "{} facets of the input are equal to others, and are covered with these",
            counts.facets_repeated
        ),
    );
    note(
        NoteCode::MissingMarkers,
        counts.markers_instead,
        format!(
            "{} faces on facets without a marker are listed with 1 or -1, as some programs do",
            counts.markers_instead
        ),
    );
    note(
        NoteCode::FillsHull,
        usize::from(counts.fills_hull && counts.domain == Domain::Inside),
        "the mesh fills the convex hull, not what the facets enclose; it would have to be asked for (--domain hull)"
            .to_owned(),
    );
    note(
        NoteCode::AnyTriangulation,
        usize::from(case.options.any_triangulation),
        "whether faces are locally Delaunay was not checked".to_owned(),
    );
}
