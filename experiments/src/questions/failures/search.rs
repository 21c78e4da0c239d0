//! Which failures are shown.

use crate::families::Member;
use crate::flips::order::Insertion;
use crate::flips::schoenhardt::Piece;
use crate::frame::Context;
use crate::questions::flip_order::measure::{run, watched};
use std::collections::BTreeMap;
use std::sync::Mutex;
use tetflip::cdt::Cdt;
use tetflip::recover::polygons::{FlipOrder, NumberType};

/// A run that has failed.
pub struct Case {
    /// The input.
    pub member: Member,
    /// The number type.
    pub times: FlipOrder,
    /// How it ended.
    pub outcome: &'static str,
    /// How much is wrong then.
    pub left: usize,
    /// What a stuck run has left.
    pub pieces: Vec<Piece>,
    /// The region in which it happened, the last.
    pub insertion: Insertion,
    /// The vertices, and the tetrahedralization before.
    pub cdt: Cdt,
    /// Whether flips in exact order succeed.
    pub exact_succeeds: bool,
}

/// The number types of the gallery.
const TIMES: [FlipOrder; 2] = [
    FlipOrder::new(NumberType::F64Paper),
    FlipOrder::new(NumberType::F64Plain),
];

/// The paper's failure case, rebuilt.
pub const PAPERS: &str = "prism/end:78";

impl Case {
    /// What the smallest case has the least of.
    fn size(&self) -> (usize, usize, usize, u64) {
        let vertices = self.cdt.complex().representative.len();
        (
            vertices,
            self.insertion.before.len(),
            self.left,
            self.member.seed,
        )
    }
}

/// The paper's case, then the smallest stuck run of each family and number type, in the order of families.
pub fn gallery(seeds: u64, context: &Context) -> Vec<Case> {
    let smallest: Mutex<BTreeMap<(usize, usize), Case>> = Mutex::default();
    context.measure_on_all_processors(&Member::all(seeds), |&member| {
        for (i, times) in TIMES.into_iter().enumerate() {
            let Some(case) = failure(member, times) else {
                continue;
            };
            let key = (member.key().0, i);
            let mut found = smallest.lock().expect("no worker panics");
            let known = found.get(&key).map(|c| (c.size(), c.member.key()));
            if known.is_none_or(|known| (case.size(), case.member.key()) < known) {
                found.insert(key, case);
            }
        }
    });
    let first = failure(
        PAPERS.parse().expect("a name"),
        FlipOrder::new(NumberType::F64Plain),
    );
    let found = smallest.into_inner().expect("no worker panics");
    first.into_iter().chain(found.into_values()).collect()
}

/// The run, if it gets stuck.
fn failure(member: Member, times: FlipOrder) -> Option<Case> {
    let cdt = member.prepare().cdt;
    let (reference, _, _) = watched(&cdt, FlipOrder::EXACT);
    let of_run = run(&cdt, times, reference.as_ref().ok());
    if of_run.outcome != "stuck" {
        return None;
    }
    let (_, _, trace) = watched(&cdt, times);
    Some(Case {
        member,
        times,
        outcome: of_run.outcome,
        left: of_run.left,
        pieces: of_run.pieces,
        insertion: trace.insertions.last()?.clone(),
        cdt,
        exact_succeeds: reference.is_ok(),
    })
}
