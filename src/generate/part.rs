//! Parts as machines make them: a block with recesses and bosses on all sides, and a bracket with bores through its
//! plates.

use super::draft::{Draft, Loop, rectangle};
use super::draw::{Draw, circle, turn};
use super::turned::{Face, Turned};
use crate::exchange::Plc;

/// A block; on each of its sides a grid of bores, counterbores, pockets, bosses, and bosses with a bore. No recess is
/// deeper than 1, and none is nearer than 1.5 to an edge of the block, so that they do not meet.
pub(super) fn machined_part(draw: &mut Draw, size: usize) -> Plc {
    // A feature has 1.6 walls to a corner, and 1.6 planes.
    let per_side = ((size as f64 / (6.0 * 22.0)).sqrt().round() as usize).max(1);
    let features = 6 * per_side * per_side;
    let corners = ((size as f64 - 6.0) / features as f64 - 1.6) / 1.6;
    let outline = circle((corners.round() as usize).clamp(3, 64));
    let square = circle(4);
    let side = 2.0 * per_side as f64 + 4.0;
    let mut draft = Draft::default();
    for axis in 0..3 {
        for (at, out) in [(0.0, -1.0), (side, 1.0)] {
            let mut face = Face::new(axis, at, rectangle([0.0; 2], [side; 2]));
            for i in 0..per_side * per_side {
                let middle = |i: usize| 2.0 * i as f64 + 3.0;
                let cell = [middle(i % per_side), middle(i / per_side)];
                let centre = cell.map(|x| x + draw.between(-0.125, 0.125));
                let steps = feature(draw);
                let along: Vec<_> = steps.iter().map(|&(r, h)| (r, at + out * h)).collect();
                let pocket = along.len() == 1 && draw.chance(0.2);
                let outline = if pocket { &square } else { &outline };
                face.put(&mut draft, centre, outline, &along);
            }
            face.draw(&mut draft);
        }
    }
    draft.finish()
}

/// Radii and heights over the face, of few bits.
fn feature(draw: &mut Draw) -> Vec<(f64, f64)> {
    let mut eighths = |low, high| draw.whole(low, high) as f64 / 8.0;
    let (wide, narrow) = (eighths(4, 6), eighths(1, 3));
    let (shallow, deep, high) = (eighths(1, 3), eighths(4, 8), eighths(2, 8));
    match draw.below(4) {
        0 => vec![(wide, -deep)],
        1 => vec![(wide, -shallow), (narrow, -deep)],
        2 => vec![(wide, high)],
        _ => vec![(wide, high), (narrow, -deep)],
    }
}

/// An L of two plates with a fillet in its corner, and bores through both plates; some of them with a counterbore.
pub(super) fn bracket(draw: &mut Draw, size: usize) -> Plc {
    let columns = ((size as f64 / (4.0 * 20.0)).sqrt().round() as usize).max(1);
    let bores = 4 * columns * columns;
    let arc = 3 + columns;
    let corners = ((size as f64 - 8.0 - arc as f64) / bores as f64 - 0.3) / 1.3;
    let outline = circle((corners.round() as usize).clamp(3, 64));
    let (length, width) = (2.0 * columns as f64 + 4.0, 4.0 * columns as f64);
    let mut draft = Draft::default();
    // The profile in the plane of z and x: axis 1 lifts (u, v) = (z, x).
    let mut profile: Loop = vec![[0.0, 0.0], [0.0, length], [1.0, length]];
    let fillet = (0..=arc as u64).map(|i| turn(i, 4 * arc as u64));
    profile.extend(fillet.map(|[c, s]| [2.0 - c, 2.0 - s]));
    profile.extend([[length, 1.0], [length, 0.0]]);
    for w in [0.0, width] {
        draft.plane(1, w, std::slice::from_ref(&profile), &[]);
    }
    // The four sides with bores are drawn below.
    let bored = [[0, 1], [2, 3], [arc + 3, arc + 4], [arc + 5, 0]];
    for i in 0..profile.len() {
        let j = (i + 1) % profile.len();
        if !bored.contains(&[i, j]) {
            let [[z, x], [next_z, next_x]] = [profile[i], profile[j]];
            draft.polygon(&[
                [x, 0.0, z],
                [next_x, 0.0, next_z],
                [next_x, width, next_z],
                [x, width, z],
            ]);
        }
    }
    for axis in [2, 0] {
        // Axis 2 lifts (x, y), axis 0 lifts (y, z); the plate goes from 0 to `length` along x or along z.
        let place = |along: f64, across: f64| match axis {
            2 => [along, across],
            _ => [across, along],
        };
        let outer = rectangle(place(0.0, 0.0), place(length, width));
        let inner = rectangle(place(2.0, 0.0), place(length, width));
        let mut faces = [Face::new(axis, 0.0, outer), Face::new(axis, 1.0, inner)];
        for i in 0..2 * columns * columns {
            let along = 2.0 * (i % columns) as f64 + 3.5 + draw.between(-0.125, 0.125);
            let across = 2.0 * (i / columns) as f64 + 1.0;
            let centre = place(along, across);
            let radius = draw.whole(2, 4) as f64 / 8.0;
            let counterbore = [(radius + 0.25, 0.5), (radius, 0.0)];
            let steps = match draw.chance(0.3) {
                true => &counterbore[..],
                false => &counterbore[1..],
            };
            let bore = Turned {
                axis,
                centre,
                outline: &outline,
                face: 1.0,
                steps,
                closed: false,
            };
            bore.draw(&mut draft);
            faces[0].open(bore.outline(steps.len() - 1), centre);
            faces[1].open(bore.outline(0), centre);
        }
        faces.into_iter().for_each(|face| face.draw(&mut draft));
    }
    draft.finish()
}
