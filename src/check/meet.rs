//! What two simplices have in common: a point, a piece of a line or a piece of a plane, and where in both it lies.
//!
//! The one is clipped by the planes that bound the other (Sutherland & Hodgman 1974), in homogeneous coordinates over
//! the dyadic numbers: exact, without division. Used only for pairs that are known to touch, so speed matters little.

use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Number, Sign, Vec3};

/// A triangle, an edge or a vertex of a part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Simplex {
    /// The corners; of an edge or a vertex the last is repeated.
    pub corners: [VertexId; 3],
    /// Whether the edges from corner 0, 1 and 2 to the next are declared, not diagonals of a triangulation.
    pub declared: [bool; 3],
}

impl Simplex {
    /// A triangle, an edge or a vertex by its dimension.
    fn dimension(&self) -> usize {
        let [a, b, c] = self.corners;
        usize::from(a != b) + usize::from(b != c)
    }

    /// Whether it is a triangle.
    pub fn is_triangle(&self) -> bool {
        self.dimension() == 2
    }

    /// The edges that are declared, by the position of the first end.
    fn edges(&self) -> impl Iterator<Item = usize> {
        let count = [0, 1, 3][self.dimension()];
        (0..count).filter(|&i| self.declared[i])
    }

    /// The ends of an edge.
    pub fn edge(&self, i: usize) -> [VertexId; 2] {
        let mut ends = [self.corners[i], self.corners[(i + 1) % 3]];
        ends.sort_unstable();
        ends
    }
}

/// Where in a simplex a common piece lies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Place {
    /// It is this vertex.
    Vertex(VertexId),
    /// It is in this declared edge.
    Edge([VertexId; 2]),
    /// It is neither.
    Interior,
}

/// What two simplices have in common.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Meet {
    /// 0 for a point, 1 for a piece of a line, 2 for a piece of a plane.
    pub dimension: usize,
    /// Where that is in the one and in the other.
    pub places: [Place; 2],
    /// A point in the middle of it, computed exactly, each coordinate rounded to a double next to it.
    pub point: [f64; 3],
}

/// A point in homogeneous coordinates x, y, z, w with w > 0.
#[derive(Clone, Debug)]
struct Homogeneous {
    xyz: Vec3<Dyadic>,
    w: Dyadic,
}

impl Homogeneous {
    fn of(point: [f64; 3]) -> Homogeneous {
        Homogeneous {
            xyz: Vec3::from_f64(point),
            w: Dyadic::from_f64(1.0),
        }
    }

    /// k·self + l·other with k·l > 0 or k, l ≥ 0: a point between them.
    fn between(&self, k: &Dyadic, other: &Homogeneous, l: &Dyadic) -> Homogeneous {
        let mix = |x: &Dyadic, y: &Dyadic| x.clone() * k + &(y.clone() * l);
        let [x, y, z] = [0, 1, 2].map(|i| mix(&self.xyz.0[i], &other.xyz.0[i]));
        Homogeneous {
            xyz: Vec3([x, y, z]),
            w: mix(&self.w, &other.w),
        }
    }

    fn equals(&self, other: &Homogeneous) -> bool {
        (0..3).all(|i| self.xyz.0[i].clone() * &other.w == other.xyz.0[i].clone() * &self.w)
    }

    /// The mean of points.
    fn mean(points: &[&Homogeneous]) -> Homogeneous {
        let mut points = points.iter();
        let mut sum = (*points.next().expect("a mean of points")).clone();
        for (n, p) in points.enumerate() {
            // (n + 1 points of mean sum) and p: weights (n + 1)/w of the sum and 1/w of p.
            let count = Dyadic::from_f64((n + 1) as f64);
            let weight = count * &p.w;
            sum = sum.between(&weight, p, &sum.w.clone());
        }
        sum
    }

    fn rounded(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.xyz.0[i].quotient(&self.w))
    }
}

/// A plane by its normal and the value there: normal·p − offset is positive in front of it.
#[derive(Debug)]
struct Plane {
    normal: Vec3<Dyadic>,
    offset: Dyadic,
}

impl Plane {
    fn through(p: &Vec3<Dyadic>, normal: Vec3<Dyadic>) -> Plane {
        Plane {
            offset: normal.dot(p),
            normal,
        }
    }

    fn reversed(&self) -> Plane {
        let [x, y, z] = self.normal.0.clone();
        Plane {
            normal: Vec3([x, y, z].map(Dyadic::negated)),
            offset: self.offset.clone().negated(),
        }
    }

    fn value(&self, p: &Homogeneous) -> Dyadic {
        self.normal.dot(&p.xyz) - &(self.offset.clone() * &p.w)
    }

    fn contains(&self, p: &Homogeneous) -> bool {
        self.value(p).exact_sign().is_zero()
    }
}

/// A simplex as the common part of planes and half-spaces.
struct Bounds {
    /// It lies in all of these planes.
    on: Vec<Plane>,
    /// It lies in front of all of these; that of a triangle's edge i comes at place i.
    front: Vec<Plane>,
}

