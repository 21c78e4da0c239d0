//! N and D of a circuit in floats with error bounds, and exactly where all coordinates are small integers on a grid.
//!
//! The evaluation is that of [`formula`](crate::predicate::formula) over [`Approx`], so its proof of the error bounds
//! applies; the rates d_v are orient3d determinants, computed once per vertex, of index [`RATE_INDEX`] (difference 1,
//! product 3, minor 4, product 6, two sums 8). The zero rate of a vertex that does not move fulfils the same bound.
//!
//! # Integers
//! If all coordinates are multiples of 2^g then the c_i, N and D are multiples of the quanta 2^(3g), 2^(5g) and 2^(6g). If
//! the error of a value is less than half of its quantum, the number is the multiple nearest to the value. If also the
//! value is less than 2^52 quanta, that multiple is found in floats: the division by a power of two is exact (or
//! underflows towards 0, the nearest multiple then), and so is rounding to an integer.

use super::motion::Motion;
use crate::mesh::VertexId;
use crate::number::{Approx, Sign, Vec3};
use crate::predicate::PointStore;
use crate::predicate::formula::Lifted;

/// The error index of an orient3d determinant of given doubles; see [`Approx`].
const RATE_INDEX: u32 = 8;

/// The magnitude of a vertex that has not been computed yet.
const UNKNOWN: f64 = -1.0;

/// Evaluates circuits in floats.
pub(super) struct Filter<'a, P> {
    motion: &'a Motion<'a, P>,
    /// Position, rate, and magnitude of the rate, by the vertices' numbers. NaN positions where they are not doubles: then
    /// nothing is certain.
    known: Vec<[f64; 5]>,
    grid: Grid,
}

/// 2^(3g), 2^(5g), 2^(6g), for coordinates on a grid 2^g; 0 where that is no normal double.
#[derive(Clone, Copy)]
struct Grid {
    coefficient: f64,
    numerator: f64,
    denominator: f64,
}

/// What the floats say about a circuit with a positive, or possibly positive, D.
pub(super) struct Evaluated {
    /// N.
    pub n: Approx,
    /// D.
    pub d: Approx,
    /// N and D in quanta, if they are certain.
    pub integers: Option<[i64; 2]>,
}

/// A tetrahedron in floats: what the evaluations of its facets have in common.
pub struct LiftedTet {
    ids: [VertexId; 4],
    origin: [f64; 5],
    others: [[f64; 5]; 3],
    lifted: Lifted<Approx>,
    /// G for the rates.
    rising: Vec3<Approx>,
    /// G for |p|², once needed.
    resting: Option<Vec3<Approx>>,
}

impl LiftedTet {
    /// The lifted tetrahedron with error indices that are constants: volume 8 (as orient3d), cross products 4.
    #[inline(always)]
    fn lifted(&self) -> Lifted<Approx> {
        self.lifted.map(
            |volume| volume.with_index_at_most::<8>(),
            with_index_at_most::<4>,
        )
    }
}

impl<'a, P: PointStore> Filter<'a, P> {
    pub(super) fn new(motion: &'a Motion<'a, P>) -> Self {
        let quantum = |degree: i32| {
            let exponent = motion.points.grid().map(|g| g.saturating_mul(degree));
            let normal = exponent.filter(|e| (-1022..=1023).contains(e));
            normal.map_or(0.0, |e| 2f64.powi(e))
        };
        Filter {
            motion,
            known: Vec::new(),
            grid: Grid {
                coefficient: quantum(3),
                numerator: quantum(5),
                denominator: quantum(6),
            },
        }
    }

    #[inline(always)]
    fn vertex(&mut self, v: VertexId) -> [f64; 5] {
        let number = self.motion.number(v);
        match self.known.get(number) {
            Some(known) if known[4] != UNKNOWN => *known,
            _ => self.know(v, number),
        }
    }

    #[cold]
    fn know(&mut self, v: VertexId, number: usize) -> [f64; 5] {
        if number >= self.known.len() {
            self.known.resize(number + 1, [UNKNOWN; 5]);
        }
        let double = |x: &Approx| if x.index() == 0 { x.value() } else { f64::NAN };
        let [x, y, z] = self
            .motion
            .points
            .coordinates::<Approx>(v)
            .0
            .each_ref()
            .map(double);
        let rate = self.motion.rate::<Approx>(v);
        debug_assert!(rate.index() <= RATE_INDEX || x.is_nan() || y.is_nan() || z.is_nan());
        self.known[number] = [x, y, z, rate.value(), rate.magnitude()];
        self.known[number]
    }

    /// Prepares the evaluation of the facets of a positive tetrahedron.
    #[inline(always)]
    pub(super) fn lift(&mut self, tet: [VertexId; 4]) -> LiftedTet {
        let origin = self.vertex(tet[0]);
        let (a, b, c) = (
            self.vertex(tet[1]),
            self.vertex(tet[2]),
            self.vertex(tet[3]),
        );
        let (pa, pb, pc) = (
            from_origin(&a, &origin),
            from_origin(&b, &origin),
            from_origin(&c, &origin),
        );
        let lifted = Lifted::new([&pa, &pb, &pc]);
        let (ra, rb, rc) = (
            relative_rate(&a, &origin),
            relative_rate(&b, &origin),
            relative_rate(&c, &origin),
        );
        LiftedTet {
            ids: tet,
            rising: lifted.gradient([&ra, &rb, &rc]),
            resting: None,
            origin,
            others: [a, b, c],
            lifted,
        }
    }

