//! The insertion of all polygons of one model with one arm, which goes on after a failure: a region that the arm cannot
//! insert is restored and inserted in exact order. So the arm meets every missing region, in the state of the mesh in
//! which a run would meet it that has not failed before.

use crate::flips::order::{Trace, disorder};
use crate::measure::outcome;
use std::cell::RefCell;
use std::collections::HashMap;
use tetflip::mesh::{TetId, TetMesh, VertexId};
use tetflip::predicate::PointStore;
use tetflip::recover::flips::{
    FlipCounts, FlipObserver, FlipOutcome, FlipRegion, FlipScratch, Flipped,
};
use tetflip::recover::polygons::FlipOrder;
use tetflip::recover::region::{Region, Sides};

/// Tetrahedra by their vertices, sorted, in an order that depends on them alone.
type Tets = Vec<[VertexId; 4]>;

fn sorted(mut tets: Tets) -> Tets {
    tets.iter_mut().for_each(|t| t.sort_unstable());
    tets.sort_unstable();
    tets
}

fn vertices(mesh: &TetMesh, tets: &[TetId]) -> Tets {
    tets.iter().map(|&t| mesh.vertices(t)).collect()
}

/// What the exact order makes of a region, and how many ties it has.
#[derive(Clone, Debug)]
struct Known {
    after: Tets,
    exact_ties: u64,
    circuit_ties: u64,
}

/// The exact order, which takes notes: of each region by the tetrahedra that fill it before.
#[derive(Default)]
pub struct Reference {
    known: RefCell<HashMap<Tets, Known>>,
    flat: RefCell<u64>,
}

impl Reference {
    /// How many regions were of polygons that are exactly flat. No order is proved to succeed in others, and none is
    /// tried there.
    pub fn flat(&self) -> u64 {
        *self.flat.borrow()
    }
}

impl<P: PointStore> FlipRegion<P> for Reference {
    fn is_exact(&self) -> bool {
        true
    }

    fn is_naive(&self) -> bool {
        false
    }

    fn insert(
        &self,
        mesh: &mut TetMesh,
        sides: &Sides<P>,
        region: &Region,
        scratch: &mut FlipScratch,
        _: Option<&mut dyn FlipObserver>,
    ) -> Flipped {
        if !sides.flat {
            return FlipOrder::FILTERED.insert(mesh, sides, region, scratch, None);
        }
        *self.flat.borrow_mut() += 1;
        let before = vertices(mesh, &region.tets);
        let mut trace = Trace::default();
        trace.begin(0, sides.frame, &before);
        let flipped = FlipOrder::FILTERED.insert(mesh, sides, region, scratch, Some(&mut trace));
        let ties = disorder(sides.points(), &trace.insertions[0], FlipOrder::FILTERED);
        let known = Known {
            after: sorted(vertices(mesh, &flipped.tets)),
            exact_ties: ties.exact_ties,
            circuit_ties: ties.circuit_ties,
        };
        self.known.borrow_mut().insert(sorted(before), known);
        flipped
    }
}

/// What one arm made of one region.
#[derive(Clone, Debug)]
pub struct Seen {
    /// Events of the exact order that the perturbation alone tells from another.
    pub exact_ties: u64,
    /// Triangles whose event is one with that of another triangle.
    pub circuit_ties: u64,
    /// How it ended.
    pub outcome: &'static str,
    /// What the flips were.
    pub counts: FlipCounts,
}

impl Seen {
    /// Whether the tetrahedra are those of the exact order.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// Whether any of the patches was needed.
    pub fn is_patched(&self) -> bool {
        self.counts.discarded_outside + self.counts.non_crossing + self.counts.postponed > 0
    }
}

/// One arm on all regions of a model.
pub struct Trial<'a> {
    order: FlipOrder,
    reference: &'a Reference,
    seen: RefCell<Vec<Seen>>,
}

impl<'a> Trial<'a> {
    /// Beside a reference that has inserted all polygons of the same model.
    pub fn new(order: FlipOrder, reference: &'a Reference) -> Trial<'a> {
        Trial {
            order,
            reference,
            seen: RefCell::default(),
        }
    }

    /// All regions, in the order of their insertion.
    pub fn into_seen(self) -> Vec<Seen> {
        self.seen.into_inner()
    }
}

impl<P: PointStore> FlipRegion<P> for Trial<'_> {
    // What it leaves behind is the exact order's.
    fn is_exact(&self) -> bool {
        true
    }

    fn is_naive(&self) -> bool {
        false
    }

    fn insert(
        &self,
        mesh: &mut TetMesh,
        sides: &Sides<P>,
        region: &Region,
        scratch: &mut FlipScratch,
        _: Option<&mut dyn FlipObserver>,
    ) -> Flipped {
        if !sides.flat {
            return FlipOrder::FILTERED.insert(mesh, sides, region, scratch, None);
        }
        let before = vertices(mesh, &region.tets);
        let known = self.reference.known.borrow();
        let known = known
            .get(&sorted(before.clone()))
            .expect("a CDT is unique, and so are the regions");
        let flipped = self.order.insert(mesh, sides, region, scratch, None);
        let is_right = sorted(vertices(mesh, &flipped.tets)) == known.after;
        let outcome = match flipped.outcome {
            _ if is_right => outcome::OK,
            FlipOutcome::Done => "not-delaunay",
            FlipOutcome::Stuck { .. } => "stuck",
            FlipOutcome::Impossible => "flip-order",
            FlipOutcome::Endless => "endless",
        };
        self.seen.borrow_mut().push(Seen {
            exact_ties: known.exact_ties,
            circuit_ties: known.circuit_ties,
            outcome,
            counts: flipped.counts,
        });
        if is_right {
            return flipped;
        }
        let mut restored = mesh.replace(&flipped.tets, &before);
        restored.sort_unstable();
        FlipOrder::FILTERED.insert(mesh, sides, &Region::of(restored), scratch, None)
    }
}
