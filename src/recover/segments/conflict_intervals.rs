//! For which places on a subsegment a new vertex is in conflict with which tetrahedra.
//!
//! A new vertex at A + u(B − A) has a conflict zone: the tetrahedra whose circumspheres contain it. For each
//! tetrahedron these u are an interval, between the roots of a quadratic polynomial. So one search for the tetrahedra
//! whose intervals are not empty tells the conflict zones of all u: an edge vanishes for those u that are in the
//! intervals of all its tetrahedra, and a vertex is joined to the new one for those that are in the interval of one of
//! its tetrahedra.
//!
//! In floats: what they tell is for choosing places, not for deciding.
//!
//! With the first corner o of a positive tetrahedron as the origin and its edges e, f, g from there, whose determinant
//! is D, a point x is inside the circumsphere iff D |x|² − x·G < 0, where G = |e|² f×g + |f|² g×e + |g|² e×f. D and G
//! are kept for each tetrahedron until it is replaced: most are looked at many times.

use super::inner_edges::inner_edges;
use crate::machine::prefetch;
use crate::mesh::{TetId, TetMesh, VertexId, any_infinite};
use crate::number::vector::{cross, dot, minus};
use crate::predicate::PointStore;

/// An open interval; empty if its ends are not in order.
pub(super) type Interval = [f64; 2];

const EMPTY: Interval = [f64::INFINITY, f64::NEG_INFINITY];

/// Vertices are taken to lie in the plane of a hull facet if they are this near to it, relative to their distance from
/// its vertices.
const FLAT: f64 = 1e-10;

/// The tetrahedra whose circumspheres reach a part of a subsegment, and their intervals. Memory is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct ConflictIntervals {
    /// For each tetrahedron the search that last came to it, and its place in `tets`, or `NOWHERE`.
    marks: Vec<(u32, u32)>,
    stamp: u32,
    tets: Vec<TetId>,
    intervals: Vec<Interval>,
    /// For each tetrahedron o, G and D; zeros if they are not known.
    spheres: Vec<[f64; 7]>,
}

/// A line through A and B.
struct Line {
    a: [f64; 3],
    b: [f64; 3],
    /// B − A and its square.
    along: [f64; 3],
    square: f64,
}

impl Line {
    fn new<P: PointStore>(points: &P, [a, b]: [VertexId; 2]) -> Line {
        let [a, b] = [points.rounded(a), points.rounded(b)];
        let along = minus(b, a);
        let square = dot(along, along);
        Line {
            a,
            b,
            along,
            square,
        }
    }
}

const NOWHERE: u32 = u32::MAX;

