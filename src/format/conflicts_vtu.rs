//! What a check found, for ParaView (`.vtu`): the facets, segments and vertices in question as triangles, lines and
//! points.
//!
//! Every conflict writes both of its parts and the point of the intersection, so a facet with several conflicts is
//! there several times. Cell data: `pair` (the number of the conflict in the list, from 0; −1 for what is wrong for
//! itself), `kind` (0 same facet, 1 facets overlap, 2 facets cross, 3 edge in facet, 4 edges overlap, 5 edge through
//! facet, 6 vertex in facet, 7 edges cross, 8 vertex on edge, 9 wrong for itself), `role` (0 and 1 for the two parts,
//! 2 for the point) and `facet` (its number as in messages, −1 for what is none).

use super::MeshFileError;
use super::mesh_file::stage;
use super::vtu::{array, begin, close, open, rows};
use crate::check::{Findings, Kind, Part, simplices_of_parts};
use crate::exchange::Plc;
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;
use std::io::{self, Write};
use std::path::Path;

/// Writes the parts that are in conflict, and the facets that are wrong for themselves, for ParaView. The file is
/// written whole or not at all.
///
/// # Errors
/// If it cannot be written.
pub fn write_conflicts(path: &Path, plc: &Plc, findings: &Findings) -> Result<(), MeshFileError> {
    let cells = cells(plc, findings);
    stage(path.to_path_buf(), |out| write(out, &cells))?.publish()?;
    Ok(())
}

/// One cell and its data.
struct Cell {
    points: Vec<u32>,
    pair: i64,
    kind: u8,
    role: u8,
    facet: i64,
}

/// All cells with the points they use.
#[derive(Default)]
struct Cells {
    points: Vec<[f64; 3]>,
    /// Where each vertex of the PLC is among the points.
    place: FxHashMap<VertexId, u32>,
    cells: Vec<Cell>,
}

impl Cells {
    fn add_point(&mut self, point: [f64; 3]) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// Adds a cell of vertices, without those that do not exist or are not finite.
    fn add(&mut self, plc: &Plc, corners: &[VertexId], cell: Cell) {
        let mut points = Vec::with_capacity(corners.len());
        for &v in corners {
            let place = match (self.place.get(&v), plc.vertices.get(v.index())) {
                (Some(&place), _) => place,
                (None, Some(&p)) if p.iter().all(|x| x.is_finite()) => {
                    let place = self.add_point(p);
                    self.place.insert(v, place);
                    place
                }
                _ => continue,
            };
            points.push(place);
        }
        if !points.is_empty() {
            self.cells.push(Cell { points, ..cell });
        }
    }
}

fn cells(plc: &Plc, findings: &Findings) -> Cells {
    let mut cells = Cells::default();
    let number = |part: Part| match part {
        Part::Facet(index) => index as i64 + i64::from(plc.first_index),
        _ => -1,
    };
    let simplices = simplices_of_parts(plc);
    for (pair, conflict) in findings.conflicts.iter().enumerate() {
        let cell = |role, facet| Cell {
            points: Vec::new(),
            pair: pair as i64,
            kind: code(&conflict.kind),
            role,
            facet,
        };
        for (role, part) in conflict.parts.into_iter().enumerate() {
            for corners in &simplices[&part] {
                cells.add(plc, corners, cell(role as u8, number(part)));
            }
        }
        let point = cells.add_point(conflict.point);
        let points = vec![point];
        cells.cells.push(Cell {
            points,
            ..cell(2, -1)
        });
    }
    for facet in findings.errors.iter().flat_map(|error| error.facets()) {
        for polygon in &plc.facets[facet].polygons {
            let wrong = Cell {
                points: Vec::new(),
                pair: -1,
                kind: 9,
                role: 0,
                facet: number(Part::Facet(facet)),
            };
            cells.add(plc, polygon, wrong);
        }
    }
    cells
}

/// The number of a kind in the file.
fn code(kind: &Kind) -> u8 {
    match kind {
        Kind::SameFacet => 0,
        Kind::FacetsOverlap => 1,
        Kind::FacetsCross => 2,
        Kind::EdgeInFacet { .. } => 3,
        Kind::EdgesOverlap { .. } => 4,
        Kind::EdgeThroughFacet { .. } => 5,
        Kind::VertexInFacet { .. } => 6,
        Kind::EdgesCross { .. } => 7,
        Kind::VertexOnEdge { .. } => 8,
    }
}

fn write(out: &mut dyn Write, all: &Cells) -> io::Result<()> {
    begin(out, &all.points, all.cells.len())?;

    writeln!(out, "<Cells>")?;
    open(out, r#"type="Int64" Name="connectivity""#)?;
    for cell in &all.cells {
        rows(out, cell.points.iter().map(|&p| [p]))?;
    }
    close(out)?;
    let mut end = 0;
    let ends = all.cells.iter().map(|cell| {
        end += cell.points.len();
        [end]
    });
    array(out, r#"type="Int64" Name="offsets""#, ends)?;
    // Vertex, line, triangle, polygon.
    let types = all.cells.iter().map(|cell| match cell.points.len() {
        1 => [1],
        2 => [3],
        3 => [5],
        _ => [7],
    });
    array(out, r#"type="UInt8" Name="types""#, types)?;
    writeln!(out, "</Cells>")?;

    writeln!(out, r#"<CellData Scalars="kind">"#)?;
    let data = |f: fn(&Cell) -> i64| all.cells.iter().map(move |cell| [f(cell)]);
    array(out, r#"type="Int64" Name="pair""#, data(|c| c.pair))?;
    array(out, r#"type="UInt8" Name="kind""#, data(|c| c.kind.into()))?;
    array(out, r#"type="UInt8" Name="role""#, data(|c| c.role.into()))?;
    array(out, r#"type="Int64" Name="facet""#, data(|c| c.facet))?;
    writeln!(out, "</CellData>")?;
    writeln!(out, "</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}
