//! Small polyhedra beside a polygon, drawn as SVG.
//!
//! What matters is on which side of the polygon something is, and many polyhedra are thousands of times as wide as they
//! are high. So the picture is affine: the height above the polygon's plane is stretched until it can be seen. Straight
//! stays straight, convex stays convex, and sides stay sides.

use std::collections::BTreeMap;
use std::fmt::Write;
use tetflip::mesh::VertexId;
use tetflip::number::Sign;
use tetflip::predicate::PointStore;

/// On which side of a polygon, of which three vertices are given, a vertex is: 1 left, 0 on its plane, −1 right.
pub fn side<P: PointStore>(points: &P, [a, b, c]: [VertexId; 3], v: u32) -> i8 {
    match points.orient3d([a, b, c, VertexId(v)]) {
        Sign::Positive => 1,
        Sign::Negative => -1,
        Sign::Zero => 0,
    }
}

/// A colour, as SVG has it.
pub type Color = &'static str;

/// Above the plane of the polygon.
pub const LEFT: Color = "#0072b2";
/// Below it.
pub const RIGHT: Color = "#d55e00";
/// On it.
pub const ON: Color = "#222222";
/// The polygon itself.
pub const POLYGON: Color = "#f0e442";
/// What crosses it.
pub const CROSSING: Color = "#cc3377";

/// A point of the picture: (along the plane, along the plane, height), about in [−1, 1]³.
pub type Spot = [f64; 3];

/// Maps points of space to the picture.
#[derive(Clone, Debug)]
pub struct Stage {
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn scaled(a: [f64; 3], s: f64) -> [f64; 3] {
    a.map(|x| x * s)
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    scaled(a, if length > 0.0 { 1.0 / length } else { 0.0 })
}

/// How high the picture is, relative to its width.
const HEIGHT: f64 = 0.65;

impl Stage {
    /// A stage for these points, above the plane of three of them.
    pub fn new(frame: [[f64; 3]; 3], points: &[[f64; 3]]) -> Stage {
        let origin = frame[0];
        let u = unit(sub(frame[1], origin));
        // Heights are positive where orient3d(frame, ·) is.
        let n = unit(cross(sub(frame[1], origin), sub(frame[2], origin)));
        let v = cross(u, n);
        let mut stage = Stage {
            origin,
            axes: [u, v, n],
        };
        let spots: Vec<Spot> = points.iter().map(|&p| stage.spot(p)).collect();
        let half = |axis: usize| {
            let low = spots.iter().map(|s| s[axis]).fold(f64::INFINITY, f64::min);
            let high = spots
                .iter()
                .map(|s| s[axis])
                .fold(f64::NEG_INFINITY, f64::max);
            (high - low, (high + low) / 2.0)
        };
        let stretch = |extent: f64, wanted: f64| if extent > 0.0 { wanted / extent } else { 1.0 };
        let ((du, cu), (dv, cv), (dn, _)) = (half(0), half(1), half(2));
        let center = [0, 1, 2].map(|i| cu * u[i] + cv * v[i]);
        stage.origin = [0, 1, 2].map(|i| origin[i] + center[i]);
        // Wide regions keep their proportions along the plane, unless they are needles.
        let wide = du.max(dv);
        stage.axes = [
            scaled(
                u,
                stretch(du.max(wide / 3.0), 2.0 * du.max(wide / 3.0) / wide),
            ),
            scaled(v, stretch(dv, 2.0 * dv.max(wide / 3.0) / wide)),
            scaled(n, stretch(dn, 2.0 * HEIGHT)),
        ];
        stage
    }

    /// Where a point is in the picture.
    pub fn spot(&self, p: [f64; 3]) -> Spot {
        let d = sub(p, self.origin);
        self.axes.map(|axis| dot(d, axis))
    }
}

/// A picture. What is added first is not necessarily behind: the depth decides. It is seen from where vertices are
/// farthest apart, and as large as the page allows.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    items: Vec<Item>,
}

#[derive(Clone, Debug)]
struct Item {
    spots: Vec<Spot>,
    /// How much nearer it counts than it is.
    nearer: f64,
    shape: Shape,
}

#[derive(Clone, Debug)]
enum Shape {
    Face(Color, f64),
    Edge(Color, f64),
    Vertex(Color, String),
}

const SIZE: f64 = 420.0;

/// Room around the picture, and for the caption.
const MARGIN: f64 = 24.0;
const CAPTION: f64 = 56.0;

/// From where a picture is seen.
#[derive(Clone, Copy, Debug)]
struct View {
    turn: f64,
    tilt: f64,
}

