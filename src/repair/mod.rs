//! What is exactly repairable in an input is repaired, with a note: between the PLC as it was given and
//! [`Complex`](crate::plc::Complex).
//!
//! | file | what is repaired |
//! |---|---|
//! | `alone` | repeated corners; facets, polygons and segments without area or length; corners of a facet on its own
//! edges |
//! | `merged` | coplanar facets that intersect others are merged first, so that the edges between them count for
//! nothing |
//! | `edges` | vertices exactly on edges that do not have them |
//! | `inside` | vertices and edges exactly inside facets that do not have them |
//! | `overlaps` | coplanar facets that overlap, or are equal |
//!
//! Two more repairs come before these, only where the coordinates are not exact
//! ([`Precision`](crate::exchange::Precision)):
//! `weld` moves vertices that are one to the precision to the first of them, and `divide` makes triangles of facets
//! that are farther from flat. They are asked for by whoever makes a mesh, and are no part of [`repair`].
//!
//! In all the others no vertex moves and none is made; all decisions are exact. Where facets cross, or coplanar facets
//! overlap so that their edges cross where there is no vertex, the input is refused. What comes out has been checked
//! once more.
//!
//! A facet without area claims nothing: it is dropped with its edges, except the two-vertex polygons in it, which are
//! segments. Facets that are the same, or overlap, are one where they do, with the smallest marker of theirs that is
//! not 0;
//! [`Plc::origins`] knows all the facets that it comes from.
//!
//! The cost is that of one search for contacts (see [`crate::check`]) if there are none, and of three if there are.

mod alone;
mod areas;
mod divide;
mod draft;
mod edges;
mod inside;
mod merged;
mod notes;
mod overlaps;
#[cfg(test)]
mod tests;
mod weld;

use crate::check::{Findings, Part, Parts, check_to, contacts, crossing_findings};
use crate::exchange::{Note, Plc, Segment};
use crate::mesh::TetMesh;
use crate::plc::PlcError;

pub use divide::divide;
pub use weld::{Refusal, Welding};

use draft::Draft;
use notes::Repairs;
use std::borrow::Cow;

/// What is allowed to be repaired.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RepairOptions {
    /// Nothing is: what would have to be repaired is refused.
    pub strict: bool,
    /// Coplanar facets are merged later on ([`Complex::new`](crate::plc::Complex::new)), so that the edges between them
    /// may cross others.
    pub merge_coplanar: bool,
    /// The precision of the input: vertices within this distance of the plane of their facet, along each axis, are on
    /// it.
    pub delta: f64,
}

impl Default for RepairOptions {
    fn default() -> RepairOptions {
        RepairOptions {
            strict: false,
            merge_coplanar: true,
            delta: 0.0,
        }
    }
}

/// A valid PLC with the same vertices.
#[derive(Clone, PartialEq, Debug)]
pub struct Repaired<'a> {
    /// The PLC; borrowed, the input itself, if there was nothing to repair.
    pub plc: Cow<'a, Plc>,
    /// What has been repaired.
    pub notes: Vec<Note>,
}

/// Why an input cannot be repaired.
enum Refused {
    /// One facet, for itself.
    Facet(PlcError),
    /// Something needs a new vertex.
    NeedsVertex,
}

impl From<PlcError> for Refused {
    fn from(error: PlcError) -> Refused {
        Refused::Facet(error)
    }
}

/// Checks a PLC, and repairs it if that is necessary and allowed.
///
/// # Errors
/// What is wrong with it, at most [`LISTED`] conflicts of it: those that cannot be repaired, or, if `strict`, any.
pub fn repair(plc: &Plc, options: RepairOptions) -> Result<Repaired<'_>, Box<Findings>> {
    repair_beside(plc, options, None)
}

