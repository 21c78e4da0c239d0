//! What all experiments are made of: the trait, what one is given and answers, expectations, and results on disk.

pub mod expectation;
pub mod experiment;
pub mod join;
pub mod ledger;
pub mod machine;
pub mod program;
pub mod query;
pub mod record;
pub mod row;
pub mod sheet;
pub mod text;

pub use expectation::{Expectation, check_rows};
pub use experiment::{About, Answer, Context, Experiment, Failed};
