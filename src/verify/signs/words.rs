//! Determinants of integers of at most 62 bits, in a few machine words: the exact signs that are needed most often,
//! of points that are exactly coplanar or cospherical, or nearly.
//!
//! # Sizes
//! Coordinates are below 2⁶¹ and differences below 2⁶². A minor of two rows is below 2·2¹²⁴, one of three below
//! 6·2¹⁸⁶ < 2¹⁸⁹ ([`Wide`] has 192 bits), a square of a length below 3·2¹²⁴ < 2¹²⁶, and insphere below 4·2¹⁸⁹·2¹²⁶ =
//! 2³¹⁷ (320 bits). If differences are below 2⁴¹, three rows fit in 128 bits (6·2¹²³ < 2¹²⁷), and if they are below
//! 2²⁴, so does insphere (24·3·2¹²⁰ < 2¹²⁷).

use crate::number::Sign;

/// A point in units of a power of two.
pub(crate) type Cell = [i64; 3];

/// What coordinates are below.
pub(crate) const LARGEST: f64 = (1u64 << 61) as f64;

/// high·2⁶⁴ + low.
#[derive(Clone, Copy)]
struct Wide {
    high: i128,
    low: u64,
}

impl Wide {
    /// The product of a word and a double word.
    #[inline(always)]
    fn product(x: i64, y: i128) -> Wide {
        let low = i128::from(x) * (y & i128::from(u64::MAX));
        Wide {
            high: i128::from(x) * (y >> 64) + (low >> 64),
            low: low as u64,
        }
    }

    #[inline(always)]
    fn plus(self, other: Wide) -> Wide {
        let (low, carry) = self.low.overflowing_add(other.low);
        Wide {
            high: self.high + other.high + i128::from(carry),
            low,
        }
    }

    fn sign(self) -> Sign {
        match (self.high, self.low) {
            (0, 0) => Sign::Zero,
            (high, _) if high < 0 => Sign::Negative,
            _ => Sign::Positive,
        }
    }
}

fn sign(x: i128) -> Sign {
    match x {
        0 => Sign::Zero,
        x if x < 0 => Sign::Negative,
        _ => Sign::Positive,
    }
}

