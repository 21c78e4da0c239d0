//! The number types against each other, on the inputs that break predicates: lattices, cospherical and coplanar points,
//! needles, and exponents at both ends of the range of doubles.
//!
//! Claims tested, each over every family:
//! 1. `Dyadic`, `BigRational` (and `rug::Rational` with the feature `rug`) agree in the sign of every determinant.
//! 2. `Approx` has the true sign whenever it has one.
//! 3. `Approx::error` bounds |value − exact|, however inputs under- and overflow.
//! 4. Naive `f64` lies where `Approx` says that it does not know.

use num_rational::BigRational;
use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tetflip::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use tetflip::predicate::formula::{circuit, insphere, orient3d, orient4d};

/// Five points and their five heights.
#[derive(Clone, Copy, Debug)]
struct Input {
    points: [[f64; 3]; 5],
    heights: [f64; 5],
}

/// Every determinant of the crate on one input: five orientations, the circuit, two lifted determinants.
fn determinants<N: Number>(input: &Input) -> Vec<N> {
    let points = input.points.map(Vec3::<N>::from_f64);
    let all @ [a, b, c, d, e] = points.each_ref();
    let quadruples = [
        [a, b, c, d],
        [e, b, c, d],
        [a, e, c, d],
        [a, b, e, d],
        [a, b, c, e],
    ];
    let mut values = quadruples.map(orient3d).to_vec();
    let (coefficients, _) = circuit(all);
    let [ha, hb, hc, hd, he] = input.heights.map(N::from_f64);
    let relative = [ha - &he, hb - &he, hc - &he, hd - &he];
    values.push(orient4d(&coefficients, relative.each_ref()));
    values.extend(coefficients);
    values.push(insphere(all));
    values
}

/// The place of insphere in [`determinants`].
const INSPHERE: usize = 11;

fn signs<N: Exact>(input: &Input) -> Vec<Sign> {
    determinants::<N>(input).iter().map(N::exact_sign).collect()
}

// ---- The families ----

fn small() -> impl Strategy<Value = f64> + Clone {
    (-4i32..=4).prop_map(f64::from)
}

/// x moved by −1, 0 or 1 units in the last place, most often by 0.
fn nudge(x: f64, by: i32) -> f64 {
    let moved = match by {
        1 => x.next_up(),
        -1 => x.next_down(),
        _ => x,
    };
    if moved.is_finite() { moved } else { x }
}

fn five(point: impl Strategy<Value = [f64; 3]>) -> impl Strategy<Value = [[f64; 3]; 5]> {
    prop::array::uniform5(point)
}

fn lattice() -> impl Strategy<Value = [[f64; 3]; 5]> {
    five(prop::array::uniform3(small()))
}

/// The points (±x, ±y, ±z) and their permutations lie on one sphere about the origin; so they do after a shift.
fn cospherical() -> impl Strategy<Value = [[f64; 3]; 5]> {
    let image = (0usize..6, any::<[bool; 3]>());
    let shift = prop::array::uniform3(-1000i32..1000);
    (
        prop::array::uniform3(0i32..50),
        shift,
        prop::array::uniform5(image),
    )
        .prop_map(|(p, shift, images)| {
            let orders = [
                [0, 1, 2],
                [1, 2, 0],
                [2, 0, 1],
                [0, 2, 1],
                [2, 1, 0],
                [1, 0, 2],
            ];
            images.map(|(order, minus)| {
                std::array::from_fn(|i| {
                    let x = p[orders[order][i]];
                    f64::from(shift[i] + if minus[i] { -x } else { x })
                })
            })
        })
}

/// Points o + s·u + t·v: coplanar up to rounding, exactly where all are small integers.
fn coplanar() -> impl Strategy<Value = [[f64; 3]; 5]> {
    let basis = prop_oneof![
        prop::array::uniform3(small()),
        prop::array::uniform3(-1.0..1.0)
    ];
    let weight = prop_oneof![small(), -1.0..1.0];
    let combination = (weight.clone(), weight);
    (
        prop::array::uniform3(basis),
        prop::array::uniform5(combination),
    )
        .prop_map(|([o, u, v], weights)| {
            weights.map(|(s, t)| std::array::from_fn(|i| o[i] + s * u[i] + t * v[i]))
        })
}

