//! Which part of space a simplex reaches: whether it has a point in a cell, and its range along a direction there. In
//! doubles, with margins for their rounding, so that no simplex is lost.

use super::tree::Bounds;

type Point = [f64; 3];

/// The range that the part of a triangle in a cell has along a direction; a quarter of it, so that sums do not
/// overflow. The part is computed by clipping (Sutherland & Hodgman 1974) in doubles, and everything that rounding
/// might cut off is added, so that the range is not too small.
pub(super) fn range_in_cell(corners: [Point; 3], cell: &Bounds, direction: Point) -> (f64, f64) {
    const MARGIN: f64 = 64.0 * f64::EPSILON;
    let size = [0, 1, 2].map(|k| {
        let bounds = cell.low[k].abs().max(cell.high[k].abs());
        corners.iter().fold(bounds, |m, p| m.max(p[k].abs()))
    });
    let mut shape = corners.to_vec();
    for (k, bound, sign) in (0..3).flat_map(|k| [(k, cell.low[k], 1.0), (k, cell.high[k], -1.0)]) {
        let inside = |p: &Point| sign * p[k] >= sign * bound;
        let mut clipped = Vec::with_capacity(shape.len() + 1);
        for (i, p) in shape.iter().enumerate() {
            let q = &shape[(i + 1) % shape.len()];
            if inside(p) {
                clipped.push(*p);
            }
            if inside(p) != inside(q) {
                let (within, beyond) = if inside(p) { (p, q) } else { (q, p) };
                let length = (beyond[k] - within[k]).abs();
                let exact = (bound - within[k]).abs() / length;
                let t = (exact + MARGIN * size[k] / length).min(1.0);
                clipped.push([0, 1, 2].map(|j| within[j] * (1.0 - t) + beyond[j] * t));
            }
        }
        // Only by rounding: it does reach the cell.
        if clipped.is_empty() {
            shape = corners.to_vec();
            break;
        }
        shape = clipped;
    }
    let terms = |p: &Point| [0, 1, 2].map(|k| 0.25 * direction[k] * p[k]);
    let sizes = terms(&size).iter().map(|x| x.abs()).sum::<f64>();
    let wrong = 4.0 * MARGIN * sizes + f64::MIN_POSITIVE;
    let at = shape.iter().map(|p| terms(p).iter().sum::<f64>());
    let low = at.clone().fold(f64::INFINITY, f64::min);
    let high = at.fold(f64::NEG_INFINITY, f64::max);
    (low - wrong, high + wrong)
}

/// Whether one of the axes across an edge of the triangle and an edge of the box, or the normal of the triangle,
/// certainly separates them. Infinite and undefined values separate nothing.
pub(super) fn separated(triangle: [Point; 3], cell: &Bounds) -> bool {
    let half = |x: f64, y: f64, sign: f64| 0.5 * x + sign * 0.5 * y;
    let centre = [0, 1, 2].map(|k| half(cell.high[k], cell.low[k], 1.0));
    let extent = [0, 1, 2].map(|k| half(cell.high[k], cell.low[k], -1.0));
    let at = triangle.map(|p| [0, 1, 2].map(|k| p[k] - centre[k]));
    // What the coordinates are rounded by is at most this times the unit roundoff.
    let size = [0, 1, 2].map(|k| {
        let largest = triangle
            .iter()
            .fold(centre[k].abs(), |m, p| m.max(p[k].abs()));
        largest + extent[k]
    });
    /// Far above what the few operations below add up to.
    const MARGIN: f64 = 64.0 * f64::EPSILON;
    let apart = |axis: Point, slack: f64| {
        let along = |p: &Point| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
        let [x, y, z] = [along(&at[0]), along(&at[1]), along(&at[2])];
        let reach: f64 =
            (0..3).map(|k| axis[k].abs() * extent[k]).sum::<f64>() + slack + f64::MIN_POSITIVE;
        x.min(y).min(z) > reach || x.max(y).max(z) < -reach
    };
    let sides = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| [0, 1, 2].map(|k| at[j][k] - at[i][k]));
    // Where a cell is much smaller than a triangle, its plane does it mostly.
    let [[ax, ay, az], [bx, by, bz], _] = sides;
    let normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    if apart(normal, MARGIN * 24.0 * size[0] * size[1] * size[2]) {
        return true;
    }
    for side in &sides {
        for k in 0..3 {
            let (l, m) = ((k + 1) % 3, (k + 2) % 3);
            let mut axis = [0.0; 3];
            axis[l] = -side[m];
            axis[m] = side[l];
            // Both factors of each product are rounded relative to `size`, and bounded by twice it.
            if apart(axis, MARGIN * 4.0 * size[l] * size[m]) {
                return true;
            }
        }
    }
    false
}
