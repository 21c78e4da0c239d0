//! What has been repaired, gathered into one note for each kind.

use crate::exchange::{Note, NoteCode};
use std::collections::BTreeMap;

/// The repairs of one kind.
#[derive(Default)]
struct Kind {
    count: usize,
    examples: Vec<String>,
    vertices: Vec<i64>,
    facets: Vec<i64>,
}

/// Everything that has been repaired.
#[derive(Default)]
pub(super) struct Repairs {
    kinds: BTreeMap<NoteCode, Kind>,
}

impl Repairs {
    /// How many examples the text of a note gives.
    const SHOWN: usize = 3;

    /// Adds one repair, with the numbers that the input gives its vertices and facets.
    pub fn add(&mut self, code: NoteCode, example: String, vertices: &[i64], facets: &[i64]) {
        let kind = self.kinds.entry(code).or_default();
        kind.count += 1;
        if kind.examples.len() < Repairs::SHOWN {
            kind.examples.push(example);
        }
        if kind.count <= Note::LISTED {
            kind.vertices.extend(vertices);
            kind.facets.extend(facets);
        }
    }

    /// One note for each kind of repair.
    pub fn notes(self) -> Vec<Note> {
        let note = |(code, kind): (NoteCode, Kind)| {
            let more = match kind.count > kind.examples.len() {
                true => format!(", … ({} in all)", kind.count),
                false => String::new(),
            };
            let text = format!("{}: {}{more}", what(code), kind.examples.join("; "));
            Note::new(code, kind.count, text)
                .on_vertices(kind.vertices)
                .on_facets(kind.facets)
        };
        self.kinds.into_iter().map(note).collect()
    }
}

/// What has been done.
fn what(code: NoteCode) -> &'static str {
    match code {
        NoteCode::VertexOnEdge => "edges are divided at vertices that lie exactly on them",
        NoteCode::VertexOnFacet => "facets get the vertices that lie exactly on them",
        NoteCode::EdgeInFacet => "facets get the edges that lie exactly inside them as segments",
        NoteCode::FacetsOverlap => "coplanar facets that overlap are divided along each other",
        NoteCode::RepeatedFacets => "facets that are the same are one",
        NoteCode::DegenerateFacets => "what has no area or no length is dropped",
        NoteCode::RepeatedCorner => "corners that are repeated in a row are left out",
        _ => "repaired",
    }
}
