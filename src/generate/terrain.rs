//! Layers of ground: surfaces of triangles over one plan, closed at their sides, with a region for every part of a
//! layer. Layers but the lowest thin out: where two surfaces come together they are one.

use super::draft::{Draft, Sets, lift};
use super::draw::{Draw, grid};
use crate::exchange::Plc;

/// The number of layers.
const LAYERS: usize = 3;

/// Four surfaces over a square grid of points, those inside moved a little.
pub(super) fn terrain(draw: &mut Draw, size: usize) -> Plc {
    // Two triangles a square for every surface, and four sides of layers.
    let squares = |n: usize| (2 * (LAYERS + 1) * n * n + 4 * LAYERS * n) as f64;
    let n = (1..)
        .find(|&n| squares(n + 1) > size as f64)
        .expect("squares grow");
    let ground = Ground::new(draw, n);
    let mut draft = Draft::default();
    for triangle in ground.triangles() {
        for surface in 0..=LAYERS {
            // Drawn once where it lies on the surface below.
            if surface == 0 || ground.is_thick(surface - 1, &triangle) {
                draft.polygon(&triangle.map(|i| ground.point(surface, i)));
            }
        }
    }
    for side in ground.sides() {
        for layer in 0..LAYERS {
            ground.draw_side(&mut draft, layer, side);
        }
    }
    ground.regions(&mut draft);
    draft.finish()
}

/// Points of a plan of n × n squares and their heights on all surfaces.
struct Ground {
    n: usize,
    plan: Vec<[f64; 2]>,
    heights: Vec<[f64; LAYERS + 1]>,
}

impl Ground {
    fn new(draw: &mut Draw, n: usize) -> Ground {
        let noise = [(); LAYERS + 1].map(|()| Noise::new(draw, n));
        let mut ground = Ground {
            n,
            plan: Vec::new(),
            heights: Vec::new(),
        };
        for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
            // Points on a side of the square stay on it, its corners where they are.
            let mut moved = |k: usize| match k {
                0 => 0.0,
                _ if k == n => n as f64,
                _ => k as f64 + draw.between(-0.2, 0.2),
            };
            ground.plan.push([moved(i), moved(j)]);
            let step = n as f64 / 8.0;
            let mut height = f64::MIN;
            let heights = [0, 1, 2, 3].map(|surface: usize| {
                let wave = grid(step * noise[surface].at(i, j));
                height = match surface {
                    0 => wave,
                    // The lowest layer is everywhere; another is missing where its thickness would be negative.
                    _ => {
                        let least = if surface == 1 { grid(step / 16.0) } else { 0.0 };
                        height + (wave + grid(step / 4.0)).max(least)
                    }
                };
                height
            });
            ground.heights.push(heights);
        }
        ground
    }

    fn point(&self, surface: usize, i: usize) -> [f64; 3] {
        lift(2, self.plan[i], self.heights[i][surface])
    }

    /// Two to a square.
    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let (n, width) = (self.n, self.n + 1);
        let squares = (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
        squares.flat_map(move |(i, j)| {
            let [a, b, c, d] =
                [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(k, l)| (i + k) * width + j + l);
            match (i + j) % 2 {
                0 => [[a, b, c], [a, c, d]],
                _ => [[a, b, d], [b, c, d]],
            }
        })
    }

    /// The sides of the plan, in steps of one square.
    fn sides(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let (n, width) = (self.n, self.n + 1);
        (0..n).flat_map(move |k| {
            [
                [k, k + 1],
                [n * width + k, n * width + k + 1],
                [k * width, (k + 1) * width],
            ]
            .into_iter()
            .chain([[k * width + n, (k + 1) * width + n]])
        })
    }

    fn is_thick(&self, layer: usize, points: &[usize]) -> bool {
        let thick = |&i: &usize| self.heights[i][layer] < self.heights[i][layer + 1];
        points.iter().any(thick)
    }

    /// A quadrangle, a triangle, or nothing.
    fn draw_side(&self, draft: &mut Draft, layer: usize, [i, j]: [usize; 2]) {
        let mut corners = vec![self.point(layer, i), self.point(layer, j)];
        if self.is_thick(layer, &[j]) {
            corners.push(self.point(layer + 1, j));
        }
        if self.is_thick(layer, &[i]) {
            corners.push(self.point(layer + 1, i));
        }
        if corners.len() > 2 {
            draft.polygon(&corners);
        }
    }

    /// A point in every part of every layer: parts are joined through edges over which the layer is not everywhere
    /// of thickness zero.
    fn regions(&self, draft: &mut Draft) {
        let triangles: Vec<[usize; 3]> = self.triangles().collect();
        for layer in 0..LAYERS {
            let mut parts = Sets::new(self.plan.len());
            for t in &triangles {
                // Thick points of one triangle are in one part.
                let thick: Vec<usize> = t
                    .iter()
                    .copied()
                    .filter(|&i| self.is_thick(layer, &[i]))
                    .collect();
                thick.windows(2).for_each(|w| {
                    parts.join(w[0], w[1]);
                });
            }
            let mut done = vec![false; self.plan.len()];
            for t in &triangles {
                let Some(&thick) = t.iter().find(|&&i| self.is_thick(layer, &[i])) else {
                    continue;
                };
                let part = parts.find(thick);
                if !std::mem::replace(&mut done[part], true) {
                    let corners = t.map(|i| self.point(layer, i));
                    let tops = t.map(|i| self.point(layer + 1, i));
                    let mean =
                        |k: usize| corners.iter().chain(&tops).map(|p| p[k]).sum::<f64>() / 6.0;
                    draft.region([0, 1, 2].map(mean), layer + 1);
                }
            }
        }
    }
}

/// Waves of halving lengths and heights: random heights on grids, interpolated.
struct Noise {
    /// The distance of the points of each grid, and the heights there, with the length of a row.
    octaves: Vec<(usize, usize, Vec<f64>)>,
}

impl Noise {
    fn new(draw: &mut Draw, n: usize) -> Noise {
        let lengths = (0..).map(|k| (n / 3) >> k).take_while(|&length| length > 0);
        let lengths: Vec<usize> = if n < 3 { vec![1] } else { lengths.collect() };
        let octave = |length: usize| {
            let row = n / length + 2;
            (
                length,
                row,
                (0..row * row).map(|_| draw.between(-1.0, 1.0)).collect(),
            )
        };
        Noise {
            octaves: lengths.into_iter().map(octave).collect(),
        }
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        let (mut sum, mut weight) = (0.0, 1.0);
        for (length, row, heights) in &self.octaves {
            let [x, y] = [i, j].map(|k| (k % length) as f64 / *length as f64);
            let height = |k: usize, l: usize| heights[(i / length + k) * row + j / length + l];
            let near = height(0, 0) * (1.0 - x) + height(1, 0) * x;
            let far = height(0, 1) * (1.0 - x) + height(1, 1) * x;
            weight /= 2.0;
            sum += weight * (near * (1.0 - y) + far * y);
        }
        sum
    }
}
