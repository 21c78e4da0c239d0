//! The empty space around the mesh: which sides of its walls see each other.
//!
//! A *wall* is a boundary face of the mesh (solid behind, empty before), or a part of a facet outside the domain
//! (empty on both sides). Around every edge the walls are sorted by angle, exactly; between two successive ones there
//! is either mesh or empty space, and the sides of walls that face the same empty wedge belong together. So the empty
//! sides fall into *shells*, each of which is one connected component of the boundary of one component of empty
//! space.
//!
//! With normals into the empty space, the signed volume inside a shell is negative iff the empty space is bounded and
//! the shell is its outer boundary. (Positive shells surround solids; sheets have volume zero.) So the negative
//! shells are the voids, one by one. O(n); exact numbers are needed only where more than two walls meet.

use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Sign, Vec3};
use crate::verify::case::Case;
use crate::verify::claims::facets::covering::OutsidePart;
use crate::verify::lookup::tables::{sort_by_edge, sorted2};
use crate::verify::signs::ray::crossing;
use crate::verify::signs::sums::Cones;
use std::cmp::Ordering;
use std::ops::Range;

/// A wall.
struct Wall {
    /// Its boundary, with the wall to the left for one who looks against the normal: a range of [`Walls::edges`].
    edges: Range<usize>,
    /// Three points of its plane, counterclockwise for that one.
    frame: [VertexId; 3],
    /// The boundary face, if it is one.
    face: Option<usize>,
}

/// All walls.
struct Walls {
    walls: Vec<Wall>,
    edges: Vec<[VertexId; 2]>,
}

impl Walls {
    fn new(case: &Case, outside: &[OutsidePart]) -> Walls {
        let mut walls = Walls {
            walls: Vec::new(),
            edges: Vec::new(),
        };
        for (f, face) in case.tables.boundary() {
            let [a, b, c] = case.tables.inward(face.first());
            walls.push(&[[a, c], [c, b], [b, a]], [a, c, b], Some(f));
        }
        for part in outside {
            walls.push(&part.boundary, part.frame, None);
        }
        walls
    }

    fn push(&mut self, edges: &[[VertexId; 2]], frame: [VertexId; 3], face: Option<usize>) {
        let start = self.edges.len();
        self.edges.extend(edges);
        let edges = start..self.edges.len();
        self.walls.push(Wall { edges, frame, face });
    }

    fn edges(&self, wall: &Wall) -> &[[VertexId; 2]] {
        &self.edges[wall.edges.clone()]
    }
}

/// One side of a wall: 2·wall before it (where the normal points), 2·wall + 1 behind it.
type Side = usize;

/// A component of the boundary of empty space.
pub(crate) struct Shell {
    /// The triangles, with normals into the empty space; polygons are fans, whose triangles may be turned over.
    pub(crate) triangles: Vec<[VertexId; 3]>,
    /// The boundary faces of the mesh in it.
    pub(crate) faces: Vec<usize>,
    /// The number of walls, of which a sheet counts once for each side.
    pub(crate) walls: usize,
    /// Six times the signed volume inside it.
    pub(crate) volume: Dyadic,
}

/// The shells, and the edges around which the walls contradict each other.
pub(crate) struct Shells {
    /// In order of their first wall.
    pub(crate) shells: Vec<Shell>,
    /// Sorted.
    pub(crate) contradictions: Vec<[VertexId; 2]>,
}

impl Shells {
    pub(crate) fn new(case: &Case, outside: &[OutsidePart]) -> Shells {
        let all = Walls::new(case, outside);
        let walls = &all.walls;
        let mut leader: Vec<Side> = (0..2 * walls.len()).collect();
        let mut contradictions = Vec::new();
        let incidences = incidences(&all, case.points.len());
        let mut order = Vec::new();
        for around in incidences.chunk_by(|x, y| x.0 == y.0) {
            let edge = around[0].0;
            order.clear();
            order.extend(around.iter().map(|i| i.1));
            let around = &mut order[..];
            sort_around(case, edge, walls, around);
            for (i, &Incidence { wall: w, forward }) in around.iter().enumerate() {
                // Counterclockwise around the edge means along the normal of a wall that has the edge forwards.
                let next = &around[(i + 1) % around.len()];
                let sides = [
                    2 * w as usize + usize::from(!forward),
                    2 * next.wall as usize + usize::from(next.forward),
                ];
                match sides.map(|side| is_empty(walls, side)) {
                    [true, true] => join(&mut leader, sides),
                    [false, false] => {}
                    _ => contradictions.push(edge),
                }
            }
        }
        contradictions.dedup();
        Shells {
            shells: gather(case, &all, &mut leader),
            contradictions,
        }
    }
}

