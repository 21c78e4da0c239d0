//! Weights, InSphere and Orient4D in doubles as adaptive predicates return them (Shewchuk 1997): the sign is always
//! right, and the value is that of the first stage whose error bound is smaller than it. So it is not far from the
//! right one where the stages had to go on, and as rounded as any where the first one did.
//!
//! Orient3D and InSphere are those of the `robust` crate, which has all four stages. Orient4D is written here:
//! InSphere's first stage with heights in the place of squares, and then the exact value, rounded once; the two stages
//! between are missing, whose values would be within a few roundings of that.
//!
//! InSphere's bound of its first stage, (16 + 224u)·u times the permanent (u = 2⁻⁵³), holds for Orient4D, too: a height
//! relative to that of the last vertex has one rounding, where a square has five. As in the predicates themselves,
//! nothing may over- or underflow.

use super::motion::PolygonMotion;
use crate::mesh::VertexId;
use crate::number::{Dyadic, Number, Vec3};
use crate::predicate::{PointStore, formula};
use robust::Coord3D;

/// How the weights of left vertices are computed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Weights {
    /// By the adaptive Orient3D.
    Adaptive,
    /// By Orient3D in plain doubles.
    Plain,
}

/// A vertex in doubles and the rate of its height.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    position: [f64; 3],
    rate: f64,
}

/// Evaluates N and D of circuits in doubles.
pub(super) struct Adaptive<'a, P> {
    motion: &'a PolygonMotion<'a, P>,
    weights: Weights,
    /// By the vertices' numbers.
    known: Vec<Option<Vertex>>,
}

impl<'a, P: PointStore> Adaptive<'a, P> {
    pub(super) fn new(motion: &'a PolygonMotion<'a, P>, weights: Weights) -> Self {
        Adaptive {
            motion,
            weights,
            known: Vec::new(),
        }
    }

    /// N and D of v, x, y, z, w. The sign of D is exact, but of the D that the rounded weights have.
    pub(super) fn evaluate(&mut self, circuit: [VertexId; 5]) -> [f64; 2] {
        let [v, x, y, z, w] = circuit.map(|v| self.vertex(v));
        // The order of Equation (1).
        let five = [x, y, z, v, w];
        let [a, b, c, d, e] = five.map(|p| coordinates(p.position));
        [robust::insphere(a, b, c, d, e), orient4d(five)]
    }

    fn vertex(&mut self, v: VertexId) -> Vertex {
        let number = self.motion.number(v);
        if number >= self.known.len() {
            self.known.resize(number + 1, None);
        }
        if let Some(vertex) = self.known[number] {
            return vertex;
        }
        let vertex = Vertex {
            position: self.motion.points.rounded(v),
            rate: self.rate(v),
        };
        self.known[number] = Some(vertex);
        vertex
    }

    fn rate(&self, v: VertexId) -> f64 {
        let Some([a, b, c]) = self.motion.frame_of_left(v) else {
            return 0.0;
        };
        let [a, b, c, v] = [a, b, c, v].map(|p| self.motion.points.rounded(p));
        match self.weights {
            // Of the opposite sign.
            Weights::Adaptive => {
                let [a, b, c, v] = [a, b, c, v].map(coordinates);
                -robust::orient3d(a, b, c, v)
            }
            // That v is a left vertex is known exactly.
            Weights::Plain => plain_orient3d([a, b, c, v]).abs(),
        }
    }
}

fn coordinates([x, y, z]: [f64; 3]) -> Coord3D<f64> {
    Coord3D { x, y, z }
}

/// Orient3D without a look at its error: the first stage of the adaptive one.
fn plain_orient3d([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1], p[2] - d[2]]);
    let minor = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - q[0] * p[1];
    a[2] * minor(b, c) + b[2] * minor(c, a) + c[2] * minor(a, b)
}

/// Orient4D of a, b, c, d, e, whose heights are their rates.
fn orient4d([a, b, c, d, e]: [Vertex; 5]) -> f64 {
    let [a4, b4, c4, d4] = [a, b, c, d].map(|p| {
        let difference = |i: usize| p.position[i] - e.position[i];
        let height = p.rate - e.rate;
        [difference(0), difference(1), difference(2), height]
    });
    // A 2×2 minor, and the same of magnitudes.
    let minor = |p: [f64; 4], q: [f64; 4]| {
        let (pq, qp) = (p[0] * q[1], q[0] * p[1]);
        (pq - qp, pq.abs() + qp.abs())
    };
    let (ab, bc, cd, da) = (minor(a4, b4), minor(b4, c4), minor(c4, d4), minor(d4, a4));
    let (ac, bd) = (minor(a4, c4), minor(b4, d4));
    let [az, bz, cz, dz] = [a4[2], b4[2], c4[2], d4[2]];
    let abc = az * bc.0 - bz * ac.0 + cz * ab.0;
    let bcd = bz * cd.0 - cz * bd.0 + dz * bc.0;
    let cda = cz * da.0 + dz * ac.0 + az * cd.0;
    let dab = dz * ab.0 + az * bd.0 + bz * da.0;
    let determinant = (d4[3] * abc - c4[3] * dab) + (b4[3] * cda - a4[3] * bcd);
    let [az, bz, cz, dz] = [az, bz, cz, dz].map(f64::abs);
    let permanent = (cd.1 * bz + bd.1 * cz + bc.1 * dz) * a4[3].abs()
        + (da.1 * cz + ac.1 * dz + cd.1 * az) * b4[3].abs()
        + (ab.1 * dz + bd.1 * az + da.1 * bz) * c4[3].abs()
        + (bc.1 * az + ac.1 * bz + ab.1 * cz) * d4[3].abs();
    const U: f64 = f64::EPSILON / 2.0;
    let bound = (16.0 + 224.0 * U) * U * permanent;
    if determinant.abs() > bound {
        return determinant;
    }
    exact_orient4d([a, b, c, d, e]).to_f64()
}

