//! The last phase: what of the tetrahedralization is written, as arrays.

use super::inside::{Inside, Located, OpenEdge, open_in, volumes_not_applied};
use super::interpolation::Interpolation;
use super::{Cdt, open};
use crate::error::{DomainError, Failure, PointKind};
use crate::exchange::{
    ExactPosition, ExportedEdge, ExportedFace, ExportedMesh, FaceTable, Note, NoteCode, Plc,
};
use crate::mesh::{SimplexIndex, TetId, VertexId, canonical_face, canonical_tet, sort_by_least};
use crate::plc::{FacetName, VertexName};
use crate::predicate::{DoublePoints, PointStore};
use crate::recover::domain::{Components, OnPolygon, keeps_edge, locate};
use crate::recover::output::embedding::check_embedding;
use crate::recover::output::rounding::round;
use crate::recover::output::shims::Repair;
use crate::recover::subpolygons::face;
use crate::report::{Phase, Report};
use crate::threads;
use std::borrow::Cow;

/// Fewer tetrahedra are one thread's work.
const FEW: usize = 1 << 15;

/// The number of what is not in the mesh, among regions and polygons.
const NONE: u32 = 0;

impl Cdt {
    /// The mesh as arrays: what the facets enclose without holes, or the convex hull. Tetrahedra, faces and edges are
    /// in an order that depends on their vertices alone, so that equal meshes give equal files. What the input says
    /// in vain, points outside of everything for instance, is in the report's notes.
    ///
    /// # Errors
    /// [`InvalidPlc`](crate::error::InvalidPlc) if polygons of the input overlap, or have something inside that they
    /// do not declare; [`DomainError`] if what is inside is not known.
    pub fn export(
        &mut self,
        plc: &Plc,
        keep_hull: bool,
        report: &mut Report,
    ) -> Result<ExportedMesh, Failure> {
        report.time(Phase::Domain, |report| {
            check_embedding(
                &self.plc.pieces.complex,
                &self.plc.subsegments,
                (&self.cdt.subpolygons, self.plc.points.len()),
                &self.cdt.inserted,
            )?;
            let n = self.plc.points.len();
            let walls = SimplexIndex::of_triangles(n, self.cdt.subpolygons.iter());
            let components = Components::new(&self.cdt.mesh, &walls);
            let open = self.open_edges(&components);
            let inside = self.inside(plc, &walls, &components, &open, keep_hull, report)?;
            let mut repair = Repair {
                points: &self.plc.points,
                mesh: Cow::Borrowed(&self.cdt.mesh),
                incidence: Cow::Borrowed(&self.cdt.incidence),
                subpolygons: Cow::Borrowed(&self.cdt.subpolygons),
                marks: inside.marks(plc, &self.cdt.mesh, &components),
                pieces: &self.plc.pieces,
                subsegments: &self.plc.subsegments,
            };
            report.flattening.shims = repair.run(!keep_hull);
            let walls = match &repair.subpolygons {
                Cow::Borrowed(_) => walls,
                Cow::Owned(moved) => SimplexIndex::of_triangles(n, moved.iter()),
            };
            let components = match (&repair.mesh, &repair.subpolygons) {
                (Cow::Borrowed(_), Cow::Borrowed(_)) => components,
                _ => Components::new(&repair.mesh, &walls),
            };
            let (mesh, marks) = (&*repair.mesh, &repair.marks);
            let mut tets = threads::collect(mesh.capacity(), FEW, |i, tets| {
                let t = TetId::new(i);
                if marks.kept[i] && mesh.is_alive(t) && !mesh.is_ghost(t) {
                    tets.push((canonical_tet(mesh.vertices(t)), t));
                }
            });
            sort_by_least(&mut tets, n, |tet| tet.0[0], |tet| tet.0);
            let regions = Regions::new(&components, tets.iter().map(|&(_, t)| t));
            let vertices: Vec<[VertexId; 4]> = tets.iter().map(|&(v, _)| v).collect();
            let rounding = round(&self.plc.points, &vertices);
            report.moved_by_rounding = rounding.moved;
            report.spoilt_by_rounding = rounding.spoilt;
            report.notes.extend(spoilt(&report.spoilt_by_rounding, plc));
            report.output_regions = regions.count as usize;
            let (faces, table) = self.faces(plc, &repair, &walls, &regions);
            if !keep_hull {
                report.notes.extend(self.facets_outside(plc, &table));
            }
            let interpolation = Interpolation {
                plc,
                points: &self.plc.points,
                complex: &self.complex,
                subsegments: &self.plc.subsegments,
                pieces: &self.plc.pieces,
            };
            let mesh = ExportedMesh {
                first_index: plc.first_index,
                vertices: rounding.coordinates,
                attributes: interpolation.attributes(),
                vertex_markers: interpolation.markers(),
                exact: self.exact_positions(),
                regions: if marks.region.is_empty() {
                    Vec::new()
                } else {
                    tets.iter().map(|(_, t)| marks.region[t.index()]).collect()
                },
                edges: self.edges(&repair, &faces),
                faces,
                face_table: table,
                region_numbers: tets.iter().map(|&(_, t)| regions.of(t)).collect(),
                tets: vertices,
                renumbered: Vec::new(),
            };
            report.output_tets = mesh.tets.len();
            report.output_faces = mesh.faces.len();
            Ok(mesh)
        })
    }

