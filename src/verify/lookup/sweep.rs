//! All faces, found and judged: those of one smallest vertex after the other, so that their points are at hand.
//!
//! The vertices are swept in parts, by all threads; what one part says of its faces, by their index in it, is
//! appended to what the ones before it say. So the faces are the same, in the same order, with any number of threads.

use crate::machine::prefetch;
use crate::mesh::VertexId;
use crate::number::Sign;
use crate::verify::lookup::gather::{Face, Gatherer, Ordered, Use, with_corners};
use crate::verify::lookup::spheres::{Spheres, side_of_sphere};
use crate::verify::signs::points::Points;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Mutex;

/// How far ahead of its use memory is asked for.
const AHEAD: usize = 16;

/// Uses of faces by tetrahedra in a part, if there are several threads: what they make of them stays in the cache.
const USES: usize = 1 << 16;

/// The faces of some successive vertices.
pub(crate) struct Part {
    /// The faces by their smallest vertices: all, or those that may be asked for.
    pub(crate) faces: Vec<Face>,
    /// How many faces there are in all.
    pub(crate) total: usize,
    /// Which faces are not, or hardly, locally Delaunay.
    pub(crate) spheres: Spheres,
    /// Whether every tetrahedron is positive.
    pub(crate) is_positive: bool,
    /// The faces with one tetrahedron.
    pub(crate) boundary: Vec<u32>,
    /// The faces with more than two tetrahedra.
    pub(crate) crowded: Vec<usize>,
    /// The faces both of whose tetrahedra are on one side, in increasing order.
    pub(crate) same_side: Vec<usize>,
    /// Where the faces of each of the vertices begin.
    pub(crate) starts: Vec<u32>,
}

/// What is swept.
struct Sweep<'a> {
    points: &'a Points,
    tets: &'a [[VertexId; 4]],
    /// A face is looked for at its smallest vertex: that is the smallest of a tetrahedron for three of its faces, and
    /// the second smallest for one.
    first: Ordered,
    second: Ordered,
    asked: Option<&'a [bool]>,
}

/// The faces of all tetrahedra, whose vertices are below `vertices`. If `asked` is given, only some are kept: those
/// all of whose vertices it holds, those with other than two tetrahedra on opposite sides, and those that are not
/// locally Delaunay.
pub(crate) fn sweep(
    points: &Points,
    tets: &[[VertexId; 4]],
    vertices: usize,
    asked: Option<&[bool]>,
) -> Part {
    let [first, second] = Ordered::by_two_least(tets, vertices);
    let sweep = Sweep {
        points,
        tets,
        first,
        second,
        asked,
    };
    let mut whole = Part::new();
    whole.starts.reserve(vertices + 1);
    if asked.is_none() {
        whole.faces.reserve(2 * tets.len() + tets.len() / 4);
    }
    if 4 * tets.len() < 2 * USES || rayon::current_num_threads() == 1 {
        sweep.judge(0..vertices, &mut Gatherer::new(vertices), &mut whole);
        return whole;
    }
    let gatherers = Mutex::new(Vec::new());
    let judge = |range: &Range<usize>| {
        let idle = || gatherers.lock().expect("no thread panics with the lock");
        let gatherer = idle().pop();
        let mut gatherer = gatherer.unwrap_or_else(|| Gatherer::new(vertices));
        let mut part = Part::new();
        sweep.judge(range.clone(), &mut gatherer, &mut part);
        idle().push(gatherer);
        part
    };
    let mut judged: Vec<Part> = Vec::new();
    for ranges in sweep
        .ranges(vertices)
        .chunks(4 * rayon::current_num_threads())
    {
        // While some threads append what is there, the others go on.
        let append = || judged.drain(..).for_each(|part| whole.append(part));
        let go_on = || ranges.par_iter().map(judge).collect();
        judged = rayon::join(append, go_on).1;
    }
    judged.into_iter().for_each(|part| whole.append(part));
    whole
}