impl ConflictIntervals {
    /// Finds the tetrahedra that reach the part `range` of ab, starting with `seeds`; gives up if there are more than
    /// `most`. Returns how many have been looked at.
    pub(super) fn find<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        ab: [VertexId; 2],
        seeds: &[TetId],
        range: Interval,
        most: usize,
    ) -> Option<usize> {
        let line = Line::new(points, ab);
        self.begin(mesh);
        let mut looked = 0;
        let mut visit = |conflicts: &mut ConflictIntervals, t: TetId| {
            if conflicts.marks[t.index()].0 == conflicts.stamp {
                return;
            }
            looked += 1;
            let interval = conflicts.interval(points, mesh, t, &line);
            let overlaps = interval[0].max(range[0]) <= interval[1].min(range[1]);
            let place = if overlaps {
                conflicts.tets.len() as u32
            } else {
                NOWHERE
            };
            conflicts.marks[t.index()] = (conflicts.stamp, place);
            if overlaps {
                for slot in 0..4 {
                    prefetch(&conflicts.spheres, mesh.neighbor(t.corner(slot)).index());
                }
                conflicts.tets.push(t);
                conflicts.intervals.push(interval);
            }
        };
        seeds.iter().for_each(|&t| visit(self, t));
        let mut next = 0;
        while let Some(&t) = self.tets.get(next) {
            if self.tets.len() > most {
                return None;
            }
            next += 1;
            for slot in 0..4 {
                visit(self, mesh.neighbor(t.corner(slot)));
            }
        }
        Some(looked)
    }

    fn begin(&mut self, mesh: &TetMesh) {
        if self.stamp == u32::MAX {
            self.marks.fill((0, 0));
            self.stamp = 0;
        }
        self.stamp += 1;
        let n = mesh.capacity();
        if self.marks.is_empty() {
            // Zeros that cost nothing until they are touched.
            self.marks = vec![(0, 0); n];
            self.spheres = vec![[0.0; 7]; n];
        } else if self.marks.len() < n {
            self.marks.resize(n, (0, 0));
            self.spheres.resize(n, [0.0; 7]);
        }
        self.tets.clear();
        self.intervals.clear();
    }

    /// To be called with the tetrahedra that an operation created.
    pub(super) fn forget(&mut self, created: &[TetId]) {
        for t in created {
            if let Some(sphere) = self.spheres.get_mut(t.index()) {
                *sphere = [0.0; 7];
            }
        }
    }

    #[inline]
    fn place(&self, t: TetId) -> Option<usize> {
        let (stamp, place) = self.marks[t.index()];
        (stamp == self.stamp && place != NOWHERE).then_some(place as usize)
    }

    /// Where new vertices are joined to the end v of ab: from v on as far as the returned interval goes, because a
    /// sphere through v that is empty shrinks towards v. `seeds` are tetrahedra that ab crosses; if none of them is at
    /// v, or too many are, everywhere.
    pub(super) fn joined<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        ab: [VertexId; 2],
        v: VertexId,
        seeds: &[TetId],
        most: usize,
    ) -> Interval {
        let line = Line::new(points, ab);
        self.begin(mesh);
        let at_v = |&&t: &&TetId| mesh.slot_of(t, v).is_some();
        self.tets.extend(seeds.iter().find(at_v));
        let mut common = EMPTY;
        let mut next = 0;
        while let Some(&t) = self.tets.get(next).filter(|_| next <= most) {
            next += 1;
            let interval = self.interval(points, mesh, t, &line);
            if interval[0].max(0.0) >= interval[1].min(1.0) {
                continue;
            }
            common = [common[0].min(interval[0]), common[1].max(interval[1])];
            let opposite = mesh.corner_of(t, v).slot();
            for slot in (0..4).filter(|&slot| slot != opposite) {
                let n = mesh.neighbor(t.corner(slot));
                if self.marks[n.index()].0 != self.stamp {
                    self.marks[n.index()] = (self.stamp, NOWHERE);
                    prefetch(&self.spheres, n.index());
                    self.tets.push(n);
                }
            }
        }
        if next == 0 || next > most {
            return [0.0, 1.0];
        }
        common
    }

    /// Calls `visit` with each wanted edge that some new vertices make vanish, and with where these are.
    pub(super) fn vanishing(
        &self,
        mesh: &TetMesh,
        range: Interval,
        wanted: impl Fn([VertexId; 2]) -> bool,
        visit: impl FnMut([VertexId; 2], Interval),
    ) {
        let narrow = |s: Interval, t: TetId| {
            let [low, high] = self.place(t).map_or(EMPTY, |i| self.intervals[i]);
            let common = [s[0].max(low), s[1].min(high)];
            (common[0] <= common[1]).then_some(common)
        };
        let is_in = |t| self.place(t).is_some();
        inner_edges(mesh, &self.tets, is_in, wanted, range, narrow, visit);
    }

    /// For which u the point A + u(B − A) is in conflict with t.
    #[inline]
    fn interval<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        t: TetId,
        line: &Line,
    ) -> Interval {
        let v = mesh.vertices(t);
        if any_infinite(v) {
            return self.interval_of_ghost(points, mesh, t, line);
        }
        let sphere = &mut self.spheres[t.index()];
        if sphere[6] == 0.0 {
            *sphere = circumsphere(points, v);
        }
        within(sphere, line)
    }

    /// Segments are never beyond a hull facet, but may be in its plane.
    fn interval_of_ghost<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        t: TetId,
        line: &Line,
    ) -> Interval {
        let c = mesh.corner_of(t, VertexId::INFINITE);
        let [p, q, r] = mesh.facet(c).map(|v| points.rounded(v));
        let normal = cross(minus(q, p), minus(r, p));
        let is_near = |x: [f64; 3]| {
            let x = minus(x, p);
            let height = dot(x, normal);
            height * height <= FLAT * FLAT * dot(x, x) * dot(normal, normal)
        };
        if is_near(line.a) && is_near(line.b) {
            self.interval(points, mesh, mesh.neighbor(c), line)
        } else {
            EMPTY
        }
    }
}