    /// The segments that one side of one polygon is on, with the components around them.
    fn open_edges(&self, components: &Components) -> Vec<OpenEdge> {
        let complex = &*self.complex;
        let sides = open::sides(complex, self.plc.subsegments.index(), |f| {
            self.is_inserted(f)
        });
        let open = (0..sides.len()).filter(|&s| sides[s] == 1);
        let mut open: Vec<OpenEdge> = open
            .map(|s| {
                let mut chain = self.plc.subsegments.chain(s as u32);
                let [a, b] = [(); 2].map(|()| chain.next().expect("a segment has two ends"));
                let t = self.cdt.incidence.tet_at_edge(&self.cdt.mesh, a, b);
                let component = t.and_then(|t| components.of(t));
                let component = component.expect("segments are edges of the mesh");
                (open::ends_of(complex, s), component)
            })
            .collect();
        open.sort_unstable();
        open
    }

    /// What is inside.
    fn inside(
        &mut self,
        plc: &Plc,
        walls: &SimplexIndex<2>,
        components: &Components,
        open: &[OpenEdge],
        keep_hull: bool,
        report: &mut Report,
    ) -> Result<Inside, DomainError> {
        let notes = &mut report.notes;
        notes.extend(volumes_not_applied(plc));
        if !keep_hull {
            let edges = open_in(open, Components::OUTSIDE);
            if !edges.is_empty() {
                return Err(DomainError::Open { edges });
            }
            if components.count() == 1 {
                return Err(DomainError::NothingEnclosed);
            }
        }
        let mut near = self.cdt.mesh.finite().next();
        let mut find = |kind, index, point| match locate(
            &self.plc.points,
            &self.cdt.mesh,
            walls,
            &mut near,
            point,
        ) {
            Ok(t) => Ok(t.and_then(|t| components.of(t))),
            Err(OnPolygon) => Err(DomainError::PointOnFacet { kind, index }),
        };
        let holes: &[[f64; 3]] = if keep_hull { &[] } else { &plc.holes };
        let holes = holes.iter().enumerate();
        let holes = holes
            .map(|(index, &hole)| find(PointKind::Hole, index, hole))
            .collect::<Result<_, _>>()?;
        let regions = plc.regions.iter().enumerate();
        let regions = regions
            .map(|(index, region)| find(PointKind::Region, index, region.point))
            .collect::<Result<_, _>>()?;
        let located = Located { holes, regions };
        if keep_hull {
            report.open_edges = open.len();
            return Inside::hull(plc, components, &located, notes);
        }
        let inside = Inside::of_facets(plc, components, open, &located, notes)?;
        let number = |v: VertexId| VertexName::new(plc, v).number;
        report.open_edges = inside.count_open(open, &number, notes);
        Ok(inside)
    }

