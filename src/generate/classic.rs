//! Polyhedra of the literature that need Steiner points: Schönhardt's (1928) and Chazelle's (1984).

use super::draft::{Draft, lift, sides};
use super::draw::{Draw, grid, turn};
use crate::exchange::Plc;

/// Schönhardt's polyhedra, and others like it with bases of up to seven corners: a prism whose top is turned against
/// its base, with diagonals that go the longer way, so that its sides bend inwards. With three corners no
/// tetrahedralization has no more vertices. As many as there is room for, at places and along axes of their own. Bases
/// are across a coordinate axis and so exactly planar.
pub(super) fn schoenhardt(draw: &mut Draw, size: usize) -> Plc {
    let mut draft = Draft::default();
    // Twelve facets and more or less each.
    let row: usize = (1..).find(|n| 11 * n * n * n >= size).expect("cubes grow");
    let mut number = 0;
    while draft.facets() < size.max(8) - 4 || number == 0 {
        let place = [number / row / row, number / row % row, number % row].map(|i| 2.5 * i as f64);
        let corners = if number == 0 { 3 } else { draw.whole(3, 7) };
        one_prism(&mut draft, draw, corners, place);
        number += 1;
    }
    draft.finish()
}

fn one_prism(draft: &mut Draft, draw: &mut Draw, corners: usize, place: [f64; 3]) {
    let axis = draw.below(3);
    let n = corners as u64;
    // A full turn has 4096n parts. A base of three corners may turn by 1/12 of it, others by 1/2n and less.
    let most = if corners == 3 { 1024 } else { 2048 };
    let start = draw.below(4096) as u64;
    let twist = draw.whole(most / 5, most * 19 / 20) as u64;
    let half = draw.between(0.25, 1.0);
    let ring = |turned: u64, height: f64| -> Vec<[f64; 3]> {
        let angle = |i: u64| turn((4096 * i + start + turned) % (4096 * n), 4096 * n);
        let point = |i: u64| lift(axis, angle(i).map(grid), height);
        let placed = (0..n).map(|i| {
            let p = point(i);
            [0, 1, 2].map(|k| p[k] + place[k])
        });
        placed.collect()
    };
    let (base, top) = (ring(0, -half), ring(twist, half));
    draft.polygon(&base);
    draft.polygon(&top);
    for ([a, b], [c, d]) in sides(&base).zip(sides(&top)) {
        // The diagonal from a to d goes on around the axis by the twist.
        draft.halves([a, b, d, c]);
    }
}

/// Chazelle's polyhedron: a block with n deep notches from below and n from above, across them, whose edges lie on the
/// surfaces z = xy and z = xy + 1. Tetrahedra between these surfaces are small, so that there must be about n² of them.
///
/// Notches are 2w wide with w < 1/4n, so that those from below and from above keep apart. Their sides are not planar,
/// but two triangles each. The seed shifts the edges by up to 1/4. In the end heights are divided by a power of two,
/// for a block about as high as wide.
pub(super) fn chazelle(draw: &mut Draw, size: usize) -> Plc {
    let n = ((size as f64 - 6.0) / 10.0).round().max(1.0) as usize;
    let side = n as f64 + 1.0;
    // The power of two that is not less.
    let about_side = (n + 1).next_power_of_two() as f64;
    let half_width = 1.0 / (8.0 * about_side);
    let (bottom, top) = (-1.0, side * side + 2.0);
    let mut lines = || -> Vec<f64> {
        let moved = (0..n).map(|i| i as f64 + 1.0 + draw.between(-0.25, 0.25));
        moved.collect()
    };
    let kinds = [(lines(), bottom, 0.0), (lines(), top, 1.0)];
    let mut draft = Draft::default();
    for (along, (lines, opening, height)) in kinds.into_iter().enumerate() {
        // Notches from below run along x at fixed y, those from above along y at fixed x.
        let at = |position: f64, across: f64, z: f64| match along {
            0 => [position, across, z],
            _ => [across, position, z],
        };
        let edge = |position: f64, line: f64| at(position, line, grid(position * line) + height);
        let mut from = 0.0;
        for to in lines.iter().map(|&line| line - half_width).chain([side]) {
            let strip = [(0.0, from), (side, from), (side, to), (0.0, to)];
            draft.polygon(&strip.map(|(position, across)| at(position, across, opening)));
            from = to + 2.0 * half_width;
        }
        for &line in &lines {
            for across in [line - half_width, line + half_width] {
                draft.halves([
                    at(0.0, across, opening),
                    at(side, across, opening),
                    edge(side, line),
                    edge(0.0, line),
                ]);
            }
        }
        for position in [0.0, side] {
            let mut outline = vec![at(position, 0.0, opening)];
            for &line in &lines {
                outline.push(at(position, line - half_width, opening));
                outline.push(edge(position, line));
                outline.push(at(position, line + half_width, opening));
            }
            outline.push(at(position, side, opening));
            let other = bottom + top - opening;
            outline.push(at(position, side, other));
            outline.push(at(position, 0.0, other));
            draft.polygon(&outline);
        }
    }
    draft.map(|[x, y, z]| [x, y, z / about_side]);
    draft.finish()
}