/// What is kept of a positive tetrahedron.
fn circumsphere<P: PointStore>(points: &P, [o, p, q, r]: [VertexId; 4]) -> [f64; 7] {
    let [o, p, q, r] = [
        points.rounded(o),
        points.rounded(p),
        points.rounded(q),
        points.rounded(r),
    ];
    let (e, f, g) = (minus(p, o), minus(q, o), minus(r, o));
    let (fg, ge, ef) = (cross(f, g), cross(g, e), cross(e, f));
    let (ee, ff, gg) = (dot(e, e), dot(f, f), dot(g, g));
    let gradient = |i: usize| ee * fg[i] + ff * ge[i] + gg * ef[i];
    let [x, y, z] = o;
    [x, y, z, gradient(0), gradient(1), gradient(2), dot(e, fg)]
}

/// For which u the point A + u(B − A) is in a sphere.
#[inline]
fn within(&[x, y, z, gx, gy, gz, volume]: &[f64; 7], line: &Line) -> Interval {
    let (x, d, gradient) = (minus(line.a, [x, y, z]), line.along, [gx, gy, gz]);
    let square = volume * line.square;
    let linear = 2.0 * volume * dot(x, d) - dot(d, gradient);
    let constant = volume * dot(x, x) - dot(x, gradient);
    negative(square, linear, constant)
}

/// Where s u² + l u + c < 0 for s ≥ 0; for s < 0, by rounding, it is taken for linear.
#[inline]
fn negative(s: f64, l: f64, c: f64) -> Interval {
    if s <= 0.0 {
        return if l > 0.0 {
            [f64::NEG_INFINITY, -c / l]
        } else if l < 0.0 {
            [-c / l, f64::INFINITY]
        } else {
            EMPTY
        };
    }
    let discriminant = l * l - 4.0 * s * c;
    if discriminant <= 0.0 {
        return EMPTY;
    }
    let sum = -0.5 * (l + discriminant.sqrt().copysign(l));
    let (x, y) = (sum / s, c / sum);
    [x.min(y), x.max(y)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::predicate::{DoublePoints, GrowingStore};

    /// The tetrahedra whose intervals contain u are the conflict zone of the point there.
    #[test]
    fn intervals_tell_conflict_zones() {
        let coordinate = |i: u32, k: u32| f64::from((i * 7919 + k * 104_729 + i * i * k) % 97);
        let vertices: Vec<[f64; 3]> = (0..80)
            .map(|i| [1, 2, 3].map(|k| coordinate(i, k)))
            .collect();
        let mut points = DoublePoints::new(vertices);
        let all: Vec<VertexId> = (0..80).map(VertexId::new).collect();
        let mut delaunay = delaunay(&points, &all).expect("these points span space");
        let mut conflicts = ConflictIntervals::default();
        let mut looked = 0;
        for [a, b] in [[0, 1], [2, 3], [10, 20], [5, 60]].map(|e| e.map(VertexId::new)) {
            let [p, q] = [a, b].map(|v| points.rounded(v));
            let start = delaunay
                .mesh
                .finite()
                .find(|&t| delaunay.mesh.has_vertices(t, &[a]));
            let start = start.expect("a is in the mesh");
            let all = [-0.5, 1.5];
            looked += conflicts
                .find(&points, &delaunay.mesh, [a, b], &[start], all, 10_000)
                .expect("there are not so many tetrahedra");
            for u in [0.1, 0.25, 0.4, 0.5, 0.7, 0.9] {
                let v = points.push([0, 1, 2].map(|i| p[i] + u * (q[i] - p[i])));
                let start = delaunay.locate(&points, v);
                delaunay.find_conflicts(&points, v, start);
                let mut zone = delaunay.conflicts().to_vec();
                zone.sort_unstable();
                let tets = conflicts.tets.iter().zip(&conflicts.intervals);
                let mut told: Vec<TetId> = tets
                    .filter(|(_, s)| s[0] < u && u < s[1])
                    .map(|(&t, _)| t)
                    .collect();
                told.sort_unstable();
                assert_eq!(zone, told);
                points.truncate(80);
            }
        }
        assert!(looked > 100);
    }
}
