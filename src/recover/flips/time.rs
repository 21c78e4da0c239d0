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

use super::event::{Event, Signs};
use super::filter::Filter;
use super::motion::{Motion, Rates};
use crate::mesh::VertexId;
pub use crate::number::Float;
use crate::number::{Exact, Sign};
use crate::predicate::PointStore;
use std::cmp::Ordering;

/// A way to compute and to compare flip times.
pub trait FlipTimes {
    /// The part of a time that the queue moves around: enough for most comparisons.
    type Key: Copy;

    /// The rest of it.
    type Time;

    /// The time at which the triangle xyz between vxyz and wxzy must be flipped; `None` if it never must, or if the
    /// number type cannot hold the time.
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Timing<Self::Key, Self::Time>> {
        let [v, x, y, z, _] = circuit;
        self.time_across([v, x, y, z], circuit, |_, may_rise| may_rise)
    }

    /// Lets the processor fetch what is known of a vertex that will be lifted soon.
    fn prefetch(&self, v: VertexId) {
        let _ = v;
    }

    /// The same for a triangle of the given tetrahedron, vxyz up to an even permutation, on which rounding may depend. Exact
    /// orders ask, before they compute the quotient, whether the time is of interest, given the signs of c_x, c_y, c_z where
    /// they are known, and whether D may be positive: if not, the answer must be `false`. (One question for both, because
    /// neither answer can be foretold, and a branch that is foretold wrongly takes as long as much of the evaluation.)
    fn time_across(
        &mut self,
        tet: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<Timing<Self::Key, Self::Time>>;

    /// About when a time is, to sort by before comparing; `None` if keys do not tell.
    fn about(key: Self::Key) -> Option<f64>;

    /// Which of two times comes first, as far as the keys tell.
    fn compare_keys(a: Self::Key, b: Self::Key) -> Option<Ordering>;

    /// Which of two events comes first, where the keys do not tell. `Equal` means: in any order.
    fn compare(&mut self, a: Timed<Self::Time>, b: Timed<Self::Time>) -> Ordering;

    /// What the number type did not decide by itself.
    fn undecided(&self) -> Undecided;

    /// Whether the order is the true one, so that the patches of §3.3 are neither needed nor applied.
    const EXACT: bool;
}

/// A flip time.
#[derive(Clone, Debug)]
pub struct Timing<K, T> {
    /// For most comparisons.
    pub key: K,
    /// For the others.
    pub time: T,
    /// The signs of the circuit's coefficients c_x, c_y, c_z, where they are known.
    pub signs: Signs,
}

/// An event and its time, to be compared.
pub type Timed<'t, T> = (&'t Event, &'t T);

/// Counts of what a number type did not decide by itself.
#[derive(Clone, Copy, Default, Debug)]
pub struct Undecided {
    /// Comparisons that float enclosures left to exact quotients.
    pub compared_exactly: u64,
    /// Comparisons that exact quotients left to the perturbation.
    pub ties: u64,
    /// Events whose exact quotient had to be computed in numbers of any size.
    pub big_quotients: u64,
    /// Times discarded because a rounded quotient was not finite.
    pub overflows: u64,
}

/// Whether two circuits have the same five vertices.
pub(super) fn same_vertices(mut a: [VertexId; 5], mut b: [VertexId; 5]) -> bool {
    a.sort_unstable();
    b.sort_unstable();
    a == b
}

/// The time −N/D as an unevaluated quotient: comparison needs no division.
#[derive(Clone, Debug)]
pub struct Quotient<N> {
    numerator: N,
    denominator: N,
}

impl<N> Quotient<N> {
    /// N and D.
    pub fn parts(&self) -> (&N, &N) {
        (&self.numerator, &self.denominator)
    }
}

/// Times in exact numbers, ties decided by the perturbation of the weights.
pub struct ExactTimes<'a, P, N> {
    filter: Filter<'a, P>,
    rates: Rates<'a, P, N>,
    /// Comparisons that the quotients did not decide, so that the perturbation had to.
    ties: u64,
    big_quotients: u64,
}

impl<'a, P: PointStore, N: Exact> ExactTimes<'a, P, N> {
    /// For the given motion.
    pub fn new(motion: &'a Motion<'a, P>) -> Self {
        ExactTimes {
            filter: Filter::new(motion),
            rates: Rates::new(motion),
            ties: 0,
            big_quotients: 0,
        }
    }

