//! TetGen's `.node`, `.poly` and `.smesh` files (Si, *TetGen, a Quality Tetrahedral Mesh Generator*, user's manual,
//! section "File formats").
//!
//! ```text
//! <vertices> [3 [<attributes> [<markers 0|1>]]]      then per vertex   <number> <x> <y> <z> …
//! <facets> [<markers 0|1>]                           then per facet
//!     .poly:   <polygons> [<holes> [<marker>]]       then per polygon  <corners> <vertex> …
//!                                                    then per hole     <number> <x> <y> <z>
//!     .smesh:  <corners> <vertex> … [<marker>]
//! <holes>                                            then per hole     <number> <x> <y> <z>
//! <regions>                                          then per region   <number> <x> <y> <z> <attribute> [<volume>]
//! ```
//!
//! As in TetGen, a list of no vertices refers to the `.node` file, corners may go on in the next line, the facet's
//! number of holes may be missing, and so may the list of regions, or those of holes and regions, at the end of the
//! file. The numbers of facets, holes and regions say nothing. Corners are the numbers of vertices as the file has
//! them, from any number on and in any order; if they do not follow one another there is a note, because TetGen then
//! counts the lines instead.
//!
//! Forgiven, too: attributes and markers of vertices that are missing or not announced, facet markers that are not
//! announced, and whatever follows the last region, such as a fifth part, if it cannot be one more region. Anything
//! else that is left over in a line is an error, because then a count is wrong; so are two vertices of one number.

use super::ahead::{Rows, read_aligned};
use super::error::{FormatError, Reason};
use super::faces::open_ring_noted;
use super::nodes::{self, vertex_list};
use super::text::{Syntax, Text};
use super::vertices::Numbering;
use crate::exchange::{Facet, Note, NoteCode, Plc, Region, Segment};
use crate::mesh::VertexId;

/// What the corners of facets are.
#[derive(Clone, Copy)]
struct Corners<'a> {
    numbering: &'a Numbering,
    points: &'a [[f64; 3]],
}

/// Which of the two facet lists a file has.
#[derive(Clone, Copy)]
enum FacetList {
    Poly,
    Smesh,
}

/// Reads a `.node` file: vertices alone.
///
/// # Errors
/// If it is malformed.
pub fn read_node(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    node(bytes).map(|(plc, _, notes)| (plc, notes))
}

fn node(bytes: &[u8]) -> Result<(Plc, Numbering, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, Syntax::Hash);
    let (vertices, columns) = vertex_list(&mut text)?;
    if vertices.points.is_empty() {
        return Err(text.error(Reason::NoVertices));
    }
    text.end_file()?;
    let (plc, numbering) = vertices.into_plc(columns.attributes);
    Ok((plc, numbering, text.into_notes()))
}

/// Reads a `.poly` file. `nodes` is asked for the bytes of the `.node` file if the list of vertices is empty.
///
/// # Errors
/// If one of the files is malformed, or `nodes` fails.
pub fn read_poly(
    bytes: &[u8],
    nodes: impl FnOnce() -> Result<Vec<u8>, FormatError>,
) -> Result<(Plc, Vec<Note>), FormatError> {
    read(bytes, FacetList::Poly, nodes)
}

/// Reads a `.smesh` file. `nodes` is asked for the bytes of the `.node` file if the list of vertices is empty.
///
/// # Errors
/// If one of the files is malformed, or `nodes` fails.
pub fn read_smesh(
    bytes: &[u8],
    nodes: impl FnOnce() -> Result<Vec<u8>, FormatError>,
) -> Result<(Plc, Vec<Note>), FormatError> {
    read(bytes, FacetList::Smesh, nodes)
}

