//! `prism`: the failure case of §3.4, rebuilt. "The PLC includes six vertices at the corners of a rectangular prism,
//! with all six vertices lying on a common sphere. A seventh vertex inside that sphere, but outside the prism, anchors
//! a set of tetrahedra that fan out to four of the prism's facets."
//!
//! Six corners, so the prism is a right one over a triangle; those are cospherical whatever the triangle. The polygon
//! is the one facet that the seventh vertex sees. While the seventh vertex, the only one on the left, rises, the fan
//! must turn into three tetrahedra that fill the prism; all of these flips happen when its lifted vertex passes the
//! hyperplane of the six others, that is at one time, and the perturbation alone puts them in order.
//!
//! - `right`: the polygon is a rectangle in z = 0, the six corners are exactly cospherical: an exact tie, which
//!   rounding breaks at random.
//! - `rotated`: the same, turned in its plane and moved, rounded to doubles: a near tie.
//! - `end`: the polygon is a triangular end, the prism is turned in space and moved, rounded: a near tie. (Three
//!   vertices are always coplanar.)
//! - `crowded`: as `right`, with up to 40 more vertices outside the sphere.
//! - `integer`: as `right`, with coordinates that are small integers: the times are computed without any error but that
//!   of the quotient.

use super::{Draw, Family, facet, one_polygon};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "prism",
    subfamilies: &["right", "rotated", "end", "crowded", "integer"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    match subfamily {
        "end" => end(draw),
        "integer" => integer(draw),
        _ => side(subfamily, draw),
    }
}

/// The failure case: `prism/end:78`, a prism of which the polygon, 4 2 5, is an end, 0 1 3 is the other end, and 6 is
/// the seventh vertex, with seven tetrahedra from 6 to the rest of the prism's boundary.
///
/// In exact order three 3-2 flips suffice, one for each side of the prism. With times in `f64` a 2-3 flip that is later
/// than all of them comes first and makes an edge that turns the diagonal of one side over, so that those of the three
/// sides go around the prism: Schönhardt's configuration. Nothing else on the queue can be flipped.
pub fn paper_failure() -> Plc {
    let vertices = vec![
        [1.3078065480124408, 1.3779478464061732, -0.5394744828808755],
        [1.8112690899167683, 1.0202704609080397, -1.6376913668019157],
        [0.4649072456801425, -0.3282048520190928, -1.8157287244026517],
        [1.6542434170044296, 1.053176664204991, -0.6994603458649746],
        [0.3078815727678037, -0.2952986487221416, -0.8774977034657107],
        [
            -0.038555296224185076,
            0.029472533479040663,
            -0.7175118404816117,
        ],
        [
            0.3143400366393333,
            -0.30606522139760983,
            -1.2501464545143133,
        ],
    ];
    Plc {
        vertices,
        facets: vec![facet([4, 2, 5])],
        ..Plc::default()
    }
}

/// The prism over a triangle abc in the x-z plane, with y = ±h: first the rectangle on ab, then the two copies of c.
fn prism([a, b, c]: [[f64; 2]; 3], h: f64) -> Vec<[f64; 3]> {
    [(a, -h), (b, -h), (b, h), (a, h), (c, -h), (c, h)]
        .map(|([x, z], y)| [x, y, z])
        .to_vec()
}

/// The centre of the sphere, which has y = 0, and the square of its radius. Rounded: they only choose other vertices.
fn sphere(prism: &[[f64; 3]]) -> ([f64; 3], f64) {
    let ([ax, h, az], [bx, _, bz], [cx, _, cz]) = (prism[3], prism[2], prism[5]);
    let (ux, uz, vx, vz) = (bx - ax, bz - az, cx - ax, cz - az);
    let (uu, vv, twice) = (
        ux * ux + uz * uz,
        vx * vx + vz * vz,
        2.0 * (ux * vz - uz * vx),
    );
    let (x, z) = ((vz * uu - uz * vv) / twice, (ux * vv - vx * uu) / twice);
    ([ax + x, 0.0, az + z], x * x + z * z + h * h)
}

fn square_distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum()
}

/// The rectangle is the polygon, in z = 0; the rest of the prism is below, the seventh vertex above.
fn side(subfamily: &str, draw: &mut Draw) -> Plc {
    let triangle = [
        [-0.25 - draw.fraction().abs(), 0.0],
        [0.25 + draw.fraction().abs(), 0.0],
        [draw.fraction(), -0.25 - draw.fraction().abs()],
    ];
    let mut vertices = prism(triangle, 0.25 + draw.fraction().abs());
    let (centre, square) = sphere(&vertices);
    let r = square.sqrt();
    let in_ball = |draw: &mut Draw| {
        let p = draw.point();
        [0, 1, 2].map(|i: usize| centre[i] + r * p[i])
    };
    // Off the boundary of the sphere, and above the prism.
    let seventh = (0..500)
        .map(|_| in_ball(draw))
        .find(|&p| p[2] > r / 100.0 && square_distance(p, centre) < 0.98 * square);
    vertices.extend(seventh);
    match subfamily {
        "crowded" => {
            for _ in 0..draw.int(1, 40) {
                let p = draw.point().map(|x| 3.0 * r * x);
                if square_distance(p, centre) > 1.01 * square {
                    vertices.push(p);
                }
            }
        }
        "rotated" => {
            // The tangent of half the angle: sines and cosines of the standard library differ between platforms.
            let t = draw.fraction();
            let (sin, cos) = (2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t));
            let [dx, dy, _] = draw.point();
            for p in &mut vertices {
                let [x, y, z] = *p;
                *p = [cos * x - sin * y + dx, sin * x + cos * y + dy, z];
            }
        }
        _ => {}
    }
    one_polygon(vertices, 4)
}

