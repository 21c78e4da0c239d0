//! An assembly like an engine: a case with cylinders, liners in them, chambers below, and a crankshaft that runs freely
//! through the bearings between the chambers. Three regions, with the attributes 1 (case), 2 (liners) and 3 (shaft).

use super::draft::{Draft, Loop, placed, rectangle};
use super::draw::{Draw, circle};
use super::turned::{Face, Turned};
use crate::exchange::Plc;

/// The length of the case per cylinder, and its height.
const PITCH: f64 = 4.0;
const TOP: f64 = 10.0;
/// The chamber from floor to ceiling, and half its width.
const FLOOR: f64 = 1.0;
const CEILING: f64 = 5.0;
const HALF: f64 = 1.5;
/// Where the shaft runs, across the x-axis.
const BEARING: [f64; 2] = [0.0, 3.0];

/// As many cylinders as the size asks for with polygons of 12 corners, but at least two.
pub(super) fn crankcase(draw: &mut Draw, size: usize) -> Plc {
    let cylinders = ((size as f64 / 122.0).round() as usize).max(2);
    let corners = (size as f64 / cylinders as f64 - 14.0) / 9.0;
    let round = circle((corners.round() as usize).clamp(6, 64));
    let mut draft = Draft::default();
    let length = PITCH * cylinders as f64;
    case(&mut draft, draw, cylinders, &round);
    shaft(&mut draft, draw, cylinders, &round);
    draft.region([length / 2.0, 1.75, 0.5], 1);
    draft.region([-0.5, BEARING[0], BEARING[1]], 3);
    draft.finish()
}

fn case(draft: &mut Draft, draw: &mut Draw, cylinders: usize, round: &[[f64; 2]]) {
    let length = PITCH * cylinders as f64;
    let tunnel = placed(round, BEARING, 0.75);
    let side = |axis, at, low, high| Face::new(axis, at, rectangle(low, high));
    // Axis 2 lifts (x, y), axis 1 (z, x), axis 0 (y, z).
    let mut deck = side(2, TOP, [0.0, -2.0], [length, 2.0]);
    side(2, 0.0, [0.0, -2.0], [length, 2.0]).draw(draft);
    for y in [-2.0, 2.0] {
        side(1, y, [0.0, 0.0], [TOP, length]).draw(draft);
    }
    for x in [0.0, length] {
        let mut end = side(0, x, [-2.0, 0.0], [2.0, TOP]);
        end.open(tunnel.clone(), BEARING);
        end.draw(draft);
    }
    for c in 0..cylinders {
        let start = PITCH * c as f64;
        let chamber = [start + 0.5, start + 3.5];
        bearing(
            draft,
            &tunnel,
            [if c == 0 { 0.0 } else { start - 0.5 }, start + 0.5],
        );
        for x in chamber {
            let mut web = side(0, x, [-HALF, FLOOR], [HALF, CEILING]);
            web.open(tunnel.clone(), BEARING);
            web.draw(draft);
        }
        side(2, FLOOR, [chamber[0], -HALF], [chamber[1], HALF]).draw(draft);
        for y in [-HALF, HALF] {
            side(1, y, [FLOOR, chamber[0]], [CEILING, chamber[1]]).draw(draft);
        }
        let centre = [start + 2.0, 0.0];
        let ceiling = side(2, CEILING, [chamber[0], -HALF], [chamber[1], HALF]);
        cylinder(draft, round, centre, ceiling, &mut deck);
        for y in [-1.5, 1.5] {
            let depth = draw.whole(4, 12) as f64 / 4.0;
            let steps = [(0.375, TOP - 0.25), (0.25, TOP - depth)];
            deck.put(draft, [start + 0.5, y], round, &steps);
        }
    }
    bearing(draft, &tunnel, [length - 0.5, length]);
    deck.draw(draft);
}

fn bearing(draft: &mut Draft, tunnel: &Loop, ends: [f64; 2]) {
    draft.walls(0, tunnel, ends);
}

/// A bore from the ceiling of its chamber to the deck, and the liner in it.
fn cylinder(
    draft: &mut Draft,
    round: &[[f64; 2]],
    centre: [f64; 2],
    mut ceiling: Face,
    deck: &mut Face,
) {
    let [bore, liner] = [1.0, 1.25].map(|radius| placed(round, centre, radius));
    for (z, face) in [(CEILING, &mut ceiling), (TOP, deck)] {
        draft.plane(2, z, &[liner.clone(), bore.clone()], &[centre]);
        face.open(liner.clone(), centre);
    }
    ceiling.draw(draft);
    draft.walls(2, &bore, [CEILING, TOP]);
    draft.walls(2, &liner, [CEILING, TOP]);
    let between = (bore[0][0] + liner[0][0]) / 2.0;
    draft.region([between, centre[1], 7.5], 2);
}

/// Journals on the axis of the bearings, and a disc in every chamber, off that axis.
fn shaft(draft: &mut Draft, draw: &mut Draw, cylinders: usize, round: &[[f64; 2]]) {
    let journal = placed(round, BEARING, 0.5);
    let mut from = -1.0;
    draft.plane(0, from, std::slice::from_ref(&journal), &[]);
    for c in 0..cylinders {
        let start = PITCH * c as f64;
        let disc = [start + 1.0, start + 3.0];
        let throw = draw.pick(&[[0.25, 0.0], [0.0, 0.25], [-0.25, 0.0], [0.0, -0.25]]);
        let centre = [BEARING[0] + throw[0], BEARING[1] + throw[1]];
        let turned = Turned {
            axis: 0,
            centre,
            outline: round,
            face: disc[0],
            steps: &[(1.0, disc[1])],
            closed: false,
        };
        turned.draw(draft);
        draft.walls(0, &journal, [from, disc[0]]);
        for x in disc {
            draft.plane(0, x, &[turned.outline(0), journal.clone()], &[BEARING]);
        }
        from = disc[1];
    }
    let end = PITCH * cylinders as f64 + 1.0;
    draft.walls(0, &journal, [from, end]);
    draft.plane(0, end, &[journal], &[]);
}
