//! The polynomials whose exact signs are needed, and how large their values get ([`Formula::GROWTH`]): if coordinates
//! are below 2^b, differences are below 2^(b+1), orient3d has 6 products of three of them, and so on.

use crate::number::{Number, Vec3};
use crate::predicate::formula;
use crate::verify::signs::fixed::Formula;

/// orient3d of four points.
pub(crate) struct Orient;

impl Formula for Orient {
    const DEGREE: u32 = 3;
    const GROWTH: u32 = 6;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        formula::orient3d([&p[0], &p[1], &p[2], &p[3]])
    }
}

/// insphere of five points.
pub(crate) struct Insphere;

impl Formula for Insphere {
    const DEGREE: u32 = 5;
    const GROWTH: u32 = 12;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        formula::insphere([&p[0], &p[1], &p[2], &p[3], &p[4]])
    }
}

/// Σ orient(a, b, c, q) over the points after the first three: at most eight.
pub(crate) struct Side;

impl Formula for Side {
    const DEGREE: u32 = 3;
    const GROWTH: u32 = 9;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        let [a, b, c] = [&p[0], &p[1], &p[2]];
        let zero = N::from_f64(0.0);
        p[3..]
            .iter()
            .fold(zero, |sum, q| sum + &formula::orient3d([a, b, c, q]))
    }
}

/// The same in the plane of two axes.
pub(crate) struct Side2d {
    pub(crate) axes: [usize; 2],
}

impl Formula for Side2d {
    const DEGREE: u32 = 2;
    const GROWTH: u32 = 6;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        let at = |q: &Vec3<N>| self.axes.map(|k| q.0[k].clone());
        let [a, b] = [at(&p[0]), at(&p[1])];
        p[2..].iter().fold(N::from_f64(0.0), |sum, q| {
            sum + &formula::orient2d([&a, &b, &at(q)])
        })
    }
}

/// Σ (q − v) along an axis, v being the first point.
pub(crate) struct Compare {
    pub(crate) axis: usize,
}

impl Formula for Compare {
    const DEGREE: u32 = 1;
    const GROWTH: u32 = 4;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        let x = |q: &Vec3<N>| q.0[self.axis].clone();
        p[1..].iter().fold(N::from_f64(0.0), |sum, q| {
            sum + &(x(q) - &p[0].0[self.axis])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Dyadic, Exact};
    use proptest::prelude::*;

    /// The determinant as the sum over all permutations.
    fn leibniz(rows: &[Vec<i128>]) -> i128 {
        let Some((first, rest)) = rows.split_first() else {
            return 1;
        };
        let term = |k: usize| {
            let without = |row: &Vec<i128>| [&row[..k], &row[k + 1..]].concat();
            let minor: Vec<Vec<i128>> = rest.iter().map(without).collect();
            first[k] * leibniz(&minor) * if k.is_multiple_of(2) { 1 } else { -1 }
        };
        (0..first.len()).map(term).sum()
    }

    proptest! {
        /// The polynomials that the verifier shares with the construction are the determinants that they are said to
        /// be.
        #[test]
        fn polynomials_are_determinants(
            p in prop::collection::vec([-9i32..10, -9i32..10, -9i32..10], 5),
        ) {
            let exact: Vec<Vec3<Dyadic>> = p.iter().map(|q| Vec3::from_f64(q.map(f64::from))).collect();
            let row = |q: &[i32; 3], lifted: bool| {
                let [x, y, z] = q.map(i128::from);
                let lift = lifted.then_some(x * x + y * y + z * z);
                [x, y, z].into_iter().chain(lift).chain([1]).collect::<Vec<i128>>()
            };
            let sign = |x: i128| Dyadic::from_f64(x as f64).exact_sign();
            let volume: Vec<_> = p[..4].iter().map(|q| row(q, false)).collect();
            prop_assert_eq!(Orient.value(&exact[..4]).exact_sign(), sign(-leibniz(&volume)));
            let sphere: Vec<_> = p.iter().map(|q| row(q, true)).collect();
            prop_assert_eq!(Insphere.value(&exact).exact_sign(), sign(-leibniz(&sphere)));
        }
    }
}
