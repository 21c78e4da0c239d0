//! Random input: soups of facets, rectangles of a lattice, triangulations that were stretched, surfaces with spikes.

use super::*;

/// Lattice coordinates to doubles of every size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    exponents: [i32; 3],
    jitter: u64,
}

impl Scale {
    /// Only the same for all axes or powers of two per axis: keeps what is coplanar coplanar, unless it is jittered.
    pub(super) fn apply(&self, n: usize, p: [i32; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| {
            // In two steps, as 2^-1074 is no normal number.
            let e = self.exponents[i];
            let mut x = f64::from(p[i]) * 2f64.powi(e / 2) * 2f64.powi(e - e / 2);
            let bits = self.jitter >> ((3 * n + i) % 32 * 2) & 3;
            if bits == 1 {
                x = x.next_up();
            } else if bits == 2 {
                x = x.next_down();
            }
            x
        })
    }
}

pub(super) fn scale() -> impl Strategy<Value = Scale> {
    let exponent = || {
        prop_oneof![
            Just(0),
            Just(900),
            Just(-900),
            Just(-1074),
            Just(1020),
            Just(-30),
            Just(3)
        ]
    };
    let exponents = prop_oneof![
        3 => Just([0; 3]),
        2 => exponent().prop_map(|e| [e; 3]),
        1 => [exponent(), exponent(), exponent()],
    ];
    let jitter = prop_oneof![2 => Just(0), 1 => any::<u64>(), 1 => any::<u64>().prop_map(|x| x & x >> 7 & x << 3)];
    (exponents, jitter).prop_map(|(exponents, jitter)| Scale { exponents, jitter })
}

pub(super) fn lattice_point(n: i32) -> [std::ops::Range<i32>; 3] {
    [0..n, 0..n, 0..n]
}

/// Vertices picked by arbitrary numbers; repetitions, which no facet may have, only now and then.
pub(super) fn pick(v: &[usize], n: usize) -> Vec<VertexId> {
    let mut picked: Vec<VertexId> = Vec::new();
    for &i in v {
        let v = VertexId::new(i % n);
        if i == 63 || !picked.contains(&v) {
            picked.push(v);
        }
    }
    picked
}

/// Anything: triangles, quadrilaterals and worse on lattice points, segments, holes, regions.
pub(super) fn soup() -> impl Strategy<Value = Plc> {
    let points = (2i32..6).prop_flat_map(|n| prop::collection::vec(lattice_point(n), 4..14));
    let polygon = prop_oneof![
        6 => prop::collection::vec(0usize..64, 3..4),
        3 => prop::collection::vec(0usize..64, 4..5),
        1 => prop::collection::vec(0usize..64, 1..7),
    ];
    let polygons = prop_oneof![
        6 => prop::collection::vec(polygon.clone(), 1..2),
        1 => prop::collection::vec(polygon, 1..4),
    ];
    let halves = || [-1i32..12, -1..12, -1..12];
    let facets = prop::collection::vec(
        (polygons, prop::collection::vec(halves(), 0..2), 0i64..3),
        0..7,
    );
    let segments = prop::collection::vec([0usize..64, 0..64], 0..4);
    let marks = prop::collection::vec(halves(), 0..2);
    (points, facets, segments, marks.clone(), marks, scale()).prop_map(
        |(points, facets, segments, holes, regions, scale)| {
            let n = points.len();
            let half = |p: &[i32; 3]| scale.apply(1, *p).map(|x| x * 0.5);
            Plc {
                vertices: points
                    .iter()
                    .enumerate()
                    .map(|(i, &p)| scale.apply(i, p))
                    .collect(),
                facets: facets
                    .iter()
                    .map(|(polygons, holes, marker)| Facet {
                        polygons: polygons.iter().map(|p| pick(p, n)).collect(),
                        holes: if holes.len() == 1 {
                            holes.iter().map(half).collect()
                        } else {
                            vec![]
                        },
                        marker: *marker,
                    })
                    .collect(),
                segments: segments
                    .iter()
                    .filter(|&&[a, b]| a % n != b % n || a == 63)
                    .map(|&[a, b]| Segment {
                        ends: [VertexId::new(a % n), VertexId::new(b % n)],
                        marker: 1,
                    })
                    .collect(),
                holes: holes.iter().map(half).collect(),
                regions: regions
                    .iter()
                    .map(|p| Region {
                        point: half(p),
                        attribute: 7.0,
                        max_volume: None,
                    })
                    .collect(),
                ..Plc::default()
            }
        },
    )
}

