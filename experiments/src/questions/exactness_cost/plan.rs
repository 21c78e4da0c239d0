//! Which inputs, by which methods.

use super::input::{Input, KINDS, Kind};
use crate::measure::method::Method;
use crate::measure::rounds::Effort;
use tetflip::number::Bits;
use tetflip::recover::flips::{QueueRule, Rules};
use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType};

/// What to run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// In the order of the rows.
    pub inputs: Vec<Input>,
    /// How often each insertion is timed.
    pub effort: Effort,
}

/// Above this size rationals are left out: with their divisors they take a thousand times as long as doubles.
const MOST_FOR_RATIONAL: u64 = 500;

/// Above this size other numbers of many bits are left out, and gift wrapping.
const MOST_FOR_SLOW: u64 = 1000;

/// Above this size dyadic numbers throughout are left out.
const MOST_FOR_EXACT: u64 = 30_000;

impl Plan {
    /// A few minutes.
    pub fn full() -> Plan {
        let slab = [
            (100, 3),
            (300, 3),
            (1000, 3),
            (3000, 3),
            (10_000, 3),
            (30_000, 2),
            (100_000, 2),
        ];
        let lattice = [(500, 2), (2000, 2), (6000, 2), (20_000, 2)];
        let sphere = [(500, 2), (2000, 2), (6000, 2)];
        Plan {
            inputs: inputs(&slab, &lattice, &sphere),
            effort: Effort {
                seconds: 0.35,
                least: 5,
                most: 301,
                of_slow: 3,
            },
        }
    }

    /// A few seconds, not fit for conclusions about time.
    pub fn quick() -> Plan {
        Plan {
            inputs: inputs(&[(100, 1), (1000, 1)], &[(500, 1)], &[(500, 1)]),
            effort: Effort {
                seconds: 0.05,
                least: 3,
                most: 21,
                of_slow: 1,
            },
        }
    }
}

/// Pairs of a size and a number of seeds, for the slab, for each lattice and for the sphere.
fn inputs(slab: &[(u64, u64)], lattice: &[(u64, u64)], sphere: &[(u64, u64)]) -> Vec<Input> {
    let of_kind = |&kind: &Kind| {
        let sizes = match kind {
            Kind::Slab => slab,
            Kind::Lattice(_) | Kind::Tenths(_) => lattice,
            Kind::Sphere => sphere,
        };
        sizes.iter().flat_map(move |&(about, seeds)| {
            (1..=seeds).map(move |seed| Input { kind, about, seed })
        })
    };
    KINDS.iter().flat_map(of_kind).collect()
}

/// Rounded times in the queue of the exact order, which has possible events only. What is left between these and
/// filtered times is not the price of exact keys alone: filtered flips are done in a copy of the region, if it is large,
/// and rounded times take the sign of D from the filter and evaluate N and D once more.
pub fn in_same_queue() -> FlipOrder {
    FlipOrder::new(NumberType::F64Plain).with_rules(Rules {
        queue: QueueRule::Possible,
        ..Rules::default()
    })
}

/// All methods, in the order of tables.
pub fn methods() -> Vec<Method> {
    let wide = FlipOrder::new(NumberType::Wide(
        "106".parse::<Bits>().expect("there are 106 bits"),
    ));
    let times = [
        FlipOrder::new(NumberType::F64Plain),
        FlipOrder::new(NumberType::F32),
        FlipOrder::FILTERED,
        FlipOrder::EXACT,
        in_same_queue(),
        wide,
        FlipOrder::new(NumberType::Rational),
        #[cfg(feature = "rug")]
        FlipOrder::new(NumberType::Rug),
    ];
    let baselines = [Insertion::Cavity, Insertion::GiftWrap];
    let all = times.into_iter().map(Insertion::Flip).chain(baselines);
    all.map(Method).collect()
}

/// The methods that are compared at a size.
pub fn methods_for(about: u64) -> Vec<Method> {
    let most = |m: &Method| match m.0 {
        _ if !is_slow(*m) => u64::MAX,
        Insertion::Flip(FlipOrder::EXACT) => MOST_FOR_EXACT,
        Insertion::Flip(order) if order.numbers == NumberType::Rational => MOST_FOR_RATIONAL,
        _ => MOST_FOR_SLOW,
    };
    let mut methods = methods();
    methods.retain(|m| about <= most(m));
    methods
}

/// Whether a method takes many times as long as the others, so that it is timed less often.
pub fn is_slow(method: Method) -> bool {
    match method.0 {
        Insertion::Flip(order) => !matches!(
            order.numbers,
            NumberType::F32 | NumberType::F64Plain | NumberType::Filtered
        ),
        Insertion::Cavity => false,
        Insertion::GiftWrap => true,
    }
}

/// A part of the progress bar.
pub fn weight(input: &Input) -> u64 {
    input.about.max(2000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_input_twice() {
        for plan in [Plan::full(), Plan::quick()] {
            let mut names: Vec<String> = plan.inputs.iter().map(Input::name).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), plan.inputs.len());
        }
    }

    #[test]
    fn slow_methods_stop_early() {
        let names = |about| {
            let names = methods_for(about).into_iter().map(|m| m.to_string());
            names.collect::<Vec<String>>().join(", ")
        };
        assert_eq!(
            names(100_000),
            "flip f64:plain, flip f32, flip filtered, flip f64:plain,queue=possible, cavity"
        );
        assert!(names(30_000).contains("exact") && !names(30_000).contains("gift"));
        assert_eq!(methods_for(500), methods());
        assert_eq!(methods_for(1000).len(), methods().len() - 1);
        let fast = methods().into_iter().filter(|&m| !is_slow(m));
        assert_eq!(fast.count(), 5);
    }
}
