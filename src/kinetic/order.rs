//! What a queue asks of times: which of two comes first.

use std::cmp::Ordering;

/// An event and its time, to be compared.
pub type Timed<'t, E, T> = (&'t E, &'t T);

/// An order of events by their times. How a time is computed is not its concern.
pub trait TimeOrder {
    /// What happens. It is copied when it leaves the queue.
    type Event: Copy;

    /// The part of a time that the queue moves around: enough for most comparisons.
    type Key: Copy;

    /// The rest of it.
    type Time;

    /// About when a time is, to sort by before comparing; `None` if keys do not tell.
    fn about(key: Self::Key) -> Option<f64>;

    /// Which of two times comes first, as far as the keys tell.
    fn compare_keys(a: Self::Key, b: Self::Key) -> Option<Ordering>;

    /// Which of two events comes first, where the keys do not tell. `Equal` means: in any order.
    fn compare(
        &mut self,
        a: Timed<Self::Event, Self::Time>,
        b: Timed<Self::Event, Self::Time>,
    ) -> Ordering;
}