    /// N and D, if D > 0: the sign of D is found in floats if they are certain of it.
    pub fn quotient(&mut self, circuit: [VertexId; 5]) -> Option<Quotient<N>> {
        self.filter.rising(circuit)?;
        self.exact_quotient(circuit)
    }

    /// N and D, if D > 0.
    pub(super) fn exact_quotient(&mut self, circuit: [VertexId; 5]) -> Option<Quotient<N>> {
        self.big_quotients += 1;
        let (numerator, denominator) = self.rates.evaluate(circuit);
        denominator.exact_sign().is_positive().then_some(Quotient {
            numerator,
            denominator,
        })
    }

    /// Which of two events, given by circuit and quotient, comes first: the sign of t_0, then the perturbation.
    pub fn compare_quotients(
        &mut self,
        a: ([VertexId; 5], &Quotient<N>),
        b: ([VertexId; 5], &Quotient<N>),
    ) -> Ordering {
        let ab = a.1.numerator.clone() * &b.1.denominator;
        let ba = b.1.numerator.clone() * &a.1.denominator;
        match (ab - &ba).exact_sign() {
            Sign::Positive => return Ordering::Less,
            Sign::Negative => return Ordering::Greater,
            Sign::Zero => self.ties += 1,
        }
        let (ca, cb) = (self.rates.coefficients(a.0), self.rates.coefficients(b.0));
        let points = self.rates.motion.points;
        compare_perturbed(points, a.0, b.0, |i, j| {
            let zero = N::from_f64(0.0);
            let of_a = i.map_or(zero.clone(), |i| ca[i].clone() * &b.1.denominator);
            let of_b = j.map_or(zero, |j| cb[j].clone() * &a.1.denominator);
            (of_a - &of_b).exact_sign()
        })
    }
}

/// The signs of t_v for the vertices of both circuits, in ε order, until one is not zero. `term` gives the sign of t_v for
/// the vertex at place i of circuit a, if any, and at place j of circuit b, if any.
pub(super) fn compare_perturbed<P: PointStore>(
    points: &P,
    a: [VertexId; 5],
    b: [VertexId; 5],
    mut term: impl FnMut(Option<usize>, Option<usize>) -> Sign,
) -> Ordering {
    let in_order = |circuit: [VertexId; 5]| {
        let mut places = [0, 1, 2, 3, 4].map(|i| (points.identity(circuit[i]), i));
        places.sort_unstable();
        places
    };
    let (pa, pb) = (in_order(a), in_order(b));
    let (mut i, mut j) = (0, 0);
    while i < 5 || j < 5 {
        let (va, vb) = (pa.get(i), pb.get(j));
        let first = va
            .map_or(u32::MAX, |v| v.0)
            .min(vb.map_or(u32::MAX, |v| v.0));
        let at = |v: Option<&(u32, usize)>| v.filter(|v| v.0 == first).map(|v| v.1);
        match term(at(va), at(vb)) {
            Sign::Positive => return Ordering::Less,
            Sign::Negative => return Ordering::Greater,
            Sign::Zero => {}
        }
        i += usize::from(at(va).is_some());
        j += usize::from(at(vb).is_some());
    }
    Ordering::Equal
}

impl<P: PointStore, N: Exact> FlipTimes for ExactTimes<'_, P, N> {
    type Key = ();
    type Time = Quotient<N>;
    const EXACT: bool = true;

    fn time_across(
        &mut self,
        _: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<Timing<(), Quotient<N>>> {
        let rising = self.filter.rising(circuit)?;
        let signs = self.filter.signs(&rising);
        if !is_wanted(signs, true) {
            return None;
        }
        let time = self.exact_quotient(circuit)?;
        Some(Timing {
            key: (),
            time,
            signs,
        })
    }

    fn about((): ()) -> Option<f64> {
        None
    }

    fn compare_keys((): (), (): ()) -> Option<Ordering> {
        None
    }

    fn compare(&mut self, a: Timed<Quotient<N>>, b: Timed<Quotient<N>>) -> Ordering {
        if same_vertices(a.0.circuit, b.0.circuit) {
            // Two triangles of one circuit, or one triangle queued again: the same time, perturbed or not.
            return Ordering::Equal;
        }
        self.compare_quotients((a.0.circuit, a.1), (b.0.circuit, b.1))
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            ties: self.ties,
            big_quotients: self.big_quotients,
            ..Undecided::default()
        }
    }
}
