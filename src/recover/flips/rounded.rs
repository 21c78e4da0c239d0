//! Flip times as rounded quotients: the paper's own method, which can fail.

use super::filter::{Filter, LiftedTet};
use super::motion::{Motion, Rates};
use super::time::{FlipTimes, Timed, Timing, Undecided};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Float, Sign};
use crate::predicate::PointStore;
use std::cmp::Ordering;

/// Times as rounded quotients, ties in order of arrival.
pub struct RoundedTimes<'a, P, N> {
    filter: Filter<'a, P>,
    exact: Rates<'a, P, Dyadic>,
    rates: Rates<'a, P, N>,
    /// Whether the sign of D is that of the rounded D, right or wrong. Otherwise it is exact, as in the paper, whose
    /// Orient4D is exact in every mode.
    naive: bool,
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
            naive: false,
            overflows: 0,
        }
    }

    /// The same with a rounded sign of D, which the paper does not go as far as.
    pub fn naive(motion: &'a Motion<'a, P>) -> Self {
        RoundedTimes {
            naive: true,
            ..RoundedTimes::new(motion)
        }
    }

    /// N and D, if D > 0.
    #[inline]
    fn positive(&mut self, lift: &LiftedTet, circuit: [VertexId; 5]) -> Option<(N, N)> {
        if self.naive {
            let (n, d) = self.rates.evaluate(circuit);
            return (d.sign() == Some(Sign::Positive)).then_some((n, d));
        }
        let across = self.filter.across(lift, circuit[4])?;
        if !across.d.is_positive() && !self.exact.evaluate(circuit).1.exact_sign().is_positive() {
            return None;
        }
        // The filter's values are what plain doubles give: the same operations in the same order, the origin apart.
        let [n, d] = self.filter.plain(lift, &across);
        let computed = N::computed(n).zip(N::computed(d));
        Some(computed.unwrap_or_else(|| self.rates.evaluate(circuit)))
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
        lift: &LiftedTet,
        circuit: [VertexId; 5],
        _: impl FnOnce([Option<Sign>; 3]) -> bool,
    ) -> Option<Timing<f64, N>> {
        let (n, d) = self.positive(lift, circuit)?;
        let Some(time) = N::negated_quotient(&n, &d) else {
            self.overflows += 1;
            return None;
        };
        Some(Timing {
            key: time.to_f64(),
            time,
            // What is possible is asked when the time has come.
            signs: [None; 3],
        })
    }

    #[inline]
    fn about(key: f64) -> Option<f64> {
        Some(key)
    }

    #[inline]
    fn compare_keys(a: f64, b: f64) -> Option<Ordering> {
        a.partial_cmp(&b).filter(|o| o.is_ne())
    }

    fn compare(&mut self, a: Timed<N>, b: Timed<N>) -> Ordering {
        N::compare(a.1, b.1)
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            overflows: self.overflows,
            ..Undecided::default()
        }
    }
}
