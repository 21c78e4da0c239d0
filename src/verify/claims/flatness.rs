//! Facets that are on one plane to a stated precision δ: some plane is within δ, along each axis, of all their
//! vertices.
//!
//! A plane is searched for in doubles, and by what the construction uses, too ([`crate::number::slab`]); whether it
//! is one is decided here, exactly but for the last places of coordinates, which its equation cannot follow.

use crate::mesh::VertexId;
use crate::number::slab::Slab;
use crate::number::vector::{cross, minus};
use crate::number::{Dyadic, Exact, Number};
use crate::verify::case::Case;
use crate::verify::claims::segments::axes_of;
use crate::verify::input;
use crate::verify::signs::distance::ulp;

/// How far off a vertex may be beyond the precision, in units in the last place of the largest coordinate.
const ROUNDING: f64 = 4.0;

/// Whether some plane is within the precision of all vertices of the facets.
pub(crate) fn is_flat(case: &Case, facets: &[usize]) -> bool {
    if case.options.precision <= 0.0 {
        return false;
    }
    let vertices = vertices(case, facets);
    let Some(frame) = input::frame(case.points, &vertices) else {
        return true;
    };
    let tolerance = case.options.precision + ROUNDING * ulp(case.points.largest());
    let points: Vec<[f64; 3]> = vertices.iter().map(|&v| case.points.at(v)).collect();
    let found = Slab::of(frame.map(|v| case.points.at(v))).and_then(|mut slab| {
        let found = slab.fit(&points, 0, tolerance);
        found.then(|| slab.equation())
    });
    found.is_some_and(|plane| points.iter().all(|&p| is_within(p, plane, tolerance)))
}

/// The axes of a projection that suits the facets together: a single one may be too thin to tell.
pub(crate) fn axes(case: &Case, facets: &[usize]) -> Option<[usize; 2]> {
    let frame = match facets {
        [f] => case.input.facets[*f].frame?,
        _ => input::frame(case.points, &vertices(case, facets))?,
    };
    axes_of(case, frame)
}

/// The vertices of the facets, sorted.
fn vertices(case: &Case, facets: &[usize]) -> Vec<VertexId> {
    let all = facets.iter().flat_map(|&f| &case.input.facets[f].vertices);
    let mut all: Vec<VertexId> = all.copied().collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Whether a point p is within a distance, along each axis, of the plane n·(x − o) = c: |n·(p − o) − c| is at most that
/// times |n₁| + |n₂| + |n₃|. Exact.
fn is_within(p: [f64; 3], (n, o, c): ([f64; 3], [f64; 3], f64), distance: f64) -> bool {
    let exact = Dyadic::from_f64;
    let mut height = exact(-c);
    let mut most = Dyadic::ZERO;
    for k in 0..3 {
        height = height + &(exact(n[k]) * &(exact(p[k]) - &exact(o[k])));
        most = most + &exact(n[k].abs());
    }
    let most = most * &exact(distance);
    let above = height.clone() - &most;
    let below = height + &most;
    !above.exact_sign().is_positive() && !below.exact_sign().is_negative()
}

/// The largest distance of a vertex of the facets from the plane of three of them, along its normal, rounded.
pub(crate) fn bulge(case: &Case, facets: &[usize]) -> f64 {
    let vertices = vertices(case, facets);
    let Some([a, b, c]) = input::frame(case.points, &vertices) else {
        return 0.0;
    };
    let [a, b, c] = [a, b, c].map(|v| case.points.at(v));
    let normal = cross(minus(b, a), minus(c, a));
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    let height = |v: &VertexId| {
        let d = minus(case.points.at(*v), a);
        (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]).abs() / length
    };
    vertices.iter().map(height).fold(0.0, f64::max)
}