impl View {
    /// To the right, up, and away.
    fn project(self, s: Spot) -> [f64; 3] {
        let (turn, tilt) = (self.turn, self.tilt);
        let x = turn.cos() * s[0] - turn.sin() * s[1];
        let y = turn.sin() * s[0] + turn.cos() * s[1];
        let up = tilt.sin() * y + tilt.cos() * s[2];
        [x, up, tilt.cos() * y - tilt.sin() * s[2]]
    }
}

impl Picture {
    /// A translucent convex polygon.
    pub fn face(&mut self, corners: &[Spot], color: Color, opacity: f64) {
        self.items.push(Item {
            spots: corners.to_vec(),
            nearer: 0.0,
            shape: Shape::Face(color, opacity),
        });
    }

    /// A line, a little in front of the faces that it bounds.
    pub fn edge(&mut self, ends: [Spot; 2], color: Color, width: f64) {
        self.items.push(Item {
            spots: ends.to_vec(),
            nearer: 0.02,
            shape: Shape::Edge(color, width),
        });
    }

    /// A vertex with its name, in front of everything; without a name, a small dot.
    pub fn vertex(&mut self, at: Spot, color: Color, name: &str) {
        self.items.push(Item {
            spots: vec![at],
            nearer: 10.0,
            shape: Shape::Vertex(color, name.to_string()),
        });
    }

    /// The tetrahedra of a region: their triangles, the boundary stronger than the inside; edges that cross the plane
    /// in a colour of their own; vertices by side. `side` is 1 above the plane, −1 below, 0 on it.
    pub fn tetrahedra(
        &mut self,
        tets: &[[u32; 4]],
        spot: impl Fn(u32) -> Spot,
        side: impl Fn(u32) -> i8,
        with_names: bool,
    ) {
        let mut triangles: BTreeMap<[u32; 3], u32> = BTreeMap::new();
        let mut edges: BTreeMap<[u32; 2], ()> = BTreeMap::new();
        let mut vertices: BTreeMap<u32, ()> = BTreeMap::new();
        for tet in tets {
            let mut t = *tet;
            t.sort_unstable();
            for skip in 0..4 {
                let mut rest = (0..4).filter(|&i| i != skip).map(|i| t[i]);
                let triangle = std::array::from_fn(|_| rest.next().expect("three of four"));
                *triangles.entry(triangle).or_default() += 1;
                vertices.insert(t[skip], ());
                for j in skip + 1..4 {
                    edges.insert([t[skip], t[j]], ());
                }
            }
        }
        let color = |s: i8| match s {
            1 => LEFT,
            -1 => RIGHT,
            _ => ON,
        };
        for (triangle, _) in triangles.iter().filter(|&(_, &n)| n == 1) {
            let sum: i32 = triangle.iter().map(|&v| i32::from(side(v))).sum();
            self.face(&triangle.map(&spot), color(sum.signum() as i8), 0.16);
        }
        for ends in edges.keys() {
            let crosses = i32::from(side(ends[0])) * i32::from(side(ends[1])) < 0;
            let (edge_color, width) = if crosses {
                (CROSSING, 1.6)
            } else {
                ("#555555", 0.9)
            };
            self.edge(ends.map(&spot), edge_color, width);
        }
        for &v in vertices.keys() {
            let name = if with_names {
                v.to_string()
            } else {
                String::new()
            };
            self.vertex(spot(v), color(side(v)), &name);
        }
    }

    /// The view in which the two nearest vertices with names are farthest apart; of pictures without names, a usual
    /// one.
    fn view(&self) -> View {
        let usual = View {
            turn: 0.45,
            tilt: 0.38,
        };
        let named =
            |item: &&Item| matches!(&item.shape, Shape::Vertex(_, name) if !name.is_empty());
        let spots: Vec<Spot> = self
            .items
            .iter()
            .filter(named)
            .map(|i| i.spots[0])
            .collect();
        let nearest = |view: &View| {
            let seen: Vec<[f64; 3]> = spots.iter().map(|&s| view.project(s)).collect();
            let pairs = seen
                .iter()
                .enumerate()
                .flat_map(|(i, a)| seen[..i].iter().map(move |b| (a, b)));
            pairs
                .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
                .fold(f64::INFINITY, f64::min)
        };
        let turns = (0..36).map(|i| f64::from(i) * std::f64::consts::PI / 18.0);
        let views = turns.flat_map(|turn| [0.3, 0.45, 0.6].map(|tilt| View { turn, tilt }));
        let best = views.max_by(|a, b| nearest(a).total_cmp(&nearest(b)));
        best.filter(|_| spots.len() > 1).unwrap_or(usual)
    }

