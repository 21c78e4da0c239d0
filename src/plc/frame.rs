//! The frame of a polygon: three of its vertices whose triangle is large (paper §3.2), so that the plane they span is
//! close to all others, and the test of how close.
//!
//! Floats choose the frame, exact arithmetic confirms it. Linear in the number of vertices.

use super::plane::{collinear, orient3d};
use crate::mesh::VertexId;
use crate::number::bits::exponent;
use crate::number::vector::{cross, minus, square};
use crate::number::{Dyadic, Number, Vec3};
use crate::predicate::formula;

/// How far vertices may be from the plane of the frame, relative to the diagonal of the polygon's bounding box.
pub(super) const FLATNESS: f64 = 1e-9;

/// How the vertices of a polygon lie to the plane of its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Flatness {
    /// All on it.
    Flat,
    /// All within [`FLATNESS`].
    NearlyFlat,
    /// This one, the worst, is at this distance.
    NotPlanar(VertexId, f64),
}

/// Three non-collinear vertices that span a large triangle: a and b far from each other, c far from the line ab.
/// `None` if all vertices are collinear. The result does not depend on anything but the order of `vertices`.
pub(crate) fn choose(points: &[[f64; 3]], vertices: &[VertexId]) -> Option<[VertexId; 3]> {
    let &start = vertices.first()?;
    let unit = Unit::of(points, vertices);
    let scaled = vertices.iter().map(|v| unit.point(points[v.index()]));
    let at: Vec<[f64; 3]> = scaled.collect();
    let a = farthest(&at, |p| square(minus(p, at[0])));
    let b = farthest(&at, |p| square(minus(p, at[a])));
    let line = minus(at[b], at[a]);
    let c = farthest(&at, |p| square(cross(line, minus(p, at[a]))));
    let [a, b, c] = [vertices[a], vertices[b], vertices[c]];
    let is_frame = |frame: [VertexId; 3]| !collinear(frame.map(|v| points[v.index()]));
    if is_frame([a, b, c]) {
        return Some([a, b, c]);
    }
    // The area is lost in rounding. If any three vertices are not collinear, then neither are two fixed different ones
    // and some third.
    let &b = vertices
        .iter()
        .find(|v| points[v.index()] != points[start.index()])?;
    let c = vertices.iter().find(|&&c| is_frame([start, b, c]))?;
    Some([start, b, *c])
}

/// How the vertices lie to the plane of the frame: signs are exact, the distance is rounded at its end only.
pub(super) fn flatness(
    points: &[[f64; 3]],
    frame: [VertexId; 3],
    vertices: &[VertexId],
) -> Flatness {
    let [a, b, c] = frame.map(|v| points[v.index()]);
    let off_plane =
        |v: &&VertexId| !frame.contains(v) && !orient3d([a, b, c, points[v.index()]]).is_zero();
    let outside: Vec<VertexId> = vertices.iter().filter(off_plane).copied().collect();
    if outside.is_empty() {
        return Flatness::Flat;
    }
    // Distances are taken after scaling by a power of two, so that they neither overflow nor underflow.
    let unit = Unit::of(points, vertices);
    let exponent = i64::from(exponent(unit.size));
    let scaled = |p: [f64; 3]| Vec3(p.map(|x| Dyadic::from_f64(x).shifted(-exponent)));
    let [a, b, c] = [a, b, c].map(scaled);
    let normal = b.sub(&a).cross(&c.sub(&a));
    let normal_length = normal.dot(&normal).to_f64().sqrt();
    let distance = |v: VertexId| {
        let d = scaled(points[v.index()]);
        formula::orient3d([&a, &b, &c, &d]).to_f64().abs() / normal_length
    };
    let worst = outside[farthest(&outside, distance)];
    let found = distance(worst);
    let diagonal =
        square(unit.extent).sqrt() * Dyadic::from_f64(unit.size).shifted(1 - exponent).to_f64();
    if found <= FLATNESS * diagonal {
        Flatness::NearlyFlat
    } else {
        let distance = Dyadic::from_f64(found.min(f64::MAX))
            .shifted(exponent)
            .to_f64();
        Flatness::NotPlanar(worst, distance)
    }
}

/// A scaling of the vertices' bounding box into the unit cube, for the choices that floats make.
struct Unit {
    low: [f64; 3],
    /// Half the largest side of the bounding box.
    size: f64,
    /// The sides of the bounding box after scaling.
    extent: [f64; 3],
}

impl Unit {
    fn of(points: &[[f64; 3]], vertices: &[VertexId]) -> Unit {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for v in vertices {
            for (k, &x) in points[v.index()].iter().enumerate() {
                low[k] = low[k].min(x);
                high[k] = high[k].max(x);
            }
        }
        let half = half_minus(high, low);
        let size = half.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        Unit {
            low,
            size,
            extent: half.map(|x| x / size),
        }
    }

    fn point(&self, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = half_minus(p, self.low);
        [x / self.size, y / self.size, z / self.size]
    }
}

/// (p − q)/2, which does not overflow.
fn half_minus(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [
        0.5 * p[0] - 0.5 * q[0],
        0.5 * p[1] - 0.5 * q[1],
        0.5 * p[2] - 0.5 * q[2],
    ]
}

/// The place of the first item with the largest measure.
fn farthest<T: Copy>(items: &[T], measure: impl Fn(T) -> f64) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for (i, &item) in items.iter().enumerate() {
        let found = measure(item);
        if found > best.1 {
            best = (i, found);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(n: usize) -> Vec<VertexId> {
        (0..n).map(VertexId::new).collect()
    }

    /// A square with a fourth vertex lifted by `height`, all scaled.
    fn square(height: f64, scale: f64) -> [[f64; 3]; 4] {
        let square = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, height],
            [0.0, 1.0, 0.0],
        ];
        square.map(|p| p.map(|x| x * scale))
    }

    #[test]
    fn flatness_at_every_scale() {
        for scale in [1.0, 1e300, 1e-300, 1.7e308] {
            let measure = |height| {
                let points = square(height, scale);
                let frame = choose(&points, &all(4)).unwrap();
                flatness(&points, frame, &all(4))
            };
            assert_eq!(measure(0.0), Flatness::Flat);
            assert_eq!(measure(1e-10), Flatness::NearlyFlat);
            match measure(1e-8) {
                Flatness::NotPlanar(_, d) => {
                    assert!((1e-9..1.001e-8).contains(&(d / scale)), "{d:e} {scale:e}");
                }
                other => panic!("{other:?}"),
            }
        }
    }

    #[test]
    fn area_below_rounding_is_found() {
        let tiny = f64::from_bits(1);
        let points = [
            [0.0; 3],
            [1.0, 1.0, 0.0],
            [0.5, 0.5, 0.0],
            [0.25, 0.25, tiny],
        ];
        assert_eq!(choose(&points[..3], &all(3)), None);
        let frame = choose(&points, &all(4)).unwrap();
        assert!(frame.contains(&VertexId(3)));
        assert_eq!(choose(&points, &[]), None);
    }
}
