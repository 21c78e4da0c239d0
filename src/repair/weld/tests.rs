//! Welds close what is closed to rounding, and tear, drift and vanish nothing.

use super::surface::sides;
use super::*;
use crate::exchange::Facet;
use proptest::prelude::*;
use std::f64::consts::TAU;

fn facets(polygons: impl IntoIterator<Item = Vec<u32>>) -> Vec<Facet> {
    let facet = |corners: Vec<u32>| Facet {
        polygons: vec![corners.into_iter().map(VertexId).collect()],
        ..Facet::default()
    };
    polygons.into_iter().map(facet).collect()
}

/// A sphere or a torus as a grid that is closed to rounding only: its last column is the first one again, and, of a
/// sphere, each row at a pole is one point.
fn grid(rows: u32, columns: u32, point: impl Fn(f64, f64) -> [f64; 3]) -> Plc {
    let all = (0..=rows).flat_map(|i| (0..=columns).map(move |j| (i, j)));
    let vertices = all.map(|(i, j)| {
        point(
            f64::from(i) / f64::from(rows),
            f64::from(j) / f64::from(columns),
        )
    });
    let quads = (0..rows).flat_map(|i| (0..columns).map(move |j| i * (columns + 1) + j));
    let halves = |v: u32| {
        let w = v + columns + 1;
        [vec![v, w, w + 1], vec![v, w + 1, v + 1]]
    };
    Plc {
        vertices: vertices.collect(),
        facets: facets(quads.flat_map(halves)),
        ..Plc::default()
    }
}

fn sphere(rows: u32, columns: u32) -> Plc {
    grid(rows, columns, |s, t| {
        let (r, z) = (TAU * s / 2.0).sin_cos();
        let (y, x) = (TAU * t).sin_cos();
        [r * x, r * y, z]
    })
}

/// Vertices, edges and triangles of what is left, and open edges.
fn euler(plc: &Plc) -> (i64, usize) {
    let surface = Surface::new(plc);
    let mut corners: Vec<VertexId> = surface.polygons.concat();
    corners.sort_unstable();
    corners.dedup();
    let edges: FxHashSet<[VertexId; 2]> = surface.polygons.iter().flat_map(|p| sides(p)).collect();
    let open = surface.edges.values().filter(|n| **n == 1).count();
    (
        corners.len() as i64 - edges.len() as i64 + surface.polygons.len() as i64,
        open,
    )
}

const DELTA: f64 = 1e-12;

#[test]
fn spheres_and_tori_are_closed() {
    let plc = sphere(7, 12);
    let welding = Welding::of(&plc, DELTA);
    assert!(welding.left.is_empty());
    assert_eq!(euler(welding.plc.as_ref().unwrap()), (2, 0));
    let torus = grid(9, 12, |s, t| {
        let ((b, a), (y, x)) = ((TAU * s).sin_cos(), (TAU * t).sin_cos());
        [(3.0 + a) * x, (3.0 + a) * y, b]
    });
    assert!(euler(&torus).1 > 0);
    let welding = Welding::of(&torus, DELTA);
    assert_eq!(euler(welding.plc.as_ref().unwrap()), (0, 0));
    assert_eq!(welding.notes(&torus, DELTA).len(), 1);
}

#[test]
fn a_gap_that_is_meant_stays() {
    // The last column is a thousandth before the first one.
    let plc = grid(7, 12, |s, t| {
        let (y, x) = (TAU * 0.999 * t).sin_cos();
        [x, y, s]
    });
    let welding = Welding::of(&plc, DELTA);
    assert!(welding.plc.is_none() && welding.left.is_empty());
}

#[test]
fn rows_of_vertices_do_not_collapse() {
    // A strip whose open edge has a vertex every δ: links are short, but the row is long.
    let n = 40;
    let vertices = (0..n)
        .flat_map(|i| [[f64::from(i), 0.0, 0.0], [f64::from(i), 100.0, 0.0]])
        .collect();
    let quads = (0..n - 1).map(|i| vec![2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]);
    let plc = Plc {
        vertices,
        facets: facets(quads),
        ..Plc::default()
    };
    let welding = Welding::of(&plc, 1.0);
    assert!(welding.plc.is_none());
    assert!(welding.left.iter().all(|(_, why)| *why == Refusal::Large));
    assert_eq!(welding.left.len(), 2);
}

/// A tetrahedron of a size at a place.
fn tetrahedron(plc: &mut Plc, at: [f64; 3], size: f64) {
    let first = plc.vertices.len() as u32;
    for corner in [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        plc.vertices
            .push([0, 1, 2].map(|k| at[k] + size * corner[k]));
    }
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    plc.facets
        .extend(facets(faces.map(|f| f.map(|v| first + v).to_vec())));
}

#[test]
fn small_solids_do_not_vanish_and_near_ones_do_not_touch() {
    let mut plc = Plc::default();
    tetrahedron(&mut plc, [0.0; 3], 1.0);
    tetrahedron(&mut plc, [5.0, 0.0, 0.0], 1e-13);
    let welding = Welding::of(&plc, DELTA);
    assert!(welding.plc.is_none());
    assert_eq!(welding.left[0].1, Refusal::Topology);
    // Corner to corner: closed surfaces have nothing to weld.
    let mut plc = Plc::default();
    tetrahedron(&mut plc, [0.0; 3], 1.0);
    tetrahedron(&mut plc, [-DELTA, 0.0, 0.0], -1.0);
    let welding = Welding::of(&plc, DELTA);
    assert!(welding.plc.is_none() && welding.left.is_empty());
    // Open ones, corner to corner: they would touch.
    plc.facets.remove(4);
    plc.facets.remove(0);
    let welding = Welding::of(&plc, DELTA);
    assert!(welding.plc.is_none());
    assert_eq!(welding.left[0].1, Refusal::Topology);
}

#[test]
fn sheets_do_not_fall_into_one() {
    // Two squares, one above the other, at a distance below the precision: welded, they would be the same.
    let square = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
    let plc = Plc {
        vertices: [square(0.0), square(DELTA)].concat(),
        facets: facets([vec![0, 1, 2, 3], vec![4, 5, 6, 7]]),
        ..Plc::default()
    };
    let welding = Welding::of(&plc, DELTA);
    assert!(welding.plc.is_none());
    assert_eq!(welding.left.len(), 4);
}

proptest! {
    /// Whatever noise is below the precision, a cut sphere closes; whatever is welded is near, and open edges only
    /// become fewer.
    #[test]
    fn noise_is_welded(
        noise in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 8 * 13),
        scale in 0.0..40.0f64,
    ) {
        let mut plc = sphere(7, 12);
        for (p, e) in plc.vertices.iter_mut().zip(&noise) {
            *p = [0, 1, 2].map(|k| p[k] + scale * DELTA * e[k]);
        }
        let (_, open) = euler(&plc);
        let welding = Welding::of(&plc, DELTA);
        for cluster in &welding.welded {
            for v in cluster {
                let d = distance(plc.vertices[v.index()], plc.vertices[cluster[0].index()]);
                prop_assert!(d <= 2.0 * DELTA);
            }
        }
        let after = welding.plc.as_ref().unwrap_or(&plc);
        let (characteristic, left) = euler(after);
        prop_assert!(left <= open);
        // Beyond that, holes may be left where the cut was, so that the characteristic tells nothing.
        if scale < 0.99 {
            prop_assert_eq!((characteristic, left), (2, 0));
        }
    }
}
