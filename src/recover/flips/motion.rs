//! The vertices of a region and how fast their heights grow while f is inserted.

use super::event::Event;
use crate::kinetic::{Motion, Quotient};
use crate::mesh::VertexId;
use crate::number::{Exact, Number, Vec3};
use crate::predicate::PointStore;
use crate::predicate::formula::{self, Lifted};
use crate::recover::tables::Table;
use std::cell::RefCell;

/// Tells the left vertices of a polygon.
pub type LeftVertices<'a> = &'a dyn Fn(VertexId) -> bool;

/// What moves while f is inserted: the heights of its left vertices v, with rates orient3d(frame, v).
pub struct PolygonMotion<'a, P> {
    pub(super) points: &'a P,
    frame: [VertexId; 3],
    is_left: LeftVertices<'a>,
    /// 1 + the number of each vertex in order of first use, 0 if not used yet; `None` if ids are small numbers already.
    numbers: Option<RefCell<VertexNumbers>>,
}

/// A table that numbers the vertices of one region; kept from region to region for its memory.
#[derive(Clone, Debug, Default)]
pub struct VertexNumbers {
    table: Table<u32>,
    used: u32,
}

impl<'a, P: PointStore> PolygonMotion<'a, P> {
    /// For the polygon with the given frame; `is_left` tells the left vertices.
    pub fn new(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        PolygonMotion::with_numbers(points, frame, is_left, VertexNumbers::default())
    }

    /// The same, using the memory of `numbers`.
    pub fn with_numbers(
        points: &'a P,
        frame: [VertexId; 3],
        is_left: LeftVertices<'a>,
        mut numbers: VertexNumbers,
    ) -> Self {
        numbers.table.clear();
        numbers.used = 0;
        PolygonMotion {
            points,
            frame,
            is_left,
            numbers: Some(RefCell::new(numbers)),
        }
    }

    /// The same for a store that has the region's vertices alone.
    pub(super) fn of_few(
        points: &'a P,
        frame: [VertexId; 3],
        is_left: LeftVertices<'a>,
    ) -> PolygonMotion<'a, P> {
        PolygonMotion {
            points,
            frame,
            is_left,
            numbers: None,
        }
    }

    /// The memory given to [`PolygonMotion::with_numbers`].
    pub fn into_numbers(self) -> VertexNumbers {
        self.numbers.map(RefCell::into_inner).unwrap_or_default()
    }

    /// A small number for each vertex that is asked for: 0, 1, 2, …
    #[inline(always)]
    pub(super) fn number(&self, v: VertexId) -> usize {
        let Some(numbers) = &self.numbers else {
            return v.index();
        };
        let known = numbers.borrow().table.get(v.index());
        if known > 0 {
            return (known - 1) as usize;
        }
        let mut numbers = numbers.borrow_mut();
        numbers.used += 1;
        let number = numbers.used;
        numbers.table.set(v.index(), number);
        (number - 1) as usize
    }

    /// Whether ids are small numbers already.
    pub(super) fn is_of_few(&self) -> bool {
        self.numbers.is_none()
    }

    /// The frame, about which d_v is measured, if v moves.
    pub(super) fn frame_of_left(&self, v: VertexId) -> Option<[VertexId; 3]> {
        (self.is_left)(v).then_some(self.frame)
    }

    /// The rate d_v.
    pub(super) fn rate<N: Number>(&self, v: VertexId) -> N {
        let Some([a, b, c]) = self.frame_of_left(v) else {
            return N::from_f64(0.0);
        };
        let p = [a, b, c, v].map(|v| self.points.coordinates::<N>(v));
        formula::orient3d(p.each_ref())
    }
}

/// Evaluates circuits in one number type. The positions and rates of a region's vertices are computed once each.
pub struct Circuits<'a, P, N> {
    pub(super) motion: &'a PolygonMotion<'a, P>,
    known: Vec<(Vec3<N>, N)>,
    /// 1 + the place of each vertex there, by its number; 0 if it is not known. (Mostly few are asked for.)
    places: Vec<u32>,
}

impl<'a, P: PointStore, N: Number> Circuits<'a, P, N> {
    /// For the given motion.
    pub fn new(motion: &'a PolygonMotion<'a, P>) -> Self {
        Circuits {
            motion,
            known: Vec::new(),
            places: Vec::new(),
        }
    }

    /// Makes sure that v is known, and gives its place.
    fn know(&mut self, v: VertexId) -> usize {
        let number = self.motion.number(v);
        if number >= self.places.len() {
            self.places.resize(number + 1, 0);
        }
        if self.places[number] == 0 {
            let position = self.motion.points.coordinates::<N>(v);
            self.known.push((position, self.motion.rate(v)));
            self.places[number] = self.known.len() as u32;
        }
        (self.places[number] - 1) as usize
    }

    /// N and D of a circuit: S(τ) = N + τ·D.
    pub(super) fn evaluate(&mut self, circuit: [VertexId; 5]) -> (N, N) {
        let places = circuit.map(|v| self.know(v));
        let of = |i: usize| &self.known[places[i]];
        let [x, y, z, w] = [1, 2, 3, 4].map(|i: usize| of(i).0.sub(&of(0).0));
        let lifted = Lifted::new([&x, &y, &z]);
        let below = |[hx, hy, hz, hw]: [N; 4]| {
            let gradient = lifted.gradient([&hx, &hy, &hz]);
            lifted.below(&gradient, &w, &hw)
        };
        let n = below([&x, &y, &z, &w].map(|p| p.dot(p)));
        let d = below([1, 2, 3, 4].map(|i: usize| of(i).1.clone() - &of(0).1));
        (n, d)
    }

    /// The coefficients of a circuit.
    pub(super) fn coefficients(&mut self, circuit: [VertexId; 5]) -> [N; 5] {
        let p = circuit.map(|v| self.motion.points.coordinates::<N>(v));
        formula::circuit(p.each_ref()).0
    }
}

impl<P: PointStore, N: Exact> Motion<N, 5> for Circuits<'_, P, N> {
    type Event = Event;

    fn quotient(&mut self, event: &Event) -> Option<Quotient<N>> {
        let (n, d) = self.evaluate(event.circuit);
        Quotient::of_rising(n, d)
    }

    fn perturbation(&mut self, event: &Event) -> [(u32, N); 5] {
        let [v, x, y, z, w] = event.circuit.map(|v| self.motion.points.identity(v));
        let [cv, cx, cy, cz, cw] = self.coefficients(event.circuit);
        [(v, cv), (x, cx), (y, cy), (z, cz), (w, cw)]
    }

    /// Two triangles of one circuit, or one triangle queued again.
    fn is_one_circuit(a: &Event, b: &Event) -> bool {
        let (mut a, mut b) = (a.circuit, b.circuit);
        a.sort_unstable();
        b.sort_unstable();
        a == b
    }
}
