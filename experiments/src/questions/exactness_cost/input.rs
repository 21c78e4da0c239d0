//! The inputs: one rectangle, cutting entirely through a set of vertices that is in general position, or that is not at
//! all.
//!
//! All but `slab` have vertices strictly inside the four planes through the edges of the rectangle that are orthogonal
//! to it, so that these edges are on the convex hull and need no Steiner points; vertices on the rectangle are left
//! out. Seeds number the vertices at random, which decides the perturbation, and move lattices by integers.
//!
//! - `slab`: random vertices near the rectangle, the scene of the paper's Fig. 8.
//! - `lattice/…`: the points with even coordinates that are at most 4 away from the rectangle. It lies `between` two
//!   layers (z = 1), in the place of one that is left out (`through`: z = 0), or in the plane x − 2y + 5z = 1
//!   (`tilted`). Each cube of eight points is cospherical, so most flip times are equal.
//! - `tenths/…`: coordinates k/10, rounded to doubles, instead of k. What was equal differs by rounding errors then,
//!   and no small grid holds the coordinates. `between`, `through`, and `diagonal`: in the place of the points with x =
//!   y. (A rectangle with rounded corners in the tilted plane would not be flat.)
//! - `sphere`: integer points p with |p|² = 250 001, and a rectangle through the centre: every insphere determinant is
//!   0.

use crate::families::Draw;
use crate::inputs::slab::Slab;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;

/// One input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    pub kind: Kind,
    /// About how many tetrahedra the rectangle crosses: the size class.
    pub about: u64,
    pub seed: u64,
}

/// The kind of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Slab,
    Lattice(Cut),
    Tenths(Cut),
    Sphere,
}

/// How the rectangle cuts a lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    Between,
    Through,
    Tilted,
    Diagonal,
}

/// All kinds, in the order of tables.
pub const KINDS: [Kind; 8] = [
    Kind::Slab,
    Kind::Lattice(Cut::Between),
    Kind::Lattice(Cut::Through),
    Kind::Lattice(Cut::Tilted),
    Kind::Tenths(Cut::Between),
    Kind::Tenths(Cut::Through),
    Kind::Tenths(Cut::Diagonal),
    Kind::Sphere,
];

type Vector = [i32; 3];

/// The square of the radius of `sphere`; 7632 integer points have it.
const SQUARE: i32 = 250_001;

impl Kind {
    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Slab => "slab",
            Kind::Lattice(Cut::Between) => "lattice/between",
            Kind::Lattice(Cut::Through) => "lattice/through",
            Kind::Lattice(Cut::Tilted) => "lattice/tilted",
            Kind::Lattice(Cut::Diagonal) => "lattice/diagonal",
            Kind::Tenths(Cut::Between) => "tenths/between",
            Kind::Tenths(Cut::Through) => "tenths/through",
            Kind::Tenths(Cut::Tilted) => "tenths/tilted",
            Kind::Tenths(Cut::Diagonal) => "tenths/diagonal",
            Kind::Sphere => "sphere",
        }
    }

    /// Whether it is made of lattice points.
    pub fn is_lattice(self) -> bool {
        matches!(self, Kind::Lattice(_) | Kind::Tenths(_))
    }

    /// Crossing tetrahedra, counted once: for each random vertex, for each unit of the rectangle's area, or for each
    /// integer point.
    fn density(self) -> f64 {
        match self {
            Kind::Slab => 3.3,
            Kind::Lattice(cut) | Kind::Tenths(cut) => match cut {
                Cut::Between | Cut::Through => 1.5,
                Cut::Tilted => 2.1,
                Cut::Diagonal => 1.2,
            },
            Kind::Sphere => 1.4,
        }
    }
}

impl Input {
    /// The PLC, whose only facet is the rectangle.
    pub fn plc(&self) -> Plc {
        let size = self.about as f64 / self.kind.density();
        let mut draw = Draw::new(self.seed, self.about);
        match self.kind {
            Kind::Slab => Slab {
                vertices: size as usize,
                half_height: 0.01,
                seed: self.seed,
            }
            .plc(),
            Kind::Lattice(cut) => lattice(cut, size, &mut draw, f64::from),
            Kind::Tenths(cut) => lattice(cut, size, &mut draw, |k| 0.1 * f64::from(k)),
            Kind::Sphere => sphere(size as usize, &mut draw),
        }
    }

    /// The name of the input.
    pub fn name(&self) -> String {
        format!("{}:{} of about {}", self.kind.name(), self.seed, self.about)
    }
}

