//! Floats of a chosen number of mantissa bits, against the hardware and against rationals.
//!
//! Claims tested:
//! 1. Sums, differences, products and quotients of `Wide<53>` are those of `f64`, and those of `Wide<24>` are those of
//!    `f32`, wherever the hardware neither over- nor underflows; so are whole determinants.
//! 2. Every operation gives the number nearest to the exact result, of two nearest ones the even one.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;
use tetflip::number::{Dyadic, Exact, Float, Number, Vec3, Wide};
use tetflip::predicate::formula::insphere;

/// Doubles whose sums, products and quotients are normal singles; many of them with few bits, so that ties occur.
fn moderate() -> impl Strategy<Value = f64> + Clone {
    let short = (-99i32..100, -20i32..20).prop_map(|(m, e)| f64::from(m) * 2f64.powi(e));
    let long = (-1.0..1.0, -20i32..20).prop_map(|(m, e): (f64, i32)| m * 2f64.powi(e));
    let near_one = (-4i32..5).prop_map(|k| 1.0 + f64::from(k) * f64::EPSILON);
    let near_one_single = (-4i32..5).prop_map(|k| 1.0 + f64::from(k) * f64::from(f32::EPSILON));
    let all = prop_oneof![short, long, near_one, near_one_single];
    all.prop_filter("normal", |x| *x == 0.0 || x.abs() > 1e-8)
}

/// a + b, a − b, a·b and, if there is one, −a/b.
fn operations<N: Float>(a: &N, b: &N) -> Vec<Option<N>> {
    vec![
        Some(a.clone() + b),
        Some(a.clone() - b),
        Some(a.clone() * b),
        N::negated_quotient(a, b),
    ]
}

fn doubles<N: Number>(numbers: Vec<Option<N>>) -> Vec<Option<f64>> {
    numbers.into_iter().map(|x| x.map(|x| x.to_f64())).collect()
}

/// An exact copy, by its leading 64 bits again and again.
fn rational(x: &Dyadic) -> BigRational {
    let mut rest = x.clone();
    let mut sum = BigRational::zero();
    while !rest.exact_sign().is_zero() {
        let head = rest.to_f64();
        sum += <BigRational as Number>::from_f64(head);
        rest = rest - &Dyadic::from_f64(head);
    }
    sum
}

/// The definition: the multiple of 2^e nearest to x, where 2^(bits−1) ≤ |x|/2^e < 2^bits.
fn nearest_even(x: &BigRational, bits: i32) -> BigRational {
    if x.is_zero() {
        return x.clone();
    }
    let two = BigRational::one() + BigRational::one();
    let size = x.abs();
    let mut unit = BigRational::one();
    while &size / &unit >= two.pow(bits) {
        unit *= &two;
    }
    while &size / &unit < two.pow(bits - 1) {
        unit /= &two;
    }
    let below = (&size / &unit).floor();
    let rest = &size / &unit - &below;
    let half = BigRational::one() / &two;
    let is_odd = !(&below / &two).is_integer();
    let up = rest > half || (rest == half && is_odd);
    let head = if up {
        below + BigRational::one()
    } else {
        below
    };
    head * unit * x.signum()
}

/// Claim 2 in one width.
fn check_rounding<const BITS: u32>(a: f64, b: f64) -> Result<(), TestCaseError> {
    let bits = BITS as i32;
    let (wa, wb) = (Wide::<BITS>::from_f64(a), Wide::<BITS>::from_f64(b));
    let (a, b) = (rational(wa.value()), rational(wb.value()));
    let exact = [
        Some(&a + &b),
        Some(&a - &b),
        Some(&a * &b),
        (!b.is_zero()).then(|| -&a / &b),
    ];
    for (ours, exact) in operations(&wa, &wb).into_iter().zip(exact) {
        let ours = ours.map(|x| rational(x.value()));
        prop_assert_eq!(ours, exact.map(|x| nearest_even(&x, bits)));
    }
    prop_assert_eq!(Wide::compare(&wa, &wb), a.cmp(&b));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn fifty_three_bits_are_those_of_a_double(a in moderate(), b in moderate()) {
        let ours = operations(&Wide::<53>::from_f64(a), &Wide::<53>::from_f64(b));
        prop_assert_eq!(doubles(ours), doubles(operations(&a, &b)));
    }

    #[test]
    fn twenty_four_bits_are_those_of_a_single(a in moderate(), b in moderate()) {
        let ours = operations(&Wide::<24>::from_f64(a), &Wide::<24>::from_f64(b));
        prop_assert_eq!(doubles(ours), doubles(operations(&(a as f32), &(b as f32))));
    }

    #[test]
    fn determinants_round_in_the_same_way(points in prop::array::uniform5(prop::array::uniform3(-1.0..1.0))) {
        fn value<N: Number>(points: [[f64; 3]; 5]) -> f64 {
            insphere(points.map(Vec3::<N>::from_f64).each_ref()).to_f64()
        }
        prop_assert_eq!(value::<Wide<53>>(points), value::<f64>(points));
        prop_assert_eq!(value::<Wide<24>>(points), value::<f32>(points));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn every_operation_rounds_to_nearest_even(a in moderate(), b in moderate()) {
        check_rounding::<1>(a, b)?;
        check_rounding::<8>(a, b)?;
        check_rounding::<24>(a, b)?;
        check_rounding::<53>(a, b)?;
        check_rounding::<64>(a, b)?;
        check_rounding::<106>(a, b)?;
        check_rounding::<256>(a, b)?;
    }
}
