//! The scenes of the viewer: small insertions, each with the exact order of flips and with times in doubles, as data.
//!
//! Coordinates are those of the polygon's plane and the height over it, scaled to the picture; heights that could not
//! be seen are drawn too large, and the scene says by how much. This is an affine map, so that what is inside what does
//! not change.

use crate::families::Member;
use crate::inputs::slab::Slab;
use crate::page::film::{Film, Frame, Tet, kind, not_delaunay};
use crate::page::picture::Picture;
use crate::questions::flip_order::measure::{run, watched};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use tetflip::cdt::Cdt;
use tetflip::mesh::VertexId;

use tetflip::exchange::Plc;
use tetflip::predicate::PointStore;
use tetflip::recover::flips::{Fate, FlipKind};
use tetflip::recover::polygons::{FlipOrder, NumberType};
use tetflip::report::Report;

/// Where a scene comes from.
enum Source {
    /// An input of `flip_order`, by its name.
    Member(&'static str),
    /// The scene of the paper's Fig. 8.
    Slab(Slab),
}

/// A scene to be made.
struct Plan {
    source: Source,
    title: &'static str,
    text: &'static str,
}

/// The scenes, the paper's failure case first.
const SCENES: [Plan; 5] = [
    Plan {
        source: Source::Member("prism/end:78"),
        title: "The failure case of the paper (§3.4)",
        text: "A prism over a triangle, its six corners on one sphere up to rounding, and a seventh vertex that sees \
               the polygon, one end of the prism. All flips happen at nearly one time. In f64 the last of seven events \
               comes first; the diagonals of the sides then go around the prism, and the half behind the polygon is \
               Schönhardt’s polyhedron, which has no tetrahedralization.",
    },
    Plan {
        source: Source::Member("lattice/layers:423"),
        title: "A lattice: exact ties",
        text: "Vertices of a lattice of integers: many flip times are exactly equal, and the perturbation of the \
               weights alone puts them in order. Doubles cannot; no crossing tetrahedron is left in the end, but the \
               result is not the CDT.",
    },
    Plan {
        source: Source::Member("sphere/centre:5"),
        title: "A sphere: exact ties",
        text: "Many vertices lie exactly on one sphere, so that many flips have one time, and what doubles tell of \
               their order is noise; the result is not the CDT.",
    },
    Plan {
        source: Source::Member("near-coplanar/tilted:0"),
        title: "Nearly coplanar vertices",
        text: "All vertices are within some units in the last place of the polygon’s plane; the rounded determinants \
               have hardly a correct digit. The flips get stuck.",
    },
    Plan {
        source: Source::Slab(Slab {
            vertices: 30,
            half_height: 0.5,
            seed: 5,
        }),
        title: "Random vertices (Fig. 8)",
        text: "The scene of the paper’s experiment: random vertices on both sides of a rectangle. Times are well \
               apart; both orders end in the CDT.",
    },
];

/// A scene as the viewer reads it. Vertices and tetrahedra are numbers of [`Scene::positions`] and [`Scene::tets`].
#[derive(Clone, Debug, Serialize)]
pub struct Scene {
    name: String,
    title: &'static str,
    text: &'static str,
    vertices: usize,
    /// The numbers of the vertices in the PLC.
    names: Vec<usize>,
    /// For the picture: y is the height over the polygon.
    positions: Vec<[f32; 3]>,
    /// For each vertex 1 (left of the polygon), 0 (on its plane), or −1.
    sides: Vec<i8>,
    polygon: Vec<usize>,
    /// Heights are drawn so many times too large.
    exaggeration: f64,
    tets: Vec<[usize; 4]>,
    before: Vec<usize>,
    runs: [Run; 2],
}

/// One order of the flips.
#[derive(Clone, Debug, Serialize)]
struct Run {
    times: &'static str,
    steps: Vec<Step>,
    end: Vec<usize>,
    outcome: &'static str,
    left: usize,
    /// What stuck flips have left: its class, tetrahedra and vertices.
    pieces: Vec<(&'static str, usize, usize)>,
    /// Triangles that are not locally Delaunay in the end.
    bad: Vec<[usize; 3]>,
}

#[derive(Clone, Debug, Serialize)]
struct Step {
    circuit: [usize; 5],
    fate: &'static str,
    /// 23, 32, 44, or 0 without a flip.
    flip: u8,
    removed: Vec<usize>,
    created: Vec<usize>,
    exact: Option<f64>,
    rounded: Option<[f64; 2]>,
    rank: Option<usize>,
}

/// All scenes.
///
/// # Panics
/// If a scene is not what the viewer can show: one polygon and one missing region. That would be a fault of the list.
pub fn all() -> Vec<Scene> {
    SCENES.iter().map(Plan::make).collect()
}

impl Plan {
    fn make(&self) -> Scene {
        let (name, plc, cdt) = match &self.source {
            Source::Member(name) => {
                let member: Member = name.parse().expect("the name of a member");
                let prepared = member.prepare();
                ((*name).to_string(), prepared.plc, prepared.cdt)
            }
            Source::Slab(slab) => {
                let plc = slab.plc();
                let cdt = Cdt::with_segments(&plc, true, &mut Report::default());
                let name = format!("slab of {} vertices, seed {}", slab.vertices, slab.seed);
                (name, plc, cdt.expect("the slab has a tetrahedralization"))
            }
        };
        self.scene(name, &plc, &cdt)
    }

