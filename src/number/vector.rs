//! Vectors of three numbers, and the same operations on coordinates as they are stored, in doubles.

use super::Number;

/// A point or vector with three coordinates x, y, z.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Vec3<N>(pub [N; 3]);

impl<N: Number> Vec3<N> {
    /// The vector with the given double coordinates.
    #[inline]
    pub fn from_f64([x, y, z]: [f64; 3]) -> Self {
        Vec3([N::from_f64(x), N::from_f64(y), N::from_f64(z)])
    }

    /// self − other.
    #[inline(always)]
    pub fn sub(&self, other: &Self) -> Self {
        let [ax, ay, az] = &self.0;
        let [bx, by, bz] = &other.0;
        Vec3([ax.clone() - bx, ay.clone() - by, az.clone() - bz])
    }

    /// self · other.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> N {
        let [ax, ay, az] = &self.0;
        let [bx, by, bz] = &other.0;
        ax.clone() * bx + &(ay.clone() * by) + &(az.clone() * bz)
    }

    /// self × other.
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> Self {
        let [ax, ay, az] = &self.0;
        let [bx, by, bz] = &other.0;
        Vec3([
            ay.clone() * bz - &(az.clone() * by),
            az.clone() * bx - &(ax.clone() * bz),
            ax.clone() * by - &(ay.clone() * bx),
        ])
    }
}

/// a − b, rounded.
#[inline]
pub(crate) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    Vec3(a).sub(&Vec3(b)).0
}

/// a·b, rounded.
#[inline]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    Vec3(a).dot(&Vec3(b))
}

/// a×b, rounded.
#[inline]
pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    Vec3(a).cross(&Vec3(b)).0
}

/// |a|², rounded.
#[inline]
pub(crate) fn square(a: [f64; 3]) -> f64 {
    dot(a, a)
}
