//! A region copied out of the mesh, so that flips find everything close together: what an insertion looks at lies
//! anywhere in the memory of a large mesh, and its flips jump about in the region in the order of time.
//!
//! The vertices get new ids, first those to the left of f, then those on f, then those to its right, so that a
//! comparison tells the side; each part in the order in which a breadth-first search of R meets them, and so the
//! tetrahedra. They keep their identities, so that the flips are those of the region in the mesh. What lies outside of
//! R is stood in for by
//! *shell* tetrahedra, each for four facets of the boundary: flips glue to their corners what they put behind those
//! facets.
//!
//! Time linear in the size of R, there and back.

use super::region_view::RegionView;
use crate::machine::less;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::region::{Region, Side, Sides};
use crate::recover::tables::Table;

/// Tables that are kept from region to region.
#[derive(Clone, Debug, Default)]
pub(super) struct CompactScratch {
    /// 1 + the place in R of a tetrahedron of the mesh.
    tets: Table<u32>,
    /// 1 + the new id of a vertex.
    vertices: Table<u32>,
}

/// A region on its own.
pub(super) struct Compact<P> {
    /// The vertices of R, and those of the polygon's frame.
    pub(super) points: P,
    /// The shell, and then R.
    pub(super) mesh: TetMesh,
    /// The frame of the polygon.
    pub(super) frame: [VertexId; 3],
    /// Which is which.
    pub(super) view: Parts,
    /// The vertices as the mesh knows them.
    vertices: Vec<VertexId>,
    /// The corner of the mesh outside of R that each corner of the shell stands for.
    outside: Vec<Corner>,
}

/// Sides and places told by ids alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    /// Ids of left vertices are less.
    left: u32,
    /// Those of right ones are not less.
    right: u32,
    /// The shell's ids are less.
    shell: u32,
}

impl Parts {
    /// Whether a vertex is to the left of f.
    #[inline]
    pub(super) fn is_left(self, v: VertexId) -> bool {
        v.0 < self.left
    }
}

impl RegionView for Parts {
    #[inline(always)]
    fn left_and_right(&self, &[a, b, c, d]: &[VertexId; 4]) -> [u8; 2] {
        let ids = [a.0, b.0, c.0, d.0];
        [less(ids, self.left), !less(ids, self.right) & 0b1111]
    }

    #[inline(always)]
    fn is_on(&self, v: VertexId) -> bool {
        (self.left..self.right).contains(&v.0)
    }

    #[inline(always)]
    fn contains(&self, t: TetId) -> bool {
        t.0 >= self.shell
    }

    fn enter(&mut self, _: TetId) {}

    fn leave(&mut self, _: TetId) {}
}

impl<P: PointStore> Compact<P> {
    /// A copy of a region.
    pub(super) fn new(
        mesh: &TetMesh,
        sides: &Sides<P>,
        region: &Region,
        scratch: &mut CompactScratch,
    ) -> Compact<P> {
        let (tets, boundary) = breadth_first(mesh, region, &mut scratch.tets);
        let (vertices, [left, right]) = by_side(mesh, sides, &tets, &mut scratch.vertices);
        let number = |v: VertexId| VertexId(scratch.vertices.get(v.index()) - 1);
        let shell = boundary.div_ceil(4);
        let mut copy = TetMesh::new();
        // Flips need some more, but rarely half as many more.
        copy.reserve(shell + tets.len() + tets.len() / 2);
        for _ in 0..shell {
            copy.add([VertexId::INFINITE; 4]);
        }
        for &t in &tets {
            let [a, b, c, d] = mesh.vertices(t);
            copy.add([number(a), number(b), number(c), number(d)]);
        }
        let mut outside = Vec::with_capacity(boundary);
        for (i, &t) in tets.iter().enumerate() {
            for (slot, &twin) in mesh.tet(t).1.iter().enumerate() {
                let c = TetId::new(shell + i).corner(slot);
                match scratch.tets.get(twin.tet().index()) {
                    0 => {
                        let stands_for = TetId::new(outside.len() / 4).corner(outside.len() % 4);
                        copy.glue(c, stands_for);
                        outside.push(twin);
                    }
                    place => {
                        let n = TetId::new(shell + place as usize - 1);
                        copy.set_twin(c, n.corner(twin.slot()));
                    }
                }
            }
        }
        let id = |n: usize| u32::try_from(n).expect("fewer than 2^32 vertices");
        Compact {
            points: sides.points().reordered(&vertices),
            mesh: copy,
            frame: sides.frame.map(number),
            view: Parts {
                left: id(left),
                right: id(right),
                shell: id(shell),
            },
            vertices,
            outside,
        }
    }

