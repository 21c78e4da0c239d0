//! Which inputs, how often.

use crate::inputs::points::Spread;
use crate::inputs::slab::Slab;
use crate::inputs::suite;
use crate::rivals::contestant::{Contestant, Ours};
use std::collections::HashSet;
use std::error::Error;
use std::path::{Path, PathBuf};
use tetflip::exchange::{Facet, Plc};
use tetflip::format::{read_plc, write_poly};
use tetflip::generate::{Kind as Made, generate};

/// What an input is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Points: the Delaunay tetrahedralization.
    Points {
        /// Whether it is unique.
        generic: bool,
    },
    /// One polygon through random points.
    Scene,
    /// A generated model: the whole CDT.
    Generated,
    /// A model of the user's.
    Model,
    /// Its vertices alone.
    ModelPoints,
}

impl Kind {
    /// The word of tables.
    pub fn word(self) -> &'static str {
        match self {
            Kind::Points { .. } => "points",
            Kind::Scene => "scene",
            Kind::Generated => "generated",
            Kind::Model => "model",
            Kind::ModelPoints => "model points",
        }
    }
}

/// One input.
pub struct Input {
    /// What tables call it.
    pub name: String,
    /// What it is for.
    pub kind: Kind,
    /// How it is made.
    source: Source,
}

enum Source {
    Points(Spread, usize),
    Scene(Slab),
    Generated(Made, usize),
    File(PathBuf),
    PointsOf(PathBuf),
}

/// An input as the programs read it.
pub struct Files {
    /// A `.node` or `.poly` file.
    pub path: PathBuf,
    /// How many vertices it has.
    pub vertices: usize,
    /// How many facets.
    pub facets: usize,
    /// Whether all of them are triangles.
    pub triangles: bool,
}

/// What to run.
pub struct Plan {
    /// In the order of the rows.
    pub inputs: Vec<Input>,
    /// How often each program runs on each.
    pub rounds: usize,
}

/// From how many points on two threads take part, too.
const LARGE: usize = 100_000;

/// The number of points in the comparisons with other programs.
pub const MILLION: usize = 1_000_000;

impl Plan {
    /// Some minutes.
    pub fn full() -> Plan {
        let mut inputs = vec![points(Spread::Cube, MILLION)];
        inputs.extend(Spread::ALL.map(|spread| points(spread, 200_000)));
        inputs.extend([1000, 3000, 10_000, 30_000, 100_000].map(scene));
        inputs.extend(MADE.map(|(kind, size)| generated(kind, size)));
        Plan { inputs, rounds: 5 }
    }

    /// Some seconds.
    pub fn quick() -> Plan {
        let mut inputs: Vec<Input> = Spread::ALL.map(|spread| points(spread, 2000)).into();
        inputs.extend([300, 1000].map(scene));
        inputs.extend(MADE.map(|(kind, size)| generated(kind, size / 20)));
        Plan { inputs, rounds: 1 }
    }

    /// Adds every file of a directory that is a PLC with facets, in order of name: as a model, and its vertices alone.
    ///
    /// # Errors
    /// If the directory cannot be read.
    pub fn add_models(&mut self, directory: &Path) -> Result<(), Box<dyn Error>> {
        for path in suite::files_with_facets(directory)? {
            let name = path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            let of_points = format!("points of {name}");
            self.inputs.push(input(
                of_points,
                Kind::ModelPoints,
                Source::PointsOf(path.clone()),
            ));
            self.inputs
                .push(input(name, Kind::Model, Source::File(path)));
        }
        Ok(())
    }
}

fn input(name: String, kind: Kind, source: Source) -> Input {
    Input { name, kind, source }
}

fn points(spread: Spread, n: usize) -> Input {
    let kind = Kind::Points {
        generic: spread.is_generic(),
    };
    input(
        format!("{}/{n}", spread.word()),
        kind,
        Source::Points(spread, n),
    )
}

/// CAD-like models, and some with many cospherical or coplanar vertices.
const MADE: [(Made, usize); 10] = [
    (Made::Bracket, 4000),
    (Made::Part, 4000),
    (Made::Crankcase, 4000),
    (Made::Maze, 5600),
    (Made::Cheese, 18_000),
    (Made::Gear, 5600),
    (Made::Shaft, 4000),
    (Made::Terrain, 20_000),
    (Made::Sponge, 5000),
    (Made::Sphere, 50_000),
];