    /// The picture as the text of an SVG file, with some lines below it.
    pub fn svg(&self, title: &str, caption: &str) -> String {
        let view = self.view();
        let seen: Vec<Vec<[f64; 3]>> = self
            .items
            .iter()
            .map(|item| item.spots.iter().map(|&s| view.project(s)).collect())
            .collect();
        let bounds = |axis: usize| {
            let all = || seen.iter().flatten().map(|p| p[axis]);
            (
                all().fold(f64::INFINITY, f64::min),
                all().fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let ((left, right), (low, high)) = (bounds(0), bounds(1));
        let (width, height) = (SIZE - 2.0 * MARGIN, SIZE - 2.0 * MARGIN - CAPTION);
        let scale = (width / (right - left)).min(height / (high - low));
        let page = |p: &[f64; 3]| {
            let x = SIZE / 2.0 + scale * (p[0] - (left + right) / 2.0);
            let y = MARGIN + height / 2.0 - scale * (p[1] - (low + high) / 2.0);
            (x, y)
        };
        let depth = |i: usize| {
            let sum: f64 = seen[i].iter().map(|p| p[2]).sum();
            sum / seen[i].len() as f64 - self.items[i].nearer
        };
        // Far ones first; a stable sort keeps the rest in order.
        let mut order: Vec<usize> = (0..self.items.len()).collect();
        order.sort_by(|&a, &b| depth(b).total_cmp(&depth(a)));
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\" width=\"{SIZE}\" \
             height=\"{SIZE}\" font-family=\"sans-serif\" font-size=\"12\">\n<title>{title}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        );
        for i in order {
            let spots: Vec<(f64, f64)> = seen[i].iter().map(page).collect();
            text += &self.items[i].shape.svg(&spots);
        }
        let lines = caption.lines().count() as f64;
        for (i, line) in caption.lines().enumerate() {
            let y = SIZE - 10.0 - 15.0 * (lines - 1.0 - i as f64);
            let _ = writeln!(text, "<text x=\"10\" y=\"{y}\">{line}</text>");
        }
        text + "</svg>\n"
    }
}

impl Shape {
    fn svg(&self, spots: &[(f64, f64)]) -> String {
        let (x, y) = spots[0];
        match self {
            Shape::Face(color, opacity) => {
                let points: Vec<String> = spots
                    .iter()
                    .map(|(x, y)| format!("{x:.1},{y:.1}"))
                    .collect();
                format!(
                    "<polygon points=\"{}\" fill=\"{color}\" fill-opacity=\"{opacity}\"/>\n",
                    points.join(" ")
                )
            }
            Shape::Edge(color, width) => format!(
                "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{color}\" \
                 stroke-width=\"{width}\"/>\n",
                spots[1].0, spots[1].1
            ),
            Shape::Vertex(color, name) if name.is_empty() => {
                format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1.6\" fill=\"{color}\"/>\n")
            }
            Shape::Vertex(color, name) => format!(
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{color}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\">{name}</text>\n",
                x + 6.0,
                y - 5.0
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_stretched_and_keep_their_sides() {
        let frame = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let points = [[0.0; 3], [4.0, 4.0, 1e-15], [1.0, 1.0, -1e-15]];
        let stage = Stage::new(frame, &points);
        let [on, a, b] = points.map(|p| stage.spot(p)[2]);
        assert!(on.abs() < 1e-12 && a * b < 0.0, "{a} {b}");
        assert!((a.abs() - HEIGHT).abs() < 1e-9);
        assert!(a > 0.0, "as orient3d(0, x, y, z) is");
    }

    #[test]
    fn the_same_picture_has_the_same_bytes() {
        let draw = || {
            let mut picture = Picture::default();
            let spot = |v: u32| [f64::from(v & 1), f64::from(v >> 1 & 1), f64::from(v / 3)];
            let side = |v: u32| if v == 3 { 1 } else { -1 };
            picture.tetrahedra(&[[0, 1, 2, 3]], spot, side, true);
            picture.svg("one tetrahedron", "below")
        };
        let svg = draw();
        assert_eq!(svg, draw());
        assert_eq!(svg.matches("<polygon").count(), 4);
        assert_eq!(svg.matches("<line").count(), 6);
        assert_eq!(svg.matches(CROSSING).count(), 3, "the edges at vertex 3");
        assert_eq!(svg.matches("<circle").count(), 4);
    }
}
