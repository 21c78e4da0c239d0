//! The queue with times that are plain integers.

use super::*;

/// Events are their arrivals.
struct Integers;

impl TimeOrder for Integers {
    type Event = u32;
    type Key = i32;
    type Time = ();

    fn about(key: i32) -> Option<f64> {
        Some(f64::from(key / 5))
    }

    fn compare_keys(a: i32, b: i32) -> Option<Ordering> {
        Some(a.cmp(&b)).filter(|o| o.is_ne())
    }

    fn compare(&mut self, _: (&u32, &()), _: (&u32, &())) -> Ordering {
        Ordering::Equal
    }
}

/// The (time, arrival) of the last 3000 of 5000 events, many at the same time, as they come off a queue.
fn sorted_by(mut queue: EventQueue<Integers>) -> Vec<(i32, u32)> {
    let time = |arrival: u32| (arrival * 37 % 411) as i32;
    let push = |queue: &mut EventQueue<Integers>, arrival| {
        queue.push(&mut Integers, arrival, time(arrival), ());
    };
    for arrival in 0..3000 {
        push(&mut queue, arrival);
    }
    // Places are used again.
    for arrival in 3000..5000 {
        let first = queue.pop(&mut Integers).expect("3000 events");
        push(&mut queue, arrival);
        assert!(first < arrival);
    }
    let mut order = Vec::new();
    while let Some(event) = queue.pop(&mut Integers) {
        order.push((time(event), event));
    }
    order
}

#[test]
fn events_come_in_order_of_time_then_of_arrival() {
    let order = sorted_by(EventQueue::earliest_first());
    assert_eq!(order.len(), 3000);
    assert!(order.is_sorted());
}

#[test]
fn the_latest_come_first_if_asked() {
    let order = sorted_by(EventQueue::latest_first());
    assert_eq!(order.len(), 3000);
    assert!(order.is_sorted_by(|a, b| b <= a));
}
