//! `walls`: facets that stand on, or hang over, a large one, as in buildings. Flips for the floor must leave the walls
//! alone.
//!
//! - `fins`: upright rectangles above and below the floor that do not touch it, inserted before it.
//! - `standing`: walls that stand on the floor; their lower edges are segments inside it.

use super::{Draw, Family, doubles, facet};
use tetflip::exchange::Plc;
use tetflip::mesh::VertexId;

/// The family.
pub const FAMILY: Family = Family {
    name: "walls",
    subfamilies: &["fins", "standing"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let standing = subfamily == "standing";
    let mut points = vec![[-7, -7, 0], [7, -7, 0], [7, 7, 0], [-7, 7, 0]];
    let (mut facets, mut floor) = (Vec::new(), facet(0..4));
    for i in 0..draw.int(1, 5) {
        let (x, n) = (2 * i - 4, points.len());
        let (half, height, side) = (draw.int(1, 4), draw.int(1, 3), draw.sign());
        let near = if standing { 0 } else { side };
        let far = near + side * height;
        points.extend([
            [x, -half, near],
            [x, half, near],
            [x, half, far],
            [x, -half, far],
        ]);
        facets.push(facet(n..n + 4));
        if standing {
            floor.polygons.push([n, n + 1].map(VertexId::new).to_vec());
        }
    }
    facets.push(floor);
    // Other points have odd x, off the planes of the walls.
    let n = draw.int(10, 60) as usize;
    let others = draw.lattice_points(5, n).into_iter();
    points.extend(others.filter(|p| p[0] % 2 != 0 && p[2] != 0));
    Plc {
        vertices: doubles(points),
        facets,
        ..Plc::default()
    }
}
