//! The polynomials whose exact signs are needed, and how large their values get ([`Formula::GROWTH`]): if coordinates are below
//! 2^b, differences are below 2^(b+1), orient3d has 6 products of three of them, and so on.

use super::fixed::Formula;
use crate::number::{Number, Vec3};
use crate::predicate::formula;

/// orient3d of four points.
pub(super) struct Orient;

impl Formula for Orient {
    const DEGREE: u32 = 3;
    const GROWTH: u32 = 6;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        formula::orient3d([&p[0], &p[1], &p[2], &p[3]])
    }
}

/// insphere of five points.
pub(super) struct Insphere;

impl Formula for Insphere {
    const DEGREE: u32 = 5;
    const GROWTH: u32 = 12;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        formula::insphere([&p[0], &p[1], &p[2], &p[3], &p[4]])
    }
}

/// Σ orient(a, b, c, q) over the points after the first three: at most eight.
pub(super) struct Side;

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
pub(super) struct Side2d {
    pub(super) axes: [usize; 2],
}

impl Formula for Side2d {
    const DEGREE: u32 = 2;
    const GROWTH: u32 = 6;
    fn value<N: Number>(&self, p: &[Vec3<N>]) -> N {
        let from = |q: &Vec3<N>, i: usize| q.0[self.axes[i]].clone() - &p[0].0[self.axes[i]];
        let along = [from(&p[1], 0), from(&p[1], 1)];
        p[2..].iter().fold(N::from_f64(0.0), |sum, q| {
            sum + &(along[0].clone() * &from(q, 1)) - &(along[1].clone() * &from(q, 0))
        })
    }
}

/// Σ (q − v) along an axis, v being the first point.
pub(super) struct Compare {
    pub(super) axis: usize,
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