    /// Where the points are whose coordinates are no doubles.
    fn exact_positions(&self) -> Vec<ExactPosition> {
        let first = self.complex.representative.len();
        let steiner = (first..self.plc.points.len()).map(VertexId::new);
        let rounded = steiner.filter(|&v| !self.plc.points.is_double(v));
        let position = |vertex: VertexId| {
            let (ends, t) = self.plc.subsegments.place_of_steiner(vertex)?;
            Some(ExactPosition { vertex, ends, t })
        };
        rounded
            .map(|v| position(v).expect("only points on segments are no doubles"))
            .collect()
    }

    /// The subpolygons of the domain with their markers, and the faces of its boundary; and what they lie on.
    ///
    /// A face of the boundary is counterclockwise for one who looks at it from outside; one between two regions for
    /// one who looks from the region with the higher number; one with the same region on both sides has its vertices
    /// in ascending order.
    fn faces(
        &self,
        plc: &Plc,
        written: &Repair<DoublePoints>,
        walls: &SimplexIndex<2>,
        regions: &Regions,
    ) -> (Vec<ExportedFace>, FaceTable) {
        let (mesh, marks) = (&*written.mesh, &written.marks);
        let polygon_of = self.polygon_of_piece();
        let mut faces = threads::collect(mesh.capacity(), FEW, |i, faces| {
            let t = TetId::new(i);
            if !marks.kept[i] || !mesh.is_alive(t) || mesh.is_ghost(t) {
                return;
            }
            for c in (0..4).map(|slot| t.corner(slot)) {
                let n = mesh.neighbor(c);
                // Ghosts are not kept.
                let boundary = !marks.kept[n.index()];
                if !boundary && n < t {
                    continue;
                }
                let facet = mesh.facet(c);
                let piece = walls.triangle(facet);
                if piece.is_none() && !boundary {
                    continue;
                }
                // The facet turns counterclockwise for one who looks from outside of t.
                let here = regions.of(t);
                let there = if boundary { NONE } else { regions.of(n) };
                let (vertices, sides) = if boundary || here < there {
                    (canonical_face(facet), [here, there])
                } else if here > there {
                    (
                        canonical_face([facet[0], facet[2], facet[1]]),
                        [there, here],
                    )
                } else {
                    (face(facet), [here, there])
                };
                let polygon = piece.map_or(NONE, |p| polygon_of[p as usize] + 1);
                faces.push((face(facet), vertices, sides, polygon));
            }
        });
        let n = self.plc.points.len();
        sort_by_least(&mut faces, n, |f| f.0[0], |f| f.0);
        let polygons = &self.complex.polygons;
        let marker = |polygon: u32| {
            polygon
                .checked_sub(1)
                .map_or(0, |f| polygons[f as usize].marker)
        };
        let exported = faces.iter().map(|&(_, vertices, _, polygon)| ExportedFace {
            vertices,
            marker: marker(polygon),
        });
        let exported = exported.collect();
        let table = FaceTable {
            sides: faces.iter().map(|f| f.2).collect(),
            polygons: faces.iter().map(|f| f.3).collect(),
            facets: polygons.iter().map(|f| plc.of_input(&f.facets)).collect(),
            markers: Vec::new(),
        };
        (exported, table)
    }

    /// The polygon of each piece.
    fn polygon_of_piece(&self) -> Vec<u32> {
        let mut of = vec![NONE; self.plc.pieces.complex.polygons.len()];
        for f in 0..self.complex.polygons.len() {
            of[self.plc.pieces.of(f)].fill(f as u32);
        }
        of
    }

