//! What stuck flips have left: is it a polyhedron that has no tetrahedralization, like Schönhardt's (1928)?
//!
//! # The question
//! The crossing tetrahedra that are left form connected polyhedra P, bounded by triangles none of which crosses the
//! polygon f. To finish, P must be filled anew with tetrahedra that do not cross f, without new vertices; then f cuts
//! it in halves. If P has no such tetrahedralization then flips inside P cannot help. If already one half has none, and
//! has six vertices and the boundary of an octahedron, then that half is Schönhardt's polyhedron up to isomorphism.
//!
//! # The search
//! Boundary triangles are oriented inwards. A set of positive tetrahedra whose inward triangles cancel in pairs of
//! opposite orientation, but for those of the boundary, covers every point of space outside their triangles as often as
//! the boundary winds around it: once inside P, never outside. Positive tetrahedra that cover P once fill it without
//! overlap. So no intersection need ever be computed: take a triangle that still needs a tetrahedron, try every apex,
//! and go on; each oriented triangle may be used once. The search is exhaustive, exponential in the worst case, and
//! gives up after a given number of trials.

use crate::flips::order::Insertion;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use tetflip::mesh::VertexId;
use tetflip::number::Sign;
use tetflip::predicate::PointStore;

/// A triangle abc that needs, or has, a tetrahedron abcd with positive orientation; the least vertex first.
type Inward = [VertexId; 3];

type Tet = [VertexId; 4];

/// How many tetrahedra a search may try, those that do not fit included. Some milliseconds; ample for eight vertices.
const MOST_TRIALS: usize = 20_000;

/// Larger polyhedra are not searched.
const MOST_VERTICES: usize = 12;

/// What a connected set of crossing tetrahedra is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Class {
    /// One half has no tetrahedralization, six vertices, and the boundary of an octahedron.
    Schoenhardt,
    /// There is no tetrahedralization that does not cross f, but the half that has none, if there is one, is another
    /// polyhedron.
    NoTetrahedralization,
    /// There is one; flips have not found it.
    Tetrahedralizable,
    /// It has more than twelve vertices, or the search was too long.
    Undecided,
}

impl Class {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Class::Schoenhardt => "schoenhardt",
            Class::NoTetrahedralization => "no-tetrahedralization",
            Class::Tetrahedralizable => "tetrahedralizable",
            Class::Undecided => "undecided",
        }
    }
}

/// One connected set of crossing tetrahedra that is left.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Piece {
    /// What it is.
    pub class: Class,
    /// The tetrahedra.
    pub tets: Vec<Tet>,
    /// How many vertices they have.
    pub vertices: usize,
    /// How many vertices each half that has no tetrahedralization has, and how many triangles on its side of f.
    pub locked_halves: Vec<(usize, usize)>,
}

impl fmt::Display for Piece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {} tets, {} vertices",
            self.class.name(),
            self.tets.len(),
            self.vertices
        )
    }
}

/// The connected sets of crossing tetrahedra that an insertion has left, those of the worst class first.
pub fn pieces_left<P: PointStore>(points: &P, insertion: &Insertion) -> Vec<Piece> {
    let sides = Sides::new(points, insertion);
    let Some((_, tets)) = &insertion.end else {
        return Vec::new();
    };
    let crossing: Vec<Tet> = tets.iter().copied().filter(|t| sides.crosses(t)).collect();
    let pieces = components(&crossing).into_iter();
    let mut pieces: Vec<Piece> = pieces.map(|tets| classify(points, &sides, tets)).collect();
    pieces.sort_unstable();
    pieces
}

/// The sides of a flat polygon, of the vertices of one region.
struct Sides(BTreeMap<VertexId, Sign>);

impl Sides {
    fn new<P: PointStore>(points: &P, insertion: &Insertion) -> Sides {
        let [a, b, c] = insertion.frame;
        let vertices = insertion.before.iter().flatten();
        Sides(
            vertices
                .map(|&v| (v, points.orient3d([a, b, c, v])))
                .collect(),
        )
    }

    fn has(&self, simplex: &[VertexId], side: Sign) -> bool {
        simplex.iter().any(|v| self.0.get(v) == Some(&side))
    }

    fn crosses(&self, simplex: &[VertexId]) -> bool {
        self.has(simplex, Sign::Positive) && self.has(simplex, Sign::Negative)
    }
}

