//! The price of exactness.
//!
//! **Question.** What do exact flip times cost, relative to the paper's rounded ones, on vertices in general position
//! and on those that make nearly every comparison a tie? How often do float enclosures decide, how often exact
//! quotients, how often the perturbation? How do flips compare with cavity retriangulation and with gift wrapping?
//!
//! **Inputs.** One rectangle through a random slab, through lattices, or through a sphere of integer points
//! ([`input`]), with 100 to 100 000 crossing tetrahedra. A row is the insertion of the rectangle by one method.
//!
//! **Columns.** [`row::Row`], [`summary::Summary`], [`summary::Target`]; the README of this package has their meaning.
//! Seconds are processor time of the insertion alone, in one thread; all methods are timed in turns in one run. A run
//! with rounded times can fail; its time, which includes the undoing, still counts.
//!
//! **Expected.** All but rounded flips always succeed; every success is verified and all of one input are the same mesh
//! ([`row::expectations`]), asserted at the end. The project's targets for times are reported as reached or missed, not
//! asserted.

mod input;
mod measure;
mod plan;
mod price;
mod price_summary;
mod row;
mod summary;

use crate::frame::{About, Answer, Context, Experiment, Failed};
use crate::measure::outcome;
use input::Input;
use plan::Plan;

/// The question.
pub struct ExactnessCost;

impl Experiment for ExactnessCost {
    fn about(&self) -> About {
        About {
            name: "exactness_cost",
            question: "cost of exact flip times by number type, on random and on degenerate vertices",
            seconds: 240,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let plan = context.plan(Plan::quick, Plan::full);
        let rows = context.measure(&plan.inputs, plan::weight, Input::name, |input| {
            measure::measure(input, &plan::methods_for(input.about), &plan.effort)
        });
        let methods = plan::methods();
        let summaries = summary::summaries(&rows, &methods);
        let mut answer = context.answer();
        answer.say("Times relative to flips with f64 times:\n");
        answer.say(summary::table(&summaries, &methods));
        answer.csv("exactness_cost", &rows, "")?;
        answer.csv("exactness_cost-summary", &summaries, "")?;
        let targets = summary::targets(&summaries);
        answer.csv(
            "exactness_cost-targets",
            &targets,
            "reached target input about bound measured",
        )?;
        answer.say(outcome::failures(&rows, |r| (r.name(), r.outcome, r.left)));
        answer.expectations = row::expectations(&rows);
        price(context, &mut answer)?;
        Ok(answer)
    }
}

/// The second part: filtered times, and the same without one of their parts.
fn price(context: &Context, answer: &mut Answer) -> Result<(), Failed> {
    let plan = context.plan(price::Plan::quick, price::Plan::full);
    let rows = context.measure(
        &plan.scenes,
        price::Scene::weight,
        price::Scene::name,
        |scene| price::measure(scene, &plan),
    );
    answer.csv("exactness_cost-price", &rows, "")?;
    let shown =
        "input about arm inputs succeeded median_microseconds_per_tet filtered_over_arm low high";
    answer.csv(
        "exactness_cost-price-summary",
        &price_summary::summaries(&rows),
        shown,
    )?;
    answer
        .expectations
        .extend(price_summary::expectations(&rows));
    Ok(())
}
