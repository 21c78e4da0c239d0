//! Families of PLCs whose polygons are flat only to rounding, in particular with many cocircular corners.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tetflip::exchange::{Facet, Plc, Segment};
use tetflip::mesh::VertexId;

/// A random rotation, as the columns of its matrix, and a random translation: rounding spoils every plane.
pub struct Placement {
    axes: [[f64; 3]; 3],
    origin: [f64; 3],
}

impl Placement {
    /// A placement in general position.
    pub fn random(rng: &mut ChaCha8Rng) -> Placement {
        let q: [f64; 4] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-3);
        let [w, x, y, z] = q.map(|c| c / norm);
        let axes = [
            [
                1. - 2. * (y * y + z * z),
                2. * (x * y + z * w),
                2. * (x * z - y * w),
            ],
            [
                2. * (x * y - z * w),
                1. - 2. * (x * x + z * z),
                2. * (y * z + x * w),
            ],
            [
                2. * (x * z + y * w),
                2. * (y * z - x * w),
                1. - 2. * (x * x + y * y),
            ],
        ];
        let origin = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        Placement { axes, origin }
    }

    /// Where a point of the model goes.
    pub fn at(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| {
            self.origin[k] + (0..3).map(|i| p[i] * self.axes[i][k]).sum::<f64>()
        })
    }
}

/// A model under construction.
struct Model {
    rng: ChaCha8Rng,
    place: Placement,
    plc: Plc,
}

impl Model {
    fn new(seed: u64) -> Model {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let place = Placement::random(&mut rng);
        Model {
            rng,
            place,
            plc: Plc::default(),
        }
    }

    fn vertex(&mut self, p: [f64; 3]) -> VertexId {
        let id = VertexId::new(self.plc.vertices.len());
        self.plc.vertices.push(self.place.at(p));
        id
    }

    fn facet(&mut self, corners: Vec<VertexId>) {
        self.facet_with(vec![corners]);
    }

    fn facet_with(&mut self, polygons: Vec<Vec<VertexId>>) {
        self.plc.facets.push(Facet {
            polygons,
            ..Facet::default()
        });
    }

    /// Loose vertices in a box, at least `off` from the plane z = 0.
    fn loose(&mut self, n: usize, [x, y, z]: [f64; 3], off: f64) {
        for _ in 0..n {
            let side = if self.rng.random() { 1.0 } else { -1.0 };
            let p = [
                self.rng.random_range(-x..x),
                self.rng.random_range(-y..y),
                side * self.rng.random_range(off..z),
            ];
            self.vertex(p);
        }
    }

    /// The boxes of a grid with the given coordinates along the axes; `present` chooses among inner squares.
    fn boxes(&mut self, at: [&[f64]; 3], present: f64) {
        let n = at.map(|c| c.len());
        let first = self.plc.vertices.len();
        for &x in at[0] {
            for &y in at[1] {
                for &z in at[2] {
                    self.vertex([x, y, z]);
                }
            }
        }
        let id = |i: [usize; 3]| VertexId::new(first + (i[0] * n[1] + i[1]) * n[2] + i[2]);
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for k in 0..n[axis] {
                for i in 0..n[u] - 1 {
                    for j in 0..n[v] - 1 {
                        let inner = k > 0 && k + 1 < n[axis];
                        if inner && !self.rng.random_bool(present) {
                            continue;
                        }
                        let corner = |di: usize, dj: usize| {
                            let mut index = [0; 3];
                            (index[axis], index[u], index[v]) = (k, i + di, j + dj);
                            id(index)
                        };
                        self.facet(vec![corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]);
                    }
                }
            }
        }
    }

    /// Short segments close to the edges of a box, so that those must be split.
    fn thorns(&mut self, n: usize, size: [f64; 3], inside: bool) {
        for _ in 0..n {
            let axis = self.rng.random_range(0..3);
            let depth = self.rng.random_range(0.01..0.1);
            let mut p: [f64; 3] = std::array::from_fn(|k| {
                let near = if self.rng.random() {
                    depth
                } else {
                    size[k] - depth
                };
                if inside { near } else { size[k] + depth }
            });
            p[axis] = self.rng.random_range(0.2..0.8) * size[axis];
            self.vertex(p);
        }
    }
}

