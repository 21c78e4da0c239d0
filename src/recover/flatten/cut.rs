//! A polygon that is not exactly flat, cut along edges of the Delaunay tetrahedralization into pieces that are.
//!
//! # Why
//! A CDT exists if all segments are edges of the (perturbed) Delaunay tetrahedralization and all polygons are flat. An
//! edge ab of it between two vertices of a polygon f can be declared a segment at no cost. If enough of them divide f
//! into exactly flat pieces, triangles above all, then the pieces are polygons of a PLC that has a CDT in exact
//! arithmetic, and no insertion of theirs meets the troubles of the paper's §3.1 and §3.2. What remains of those is
//! here, where nothing of the mesh has been touched:
//!
//! - Two edges that cross in projection are opposite edges of a shim, or of a pile of shims (tetrahedra with all
//!   vertices on f). Any choice will do that divides f into flat cells: the lower one always, so that f runs below all
//!   shims; the upper one always; or the shorter one first. On the convex hull one of the first two can be a bad
//!   choice: from outside, every edge of the hull is Delaunay, however long, and hides shims across segments.
//! - Where neither diagonal of a quadrilateral is an edge (paper, Fig. 4) a cell remains that is not flat:
//!   [`Cut::bad`].
//!
//! Linear in the stars of f's vertices, but for the sweep over its edges.

use super::cells::{Cell, cells};
use super::crossings::{Crossings, Preference};
use super::figure::Figure;
use super::neighbours::Neighbours;
use crate::mesh::{Incidence, TetMesh};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use crate::recover::segments::Subsegments;

/// A polygon in pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Cut {
    /// The exactly flat pieces.
    pub(super) pieces: Vec<Polygon>,
    /// The cells that are not flat.
    pub(super) bad: Vec<Cell>,
    /// The same as polygons, those that can be.
    pub(super) whole: Vec<Polygon>,
    /// How often a choice between crossing edges was made.
    pub(super) choices: usize,
}

impl Cut {
    /// Whether all cells can be polygons.
    pub(super) fn is_in_pieces(&self) -> bool {
        self.whole.len() == self.bad.len()
    }
}

/// Cuts polygon f, whose figure is given.
pub(super) fn cut<P: PointStore>(
    figure: &Figure<P>,
    f: &Polygon,
    (mesh, incidence, neighbours): (&TetMesh, &Incidence, &mut Neighbours),
    subsegments: &Subsegments,
) -> Cut {
    let points = figure.points;
    let candidates = figure.candidates(mesh, incidence, neighbours, subsegments);
    let crossings = Crossings::new(figure, candidates);
    let preferences = [Preference::Lower, Preference::Upper, Preference::Shorter];
    let mut best: Option<Cut> = None;
    for preference in preferences {
        let accepted = crossings.without(points, preference);
        let mut result = Cut {
            choices: crossings.pairs.len(),
            ..Cut::default()
        };
        for cell in cells(figure, &accepted) {
            match cell.piece(points, &figure.plane, f) {
                Ok(piece) => result.pieces.push(piece),
                Err(cell) => {
                    result.whole.extend(cell.whole(points, &figure.plane, f));
                    result.bad.push(cell);
                }
            }
        }
        let done = result.bad.is_empty() || result.choices == 0;
        if best.as_ref().is_none_or(|b| result.bad.len() < b.bad.len()) {
            best = Some(result);
        }
        if done {
            break;
        }
    }
    best.expect("there is a first one")
}
