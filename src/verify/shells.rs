//! The empty space around the mesh: which sides of its walls see each other.
//!
//! A *wall* is a boundary face of the mesh (solid behind, empty before), or a part of a facet outside the domain (empty
//! on both sides). Around every edge the walls are sorted by angle, exactly; between two successive ones there is either
//! mesh or empty space, and the sides of walls that face the same empty wedge belong together. So the empty sides fall
//! into *shells*, each of which is one connected component of the boundary of one component of empty space.
//!
//! With normals into the empty space, the signed volume inside a shell is negative iff the empty space is bounded and the
//! shell is its outer boundary. (Positive shells surround solids; sheets have volume zero.) So the negative shells are
//! the voids, one by one. O(n log n); exact numbers are needed only where more than two walls meet.

use super::Case;
use super::facets::OutsidePart;
use super::planar::crossing;
use super::tables::sorted2;
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Sign, Vec3};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// A wall.
struct Wall {
    /// Its boundary, with the wall to the left for one who looks against the normal.
    edges: Vec<[VertexId; 2]>,
    /// Three points of its plane, counterclockwise for that one.
    frame: [VertexId; 3],
    /// The boundary face, if it is one.
    face: Option<usize>,
}

/// One side of a wall: 2·wall before it (where the normal points), 2·wall + 1 behind it.
type Side = usize;

/// A component of the boundary of empty space.
pub(super) struct Shell {
    /// The triangles, with normals into the empty space; polygons are fans, whose triangles may be turned over.
    pub(super) triangles: Vec<[VertexId; 3]>,
    /// The boundary faces of the mesh in it.
    pub(super) faces: Vec<usize>,
    /// The number of walls, of which a sheet counts once for each side.
    pub(super) walls: usize,
    /// Six times the signed volume inside it.
    pub(super) volume: Dyadic,
}

/// The shells, and the edges around which the walls contradict each other.
pub(super) struct Shells {
    /// In order of their first wall.
    pub(super) shells: Vec<Shell>,
    /// Sorted.
    pub(super) contradictions: Vec<[VertexId; 2]>,
}

/// Six times the signed volume between the origin and a triangle.
pub(super) fn cone(case: &Case, triangle: [VertexId; 3]) -> Dyadic {
    let [a, b, c] = triangle.map(|v| case.points.exact(v));
    a.dot(&b.cross(&c))
}

impl Shells {
    pub(super) fn new(case: &Case, outside: &[OutsidePart]) -> Shells {
        let faces = case.tables.boundary().map(|(f, face)| {
            let [a, b, c] = case.tables.inward(face.sides[0]);
            Wall {
                edges: vec![[a, c], [c, b], [b, a]],
                frame: [a, c, b],
                face: Some(f),
            }
        });
        let sheets = outside.iter().map(|part| Wall {
            edges: part.boundary.clone(),
            frame: part.frame,
            face: None,
        });
        let walls: Vec<Wall> = faces.chain(sheets).collect();
        let mut leader: Vec<Side> = (0..2 * walls.len()).collect();
        let mut contradictions = Vec::new();
        for (edge, mut around) in walls_around_edges(&walls) {
            sort_around(case, edge, &walls, &mut around);
            for (i, &(w, forward)) in around.iter().enumerate() {
                // Counterclockwise around the edge means along the normal of a wall that has the edge forwards.
                let (x, other_forward) = around[(i + 1) % around.len()];
                let sides = [
                    2 * w + usize::from(!forward),
                    2 * x + usize::from(other_forward),
                ];
                match sides.map(|side| is_empty(&walls, side)) {
                    [true, true] => join(&mut leader, sides),
                    [false, false] => {}
                    _ => contradictions.push(edge),
                }
            }
        }
        contradictions.dedup();
        Shells {
            shells: gather(case, &walls, &mut leader),
            contradictions,
        }
    }
}

impl Shell {
    /// Whether the shell winds around a point: the crossings of a ray from it, a point on the shell counting as outside.
    pub(super) fn surrounds(&self, case: &Case, point: VertexId) -> bool {
        let winding = |t: &[VertexId; 3]| {
            let [a, b, c] = *t;
            let edges = [[a, b], [b, c], [c, a]];
            let turn: i32 = edges
                .iter()
                .map(|&e| crossing(case.points, [0, 1], e, &[point]))
                .sum();
            // The plane of a triangle that turns counterclockwise is above the point if the point is on its negative side.
            let side = match turn {
                0 => return 0,
                _ => case.points.orient([a, b, c, point]),
            };
            let above = if turn > 0 {
                Sign::Negative
            } else {
                Sign::Positive
            };
            if side == above { turn } else { 0 }
        };
        self.triangles.iter().map(winding).sum::<i32>() != 0
    }
}

