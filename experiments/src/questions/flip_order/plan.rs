//! Which inputs are run, with which arms.

use tetflip::number::Bits;
use tetflip::recover::flips::{Rules, TieRule};
use tetflip::recover::polygons::{FlipOrder, NumberType};

/// A number type with its rules, and on how many inputs it is run.
#[derive(Clone, Copy, Debug)]
pub struct Arm {
    /// The number type and the rules.
    pub order: FlipOrder,
    /// It is run on so many inputs of each family, or a few more, so that all subfamilies have as many: the first ones.
    pub per_family: u64,
}

/// The inputs and arms of a run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Inputs of each family, or a few more.
    pub per_family: u64,
    /// The result of inputs whose seeds are multiples of this is verified.
    pub verify_every: u64,
    /// In the order of tables.
    pub arms: Vec<Arm>,
}

/// Doubles, in the order of tables: evaluated as the paper says, as TetGen does it, plainly, and exactly with one
/// rounding.
pub const DOUBLES: [NumberType; 4] = [
    NumberType::F64Paper,
    NumberType::F64TetGen,
    NumberType::F64Plain,
    NumberType::F64Once,
];

/// Of these, the ones of which all inputs are also run with ties broken by the perturbation: what becomes of the
/// failures then tells ties from rounding.
pub const PERTURBED: [NumberType; 2] = [NumberType::F64Paper, NumberType::F64Once];

/// Rounded times, and the perturbation where they are equal.
pub fn by_perturbation(numbers: NumberType) -> FlipOrder {
    FlipOrder::new(numbers).with_rules(Rules {
        ties: TieRule::Perturbed,
        ..Rules::default()
    })
}

impl Plan {
    /// Some minutes.
    pub fn full() -> Plan {
        Plan::new(2000, 200, 100, 40)
    }

    /// Some seconds.
    pub fn quick() -> Plan {
        Plan::new(24, 6, 6, 6)
    }

    /// The main arms run on all inputs, so many of each family; the rules of doubles are crossed on fewer; other widths
    /// are run on still fewer, and the slow rationals on the fewest.
    fn new(all: u64, cross: u64, widths: u64, few: u64) -> Plan {
        let on = |per_family| move |order| Arm { order, per_family };
        let plain = |numbers| FlipOrder::new(numbers);
        let mut main = vec![FlipOrder::EXACT, FlipOrder::FILTERED];
        main.extend(DOUBLES.map(plain));
        main.extend(PERTURBED.map(by_perturbation));
        let mut arms: Vec<Arm> = main.iter().copied().map(on(all)).collect();
        let crossed = Rules::ALL
            .into_iter()
            .flat_map(|rules| DOUBLES.map(|d| plain(d).with_rules(rules)))
            .filter(|order| !main.contains(order));
        arms.extend(crossed.map(on(cross)));
        let coarse = [NumberType::F32, NumberType::F32Once, NumberType::Naive];
        arms.extend(coarse.map(plain).map(on(cross)));
        let widths_of =
            |width: fn(Bits) -> NumberType| Bits::ALL.iter().map(move |&b| plain(width(b)));
        arms.extend(widths_of(NumberType::Wide).map(on(widths)));
        arms.extend(widths_of(NumberType::WideOnce).map(on(widths)));
        arms.push(on(few)(plain(NumberType::Rational)));
        #[cfg(feature = "rug")]
        arms.push(on(few)(plain(NumberType::Rug)));
        Plan {
            per_family: all,
            verify_every: 4,
            arms,
        }
    }

    /// The same with all arms on all inputs.
    #[cfg(test)]
    pub fn uncut(mut self) -> Plan {
        self.arms
            .iter_mut()
            .for_each(|arm| arm.per_family = u64::MAX);
        self
    }

    /// The place of an arm in tables.
    pub fn place(&self, order: FlipOrder) -> usize {
        let place = self.arms.iter().position(|arm| arm.order == order);
        place.unwrap_or(self.arms.len())
    }
}

/// The bits of a rounded number's significand.
pub fn precision(times: FlipOrder) -> Option<u32> {
    match times.numbers {
        NumberType::F32 | NumberType::F32Once => Some(f32::MANTISSA_DIGITS),
        NumberType::Wide(bits) | NumberType::WideOnce(bits) => Some(bits.get()),
        numbers => DOUBLES.contains(&numbers).then_some(f64::MANTISSA_DIGITS),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_are_different_and_the_cross_is_full() {
        for plan in [Plan::full(), Plan::quick()] {
            let mut names: Vec<String> = plan.arms.iter().map(|a| a.order.to_string()).collect();
            names.sort_unstable();
            let all = names.len();
            names.dedup();
            assert_eq!(names.len(), all);
            let of_doubles = plan
                .arms
                .iter()
                .filter(|a| DOUBLES.contains(&a.order.numbers));
            assert_eq!(of_doubles.count(), 4 * 3 * 2);
        }
    }
}