fn needles() -> impl Strategy<Value = [[f64; 3]; 5]> {
    five((-1.0..1.0, -1e-12..1e-12, -1e-15..1e-15).prop_map(|(x, y, z)| [x, y, z]))
}

/// Exponents of one scale at which values or products under- or overflow: degree 3 at 1e±108, degree 5 at 1e±65.
fn extreme() -> impl Strategy<Value = [[f64; 3]; 5]> {
    let scale = prop::sample::select(vec![
        1e300, 1.7e308, 1e154, 1e108, 1e103, 1e65, 1e61, 1e-61, 1e-65, 1e-103, 1e-108, 1e-154,
        1e-162, 1e-290, 1e-300, 1e-308,
    ]);
    let unit = prop_oneof![small().prop_map(|x| x / 4.0), -1.0..1.0];
    (scale, five(prop::array::uniform3(unit)))
        .prop_map(|(scale, p)| p.map(|q| q.map(|x| x * scale)))
}

fn subnormal() -> impl Strategy<Value = [[f64; 3]; 5]> {
    let tiny = (-9i32..10).prop_map(|i| f64::from(i) * 5e-324);
    let x = prop_oneof![
        tiny,
        prop::num::f64::SUBNORMAL,
        Just(f64::MIN_POSITIVE),
        Just(-f64::MIN_POSITIVE)
    ];
    five(prop::array::uniform3(x))
}

fn any_finite() -> impl Strategy<Value = f64> + Clone {
    prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO
}

fn mixed_exponents() -> impl Strategy<Value = [[f64; 3]; 5]> {
    let moderate = (-1.0..1.0, -40i32..40).prop_map(|(x, e): (f64, i32)| x * 2f64.powi(e));
    five(prop::array::uniform3(prop_oneof![
        any_finite(),
        moderate,
        small()
    ]))
}

fn generic() -> impl Strategy<Value = [[f64; 3]; 5]> {
    five(prop::array::uniform3(-1.0..1.0))
}

/// A point of any family, nudged, with heights that are arbitrary, small, or those of the points on a paraboloid.
fn input() -> impl Strategy<Value = Input> {
    let points = prop_oneof![
        lattice(),
        cospherical(),
        coplanar(),
        needles(),
        extreme(),
        subnormal(),
        mixed_exponents(),
        generic(),
    ];
    let by = prop_oneof![6 => Just(0), 1 => Just(1), 1 => Just(-1)];
    let nudges = prop::array::uniform5(prop::array::uniform3(by));
    let heights = prop::array::uniform5(prop_oneof![any_finite(), small(), -1.0..1.0]);
    (points, nudges, heights, any::<bool>()).prop_map(
        |(mut points, nudges, mut heights, lifted)| {
            for (p, by) in points.iter_mut().zip(nudges) {
                *p = std::array::from_fn(|i| nudge(p[i], by[i]));
            }
            if lifted {
                heights = points.map(|p| {
                    p.iter()
                        .map(|x| x * x)
                        .sum::<f64>()
                        .clamp(f64::MIN, f64::MAX)
                });
            }
            Input { points, heights }
        },
    )
}

// ---- The claims ----

/// Whether |value − exact| ≤ error, in exact arithmetic; an error that is not finite bounds everything.
fn is_bound<N: Exact>(approx: &Approx, exact: &N) -> bool {
    if !approx.error().is_finite() {
        return true;
    }
    if !approx.value().is_finite() {
        return false;
    }
    let difference = N::from_f64(approx.value()) - exact;
    let error = N::from_f64(approx.error());
    let above = difference.clone() - &error;
    !above.exact_sign().is_positive() && !(difference + &error).exact_sign().is_negative()
}