fn generated(kind: Made, size: usize) -> Input {
    input(
        format!("{kind}/{size}"),
        Kind::Generated,
        Source::Generated(kind, size),
    )
}

/// The scene of Fig. 8 with about so many crossing tetrahedra.
fn scene(crossing: u64) -> Input {
    input(
        format!("slab/{crossing}"),
        Kind::Scene,
        Source::Scene(Slab::crossing(crossing)),
    )
}

impl Input {
    /// Writes it into a directory.
    ///
    /// # Errors
    /// If that is impossible.
    pub fn write(&self, directory: &Path) -> Result<Files, Box<dyn Error>> {
        let plc = match &self.source {
            Source::Points(spread, n) => Plc {
                vertices: spread.points(*n),
                ..Plc::default()
            },
            Source::Scene(slab) => slab.plc(),
            Source::Generated(kind, size) => generate(*kind, 1, *size),
            Source::File(path) => read_plc(path)?.0,
            Source::PointsOf(path) => Plc {
                vertices: distinct(read_plc(path)?.0.vertices),
                ..Plc::default()
            },
        };
        let path = if plc.facets.is_empty() {
            let path = directory.join("input.node");
            std::fs::write(&path, node(&plc.vertices))?;
            path
        } else {
            let path = directory.join("input.poly");
            write_poly(&path, &plc)?;
            path
        };
        Ok(Files {
            path,
            vertices: plc.vertices.len(),
            facets: plc.facets.len(),
            triangles: plc.facets.iter().all(is_triangle),
        })
    }

    /// Whether a program takes part.
    pub fn is_for(&self, contestant: &Contestant, files: &Files) -> bool {
        let vertices = files.vertices;
        let points = matches!(self.kind, Kind::Points { .. } | Kind::ModelPoints);
        match contestant {
            // What two threads gain shows on the largest inputs.
            Contestant::Ours(Ours::Delaunay | Ours::Verifier, 2..) if vertices < LARGE => false,
            Contestant::Ours(Ours::Delaunay, _) => points,
            // Most of its time goes into numbers for Python and back.
            Contestant::Hxt { threads, .. } => {
                self.name.starts_with("uniform/") && (*threads == 1 || vertices >= MILLION)
            }
            Contestant::Ours(Ours::Cavity | Ours::Flips, _) => !points,
            Contestant::Ours(Ours::Verifier, _) => {
                vertices < MILLION && self.kind != Kind::ModelPoints
            }
            Contestant::TetGen { .. } => true,
            Contestant::TetGen16 { .. } => files.triangles,
        }
    }
}

fn is_triangle(facet: &Facet) -> bool {
    matches!(&facet.polygons[..], [polygon] if polygon.len() == 3) && facet.holes.is_empty()
}

/// Each point once, in the order of the first ones.
fn distinct(points: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    let mut known = HashSet::new();
    // −0 is 0.
    let is_new = |p: &[f64; 3]| known.insert(p.map(|x| (x + 0.0).to_bits()));
    points.into_iter().filter(is_new).collect()
}

fn node(points: &[[f64; 3]]) -> String {
    use std::fmt::Write;
    let mut text = format!("{} 3 0 0\n", points.len());
    for (i, [x, y, z]) in points.iter().enumerate() {
        let _ = writeln!(text, "{i} {x:?} {y:?} {z:?}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_models_are_distinct() {
        let points = vec![[0.0, 1.0, 2.0], [3.0; 3], [-0.0, 1.0, 2.0], [3.0, 3.0, 4.0]];
        let kept = [points[0], points[1], points[3]];
        assert_eq!(distinct(points), kept);
    }

    #[test]
    fn what_is_written_is_read() {
        let directory = tempfile::TempDir::new().expect("a directory");
        for input in Plan::quick().inputs {
            let files = input.write(directory.path()).expect("written");
            let (plc, _) = read_plc(&files.path).expect("a file");
            assert_eq!(plc.vertices.len(), files.vertices, "{}", input.name);
            assert_eq!(plc.facets.len(), files.facets);
            assert_eq!(plc.facets.is_empty(), input.kind.word() == "points");
        }
    }
}
