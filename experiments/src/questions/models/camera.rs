//! Where a model is seen from: above and beside, in parallel projection, as large as the picture allows.

use tetflip::exchange::Plc;

/// The directions of the picture's axes, right, up and towards the eye: orthogonal, of length 1.
const AXES: [[f64; 3]; 3] = [
    [0.8, 0.6, 0.0],
    [-0.3, 0.4, 0.866_025_403_784_438_6],
    [0.519_615_242_270_663_2, -0.692_820_323_027_551, 0.5],
];

/// A parallel projection.
pub struct Camera {
    low: [f64; 3],
    high: [f64; 3],
    middle: [f64; 3],
    scale: f64,
}

impl Camera {
    /// A projection that shows all vertices of a model within the unit square.
    pub fn of(plc: &Plc) -> Camera {
        let bounds = |points: &mut dyn Iterator<Item = [f64; 3]>| {
            points.fold(([f64::MAX; 3], [f64::MIN; 3]), |(low, high), p| {
                let at = |k: usize| (low[k].min(p[k]), high[k].max(p[k]));
                ([0, 1, 2].map(|k| at(k).0), [0, 1, 2].map(|k| at(k).1))
            })
        };
        let (low, high) = bounds(&mut plc.vertices.iter().copied());
        let (left, right) = bounds(&mut plc.vertices.iter().map(|&p| turned(p)));
        let extent = (right[0] - left[0]).max(right[1] - left[1]);
        Camera {
            low,
            high,
            middle: [0, 1, 2].map(|k| (left[k] + right[k]) / 2.0),
            scale: 0.94 / extent,
        }
    }

    /// Points in the picture, and how near they are: all about ±1/2.
    pub fn view(&self, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let view = |&p: &[f64; 3]| {
            let p = turned(p);
            [0, 1, 2].map(|k| (p[k] - self.middle[k]) * self.scale)
        };
        points.iter().map(view).collect()
    }

    /// Whether a polygon lies on a side of the bounding box.
    pub fn is_side(&self, polygon: &[[f64; 3]]) -> bool {
        let on = |k: usize, x: f64| polygon.iter().all(|p| p[k] == x);
        (0..3).any(|k| on(k, self.low[k]) || on(k, self.high[k]))
    }
}

fn turned(p: [f64; 3]) -> [f64; 3] {
    AXES.map(|axis| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2])
}
