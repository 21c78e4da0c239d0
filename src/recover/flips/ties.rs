//! What an inexact order does with events whose rounded times are equal, and which events it queues.

use super::event::{Event, Signs};
use super::motion::{Circuits, PolygonMotion};
use crate::kinetic::{ExactOrder, Motion, TieBreaker};
use crate::mesh::VertexId;
use crate::number::Dyadic;
use crate::predicate::PointStore;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// How events with equal rounded times are ordered.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Debug)]
pub enum TieRule {
    /// In the order of their arrival, as in the paper (`arrival`).
    #[default]
    Arrival,
    /// By the perturbation of the weights, exactly (`perturbed`).
    Perturbed,
    /// The events of one circuit get one time, that of the first to be evaluated, and come one after the other
    /// (`circuit`).
    Circuit,
}

/// Which events an inexact order queues.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Debug)]
pub enum QueueRule {
    /// All that Fig. 7 queues (`all`).
    #[default]
    All,
    /// Only those whose flips are possible when they are queued, as exact orders do (`possible`).
    Possible,
}

/// How a rounded order treats what the numbers leave open.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Debug)]
pub struct Rules {
    /// For equal times.
    pub ties: TieRule,
    /// For the queue.
    pub queue: QueueRule,
}

impl Rules {
    /// All combinations of rules for ties and for the queue, the paper's first.
    pub const ALL: [Rules; 6] = {
        const fn rules(ties: TieRule, queue: QueueRule) -> Rules {
            Rules { ties, queue }
        }
        [
            rules(TieRule::Arrival, QueueRule::All),
            rules(TieRule::Perturbed, QueueRule::All),
            rules(TieRule::Circuit, QueueRule::All),
            rules(TieRule::Arrival, QueueRule::Possible),
            rules(TieRule::Perturbed, QueueRule::Possible),
            rules(TieRule::Circuit, QueueRule::Possible),
        ]
    };
}

/// What is not the default, each after a comma.
impl fmt::Display for Rules {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.ties {
            TieRule::Arrival => {}
            TieRule::Perturbed => f.write_str(",ties=perturbed")?,
            TieRule::Circuit => f.write_str(",ties=circuit")?,
        }
        match self.queue {
            QueueRule::All => {}
            QueueRule::Possible => f.write_str(",queue=possible")?,
        }
        Ok(())
    }
}

/// A word that names no rule.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "{0:?} is no rule; there are ties=arrival, ties=perturbed, ties=circuit, queue=all and queue=possible"
)]
pub struct UnknownRule(String);

impl FromStr for Rules {
    type Err = UnknownRule;

    fn from_str(words: &str) -> Result<Rules, UnknownRule> {
        let mut rules = Rules::default();
        for word in words.split(',') {
            match word {
                "ties=arrival" => rules.ties = TieRule::Arrival,
                "ties=perturbed" => rules.ties = TieRule::Perturbed,
                "ties=circuit" => rules.ties = TieRule::Circuit,
                "queue=all" => rules.queue = QueueRule::All,
                "queue=possible" => rules.queue = QueueRule::Possible,
                _ => return Err(UnknownRule(word.to_owned())),
            }
        }
        Ok(rules)
    }
}

/// A [`TieRule`] at work. Time values have the type `V`.
pub enum FlipTies<'a, P, V> {
    /// [`TieRule::Arrival`].
    Arrival,
    /// [`TieRule::Perturbed`].
    Perturbed(Box<ExactOrder<Circuits<'a, P, Dyadic>, Dyadic, 5>>),
    /// [`TieRule::Circuit`].
    Circuit(OneTime<'a, P, V>),
}

/// One time for each circuit: the vertices whose coefficients are not zero, ascending, and `INFINITE` in the place of
/// others.
pub struct OneTime<'a, P, V> {
    points: &'a P,
    known: FxHashMap<[VertexId; 5], (u32, V)>,
}

impl<'a, P: PointStore, V: Clone> FlipTies<'a, P, V> {
    pub(super) fn new(rule: TieRule, motion: &'a PolygonMotion<'a, P>) -> Self {
        match rule {
            TieRule::Arrival => FlipTies::Arrival,
            TieRule::Perturbed => {
                FlipTies::Perturbed(Box::new(ExactOrder::new(Circuits::new(motion))))
            }
            TieRule::Circuit => FlipTies::Circuit(OneTime {
                points: motion.points,
                known: FxHashMap::default(),
            }),
        }
    }

    /// The time of an event, given what has been computed for it.
    #[inline]
    pub(super) fn settled(&mut self, circuit: [VertexId; 5], time: V) -> V {
        match self {
            FlipTies::Arrival | FlipTies::Perturbed(_) => time,
            FlipTies::Circuit(one) => one.time(circuit, time),
        }
    }
}

impl<P: PointStore, V: Clone> OneTime<'_, P, V> {
    fn circuit(&self, five: [VertexId; 5]) -> [VertexId; 5] {
        let without = |i: usize| {
            let mut four = five.iter().enumerate().filter(|&(j, _)| j != i);
            [(); 4].map(|()| *four.next().expect("four of five are left").1)
        };
        let in_circuit = |i: usize| match self.points.orient3d(without(i)).is_zero() {
            true => VertexId::INFINITE,
            false => five[i],
        };
        let mut circuit = [0, 1, 2, 3, 4].map(in_circuit);
        circuit.sort_unstable();
        circuit
    }

    fn time(&mut self, five: [VertexId; 5], time: V) -> V {
        let (circuit, next) = (self.circuit(five), self.known.len() as u32);
        self.known.entry(circuit).or_insert((next, time)).1.clone()
    }

    /// Which circuit it is, in the order of their first evaluation.
    fn place(&self, five: [VertexId; 5]) -> u32 {
        self.known
            .get(&self.circuit(five))
            .expect("events with a time have been evaluated")
            .0
    }
}

impl<P: PointStore, V: Clone> TieBreaker for FlipTies<'_, P, V> {
    type Event = Event;

    fn break_tie(&mut self, a: &Event, b: &Event) -> Ordering {
        match self {
            FlipTies::Arrival => Ordering::Equal,
            FlipTies::Perturbed(exact) => {
                let quotients = [a, b].map(|event| exact.motion.quotient(event));
                match &quotients {
                    [Some(qa), Some(qb)] => exact.compare_perturbations((a, qa), (b, qb)),
                    // D is rounded, and exactly it is not positive: the exact order says nothing of such an event.
                    _ => Ordering::Equal,
                }
            }
            FlipTies::Circuit(one) => one.place(a.circuit).cmp(&one.place(b.circuit)),
        }
    }
}

impl QueueRule {
    /// Whether an event is queued, given the question that exact orders ask.
    #[inline]
    pub(super) fn admits(self, is_wanted: impl FnOnce(Signs, bool) -> bool) -> bool {
        match self {
            QueueRule::All => true,
            QueueRule::Possible => is_wanted(Signs::UNKNOWN, true),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_rules_are_one_to_one() {
        for rules in Rules::ALL {
            let words = rules.to_string();
            let Some(words) = words.strip_prefix(',') else {
                assert_eq!((rules, words.as_str()), (Rules::default(), ""));
                continue;
            };
            assert_eq!(words.parse(), Ok(rules), "{words}");
        }
        assert_eq!("queue=all,ties=arrival".parse(), Ok(Rules::default()));
        assert!("ties=".parse::<Rules>().is_err());
    }
}