impl Shell {
    /// Whether the shell winds around a point: the crossings of a ray from it, a point on the shell counting as
    /// outside.
    pub(crate) fn surrounds(&self, case: &Case, point: VertexId) -> bool {
        let winding = |t: &[VertexId; 3]| {
            let [a, b, c] = *t;
            let edges = [[a, b], [b, c], [c, a]];
            let turn: i32 = edges
                .iter()
                .map(|&e| crossing(case.points, [0, 1], e, &[point]))
                .sum();
            // The plane of a triangle that turns counterclockwise is above the point if the point is on its negative
            // side.
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

#[inline]
fn is_empty(walls: &[Wall], side: Side) -> bool {
    side.is_multiple_of(2) || walls[side / 2].face.is_none()
}

#[inline]
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

/// A wall at an edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Incidence {
    wall: u32,
    /// Whether the wall has the edge from the smaller to the larger end.
    forward: bool,
}

/// All walls at all edges, smaller end first, by edges, at each edge in the order of walls.
fn incidences(walls: &Walls, points: usize) -> Vec<([VertexId; 2], Incidence)> {
    let mut incidences = Vec::with_capacity(walls.edges.len());
    for (w, wall) in walls.walls.iter().enumerate() {
        incidences.extend(walls.edges(wall).iter().map(|&edge| {
            let incidence = Incidence {
                wall: w as u32,
                forward: edge[0] < edge[1],
            };
            (sorted2(edge), incidence)
        }));
    }
    sort_by_edge(&mut incidences, points);
    incidences
}

/// Sorts the walls counterclockwise around the edge from its smaller to its larger end. Two need no order.
fn sort_around(case: &Case, edge: [VertexId; 2], walls: &[Wall], around: &mut [Incidence]) {
    if around.len() <= 2 {
        return;
    }
    let [a, b] = edge.map(|v| case.points.exact(v));
    let axis = b.sub(&a);
    // n × (direction of the edge in the wall) points into the wall.
    let inward = |&Incidence { wall, forward }: &Incidence| {
        let [p, q, r] = walls[wall as usize].frame.map(|v| case.points.exact(v));
        let normal = q.sub(&p).cross(&r.sub(&p));
        if forward {
            normal.cross(&axis)
        } else {
            axis.cross(&normal)
        }
    };
    let mut directions: Vec<(Incidence, Vec3<Dyadic>)> =
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
fn gather(case: &Case, all: &Walls, leader: &mut [Side]) -> Vec<Shell> {
    let walls = &all.walls;
    // A leader is the first side of its shell.
    let mut sides: Vec<(Side, Side)> = (0..2 * walls.len())
        .filter(|&side| is_empty(walls, side))
        .map(|side| (find(leader, side), side))
        .collect();
    sides.sort_unstable();
    let mut cones = Cones::new();
    let shells = sides.chunk_by(|x, y| x.0 == y.0).map(|sides| {
        let mut shell = Shell {
            triangles: Vec::with_capacity(sides.len()),
            faces: Vec::new(),
            walls: sides.len(),
            volume: Dyadic::ZERO,
        };
        for &(_, side) in sides {
            let wall = &walls[side / 2];
            shell.faces.extend(wall.face);
            let edges = all.edges(wall);
            let Some(&[apex, _]) = edges.first() else {
                continue;
            };
            for &[a, b] in edges.iter().filter(|e| !e.contains(&apex)) {
                let triangle = if side.is_multiple_of(2) {
                    [apex, a, b]
                } else {
                    [apex, b, a]
                };
                shell.triangles.push(triangle);
                cones.add(case.points, triangle);
            }
        }
        shell.volume = cones.volume();
        shell
    });
    shells.collect()
}