fn dot(a: Vector, b: Vector) -> i32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A rectangle of the given area, nearly a square, and the lattice points beside it.
fn lattice(cut: Cut, area: f64, draw: &mut Draw, coordinate: fn(i32) -> f64) -> Plc {
    // Two directions of the rectangle, its centre, and the normal of its plane.
    let (u, v, centre, normal): (Vector, Vector, Vector, Vector) = match cut {
        Cut::Between => ([1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 1]),
        Cut::Through => ([1, 0, 0], [0, 1, 0], [0, 0, 0], [0, 0, 1]),
        Cut::Tilted => ([2, 1, 0], [-1, 2, 1], [1, 0, 0], [1, -2, 5]),
        Cut::Diagonal => ([1, 1, 0], [0, 0, 1], [0, 0, 0], [1, -1, 0]),
    };
    let half_side = |w: Vector| (area.sqrt() / 2.0 / f64::from(dot(w, w)).sqrt()).ceil() as i32;
    let (a, b) = (half_side(u), half_side(v));
    let corner = |(i, j): (i32, i32)| [0, 1, 2].map(|k| centre[k] + i * a * u[k] + j * b * v[k]);
    let corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)].map(corner);
    let is_beside = |p: Vector| {
        let q = [0, 1, 2].map(|k| p[k] - centre[k]);
        let height = dot(q, normal);
        height != 0
            && height * height <= 16 * dot(normal, normal)
            && dot(q, u).abs() < a * dot(u, u)
            && dot(q, v).abs() < b * dot(v, v)
    };
    // Even coordinates, from −r to r.
    let range = |k: usize| {
        let r = (a * u[k].abs() + b * v[k].abs() + 6) / 2;
        (-r..=r).map(|x| 2 * x)
    };
    let points = range(0).flat_map(|x| {
        let planes = range(1).flat_map(move |y| range(2).map(move |z| [x, y, z]));
        planes.filter(|&p| is_beside(p))
    });
    let mut points: Vec<Vector> = points.collect();
    draw.shuffle(&mut points);
    // x − y is kept.
    let (s, t) = (draw.int(-50, 50), draw.int(-50, 50));
    let moved = |p: Vector| [p[0] + s, p[1] + s, p[2] + t].map(coordinate);
    rectangle_and(corners.map(moved), points.into_iter().map(moved))
}

fn sphere(n: usize, draw: &mut Draw) -> Plc {
    let r = SQUARE.isqrt();
    let on_sphere = (-r..=r).flat_map(|x| {
        (-r..=r).flat_map(move |y| {
            let zz = SQUARE - x * x - y * y;
            let z = zz.max(0).isqrt();
            let both = [[x, y, z], [x, y, -z]];
            both.into_iter().filter(move |_| z > 0 && z * z == zz)
        })
    });
    let mut points: Vec<Vector> = on_sphere.collect();
    draw.shuffle(&mut points);
    points.truncate(n);
    let (a, b) = (r + 10, r + 20);
    let corners = [[-a, -b, 0], [a, -b, 0], [a, b, 0], [-a, b, 0]];
    let doubles = |p: Vector| p.map(f64::from);
    rectangle_and(corners.map(doubles), points.into_iter().map(doubles))
}

fn rectangle_and(corners: [[f64; 3]; 4], points: impl Iterator<Item = [f64; 3]>) -> Plc {
    let rectangle = Facet {
        polygons: vec![(0..4).map(VertexId::new).collect()],
        ..Facet::default()
    };
    Plc {
        vertices: corners.into_iter().chain(points).collect(),
        facets: vec![rectangle],
        ..Plc::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::cdt::Cdt;
    use tetflip::recover::polygons::{FlipOrder, Insertion};
    use tetflip::report::Report;

    /// A rectangle cuts about as many tetrahedra as it should, without Steiner points, and is flat.
    #[test]
    fn sizes_are_right_and_rectangles_flat() {
        for kind in KINDS {
            for about in [500, 2000] {
                let input = Input {
                    kind,
                    about,
                    seed: 1,
                };
                let mut report = Report::default();
                let mut cdt = Cdt::with_segments(&input.plc(), true, &mut report).unwrap();
                let filtered = Insertion::Flip(FlipOrder::FILTERED);
                let counts = cdt.insert_polygons(filtered, &mut report, &mut |_| ());
                let counts = counts.unwrap_or_else(|e| panic!("{}: {e}", input.name()));
                assert_eq!(
                    (report.steiner_points, counts.not_flat),
                    (0, 0),
                    "{}",
                    input.name()
                );
                let crossing = counts.crossing_tets;
                assert!(
                    (about * 2 / 3..about * 3 / 2).contains(&crossing),
                    "{}: {crossing}",
                    input.name()
                );
            }
        }
    }

    #[test]
    fn seeds_number_vertices_anew() {
        for kind in KINDS {
            let of_seed = |seed| {
                Input {
                    kind,
                    about: 300,
                    seed,
                }
                .plc()
            };
            assert_eq!(of_seed(1), of_seed(1));
            assert_ne!(of_seed(1), of_seed(2));
        }
    }

    #[test]
    fn tenths_are_rounded_and_lattices_are_not() {
        let of_kind = |kind| {
            Input {
                kind,
                about: 300,
                seed: 1,
            }
            .plc()
            .vertices
        };
        let whole = |p: &[f64; 3]| p.iter().all(|x| x.fract() == 0.0);
        assert!(of_kind(Kind::Lattice(Cut::Tilted)).iter().all(whole));
        let tenths = of_kind(Kind::Tenths(Cut::Diagonal));
        // 0.1·3 is not the double nearest to 0.3.
        assert!(
            tenths
                .iter()
                .flatten()
                .any(|x| *x != (x * 10.0).round() / 10.0)
        );
    }
}
