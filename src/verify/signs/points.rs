//! All points that a check talks about, and where they are exactly.

use crate::machine::prefetch;
use crate::mesh::VertexId;
use crate::number::bits::lowest_bit;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use crate::predicate::formula;
use crate::threads;
use crate::verify::signs::filter::{self, Exactness};
use crate::verify::signs::fixed::{self, Scaled};
use crate::verify::signs::tally::Tally;
use crate::verify::signs::words::{self, Cell};
use rustc_hash::FxHashMap;

/// The points: first the vertices of the mesh, then those points of the input (vertices, hole and region points) that
/// are no mesh vertices. A [`VertexId`] in this module names any of them.
pub(crate) struct Points {
    coordinates: Vec<[f64; 3]>,
    /// The points whose coordinates are no doubles; `coordinates` has them rounded.
    exact: FxHashMap<VertexId, Elsewhere>,
    /// How far each point may be from its coordinates along an axis; empty if no point is elsewhere.
    wobble: Vec<f64>,
    /// Whether all coordinates are small enough for the filters.
    pub(crate) shortcut: bool,
    largest: f64,
    /// The greatest k for each point such that its coordinates are multiples of 2^k; [`ELSEWHERE`] if they are no
    /// doubles.
    grain: Vec<i16>,
    pub(crate) exactness: Exactness,
    exact_signs: Tally,
}

/// Fewer points are one thread's work.
const FEW: usize = 1 << 15;

/// Below all exponents.
const ELSEWHERE: i16 = i16::MIN;

/// The greatest k such that a number is a multiple of 2^k; above all of them for zero.
#[inline(always)]
fn grain(x: f64) -> i16 {
    lowest_bit(x).map_or(i16::MAX, |k| k as i16)
}

/// Where a point is exactly.
struct Elsewhere {
    at: Vec3<Dyadic>,
    scaled: Option<[Scaled; 3]>,
    /// What its rounded coordinates lack.
    rest: [Approx; 3],
}

impl Points {
    /// Finite coordinates.
    pub(crate) fn new(coordinates: Vec<[f64; 3]>) -> Points {
        let n = coordinates.len();
        let parts = threads::in_parts(n, FEW, |range| {
            let numbers = coordinates[range].iter().flatten();
            numbers.fold(0.0f64, |m, x| m.max(x.abs()))
        });
        let largest = parts.into_iter().fold(0.0, f64::max);
        let grain: Vec<i16> = threads::map(n, FEW, |v| {
            let [x, y, z] = coordinates[v].map(grain);
            x.min(y).min(z)
        });
        Points {
            exactness: Exactness::new(grain.iter().copied().min().unwrap_or(0)),
            grain,
            exact_signs: Tally::default(),
            coordinates,
            exact: FxHashMap::default(),
            wobble: Vec::new(),
            shortcut: largest <= filter::LARGEST,
            largest,
        }
    }

    /// The same points, some of which are exactly elsewhere.
    pub(crate) fn with_exact(mut self, exact: FxHashMap<VertexId, Vec3<Dyadic>>) -> Points {
        if exact.is_empty() {
            return self;
        }
        self.wobble = vec![0.0; self.coordinates.len()];
        for (v, at) in exact {
            let rest = at.sub(&Vec3::from_f64(self.at(v))).0;
            // More than the rounding of the rest itself, and of twice this.
            let wobble = rest.each_ref().map(|r| match r.exact_sign() {
                Sign::Zero => 0.0,
                _ => r.to_f64().abs() * 1.0001 + f64::MIN_POSITIVE,
            });
            self.wobble[v.index()] = wobble[0].max(wobble[1]).max(wobble[2]);
            self.grain[v.index()] = ELSEWHERE;
            let [x, y, z] = at.0.each_ref().map(Scaled::from_dyadic);
            let scaled = x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            let rest = rest.each_ref().map(Approx::rounded);
            self.exact.insert(v, Elsewhere { at, scaled, rest });
        }
        self
    }

    /// The largest absolute value of a coordinate.
    pub(crate) fn largest(&self) -> f64 {
        self.largest
    }

    /// The coordinates, rounded if they are no doubles.
    #[inline(always)]
    pub(crate) fn at(&self, v: VertexId) -> [f64; 3] {
        self.coordinates[v.index()]
    }

    /// How far the difference of two of the points may be from that of their coordinates, along an axis.
    #[inline(always)]
    pub(crate) fn wobble(&self, points: &[VertexId]) -> f64 {
        if self.wobble.is_empty() {
            return 0.0;
        }
        let wobble = points.iter().map(|v| self.wobble[v.index()]);
        2.0 * wobble.fold(0.0, f64::max)
    }