    fn scene(&self, name: String, plc: &Plc, cdt: &Cdt) -> Scene {
        let one = |times| {
            let mut insertions = watched(cdt, times).2.insertions;
            assert_eq!(insertions.len(), 1, "{name}: one missing region");
            insertions.pop().expect("one")
        };
        let insertions = [FlipOrder::EXACT, FlipOrder::new(NumberType::F64Plain)].map(one);
        let films = insertions.each_ref().map(|i| Film::of(cdt.points(), i));
        assert_eq!(films[0].before, films[1].before, "both begin alike");
        let polygon = &plc.facets[0].polygons[0];
        let numbering = Numbering::of(&films, polygon);
        let picture = Picture::of(
            cdt.points(),
            insertions[0].frame,
            polygon,
            &numbering.vertices,
        );
        let reference = watched(cdt, FlipOrder::EXACT).0.ok();
        let orders = [
            ("exact", FlipOrder::EXACT),
            ("f64:plain", FlipOrder::new(NumberType::F64Plain)),
        ];
        let runs = std::array::from_fn(|i| {
            let (word, times) = orders[i];
            let end = (word, run(cdt, times, reference.as_ref()));
            Run::of(
                &films[i],
                end,
                &numbering,
                cdt.points(),
                insertions[i].frame,
            )
        });
        Scene {
            name,
            title: self.title,
            text: self.text,
            vertices: plc.vertices.len(),
            names: numbering.vertices.iter().map(|v| v.index()).collect(),
            positions: picture.positions,
            sides: picture.sides,
            polygon: polygon.iter().map(|&v| numbering.vertex(v)).collect(),
            exaggeration: picture.exaggeration,
            tets: numbering.tets.iter().map(|t| numbering.all(*t)).collect(),
            before: numbering.numbers(&films[0].before),
            runs,
        }
    }
}

/// The vertices and tetrahedra of a scene, numbered.
struct Numbering {
    vertices: Vec<VertexId>,
    tets: Vec<Tet>,
    numbers: BTreeMap<Tet, usize>,
}

impl Numbering {
    fn of(films: &[Film; 2], polygon: &[VertexId]) -> Numbering {
        let frames = || films.iter().flat_map(|f| &f.frames);
        let tets: BTreeSet<Tet> = films[0]
            .before
            .iter()
            .chain(frames().flat_map(|f| &f.created))
            .copied()
            .collect();
        let circuits = frames().flat_map(|f| f.circuit);
        let vertices: BTreeSet<VertexId> = tets
            .iter()
            .flatten()
            .chain(polygon)
            .copied()
            .chain(circuits)
            .collect();
        let tets: Vec<Tet> = tets.into_iter().collect();
        Numbering {
            vertices: vertices.into_iter().collect(),
            numbers: tets.iter().enumerate().map(|(i, &t)| (t, i)).collect(),
            tets,
        }
    }

    fn vertex(&self, v: VertexId) -> usize {
        self.vertices
            .binary_search(&v)
            .expect("a vertex of the scene")
    }

    fn all<const N: usize>(&self, vertices: [VertexId; N]) -> [usize; N] {
        vertices.map(|v| self.vertex(v))
    }

    fn numbers(&self, tets: &[Tet]) -> Vec<usize> {
        tets.iter().map(|t| self.numbers[t]).collect()
    }
}

impl Run {
    fn of<P: PointStore>(
        film: &Film,
        (times, run): (&'static str, crate::questions::flip_order::measure::Run),
        numbering: &Numbering,
        points: &P,
        frame: [VertexId; 3],
    ) -> Run {
        let bad = match run.outcome {
            "not-delaunay" => not_delaunay(points, frame, &film.end),
            _ => Vec::new(),
        };
        let pieces = run.pieces.iter();
        Run {
            times,
            steps: film.frames.iter().map(|f| Step::of(f, numbering)).collect(),
            end: numbering.numbers(&film.end),
            outcome: run.outcome,
            left: run.left,
            pieces: pieces
                .map(|p| (p.class.name(), p.tets.len(), p.vertices))
                .collect(),
            bad: bad.into_iter().map(|f| numbering.all(f)).collect(),
        }
    }
}

impl Step {
    fn of(frame: &Frame, numbering: &Numbering) -> Step {
        Step {
            circuit: numbering.all(frame.circuit),
            fate: match frame.fate {
                Fate::Flipped(_) => "flipped",
                Fate::Impossible => "postponed",
                Fate::OutsideRegion => "outside",
                Fate::FlippedFromList(_) => "from-list",
                Fate::DroppedFromList => "dropped",
                Fate::FlippedNonCrossing(_) => "non-crossing",
                Fate::Stale => unreachable!("a film leaves them out"),
            },
            flip: match kind(frame.fate) {
                Some(FlipKind::TwoThree) => 23,
                Some(FlipKind::ThreeTwo) => 32,
                Some(FlipKind::FourFour) => 44,
                None => 0,
            },
            removed: numbering.numbers(&frame.removed),
            created: numbering.numbers(&frame.created),
            exact: frame.exact_time,
            rounded: frame.rounded_times,
            rank: frame.rank,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the texts of the scenes say. A change of the rounded queue's details can change how it fails.
    #[test]
    fn scenes_end_as_they_say() {
        let ends: Vec<[&str; 2]> = all()
            .iter()
            .map(|s| s.runs.each_ref().map(|r| r.outcome))
            .collect();
        assert_eq!(
            ends,
            [
                ["ok", "stuck"],
                ["ok", "not-delaunay"],
                ["ok", "not-delaunay"],
                ["ok", "stuck"],
                ["ok", "ok"]
            ]
        );
    }
}
