//! Shapes as drawing programs make them, turned and rounded as files have them.

use crate::meshes::{facet, plc};
use proptest::prelude::*;
use std::f64::consts::TAU;
use tetflip::exchange::Plc;

/// How coordinates are written.
#[derive(Clone, Copy, Debug)]
pub enum Rounding {
    Float32,
    Digits(usize),
    Decimals(usize),
}

pub fn any_rounding() -> impl Strategy<Value = Rounding> {
    prop_oneof![
        Just(Rounding::Float32),
        Just(Rounding::Digits(6)),
        Just(Rounding::Decimals(3)),
    ]
}

impl Rounding {
    fn of(self, x: f64) -> f64 {
        let text = match self {
            Rounding::Float32 => return f64::from(x as f32),
            Rounding::Digits(n) => format!("{x:.*e}", n - 1),
            Rounding::Decimals(n) => format!("{x:.n$}"),
        };
        text.parse().expect("a number")
    }
}

/// The shape turned and moved at random, and rounded.
pub fn turned(mut shape: Plc, seed: u64, rounding: Rounding) -> Plc {
    // SplitMix64, in (−1, 1).
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let angles = [0; 3].map(|_| random() * TAU);
    let shift = [0; 3].map(|_| random() * 5.0);
    for p in &mut shape.vertices {
        for (k, angle) in angles.iter().enumerate() {
            let (i, j) = (k, (k + 1) % 3);
            let (sin, cos) = angle.sin_cos();
            (p[i], p[j]) = (cos * p[i] - sin * p[j], sin * p[i] + cos * p[j]);
        }
        for k in 0..3 {
            p[k] = rounding.of(p[k] + shift[k]);
        }
    }
    shape
}

/// Two sheets, the points of `ring` at both heights, with triangles of the lower one, and walls around walks.
fn extruded(ring: &[[f64; 2]], height: f64, sheet: &[[u32; 3]], walks: &[Vec<u32>]) -> Plc {
    let n = ring.len() as u32;
    let at = |z: f64| ring.iter().map(move |&[x, y]| [x, y, z]);
    let vertices: Vec<[f64; 3]> = at(0.0).chain(at(height)).collect();
    let mut shape = plc(&vertices, &[]);
    for &[a, b, c] in sheet {
        shape.facets.push(facet(&[a, c, b]));
        shape.facets.push(facet(&[a, b, c].map(|v| v + n)));
    }
    for walk in walks {
        for i in 0..walk.len() {
            let (a, b) = (walk[i], walk[(i + 1) % walk.len()]);
            shape.facets.push(facet(&[a, b, b + n]));
            shape.facets.push(facet(&[a, b + n, a + n]));
        }
    }
    shape
}

fn circle(n: u32, radius: impl Fn(u32) -> f64) -> Vec<[f64; 2]> {
    let point = |i: u32| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
        [radius(i) * cos, radius(i) * sin]
    };
    (0..n).map(point).collect()
}

/// A prism of n sides; its caps are fans.
pub fn prism(n: u32, height: f64) -> Plc {
    let sheet: Vec<[u32; 3]> = (1..n - 1).map(|i| [0, i, i + 1]).collect();
    extruded(&circle(n, |_| 5.0), height, &sheet, &[(0..n).collect()])
}

/// A washer of n sides.
pub fn washer(n: u32, height: f64) -> Plc {
    let mut ring = circle(n, |_| 5.0);
    ring.extend(circle(n, |_| 3.0));
    let quad = |i: u32| {
        let j = (i + 1) % n;
        [[i, j, n + i], [n + i, j, n + j]]
    };
    let sheet: Vec<[u32; 3]> = (0..n).flat_map(quad).collect();
    extruded(
        &ring,
        height,
        &sheet,
        &[(0..n).collect(), (n..2 * n).rev().collect()],
    )
}

/// A wheel of n teeth, with a vertex in the middle of each cap.
pub fn gear(n: u32, height: f64) -> Plc {
    let m = 4 * n;
    let mut ring = circle(m, |i| if i % 4 < 2 { 5.0 } else { 4.2 });
    ring.push([0.0; 2]);
    let sheet: Vec<[u32; 3]> = (0..m).map(|i| [m, i, (i + 1) % m]).collect();
    let walk: Vec<u32> = (0..m).collect();
    // The middle has no wall: the walk has the numbers of the ring alone.
    extruded(&ring, height, &sheet, &[walk])
}

/// A column of n sides, each a quadrilateral, with a polygon at both ends.
pub fn column(n: u32) -> Plc {
    let mut shape = prism(n, 3.0);
    let below: Vec<u32> = (0..n).rev().collect();
    let above: Vec<u32> = (n..2 * n).collect();
    shape.facets = vec![facet(&below), facet(&above)];
    let side = |i: u32| {
        let j = (i + 1) % n;
        facet(&[i, j, n + j, n + i])
    };
    shape.facets.extend((0..n).map(side));
    shape
}