    /// The ids of R's tetrahedra before any flip.
    pub(super) fn tets(&self) -> impl ExactSizeIterator<Item = TetId> + use<P> {
        (self.view.shell as usize..self.mesh.capacity()).map(TetId::new)
    }

    /// How many tetrahedra cross f.
    pub(super) fn crossing(&self) -> usize {
        let crosses = |&t: &TetId| {
            let [left, right] = self.view.left_and_right(&self.mesh.vertices(t));
            left != 0 && right != 0
        };
        self.inner().filter(crosses).count()
    }

    /// The tetrahedra that fill R.
    fn inner(&self) -> impl Iterator<Item = TetId> + '_ {
        self.mesh.all().skip_while(|&t| !self.view.contains(t))
    }

    /// Puts the tetrahedra that fill R now into the place of those that did, and returns their ids in the mesh, sorted.
    pub(super) fn put_back(self, mesh: &mut TetMesh, region: &Region) -> Vec<TetId> {
        let mut olds = region.tets.iter().copied();
        // By ids in the copy.
        let mut ids = vec![TetId(u32::MAX); self.mesh.capacity()];
        let mut tets = Vec::with_capacity(region.tets.len());
        for t in self.inner() {
            let id = olds
                .next()
                .unwrap_or_else(|| mesh.add([VertexId::INFINITE; 4]));
            ids[t.index()] = id;
            tets.push(id);
        }
        for t in olds {
            mesh.remove(t);
        }
        for t in self.inner() {
            let (vertices, twins) = self.mesh.tet(t);
            let id = ids[t.index()];
            let mut across = [Corner::NONE; 4];
            for (slot, &twin) in twins.iter().enumerate() {
                across[slot] = if self.view.contains(twin.tet()) {
                    ids[twin.tet().index()].corner(twin.slot())
                } else {
                    let outside = self.outside[4 * twin.tet().index() + twin.slot()];
                    mesh.set_twin(outside, id.corner(slot));
                    outside
                };
            }
            let vertex = |slot: usize| self.vertices[vertices[slot].index()];
            let vertices = [vertex(0), vertex(1), vertex(2), vertex(3)];
            mesh.overwrite(id, vertices, across);
        }
        tets.sort_unstable();
        tets
    }
}

/// The tetrahedra of R in breadth-first order, and how many facets its boundary has. `places` is told 1 + the place of
/// each.
fn breadth_first(mesh: &TetMesh, region: &Region, places: &mut Table<u32>) -> (Vec<TetId>, usize) {
    places.clear();
    let mut order: Vec<TetId> = Vec::with_capacity(region.tets.len());
    let mut meet = |t: TetId, order: &mut Vec<TetId>| {
        if places.get(t.index()) == 0 {
            order.push(t);
            places.set(t.index(), order.len() as u32);
        }
    };
    let (mut next, mut boundary) = (0, 0);
    // A region that was put together again after a failure need not be connected for all that its marks tell.
    for &start in &region.tets {
        meet(start, &mut order);
        while let Some(&t) = order.get(next) {
            next += 1;
            for twin in mesh.tet(t).1 {
                if region.contains(twin.tet()) {
                    meet(twin.tet(), &mut order);
                } else {
                    boundary += 1;
                }
            }
        }
    }
    (order, boundary)
}