fn bounds(points: &[[f64; 3]], simplex: &Simplex) -> Bounds {
    let [a, b, c] = simplex
        .corners
        .map(|v| Vec3::<Dyadic>::from_f64(points[v.index()]));
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::<Dyadic>::from_f64);
    match simplex.dimension() {
        2 => {
            let normal = b.sub(&a).cross(&c.sub(&a));
            let side =
                |p: &Vec3<Dyadic>, q: &Vec3<Dyadic>| Plane::through(p, normal.cross(&q.sub(p)));
            Bounds {
                front: vec![side(&a, &b), side(&b, &c), side(&c, &a)],
                on: vec![Plane::through(&a, normal.clone())],
            }
        }
        1 => {
            let along = b.sub(&a);
            let around = axes
                .iter()
                .map(|axis| Plane::through(&a, along.cross(axis)));
            Bounds {
                on: around.collect(),
                front: vec![
                    Plane::through(&a, along.clone()),
                    Plane::through(&b, along).reversed(),
                ],
            }
        }
        _ => Bounds {
            on: axes
                .into_iter()
                .map(|axis| Plane::through(&a, axis))
                .collect(),
            front: Vec::new(),
        },
    }
}

/// The part of a convex polygon, a segment or a point in front of a plane.
fn clip(shape: &[Homogeneous], plane: &Plane) -> Vec<Homogeneous> {
    let values: Vec<Dyadic> = shape.iter().map(|p| plane.value(p)).collect();
    let mut clipped: Vec<Homogeneous> = Vec::new();
    let mut add = |p: Homogeneous| {
        if !clipped.iter().any(|q| q.equals(&p)) {
            clipped.push(p);
        }
    };
    for (i, p) in shape.iter().enumerate() {
        let j = (i + 1) % shape.len();
        let (v, w) = (&values[i], &values[j]);
        if !v.exact_sign().is_negative() {
            add(p.clone());
        }
        if (v.exact_sign() * w.exact_sign()).is_negative() {
            // w·p − v·q has the value 0; the sign makes both weights positive.
            let (k, l) = match v.exact_sign() {
                Sign::Positive => (w.clone().negated(), v.clone()),
                _ => (w.clone(), v.clone().negated()),
            };
            add(p.between(&k, &shape[j], &l));
        }
    }
    clipped
}

/// The dimension of the hull of different points.
fn dimension_of(shape: &[Homogeneous]) -> usize {
    match shape {
        [] | [_] => 0,
        [p, q, rest @ ..] => {
            let towards = |x: &Homogeneous| {
                // x − p, times both weights, which are positive.
                let [a, b, c] =
                    [0, 1, 2].map(|i| x.xyz.0[i].clone() * &p.w - &(p.xyz.0[i].clone() * &x.w));
                Vec3([a, b, c])
            };
            let line = towards(q);
            let off = |x: &Homogeneous| {
                let normal = line.cross(&towards(x));
                normal.0.iter().any(|n| !n.exact_sign().is_zero())
            };
            if rest.iter().any(off) { 2 } else { 1 }
        }
    }
}

/// What two simplices have in common; `None` if nothing. Degenerate triangles are not allowed.
pub(super) fn meet(points: &[[f64; 3]], s: &Simplex, t: &Simplex) -> Option<Meet> {
    let [of_s, of_t] = [s, t].map(|simplex| bounds(points, simplex));
    let mut corners = s.corners.to_vec();
    corners.dedup();
    let mut shape: Vec<Homogeneous> = corners
        .iter()
        .map(|v| Homogeneous::of(points[v.index()]))
        .collect();
    for plane in &of_t.on {
        shape = clip(&clip(&shape, plane), &plane.reversed());
    }
    for plane in &of_t.front {
        shape = clip(&shape, plane);
    }
    if shape.is_empty() {
        return None;
    }
    let dimension = dimension_of(&shape);
    let middle = Homogeneous::mean(&shape.iter().collect::<Vec<_>>());
    Some(Meet {
        dimension,
        places: [
            place(points, s, &of_s, &shape),
            place(points, t, &of_t, &shape),
        ],
        point: middle.rounded(),
    })
}

/// Where in a simplex a common piece lies.
fn place(points: &[[f64; 3]], simplex: &Simplex, bounds: &Bounds, shape: &[Homogeneous]) -> Place {
    if let [point] = shape {
        let is_vertex = |v: &&VertexId| Homogeneous::of(points[v.index()]).equals(point);
        if let Some(&v) = simplex.corners.iter().find(is_vertex) {
            return Place::Vertex(v);
        }
    }
    let along =
        |&i: &usize| simplex.dimension() == 1 || shape.iter().all(|p| bounds.front[i].contains(p));
    let edge = simplex.edges().find(along);
    edge.map_or(Place::Interior, |i| Place::Edge(simplex.edge(i)))
}
