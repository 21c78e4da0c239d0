//! PLCs to TetGen's `.poly` format; [`super::read_poly`] reads them back as they were, every double bit by bit.

use super::MeshFileError;
use super::mesh_file::Shortest;
use super::staged::stage;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use std::io::{self, Write};
use std::path::Path;

/// Writes a PLC as a `.poly` file that holds its vertices, too. A floating segment becomes a facet of two vertices.
///
/// # Errors
/// If the file cannot be written; then there is none, or the one that was there before.
pub fn write_poly(path: &Path, plc: &Plc) -> Result<(), MeshFileError> {
    let staged = stage(path.to_path_buf(), |out| poly(out, plc))?;
    staged.publish().map(|_| ())
}

fn poly(out: &mut dyn Write, plc: &Plc) -> io::Result<()> {
    let number = |v: &VertexId| match plc.numbers.get(v.index()) {
        Some(&number) => number,
        None => i64::from(v.0) + i64::from(plc.first_index),
    };
    let (columns, marked) = (plc.attributes.per_vertex, !plc.vertex_markers.is_empty());
    writeln!(
        out,
        "{} 3 {columns} {}",
        plc.vertices.len(),
        u8::from(marked)
    )?;
    for (i, &p) in plc.vertices.iter().enumerate() {
        let v = VertexId::new(i);
        write!(out, "{} {}", number(&v), point(p))?;
        if columns > 0 {
            for &value in plc.attributes.of(v) {
                write!(out, " {}", Shortest(value))?;
            }
        }
        if marked {
            write!(out, " {}", plc.vertex_markers[i])?;
        }
        writeln!(out)?;
    }
    writeln!(out, "{} 1", plc.facets.len() + plc.segments.len())?;
    for facet in &plc.facets {
        let (polygons, holes) = (facet.polygons.len(), facet.holes.len());
        writeln!(out, "{polygons} {holes} {}", facet.marker)?;
        for polygon in &facet.polygons {
            write!(out, "{}", polygon.len())?;
            for v in polygon {
                write!(out, " {}", number(v))?;
            }
            writeln!(out)?;
        }
        for (i, &hole) in (1..).zip(&facet.holes) {
            writeln!(out, "{i} {}", point(hole))?;
        }
    }
    for segment in &plc.segments {
        let [a, b] = segment.ends.each_ref().map(number);
        writeln!(out, "1 0 {}\n2 {a} {b}", segment.marker)?;
    }
    writeln!(out, "{}", plc.holes.len())?;
    for (i, &hole) in (1..).zip(&plc.holes) {
        writeln!(out, "{i} {}", point(hole))?;
    }
    writeln!(out, "{}", plc.regions.len())?;
    for (i, region) in (1..).zip(&plc.regions) {
        let (p, attribute) = (point(region.point), Shortest(region.attribute));
        write!(out, "{i} {p} {attribute}")?;
        if let Some(volume) = region.max_volume {
            write!(out, " {}", Shortest(volume))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn point([x, y, z]: [f64; 3]) -> String {
    format!("{} {} {}", Shortest(x), Shortest(y), Shortest(z))
}