fn read(
    bytes: &[u8],
    list: FacetList,
    nodes: impl FnOnce() -> Result<Vec<u8>, FormatError>,
) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, Syntax::Hash);
    let (vertices, columns) = vertex_list(&mut text)?;
    let (mut plc, numbering, mut notes) = if vertices.points.is_empty() {
        node(&nodes()?).map_err(|e| FormatError::NodeFile(Box::new(e)))?
    } else {
        let (plc, numbering) = vertices.into_plc(columns.attributes);
        (plc, numbering, Vec::new())
    };
    for note in &mut notes {
        note.text = format!("in the .node file of the vertices: {}", note.text);
    }
    let corners = Corners {
        numbering: &numbering,
        points: &plc.vertices,
    };
    let facets = facet_list(&mut text, list, corners)?;
    plc.facets = facets.facets;
    plc.segments = facets.segments;
    if text.advance() {
        plc.holes = holes(&mut text)?;
    }
    if text.advance() {
        plc.regions = regions(&mut text)?;
    }
    end(&mut text)?;
    notes.extend(text.into_notes());
    Ok((plc, notes))
}

/// What follows the last region is ignored, unless it can be a region that the count leaves out.
fn end(text: &mut Text) -> Result<(), FormatError> {
    text.end_line()?;
    if !text.advance() {
        return Ok(());
    }
    const REGION: usize = 5;
    let mark = text.mark();
    let mut numbers = 0;
    let mut other = false;
    while let Some(token) = text.token() {
        numbers += 1;
        other |= text.number(token).is_err();
    }
    text.return_to(mark);
    if numbers >= REGION && !other {
        return text.end_line();
    }
    text.forgive(NoteCode::TrailingData);
    Ok(())
}

fn facet_list(text: &mut Text, list: FacetList, corners: Corners) -> Result<Facets, FormatError> {
    text.begin("the number of facets")?;
    let token = text.here("the number of facets")?;
    let count = text.count(token, "the number of facets")?;
    let marked = match text.token() {
        Some(token) => text.count(token, "the number of facet markers")? > 0,
        None => false,
    };
    text.end_line()?;
    let mut facets = Facets::default();
    let read = |text: &mut Text, facets: &mut Facets| {
        let line = text.number_of_line();
        let mut facet = match list {
            FacetList::Poly => poly_facet(text, corners)?,
            FacetList::Smesh => smesh_facet(text, corners)?,
        };
        if !marked && facet.marker != 0 {
            text.forgive_line(NoteCode::ExtraColumns, line);
            facet.marker = 0;
        }
        facets.push(facet);
        Ok::<(), FormatError>(())
    };
    let align = |rest: &[u8]| first_facet(rest, |text| read(text, &mut Facets::default()).is_ok());
    read_aligned(text, count, &mut facets, read, align);
    while facets.count < count {
        text.begin("a facet")?;
        read(text, &mut facets)?;
    }
    Ok(facets)
}

/// In how many bytes the beginning of a facet is looked for.
#[cfg(not(test))]
fn window() -> usize {
    1 << 13
}

#[cfg(test)]
use super::ahead::tests::window;

/// The lines that are there to their ends.
fn whole_lines(bytes: &[u8]) -> &[u8] {
    // A carriage return at the end may belong to a line feed that is not there.
    let inner = bytes.len().saturating_sub(1);
    let feed = bytes.iter().rposition(|&b| b == b'\n');
    let end = feed.or_else(|| bytes[..inner].iter().rposition(|&b| b == b'\r'));
    &bytes[..end.map_or(0, |i| i + 1)]
}

/// Where a facet probably begins: several can be read from there. At the beginning of a line in any case.
fn first_facet(bytes: &[u8], reads: impl Fn(&mut Text) -> bool) -> usize {
    // The lines that are tried, and how many facets there must be.
    const LINES: usize = 16;
    const FACETS: usize = 4;
    let bytes = whole_lines(&bytes[..bytes.len().min(window())]);
    let mut text = Text::new(bytes, Syntax::Hash);
    for _ in 0..LINES {
        let mut trial = text.clone();
        let begins = (0..FACETS).all(|_| !trial.advance() || reads(&mut trial));
        if begins || !text.next_line() {
            break;
        }
    }
    bytes.len() - text.rest().len()
}

/// What a list of facets comes to.
#[derive(Default)]
struct Facets {
    /// How many there were.
    count: u64,
    facets: Vec<Facet>,
    segments: Vec<Segment>,
}

