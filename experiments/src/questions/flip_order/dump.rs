//! One input as numbers, so that anybody can recompute what an arm does: all doubles as hexadecimal floats.

use super::measure::watched;
use crate::families::Member;
use crate::flips::order::{Insertion, is_left, popped_alive};
use crate::frame::Failed;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use tetflip::mesh::VertexId;
use tetflip::number::{Dyadic, Number};
use tetflip::predicate::{DoublePoints, PointStore};
use tetflip::recover::flips::{Evaluation, ExactTimes, PolygonMotion, RoundedTimes, Rules};
use tetflip::recover::polygons::FlipOrder;

/// Writes `vertices.csv` (number, identity in the perturbation, coordinates, Steiner points included), `polygons.csv`
/// (their corners) and for each region that is inserted in exact order `region-K.csv` (its tetrahedra) and
/// `events-K.csv` (each event that came off the queue alive, with N and D as each arm in doubles evaluates them).
///
/// # Errors
/// If a file cannot be written.
pub fn dump(member: Member, directory: &Path) -> Result<Vec<PathBuf>, Failed> {
    fs::create_dir_all(directory)?;
    let prepared = member.prepare();
    let points = prepared.cdt.points();
    let mut files = Vec::new();
    let mut write = |name: String, text: String| -> Result<(), Failed> {
        let path = directory.join(name);
        fs::write(&path, text)?;
        files.push(path);
        Ok(())
    };
    let mut text = "vertex,identity,x,y,z\n".to_string();
    for v in (0..points.len()).map(VertexId::new) {
        let [x, y, z] = points.rounded(v).map(hexadecimal);
        writeln!(text, "{v},{},{x},{y},{z}", points.identity(v))?;
    }
    write("vertices.csv".to_string(), text)?;
    let mut text = "polygon,corner,vertex\n".to_string();
    for (polygon, facet) in prepared.plc.facets.iter().enumerate() {
        for (corner, v) in facet.polygons.iter().flatten().enumerate() {
            writeln!(text, "{polygon},{corner},{v}")?;
        }
    }
    write("polygons.csv".to_string(), text)?;
    let (_, _, trace) = watched(&prepared.cdt, FlipOrder::EXACT);
    for (k, insertion) in trace.insertions.iter().enumerate() {
        let mut text = "a,b,c,d\n".to_string();
        for [a, b, c, d] in &insertion.before {
            writeln!(text, "{a},{b},{c},{d}")?;
        }
        write(format!("region-{k}.csv"), text)?;
        write(format!("events-{k}.csv"), events(points, insertion)?)?;
    }
    Ok(files)
}

/// Frame and polygon are the same in all rows. (The rounding of `plain` depends on the order of the tetrahedron's
/// vertices; here it is v, x, y, z, in the mesh it need not be.)
fn events(points: &DoublePoints, insertion: &Insertion) -> Result<String, Failed> {
    let left = |v| is_left(points, insertion.frame, v);
    let motion = PolygonMotion::new(points, insertion.frame, &left);
    let mut exact = ExactTimes::<_, Dyadic>::new(&motion);
    let arms = [
        ("once", Evaluation::Once),
        ("paper", Evaluation::Paper),
        ("tetgen", Evaluation::TetGen),
        ("plain", Evaluation::Plain),
    ];
    let mut text = "polygon,frame_a,frame_b,frame_c,v,x,y,z,w,exact_sign_of_d".to_string();
    for (name, _) in arms {
        write!(text, ",{name}_n,{name}_d")?;
    }
    text += "\n";
    let mut times = arms.map(|(_, e)| RoundedTimes::<_, f64>::new(&motion, e, Rules::default()));
    let [a, b, c] = insertion.frame;
    for circuit in popped_alive(insertion) {
        let [v, x, y, z, w] = circuit;
        let rises = exact.quotient(circuit).is_some();
        let sign = if rises { "+" } else { "not +" };
        write!(
            text,
            "{},{a},{b},{c},{v},{x},{y},{z},{w},{sign}",
            insertion.polygon
        )?;
        for times in &mut times {
            match times.parts(circuit) {
                Some((n, d)) => write!(text, ",{},{}", hexadecimal(n), hexadecimal(d))?,
                None => text += ",,",
            }
        }
        text += "\n";
    }
    Ok(text)
}

/// A finite double as C's `%a` writes it.
fn hexadecimal(x: f64) -> String {
    let bits = x.to_f64().to_bits();
    let sign = if bits >> 63 == 1 { "-" } else { "" };
    let (biased, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
    match (biased, fraction) {
        (0, 0) => format!("{sign}0x0p+0"),
        (0, _) => format!("{sign}0x0.{fraction:013x}p-1022"),
        _ => format!("{sign}0x1.{fraction:013x}p{:+}", biased - 1023),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_written_as_c_does() {
        let written = [1.0, -0.1, 0.0, 5e-324, 3.0 * 2f64.powi(100)].map(hexadecimal);
        let expected = [
            "0x1.0000000000000p+0",
            "-0x1.999999999999ap-4",
            "0x0p+0",
            "0x0.0000000000001p-1022",
            "0x1.8000000000000p+101",
        ];
        assert_eq!(written, expected);
    }

    #[test]
    fn a_dump_has_all_events_with_their_parts() {
        let directory = tempfile::TempDir::new().expect("a directory");
        let member = "prism/end:78".parse().expect("a name");
        let files = dump(member, directory.path()).expect("a writable directory");
        assert_eq!(files.len(), 4);
        let events = fs::read_to_string(&files[3]).expect("written");
        let mut lines = events.lines();
        let columns = lines.next().expect("a header").split(',').count();
        let rows: Vec<&str> = lines.collect();
        assert_eq!((columns, rows.len()), (18, 3), "three flips: {events}");
        assert!(
            rows.iter()
                .all(|r| r.split(',').count() == 18 && r.contains(",+,"))
        );
    }
}
