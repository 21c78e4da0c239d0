//! Which inputs are run, with which number types.

use tetflip::number::Bits;
use tetflip::recover::polygons::{FlipOrder, NumberType};

/// A number type, and on which inputs it is run.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    /// The number type.
    pub times: FlipOrder,
    /// It is run on the inputs whose seeds are multiples of this.
    pub every: u64,
}

/// The inputs and number types of a run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Every subfamily is run with the seeds 0, …, `seeds` − 1.
    pub seeds: u64,
    /// The result of inputs whose seeds are multiples of this is verified.
    pub verify_every: u64,
    /// In the order of tables.
    pub numbers: Vec<Numbers>,
}

impl Plan {
    /// Some minutes.
    pub fn full() -> Plan {
        Plan {
            seeds: 600,
            verify_every: 4,
            numbers: number_types(),
        }
    }

    /// Some seconds.
    pub fn quick() -> Plan {
        Plan {
            seeds: 8,
            verify_every: 4,
            numbers: number_types(),
        }
    }
}

/// All number types. Those that are slow, because they are made of big integers, are run on a sample.
fn number_types() -> Vec<Numbers> {
    let on_all = |times| Numbers { times, every: 1 };
    let on_sample = |times| Numbers { times, every: 20 };
    let on_few = |times| Numbers { times, every: 50 };
    let mut all = vec![
        on_all(FlipOrder::new(NumberType::F32)),
        on_all(FlipOrder::new(NumberType::F64)),
        on_all(FlipOrder::FILTERED),
        on_all(FlipOrder::EXACT),
        on_all(FlipOrder::new(NumberType::Naive)),
    ];
    all.extend(
        Bits::ALL
            .iter()
            .map(|&bits| on_sample(FlipOrder::new(NumberType::Wide(bits)))),
    );
    all.push(on_few(FlipOrder::new(NumberType::Rational)));
    #[cfg(feature = "rug")]
    all.push(on_few(FlipOrder::new(NumberType::Rug)));
    all
}

/// The bits of a rounded number's significand.
pub fn precision(times: FlipOrder) -> Option<u32> {
    match times.numbers {
        NumberType::F32 => Some(f32::MANTISSA_DIGITS),
        NumberType::F64 => Some(f64::MANTISSA_DIGITS),
        NumberType::Wide(bits) => Some(bits.get()),
        _ => None,
    }
}

/// The place of a number type in the order of tables.
pub fn place(times: &str) -> Option<usize> {
    number_types()
        .iter()
        .position(|n| n.times.to_string() == times)
}