impl Sweep<'_> {
    /// The vertices in parts with about [`USES`] uses.
    fn ranges(&self, vertices: usize) -> Vec<Range<usize>> {
        let before = |v: usize| 3 * self.first.before(v) + self.second.before(v);
        let mut bounds = vec![0];
        for v in 1..vertices {
            if before(v) >= bounds.len() * USES {
                bounds.push(v);
            }
        }
        bounds.push(vertices);
        bounds.windows(2).map(|w| w[0]..w[1]).collect()
    }

    /// Finds and judges the faces of some vertices.
    fn judge(&self, vertices: Range<usize>, gatherer: &mut Gatherer, part: &mut Part) {
        let Sweep {
            points,
            tets,
            first,
            second,
            asked,
        } = self;
        let mut uses = Vec::new();
        for v in vertices {
            part.starts.push(part.faces.len() as u32);
            uses.clear();
            for i in first.range(v) {
                let t = first.tet(i);
                let ([a, b, c, d], odd) = with_corners(&tets[t as usize]);
                for v in [b, c, d] {
                    points.prefetch(v.0);
                    gatherer.prefetch(v.0);
                }
                uses.push(Use::new(t, [b.0, c.0], d, odd));
                uses.push(Use::new(t, [b.0, d.0], c, !odd));
                uses.push(Use::new(t, [c.0, d.0], b, odd));
                debug_assert_eq!(a.0.index(), v);
            }
            for i in second.range(v) {
                if let Some(ahead) = second.get(i + AHEAD) {
                    prefetch(tets, ahead as usize);
                }
                let t = second.tet(i);
                let ([a, _, c, d], odd) = with_corners(&tets[t as usize]);
                points.prefetch(a.0);
                gatherer.prefetch(c.0);
                uses.push(Use::new(t, [c.0, d.0], a, !odd));
            }
            for i in first.range(v) {
                let tet = tets[first.tet(i) as usize];
                part.is_positive &= points.orient(tet).is_positive();
            }
            gatherer.gather(VertexId(v as u32), &mut uses);
            part.take(points, gatherer, *asked);
        }
    }
}

impl Part {
    /// Nothing.
    fn new() -> Part {
        Part {
            faces: Vec::new(),
            total: 0,
            spheres: Spheres::default(),
            is_positive: true,
            boundary: Vec::new(),
            crowded: Vec::new(),
            same_side: Vec::new(),
            starts: Vec::new(),
        }
    }

    /// Judges the faces of one vertex, and keeps them if they may be asked for.
    fn take(&mut self, points: &Points, gathered: &Gatherer, asked: Option<&[bool]>) {
        self.total += gathered.faces.len();
        for (i, face) in gathered.faces.iter().enumerate() {
            let f = self.faces.len();
            let mut keep = asked.is_none_or(|asked| face.key.iter().all(|v| asked[v.index()]));
            match face.both() {
                None => {
                    self.boundary.push(f as u32);
                    keep = true;
                }
                Some([a, b]) if a.is_below() == b.is_below() => {
                    self.same_side.push(f);
                    keep = true;
                }
                Some(_) => {}
            }
            if gathered.crowded.contains(&i) {
                self.crowded.push(f);
                keep = true;
            }
            match side_of_sphere(points, face) {
                Sign::Negative => {}
                Sign::Zero if keep => self.spheres.cospherical.push(f),
                Sign::Zero => self.spheres.cospherical_elsewhere += 1,
                Sign::Positive => {
                    self.spheres.violated.push(f);
                    keep = true;
                }
            }
            if keep {
                self.faces.push(*face);
            }
        }
    }

    /// Appends the faces of the vertices that follow.
    fn append(&mut self, next: Part) {
        let offset = self.faces.len();
        let shift = |f: usize| offset + f;
        let shift_u32 = |f: u32| offset as u32 + f;
        self.faces.extend(next.faces);
        self.total += next.total;
        let spheres = &mut self.spheres;
        spheres
            .violated
            .extend(next.spheres.violated.into_iter().map(shift));
        spheres
            .cospherical
            .extend(next.spheres.cospherical.into_iter().map(shift));
        spheres.cospherical_elsewhere += next.spheres.cospherical_elsewhere;
        self.is_positive &= next.is_positive;
        self.boundary
            .extend(next.boundary.into_iter().map(shift_u32));
        self.crowded.extend(next.crowded.into_iter().map(shift));
        self.same_side.extend(next.same_side.into_iter().map(shift));
        self.starts.extend(next.starts.into_iter().map(shift_u32));
    }
}
