//! TetGen as another program (versions 1.5 and 1.6): its switches, its files, and what it says. It gets a PLC in its
//! own format; its mesh is read back. The only place that knows how it is called.

use super::process::Ran;
use crate::exchange::{ExportedMesh, Plc};
use crate::format::{MeshFileError, read_mesh, read_plc, write_poly};
use std::collections::HashSet;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What is asked of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Switches {
    /// Whether there are facets: a CDT, without optimization afterwards; else the Delaunay tetrahedralization of
    /// points.
    pub facets: bool,
    /// Polygons by flips instead of cavities.
    pub flips: bool,
    /// The whole convex hull.
    pub hull: bool,
    /// Facets that are nearly coplanar are merged.
    pub merge: bool,
    /// The mesh is written, and nothing is told; else its figures are told, and nothing is written.
    pub writes: bool,
}

impl Switches {
    /// The CDT of the whole hull by cavities, written.
    pub const CAVITY: Switches = Switches {
        facets: true,
        flips: false,
        hull: true,
        merge: true,
        writes: true,
    };
}

impl fmt::Display for Switches {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letter = |on: bool, letter: &'static str| if on { letter } else { "" };
        f.write_str("-")?;
        if self.facets {
            let (flips, hull) = (letter(self.flips, "L"), letter(self.hull, "c"));
            write!(f, "p{flips}{hull}{}O0", letter(!self.merge, "M"))?;
        }
        f.write_str(if self.writes { "Q" } else { "NEF" })
    }
}

/// Its files in a directory.
#[derive(Clone, Debug)]
pub struct Files {
    input: PathBuf,
}

impl Files {
    /// Writes a PLC for it.
    ///
    /// # Errors
    /// If that is impossible.
    pub fn write(plc: &Plc, directory: &Path) -> Result<Files, MeshFileError> {
        let input = directory.join("model.poly");
        write_poly(&input, plc)?;
        Ok(Files { input })
    }

    /// What it reads.
    pub fn input(&self) -> &Path {
        &self.input
    }

    /// The call of a program, which may be another one that takes the same switches and files.
    pub fn command(&self, program: &Path, switches: &str) -> Command {
        let mut command = Command::new(program);
        command.arg(switches).arg(&self.input);
        command
    }

    /// Whether it has written tetrahedra.
    pub fn has_mesh(&self) -> bool {
        self.output("ele").exists()
    }

    /// The mesh that it has written.
    ///
    /// # Errors
    /// If there is none that can be read.
    pub fn mesh(&self) -> Result<ExportedMesh, MeshFileError> {
        read_mesh(&self.output("node"))
    }

    /// How many vertices of the output are not those of the PLC, if there is an output. Programs write fewer digits
    /// than there are; duplicates and unused vertices of the input may be missing.
    pub fn new_vertices(&self, plc: &Plc) -> Option<usize> {
        let key = |p: &[f64; 3]| p.map(|x| format!("{:.12e}", x + 0.0));
        let known: HashSet<[String; 3]> = plc.vertices.iter().map(key).collect();
        let (written, _) = read_plc(&self.output("node")).ok()?;
        let new = written.vertices.iter().filter(|p| !known.contains(&key(p)));
        Some(new.count())
    }

    fn output(&self, extension: &str) -> PathBuf {
        self.input.with_file_name(format!("model.1.{extension}"))
    }
}

/// What a program tells of a successful run.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Processor time of the algorithm.
    pub seconds: f64,
    /// Of these, for polygons (and TetGen's segments).
    pub polygon_seconds: Option<f64>,
    /// Wall clock of the algorithm.
    pub wall: Option<f64>,
    /// Tetrahedra in the end.
    pub tetrahedra: usize,
    /// New vertices.
    pub steiner_points: Option<usize>,
}