/// [`repair`] with the Delaunay tetrahedralization of all different vertices, if it is there already. Facets that are
/// faces of it do not intersect each other, so that only the others are looked at closely: much faster. The result is
/// the same.
///
/// # Errors
/// The same.
pub fn repair_beside<'p>(
    plc: &'p Plc,
    options: RepairOptions,
    delaunay: Option<&TetMesh>,
) -> Result<Repaired<'p>, Box<Findings>> {
    let parts = Parts::new(plc, options.delta);
    let is_final = |error: &PlcError| options.strict || !error.is_repairable();
    if parts.errors.iter().any(is_final) {
        let mut errors = parts.errors;
        errors.retain(is_final);
        return Err(alone_wrong(errors));
    }
    let mut repairs = Repairs::default();
    let mut draft = None;
    let mut parts = parts;
    if !parts.errors.is_empty() {
        let mended = alone::mend(plc, &parts, &mut repairs);
        let mended = mended.map_err(|error| alone_wrong(vec![error]))?;
        parts = Parts::new(&mended.plc, options.delta);
        draft = Some(mended);
    }
    let current = draft.as_ref().map_or(plc, |draft| &draft.plc);
    let found = contacts(current, &parts, options.merge_coplanar, LISTED, delaunay);
    let found = match found {
        Ok(found) => found,
        Err(pairs) => return Err(needing_vertex(plc, current, &parts, &pairs)),
    };
    if found.pairs.is_empty() {
        let plc = draft.map_or(Cow::Borrowed(plc), |draft| Cow::Owned(draft.plc));
        let notes = repairs.notes();
        return Ok(Repaired { plc, notes });
    }
    if options.strict {
        return Err(Box::new(check_to(plc, Some(LISTED), options.delta)));
    }
    let before = draft.as_ref().map(|draft| draft.plc.clone());
    let mut draft = draft.unwrap_or_else(|| Draft::of(plc, options.delta));
    match contacts_resolved(&mut draft, parts, found, options, delaunay, &mut repairs) {
        Ok(()) => Ok(Repaired {
            plc: Cow::Owned(draft.plc),
            notes: repairs.notes(),
        }),
        Err(Refused::Facet(error)) => Err(alone_wrong(vec![error])),
        Err(Refused::NeedsVertex) => {
            let before = before.as_ref().unwrap_or(plc);
            Err(needing_vertex(
                plc,
                before,
                &Parts::new(before, options.delta),
                &[],
            ))
        }
    }
}

/// How many conflicts a refusal lists at most.
#[doc(hidden)]
pub const LISTED: usize = 8;

/// Repairs contacts of different parts.
fn contacts_resolved(
    draft: &mut Draft,
    mut parts: Parts,
    mut found: crate::check::Contacts,
    options: RepairOptions,
    delaunay: Option<&TetMesh>,
    repairs: &mut Repairs,
) -> Result<(), Refused> {
    if options.merge_coplanar && merged::merge(draft, &parts, &found)? {
        parts = Parts::new(&draft.plc, options.delta);
        let again = contacts(&draft.plc, &parts, true, 1, delaunay);
        found = again.map_err(|_| Refused::NeedsVertex)?;
    }
    edges::divide(draft, &parts, &found, repairs);
    inside::complete(draft, &parts, &found, repairs)?;
    overlaps::divide(draft, &parts, &found, repairs)?;
    let parts = Parts::new(&draft.plc, options.delta);
    if let Some(error) = parts.errors.first() {
        return Err(Refused::Facet(error.clone()));
    }
    match contacts(&draft.plc, &parts, options.merge_coplanar, 1, delaunay) {
        Ok(left) if left.pairs.is_empty() => Ok(()),
        _ => Err(Refused::NeedsVertex),
    }
}

/// The findings when facets are wrong for themselves: nothing else has been looked for.
fn alone_wrong(errors: Vec<PlcError>) -> Box<Findings> {
    Box::new(Findings {
        errors,
        stopped: true,
        ..Findings::default()
    })
}

/// The findings when parts of a PLC, whose facets are valid for themselves, intersect so that a new vertex would be
/// needed: these `pairs` or, if there are none, what the check says.
fn needing_vertex(input: &Plc, plc: &Plc, parts: &Parts, pairs: &[[u32; 2]]) -> Box<Findings> {
    let mut found = crossing_findings(plc, parts, pairs, pairs.len() >= LISTED);
    if pairs.is_empty() {
        // What remained after the repair does not show in single contacts.
        found = check_to(plc, None, parts.delta);
        if found.conflicts.iter().any(|c| !c.repairable) {
            found.conflicts.retain(|c| !c.repairable);
        }
        found.stopped = found.conflicts.len() > LISTED;
        found.conflicts.truncate(LISTED);
    }
    // Dropping what is degenerate has changed the places of what is left.
    let ends = |segments: &[Segment], i: usize| segments[i].ends;
    let part = |part: Part| match part {
        Part::Facet(i) => Part::Facet(plc.origins.get(i).map_or(i, |from| from[0])),
        Part::Segment(i) => {
            let mut own = 0..input.segments.len();
            let wanted = ends(&plc.segments, i);
            let place = own.find(|&k| ends(&input.segments, k) == wanted);
            Part::Segment(place.expect("segments are dropped only"))
        }
        Part::Vertex(v) => Part::Vertex(v),
    };
    for conflict in &mut found.conflicts {
        conflict.repairable = false;
        conflict.parts = conflict.parts.map(part);
    }
    Box::new(found)
}