/// A PLC for every seed.
pub type Family = fn(u64) -> Plc;

/// The families, by name.
pub const FAMILIES: [(&str, Family); 12] = [
    ("wheel", wheel),
    ("prism", prism),
    ("box", rotated_box),
    ("bar", bar),
    ("book", book),
    ("boxes", boxes),
    ("sheet", sheet),
    ("window", window),
    ("crossed", crossed),
    ("flange", flange),
    ("boss", boss),
    ("floor", floor),
];

/// A regular polygon, and loose vertices above and below.
pub fn wheel(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let n = m.rng.random_range(4..16);
    let corners = (0..n)
        .map(|i| {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
            m.vertex([angle.cos(), angle.sin(), 0.0])
        })
        .collect();
    m.facet(corners);
    let loose = m.rng.random_range(2..14);
    m.loose(loose, [1.0, 1.0, 0.8], 0.05);
    m.plc
}

/// A prism over a regular polygon, perhaps with vertices inside.
pub fn prism(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let n: usize = m.rng.random_range(3..10);
    let height = m.rng.random_range(0.2..3.0);
    let mut ring = |z: f64| -> Vec<VertexId> {
        let at = |i| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n)
            .map(|i| m.vertex([at(i).cos(), at(i).sin(), z]))
            .collect()
    };
    let (low, high) = (ring(0.0), ring(height));
    for i in 0..n {
        let j = (i + 1) % n;
        m.facet(vec![low[i], low[j], high[j], high[i]]);
    }
    m.facet(low);
    m.facet(high);
    let inside = m.rng.random_range(0..6);
    for _ in 0..inside {
        let p = [
            m.rng.random_range(-0.4..0.4),
            m.rng.random_range(-0.4..0.4),
            m.rng.random_range(0.05..0.95) * height,
        ];
        m.vertex(p);
    }
    m.plc
}

/// A box, with vertices near its edges inside and outside.
pub fn rotated_box(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let size: [f64; 3] = std::array::from_fn(|_| m.rng.random_range(0.3..2.0));
    m.boxes([&[0., size[0]], &[0., size[1]], &[0., size[2]]], 1.0);
    let (inner, outer) = (m.rng.random_range(0..6), m.rng.random_range(0..4));
    m.thorns(inner, size, true);
    m.thorns(outer, size, false);
    m.plc
}

/// Long bars side by side.
pub fn bar(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let length = m.rng.random_range(3.0..12.0);
    let (a, b) = (m.rng.random_range(0.2..0.8), m.rng.random_range(0.1..0.9));
    m.boxes([&[0., length], &[0., a, 1.], &[0., b, 1.]], 0.7);
    let n = m.rng.random_range(0..5);
    m.thorns(n, [length, 1., 1.], true);
    m.plc
}

/// Rectangles with a common edge at small angles.
pub fn book(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let (a, b) = (m.vertex([0.; 3]), m.vertex([1., 0., 0.]));
    let pages = m.rng.random_range(2..6);
    let mut angle = 0.0f64;
    for _ in 0..pages {
        angle += m.rng.random_range(0.03..0.6);
        let width = m.rng.random_range(0.5..1.5);
        let (y, z) = (width * angle.cos(), width * angle.sin());
        let (c, d) = (m.vertex([1., y, z]), m.vertex([0., y, z]));
        m.facet(vec![a, b, c, d]);
    }
    let n = m.rng.random_range(1..6);
    for _ in 0..n {
        let p = [
            m.rng.random_range(-0.5..1.5),
            m.rng.random_range(-1.5..-0.2),
            m.rng.random_range(-1.5..1.5),
        ];
        m.vertex(p);
    }
    m.plc
}

