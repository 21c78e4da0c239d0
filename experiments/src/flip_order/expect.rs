//! What all inputs must show.

use crate::expectation::Expectation;
use crate::flip_order::measure::{DIFFERENT, Measured, is_broken};
use crate::flip_order::plan::name_of;

/// All expectations.
pub fn expectations(inputs: &[Measured]) -> Vec<Expectation> {
    let of_runs = |statement, is_broken: &dyn Fn(&crate::flip_order::measure::Run) -> bool| {
        let runs = inputs
            .iter()
            .flat_map(|m| m.runs.iter().map(move |r| (m, r)));
        let broken = runs.filter(|(_, r)| is_broken(r));
        Expectation {
            statement,
            broken_by: broken
                .map(|(m, r)| format!("{} with {}", m.member, name_of(r.times)))
                .collect(),
        }
    };
    let of_inputs = |statement, is_broken: &dyn Fn(&Measured) -> bool| Expectation {
        statement,
        broken_by: inputs
            .iter()
            .filter(|m| is_broken(m))
            .map(|m| m.member.to_string())
            .collect(),
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
    use super::*;
    use crate::flip_order::measure::measure;
    use crate::flip_order::plan::{Plan, is_exact};

    fn broken(input: Measured) -> Vec<usize> {
        let all = expectations(&[input]).into_iter().enumerate();
        all.filter(|(_, e)| !e.broken_by.is_empty())
            .map(|(i, _)| i)
            .collect()
    }

    #[test]
    fn each_expectation_can_fail() {
        // Rounded times fail on it, which breaks nothing.
        let good = measure("prism/end:78".parse().expect("a name"), &Plan::quick());
        assert!(good.runs.iter().any(|r| !r.is_ok()));
        assert!(broken(good.clone()).is_empty());
        let mut bad = good.clone();
        let mut runs = bad.runs.iter_mut();
        let exact = runs.find(|r| is_exact(r.times)).expect("an exact run");
        exact.disorder.kendall = 1;
        assert_eq!(broken(bad), [0]);
        let mut bad = good.clone();
        bad.runs[0].outcome = DIFFERENT;
        assert_eq!(broken(bad), [1]);
        let cavity_agrees = false;
        assert_eq!(
            broken(Measured {
                cavity_agrees,
                ..good.clone()
            }),
            [2]
        );
        let gift_wrap_agrees = false;
        assert_eq!(
            broken(Measured {
                gift_wrap_agrees,
                ..good.clone()
            }),
            [3]
        );
        let verified = Some(false);
        assert_eq!(
            broken(Measured {
                verified,
                ..good.clone()
            }),
            [4]
        );
        let mut bad = good;
        bad.counts.not_flat = 1;
        assert_eq!(broken(bad), [5]);
    }
}