#[inline(always)]
fn minus(a: Cell, b: Cell) -> Cell {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// All bits that the absolute values have.
#[inline(always)]
fn bits(rows: &[Cell]) -> u64 {
    let all = rows.iter().flatten();
    all.fold(0, |bits, x| bits | x.unsigned_abs())
}

/// The minor of two rows without the third column.
#[inline(always)]
fn minor(a: Cell, b: Cell) -> i128 {
    let product = |x: i64, y: i64| i128::from(x) * i128::from(y);
    product(a[0], b[1]) - product(a[1], b[0])
}

/// z₀m₀ + z₁m₁ + z₂m₂, if that is below 2¹²⁷.
#[inline(always)]
fn narrow(z: [i64; 3], m: [i128; 3]) -> i128 {
    i128::from(z[0]) * m[0] + i128::from(z[1]) * m[1] + i128::from(z[2]) * m[2]
}

#[inline(always)]
fn wide(z: [i64; 3], m: [i128; 3]) -> Wide {
    let [p, q, r] = [
        Wide::product(z[0], m[0]),
        Wide::product(z[1], m[1]),
        Wide::product(z[2], m[2]),
    ];
    p.plus(q).plus(r)
}

/// The sign of det[b−a, c−a, d−a].
pub(crate) fn orient([a, b, c, d]: [Cell; 4]) -> Sign {
    let rows = [minus(b, a), minus(c, a), minus(d, a)];
    let [p, q, r] = rows;
    let z = [p[2], q[2], r[2]];
    let m = [minor(q, r), minor(r, p), minor(p, q)];
    if bits(&rows) < 1 << 41 {
        sign(narrow(z, m))
    } else {
        wide(z, m).sign()
    }
}

/// The sign of (b−a)×(c−a), in two coordinates.
pub(crate) fn orient2d([a, b, c]: [[i64; 2]; 3]) -> Sign {
    let [p, q] = [b, c].map(|x| [x[0] - a[0], x[1] - a[1], 0]);
    sign(minor(p, q))
}

/// The sign of insphere, positive iff e is inside the circumsphere of the positive abcd.
pub(crate) fn insphere([a, b, c, d, e]: [Cell; 5]) -> Sign {
    let rows = [minus(a, e), minus(b, e), minus(c, e), minus(d, e)];
    let [p, q, r, s] = rows;
    let (ab, ac, ad) = (minor(p, q), minor(p, r), minor(p, s));
    let (bc, bd, cd) = (minor(q, r), minor(q, s), minor(r, s));
    let lift = rows.map(|x| {
        let square = |x: i64| i128::from(x) * i128::from(x);
        square(x[0]) + square(x[1]) + square(x[2])
    });
    // Σ lift·minor, with the signs of the second and the fourth term in their minors.
    let z = [
        [q[2], r[2], s[2]],
        [p[2], r[2], s[2]],
        [p[2], q[2], s[2]],
        [p[2], q[2], r[2]],
    ];
    let m = [[cd, -bd, bc], [-cd, ad, -ac], [bd, -ad, ab], [-bc, ac, -ab]];
    if bits(&rows) < 1 << 24 {
        return sign((0..4).map(|i| lift[i] * narrow(z[i], m[i])).sum());
    }
    let mut sum = [0; 5];
    for i in 0..4 {
        add_product(&mut sum, wide(z[i], m[i]), lift[i] as u128);
    }
    if sum == [0; 5] {
        Sign::Zero
    } else if sum[4] >> 63 == 1 {
        Sign::Negative
    } else {
        Sign::Positive
    }
}

/// sum += xy, modulo 2³²⁰.
#[inline(always)]
fn add_product(sum: &mut [u64; 5], x: Wide, y: u128) {
    let extension = (x.high >> 127) as u64;
    let x = [
        x.low,
        x.high as u64,
        (x.high >> 64) as u64,
        extension,
        extension,
    ];
    for (j, y) in [y as u64, (y >> 64) as u64].into_iter().enumerate() {
        let mut carry = 0;
        for i in 0..5 - j {
            let product = u128::from(x[i]) * u128::from(y) + u128::from(sum[i + j]) + carry;
            sum[i + j] = product as u64;
            carry = product >> 64;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Dyadic, Exact, Number, Vec3};
    use crate::predicate::formula;
    use proptest::prelude::*;

    /// Of all sizes; small offsets from a common value make many zeros.
    fn points() -> impl Strategy<Value = [Cell; 5]> {
        let offset = prop_oneof![
            -2i64..3,
            -(1i64 << 23)..1 << 23,
            -(1i64 << 40)..1 << 40,
            -(1i64 << 60)..1 << 60,
            Just((1i64 << 61) - 1),
            Just(1 - (1i64 << 61)),
        ];
        let small = prop::array::uniform5(prop::array::uniform3(-2i64..3));
        let shifted =
            (small.clone(), 0u32..60).prop_map(|(p, k)| p.map(|p| p.map(|x| x << (k % 59))));
        let any = prop::array::uniform5(prop::array::uniform3(offset));
        prop_oneof![shifted, any]
    }

    fn dyadic(p: Cell) -> Vec3<Dyadic> {
        let number = |x: i64| {
            let (high, low) = (x >> 32, x & 0xffff_ffff);
            Dyadic::from_f64(high as f64).shifted(32) + &Dyadic::from_f64(low as f64)
        };
        Vec3(p.map(number))
    }

    proptest! {
        #[test]
        fn signs_are_exact(p in points()) {
            let e = p.map(dyadic);
            let [a, b, c, d, _] = e.each_ref();
            let [pa, pb, pc, pd, _] = p;
            prop_assert_eq!(orient([pa, pb, pc, pd]), formula::orient3d([a, b, c, d]).exact_sign());
            prop_assert_eq!(insphere(p), formula::insphere(e.each_ref()).exact_sign());
            let flat = [pa, pb, pc].map(|x| [x[0], x[1], 0]);
            let up = [flat[0][0], flat[0][1], 1];
            let f = [flat[0], flat[1], flat[2], up].map(dyadic);
            let plane = [pa, pb, pc].map(|x| [x[0], x[1]]);
            prop_assert_eq!(orient2d(plane), formula::orient3d(f.each_ref()).exact_sign());
        }
    }
}
