//! Which inputs are run, with which number types.

use tetflip::number::Bits;
use tetflip::recover::polygons::Times;

/// A number type, and on which inputs it is run.
#[derive(Clone, Copy, Debug)]
pub struct NumberType {
    /// The number type.
    pub times: Times,
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
    pub numbers: Vec<NumberType>,
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
fn number_types() -> Vec<NumberType> {
    let on_all = |times| NumberType { times, every: 1 };
    let on_sample = |times| NumberType { times, every: 20 };
    let on_few = |times| NumberType { times, every: 50 };
    let mut all = vec![
        on_all(Times::F32),
        on_all(Times::F64),
        on_all(Times::Filtered),
        on_all(Times::Exact),
        on_all(Times::Naive),
    ];
    all.extend(Bits::ALL.iter().map(|&bits| on_sample(Times::Wide(bits))));
    all.push(on_few(Times::Rational));
    #[cfg(feature = "rug")]
    all.push(on_few(Times::Rug));
    all
}

/// The bits of a rounded number's significand.
pub fn precision(times: Times) -> Option<u32> {
    match times {
        Times::F32 => Some(f32::MANTISSA_DIGITS),
        Times::F64 => Some(f64::MANTISSA_DIGITS),
        Times::Wide(bits) => Some(bits.get()),
        _ => None,
    }
}
