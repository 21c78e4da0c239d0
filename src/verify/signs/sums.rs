//! Exact sums of volumes and areas.

use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Sign};
use crate::verify::signs::accumulator::Accumulator;
use crate::verify::signs::points::Points;

/// The sum of the signed volumes between the origin and triangles.
pub(crate) struct Cones {
    /// Over triangles of doubles.
    doubles: Accumulator,
    /// Over the other ones.
    others: Dyadic,
}

impl Cones {
    /// None.
    pub(crate) fn new() -> Cones {
        Cones {
            doubles: Accumulator::new(),
            others: Dyadic::ZERO,
        }
    }

    /// Adds the cone over a triangle.
    pub(crate) fn add(&mut self, points: &Points, triangle: [VertexId; 3]) {
        if triangle.iter().all(|&v| points.is_double(v)) {
            let corners = triangle.map(|v| points.at(v));
            self.doubles.add_determinant(corners);
        } else {
            let [a, b, c] = triangle.map(|v| points.exact(v));
            self.others = self.others.clone() + &a.dot(&b.cross(&c));
        }
    }

    /// Six times the sum; nothing is left.
    pub(crate) fn volume(&mut self) -> Dyadic {
        let others = std::mem::replace(&mut self.others, Dyadic::ZERO);
        self.doubles.take() + &others
    }
}

/// The sum of signed areas in the plane of two axes.
pub(crate) struct Areas {
    axes: [usize; 2],
    /// Of triangles of doubles.
    doubles: Accumulator,
    /// Of the other ones.
    others: Dyadic,
}

impl Areas {
    /// None.
    pub(crate) fn new(axes: [usize; 2]) -> Areas {
        Areas {
            axes,
            doubles: Accumulator::new(),
            others: Dyadic::ZERO,
        }
    }

    /// Adds the area of a triangle.
    pub(crate) fn add(&mut self, points: &Points, triangle: [VertexId; 3]) {
        if triangle.iter().all(|&v| points.is_double(v)) {
            let [a, b, c] = triangle.map(|v| {
                let p = points.at(v);
                self.axes.map(|i| p[i])
            });
            // (b−a)×(c−a) = a×b + b×c + c×a.
            for [p, q] in [[a, b], [b, c], [c, a]] {
                self.doubles.add([p[0], q[1], 1.0]);
                self.doubles.add([-p[1], q[0], 1.0]);
            }
        } else {
            self.others = self.others.clone() + &points.area(self.axes, triangle);
        }
    }

    /// The sign of the sum.
    pub(crate) fn sign(&mut self) -> Sign {
        let others = self.others.exact_sign();
        if others.is_zero() {
            return self.doubles.sign();
        }
        self.others = self.take_twice();
        self.others.exact_sign()
    }

    /// Twice the sum; nothing is left of it.
    pub(crate) fn take_twice(&mut self) -> Dyadic {
        let others = std::mem::replace(&mut self.others, Dyadic::ZERO);
        self.doubles.take() + &others
    }
}
