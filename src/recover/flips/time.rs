//! When a crossing triangle must be flipped (paper, Equation (1)), in any number type.
//!
//! # The lifted determinant as a function of time
//! While f is inserted the heights of the left vertices grow, h_v(τ) = |v|² + τ·d_v with d_v = orient3d(frame, v) for a
//! left vertex and d_v = 0 for every other one, also for vertices of f that are not exactly on its plane. For the two
//! tetrahedra vxyz and wxzy of a triangle xyz, with the circuit's coefficients c of (v, x, y, z, w)
//! ([`formula`](crate::predicate::formula)),
//!
//! > S(τ) = N + τ·D,  N = insphere(v,x,y,z,w) = −Σ c_i|p_i − w|²,  D = −Σ c_i·d_i,
//!
//! is negative while the lifted triangle is locally convex. It is at τ = 0; if D ≤ 0 it stays so for ever (Fig. 7, line
//! 11); else it must be flipped at τ = −N/D (line 12).
//!
//! # Exact order, with the perturbation
//! Under the weights ε_v, N becomes N + Σ ε_v c_v, and D is free of ε. So with D_A, D_B > 0, A comes before B iff the
//! first non-zero of
//!
//! > t_0 = N_A·D_B − N_B·D_A (degree 11),  t_v = c_{A,v}·D_B − c_{B,v}·D_A (degree 9), v in ε order,
//!
//! is positive, where c = 0 for a vertex that is not among the five. If all vanish then the two circuits are the same
//! up to a factor, which happens only for two triangles of one 4-to-4 flip: they are one event.

use super::event::Event;
use crate::mesh::VertexId;
pub use crate::number::Float;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use crate::predicate::{PointStore, formula};
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// A way to compute and to compare flip times.
pub trait FlipTimes {
    /// The time of one flip, or what is needed to compare it.
    type Time;

    /// The time at which the triangle xyz between vxyz and wxzy must be flipped; `None` if it never must, or if the
    /// number type cannot hold the time.
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Self::Time>;

    /// Which of two events comes first. `Equal` means: in any order.
    fn compare(&mut self, a: &Event<Self::Time>, b: &Event<Self::Time>) -> Ordering;

    /// What the number type did not decide by itself.
    fn undecided(&self) -> Undecided;

    /// Whether the order is the true one, so that the patches of §3.3 are neither needed nor applied.
    const EXACT: bool;
}

/// Counts of what a number type did not decide by itself.
#[derive(Clone, Copy, Default, Debug)]
pub struct Undecided {
    /// Comparisons that float enclosures left to exact quotients.
    pub compared_exactly: u64,
    /// Comparisons that exact quotients left to the perturbation.
    pub ties: u64,
    /// Times discarded because a rounded quotient was not finite.
    pub overflows: u64,
}

/// Tells the left vertices of a polygon.
pub type LeftVertices<'a> = &'a dyn Fn(VertexId) -> bool;

/// N and D of S(τ) = N + τ·D, from the five points and their rates d.
fn numerator_and_denominator<N: Number>(p: &[Vec3<N>; 5], rates: &[N; 5]) -> (N, N) {
    let (c, q) = formula::circuit(p.each_ref());
    let lift = [0, 1, 2, 3].map(|i: usize| q[i].dot(&q[i]));
    let rate = [0, 1, 2, 3].map(|i: usize| rates[i].clone() - &rates[4]);
    (
        formula::orient4d(&c, lift.each_ref()),
        formula::orient4d(&c, rate.each_ref()),
    )
}

/// Whether two circuits have the same five vertices.
pub(super) fn same_vertices(mut a: [VertexId; 5], mut b: [VertexId; 5]) -> bool {
    a.sort_unstable();
    b.sort_unstable();
    a == b
}

