//! The picture of a stuck run: the polyhedron of the worst class that it has left.

use super::search::Case;
use crate::pictures::picture::{POLYGON, Picture, Spot, Stage, side};
use tetflip::mesh::VertexId;
use tetflip::predicate::PointStore;

/// Pictures with more tetrahedra than this show nothing.
const MOST_TETRAHEDRA: usize = 60;

/// The picture; none if too much is left.
pub fn picture(case: &Case) -> Option<String> {
    let piece = case.pieces.first()?;
    if piece.tets.len() > MOST_TETRAHEDRA {
        return None;
    }
    let points = case.cdt.points();
    let at = |v: u32| points.rounded(VertexId(v));
    let frame = case.insertion.frame;
    let tets: Vec<[u32; 4]> = piece.tets.iter().map(|t| t.map(|v| v.0)).collect();
    let mut used: Vec<u32> = tets.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let spots: Vec<[f64; 3]> = used.iter().map(|&v| at(v)).collect();
    let stage = Stage::new(frame.map(|v| points.rounded(v)), &spots);
    let side = |v: u32| side(points, frame, v);
    let mut picture = Picture::default();
    let spots: Vec<_> = used.iter().map(|&v| stage.spot(at(v))).collect();
    let ground = ground(&spots);
    picture.face(&ground, POLYGON, 0.25);
    picture.tetrahedra(&tets, |v| stage.spot(at(v)), side, used.len() <= 16);
    let title = format!("{}, flip times {}", case.member, case.times);
    let caption = format!(
        "{title}\n{}; {} tetrahedra left that cross the polygon",
        piece.class.name(),
        tets.len()
    );
    Some(picture.svg(&title, &caption))
}

/// A rectangle in the plane of the polygon that is a little larger than what is above and below it.
fn ground(spots: &[Spot]) -> [Spot; 4] {
    let bounds = |axis: usize| {
        let all = || spots.iter().map(|s| s[axis]);
        let low = all().fold(f64::INFINITY, f64::min);
        let high = all().fold(f64::NEG_INFINITY, f64::max);
        let room = 0.08 * (high - low).max(0.1);
        (low - room, high + room)
    };
    let ((x0, x1), (y0, y1)) = (bounds(0), bounds(1));
    [[x0, y0, 0.0], [x1, y0, 0.0], [x1, y1, 0.0], [x0, y1, 0.0]]
}