/// Rectangles and triangles in planes that are nearly all parallel to two axes or tilted by 45 degrees, with corners on
/// a lattice: they touch, overlap and cross, and many are accepted.
pub(super) fn rectangles() -> impl Strategy<Value = Plc> {
    let rectangle = (
        lattice_point(5),
        0usize..3,
        1i32..4,
        1i32..4,
        0i32..6,
        0u8..4,
    );
    let facets = prop::collection::vec(rectangle, 1..6);
    let loose = prop::collection::vec(lattice_point(8), 4..12);
    (facets, loose, scale()).prop_map(|(facets, loose, scale)| {
        // Without jitter: see `edges_an_ulp_apart_end`.
        let scale = Scale { jitter: 0, ..scale };
        let mut plc = Plc::default();
        let add = |plc: &mut Plc, p: [i32; 3]| {
            plc.vertices.push(scale.apply(plc.vertices.len(), p));
            VertexId::new(plc.vertices.len() - 1)
        };
        for (at, axis, width, height, tilt, corners) in facets {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corner = |i: i32, j: i32| {
                let mut p = at;
                p[u] += i * width;
                p[v] += j * height;
                // Tilted around u, if at all.
                p[axis] += i32::from(tilt == 0) * j * height;
                p
            };
            let square = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            let n = if corners == 0 { 3 } else { 4 };
            let polygon: Vec<VertexId> = square[..n].iter().map(|&p| add(&mut plc, p)).collect();
            plc.facets.push(Facet {
                polygons: vec![polygon],
                marker: i64::from(corners == 2),
                ..Facet::default()
            });
        }
        for p in loose {
            add(&mut plc, p);
        }
        plc
    })
}

/// Valid: triangles and edges of a tetrahedralization of integer points that is Delaunay only after a stretch.
pub(super) fn stretched() -> impl Strategy<Value = Plc> {
    let points = (3i32..12).prop_flat_map(|n| prop::collection::btree_set(lattice_point(n), 5..30));
    let stretch = [1i32..20, 1..20, 1..20];
    let chosen = prop::collection::vec(0u8..4, 97);
    let edges = prop::collection::vec(0u8..8, 41);
    (points, stretch, chosen, edges, 0u8..4, -2i32..3).prop_map(
        |(points, stretch, chosen, edges, rare, e)| {
            let points: Vec<[i32; 3]> = points.into_iter().collect();
            let stretched = points
                .iter()
                .map(|p| [0, 1, 2].map(|i| f64::from(p[i] * stretch[i])));
            let store = DoublePoints::new(stretched.collect());
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let size = 2f64.powi(300 * e);
            let mut plc = plc_of_points(
                points
                    .iter()
                    .map(|p| p.map(|x| f64::from(x) * size))
                    .collect(),
            );
            let Ok(d) = delaunay(&store, &all) else {
                return plc;
            };
            let mut k = 0;
            for t in d.mesh.finite() {
                for slot in 0..4 {
                    let c = t.corner(slot);
                    if c > d.mesh.twin(c) {
                        continue;
                    }
                    k += 1;
                    if chosen[k % 97] <= rare {
                        continue;
                    }
                    let f = d.mesh.facet(c);
                    plc.facets.push(Facet {
                        polygons: vec![f.to_vec()],
                        marker: (k % 2) as i64,
                        ..Facet::default()
                    });
                    if edges[k % 41] == 0 {
                        plc.segments.push(Segment {
                            ends: [f[0], f[1]],
                            marker: 3,
                        });
                    }
                }
            }
            plc
        },
    )
}

/// Valid: a surface around the origin, star-shaped, with spikes: the hull of integer points, each then pulled out by an
/// integer factor. Its radial projection stays a triangulated sphere.
pub(super) fn spiky() -> impl Strategy<Value = Plc> {
    let points = prop::collection::btree_set([-4i32..5, -4..5, -4..5], 5..24);
    (
        points,
        prop::collection::vec(prop_oneof![3 => 1i32..4, 1 => 4..60], 24),
        0u8..3,
    )
        .prop_map(|(points, factor, loose)| {
            let points: Vec<[i32; 3]> = points.into_iter().filter(|p| *p != [0; 3]).collect();
            let store = DoublePoints::new(points.iter().map(|p| p.map(f64::from)).collect());
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let mut plc = Plc::default();
            let Ok(d) = delaunay(&store, &all) else {
                return plc;
            };
            let mut number = vec![None; points.len()];
            for t in d.mesh.all() {
                let Some(slot) = d.mesh.slot_of(t, VertexId::INFINITE) else {
                    continue;
                };
                let f = d.mesh.facet(t.corner(slot));
                let [a, b, c] = f.map(|v| points[v.index()].map(i64::from));
                let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
                let inner = d.mesh.vertex(d.mesh.twin(t.corner(slot)));
                let q = points[inner.index()].map(i64::from);
                // The origin must be strictly on the inner side of every facet.
                let side = |p: [i64; 3]| {
                    let [u, v, w] = [a, b, c].map(|x| [x[0] - p[0], x[1] - p[1], x[2] - p[2]]);
                    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                        + u[2] * (v[0] * w[1] - v[1] * w[0])
                };
                if det == 0 || (side(q) > 0) != (det > 0) {
                    return Plc::default();
                }
                let polygon = f.map(|v| {
                    *number[v.index()].get_or_insert_with(|| {
                        let r = factor[v.index()];
                        plc.vertices
                            .push(points[v.index()].map(|x| f64::from(x * r)));
                        VertexId::new(plc.vertices.len() - 1)
                    })
                });
                plc.facets.push(Facet {
                    polygons: vec![polygon.to_vec()],
                    ..Facet::default()
                });
            }
            for k in 0..loose {
                plc.vertices.push([f64::from(k) / 1024.0, 0.0, 0.0]);
            }
            plc
        })
}