/// The rates d_v of the vertices of one region, each computed once.
pub(super) struct Rates<'a, P, N> {
    points: &'a P,
    frame: [VertexId; 3],
    is_left: LeftVertices<'a>,
    known: FxHashMap<VertexId, N>,
}

impl<'a, P: PointStore, N: Number> Rates<'a, P, N> {
    pub(super) fn new(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        Rates {
            points,
            frame,
            is_left,
            known: FxHashMap::default(),
        }
    }

    fn of(&mut self, v: VertexId) -> N {
        if !(self.is_left)(v) {
            return N::from_f64(0.0);
        }
        if let Some(rate) = self.known.get(&v) {
            return rate.clone();
        }
        let [a, b, c] = self.frame;
        let p = [a, b, c, v].map(|v| self.points.coordinates::<N>(v));
        let rate = formula::orient3d(p.each_ref());
        self.known.insert(v, rate.clone());
        rate
    }

    /// N and D of a circuit.
    pub(super) fn evaluate(&mut self, circuit: [VertexId; 5]) -> (N, N) {
        let p = circuit.map(|v| self.points.coordinates::<N>(v));
        let rates = circuit.map(|v| self.of(v));
        numerator_and_denominator(&p, &rates)
    }
}

/// The sign of D, exact: filtered, then dyadic. The paper's own Orient4D is exact in every mode.
struct DenominatorSign<'a, P> {
    filter: Rates<'a, P, Approx>,
    exact: Rates<'a, P, Dyadic>,
}

impl<'a, P: PointStore> DenominatorSign<'a, P> {
    fn new(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        DenominatorSign {
            filter: Rates::new(points, frame, is_left),
            exact: Rates::new(points, frame, is_left),
        }
    }

    fn of(&mut self, circuit: [VertexId; 5]) -> Sign {
        let (_, d) = self.filter.evaluate(circuit);
        d.sign()
            .unwrap_or_else(|| self.exact.evaluate(circuit).1.exact_sign())
    }
}

/// Times as rounded quotients, ties in order of arrival: the paper's own method, which can fail.
pub struct RoundedTimes<'a, P, N> {
    /// `None` if the sign of D is that of the rounded D, right or wrong.
    denominator: Option<DenominatorSign<'a, P>>,
    rates: Rates<'a, P, N>,
    /// Times discarded because the quotient was not finite.
    overflows: u64,
}

impl<'a, P: PointStore, N: Number> RoundedTimes<'a, P, N> {
    /// For the polygon with the given frame; `is_left` tells the left vertices.
    pub fn new(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        RoundedTimes {
            denominator: Some(DenominatorSign::new(points, frame, is_left)),
            ..RoundedTimes::naive(points, frame, is_left)
        }
    }

    /// The same with a rounded sign of D, which the paper does not go as far as.
    pub fn naive(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        RoundedTimes {
            denominator: None,
            rates: Rates::new(points, frame, is_left),
            overflows: 0,
        }
    }
}

impl<P: PointStore, N: Float> FlipTimes for RoundedTimes<'_, P, N> {
    type Time = N;
    const EXACT: bool = false;

    fn time(&mut self, circuit: [VertexId; 5]) -> Option<N> {
        if let Some(denominator) = &mut self.denominator
            && !denominator.of(circuit).is_positive()
        {
            return None;
        }
        let (n, d) = self.rates.evaluate(circuit);
        if self.denominator.is_none() && d.sign() != Some(Sign::Positive) {
            return None;
        }
        let time = N::negated_quotient(&n, &d);
        self.overflows += u64::from(time.is_none());
        time
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            overflows: self.overflows,
            ..Undecided::default()
        }
    }

    fn compare(&mut self, a: &Event<N>, b: &Event<N>) -> Ordering {
        N::compare(&a.time, &b.time)
    }
}

/// The time −N/D as an unevaluated quotient: comparison needs no division.
#[derive(Clone, Debug)]
pub struct Quotient<N> {
    numerator: N,
    denominator: N,
}

