//! Vertices as the viewer draws them: the polygon's plane is horizontal, its centroid the origin, and heights are exact
//! before they are rounded, because in some scenes all of them are within an ulp.

use tetflip::mesh::VertexId;
use tetflip::number::{Dyadic, Sign, Vec3};
use tetflip::predicate::{PointStore, formula};

/// Heights are drawn at least this part of the scene's radius.
const LEAST_HEIGHT: f64 = 0.3;

/// What is drawn.
pub struct Picture {
    /// For each vertex; y is the height. The farthest vertex is about 1 from the origin.
    pub positions: Vec<[f32; 3]>,
    /// 1: left of the polygon, 0: on its plane, −1: right.
    pub sides: Vec<i8>,
    /// Heights are multiplied by this.
    pub exaggeration: f64,
}

impl Picture {
    /// The vertices beside the polygon, of which `frame` are three vertices.
    pub fn of<P: PointStore>(
        points: &P,
        frame: [VertexId; 3],
        polygon: &[VertexId],
        vertices: &[VertexId],
    ) -> Picture {
        let plane = Plane::of(points, frame, polygon);
        let mut at: Vec<[f64; 3]> = vertices.iter().map(|&v| plane.place(points, v)).collect();
        let largest = |size: &dyn Fn(&[f64; 3]) -> f64| at.iter().map(size).fold(0.0, f64::max);
        let radius = largest(&|p| p[0].hypot(p[2]));
        let height = largest(&|p| p[1].abs());
        let exaggeration = two_digits((LEAST_HEIGHT * radius / height).max(1.0));
        let scale = 1.0 / radius.max(height * exaggeration);
        for p in &mut at {
            *p = [p[0] * scale, p[1] * exaggeration * scale, p[2] * scale];
        }
        let [a, b, c] = frame;
        let side = |v| match points.orient3d([a, b, c, v]) {
            Sign::Positive => 1,
            Sign::Zero => 0,
            Sign::Negative => -1,
        };
        Picture {
            positions: at.iter().map(|p| p.map(decimals)).collect(),
            sides: vertices.iter().map(|&v| side(v)).collect(),
            exaggeration,
        }
    }
}

/// Four decimals: finer than a pixel.
fn decimals(x: f64) -> f32 {
    ((x * 1e4).round() / 1e4) as f32
}

/// Two significant digits.
fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().expect("a number")
}

/// Two orthonormal directions of the polygon's plane, and its centroid.
struct Plane {
    frame: [VertexId; 3],
    origin: [f64; 3],
    axes: [[f64; 3]; 2],
    /// The length of the frame's normal, twice its area.
    normal: f64,
}

fn sub(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ]
}

impl Plane {
    fn of<P: PointStore>(points: &P, frame: [VertexId; 3], polygon: &[VertexId]) -> Plane {
        let [a, b, c] = frame.map(|v| points.rounded(v));
        let normal = cross(sub(b, a), sub(c, a));
        let length = dot(normal, normal).sqrt();
        let along = sub(b, a);
        let along = along.map(|x| x / dot(along, along).sqrt());
        let across = cross(normal.map(|x| x / length), along);
        let corners = polygon.iter().map(|&v| points.rounded(v));
        let sum = corners.fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
        Plane {
            frame,
            origin: sum.map(|x| x / polygon.len() as f64),
            axes: [along, across],
            normal: length,
        }
    }

    /// The directions along, up, and −across are right-handed with up as y, so that nothing is mirrored.
    fn place<P: PointStore>(&self, points: &P, v: VertexId) -> [f64; 3] {
        let p = sub(points.rounded(v), self.origin);
        let [a, b, c] = self.frame;
        let corners: [Vec3<Dyadic>; 4] = [a, b, c, v].map(|v| points.coordinates(v));
        let volume = formula::orient3d(corners.each_ref());
        let height = volume.quotient(&tetflip::number::Number::from_f64(self.normal));
        [dot(p, self.axes[0]), height, -dot(p, self.axes[1])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::predicate::DoublePoints;

    fn picture(last: [f64; 3]) -> Picture {
        let corners = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 3.0, 0.0],
            [0.0, 3.0, 0.0],
        ];
        let points = DoublePoints::new([&corners[..], &[last]].concat());
        let all: Vec<VertexId> = (0..5).map(VertexId::new).collect();
        Picture::of(&points, [all[0], all[1], all[2]], &all[..4], &all)
    }

    #[test]
    fn nothing_is_mirrored_and_the_left_is_above() {
        let picture = picture([2.0, 1.5, 2.0]);
        assert_eq!(picture.exaggeration, 1.0);
        assert_eq!(picture.sides, [0, 0, 0, 0, 1]);
        let [a, b, c, _, e] = picture.positions[..] else {
            panic!("five positions")
        };
        assert_eq!(a, [-0.8, 0.0, 0.6]);
        assert_eq!(e, [0.0, 0.8, 0.0]);
        let [a, b, c, e] = [a, b, c, e].map(|p| p.map(f64::from));
        assert!(dot(cross(sub(b, a), sub(c, a)), sub(e, a)) > 0.0);
    }

    #[test]
    fn heights_within_an_ulp_are_seen() {
        let picture = picture([2.0, 1.5, -1e-17]);
        assert_eq!(picture.sides[4], -1);
        assert!(picture.exaggeration > 1e16);
        assert!((picture.positions[4][1] + 0.3).abs() < 0.01);
    }
}