    /// Whether the point is exactly where its coordinates say.
    pub(crate) fn is_double(&self, v: VertexId) -> bool {
        self.exact.is_empty() || !self.exact.contains_key(&v)
    }

    pub(crate) fn exact(&self, v: VertexId) -> Vec3<Dyadic> {
        match self.exact.get(&v) {
            Some(exact) => exact.at.clone(),
            None => Vec3::from_f64(self.at(v)),
        }
    }

    /// What the coordinates of a point that is elsewhere lack.
    pub(crate) fn rest(&self, v: VertexId) -> &[Approx; 3] {
        &self.exact[&v].rest
    }

    /// The exact coordinates, unless they are too long.
    pub(crate) fn scaled(&self, v: VertexId) -> Option<[Scaled; 3]> {
        if !self.is_double(v) {
            return self.exact[&v].scaled;
        }
        Some(self.at(v).map(Scaled::from_f64))
    }

    /// Whether two points are exactly at the same place.
    pub(crate) fn coincide(&self, v: VertexId, w: VertexId) -> bool {
        self.exact(v) == self.exact(w)
    }

    /// det[b−a, c−a, d−a], exactly.
    pub(crate) fn volume(&self, t: [VertexId; 4]) -> Dyadic {
        let p = t.map(|v| self.exact(v));
        formula::orient3d(p.each_ref())
    }

    /// Lets the processor fetch the coordinates of a point that will soon be wanted.
    #[inline(always)]
    pub(crate) fn prefetch(&self, v: VertexId) {
        prefetch(&self.coordinates, v.index());
    }

    /// Whether all points are exactly where their coordinates say.
    pub(crate) fn are_doubles(&self) -> bool {
        self.exact.is_empty()
    }

    /// The points that are not where their coordinates say, in increasing order.
    pub(crate) fn elsewhere(&self) -> Vec<VertexId> {
        let mut all: Vec<VertexId> = self.exact.keys().copied().collect();
        all.sort_unstable();
        all
    }

    /// The coordinates of all points, rounded.
    pub(crate) fn coordinates(&self) -> &[[f64; 3]] {
        &self.coordinates
    }

    /// A box that holds some points.
    pub(crate) fn bounds(&self, points: &[VertexId]) -> [[f64; 3]; 2] {
        let wobble = self.wobble(points);
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for &v in points {
            for (k, x) in self.at(v).into_iter().enumerate() {
                bounds[0][k] = bounds[0][k].min(x - wobble);
                bounds[1][k] = bounds[1][k].max(x + wobble);
            }
        }
        bounds
    }

    /// How many points there are.
    pub(crate) fn len(&self) -> usize {
        self.coordinates.len()
    }

    /// How many signs were decided by integers so far.
    pub(crate) fn exact_signs(&self) -> usize {
        self.exact_signs.total()
    }

    /// The points in the largest unit that makes them integers, if those are small enough.
    #[inline(always)]
    pub(crate) fn cells<const N: usize>(&self, ids: [VertexId; N]) -> Option<[Cell; N]> {
        let grain = ids.iter().map(|v| self.grain[v.index()]);
        let unit = match grain.min() {
            None | Some(i16::MAX) => 0,
            Some(k) if (-1000..1000).contains(&k) => i64::from(k),
            Some(_) => return None,
        };
        let scale = f64::from_bits(((1023 - unit) as u64) << 52);
        let mut cells = [[0; 3]; N];
        let mut fits = true;
        for (cell, v) in cells.iter_mut().zip(ids) {
            for (to, from) in cell.iter_mut().zip(self.at(v)) {
                let x = from * scale;
                fits &= x.abs() < words::LARGEST;
                *to = x as i64;
            }
        }
        fits.then_some(cells)
    }

    /// A sign that is decided by integers.
    pub(crate) fn counted(&self, sign: Sign) -> Sign {
        self.exact_signs.add();
        sign
    }

    /// A sign by integers that may be long.
    pub(crate) fn in_fixed<F: fixed::Formula>(&self, ids: &[VertexId], formula: &F) -> Sign {
        self.counted(fixed::sign(self, ids, formula))
    }

    /// The centroid of points (four at most), rounded, and how far off that may be along each axis.
    pub(crate) fn centroid(&self, q: &[VertexId]) -> ([f64; 3], f64) {
        let share = q.len() as f64;
        let at = [0, 1, 2].map(|i| q.iter().map(|&v| self.at(v)[i] / share).sum::<f64>());
        // At most six roundings of relative size 2⁻⁵³ on the way to the centre of up to four points.
        let coordinates = q.iter().flat_map(|&v| self.at(v));
        let largest = coordinates.fold(0.0f64, |m, x| m.max(x.abs()));
        let slack = 16.0 * f64::EPSILON * largest + f64::MIN_POSITIVE + self.wobble(q);
        (at, slack)
    }
}