#[cfg(test)]
impl<N> Quotient<N> {
    /// N and D.
    pub(super) fn parts(&self) -> (&N, &N) {
        (&self.numerator, &self.denominator)
    }
}

/// Times in exact numbers, ties decided by the perturbation of the weights.
pub struct ExactTimes<'a, P, N> {
    denominator: DenominatorSign<'a, P>,
    rates: Rates<'a, P, N>,
    /// Comparisons that the quotients did not decide, so that the perturbation had to.
    ties: u64,
}

impl<'a, P: PointStore, N: Exact> ExactTimes<'a, P, N> {
    /// For the polygon with the given frame; `is_left` tells the left vertices.
    pub fn new(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        ExactTimes {
            denominator: DenominatorSign::new(points, frame, is_left),
            rates: Rates::new(points, frame, is_left),
            ties: 0,
        }
    }

    /// N and D, if D > 0.
    pub fn quotient(&mut self, circuit: [VertexId; 5]) -> Option<Quotient<N>> {
        if !self.denominator.of(circuit).is_positive() {
            return None;
        }
        let (numerator, denominator) = self.rates.evaluate(circuit);
        Some(Quotient {
            numerator,
            denominator,
        })
    }

    /// Which of two events, given by circuit and time, comes first: the sign of t_0, then the perturbation.
    pub fn compare_quotients(&mut self, a: Timed<N>, b: Timed<N>) -> Ordering {
        let ab = a.1.numerator.clone() * &b.1.denominator;
        let ba = b.1.numerator.clone() * &a.1.denominator;
        match (ab - &ba).exact_sign() {
            Sign::Positive => Ordering::Less,
            Sign::Negative => Ordering::Greater,
            Sign::Zero => self.compare_perturbed(a, b),
        }
    }

    /// The signs of t_v for the vertices of both circuits, in ε order, until one is not zero.
    fn compare_perturbed(&mut self, a: Timed<N>, b: Timed<N>) -> Ordering {
        self.ties += 1;
        let points = self.rates.points;
        let coefficients = |circuit: [VertexId; 5]| {
            let p = circuit.map(|v| points.coordinates::<N>(v));
            formula::circuit(p.each_ref()).0
        };
        let (ca, cb) = (coefficients(a.0), coefficients(b.0));
        let mut vertices: Vec<VertexId> = a.0.into_iter().chain(b.0).collect();
        vertices.sort_unstable_by_key(|&v| points.identity(v));
        vertices.dedup();
        let zero = N::from_f64(0.0);
        for v in vertices {
            let of = |circuit: &[VertexId; 5], c: &[N; 5]| {
                let place = circuit.iter().position(|&w| w == v);
                place.map_or(zero.clone(), |i| c[i].clone())
            };
            let term = of(&a.0, &ca) * &b.1.denominator - &(of(&b.0, &cb) * &a.1.denominator);
            match term.exact_sign() {
                Sign::Positive => return Ordering::Less,
                Sign::Negative => return Ordering::Greater,
                Sign::Zero => {}
            }
        }
        Ordering::Equal
    }
}

/// A circuit with its time.
pub type Timed<'t, N> = ([VertexId; 5], &'t Quotient<N>);

impl<P: PointStore, N: Exact> FlipTimes for ExactTimes<'_, P, N> {
    type Time = Quotient<N>;
    const EXACT: bool = true;

    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Quotient<N>> {
        self.quotient(circuit)
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            ties: self.ties,
            ..Undecided::default()
        }
    }

    fn compare(&mut self, a: &Event<Quotient<N>>, b: &Event<Quotient<N>>) -> Ordering {
        if same_vertices(a.circuit, b.circuit) {
            // Two triangles of one circuit, or one triangle queued again: the same time, perturbed or not.
            return Ordering::Equal;
        }
        self.compare_quotients((a.circuit, &a.time), (b.circuit, &b.time))
    }
}