/// The vertices of R and of the frame, left, on and right, in the order in which they are met; how many are left, and
/// how many are not right. `numbers` is told 1 + the place of each.
fn by_side<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    tets: &[TetId],
    numbers: &mut Table<u32>,
) -> (Vec<VertexId>, [usize; 2]) {
    numbers.clear();
    let (mut left, mut on, mut right) = (Vec::new(), Vec::new(), Vec::new());
    let of_tets = tets.iter().flat_map(|&t| mesh.vertices(t));
    for v in of_tets.chain(sides.frame) {
        if numbers.get(v.index()) == 0 {
            numbers.set(v.index(), 1);
            match sides.of(v) {
                Side::Left => left.push(v),
                Side::Right => right.push(v),
                _ => on.push(v),
            }
        }
    }
    let counts = [left.len(), left.len() + on.len()];
    left.append(&mut on);
    left.append(&mut right);
    for (v, number) in left.iter().zip(1..) {
        numbers.set(v.index(), number);
    }
    (left, counts)
}

#[cfg(test)]
mod tests {
    use crate::cdt::{Cdt, Options};
    use crate::exchange::{Facet, Plc};
    use crate::mesh::{TetMesh, VertexId};
    use crate::recover::flips::FlipObserver;
    use crate::recover::polygons::{FlipOrder, Insertion, PolygonCounts};
    use crate::report::Report;

    struct Silent;

    impl FlipObserver for Silent {}

    /// A rectangle through points of a flat box, which has a vertical one in its way.
    fn scene(seed: u32, grid: f64) -> Plc {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        };
        let mut vertices: Vec<[f64; 3]> = Vec::new();
        while vertices.len() < 150 {
            let p = [2.0 * next(), 2.0 * next(), 0.25 * next()].map(|x| (x * grid).round() / grid);
            if p[2] != 0.0 && !vertices.contains(&p) {
                vertices.push(p);
            }
        }
        vertices.extend([[-3., -2., 0.], [3., -2., 0.], [3., 2., 0.], [-3., 2., 0.]]);
        vertices.extend([[2., -1., 0.5], [2., 1., 0.5], [2., 1., 1.], [2., -1., 1.]]);
        let facet = |first: usize| Facet {
            polygons: vec![(first..first + 4).map(VertexId::new).collect()],
            ..Facet::default()
        };
        Plc {
            vertices,
            facets: vec![facet(150), facet(154)],
            ..Plc::default()
        }
    }

    fn inserted(plc: &Plc, observed: bool) -> (TetMesh, PolygonCounts) {
        let mut report = Report::default();
        let mut cdt = Cdt::begin(plc, &Options::default(), &mut report).expect("a PLC");
        let insertion = Insertion::Flip(FlipOrder::FILTERED);
        let mut silent = Silent;
        let observer = observed.then_some(&mut silent as &mut dyn FlipObserver);
        let counts = cdt
            .insert_polygons_observed(insertion, &mut report, &mut |_| (), observer)
            .expect("a valid PLC");
        (cdt.mesh().clone(), counts)
    }

    fn sorted_tets(mesh: &TetMesh) -> Vec<[VertexId; 4]> {
        let sorted = |t| {
            let mut v = mesh.vertices(t);
            v.sort_unstable();
            v
        };
        let mut tets: Vec<[VertexId; 4]> = mesh.finite().map(sorted).collect();
        tets.sort_unstable();
        tets
    }

    /// An insertion that is observed takes place in the mesh itself.
    #[test]
    fn flips_in_a_copy_are_those_in_the_mesh() {
        for (seed, grid) in [(1, 1e9), (2, 1e9), (3, 16.0), (4, 32.0)] {
            let plc = scene(seed, grid);
            let (copied, counts) = inserted(&plc, false);
            assert!(counts.largest_region >= 100, "{counts:?}");
            assert_eq!(copied.check(), Ok(()));
            let (in_place, expected) = inserted(&plc, true);
            assert_eq!(sorted_tets(&copied), sorted_tets(&in_place));
            assert_eq!(counts.crossing_tets, expected.crossing_tets);
            assert_eq!(counts.recovered, expected.recovered);
            let kinds =
                |c: &PolygonCounts| [c.flips.two_three, c.flips.three_two, c.flips.four_four];
            assert_eq!(kinds(&counts), kinds(&expected));
        }
    }
}
