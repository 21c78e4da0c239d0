//! Determinants in doubles, two at a time: the polynomials of [`super::formula`], and their depth: a difference, a
//! product, a minor, a product, two sums; for insphere times the lift, and two sums more. So the error bounds are the
//! same.
//!
//! With e as the origin, the minors ab, bc, cd, da, ac, bd (ij = x_i·y_j − x_j·y_i) and heights z, the orientations of
//! e with three others are
//!
//! > abc = z_a·bc − z_b·ac + z_c·ab,  bcd = z_b·cd − z_c·bd + z_d·bc,
//! > cda = z_c·da + z_d·ac + z_a·cd,  dab = z_d·ab + z_a·bd + z_b·da,
//!
//! each from the one before by the rotation a→b→c→d→a, under which ac becomes bd, and bd becomes −ac: hence pairs.

use crate::machine::Pair;

/// The coordinates x, y, z of a, b and c, d relative to e.
type Relative = [[Pair; 2]; 3];

#[inline(always)]
fn relative(points: [&[f64; 3]; 5]) -> Relative {
    let coordinate = |i: usize| relative_coordinate(points, i);
    [coordinate(0), coordinate(1), coordinate(2)]
}

#[inline(always)]
fn relative_coordinate<const N: usize>([a, b, c, d, e]: [&[f64; N]; 5], i: usize) -> [Pair; 2] {
    let origin = Pair::new(e[i], e[i]);
    [
        Pair::new(a[i], b[i]) - origin,
        Pair::new(c[i], d[i]) - origin,
    ]
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

/// |a−e|², |b−e|² and |c−e|², |d−e|².
#[inline(always)]
fn squares([x, y, z]: &Relative) -> [Pair; 2] {
    [
        x[0] * x[0] + y[0] * y[0] + z[0] * z[0],
        x[1] * x[1] + y[1] * y[1] + z[1] * z[1],
    ]
}

/// orient4d(a,b,c,d,e) from the heights of a, b and c, d relative to that of e.
#[inline(always)]
fn below(orientations: &[Pair; 2], heights: &[Pair; 2]) -> f64 {
    // The height that is missing from each orientation: h_d, h_a and h_b, h_c.
    let missing = [heights[1].middle(heights[0]), heights[0].middle(heights[1])];
    // d·abc + b·cda and a·bcd + c·dab.
    let terms = missing[0] * orientations[0] + missing[1] * orientations[1];
    terms.second() - terms.first()
}

/// insphere(a,b,c,d,e), and the largest of the four lifts |a−e|², …
#[inline(always)]
pub(super) fn insphere(points: [&[f64; 3]; 5]) -> (f64, f64) {
    let relative = relative(points);
    let lifts = squares(&relative);
    let value = below(&orientations(&relative), &lifts);
    (value, lifts[0].larger(lifts[1]).larger_lane())
}

/// Five points whose heights, the fourth coordinates, change with time.
pub(crate) struct Circuit {
    relative: Relative,
    /// Relative to that of e.
    heights: [Pair; 2],
    orientations: [Pair; 2],
}

impl Circuit {
    #[inline(always)]
    pub(crate) fn new(points: [&[f64; 4]; 5]) -> Circuit {
        let coordinate = |i: usize| relative_coordinate(points, i);
        let relative = [coordinate(0), coordinate(1), coordinate(2)];
        Circuit {
            orientations: orientations(&relative),
            heights: coordinate(3),
            relative,
        }
    }

    /// The largest differences of the coordinates to those of e. If one is NaN, any.
    #[inline(always)]
    pub(crate) fn largest_differences(&self) -> [f64; 3] {
        let largest = |[ab, cd]: &[Pair; 2]| ab.magnitudes().larger(cd.magnitudes()).larger_lane();
        let [x, y, z] = &self.relative;
        [largest(x), largest(y), largest(z)]
    }

    /// orient4d(a,b,c,d,e) with the heights.
    #[inline(always)]
    pub(crate) fn below(&self) -> f64 {
        below(&self.orientations, &self.heights)
    }

    /// insphere(a,b,c,d,e).
    #[inline(always)]
    pub(crate) fn insphere(&self) -> f64 {
        below(&self.orientations, &squares(&self.relative))
    }

    /// The circuit's coefficients of a, b, c, d.
    #[inline(always)]
    pub(crate) fn coefficients(&self) -> [f64; 4] {
        let [first, second] = &self.orientations;
        [
            -first.second(),
            second.first(),
            -second.second(),
            first.first(),
        ]
    }

    /// Which of the coefficients of b, c, d are less than −`bound` for certain, as bits, and which are greater than
    /// `bound`.
    #[inline(always)]
    pub(crate) fn signs(&self, bound: f64) -> [u8; 2] {
        let bounds = Pair::new(bound, bound);
        let [first, second] = self.orientations;
        let zero = Pair::new(0.0, 0.0);
        // abc, bcd and cda, dab: the coefficients of d, −a, b, −c.
        let (above_first, above_second) = (first.above(bounds), second.above(bounds));
        let (below_first, below_second) =
            ((zero - first).above(bounds), (zero - second).above(bounds));
        [
            below_second & 1 | above_second & 2 | (below_first & 1) << 2,
            above_second & 1 | below_second & 2 | (above_first & 1) << 2,
        ]
    }
}

/// (a, b), (c, d) to (b, c), (d, a).
#[inline(always)]
fn rotated([ab, cd]: [Pair; 2]) -> [Pair; 2] {
    [ab.middle(cd), cd.middle(ab)]
}
