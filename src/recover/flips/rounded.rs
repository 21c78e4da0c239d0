//! Flip times as rounded quotients: the paper's own method, which can fail.

use super::event::Signs;
use super::filter::{Filter, Moving};
use super::motion::{Motion, Rates};
use super::time::{FlipTimes, Timed, Timing, Undecided};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Float, Sign, Vec3};
use crate::predicate::PointStore;
use crate::predicate::formula::Lifted;
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
    fn positive(&mut self, tet: [VertexId; 4], circuit: [VertexId; 5]) -> Option<(N, N)> {
        if self.naive {
            let (n, d) = self.rates.evaluate(circuit);
            return (d.sign() == Some(Sign::Positive)).then_some((n, d));
        }
        let rising = self.filter.rising(circuit)?;
        if !rising.d.is_positive() && !self.exact.evaluate(circuit).1.exact_sign().is_positive() {
            return None;
        }
        let [n, d] = self.plain(tet, circuit[4]);
        let computed = N::computed(n).zip(N::computed(d));
        Some(computed.unwrap_or_else(|| self.rates.evaluate(circuit)))
    }

    /// N and D in plain doubles: the operations of [`Rates::evaluate`] in the same order, the origin apart.
    #[inline]
    fn plain(&mut self, tet: [VertexId; 4], apex: VertexId) -> [f64; 2] {
        let [a, b, c, d] = tet;
        let [origin, x, y, z, w] = [a, b, c, d, apex].map(|v| self.filter.vertex(v));
        let relative = |p: &Moving| {
            let difference = |i: usize| p.0[i] - origin.0[i];
            (
                Vec3([difference(0), difference(1), difference(2)]),
                difference(3),
            )
        };
        let [x, y, z, w] = [relative(&x), relative(&y), relative(&z), relative(&w)];
        let lifted = Lifted::new([&x.0, &y.0, &z.0]);
        let below = |heights: [f64; 3], height: f64| {
            let gradient = lifted.gradient(heights.each_ref());
            lifted.below(&gradient, &w.0, &height)
        };
        let square = |p: &Vec3<f64>| p.dot(p);
        [
            below([square(&x.0), square(&y.0), square(&z.0)], square(&w.0)),
            below([x.1, y.1, z.1], w.1),
        ]
    }
}

impl<P: PointStore, N: Float> FlipTimes for RoundedTimes<'_, P, N> {
    type Key = f64;
    type Time = N;
    const EXACT: bool = false;

    #[inline]
    fn time_across(
        &mut self,
        tet: [VertexId; 4],
        circuit: [VertexId; 5],
        _: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<Timing<f64, N>> {
        let (n, d) = self.positive(tet, circuit)?;
        let Some(time) = N::negated_quotient(&n, &d) else {
            self.overflows += 1;
            return None;
        };
        Some(Timing {
            key: time.to_f64(),
            time,
            // What is possible is asked when the time has come.
            signs: Signs::UNKNOWN,
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