    /// A note about facets with an area that are on no face.
    fn facets_outside(&self, plc: &Plc, table: &FaceTable) -> Option<Note> {
        let mut written = vec![false; self.complex.polygons.len() + 1];
        for &polygon in &table.polygons {
            written[polygon as usize] = true;
        }
        // Of a facet that a repair has divided some pieces may be written.
        let of = |wanted: bool| {
            let polygons = (0..self.complex.polygons.len()).filter(|&f| self.is_inserted(f));
            let polygons = polygons.filter(|&f| written[f + 1] == wanted);
            let facets = polygons.flat_map(|f| &self.complex.polygons[f].facets);
            plc.of_input(&facets.copied().collect::<Vec<_>>())
        };
        let mut facets = of(false);
        if !plc.origins.is_empty() && !facets.is_empty() {
            let written = of(true);
            facets.retain(|f| written.binary_search(f).is_err());
        }
        let named = FacetName::of_input(plc, &facets[..facets.len().min(Note::LISTED)]);
        let names: Vec<String> = named.iter().take(4).map(ToString::to_string).collect();
        let text = match facets.len() {
            0 => return None,
            1 => format!("{} is outside of the domain and left out", names[0]),
            2..=4 => format!(
                "{} are outside of the domain and left out",
                names.join(", ")
            ),
            count => format!(
                "{count} facets are outside of the domain and left out: {}, …",
                names.join(", ")
            ),
        };
        let numbers = named.iter().map(|name| name.number);
        Some(Note::new(NoteCode::FacetsOutside, facets.len(), text).on_facets(numbers))
    }

    /// The subsegments of the domain, whose faces are given, with their markers.
    fn edges(&self, written: &Repair<DoublePoints>, faces: &[ExportedFace]) -> Vec<ExportedEdge> {
        let n = self.plc.points.len();
        let mut markers = Vec::new();
        let mut ends: Vec<[VertexId; 2]> = Vec::new();
        let given = self.complex.segments.len() - self.complex.diagonals;
        for (s, segment) in self.complex.segments[..given].iter().enumerate() {
            let mut chain = self.plc.subsegments.chain(s as u32);
            let mut last = chain.next();
            for v in chain {
                ends.extend(last.replace(v).map(|u| [u.min(v), u.max(v)]));
            }
            markers.resize(ends.len(), segment.marker);
        }
        // Where a face is written, its edges are. Of the others the tetrahedra decide.
        let mut kept = vec![false; ends.len()];
        let index = SimplexIndex::of_edges(n, &ends);
        for &ExportedFace { vertices, .. } in faces {
            let [a, b, c] = vertices;
            for i in [[a, b], [a, c], [b, c]].map(|[a, b]| index.edge(a, b)) {
                i.into_iter().for_each(|i| kept[i as usize] = true);
            }
        }
        let (mesh, incidence) = (&written.mesh, &written.incidence);
        let mut edges: Vec<ExportedEdge> = Vec::with_capacity(ends.len());
        for (i, (vertices, marker)) in ends.into_iter().zip(markers).enumerate() {
            let [a, b] = vertices;
            if kept[i] || keeps_edge(mesh, incidence, &written.marks, a, b) {
                edges.push(ExportedEdge { vertices, marker });
            }
        }
        sort_by_least(&mut edges, n, |e| e.vertices[0], |e| e.vertices);
        edges
    }
}

/// The numbers of the regions: the components of the domain, from 1, in the order of their first tetrahedra in the
/// output.
struct Regions<'a> {
    components: &'a Components,
    numbers: Vec<u32>,
    count: u32,
}

impl Regions<'_> {
    fn new<'a>(components: &'a Components, written: impl Iterator<Item = TetId>) -> Regions<'a> {
        let mut numbers = vec![NONE; components.count()];
        let mut count = 0;
        for c in written.filter_map(|t| components.of(t)) {
            let number = &mut numbers[c as usize];
            if *number == NONE {
                count += 1;
                *number = count;
            }
        }
        Regions {
            components,
            numbers,
            count,
        }
    }

    fn of(&self, t: TetId) -> u32 {
        self.components
            .of(t)
            .map_or(NONE, |c| self.numbers[c as usize])
    }
}

/// A note about tetrahedra that are positive only with exact Steiner points.
fn spoilt(tets: &[usize], plc: &Plc) -> Option<Note> {
    let names = tets.iter().take(Note::LISTED);
    let names: Vec<String> = names
        .map(|t| (t + plc.first_index as usize).to_string())
        .collect();
    let more = if tets.len() > Note::LISTED {
        ", …"
    } else {
        ""
    };
    let text = format!(
        "{} tetrahedra are positive, but not with Steiner points rounded to doubles: {}{more} (the report lists all)",
        tets.len(),
        names.join(", "),
    );
    (!tets.is_empty()).then(|| Note::new(NoteCode::SpoiltByRounding, tets.len(), text))
}
