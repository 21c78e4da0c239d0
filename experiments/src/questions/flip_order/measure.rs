//! One input, with every arm.

use super::plan::Plan;
use crate::families::{Member, Prepared};
use crate::flips::order::{Disorder, Trace, disorder};
use crate::flips::schoenhardt::{Class, Piece, pieces_left};
use crate::measure::outcome;
use tetflip::cdt::Cdt;
use tetflip::error::Failure;
use tetflip::mesh::VertexId;
use tetflip::recover::flips::FlipCounts;
use tetflip::recover::polygons::{FlipOrder, Insertion, PolygonCounts};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// The tetrahedra of a mesh, by their vertices, in an order that depends on them alone.
pub type Tets = Vec<[VertexId; 4]>;

/// The word for a run that ended in other tetrahedra than those of the exact order, without noticing. There should be
/// none.
pub const DIFFERENT: &str = "different";

/// The insertion of all polygons of one input with one number type.
#[derive(Clone, Debug)]
pub struct Run {
    /// The number type.
    pub times: FlipOrder,
    /// `ok`: the tetrahedra of the CDT. Otherwise [`DIFFERENT`], or the kind of failure.
    pub outcome: &'static str,
    /// How much is wrong then: see [`outcome::left`].
    pub left: usize,
    /// What the flips were, also before a failure.
    pub counts: FlipCounts,
    /// Of all regions together.
    pub disorder: Disorder,
    /// What a stuck run has left.
    pub pieces: Vec<Piece>,
}

impl Run {
    /// The worst class of what a stuck run has left.
    pub fn class(&self) -> Option<Class> {
        self.pieces.first().map(|p| p.class)
    }

    /// Whether it ended in the CDT.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }
}

/// One input and all runs on it.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Which input.
    pub member: Member,
    /// Vertices of the PLC.
    pub vertices: usize,
    /// Polygons.
    pub polygons: usize,
    /// Steiner points on segments.
    pub steiner_points: usize,
    /// What exact flips inserted.
    pub counts: PolygonCounts,
    /// Whether cavity retriangulation ended in the same tetrahedra as exact flips.
    pub cavity_agrees: bool,
    /// Whether gift wrapping did.
    pub gift_wrap_agrees: bool,
    /// Whether the verifier found them to be the CDT; none if this input is not in its sample.
    pub verified: Option<bool>,
    /// The runs, in the order of the plan.
    pub runs: Vec<Run>,
}

impl Measured {
    /// Events of the exact order that the perturbation alone tells from another.
    pub fn exact_ties(&self) -> u64 {
        let exact = self.runs.iter().find(|run| run.times == FlipOrder::EXACT);
        exact.map_or(0, |run| run.disorder.exact_ties)
    }

    /// Whether there are any.
    pub fn has_exact_ties(&self) -> bool {
        self.exact_ties() > 0
    }
}

/// Runs one input.
pub fn measure(member: Member, plan: &Plan) -> Measured {
    let prepared = member.prepare();
    let reference = tets_by(&prepared.cdt, Insertion::Flip(FlipOrder::EXACT));
    let expected = reference.as_ref().ok().map(|(tets, _)| tets);
    let arms = plan
        .arms
        .iter()
        .filter(|a| member.is_among_first(a.per_family));
    let agrees = |insertion| {
        let result = tets_by(&prepared.cdt, insertion);
        result.is_ok_and(|(tets, _)| Some(&tets) == expected)
    };
    let sampled = member.seed.is_multiple_of(plan.verify_every);
    Measured {
        member,
        vertices: prepared.plc.vertices.len(),
        polygons: prepared.plc.facets.len(),
        steiner_points: prepared.steiner_points,
        counts: reference.as_ref().map(|(_, c)| *c).unwrap_or_default(),
        cavity_agrees: agrees(Insertion::Cavity),
        gift_wrap_agrees: agrees(Insertion::GiftWrap),
        verified: sampled.then(|| is_cdt(&prepared)),
        runs: arms
            .map(|a| run(&prepared.cdt, a.order, expected))
            .collect(),
    }
}

fn tets_by(cdt: &Cdt, insertion: Insertion) -> Result<(Tets, PolygonCounts), Failure> {
    let mut cdt = cdt.clone();
    let counts = cdt.insert_polygons(insertion, &mut Report::default(), &mut |_| ())?;
    Ok((sorted_tets(&cdt), counts))
}

fn sorted_tets(cdt: &Cdt) -> Tets {
    let sorted = cdt.mesh().finite().map(|t| {
        let mut v = cdt.mesh().vertices(t);
        v.sort_unstable();
        v
    });
    let mut tets: Tets = sorted.collect();
    tets.sort_unstable();
    tets
}

/// A watched run: its outcome and what happened.
pub fn watched(cdt: &Cdt, times: FlipOrder) -> (Result<Tets, Failure>, FlipCounts, Trace) {
    let (mut cdt, mut report, mut trace) = (cdt.clone(), Report::default(), Trace::default());
    let insertion = Insertion::Flip(times);
    let result =
        cdt.insert_polygons_observed(insertion, &mut report, &mut |_| (), Some(&mut trace));
    let tets = result.map(|_| sorted_tets(&cdt));
    (tets, report.insertion_counts.flips, trace)
}

/// One run, compared with the expected tetrahedra.
pub fn run(cdt: &Cdt, times: FlipOrder, expected: Option<&Tets>) -> Run {
    let (result, counts, trace) = watched(cdt, times);
    let mut total = Disorder {
        rounded_ties: Some(0),
        ..Disorder::default()
    };
    for insertion in &trace.insertions {
        total.add(&disorder(cdt.points(), insertion, times));
    }
    let outcome = match &result {
        Ok(tets) if Some(tets) != expected => DIFFERENT,
        other => outcome::word(other),
    };
    let is_stuck = outcome == "stuck";
    let last = trace.insertions.last().filter(|_| is_stuck);
    Run {
        times,
        outcome,
        left: outcome::left(&result),
        counts,
        disorder: total,
        pieces: last.map_or(Vec::new(), |i| pieces_left(cdt.points(), i)),
    }
}

/// The exact and independent verdict on the exact result: the CDT in the convex hull. Nothing is forgiven, unless
/// rounded Steiner points need it.
fn is_cdt(prepared: &Prepared) -> bool {
    let (mut cdt, mut report) = (prepared.cdt.clone(), Report::default());
    let insertion = Insertion::Flip(FlipOrder::EXACT);
    let inserted = cdt.insert_polygons(insertion, &mut report, &mut |_| ());
    let exported = inserted.and_then(|_| cdt.export(&prepared.plc, true, &mut report));
    let mut options = VerifyOptions {
        domain: Domain::Hull,
        ..VerifyOptions::default()
    };
    if prepared.steiner_points == 0 {
        options.tolerance = 0.0;
    }
    exported.is_ok_and(|mesh| verify(&prepared.plc, &mesh, options).is_ok())
}

/// Whether what one run shows of an input breaks what is expected of its number type.
pub fn is_broken(run: &Run) -> bool {
    let disorder = &run.disorder;
    let patches = [
        run.counts.postponed,
        run.counts.discarded_outside,
        run.counts.non_crossing,
        run.counts.overflows,
        disorder.kendall,
        disorder.unfounded,
    ];
    run.times.is_exact() && (!run.is_ok() || patches != [0; 6])
}
