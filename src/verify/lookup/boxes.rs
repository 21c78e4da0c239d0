//! Which of many boxes meet a box: a tree, each node of which has the box around all below it.
//!
//! O(n log n) to build for n boxes; O(log n + k) for k boxes that are found, if these are of reasonable shape.

use std::ops::Range;

/// A box by its least and greatest coordinates.
pub(crate) type Bounds = [[f64; 3]; 2];

/// Nodes with as many boxes are not divided.
const LEAF: usize = 8;

struct Node {
    bounds: Bounds,
    /// The boxes below, by their places in [`Boxes::order`].
    range: Range<usize>,
    /// The second child; the first one is the next node. 0 for a leaf.
    second: usize,
}

/// The tree.
pub(crate) struct Boxes {
    boxes: Vec<Bounds>,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

fn around(boxes: &[Bounds], order: &[u32]) -> Bounds {
    let mut all = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for &i in order {
        let [low, high] = &boxes[i as usize];
        for k in 0..3 {
            all[0][k] = all[0][k].min(low[k]);
            all[1][k] = all[1][k].max(high[k]);
        }
    }
    all
}

fn meet(a: &Bounds, b: &Bounds) -> bool {
    (0..3).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k])
}

impl Boxes {
    /// Of boxes with finite coordinates.
    pub(crate) fn new(boxes: Vec<Bounds>) -> Boxes {
        let mut tree = Boxes {
            order: (0..boxes.len() as u32).collect(),
            boxes,
            nodes: Vec::new(),
        };
        tree.divide(0..tree.order.len());
        tree
    }

    fn divide(&mut self, range: Range<usize>) {
        let place = self.nodes.len();
        let bounds = around(&self.boxes, &self.order[range.clone()]);
        self.nodes.push(Node {
            bounds,
            range: range.clone(),
            second: 0,
        });
        if range.len() <= LEAF {
            return;
        }
        let extent = |k: usize| bounds[1][k] - bounds[0][k];
        let axis = (0..3)
            .max_by(|&i, &j| extent(i).total_cmp(&extent(j)))
            .expect("three axes");
        let boxes = &self.boxes;
        // Halves, so that no sum overflows.
        let middle = |i: &u32| {
            let [low, high] = &boxes[*i as usize];
            low[axis] / 2.0 + high[axis] / 2.0
        };
        let half = range.len() / 2;
        self.order[range.clone()]
            .select_nth_unstable_by(half, |i, j| middle(i).total_cmp(&middle(j)).then(i.cmp(j)));
        let cut = range.start + half;
        self.divide(range.start..cut);
        self.nodes[place].second = self.nodes.len();
        self.divide(cut..range.end);
    }

    /// The boxes that meet the `i`-th one, itself included, in no order.
    pub(crate) fn meeting(&self, i: usize, found: &mut Vec<u32>) {
        self.meeting_box(&self.boxes[i], found);
    }

    /// The boxes that meet another one, in no order.
    pub(crate) fn meeting_box(&self, own: &Bounds, found: &mut Vec<u32>) {
        found.clear();
        let mut stack = vec![0];
        while let Some(n) = stack.pop() {
            let node = &self.nodes[n];
            if !meet(&node.bounds, own) {
                continue;
            }
            if node.second == 0 {
                let below = self.order[node.range.clone()].iter();
                found.extend(below.filter(|&&j| meet(&self.boxes[j as usize], own)));
            } else {
                stack.extend([node.second, n + 1]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_what_meets_and_nothing_else(
            corners in prop::collection::vec(([0i8..20, 0i8..20, 0i8..20], [0i8..4, 0i8..4, 0i8..4]), 1..80),
        ) {
            let boxes: Vec<Bounds> = corners
                .iter()
                .map(|(low, size)| [low.map(f64::from), [0, 1, 2].map(|k| f64::from(low[k] + size[k]))])
                .collect();
            let tree = Boxes::new(boxes.clone());
            let mut found = Vec::new();
            for (i, own) in boxes.iter().enumerate() {
                tree.meeting(i, &mut found);
                found.sort_unstable();
                let all = 0..boxes.len() as u32;
                let expected: Vec<u32> = all.filter(|&j| meet(own, &boxes[j as usize])).collect();
                prop_assert_eq!(&found, &expected);
            }
        }
    }
}
