//! Flip times as rounded quotients: the paper's own method, which can fail.

use super::adaptive::{Adaptive, Weights};
use super::event::Signs;
use super::filter::{Filter, Moving};
use super::motion::{Circuits, PolygonMotion};
use super::ties::{FlipTies, QueueRule, Rules};
use super::time::{FlipTime, FlipTimes, Undecided};
use crate::kinetic::RoundedOrder;
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Float, Sign, Vec3};
use crate::predicate::PointStore;
use crate::predicate::formula::Lifted;

/// How N and D are evaluated.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Evaluation {
    /// Every operation rounded, but the sign of D is exact.
    Plain,
    /// Every operation rounded, and the sign of D is that of the rounded D, right or wrong. The paper does not go as
    /// far.
    Naive,
    /// As the paper's text has it (§3.2, §3.3): the weights d_v are values of the adaptive Orient3D; N is a value of the
    /// adaptive InSphere; and D one of the adaptive Orient4D, given those weights, so that its sign is exact, but that of
    /// another D.
    Paper,
    /// As TetGen 1.5 is known to do it: the same with weights by Orient3D in plain doubles.
    TetGen,
    /// N and D exact, and each rounded once; the sign of D is exact.
    Once,
}

/// Times as rounded quotients.
pub struct RoundedTimes<'a, P, N> {
    filter: Filter<'a, P>,
    exact: Circuits<'a, P, Dyadic>,
    rounded: Circuits<'a, P, N>,
    adaptive: Adaptive<'a, P>,
    evaluation: Evaluation,
    queue: QueueRule,
    order: RoundedOrder<N, FlipTies<'a, P, N>>,
    /// Times discarded because the quotient was not finite.
    overflows: u64,
}

impl<'a, P: PointStore, N: Float> RoundedTimes<'a, P, N> {
    /// For the given motion.
    pub fn new(
        motion: &'a PolygonMotion<'a, P>,
        evaluation: Evaluation,
        Rules { ties, queue }: Rules,
    ) -> Self {
        RoundedTimes {
            filter: Filter::new(motion),
            exact: Circuits::new(motion),
            rounded: Circuits::new(motion),
            adaptive: Adaptive::new(
                motion,
                match evaluation {
                    Evaluation::TetGen => Weights::Plain,
                    _ => Weights::Adaptive,
                },
            ),
            evaluation,
            queue,
            order: RoundedOrder::new(FlipTies::new(ties, motion)),
            overflows: 0,
        }
    }

    /// N and D of v, x, y, z, w as they are evaluated, if D > 0.
    pub fn parts(&mut self, circuit: [VertexId; 5]) -> Option<(N, N)> {
        let [v, x, y, z, _] = circuit;
        self.positive([v, x, y, z], circuit)
    }

    /// N and D, if D > 0.
    #[inline]
    fn positive(&mut self, tet: [VertexId; 4], circuit: [VertexId; 5]) -> Option<(N, N)> {
        match self.evaluation {
            Evaluation::Plain => self.positive_plain(tet, circuit),
            Evaluation::Naive => {
                let (n, d) = self.rounded.evaluate(circuit);
                (d.sign() == Some(Sign::Positive)).then_some((n, d))
            }
            Evaluation::Paper | Evaluation::TetGen => {
                let [n, d] = self.adaptive.evaluate(circuit);
                (d > 0.0).then(|| (N::from_f64(n), N::from_f64(d)))
            }
            Evaluation::Once => {
                self.filter.rising(circuit)?;
                let (n, d) = self.exact.evaluate(circuit);
                let is_positive = d.exact_sign().is_positive();
                is_positive.then(|| (N::nearest(&n), N::nearest(&d)))
            }
        }
    }

    /// [`Evaluation::Plain`].
    #[inline]
    fn positive_plain(&mut self, tet: [VertexId; 4], circuit: [VertexId; 5]) -> Option<(N, N)> {
        let rising = self.filter.rising(circuit)?;
        if !rising.d.is_positive() && !self.exact.evaluate(circuit).1.exact_sign().is_positive() {
            return None;
        }
        let [n, d] = self.plain(tet, circuit[4]);
        let computed = N::computed(n).zip(N::computed(d));
        Some(computed.unwrap_or_else(|| self.rounded.evaluate(circuit)))
    }

    /// N and D in plain doubles: the operations of [`Circuits::evaluate`] in the same order, the origin apart.
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

impl<'a, P: PointStore, N: Float> FlipTimes for RoundedTimes<'a, P, N> {
    type Order = RoundedOrder<N, FlipTies<'a, P, N>>;
    const EXACT: bool = false;

    #[inline]
    fn order(&mut self) -> &mut Self::Order {
        &mut self.order
    }

    #[inline]
    fn time_across(
        &mut self,
        tet: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<FlipTime<Self::Order>> {
        let (n, d) = self.positive(tet, circuit)?;
        // By default, what is possible is asked when the time has come.
        if !self.queue.admits(is_wanted) {
            return None;
        }
        let Some(time) = N::negated_quotient(&n, &d) else {
            self.overflows += 1;
            return None;
        };
        let time = self.order.ties.settled(circuit, time);
        Some(FlipTime {
            key: time.to_f64(),
            time,
            signs: Signs::UNKNOWN,
        })
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            overflows: self.overflows,
            ..Undecided::default()
        }
    }
}
