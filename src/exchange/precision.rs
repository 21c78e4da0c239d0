//! The precision of an input: how far its coordinates may be from what was meant, derived from their values.
//!
//! Nothing is known of the spelling: a value counts with its shortest decimal that reads back to the same double. What
//! is assumed is that all coordinates have been through one rounding, the coarsest that explains all of them, and that
//! nobody rounds to what short numbers are: 0, 0.5 and 12 are meant.

use serde::{Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// How far coordinates may be from what was meant.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize)]
pub struct Precision {
    /// The distance δ in the unit of the coordinates, along each axis; 0 if they are exact.
    pub delta: f64,
    /// What it follows from.
    pub rounding: Rounding,
}

/// The rounding that explains all coordinates.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Rounding {
    /// None: all are short decimals, or small multiples of one power of two; or the coordinates are to be exact.
    #[default]
    None,
    /// The user says so.
    Given,
    /// All are values of float32: half a unit of it at the largest.
    Float32,
    /// So many significant digits are enough for all: half a unit of the last at the largest.
    Digits(u32),
    /// So many decimals are enough for all: half a unit of the last.
    Decimals(u32),
    /// That of doubles: 8 units at the largest, for what was computed in doubles.
    Double,
}

/// In a word or two: `none`, `given`, `float32`, `6 digits`, `3 decimals`, `double`.
impl Serialize for Rounding {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Rounding::None => serializer.serialize_str("none"),
            Rounding::Given => serializer.serialize_str("given"),
            Rounding::Float32 => serializer.serialize_str("float32"),
            Rounding::Digits(n) => serializer.collect_str(&format_args!("{n} digits")),
            Rounding::Decimals(n) => serializer.collect_str(&format_args!("{n} decimals")),
            Rounding::Double => serializer.serialize_str("double"),
        }
    }
}

impl fmt::Display for Rounding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Rounding::None => f.write_str("the coordinates are exact"),
            Rounding::Given => f.write_str("as given"),
            Rounding::Float32 => f.write_str("half a unit of float32 at the largest coordinate"),
            Rounding::Digits(n) => write!(
                f,
                "half a unit of the last of {n} digits of the largest coordinate"
            ),
            Rounding::Decimals(n) => write!(f, "half a unit of the last of {n} decimals"),
            Rounding::Double => f.write_str("8 units of double at the largest coordinate"),
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:e} ({})", self.delta, self.rounding)
    }
}

/// Which precision an input has.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum PrecisionChoice {
    /// The one that its coordinates tell ([`Precision::of`]).
    #[default]
    Auto,
    /// All coordinates are meant as they are.
    Exact,
    /// This distance in the unit of the coordinates.
    Given(f64),
}

impl PrecisionChoice {
    /// The precision of points. Linear time.
    pub fn of(self, points: &[[f64; 3]]) -> Precision {
        match self {
            PrecisionChoice::Auto => Precision::of(points),
            PrecisionChoice::Exact => Precision::default(),
            PrecisionChoice::Given(delta) => Precision {
                delta,
                rounding: Rounding::Given,
            },
        }
    }
}

impl fmt::Display for PrecisionChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PrecisionChoice::Auto => f.write_str("auto"),
            PrecisionChoice::Exact => f.write_str("exact"),
            PrecisionChoice::Given(delta) => write!(f, "{delta:e}"),
        }
    }
}

impl FromStr for PrecisionChoice {
    type Err = &'static str;

    fn from_str(word: &str) -> Result<PrecisionChoice, &'static str> {
        match word {
            "auto" => Ok(PrecisionChoice::Auto),
            "exact" => Ok(PrecisionChoice::Exact),
            _ => match word.parse::<f64>() {
                Ok(delta) if delta.is_finite() && delta >= 0.0 => Ok(PrecisionChoice::Given(delta)),
                _ => Err("none of auto, exact, and a distance from 0 on"),
            },
        }
    }
}

/// From so many significant digits on they count as rounded.
const LEAST_DIGITS: i32 = 6;
/// From so many decimals on they count as rounded.
const LEAST_DECIMALS: i32 = 3;
/// More significant digits than doubles hold for certain are their own rounding.
const MOST_DIGITS: i32 = 15;
/// The half unit of a decimal rounding is at most this part of the model.
const COARSEST: f64 = 1e-4;
/// Multiples of a power of two are meant if they are less than two to the power of this.
const LATTICE_BITS: i32 = 16;

