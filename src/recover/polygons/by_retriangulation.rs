//! Polygon insertion by retriangulating R as a whole: cavities or gift wrapping, and what comes after a refusal.
//!
//! Cavity retriangulation, where it is chosen, is tried first, and gift wrapping of the two original cavities where it
//! is refused. f is flat. Gift wrapping is refused only if the PLC is not valid; then the caller flips. It also
//! flips in place of a fallback on gift wrapping, whose time is quadratic, in regions of more than [`MOST_WRAPPED`]
//! tetrahedra.

use super::{Current, PolygonInsertion};
use crate::clock::Task;
use crate::predicate::PointStore;
use crate::recover::method::Insertion;
use crate::recover::region::{Region, Sides};
use crate::recover::retriangulate::gift_wrap::gift_wrap;
use crate::recover::retriangulate::{Retriangulation, cavity};
use crate::recover::subpolygons::Face;
use crate::recover::workspace::ConstrainedMesh;

/// The largest region that is gift wrapped because cavity retriangulation was refused: seconds, not minutes.
pub const MOST_WRAPPED: usize = 10_000;

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Retriangulates one region as a whole, and returns the polygons that this displaced; `None` if it is refused.
    pub(super) fn by_retriangulation(
        &mut self,
        f: &Current<P>,
        region: &Region,
    ) -> Option<Vec<usize>> {
        if self.insertion == Insertion::Cavity {
            if let Some(r) = self.by_cavity(&f.sides, region, f.may_displace) {
                return Some(self.put_into_mesh(f, &r));
            }
            self.counts.cavity_fallbacks += 1;
        }
        let is_fallback = self.insertion == Insertion::Cavity;
        let found = if is_fallback && region.tets.len() > MOST_WRAPPED {
            None
        } else {
            self.by_gift_wrapping(&f.sides, region)
        };
        if found.is_none() {
            self.counts.flip_fallbacks += 1;
        } else if is_fallback {
            self.counts.gift_wrap_fallbacks += 1;
        }
        found.map(|r| self.put_into_mesh(f, &r))
    }

    fn by_cavity(
        &mut self,
        sides: &Sides<P>,
        region: &Region,
        may_displace: bool,
    ) -> Option<Retriangulation> {
        let ConstrainedMesh {
            mesh,
            subpolygons,
            scratch,
            ..
        } = &mut *self.cdt;
        let is_subpolygon = |t: Face| subpolygons.contains_key(&t);
        let any = !subpolygons.is_empty();
        let is_subpolygon = any.then_some(&is_subpolygon as &dyn Fn(Face) -> bool);
        let result = cavity::retriangulate(mesh, sides, region, is_subpolygon, &mut scratch.cavity);
        // A polygon that is flat only to rounding may not fit again.
        let pieces = &self.plc.pieces.complex.polygons;
        let is_flat = |t: &Face| subpolygons.get(t).is_none_or(|&g| pieces[g as usize].flat);
        let fits = |r: &Retriangulation| {
            r.displaced.is_empty() || may_displace && r.displaced.iter().all(is_flat)
        };
        result.ok().filter(fits)
    }

    fn by_gift_wrapping(&self, sides: &Sides<P>, region: &Region) -> Option<Retriangulation> {
        let mesh = &self.cdt.mesh;
        let is_subpolygon = |t: Face| self.cdt.subpolygons.contains_key(&t);
        let wrapped = gift_wrap(mesh, sides, region, &is_subpolygon).ok()?;
        mesh.can_replace(&wrapped.old, &wrapped.new)
            .then_some(wrapped)
    }

    /// Puts a retriangulation into the mesh, and returns the polygons that it displaced.
    fn put_into_mesh(&mut self, f: &Current<P>, r: &Retriangulation) -> Vec<usize> {
        self.cdt.scratch.cavity.clock.begin();
        let created = r.put_into(&mut self.cdt.mesh);
        self.cdt.created(&created);
        self.cdt.scratch.cavity.clock.end(Task::Merging);
        self.counts.swallowed += r.swallowed as u64;
        self.counts.displaced += r.displaced.len() as u64;
        self.cover(f, &r.faces);
        let displaced = r.displaced.iter();
        let polygons = displaced.filter_map(|t| self.cdt.subpolygons.remove(t));
        polygons.map(|g| g as usize).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::exchange::{Facet, Plc};
    use crate::mesh::{TetId, TetMesh, VertexId};
    use crate::plc::Complex;
    use crate::predicate::DoublePoints;
    use crate::recover::flatten::Pieces;
    use crate::recover::polygons::{FlipOrder, PolygonCounts};
    use crate::recover::retriangulate::gift_wrap;
    use crate::recover::segments::recover_segments;
    use crate::recover::workspace::EdgeProtectedPlc;
    use std::sync::Arc;

    /// A mesh with all segments of a PLC.
    struct Scene {
        plc: EdgeProtectedPlc<DoublePoints>,
        cdt: ConstrainedMesh,
    }

    impl Scene {
        fn new(vertices: &[[f64; 3]], facets: &[[u32; 4]]) -> Scene {
            let facet = |f: &[u32; 4]| Facet {
                polygons: vec![f.map(VertexId).to_vec()],
                ..Facet::default()
            };
            let plc = Plc {
                vertices: vertices.to_vec(),
                facets: facets.iter().map(facet).collect(),
                ..Plc::default()
            };
            let complex = Complex::new(&plc, true).expect("a PLC");
            let mut points = DoublePoints::new(plc.vertices);
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let mut delaunay = delaunay(&points, &all).expect("not on one plane");
            let (subsegments, incidence) =
                recover_segments(&complex, &mut points, &mut delaunay, &|_| true)
                    .expect("few and far between");
            assert_eq!(points.len(), vertices.len(), "no Steiner point");
            let n = complex.polygons.len();
            Scene {
                plc: EdgeProtectedPlc {
                    points,
                    subsegments,
                    pieces: Pieces::whole(Arc::new(complex)),
                },
                cdt: ConstrainedMesh::new(delaunay.mesh, incidence, n),
            }
        }

        fn insertion(&mut self, insertion: Insertion) -> PolygonInsertion<'_, DoublePoints> {
            PolygonInsertion::new(&self.plc, &mut self.cdt, insertion)
        }
    }

    /// A square that cuts the convex hull in two, and five upright rectangles that float above and below it. Their
    /// triangles in the cavities of the square are not all Delaunay for the cavities' vertices.
    fn fins() -> Scene {
        let square = [[-7, -7, 0], [7, -7, 0], [7, 7, 0], [-7, 7, 0]];
        let loose = [
            [-5, -2, 2],
            [-5, 5, -1],
            [-1, -2, -4],
            [3, -2, 4],
            [3, 0, -2],
            [5, -4, 1],
        ];
        let fin = |[x, y, z, far]: [i32; 4]| [[x, -y, z], [x, y, z], [x, y, far], [x, -y, far]];
        let fins = [
            [-4, 3, 1, 4],
            [-2, 3, -1, -2],
            [0, 2, -1, -3],
            [2, 3, 1, 2],
            [4, 1, -1, -3],
        ];
        let all = square
            .into_iter()
            .chain(fins.into_iter().flat_map(fin))
            .chain(loose);
        let vertices: Vec<[f64; 3]> = all.map(|p| p.map(f64::from)).collect();
        let facet = |i: u32| [4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3];
        Scene::new(&vertices, &[1, 2, 3, 4, 5, 0].map(facet))
    }

    fn crossing(mesh: &TetMesh, sides: &Sides<DoublePoints>) -> TetId {
        let mut tets = mesh.finite();
        tets.find(|&t| sides.crosses_tet(mesh, t))
            .expect("the polygon is missing")
    }

    /// Inserts the square last, as a polygon that may not displace others, and returns the mesh.
    fn square_without_displacing(insertion: Insertion) -> (Vec<[VertexId; 4]>, PolygonCounts) {
        let mut scene = fins();
        for f in 0..5 {
            let mut first = scene.insertion(insertion);
            first.insert(f).expect("a valid PLC");
        }
        let square = &scene.plc.pieces.complex.polygons[5];
        let sides = Sides::new(&scene.plc.points, square, square.vertices.iter().copied());
        let seed = crossing(&scene.cdt.mesh, &sides);
        let region = Region::grow(&scene.cdt.mesh, &sides, seed);
        let mut last = PolygonInsertion::new(&scene.plc, &mut scene.cdt, insertion);
        let f = last.begin(5, false);
        assert_eq!(last.by_retriangulation(&f, &region), Some(Vec::new()));
        let counts = last.counts();
        assert!(scene.cdt.mesh.check().is_ok());
        (scene.cdt.mesh.sorted_tets(), counts)
    }

    #[test]
    fn a_refused_cavity_is_gift_wrapped() {
        let (cavity, counts) = square_without_displacing(Insertion::Cavity);
        assert_eq!(counts.cavity_fallbacks, 1);
        assert_eq!((counts.gift_wrap_fallbacks, counts.flip_fallbacks), (1, 0));
        let (wrapped, counts) = square_without_displacing(Insertion::GiftWrap);
        let expected = PolygonCounts {
            recovered: 2,
            most_recovered: 2,
            ..PolygonCounts::default()
        };
        assert_eq!(counts, expected, "nothing falls back");
        assert_eq!(cavity, wrapped);
        let mut scene = fins();
        let mut all = scene.insertion(Insertion::Flip(FlipOrder::EXACT));
        all.insert_all(&mut |_| {}).expect("a valid PLC");
        assert_eq!(wrapped, scene.cdt.mesh.sorted_tets());
    }

    /// Paper, Fig. 4: a polygon that is not flat, and whose sides want different diagonals of it.
    #[test]
    fn incompatible_sides_are_refused() {
        let e = 2f64.powi(-48);
        let polygon = [[-1., 0., e], [0., -1., -e], [1., 0., e], [0., 1., -e]];
        let apexes = [[0., 0., 0.25], [0., 0., -0.25]];
        let scene = Scene::new(&[&polygon[..], &apexes].concat(), &[[0, 1, 2, 3]]);
        let f = &scene.plc.pieces.complex.polygons[0];
        let sides = Sides::new(&scene.plc.points, f, f.vertices.iter().copied());
        assert!(!sides.flat);
        let seed = crossing(&scene.cdt.mesh, &sides);
        let region = Region::grow(&scene.cdt.mesh, &sides, seed);
        assert_eq!(region.tets.len(), 4);
        let result = gift_wrap::gift_wrap(&scene.cdt.mesh, &sides, &region, &|_| false);
        assert_eq!(result.map(|r| r.new), Err(gift_wrap::Refused::Incompatible));
    }
}