/// What TetGen tells: seconds are of the phases up to the CDT.
pub fn figures(said: &str) -> Option<Figures> {
    let after = |heading| number_after(said, heading);
    let count = |heading| after(heading).map(|n| n as usize);
    let recovery = [
        "Constrained Delaunay seconds:",
        "Boundary recovery seconds:",
    ];
    let recovery: Vec<f64> = recovery.into_iter().filter_map(after).collect();
    let polygons: f64 = recovery.iter().sum();
    let surface = after("Surface mesh seconds:").unwrap_or(0.0);
    Some(Figures {
        seconds: after("Delaunay seconds:")? + surface + polygons,
        polygon_seconds: (!recovery.is_empty()).then_some(polygons),
        wall: None,
        tetrahedra: count("Mesh tetrahedra:")?,
        steiner_points: Some(count("Mesh points:")?.saturating_sub(count("Input points:")?)),
    })
}

/// The number that follows a heading in a text, the first time.
pub fn number_after(text: &str, heading: &str) -> Option<f64> {
    let (_, rest) = text.split_once(heading)?;
    let word = rest.split_whitespace().next()?;
    word.trim_end_matches([',', ')', 's']).parse().ok()
}

/// How a run ended that was no success: the words of the columns `outcome` and `kind` of a survey. Its exit statuses
/// (TetGen
/// 1.5): 1 out of memory, 2 a bug, 3 self-intersection, 4 and 5 features below its tolerance, 10 bad input.
pub fn failure(ran: &Ran) -> (&'static str, String) {
    let Some(status) = ran.status else {
        return ("timeout", String::new());
    };
    match status.code() {
        // Where the program is linked with its library, it stops by an exception that nobody catches.
        None if ran.said.contains("instance of 'int'") => ("gave up", "Stopped".to_owned()),
        None if ran.said.contains("bad_alloc") => ("memory", "OutOfMemory".to_owned()),
        Some(1) => ("memory", "OutOfMemory".to_owned()),
        Some(2) => ("gave up", "InternalError".to_owned()),
        Some(3) => ("invalid", "SelfIntersection".to_owned()),
        Some(4 | 5) => ("gave up", "TooClose".to_owned()),
        Some(10) => ("unreadable", "InputError".to_owned()),
        Some(code) => ("gave up", format!("Exit{code}")),
        None => ("crash", signal_name(status)),
    }
}

/// The signal that ended a process.
#[cfg(unix)]
pub fn signal_name(status: std::process::ExitStatus) -> String {
    use std::os::unix::process::ExitStatusExt;
    match status.signal() {
        Some(4) => "SIGILL".to_owned(),
        Some(6) => "SIGABRT".to_owned(),
        Some(8) => "SIGFPE".to_owned(),
        Some(9) => "SIGKILL".to_owned(),
        Some(11) => "SIGSEGV".to_owned(),
        Some(15) => "SIGTERM".to_owned(),
        Some(signal) => format!("Signal{signal}"),
        None => "Unknown".to_owned(),
    }
}

/// The signal that ended a process: there are none here.
#[cfg(not(unix))]
pub fn signal_name(_status: std::process::ExitStatus) -> String {
    "Unknown".to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn switches_are_letters() {
        assert_eq!(Switches::CAVITY.to_string(), "-pcO0Q");
        let flips = Switches {
            flips: true,
            merge: false,
            hull: false,
            ..Switches::CAVITY
        };
        assert_eq!(flips.to_string(), "-pLMO0Q");
        let points = Switches {
            facets: false,
            writes: false,
            ..Switches::CAVITY
        };
        assert_eq!(points.to_string(), "-NEF");
    }

    #[test]
    fn phases_and_counts() {
        let text = "Delaunay seconds:  0.5\nSurface mesh seconds:  0.25\nConstrained Delaunay seconds:  2\n\
                    Exterior tets removal seconds:  9\n  Input points: 10\n  Mesh points: 12\n  Mesh tetrahedra: 17\n";
        let found = figures(text).expect("a success");
        assert_eq!((found.seconds, found.polygon_seconds), (2.75, Some(2.0)));
        assert_eq!((found.tetrahedra, found.steiner_points), (17, Some(2)));
        assert_eq!(figures(&text[..30]), None);
        let times = "(Wall 2.918s, CPU 0.692431s)";
        assert_eq!(number_after(times, "CPU"), Some(0.692431));
        assert_eq!(
            (number_after(times, "Wall"), number_after(times, "none")),
            (Some(2.918), None)
        );
    }
}