/// The tetrahedra, grouped by common triangles.
fn components(tets: &[Tet]) -> Vec<Vec<Tet>> {
    let mut left: Vec<Tet> = tets.to_vec();
    let mut components = Vec::new();
    while let Some(first) = left.pop() {
        let mut component = vec![first];
        let mut next = 0;
        while let Some(&t) = component.get(next) {
            next += 1;
            let is_neighbor = |u: &Tet| u.iter().filter(|v| t.contains(v)).count() == 3;
            component.extend(left.iter().copied().filter(is_neighbor));
            left.retain(|u| !is_neighbor(u));
        }
        component.sort_unstable();
        components.push(component);
    }
    components
}

fn classify<P: PointStore>(points: &P, sides: &Sides, tets: Vec<Tet>) -> Piece {
    let boundary = boundary(&tets);
    let vertices = vertices_of(&boundary);
    let all = Search {
        points,
        vertices: &vertices,
        allowed: &|t| !sides.crosses(t),
        is_free: &|_| false,
    };
    let mut locked_halves = Vec::new();
    let answer = if vertices.len() > MOST_VERTICES {
        Answer::TooLong
    } else {
        all.fill(&boundary)
    };
    let class = match answer {
        Answer::Filled(_) => Class::Tetrahedralizable,
        Answer::TooLong => Class::Undecided,
        Answer::Impossible => {
            let mut class = Class::NoTetrahedralization;
            for side in [Sign::Positive, Sign::Negative] {
                if let Some((half, is_octahedral)) = locked_half(points, sides, &boundary, side) {
                    locked_halves.push(half);
                    if half.0 == 6 && is_octahedral {
                        class = Class::Schoenhardt;
                    }
                }
            }
            class
        }
    };
    Piece {
        class,
        tets,
        vertices: vertices.len(),
        locked_halves,
    }
}

/// The half of a polyhedron on one side of f, if it has no tetrahedralization: its vertices and its triangles on that
/// side, and whether its boundary is that of an octahedron.
fn locked_half<P: PointStore>(
    points: &P,
    sides: &Sides,
    boundary: &[Inward],
    side: Sign,
) -> Option<((usize, usize), bool)> {
    let other = if side == Sign::Positive {
        Sign::Negative
    } else {
        Sign::Positive
    };
    let half: Vec<Inward> = boundary
        .iter()
        .copied()
        .filter(|t| sides.has(t, side))
        .collect();
    let vertices = vertices_of(&half);
    let search = Search {
        points,
        vertices: &vertices,
        allowed: &|t| !sides.has(t, other),
        // The triangulation of f is left open.
        is_free: &|t| !sides.has(t, side),
    };
    (search.fill(&half) == Answer::Impossible)
        .then(|| ((vertices.len(), half.len()), closes_to_octahedron(&half)))
}

/// Whether triangles, with one triangle or two more that close them, are the boundary of an octahedron: eight in all,
/// four at each of six vertices.
fn closes_to_octahedron(half: &[Inward]) -> bool {
    let edges: BTreeSet<[VertexId; 2]> = half.iter().flat_map(edges_of).collect();
    let open: BTreeMap<VertexId, VertexId> = edges
        .iter()
        .filter(|&&[a, b]| !edges.contains(&[b, a]))
        .map(|&[a, b]| (b, a))
        .collect();
    let mut ring: Vec<VertexId> = open.keys().take(1).copied().collect();
    while let Some(&next) = ring.last().and_then(|v| open.get(v)) {
        if next == ring[0] || ring.len() > open.len() {
            break;
        }
        ring.push(next);
    }
    if ring.len() != open.len() {
        return false;
    }
    let closed = |more: &[[usize; 3]]| {
        let more = more.iter().map(|t| t.map(|i| ring[i]));
        is_octahedron(&half.iter().copied().chain(more).collect::<Vec<_>>())
    };
    match ring.len() {
        0 => closed(&[]),
        3 => closed(&[[0, 1, 2]]),
        4 => closed(&[[0, 1, 2], [0, 2, 3]]) || closed(&[[0, 1, 3], [1, 2, 3]]),
        _ => false,
    }
}

fn is_octahedron(triangles: &[[VertexId; 3]]) -> bool {
    let mut degrees: BTreeMap<VertexId, usize> = BTreeMap::new();
    for &v in triangles.iter().flatten() {
        *degrees.entry(v).or_default() += 1;
    }
    let edges: BTreeSet<[VertexId; 2]> = triangles.iter().flat_map(edges_of).collect();
    let is_closed = edges.len() == 24 && edges.iter().all(|&[a, b]| edges.contains(&[b, a]));
    triangles.len() == 8 && degrees.len() == 6 && degrees.values().all(|&d| d == 4) && is_closed
}

