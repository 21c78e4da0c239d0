//! PLCs with small angles: what makes segment recovery insert points without end. Coordinates come from correctly
//! rounded operations only, so that they are the same bits everywhere.

use crate::families::draw::Draw;
use tetflip::exchange::{Facet, Plc, Segment};
use tetflip::mesh::VertexId;

/// All of them, with what tables call them; with `quick`, the small ones.
pub fn models(quick: bool) -> Vec<(String, Plc)> {
    let mut models = Vec::new();
    let mut add = |name: String, plc: Plc| models.push((name, plc));
    let sizes: &[u32] = if quick { &[20] } else { &[20, 100, 400] };
    for &n in sizes {
        for spread in [1e-2, 1e-4, 1e-7] {
            // Longer than anything else by far, and no other question.
            if n < 400 || spread == 1e-2 {
                add(format!("spokes/{n}/{spread:e}"), spokes(n, spread));
            }
        }
        add(format!("fan/{n}"), fan(n));
    }
    for n in if quick { vec![10] } else { vec![10, 30, 60] } {
        add(format!("walls/{n}"), walls(n));
    }
    for thickness in [1e-3, 1e-7, 1e-10] {
        add(format!("wedge/{thickness:e}"), two_sheets(0.0, thickness));
        add(
            format!("slit/{thickness:e}"),
            two_sheets(thickness, thickness),
        );
        add(format!("needles/{thickness:e}"), needles(thickness));
    }
    add("drum/24".to_string(), drum(24));
    models
}

fn segment(a: usize, b: usize) -> Segment {
    Segment {
        ends: [a, b].map(VertexId::new),
        marker: 0,
    }
}

fn facet(corners: &[usize]) -> Facet {
    Facet {
        polygons: vec![corners.iter().map(|&v| VertexId::new(v)).collect()],
        ..Facet::default()
    }
}

/// n segments from the origin, all in nearly one direction, with lengths between 10 and 15.
fn spokes(n: u32, spread: f64) -> Plc {
    let mut draw = Draw::new(1, u64::from(n));
    let mut vertices = vec![[0.0; 3]];
    for _ in 0..n {
        let length = 12.5 + 2.5 * draw.fraction();
        let [y, z] = [draw.fraction(), draw.fraction()];
        vertices.push([length, length * spread * y, length * spread * z]);
    }
    vertices.extend([[1.0, 20.0, 3.0], [-5.0, -20.0, 1.0], [3.0, 1.0, 30.0]]);
    Plc {
        vertices,
        segments: (1..=n as usize).map(|i| segment(0, i)).collect(),
        ..Plc::default()
    }
}

/// n segments of nearly equal length in a plane, at a twentieth of a degree from each other.
fn fan(n: u32) -> Plc {
    let mut vertices = vec![[0.0; 3]];
    // The tangent of half the angle gives points of a circle without a sine.
    for i in 0..n {
        let tangent = f64::from(i) * 0.000_436;
        let scale = 10.0 / (1.0 + tangent * tangent);
        vertices.push([
            scale * (1.0 - tangent * tangent),
            2.0 * scale * tangent,
            0.0,
        ]);
    }
    vertices.extend([[3.0, 2.0, 10.0], [3.0, 2.0, -10.0]]);
    Plc {
        vertices,
        segments: (1..=n as usize).map(|i| segment(0, i)).collect(),
        ..Plc::default()
    }
}

/// n rectangles around an axis, a twentieth of a degree from each other and not equally long.
fn walls(n: u32) -> Plc {
    let mut plc = Plc {
        vertices: vec![[0.0; 3], [0.0, 0.0, 5.0]],
        ..Plc::default()
    };
    for i in 0..n {
        let length = 10.0 + f64::from(i % 7) * 0.3;
        let y = length * f64::from(i) * 0.000_873;
        for z in [0.0, 5.0] {
            plc.vertices.push([length, y, z]);
        }
        let first = 2 + 2 * i as usize;
        plc.facets.push(facet(&[0, first, first + 1, 1]));
    }
    plc
}

/// Two rectangles, so far apart at two opposite ends.
fn two_sheets(near: f64, far: f64) -> Plc {
    let mut vertices = vec![
        [0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 0.0, far],
        [1.0, 1.0, far],
        [0.3, 0.4, 2.0],
        [0.7, 0.2, -2.0],
    ];
    let mut facets = vec![facet(&[0, 2, 3, 1])];
    if near > 0.0 {
        vertices.extend([[0.0, 0.0, near], [0.0, 1.0, near]]);
        facets.push(facet(&[8, 4, 5, 9]));
    } else {
        facets.push(facet(&[0, 4, 5, 1]));
    }
    Plc {
        vertices,
        facets,
        ..Plc::default()
    }
}

/// Triangles with one short side, crossing each other's neighbourhood at many heights.
fn needles(width: f64) -> Plc {
    let mut plc = Plc::default();
    for i in 0..12 {
        let z = f64::from(i) * 0.01;
        let (x, y) = if i % 2 == 0 { (1.0, 0.1) } else { (-0.3, 0.9) };
        let first = plc.vertices.len();
        plc.vertices.extend([
            [-x, -y, z],
            [x, y, z],
            [x - width * y, y + width * x, z + width],
        ]);
        plc.facets.push(facet(&[first, first + 1, first + 2]));
    }
    plc
}

/// A tall drum whose n sides are pairs of triangles that are not quite coplanar, as in models in single precision.
fn drum(n: usize) -> Plc {
    let mut plc = Plc::default();
    for i in 0..n {
        // A rational parametrization of the circle, by the tangent of half the angle.
        let tangent = (2 * i + 1) as f64 / n as f64 - 1.0;
        let scale = 1.0 / (1.0 + tangent * tangent);
        let (x, y) = (scale * (1.0 - tangent * tangent), 2.0 * scale * tangent);
        for z in [0.0, 20.0] {
            plc.vertices.push([
                f64::from(x as f32),
                f64::from(y as f32),
                z + 1e-7 * (i % 3) as f64,
            ]);
        }
    }
    for i in 0..n - 1 {
        let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
        plc.facets.push(facet(&[a, c, d]));
        plc.facets.push(facet(&[a, d, b]));
    }
    plc.vertices.extend([[0.1, 0.2, 5.0], [0.0, 0.1, 16.0]]);
    plc
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::plc::Complex;

    #[test]
    fn models_are_complexes_with_segments() {
        for (name, plc) in models(false) {
            let complex = Complex::new(&plc, true).expect("a PLC");
            assert!(complex.segments.len() >= 7, "{name}");
        }
        assert!(models(true).len() < models(false).len());
    }
}
