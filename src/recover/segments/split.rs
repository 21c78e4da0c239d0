//! Where to put a Steiner point on a missing subsegment (paper §2; Si & Gärtner 2005).
//!
//! All of this is a choice, not a decision: any point strictly between the ends keeps the algorithm correct, so plain
//! floats do. Positions are parameters t of the *original* segment p + t(q−p), kept to as few bits as the choice
//! allows: with coordinates that have bits to spare (integers, single precision files) the point is then exactly on the
//! line, and polygons stay flat.

use crate::number::vector::{dot, minus, square};

/// A subsegment of the segment pq and what is known around it.
#[derive(Clone, Copy, Debug)]
pub struct Subsegment {
    /// The ends of the original segment.
    pub ends: [[f64; 3]; 2],
    /// The parameters of the subsegment's ends, 0 ≤ t0 < t1 ≤ 1.
    pub range: [f64; 2],
    /// How many vertices the segment has by now, its ends included.
    pub vertices: usize,
}

/// The vertex that encroaches upon the subsegment most: the one that sees it under the largest angle.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// Its coordinates.
    pub point: [f64; 3],
    /// If it lies on, or is an end of, another segment that shares end 0 or 1 of ours, which one.
    pub shares: Option<usize>,
}

/// Keeps the new point this far from both ends, as a fraction of the subsegment.
const MARGIN: f64 = 0.2;
/// How far the few-bit parameter may be from the chosen one, as a fraction of the subsegment.
const SLACK: f64 = 0.05;

/// The parameter of the new point, strictly inside the range; `None` if there is no double in it.
///
/// 1. If the reference point is on a segment that meets ours at an end, the hub: at its distance from the hub.
///    Two subsegments of equal length at a small angle do not encroach upon each other (an isosceles triangle has acute
///    base angles), so this ends. No bits are saved here: equal distances must be equal up to rounding, or each segment
///    of a fan has to be split again a little beside the points of each other.
/// 2. If there already is a point at that distance, and the segment has many: at a distance from the hub that is a
///    short dyadic number in absolute units, so that all segments of a fan are split on the same spheres. Not at once,
///    because strips of long triangles, which are no fans, are split best in the middle.
/// 3. Otherwise the reference point's projection onto the subsegment, or the middle if that is too close to an end.
pub fn split_parameter(s: &Subsegment, reference: Option<Reference>) -> Option<f64> {
    let [t0, t1] = s.range;
    let length = distance(s.ends[0], s.ends[1]);
    let (t, slack) = same_distance(s, length, reference)
        .or_else(|| on_shell(s, length, reference))
        .unwrap_or_else(|| (projection(s, reference), SLACK * (t1 - t0)));
    let t = fewest_bits(t, slack);
    (t0 < t && t < t1).then_some(t).or_else(|| {
        let middle = 0.5 * (t0 + t1);
        (t0 < middle && middle < t1).then_some(middle)
    })
}

/// Rule 1.
fn same_distance(s: &Subsegment, length: f64, reference: Option<Reference>) -> Option<(f64, f64)> {
    let [t0, t1] = s.range;
    let reference = reference?;
    let end = reference.shares?;
    let t = distance(reference.point, s.ends[end]) / length;
    let t = if end == 0 { t } else { 1.0 - t };
    let margin = 0.5 * MARGIN * (t1 - t0);
    (t0 + margin <= t && t <= t1 - margin).then_some((t, 0.0))
}

/// From how many vertices on a segment on rule 2 holds.
const MANY: usize = 4;
/// How far from both ends rule 2 keeps the new point, as a fraction of the subsegment. At most 1/2.
const SHELL_MARGIN: f64 = 0.25;