fn edges_of(&[a, b, c]: &[VertexId; 3]) -> [[VertexId; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn vertices_of(triangles: &[Inward]) -> Vec<VertexId> {
    let vertices: BTreeSet<VertexId> = triangles.iter().flatten().copied().collect();
    vertices.into_iter().collect()
}

/// The inward triangles of a positive tetrahedron.
fn inward([a, b, c, d]: Tet) -> [Inward; 4] {
    [[a, b, c], [a, d, b], [a, c, d], [b, d, c]].map(least_first)
}

fn least_first(mut t: Inward) -> Inward {
    let least = (0..3).min_by_key(|&i| t[i]).expect("three vertices");
    t.rotate_left(least);
    t
}

fn reversed([a, b, c]: Inward) -> Inward {
    [a, c, b]
}

/// The boundary of the union of positive tetrahedra that do not overlap.
fn boundary(tets: &[Tet]) -> Vec<Inward> {
    let all: BTreeSet<Inward> = tets.iter().flat_map(|&t| inward(t)).collect();
    let outer = all.iter().copied().filter(|&t| !all.contains(&reversed(t)));
    outer.collect()
}

/// Whether there is a tetrahedralization.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// This one.
    Filled(Vec<Tet>),
    /// None.
    Impossible,
    /// Not found within the trials allowed.
    TooLong,
}

/// A search for a tetrahedralization with given vertices.
struct Search<'a, P> {
    points: &'a P,
    vertices: &'a [VertexId],
    /// Which tetrahedra may be used.
    allowed: &'a dyn Fn(&Tet) -> bool,
    /// Which triangles may stay without a tetrahedron on the other side.
    is_free: &'a dyn Fn(&Inward) -> bool,
}

/// A state of the search.
#[derive(Default)]
struct Front {
    /// Triangles that need a tetrahedron.
    open: BTreeSet<Inward>,
    /// Triangles that have one.
    done: BTreeSet<Inward>,
    tets: Vec<Tet>,
    trials: usize,
}

/// The polyhedron with the given boundary, oriented inwards: has it a tetrahedralization without further vertices?
pub fn tetrahedralization<P: PointStore>(points: &P, boundary: &[[VertexId; 3]]) -> Answer {
    let search = Search {
        points,
        vertices: &vertices_of(boundary),
        allowed: &|_| true,
        is_free: &|_| false,
    };
    let boundary: Vec<Inward> = boundary.iter().map(|&t| least_first(t)).collect();
    search.fill(&boundary)
}