/// A grid of boxes with some of the squares inside.
pub fn boxes(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let n: [usize; 3] = std::array::from_fn(|_| m.rng.random_range(1..4));
    let even = m.rng.random::<bool>();
    let at: [Vec<f64>; 3] = n.map(|n| {
        let mut x = 0.0;
        let mut list = vec![0.0];
        for _ in 0..n {
            x += if even {
                1.0
            } else {
                m.rng.random_range(0.3..1.2)
            };
            list.push(x);
        }
        list
    });
    m.boxes([&at[0], &at[1], &at[2]], 0.6);
    m.plc
}

/// A rotated sheet of squares, and vertices above and below.
pub fn sheet(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let n: usize = m.rng.random_range(2..6);
    let id: Vec<VertexId> = (0..=n)
        .flat_map(|i| {
            (0..=n).map(move |j| [i as f64 - n as f64 / 2., j as f64 - n as f64 / 2., 0.])
        })
        .map(|p| m.vertex(p))
        .collect();
    for i in 0..n {
        for j in 0..n {
            let at = |i: usize, j: usize| id[i * (n + 1) + j];
            m.facet(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    let loose = m.rng.random_range(2..20);
    let half = n as f64 / 2.;
    m.loose(loose, [half, half, 1.0], 0.1);
    m.plc
}

/// A wall with a window, vertices and an edge that float in it.
pub fn window(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let mut rectangle = |x: [f64; 2], y: [f64; 2]| -> Vec<VertexId> {
        [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]
            .map(|[x, y]| m.vertex([x, y, 0.]))
            .to_vec()
    };
    let polygons = vec![
        rectangle([-2., 2.], [-1., 1.]),
        rectangle([-1.5, -0.5], [-0.5, 0.5]),
    ];
    let hole = m.place.at([-1., 0., 0.]);
    let slit = vec![m.vertex([0.25, -0.5, 0.]), m.vertex([0.25, 0.5, 0.])];
    let floating: Vec<Vec<VertexId>> = [[1., 0.], [1.5, 0.], [1., 0.5], [1.5, 0.5]]
        .map(|[x, y]| vec![m.vertex([x, y, 0.])])
        .to_vec();
    let polygons = [polygons, vec![slit], floating].concat();
    let holes = if m.rng.random() {
        vec![hole]
    } else {
        Vec::new()
    };
    m.plc.facets.push(Facet {
        polygons,
        holes,
        ..Facet::default()
    });
    let loose = m.rng.random_range(2..14);
    m.loose(loose, [2., 1., 0.8], 0.05);
    m.plc
}

/// Two walls that cross in a common segment, with long loose segments close to them.
pub fn crossed(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let angle: f64 = m.rng.random_range(0.05..1.5);
    let axis = [m.vertex([0., 0., -1.]), m.vertex([0., 0., 1.])];
    for angle in [
        0.0,
        angle,
        std::f64::consts::PI,
        angle + std::f64::consts::PI,
    ] {
        let r = m.rng.random_range(0.5..3.0);
        let (x, y) = (r * f64::cos(angle), r * f64::sin(angle));
        let far = [m.vertex([x, y, 1.]), m.vertex([x, y, -1.])];
        m.facet(vec![axis[0], axis[1], far[0], far[1]]);
    }
    let n = m.rng.random_range(1..4);
    for i in 0..n {
        let z = [-1.5, 1.5, 1.9][i];
        let ends = [m.vertex([-2., -0.3, z]), m.vertex([2., 0.4, z + 0.1])];
        m.plc.segments.push(Segment { ends, marker: 0 });
    }
    m.plc
}

/// Corners of a regular polygon around a point.
fn ring(m: &mut Model, n: usize, [x, y, z]: [f64; 3], radius: f64, turn: f64) -> Vec<VertexId> {
    let at = |i: usize| turn + std::f64::consts::TAU * i as f64 / n as f64;
    (0..n)
        .map(|i| m.vertex([x + radius * at(i).cos(), y + radius * at(i).sin(), z]))
        .collect()
}

/// The quadrilaterals between two cycles of as many vertices.
fn walls(m: &mut Model, low: &[VertexId], high: &[VertexId]) {
    for i in 0..low.len() {
        let j = (i + 1) % low.len();
        m.facet(vec![low[i], low[j], high[j], high[i]]);
    }
}

/// A turned part: discs of several radii and heights upon each other, thin ones among them, with regular polygons for
/// circles. Where two meet there is a ring, which is not on the convex hull.
pub fn flange(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let n: usize = m.rng.random_range(5..25);
    let discs: usize = m.rng.random_range(2..6);
    let (mut below, mut z): (Option<(Vec<VertexId>, bool)>, f64) = (None, 0.0);
    for i in 0..discs {
        let is_wide = i % 2 == 1;
        let radius = if is_wide {
            m.rng.random_range(1.0..2.0)
        } else {
            m.rng.random_range(0.3..0.8)
        };
        let (height, turn) = (
            m.rng.random_range(0.03..0.6),
            m.rng.random_range(0.0..std::f64::consts::TAU),
        );
        let low = ring(&mut m, n, [0., 0., z], radius, turn);
        let center = m.place.at([0., 0., z]);
        z += height;
        let high = ring(&mut m, n, [0., 0., z], radius, turn);
        walls(&mut m, &low, &high);
        match below {
            None => m.facet(low),
            Some((below, _)) => {
                let polygons = if is_wide {
                    vec![low, below]
                } else {
                    vec![below, low]
                };
                m.plc.facets.push(Facet {
                    polygons,
                    holes: vec![center],
                    ..Facet::default()
                });
            }
        }
        below = Some((high, is_wide));
    }
    m.facet(below.expect("there are discs").0);
    m.plc
}

/// A plate with bosses on both faces, not one above the other.
pub fn boss(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let n: usize = m.rng.random_range(3..12);
    let thickness = m.rng.random_range(0.1..1.0);
    let mut square = |z: f64| {
        let corners = [[-3., -3.], [3., -3.], [3., 3.], [-3., 3.]];
        corners.map(|[x, y]| m.vertex([x, y, z])).to_vec()
    };
    let (low, high) = (square(0.0), square(thickness));
    walls(&mut m, &low, &high);
    for (outline, z, up) in [(low, 0.0, -1.0), (high, thickness, 1.0)] {
        let (mut polygons, mut holes) = (vec![outline], Vec::new());
        for [x, y] in [[-1.5, -1.5], [1.5, -1.5], [1.5, 1.5], [-1.5, 1.5]] {
            let (radius, turn) = (m.rng.random_range(0.3..1.3), m.rng.random_range(0.0..6.0));
            let top = z + up * m.rng.random_range(0.1..1.5);
            let foot = ring(&mut m, n, [x, y, z], radius, turn);
            let head = ring(&mut m, n, [x, y, top], radius, turn);
            walls(&mut m, &foot, &head);
            m.facet(head);
            polygons.push(foot);
            holes.push(m.place.at([x, y, z]));
        }
        m.plc.facets.push(Facet {
            polygons,
            holes,
            ..Facet::default()
        });
    }
    m.plc
}

/// A floor with many vertices inside, on a lattice, on a circle or anywhere, and others on both sides of it.
pub fn floor(seed: u64) -> Plc {
    let mut m = Model::new(seed);
    let corners = [[-3., -3.], [3., -3.], [3., 3.], [-3., 3.]];
    let outline = corners.map(|[x, y]| m.vertex([x, y, 0.])).to_vec();
    let mut polygons = vec![outline];
    match seed % 3 {
        0 => {
            for i in 0..16u8 {
                let [x, y] = [i % 4, i / 4].map(|k| f64::from(k) - 1.5);
                polygons.push(vec![m.vertex([x, y, 0.])]);
            }
        }
        1 => {
            let circle = ring(&mut m, 12, [0.; 3], 2.0, 0.3);
            polygons.extend(circle.into_iter().map(|v| vec![v]));
        }
        _ => {
            for _ in 0..14 {
                let [x, y] = [(); 2].map(|()| m.rng.random_range(-2.5..2.5));
                polygons.push(vec![m.vertex([x, y, 0.])]);
            }
        }
    }
    m.facet_with(polygons);
    m.loose(20, [2.5, 2.5, 2.0], 0.1);
    m.plc
}
