//! Determinants in doubles, two at a time: the polynomials of [`super::formula`], and their depth: a difference, a product,
//! a minor, a product, two sums; for insphere times the lift, and two sums more. So the error bounds are the same.
//!
//! With e as the origin, the minors ab, bc, cd, da, ac, bd (ij = x_i·y_j − x_j·y_i) and heights z, the orientations of e with
//! three others are
//!
//! > abc = z_a·bc − z_b·ac + z_c·ab,  bcd = z_b·cd − z_c·bd + z_d·bc,
//! > cda = z_c·da + z_d·ac + z_a·cd,  dab = z_d·ab + z_a·bd + z_b·da,
//!
//! each from the one before by the rotation a→b→c→d→a, under which ac becomes bd, and bd becomes −ac: hence pairs.

use crate::machine::Pair;

/// The coordinates x, y, z of a, b and c, d relative to e.
type Relative = [[Pair; 2]; 3];

#[inline(always)]
fn relative([a, b, c, d, e]: [&[f64; 3]; 5]) -> Relative {
    let coordinate = |i: usize| {
        let origin = Pair::new(e[i], e[i]);
        [
            Pair::new(a[i], b[i]) - origin,
            Pair::new(c[i], d[i]) - origin,
        ]
    };
    [coordinate(0), coordinate(1), coordinate(2)]
}

/// abc, bcd and cda, dab.
#[inline(always)]
fn orientations([x, y, z]: &Relative) -> [Pair; 2] {
    let [xr, yr, zr] = [rotated(*x), rotated(*y), rotated(*z)];
    // ab, bc and cd, da.
    let sides = [x[0] * yr[0] - xr[0] * y[0], x[1] * yr[1] - xr[1] * y[1]];
    // ac, bd.
    let diagonals = x[0] * y[1] - x[1] * y[0];
    // bc, cd and da, ab.
    let next = rotated(sides);
    [
        z[0] * next[0] - zr[0] * diagonals + z[1] * sides[0],
        z[1] * next[1] + zr[1] * diagonals + z[0] * sides[1],
    ]
}

/// The orientations of abcd with e in place of a, of b, of c, of d: on the positive side of all facets is the inside.
#[inline(always)]
pub(super) fn sides(points: [&[f64; 3]; 5]) -> [f64; 4] {
    let [first, second] = orientations(&relative(points));
    [
        first.second(),
        -second.first(),
        second.second(),
        -first.first(),
    ]
}

/// insphere(a,b,c,d,e), and the largest of the four lifts |a−e|², …
#[inline(always)]
pub(super) fn insphere(points: [&[f64; 3]; 5]) -> (f64, f64) {
    let relative = relative(points);
    let orientations = orientations(&relative);
    let [x, y, z] = relative;
    let lifts = [
        x[0] * x[0] + y[0] * y[0] + z[0] * z[0],
        x[1] * x[1] + y[1] * y[1] + z[1] * z[1],
    ];
    // The lift that is missing from each orientation: h_d, h_a and h_b, h_c.
    let missing = [lifts[1].middle(lifts[0]), lifts[0].middle(lifts[1])];
    // d·abc + b·cda and a·bcd + c·dab.
    let terms = missing[0] * orientations[0] + missing[1] * orientations[1];
    let largest = lifts[0].larger(lifts[1]);
    let (first, second) = (largest.first(), largest.second());
    let largest = if first > second { first } else { second };
    (terms.second() - terms.first(), largest)
}

/// (a, b), (c, d) to (b, c), (d, a).
#[inline(always)]
fn rotated([ab, cd]: [Pair; 2]) -> [Pair; 2] {
    [ab.middle(cd), cd.middle(ab)]
}