impl<P: PointStore> Search<'_, P> {
    fn fill(&self, boundary: &[Inward]) -> Answer {
        let mut front = Front {
            open: boundary.iter().copied().collect(),
            ..Front::default()
        };
        match self.go_on(&mut front) {
            Some(true) => Answer::Filled(front.tets),
            Some(false) => Answer::Impossible,
            None => Answer::TooLong,
        }
    }

    /// Whether the front can be closed; `None` if that takes too many trials.
    fn go_on(&self, front: &mut Front) -> Option<bool> {
        if front.open.is_empty() {
            return Some(true);
        }
        let mut fewest = self.vertices.len() + 1;
        let mut choice = Vec::new();
        for &t in &front.open {
            front.trials += self.vertices.len();
            let fitting = self.fitting(front, t);
            if fitting.len() < fewest {
                (fewest, choice) = (fitting.len(), fitting);
            }
            if fewest == 0 || front.trials > MOST_TRIALS {
                break;
            }
        }
        if front.trials > MOST_TRIALS {
            return None;
        }
        for tet in choice {
            let undo = self.place(front, tet);
            if self.go_on(front)? {
                return Some(true);
            }
            (front.open, front.done) = undo;
            front.tets.pop();
        }
        Some(false)
    }

    /// The tetrahedra on an open triangle that fit what is there.
    fn fitting(&self, front: &Front, [a, b, c]: Inward) -> Vec<Tet> {
        let tets = self.vertices.iter().map(|&v| [a, b, c, v]);
        let fits = |tet: &Tet| {
            !tet[..3].contains(&tet[3])
                && (self.allowed)(tet)
                && inward(*tet).iter().all(|t| self.has_room(front, t))
                && self.points.orient3d(*tet).is_positive()
        };
        tets.filter(fits).collect()
    }

    fn has_room(&self, front: &Front, t: &Inward) -> bool {
        let back = reversed(*t);
        front.open.contains(t)
            || !front.done.contains(t) && !front.open.contains(&back) && !front.done.contains(&back)
    }

    fn place(&self, front: &mut Front, tet: Tet) -> (BTreeSet<Inward>, BTreeSet<Inward>) {
        let before = (front.open.clone(), front.done.clone());
        for t in inward(tet) {
            if !front.open.remove(&t) && !(self.is_free)(&t) {
                front.open.insert(reversed(t));
            }
            front.done.insert(t);
        }
        front.tets.push(tet);
        before
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::predicate::DoublePoints;

    fn ids<const N: usize>(t: [u32; N]) -> [VertexId; N] {
        t.map(VertexId)
    }

    /// A triangle 0 1 2 below, 3 4 5 above, the same turned by some degrees, and cyclic diagonals.
    fn twisted_prism(degrees: f64) -> (DoublePoints, Vec<[VertexId; 3]>) {
        let at = |degrees: f64, z: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [cos, sin, z]
        };
        let lower = [0.0, 120.0, 240.0].map(|a| at(a, 0.0));
        let upper = [0.0, 120.0, 240.0].map(|a| at(a + degrees, 1.0));
        let mut faces = vec![[0, 1, 2], [3, 5, 4]];
        for i in 0..3 {
            let j = (i + 1) % 3;
            // The diagonal from the lower i to the upper j.
            faces.extend([[i, 3 + j, j], [i, 3 + i, 3 + j]]);
        }
        let points = DoublePoints::new([lower, upper].concat());
        (points, faces.into_iter().map(ids).collect())
    }

    #[test]
    fn schoenhardts_polyhedron_has_no_tetrahedralization() {
        // Turned one way the diagonals are reflex, turned the other way they are convex edges of an octahedron.
        let (points, faces) = twisted_prism(30.0);
        let (mirrored, _) = twisted_prism(-30.0);
        let answers = [&points, &mirrored].map(|p| tetrahedralization(p, &faces));
        assert_eq!(
            answers.iter().filter(|a| **a == Answer::Impossible).count(),
            1,
            "{answers:?}"
        );
        let filled = answers.iter().find_map(|a| match a {
            Answer::Filled(tets) => Some(tets.len()),
            _ => None,
        });
        // Four around a diagonal, or five.
        assert!(matches!(filled, Some(4 | 5)), "{filled:?}");
        assert!(is_octahedron(&faces));
        assert!(closes_to_octahedron(&faces[1..]) && closes_to_octahedron(&faces));
        // An untwisted prism with cyclic diagonals has none, either; with one diagonal turned over it has.
        let (points, mut faces) = twisted_prism(0.0);
        assert_eq!(tetrahedralization(&points, &faces), Answer::Impossible);
        faces[2] = ids([0, 3, 1]);
        faces[3] = ids([1, 3, 4]);
        let Answer::Filled(tets) = tetrahedralization(&points, &faces) else {
            panic!("a prism is three tetrahedra");
        };
        assert_eq!(tets.len(), 3);
        assert!(!is_octahedron(&faces));
        let mut outer = boundary(&tets);
        let mut given: Vec<Inward> = faces.into_iter().map(least_first).collect();
        outer.sort_unstable();
        given.sort_unstable();
        assert_eq!(outer, given);
    }

    #[test]
    fn inward_triangles_see_a_positive_tetrahedron() {
        let unit = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let points = DoublePoints::new(unit);
        let tet = ids([0, 1, 2, 3]);
        assert!(points.orient3d(tet).is_positive());
        for t in inward(tet) {
            let apex = tet.iter().find(|v| !t.contains(v)).expect("one of four");
            assert!(points.orient3d([t[0], t[1], t[2], *apex]).is_positive());
        }
        assert_eq!(boundary(&[tet]).len(), 4);
    }

    #[test]
    fn components_meet_in_triangles() {
        let tets = [[0, 1, 2, 3], [1, 2, 3, 4], [4, 5, 6, 7], [3, 4, 8, 9]].map(ids);
        let mut sizes: Vec<usize> = components(&tets).iter().map(Vec::len).collect();
        sizes.sort_unstable();
        assert_eq!(sizes, [1, 1, 2]);
    }
}
