//! The list of all experiments. A new one gets a module in [`crate::questions`], a line here, a section in
//! [`crate::page`] and a chapter in the README of this package.

use crate::frame::Experiment;
use crate::questions::*;

/// All experiments, in the order in which they are run.
pub const ALL: [&dyn Experiment; 14] = [
    &models::Models,
    &fig8::Fig8,
    &fig9::Fig9,
    &table1::Table1,
    &table2::Table2,
    &growth::Growth,
    &exactness_cost::ExactnessCost,
    &flip_order::FlipOrder,
    &flip_models::FlipModels,
    &failures::Failures,
    &updates::Updates,
    &steiner::Steiner,
    &rivals::Rivals,
    &scaling::Scaling,
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_different() {
        let names: BTreeSet<&str> = ALL.iter().map(|e| e.about().name).collect();
        assert_eq!(names.len(), ALL.len());
    }
}
