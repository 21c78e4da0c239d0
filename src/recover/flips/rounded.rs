//! Flip times as rounded quotients: the paper's own method, which can fail.

use super::filter::{Filter, LiftedTet};
use super::motion::{Motion, Rates};
use super::time::{FlipTimes, Float, Timed, Timing, Undecided};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Sign};
use crate::predicate::PointStore;
use std::cmp::Ordering;

/// Times as rounded quotients, ties in order of arrival. The sign of D is exact, as in the paper, whose Orient4D is exact
/// in every mode.
pub struct RoundedTimes<'a, P, N> {
    filter: Filter<'a, P>,
    exact: Rates<'a, P, Dyadic>,
    rates: Rates<'a, P, N>,
    /// Times discarded because the quotient was not finite.
    overflows: u64,
}

impl<'a, P: PointStore, N: Float> RoundedTimes<'a, P, N> {
    /// For the given motion.
    pub fn new(motion: &'a Motion<'a, P>) -> Self {
        RoundedTimes {
            filter: Filter::new(motion),
            exact: Rates::new(motion),
            rates: Rates::new(motion),
            overflows: 0,
        }
    }
}

impl<P: PointStore, N: Float> FlipTimes for RoundedTimes<'_, P, N> {
    type Key = f64;
    type Time = N;
    const EXACT: bool = false;

    type Lift = LiftedTet;

    #[inline]
    fn lift(&mut self, tet: [VertexId; 4]) -> LiftedTet {
        self.filter.lift(tet)
    }

    #[inline]
    fn time_across(
        &mut self,
        lift: &mut LiftedTet,
        circuit: [VertexId; 5],
    ) -> Option<Timing<f64, N>> {
        let evaluated = self.filter.evaluate_across(lift, circuit[4])?;
        if evaluated.d.sign_on_grid(0.0) != Some(Sign::Positive)
            && !self.exact.evaluate(circuit).1.exact_sign().is_positive()
        {
            return None;
        }
        // The filter's values are what plain doubles give: the same operations in the same order, the origin apart.
        let in_doubles = N::from_doubles(evaluated.n.value(), evaluated.d.value());
        let (n, d) = in_doubles.unwrap_or_else(|| self.rates.evaluate(circuit));
        let time = N::negated_quotient(&n, &d);
        let key = time.to_f64();
        if !key.is_finite() {
            self.overflows += 1;
            return None;
        }
        // What is possible is asked when the time has come.
        let signs = [None; 3];
        Some(Timing { key, time, signs })
    }

    #[inline]
    fn compare_keys(a: f64, b: f64) -> Option<Ordering> {
        Some(a.total_cmp(&b)).filter(|o| o.is_ne())
    }

    fn compare(&mut self, a: Timed<N>, b: Timed<N>) -> Ordering {
        a.1.compare(b.1)
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            overflows: self.overflows,
            ..Undecided::default()
        }
    }
}