/// The same exactly.
fn exact_orient4d(five: [Vertex; 5]) -> Dyadic {
    let positions = five.map(|p| Vec3::<Dyadic>::from_f64(p.position));
    let (circuit, _) = formula::circuit(positions.each_ref());
    let [a, b, c, d, e] = five.map(|p| Dyadic::from_f64(p.rate));
    let heights = [a, b, c, d].map(|h| h - &e);
    // `formula` is of the other orientation: that of v, x, y, z, w.
    formula::orient4d(&circuit, heights.each_ref()).negated()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Exact, Sign};
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;

    type Point = [f64; 4];

    /// The determinant of four rows, by cofactors along the last column, in rationals.
    fn determinant(five: [Point; 5]) -> BigRational {
        let rational = |x: f64| BigRational::from_float(x).expect("finite");
        let e = five[4].map(rational);
        let row = |i: usize| -> Vec<BigRational> {
            let difference = |j: usize| rational(five[i][j]) - &e[j];
            (0..4).map(difference).collect()
        };
        let rows: Vec<Vec<BigRational>> = (0..4).map(row).collect();
        let of = |rows: &[&Vec<BigRational>], c: [usize; 3]| {
            let [p, q, r] = [rows[0], rows[1], rows[2]];
            let minor = |i: usize, j: usize| &q[i] * &r[j] - &q[j] * &r[i];
            &p[c[0]] * minor(c[1], c[2]) - &p[c[1]] * minor(c[0], c[2])
                + &p[c[2]] * minor(c[0], c[1])
        };
        let mut sum = BigRational::from_integer(0.into());
        for i in 0..4 {
            let others: Vec<&Vec<BigRational>> =
                (0..4).filter(|&j| j != i).map(|j| &rows[j]).collect();
            let term = &rows[i][3] * of(&others, [0, 1, 2]);
            // The element (i, 3) has the sign (−1)^(i+3).
            sum = if i % 2 == 0 { sum - term } else { sum + term };
        }
        sum
    }

    fn points() -> impl Strategy<Value = [Point; 5]> {
        // Few values, so that many determinants are zero, and some of them off by an ulp.
        let number = (-3i32..4, -1i32..2, 0usize..3).prop_map(|(x, ulps, scale)| {
            let x = f64::from(x) * [1.0, 0.1, 1.0 / 3.0][scale];
            x * (1.0 + f64::from(ulps) * f64::EPSILON)
        });
        let point = [number.clone(), number.clone(), number.clone(), number];
        [
            point.clone(),
            point.clone(),
            point.clone(),
            point.clone(),
            point,
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        /// The sign is right, and where the first stage does not decide the value is the nearest double.
        #[test]
        fn signs_are_exact(five in points()) {
            let vertex = |p: Point| Vertex { position: [p[0], p[1], p[2]], rate: p[3] };
            let (found, expected) = (orient4d(five.map(vertex)), determinant(five));
            let exact = exact_orient4d(five.map(vertex));
            prop_assert_eq!(exact.exact_sign(), expected.exact_sign());
            prop_assert_eq!(Sign::of_f64(found).expect("no NaN"), exact.exact_sign());
            let found = BigRational::from_float(found).expect("finite");
            prop_assert!((found - &expected).abs() <= expected.abs());
        }

        /// N of Equation (1) is `formula`'s insphere, and so is D's orientation.
        #[test]
        fn the_orientation_is_that_of_the_formulas(five in points()) {
            let [a, b, c, d, e] = five.map(|p| coordinates([p[0], p[1], p[2]]));
            let staged = robust::insphere(a, b, c, d, e);
            let [x, y, z, v, w] = five.map(|p| Vec3::<Dyadic>::from_f64([p[0], p[1], p[2]]));
            let exact = formula::insphere([&v, &x, &y, &z, &w]);
            prop_assert_eq!(Sign::of_f64(staged).expect("no NaN"), exact.exact_sign());
        }
    }
}