/// The triangle is the polygon; the seventh vertex is beyond it.
fn end(draw: &mut Draw) -> Plc {
    let triangle = [0; 3].map(|_| [draw.fraction(), draw.fraction()]);
    let mut vertices = prism(triangle, 0.25 + draw.fraction().abs());
    let (centre, square) = sphere(&vertices);
    let (r, h) = (square.sqrt(), vertices[2][1]);
    let p = (0..500).map(|_| draw.point().map(|x| r * x)).map(|p| {
        let [x, y, z] = p;
        [centre[0] + x, y, centre[2] + z]
    });
    let beyond = |p: &[f64; 3]| p[1] > h + r / 100.0 && square_distance(*p, centre) < 0.98 * square;
    vertices.extend(p.into_iter().find(beyond));
    let axes = rotation(draw);
    let shift = draw.point();
    let turned = vertices.iter().map(|p| {
        let along = |i: usize| axes[i].iter().zip(p).map(|(a, x)| a * x).sum::<f64>();
        [0, 1, 2].map(|i| along(i) + shift[i])
    });
    let turned: Vec<[f64; 3]> = turned.collect();
    // The end at y = h comes first.
    let order = [2, 3, 5, 0, 1, 4, 6];
    let known = order.iter().filter_map(|&i| turned.get(i).copied());
    one_polygon(known.collect(), 3)
}

/// A rotation, but for rounding: from a random quaternion.
fn rotation(draw: &mut Draw) -> [[f64; 3]; 3] {
    let q: [f64; 4] = std::array::from_fn(|_| draw.fraction());
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [w, x, y, z] = q.map(|c| c / norm);
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

fn integer(draw: &mut Draw) -> Plc {
    let mut whole = |low, high| f64::from(draw.int(low, high));
    let triangle = [
        [-whole(1, 9), 0.0],
        [whole(1, 9), 0.0],
        [whole(-9, 9), -whole(1, 9)],
    ];
    let mut vertices = prism(triangle, whole(1, 9));
    let (centre, square) = sphere(&vertices);
    let mut seventh = || [whole(-20, 20), whole(-20, 20), whole(1, 20)];
    let inside = |p: &[f64; 3]| square_distance(*p, centre) < 0.999 * square;
    vertices.extend((0..500).map(|_| seventh()).find(inside));
    one_polygon(vertices, 4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::Member;
    use crate::flips::order::{Trace, disorder, exact_ranks};
    use crate::flips::schoenhardt::{Class, pieces_left};
    use tetflip::cdt::Cdt;
    use tetflip::error::{Failure, GaveUp};
    use tetflip::mesh::VertexId;
    use tetflip::recover::flips::Fate;
    use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType};
    use tetflip::report::Report;

    fn run(times: FlipOrder) -> (Cdt, Trace, Result<(), Failure>) {
        let mut report = Report::default();
        let mut cdt = Cdt::with_segments(&paper_failure(), true, &mut report).expect("segments");
        let (before, mut trace) = (cdt.clone(), Trace::default());
        let insertion = Insertion::Flip(times);
        let result =
            cdt.insert_polygons_observed(insertion, &mut report, &mut |_| (), Some(&mut trace));
        (before, trace, result.map(|_| ()))
    }

    #[test]
    fn rounded_order_locks_itself_in_schoenhardts_polyhedron() {
        let (cdt, trace, result) = run(FlipOrder::new(NumberType::F64Plain));
        let [insertion] = trace.insertions.as_slice() else {
            panic!("one region");
        };
        // The fan: seven tetrahedra, all with the seventh vertex.
        assert_eq!(insertion.before.len(), 7);
        assert!(insertion.before.iter().all(|t| t.contains(&VertexId(6))));
        let d = disorder(
            cdt.points(),
            insertion,
            FlipOrder::new(NumberType::F64Plain),
        );
        assert!(d.adjacent >= 2 && d.kendall > 2, "{d:?}");
        // The first event is the last one in the exact order, and the only one that is flipped.
        assert_eq!(
            exact_ranks(cdt.points(), insertion)[0],
            Some(d.events as usize)
        );
        let flips = insertion
            .events
            .iter()
            .filter(|(_, fate)| matches!(fate, Fate::Flipped(_)));
        assert_eq!(flips.count(), 1);
        assert_eq!(d.list_left, 6);
        assert!(matches!(
            result,
            Err(Failure::GaveUp(GaveUp::Stuck { crossing: 7, .. }))
        ));
        let pieces = pieces_left(cdt.points(), insertion);
        assert_eq!(pieces.len(), 1);
        assert_eq!(
            (pieces[0].class, pieces[0].vertices),
            (Class::Schoenhardt, 7)
        );
        // The prism, without its end on the polygon.
        assert_eq!(pieces[0].locked_halves, [(6, 7)]);
    }

    #[test]
    fn exact_order_succeeds() {
        for times in [FlipOrder::EXACT, FlipOrder::FILTERED] {
            let (cdt, trace, result) = run(times);
            assert_eq!(result, Ok(()));
            let d = disorder(cdt.points(), &trace.insertions[0], times);
            assert_eq!((d.events, d.kendall), (3, 0), "three flips");
        }
    }

    /// A change of the generators would make old tables incomparable.
    #[test]
    fn seeds_give_the_same_bits() {
        let member: Member = "prism/end:78".parse().expect("a name");
        assert_eq!(member.prepare().plc, paper_failure());
    }
}