impl Precision {
    /// The precision of points, of which those that are not finite count for nothing. Linear time.
    pub fn of(points: &[[f64; 3]]) -> Precision {
        let finite = points.iter().filter(|p| p.iter().all(|x| x.is_finite()));
        let coordinates = || finite.clone().flatten().copied().filter(|&x| x != 0.0);
        let largest = coordinates().fold(0.0f64, |m, x| m.max(x.abs()));
        let exact = Precision {
            delta: 0.0,
            rounding: Rounding::None,
        };
        if largest == 0.0 || is_lattice(coordinates(), largest) {
            return exact;
        }
        let (mut digits, mut decimals) = (0, 0);
        for x in coordinates() {
            let (n, d) = shortest(x);
            (digits, decimals) = (digits.max(n), decimals.max(d));
        }
        if digits < LEAST_DIGITS && decimals < LEAST_DECIMALS {
            return exact;
        }
        if coordinates().all(|x| f64::from(x as f32) == x) {
            return Precision {
                delta: 0.5 * (largest as f32).abs().next_up_gap(),
                rounding: Rounding::Float32,
            };
        }
        let size = (0..3).map(|k| extent(finite.clone().map(|p| p[k])));
        let size = size.fold(0.0, f64::max);
        let exponent = exponent_of(largest);
        // Of numbers with so many decimals nearly all have all of them, of whatever size they are; of numbers with so
        // many digits nearly all have these.
        let (mut of_digits, mut of_decimals) = (0, 0);
        for x in coordinates() {
            let (n, d) = shortest(x);
            of_digits += usize::from(n == digits);
            of_decimals += usize::from(d == decimals);
        }
        let fixed = decimals >= LEAST_DECIMALS && of_decimals >= of_digits;
        let (unit, rounding) = match fixed || digits < LEAST_DIGITS {
            true => (-decimals, Rounding::Decimals(decimals.unsigned_abs())),
            false => (
                exponent + 1 - digits,
                Rounding::Digits(digits.unsigned_abs()),
            ),
        };
        let delta = 0.5 * 10f64.powi(unit);
        if digits <= MOST_DIGITS && delta <= COARSEST * size {
            return Precision { delta, rounding };
        }
        Precision {
            delta: 8.0 * (largest.next_up() - largest),
            rounding: Rounding::Double,
        }
    }
}

/// The distance from a float32 to the next.
trait Gap {
    fn next_up_gap(self) -> f64;
}

impl Gap for f32 {
    fn next_up_gap(self) -> f64 {
        f64::from(self.next_up()) - f64::from(self)
    }
}

/// Whether all values are multiples of one power of two, less than two to the power of [`LATTICE_BITS`] times it.
fn is_lattice(coordinates: impl Iterator<Item = f64>, largest: f64) -> bool {
    // The largest is below 2^e.
    let e = (largest.to_bits() >> 52) as i32 - 1022;
    let unit = 2f64.powi((e - LATTICE_BITS).max(-1022));
    let mut coordinates = coordinates;
    // A quotient by a power of two is exact unless it is too small.
    coordinates.all(|x| (x / unit).fract() == 0.0 && (x / unit) * unit == x)
}

/// The numbers of significant digits and of decimals of the shortest decimal that reads back.
fn shortest(x: f64) -> (i32, i32) {
    let text = format!("{x:e}");
    let (mantissa, exponent) = text
        .split_once('e')
        .expect("a number in scientific notation");
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).count() as i32;
    let exponent: i32 = exponent.parse().expect("an exponent");
    (digits, (digits - 1 - exponent).max(0))
}

/// The decimal exponent of the first digit.
fn exponent_of(x: f64) -> i32 {
    let text = format!("{x:e}");
    let exponent = text.split_once('e').and_then(|(_, e)| e.parse().ok());
    exponent.expect("a number in scientific notation")
}

fn extent(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let high = values.clone().fold(f64::NEG_INFINITY, f64::max);
    high - values.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A turned helix, rounded.
    fn helix(scale: f64, rounded: impl Fn(f64) -> f64) -> Precision {
        let point = |i: u32| {
            let t = f64::from(i) * 0.7;
            [t.sin(), t.cos(), t / 200.0].map(|x| rounded(x * scale))
        };
        Precision::of(&(0..200).map(point).collect::<Vec<_>>())
    }

    fn printed(text: String) -> f64 {
        text.parse().unwrap()
    }

    #[test]
    fn roundings_are_recognised() {
        let single = helix(3.0, |x| f64::from(x as f32));
        assert_eq!(single.rounding, Rounding::Float32);
        assert_eq!(single.delta, 2f64.powi(-23));
        let six = helix(3.0, |x| printed(format!("{x:.5e}")));
        assert_eq!((six.rounding, six.delta), (Rounding::Digits(6), 0.5e-5));
        let three = helix(30.0, |x| printed(format!("{x:.3}")));
        assert_eq!(
            (three.rounding, three.delta),
            (Rounding::Decimals(3), 0.5e-3)
        );
        let four = helix(3000.0, |x| printed(format!("{x:.4}")));
        assert_eq!(four.rounding, Rounding::Decimals(4));
        // Small numbers have more decimals then.
        let six = helix(0.2, |x| printed(format!("{x:.5e}")));
        assert_eq!(six.rounding, Rounding::Digits(6));
        assert!((0.49e-6..0.51e-6).contains(&six.delta));
        let double = helix(3.0, |x| x);
        assert_eq!(double.rounding, Rounding::Double);
        assert_eq!(double.delta, 8.0 * 2f64.powi(-51));
    }

    #[test]
    fn short_numbers_and_lattices_are_exact() {
        let exact = |points: &[[f64; 3]]| Precision::of(points).delta == 0.0;
        assert!(exact(&[]));
        assert!(exact(&[[0.0, 0.5, 12.0], [3.25, -7.0, 1000.0]]));
        assert!(exact(&[[0.1, 0.2, 0.3], [1.7, 2.25, 99.99]]));
        // Voxels of a size that has many digits.
        assert!(exact(&[[0.0009765625, 0.125, 12.0], [0.0, f64::NAN, 0.1]]));
        // Too coarse for the model: three decimals of a model as large as five thousandths.
        let coarse = helix(0.005, |x| printed(format!("{x:.3}")));
        assert_eq!(coarse.rounding, Rounding::Double);
    }
}
