//! What says how polygons are inserted by flips: the order of the flips, its number type, and what a number type of
//! one's own must provide (`examples/own_number.rs`).

pub use crate::recover::flips::{
    Evaluation, ExactNumbers, Exactness, FilteredNumbers, FlipNumbers, FlipOrder, FlipTime,
    FlipTimes, NumberType, QueueRule, RoundedNumbers, Rules, TieRule, UnknownOrder, WideNumbers,
};
