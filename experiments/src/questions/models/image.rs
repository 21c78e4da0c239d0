//! A picture in grey with a depth at every pixel, sampled nine times for each.

use std::error::Error;
use std::path::Path;

/// Samples along each side of a pixel.
const SAMPLES: usize = 3;
/// How far an edge may be behind the facets that it is drawn on.
const BEHIND: f64 = 0.004;
/// Where the light comes from.
const LIGHT: [f64; 3] = [-0.36, 0.48, 0.8];

/// Samples, 0 black and 1 white, and how near they are.
pub struct Image {
    side: usize,
    grey: Vec<f32>,
    near: Vec<f64>,
}

impl Image {
    /// A blank square.
    pub fn new(width: usize) -> Image {
        let side = width * SAMPLES;
        Image {
            side,
            grey: vec![1.0; side * side],
            near: vec![f64::MIN; side * side],
        }
    }

    /// How much is drawn on.
    pub fn ink(&self) -> f64 {
        let drawn = self.grey.iter().filter(|&&g| g < 1.0).count();
        drawn as f64 / self.grey.len() as f64
    }

    /// Draws a plane facet, whose polygons are given with their depths: what lies within an odd number of them.
    pub fn fill(&mut self, polygons: &[Vec<[f64; 3]>]) {
        let normal = newell(&polygons[0]);
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Seen from its edge.
        if normal[2].abs() < 1e-9 * length {
            return;
        }
        let lit: f64 = (0..3).map(|k| normal[k] * LIGHT[k]).sum::<f64>() * normal[2].signum();
        let grey = (0.62 + 0.33 * lit / length).clamp(0.3, 0.95) as f32;
        let origin = polygons[0][0];
        let depth = |x: f64, y: f64| {
            origin[2] - (normal[0] * (x - origin[0]) + normal[1] * (y - origin[1])) / normal[2]
        };
        let sides: Vec<[[f64; 3]; 2]> = polygons
            .iter()
            .flat_map(|p| (0..p.len()).map(|i| [p[i], p[(i + 1) % p.len()]]))
            .collect();
        let heights = || polygons.iter().flatten().map(|p| p[1]);
        let low = self.cell(heights().fold(f64::MAX, f64::min));
        let high = self.cell(heights().fold(f64::MIN, f64::max));
        for row in low..=high {
            let y = self.position(row);
            let crossing = |[p, q]: &[[f64; 3]; 2]| {
                let crosses = (p[1] <= y) != (q[1] <= y);
                crosses.then(|| p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
            };
            let mut crossings: Vec<f64> = sides.iter().filter_map(crossing).collect();
            crossings.sort_by(f64::total_cmp);
            for span in crossings.chunks_exact(2) {
                for column in self.cell(span[0])..=self.cell(span[1]) {
                    let x = self.position(column);
                    if (span[0]..=span[1]).contains(&x) {
                        self.put(column, row, depth(x, y), grey);
                    }
                }
            }
        }
    }

    /// Draws an edge where it is not hidden.
    pub fn line(&mut self, p: [f64; 3], q: [f64; 3]) {
        let length = (0..2).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max);
        let steps = (length * self.side as f64).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let t = step as f64 / steps as f64;
            let [x, y, z] = [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k]));
            let (column, row) = (self.cell(x), self.cell(y));
            let at = row * self.side + column;
            if z + BEHIND >= self.near[at] {
                self.grey[at] = 0.0;
            }
        }
    }

    /// Writes a PNG of 16 greys.
    pub fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let width = self.side / SAMPLES;
        let pixel = |x: usize, row: usize| -> u8 {
            // Rows go downwards in a file.
            let y = width - 1 - row;
            let samples = (0..SAMPLES * SAMPLES).map(|i| {
                let (x, y) = (x * SAMPLES + i % SAMPLES, y * SAMPLES + i / SAMPLES);
                self.grey[y * self.side + x]
            });
            (samples.sum::<f32>() / (SAMPLES * SAMPLES) as f32 * 15.0).round() as u8
        };
        let pairs = (0..width).flat_map(|row| (0..width / 2).map(move |i| (2 * i, row)));
        let bytes: Vec<u8> = pairs
            .map(|(x, row)| pixel(x, row) << 4 | pixel(x + 1, row))
            .collect();
        let file = std::io::BufWriter::new(std::fs::File::create(path)?);
        let mut encoder = png::Encoder::new(file, width as u32, width as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Four);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&bytes)?;
        Ok(())
    }

    fn put(&mut self, column: usize, row: usize, near: f64, grey: f32) {
        let at = row * self.side + column;
        if near > self.near[at] {
            self.near[at] = near;
            self.grey[at] = grey;
        }
    }

    /// The row or column that holds a position.
    fn cell(&self, x: f64) -> usize {
        let cell = ((x + 0.5) * self.side as f64).floor();
        (cell.max(0.0) as usize).min(self.side - 1)
    }

    /// The middle of a row or column.
    fn position(&self, cell: usize) -> f64 {
        (cell as f64 + 0.5) / self.side as f64 - 0.5
    }
}

/// A normal of a polygon, as long as twice its area (Newell).
fn newell(polygon: &[[f64; 3]]) -> [f64; 3] {
    let sides = || (0..polygon.len()).map(|i| [polygon[i], polygon[(i + 1) % polygon.len()]]);
    [(1, 2), (2, 0), (0, 1)].map(|(u, v)| sides().map(|[p, q]| (p[u] - q[u]) * (p[v] + q[v])).sum())
}