/// Claims 2 and 3 for one value.
fn check_filter<N: Exact>(approx: &Approx, exact: &N) -> Result<(), TestCaseError> {
    if let Some(sign) = approx.sign() {
        prop_assert_eq!(sign, exact.exact_sign(), "{:?}", approx);
    }
    prop_assert!(
        is_bound(approx, exact),
        "{:?}, error {:e}, exactly {:e}",
        approx,
        approx.error(),
        exact.to_f64()
    );
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn dyadics_and_the_filter_agree(input in input()) {
        let exact = determinants::<Dyadic>(&input);
        for (approx, exact) in determinants::<Approx>(&input).iter().zip(&exact) {
            check_filter(approx, exact)?;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn dyadics_and_rationals_agree(input in input()) {
        prop_assert_eq!(signs::<Dyadic>(&input), signs::<BigRational>(&input));
    }

    #[test]
    fn rationals_and_the_filter_agree(input in input()) {
        let exact = determinants::<BigRational>(&input);
        for (approx, exact) in determinants::<Approx>(&input).iter().zip(&exact) {
            check_filter(approx, exact)?;
        }
    }

    #[cfg(feature = "rug")]
    #[test]
    fn dyadics_and_gmp_agree(input in input()) {
        prop_assert_eq!(signs::<Dyadic>(&input), signs::<rug::Rational>(&input));
    }

    /// Shewchuk's predicates, where nothing under- or overflows. Their sign is the opposite of ours.
    #[test]
    fn dyadics_and_shewchuk_agree(points in prop_oneof![lattice(), cospherical(), coplanar(), needles(), generic()]) {
        let coordinates = points.map(|[x, y, z]| robust::Coord3D { x, y, z });
        let [a, b, c, d, e] = coordinates;
        let exact = points.map(Vec3::<Dyadic>::from_f64);
        let ours = orient3d([&exact[0], &exact[1], &exact[2], &exact[3]]).exact_sign();
        prop_assert_eq!(Some(-ours), Sign::of_f64(robust::orient3d(a, b, c, d)));
        let ours = insphere(exact.each_ref()).exact_sign();
        prop_assert_eq!(Some(-ours), Sign::of_f64(robust::insphere(a, b, c, d, e)));
    }
}

/// A step of a stack machine, to try the filter's proof on polynomials that no formula of the crate has.
#[derive(Clone, Copy, Debug)]
enum Step {
    Push(f64),
    Add,
    Sub,
    Mul,
    Square,
}

fn step() -> impl Strategy<Value = Step> {
    let extremes = prop::sample::select(vec![
        f64::MAX,
        f64::MIN_POSITIVE,
        5e-324,
        1.0,
        1.0f64.next_down(),
        1e-160,
    ]);
    let number = prop_oneof![any_finite(), extremes, small(), -1.0..1.0];
    prop_oneof![
        5 => number.prop_map(Step::Push),
        1 => Just(Step::Add),
        2 => Just(Step::Sub),
        2 => Just(Step::Mul),
        1 => Just(Step::Square),
    ]
}

/// All the values that a program passes through.
fn run<N: Number>(program: &[Step]) -> Vec<N> {
    let mut stack: Vec<N> = Vec::new();
    let mut passed = Vec::new();
    for step in program {
        let value = match step {
            Step::Push(x) => N::from_f64(*x),
            Step::Square => match stack.last() {
                Some(x) => x.clone() * x,
                None => continue,
            },
            Step::Add | Step::Sub | Step::Mul => {
                let (Some(y), Some(x)) = (stack.pop(), stack.pop()) else {
                    stack.clear();
                    continue;
                };
                match step {
                    Step::Add => x + &y,
                    Step::Sub => x - &y,
                    _ => x * &y,
                }
            }
        };
        passed.push(value.clone());
        stack.push(value);
    }
    passed
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_filter_holds_for_any_polynomial(program in prop::collection::vec(step(), 2..16)) {
        let exact = run::<Dyadic>(&program);
        for (approx, exact) in run::<Approx>(&program).iter().zip(&exact) {
            check_filter(approx, exact)?;
        }
    }

    /// On a grid of integers, whose determinants are integers: sure of zero, and right about it.
    #[test]
    fn zero_is_certified_on_a_grid(points in prop_oneof![lattice(), cospherical()], e in -30i32..30) {
        let unit = 2f64.powi(e);
        let input = Input { points: points.map(|p| p.map(|x| x * unit)), heights: [0.0; 5] };
        let approx = determinants::<Approx>(&input);
        for (i, (approx, exact)) in approx.iter().zip(signs::<Dyadic>(&input)).enumerate() {
            // orient3d and the circuit have degree 3, insphere degree 5; orient4d of zero heights is zero.
            let degree = if i == INSPHERE { 5 } else { 3 };
            prop_assert_eq!(approx.sign_on_grid(unit.powi(degree)), Some(exact));
        }
    }
}

/// 1 + n·2⁻⁵³ in n additions that each lose their term, so that the value stays 1 while the error grows by u each time:
/// the sum that needs an index growing by ½ a step at least.
#[test]
fn sums_that_lose_every_term() {
    let (lost, mut exact) = (2f64.powi(-53), Dyadic::from_f64(1.0));
    let mut approx = Approx::from_f64(1.0);
    for _ in 0..1000 {
        approx = approx + &Approx::from_f64(lost);
        exact = exact + &Dyadic::from_f64(lost);
        check_filter(&approx, &exact).unwrap();
    }
    assert_eq!(approx.value(), 1.0, "every term is lost");
}

/// The same for products: (1 + 3·2⁻⁵²)ⁿ.
#[test]
fn powers_near_one() {
    let factor = 1.0f64.next_up().next_up().next_up();
    let (mut approx, mut exact) = (Approx::from_f64(factor), Dyadic::from_f64(factor));
    for _ in 0..200 {
        approx = approx * &Approx::from_f64(factor);
        exact = exact * &Dyadic::from_f64(factor);
        check_filter(&approx, &exact).unwrap();
    }
}

// ---- The filter matters, and is of use ----

/// Points of the plane x + y + z = 1, up to rounding.
fn nearly_coplanar(i: u32) -> [[f64; 3]; 5] {
    let at = |k: u32| {
        let x = f64::from((7 * i + 31 * k) % 101) / 101.0;
        let y = f64::from((13 * i + 57 * k * k) % 103) / 103.0;
        [x, y, 1.0 - x - y]
    };
    [0, 1, 2, 3, 4].map(at)
}

/// Rotations of one vector by Pythagorean angles, up to rounding on the unit sphere.
fn nearly_cospherical(i: u32) -> [[f64; 3]; 5] {
    let angles = [
        (3, 4, 5),
        (5, 12, 13),
        (8, 15, 17),
        (20, 21, 29),
        (12, 35, 37),
        (9, 40, 41),
        (28, 45, 53),
    ];
    let at = |k: u32| {
        let pick = |n: u32| angles[n as usize % angles.len()];
        let ((p, q, r), (s, t, u)) = (pick(i + k), pick(i / 7 + 3 * k));
        let [p, q, r, s, t, u] = [p, q, r, s, t, u].map(f64::from);
        [p / r * (s / u), p / r * (t / u), q / r]
    };
    [0, 1, 2, 3, 4].map(at)
}

/// (number of signs, wrong ones of `f64`, unknown ones of `Approx`). Where `f64` is wrong, `Approx` must not know.
fn count(family: impl Fn(u32) -> [[f64; 3]; 5], index: usize) -> (u32, u32, u32) {
    let (mut wrong, mut unknown) = (0, 0);
    for i in 0..1000 {
        let heights = [0.0; 5];
        let points = family(i);
        let input = Input { points, heights };
        let naive = determinants::<f64>(&input)[index].sign();
        let filtered = determinants::<Approx>(&input)[index].sign();
        let lies = naive != Some(signs::<Dyadic>(&input)[index]);
        assert!(!lies || filtered.is_none(), "{points:?}");
        wrong += u32::from(lies);
        unknown += u32::from(filtered.is_none());
    }
    (1000, wrong, unknown)
}

#[test]
fn naive_floats_lie() {
    let (all, wrong, _) = count(nearly_coplanar, 0);
    assert!(
        wrong > all / 20,
        "orient3d in f64 was wrong {wrong} times of {all}"
    );
    let (all, wrong, _) = count(nearly_cospherical, INSPHERE);
    assert!(
        wrong > all / 20,
        "insphere in f64 was wrong {wrong} times of {all}"
    );
}

#[test]
fn the_filter_knows_the_sign_of_generic_input() {
    let generic = |i: u32| {
        let mut random = ChaCha8Rng::seed_from_u64(i.into());
        std::array::from_fn(|_| std::array::from_fn(|_| random.random_range(-1.0..1.0)))
    };
    for index in [0, INSPHERE] {
        let (all, wrong, unknown) = count(generic, index);
        assert_eq!(wrong, 0);
        assert!(unknown < all / 100, "{unknown} unknown of {all}");
    }
}