    /// N and D for the tetrahedron and the apex across one of its facets; `None` if certainly D ≤ 0.
    #[inline(always)]
    pub(super) fn evaluate_across(
        &mut self,
        tet: &mut LiftedTet,
        apex: VertexId,
    ) -> Option<Evaluated> {
        let apex = self.vertex(apex);
        let w = from_origin(&apex, &tet.origin);
        let rate = relative_rate(&apex, &tet.origin);
        let lifted = tet.lifted();
        // Rates 9, their products with cross products 14, two sums.
        let rising = with_index_at_most::<16>(&tet.rising);
        let d = lifted.below(&rising, &w, &rate);
        match d.sign_on_grid(self.grid.denominator) {
            Some(Sign::Negative | Sign::Zero) => return None,
            Some(Sign::Positive) | None => {}
        }
        if tet.resting.is_none() {
            let [a, b, c] = &tet.others;
            let (a, b, c) = (
                from_origin(a, &tet.origin),
                from_origin(b, &tet.origin),
                from_origin(c, &tet.origin),
            );
            tet.resting = Some(lifted.gradient([&a.dot(&a), &b.dot(&b), &c.dot(&c)]));
        }
        let resting = tet.resting.as_ref().expect("just computed");
        // Squares 5, their products with cross products 10, two sums.
        let resting = with_index_at_most::<12>(resting);
        let n = lifted.below(&resting, &w, &w.dot(&w));
        let integers = match (
            in_quanta(&n, self.grid.numerator),
            in_quanta(&d, self.grid.denominator),
        ) {
            (Some(n), Some(d)) => Some([n, d]),
            _ => None,
        };
        Some(Evaluated { n, d, integers })
    }

    /// The signs of c_x, c_y, c_z of a circuit, for a triangle xyz of the lifted tetrahedron, where they are certain, and all
    /// five coefficients in quanta, if all are certain: c_w is the volume of the tetrahedron, and those of its vertices are
    /// the volumes with the apex in their place, negated.
    #[inline(always)]
    pub(super) fn signs(
        &mut self,
        tet: &LiftedTet,
        [v, x, y, z, w]: [VertexId; 5],
    ) -> ([Option<Sign>; 3], Option<[i64; 5]>) {
        let w = from_origin(&self.vertex(w), &tet.origin);
        let lifted = tet.lifted();
        let volume = *lifted.volume();
        let [a, b, c] = lifted.with_in_place(&w);
        let o = volume - &a - &b - &c;
        let quantum = self.grid.coefficient;
        let sign = |x: Approx| x.sign_on_grid(quantum);
        let volumes = [sign(o), sign(a), sign(b), sign(c)];
        let place = |p: VertexId| {
            let place = tet.ids.iter().position(|&v| v == p);
            place.expect("v, x, y, z are the vertices of the tetrahedron")
        };
        let places = [place(v), place(x), place(y), place(z)];
        let signs = [1, 2, 3].map(|i: usize| volumes[places[i]].map(|sign| -sign));
        let integers = || {
            let with_apex = [
                in_quanta(&o, quantum)?,
                in_quanta(&a, quantum)?,
                in_quanta(&b, quantum)?,
                in_quanta(&c, quantum)?,
            ];
            let [v, x, y, z] = places.map(|i| -with_apex[i]);
            Some([v, x, y, z, in_quanta(&volume, quantum)?])
        };
        (signs, integers())
    }

    /// N and D of a circuit; `None` if certainly D ≤ 0.
    pub(super) fn evaluate(&mut self, [v, x, y, z, w]: [VertexId; 5]) -> Option<Evaluated> {
        let mut tet = self.lift([v, x, y, z]);
        self.evaluate_across(&mut tet, w)
    }
}

/// A vector with larger error indices, given as a constant.
#[inline(always)]
fn with_index_at_most<const K: u32>(v: &Vec3<Approx>) -> Vec3<Approx> {
    let [x, y, z] = v.0;
    Vec3([
        x.with_index_at_most::<K>(),
        y.with_index_at_most::<K>(),
        z.with_index_at_most::<K>(),
    ])
}

/// p − origin.
#[inline(always)]
fn from_origin(p: &[f64; 5], origin: &[f64; 5]) -> Vec3<Approx> {
    let position = |&[x, y, z, _, _]: &[f64; 5]| Vec3::<Approx>::from_f64([x, y, z]);
    position(p).sub(&position(origin))
}

/// The rate at p less that at the origin.
#[inline(always)]
fn relative_rate(p: &[f64; 5], origin: &[f64; 5]) -> Approx {
    let rate =
        |&[_, _, _, value, magnitude]: &[f64; 5]| Approx::with_bound(value, magnitude, RATE_INDEX);
    rate(p) - &rate(origin)
}

/// x as a multiple of `quantum`, which it is known to be, if the bound leaves only one possibility.
#[inline]
fn in_quanta(x: &Approx, quantum: f64) -> Option<i64> {
    // No quantum: 0 < 0 is false. The error's bound is at least the smallest normal double.
    let certain = x.error() < 0.5 * quantum && x.value().abs() < quantum * 2f64.powi(52);
    certain.then(|| (x.value() / quantum).round() as i64)
}
