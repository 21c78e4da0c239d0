//! What all inputs must show.

use super::measure::{DIFFERENT, Measured, Run, is_broken};
use crate::frame::Expectation;

/// All expectations.
pub fn expectations(inputs: &[Measured]) -> Vec<Expectation> {
    let of_runs = |statement, is_broken: &dyn Fn(&Run) -> bool| {
        let runs = inputs
            .iter()
            .flat_map(|m| m.runs.iter().map(move |r| (m, r)));
        let broken = runs.filter(|(_, r)| is_broken(r));
        let names = broken.map(|(m, r)| format!("{} with {}", m.member, r.times));
        Expectation {
            statement,
            broken_by: names.collect(),
        }
    };
    let of_inputs = |statement, is_broken: &dyn Fn(&Measured) -> bool| {
        let broken = inputs.iter().filter(|m| is_broken(m));
        Expectation {
            statement,
            broken_by: broken.map(|m| m.member.to_string()).collect(),
        }
    };
    vec![
        of_runs(
            "every exact number type ends in the same CDT on every input, without a patch or an inversion",
            &is_broken,
        ),
        of_runs(
            "rounded times never end in other tetrahedra unnoticed",
            &|r| r.outcome == DIFFERENT,
        ),
        of_inputs("cavity retriangulation ends in the same tetrahedra", &|m| {
            !m.cavity_agrees
        }),
        of_inputs("gift wrapping ends in the same tetrahedra", &|m| {
            !m.gift_wrap_agrees
        }),
        of_inputs("the verifier accepts all results of its sample", &|m| {
            m.verified == Some(false)
        }),
        of_inputs(
            "all polygons are exactly flat, Steiner points included",
            &|m| m.counts.not_flat > 0,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::measure::measure;
    use super::super::plan::Plan;
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn each_can_fail() {
        // Rounded times fail on it, which breaks nothing.
        let member = "prism/end:78".parse().expect("a name");
        let good = measure(member, &Plan::quick().uncut());
        assert!(good.runs.iter().any(|r| !r.is_ok()));
        let exact = good
            .runs
            .iter()
            .position(|r| r.times.is_exact())
            .expect("an exact run");
        let rounded = good
            .runs
            .iter()
            .position(|r| !r.times.is_exact())
            .expect("a rounded run");
        assert_each_can_fail(
            expectations,
            &[good],
            &[
                (&|m| m.runs[exact].disorder.kendall = 1, &[0]),
                (&|m| m.runs[rounded].outcome = DIFFERENT, &[1]),
                (&|m| m.cavity_agrees = false, &[2]),
                (&|m| m.gift_wrap_agrees = false, &[3]),
                (&|m| m.verified = Some(false), &[4]),
                (&|m| m.counts.not_flat = 1, &[5]),
            ],
        );
    }
}
