//! The list of vertices of TetGen's `.node`, `.poly` and `.smesh` files.

use super::ahead::{Rows, read_ahead};
use super::error::{FormatError, Reason};
use super::text::Text;
use super::vertices::Vertices;
use crate::exchange::NoteCode;

/// What follows the coordinates of a vertex.
#[derive(Clone, Copy, Default)]
pub(super) struct Columns {
    /// How many attributes.
    pub attributes: usize,
    /// Whether a marker.
    marked: bool,
}

/// Reads the vertices and how many attributes each has.
pub(super) fn vertex_list(text: &mut Text) -> Result<(Vertices, Columns), FormatError> {
    text.begin("the number of vertices")?;
    let token = text.here("the number of vertices")?;
    let count = text.vertex_count(token)?;
    if let Some(token) = text.token() {
        let dimension = text.integer(token)?;
        if dimension != 3 {
            return Err(text.error(Reason::Dimension(dimension)));
        }
    }
    let mut columns = Columns::default();
    if let Some(token) = text.token() {
        let attributes = text.count(token, "the number of attributes")?;
        columns.attributes = usize::try_from(attributes).unwrap_or(usize::MAX);
    }
    if let Some(token) = text.token() {
        columns.marked = text.count(token, "the number of markers")? > 0;
    }
    text.end_line()?;

    let mut vertices = Vertices::default();
    let read = |text: &mut Text, vertices: &mut Vertices| vertex(text, columns, vertices);
    read_ahead(text, count, &mut vertices, read);
    while vertices.len() < count {
        text.begin("a vertex")?;
        vertex(text, columns, &mut vertices)?;
    }
    if count == 0 {
        columns = Columns::default();
    }
    Ok((vertices, columns))
}

fn vertex(text: &mut Text, columns: Columns, vertices: &mut Vertices) -> Result<(), FormatError> {
    let token = text.here("the number of a vertex")?;
    let number = text.integer(token)?;
    if !vertices.may_have(number) {
        if vertices.is_piece() {
            return Err(text.error(Reason::NumberTwice(number)));
        }
        text.forgive(NoteCode::VertexNumbers);
        vertices.allow_any_numbers();
    }
    let point = text.point()?;
    if !vertices.push(number, point) {
        return Err(text.error(Reason::NumberTwice(number)));
    }
    for _ in 0..columns.attributes {
        let value = match text.token() {
            Some(token) => text.real(token)?,
            None => missing(text, columns)?,
        };
        vertices.attributes.push(value);
    }
    if columns.marked {
        let marker = match text.token() {
            Some(token) => marker(text, token)?,
            None => missing(text, columns)? as i64,
        };
        vertices.markers.push(marker);
    }
    if text.has_word() {
        more(text)?;
    }
    Ok(())
}

/// What stands for a column that is not there. No room is made for attributes that are only announced.
#[cold]
fn missing(text: &mut Text, columns: Columns) -> Result<f64, FormatError> {
    const MOST: usize = 16;
    if columns.attributes > MOST {
        return Err(text.error(Reason::LineEnds("an attribute")));
    }
    text.forgive(NoteCode::MissingColumns);
    Ok(0.0)
}

/// Columns that nobody announced.
#[cold]
fn more(text: &mut Text) -> Result<(), FormatError> {
    // Then they may be decimal commas, and what is left coordinates.
    if text.is_separated_by_commas() {
        return text.end_line();
    }
    text.forgive(NoteCode::ExtraColumns);
    while let Some(token) = text.token() {
        text.real(token)?;
    }
    Ok(())
}

/// A marker, which may be written as a real number that is whole.
pub(super) fn marker(text: &mut Text, token: &[u8]) -> Result<i64, FormatError> {
    const MOST: f64 = (1u64 << 53) as f64;
    text.integer(token).or_else(|error| match text.real(token) {
        Ok(x) if x.fract() == 0.0 && x.abs() <= MOST => Ok(x as i64),
        _ => Err(error),
    })
}