impl Facets {
    fn push(&mut self, facet: Facet) {
        self.count += 1;
        if facet.polygons.iter().any(|p| p.len() >= 3) {
            self.facets.push(facet);
            return;
        }
        // Not an area: segments that float in space. Single vertices say nothing.
        for polygon in &facet.polygons {
            if let &[a, b] = &polygon[..] {
                self.segments.push(Segment {
                    ends: [a, b],
                    marker: facet.marker,
                });
            }
        }
    }
}

impl Rows for Facets {
    fn piece(&self) -> Facets {
        Facets::default()
    }

    fn len(&self) -> u64 {
        self.count
    }

    fn append(&mut self, next: Facets) -> bool {
        self.count += next.count;
        self.facets.extend(next.facets);
        self.segments.extend(next.segments);
        true
    }
}

fn poly_facet(text: &mut Text, vertices: Corners) -> Result<Facet, FormatError> {
    let token = text.here("the number of polygons of a facet")?;
    let polygons = text.count(token, "the number of polygons of a facet")?;
    if polygons == 0 {
        return Err(text.error(Reason::EmptyFacet));
    }
    let holes = match text.token() {
        Some(token) => text.count(token, "the number of holes of a facet")?,
        None => 0,
    };
    let marker = marker(text)?;
    text.end_line()?;
    let mut facet = Facet {
        marker,
        polygons: Vec::with_capacity(polygons.min(4) as usize),
        ..Facet::default()
    };
    for _ in 0..polygons {
        text.begin("a polygon")?;
        facet.polygons.push(corners(text, vertices)?);
        text.end_line()?;
    }
    for _ in 0..holes {
        text.begin("a hole of a facet")?;
        facet.holes.push(numbered_point(text)?);
        text.end_line()?;
    }
    Ok(facet)
}

fn smesh_facet(text: &mut Text, vertices: Corners) -> Result<Facet, FormatError> {
    let polygons = vec![corners(text, vertices)?];
    let marker = marker(text)?;
    text.end_line()?;
    Ok(Facet {
        polygons,
        marker,
        holes: Vec::new(),
    })
}

fn marker(text: &mut Text) -> Result<i64, FormatError> {
    match text.token() {
        Some(token) => nodes::marker(text, token),
        None => Ok(0),
    }
}

fn corners(text: &mut Text, vertices: Corners) -> Result<Vec<VertexId>, FormatError> {
    let token = text.here("the number of corners")?;
    let count = text.count(token, "the number of corners")?;
    if count == 0 {
        return Err(text.error(Reason::EmptyFacet));
    }
    let mut polygon = Vec::new();
    for _ in 0..count {
        let token = text.anywhere("a corner")?;
        let index = text.integer(token)?;
        let vertex = vertices.numbering.vertex(index);
        polygon.push(vertex.ok_or_else(|| {
            let (first, last) = vertices.numbering.range();
            text.error(Reason::IndexOutOfRange { index, first, last })
        })?);
    }
    open_ring_noted(text, &mut polygon, vertices.points);
    Ok(polygon)
}

fn numbered_point(text: &mut Text) -> Result<[f64; 3], FormatError> {
    let token = text.here("the number of a point")?;
    text.integer(token)?;
    text.point()
}

fn holes(text: &mut Text) -> Result<Vec<[f64; 3]>, FormatError> {
    let token = text.here("the number of holes")?;
    let count = text.count(token, "the number of holes")?;
    text.end_line()?;
    let mut holes = Vec::new();
    for _ in 0..count {
        text.begin("a hole")?;
        holes.push(numbered_point(text)?);
        text.end_line()?;
    }
    Ok(holes)
}

fn regions(text: &mut Text) -> Result<Vec<Region>, FormatError> {
    let token = text.here("the number of regions")?;
    let count = text.count(token, "the number of regions")?;
    text.end_line()?;
    let mut regions = Vec::new();
    for _ in 0..count {
        text.begin("a region")?;
        let point = numbered_point(text)?;
        let token = text.here("the attribute of a region")?;
        let attribute = text.real(token)?;
        let volume = match text.token() {
            Some(token) => Some(text.real(token)?),
            None => None,
        };
        text.end_line()?;
        regions.push(Region {
            point,
            attribute,
            // TetGen writes −1 for "no bound".
            max_volume: volume.filter(|&v| v > 0.0),
        });
    }
    Ok(regions)
}