/// Rule 2.
fn on_shell(s: &Subsegment, length: f64, reference: Option<Reference>) -> Option<(f64, f64)> {
    let end = reference?.shares?;
    if s.vertices < MANY {
        return None;
    }
    let [t0, t1] = s.range;
    let from_hub = |t: f64| if end == 0 { t } else { 1.0 - t };
    let (x, y) = (from_hub(t0) * length, from_hub(t1) * length);
    let (near, far) = (x.min(y), x.max(y));
    let keep = SHELL_MARGIN * (far - near);
    let mut step = 2f64.powi((far - near).log2().ceil() as i32 + 1);
    // An interval of half the length has a multiple of a quarter of it.
    for _ in 0..4 {
        let radius = ((near + keep) / step).ceil() * step;
        if radius <= far - keep {
            return Some((from_hub(radius / length), 0.0));
        }
        step *= 0.5;
    }
    None
}

/// Rule 3.
fn projection(s: &Subsegment, reference: Option<Reference>) -> f64 {
    let [t0, t1] = s.range;
    let middle = 0.5 * (t0 + t1);
    let Some(reference) = reference else {
        return middle;
    };
    let [p, q] = s.ends;
    let along = minus(q, p);
    let t = dot(minus(reference.point, p), along) / dot(along, along);
    let margin = MARGIN * (t1 - t0);
    if t0 + margin <= t && t <= t1 - margin {
        t
    } else {
        middle
    }
}

/// The number with the fewest bits after the binary point that is within `slack` of t.
pub(super) fn fewest_bits(t: f64, slack: f64) -> f64 {
    if slack <= 0.0 {
        return t;
    }
    const MOST: f64 = (1u64 << 52) as f64;
    let mut scale = 1.0;
    while scale < MOST {
        let rounded = (t * scale).round() / scale;
        if (rounded - t).abs() <= slack {
            return rounded;
        }
        scale *= 2.0;
    }
    t
}

/// The cosine-like measure by which the vertex p sees ab: smaller for larger angles, negative inside the diametral
/// sphere.
pub fn angle_measure(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let (u, v) = (minus(a, p), minus(b, p));
    dot(u, v) / (dot(u, u) * dot(v, v)).sqrt()
}

/// The distance of two points.
#[inline]
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    square(minus(a, b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole() -> Subsegment {
        Subsegment {
            ends: [[0.0; 3], [10.0, 0.0, 0.0]],
            range: [0.0, 1.0],
            vertices: 2,
        }
    }

    #[test]
    fn projects_the_reference_point_with_few_bits() {
        let reference = Reference {
            point: [3.7, 1.0, 0.0],
            shares: None,
        };
        assert_eq!(split_parameter(&whole(), Some(reference)), Some(0.375));
        let near_the_end = Reference {
            point: [0.1, 1.0, 0.0],
            shares: None,
        };
        assert_eq!(split_parameter(&whole(), Some(near_the_end)), Some(0.5));
    }

    #[test]
    fn repeats_the_distance_of_a_neighbour() {
        let reference = Reference {
            point: [3.0, 0.1, 0.0],
            shares: Some(0),
        };
        let t = split_parameter(&whole(), Some(reference)).expect("long enough");
        assert_eq!(t * 10.0, (9.01f64).sqrt());
    }

    #[test]
    fn segments_of_a_fan_are_split_on_common_spheres() {
        let radius = |length: f64| {
            let s = Subsegment {
                ends: [[0.0; 3], [length, 0.0, 0.0]],
                range: [4.0 / length, 7.0 / length],
                vertices: MANY,
            };
            // At the distance of the subsegment's first end.
            let reference = Reference {
                point: [4.0, 0.1, 0.0],
                shares: Some(0),
            };
            split_parameter(&s, Some(reference)).expect("long enough") * length
        };
        for length in [10.0, 11.3, 12.7] {
            assert!((radius(length) - 5.0).abs() < 1e-14 || (radius(length) - 6.0).abs() < 1e-14);
            assert!((radius(length) - radius(10.0)).abs() < 1e-14);
        }
    }

    #[test]
    fn stops_when_doubles_end() {
        let mut s = whole();
        s.range = [0.5, 0.5f64.next_up()];
        assert_eq!(split_parameter(&s, None), None);
    }
}
