//! The determinants in integers of fixed size, for points that lie on a common grid not much finer than their
//! coordinates are large: exact, without allocation, in some 60 ns where one word holds a coordinate.
//!
//! These are the polynomials of [`super::formula`] a second time, since each product here has just as many words as it
//! needs. In a ring whose numbers all have the five words of insphere, [`super::formula`] would do; measured, insphere
//! then takes 4,200 instructions in place of 1,060.
//!
//! Where all coordinates are below 2^(64D−3) in units of the grid, with D words for a difference, then differences are
//! below 2^(64D−2), 2×2 minors below 2^(128D−3), 3×3 minors below 3·2^(192D−5) and the sum of four of them below
//! 2^(192D−2), lifts below 3·2^(128D−4), and the lifted determinant below 36·2^(320D−9): all fit 2D, 3D, 2D and 5D
//! words.

use crate::number::bits::{exponent, lowest_bit};
use crate::number::{Integer, Sign};

/// The finest grid on which all of these coordinates lie, and how many bits the largest of them has in its units.
pub(super) fn grid_and_bits(points: &[[f64; 3]]) -> (i32, i32) {
    let (mut grid, mut top) = (i32::MAX, i32::MIN);
    for &x in points.iter().flatten() {
        let Some(low) = lowest_bit(x) else { continue };
        grid = grid.min(low);
        top = top.max(exponent(x) + 1);
    }
    if grid == i32::MAX {
        (0, 0)
    } else {
        (grid, top - grid)
    }
}

/// The bits of a coordinate for which D words are enough.
pub(super) const fn most_bits(words: usize) -> i32 {
    64 * words as i32 - 3
}

type Vector<const D: usize> = [Integer<D>; 3];

#[inline(always)]
fn difference<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    [a[0].minus(&b[0]), a[1].minus(&b[1]), a[2].minus(&b[2])]
}

/// x_a·y_b − x_b·y_a.
#[inline(always)]
fn minor<const D: usize, const D2: usize>(a: &Vector<D>, b: &Vector<D>) -> Integer<D2> {
    a[0].times::<D, D2>(&b[1]).minus(&b[0].times(&a[1]))
}

/// |p|².
#[inline(always)]
fn lift<const D: usize, const D2: usize>([x, y, z]: &Vector<D>) -> Integer<D2> {
    x.times::<D, D2>(x).plus(&y.times(y)).plus(&z.times(z))
}

/// z_a·bc − z_b·ac + z_c·ab, for the minors of two.
#[inline(always)]
fn expand<const D: usize, const D2: usize, const D3: usize>(
    [a, b, c]: [&Vector<D>; 3],
    [bc, ac, ab]: [&Integer<D2>; 3],
) -> Integer<D3> {
    let outer: Integer<D3> = a[2].times(bc);
    outer.minus(&b[2].times(ac)).plus(&c[2].times(ab))
}

/// The sign of orient2d, in the first two coordinates.
#[inline]
pub(super) fn orient2d<const D: usize, const D2: usize>([a, b, c]: [Vector<D>; 3]) -> Sign {
    minor::<D, D2>(&difference(&b, &a), &difference(&c, &a)).sign()
}

/// The sign of orient3d.
#[inline]
pub(super) fn orient3d<const D: usize, const D2: usize, const D3: usize>(
    [a, b, c, d]: [Vector<D>; 4],
) -> Sign {
    let (b, c, d) = (difference(&b, &a), difference(&c, &a), difference(&d, &a));
    let minors: [Integer<D2>; 3] = [minor(&c, &d), minor(&b, &d), minor(&b, &c)];
    expand::<D, D2, D3>([&b, &c, &d], minors.each_ref()).sign()
}

/// The sign of insphere, and the circuit's coefficients: see [`super::formula::circuit`].
#[inline]
pub(super) fn insphere<const D: usize, const D2: usize, const D3: usize, const D5: usize>(
    [a, b, c, d, e]: [Vector<D>; 5],
) -> (Sign, [Integer<D3>; 5]) {
    let q = [
        difference(&a, &e),
        difference(&b, &e),
        difference(&c, &e),
        difference(&d, &e),
    ];
    let [a, b, c, d] = q.each_ref();
    let (ab, ac, ad): (Integer<D2>, Integer<D2>, Integer<D2>) =
        (minor(a, b), minor(a, c), minor(a, d));
    let (bc, bd, cd): (Integer<D2>, Integer<D2>, Integer<D2>) =
        (minor(b, c), minor(b, d), minor(c, d));
    let bcd: Integer<D3> = expand([b, c, d], [&cd, &bd, &bc]);
    let acd: Integer<D3> = expand([a, c, d], [&cd, &ad, &ac]);
    let abd: Integer<D3> = expand([a, b, d], [&bd, &ad, &ab]);
    let abc: Integer<D3> = expand([a, b, c], [&bc, &ac, &ab]);
    // −Σ c_i·h_i with c = (−bcd, acd, −abd, abc).
    let outer: Integer<D5> = bcd.times(&lift::<D, D2>(a));
    let det = outer
        .minus(&acd.times(&lift::<D, D2>(b)))
        .plus(&abd.times(&lift::<D, D2>(c)))
        .minus(&abc.times(&lift::<D, D2>(d)));
    let ce = bcd.plus(&abd).minus(&acd).minus(&abc);
    let zero = Integer::ZERO;
    (
        det.sign(),
        [zero.minus(&bcd), acd, zero.minus(&abd), abc, ce],
    )
}