fn is_empty(walls: &[Wall], side: Side) -> bool {
    side.is_multiple_of(2) || walls[side / 2].face.is_none()
}

fn find(leader: &mut [Side], mut side: Side) -> Side {
    while leader[side] != side {
        leader[side] = leader[leader[side]];
        side = leader[side];
    }
    side
}

fn join(leader: &mut [Side], sides: [Side; 2]) {
    let [s, t] = sides.map(|side| find(leader, side));
    leader[s.max(t)] = s.min(t);
}

/// For each edge, the walls that have it and whether they have it from the smaller to the larger end.
fn walls_around_edges(walls: &[Wall]) -> BTreeMap<[VertexId; 2], Vec<(usize, bool)>> {
    let mut around: BTreeMap<[VertexId; 2], Vec<(usize, bool)>> = BTreeMap::new();
    for (w, wall) in walls.iter().enumerate() {
        for &edge in &wall.edges {
            around
                .entry(sorted2(edge))
                .or_default()
                .push((w, edge[0] < edge[1]));
        }
    }
    around
}

/// Sorts the walls counterclockwise around the edge from its smaller to its larger end. Two need no order.
fn sort_around(case: &Case, edge: [VertexId; 2], walls: &[Wall], around: &mut [(usize, bool)]) {
    if around.len() <= 2 {
        return;
    }
    let [a, b] = edge.map(|v| case.points.exact(v));
    let axis = b.sub(&a);
    // n × (direction of the edge in the wall) points into the wall.
    let inward = |&(w, forward): &(usize, bool)| {
        let [p, q, r] = walls[w].frame.map(|v| case.points.exact(v));
        let normal = q.sub(&p).cross(&r.sub(&p));
        if forward {
            normal.cross(&axis)
        } else {
            axis.cross(&normal)
        }
    };
    let mut directions: Vec<((usize, bool), Vec3<Dyadic>)> =
        around.iter().map(|wall| (*wall, inward(wall))).collect();
    let first = directions[0].1.clone();
    let turn = |d: &Vec3<Dyadic>, e: &Vec3<Dyadic>| axis.dot(&d.cross(e)).exact_sign();
    // 0: with the first, 1: up to half a turn, 2: opposite to the first, 3: beyond.
    let quarter = |d: &Vec3<Dyadic>| match (turn(&first, d), first.dot(d).exact_sign()) {
        (Sign::Zero, Sign::Negative) => 2,
        (Sign::Zero, _) => 0,
        (Sign::Positive, _) => 1,
        (Sign::Negative, _) => 3,
    };
    directions.sort_by(|(v, d), (w, e)| {
        let angle = match turn(d, e) {
            Sign::Positive => Ordering::Less,
            Sign::Negative => Ordering::Greater,
            Sign::Zero => Ordering::Equal,
        };
        quarter(d).cmp(&quarter(e)).then(angle).then(v.cmp(w))
    });
    for (place, (wall, _)) in around.iter_mut().zip(directions) {
        *place = wall;
    }
}

/// The shells in order of their first wall.
fn gather(case: &Case, walls: &[Wall], leader: &mut [Side]) -> Vec<Shell> {
    let mut shells: BTreeMap<Side, Shell> = BTreeMap::new();
    for side in (0..2 * walls.len()).filter(|&side| is_empty(walls, side)) {
        let shell = shells.entry(find(leader, side)).or_insert_with(|| Shell {
            triangles: Vec::new(),
            faces: Vec::new(),
            walls: 0,
            volume: Dyadic::ZERO,
        });
        let wall = &walls[side / 2];
        shell.walls += 1;
        shell.faces.extend(wall.face);
        let Some(&[apex, _]) = wall.edges.first() else {
            continue;
        };
        for &[a, b] in wall.edges.iter().filter(|e| !e.contains(&apex)) {
            let triangle = if side.is_multiple_of(2) {
                [apex, a, b]
            } else {
                [apex, b, a]
            };
            shell.triangles.push(triangle);
            shell.volume = shell.volume.clone() + &cone(case, triangle);
        }
    }
    shells.into_values().collect()
}
