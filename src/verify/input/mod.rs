//! The PLC in terms of the points of the mesh: every input vertex is the used mesh vertex with the same coordinates, or
//! a point of its own if there is none.
//!
//! The PLC is the one that was given, not one that was repaired: vertices may lie on edges and facets, facets may
//! overlap in their plane or be equal, corners may be repeated. A facet without an area claims nothing.

pub(crate) mod edges;
mod welds;

use crate::exchange::ExportedMesh;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::number::vector::{cross, dot, minus};
use crate::number::{Dyadic, Vec3};
use crate::threads;
use crate::verify::lookup::boxes::Boxes;
use crate::verify::lookup::places::Places;
use crate::verify::signs::points::Points;
use edges::InputEdge;
use rustc_hash::FxHashMap;
use std::sync::OnceLock;

/// Fewer elements are one thread's work.
const FEW: usize = 1 << 12;

/// A facet.
pub(crate) struct InputFacet {
    /// The edges of its polygons by index in [`Input::edges`], without repetition.
    pub(crate) edges: Vec<usize>,
    /// Its vertices, without repetition.
    pub(crate) vertices: Vec<VertexId>,
    /// Its hole points.
    pub(crate) holes: Vec<VertexId>,
    /// Three of its vertices that are not collinear and span a large triangle; none if all are collinear.
    pub(crate) frame: Option<[VertexId; 3]>,
    /// Whether all vertices lie exactly on the plane of the frame.
    pub(crate) flat: bool,
    /// The largest distance of a vertex from that plane (rounded; 0 if flat).
    pub(crate) bulge: f64,
}

/// The PLC.
pub(crate) struct Input {
    /// The point of each input vertex.
    pub(crate) site_of: Vec<VertexId>,
    /// Whether a point is an input vertex.
    pub(crate) is_site: Vec<bool>,
    /// Edges and segments, in order of their ends.
    pub(crate) edges: Vec<InputEdge>,
    /// The facets, as in the PLC.
    pub(crate) facets: Vec<InputFacet>,
    /// The points of the hole points.
    pub(crate) holes: Vec<VertexId>,
    /// The points of the region points.
    pub(crate) regions: Vec<VertexId>,
    /// Used mesh vertices that are doubles, and others at the same places before them.
    pub(crate) coincident: Vec<[VertexId; 2]>,
    /// Where the used mesh vertices are that are doubles, and the input vertices that are none.
    pub(crate) places: Places,
    /// Input vertices that are taken for others, as the mesh has them welded.
    pub(crate) welded: usize,
    /// The facets that are equal to an earlier one, with the first such, in increasing order.
    repeated: Vec<(usize, usize)>,
    /// The same the other way round.
    repeats: Vec<(usize, usize)>,
    /// The boxes of the facets; of use where facets overlap only.
    boxes: OnceLock<Boxes>,
}

impl Input {
    /// `used[v]` says whether mesh vertex v is in a tetrahedron. `exact` are those that are not where their doubles
    /// say. Input vertices that the mesh has not may have been welded to others, to a `precision`.
    pub(crate) fn new(
        plc: &Plc,
        used: &[bool],
        mesh: &ExportedMesh,
        exact: FxHashMap<VertexId, Vec3<Dyadic>>,
        precision: f64,
    ) -> (Input, Points) {
        // The vertices of the mesh, then the other points of the input.
        let mut coordinates = mesh.vertices.clone();
        let mut places = Places::new(coordinates.len() + plc.vertices.len());
        let mut coincident = Vec::new();
        for (v, &p) in coordinates.iter().enumerate() {
            let v = VertexId::new(v);
            if used[v.index()] && (exact.is_empty() || !exact.contains_key(&v)) {
                let first = places.first_at(&coordinates, p, v);
                if first != v {
                    coincident.push([first, v]);
                }
            }
        }
        let mut site_of = Vec::with_capacity(plc.vertices.len());
        // Most input vertices are the mesh vertices with their numbers, which are the first ones there if none
        // coincide.
        let is_same = |i: usize, p: [f64; 3]| {
            coincident.is_empty()
                && exact.is_empty()
                && used.get(i).is_some_and(|&used| used)
                && mesh.vertices[i] == p
        };
        for (i, &p) in plc.vertices.iter().enumerate() {
            if is_same(i, p) {
                site_of.push(VertexId::new(i));
                continue;
            }
            let new = VertexId::new(coordinates.len());
            let site = places.first_at(&coordinates, p, new);
            if site == new {
                coordinates.push(p);
            }
            site_of.push(site);
        }
        let is_used = |v: VertexId| used.get(v.index()).is_some_and(|&used| used);
        let welded = welds::find(plc, &mut site_of, is_used, precision);
        let mut add = |p: [f64; 3]| {
            coordinates.push(p);
            VertexId::new(coordinates.len() - 1)
        };
        let holes = plc.holes.iter().map(|&p| add(p)).collect();
        let regions = plc.regions.iter().map(|r| add(r.point)).collect();
        let facet_holes: Vec<Vec<VertexId>> = plc
            .facets
            .iter()
            .map(|f| f.holes.iter().map(|&p| add(p)).collect())
            .collect();
        let points = Points::new(coordinates).with_exact(exact);
        let mut is_site = vec![
            false;
            used.len()
                .max(site_of.iter().map(|v| v.index() + 1).max().unwrap_or(0))
        ];
        for v in &site_of {
            is_site[v.index()] = true;
        }
        let shapes = threads::each(plc.facets.iter(), FEW, |facet| {
            let corners = facet.polygons.iter().flatten();
            let mut vertices: Vec<VertexId> = corners.map(|v| site_of[v.index()]).collect();
            vertices.sort_unstable();
            vertices.dedup();
            let frame = frame(&points, &vertices);
            (vertices, frame)
        });
        let has_area = |f: usize| shapes[f].1.is_some();
        let edges::Edges {
            edges,
            of_facet,
            repeated,
        } = edges::all(plc, &points, &site_of, has_area);
        let mut repeats: Vec<(usize, usize)> = repeated.iter().map(|&(f, g)| (g, f)).collect();
        repeats.sort_unstable();
        let parts = shapes.into_iter().zip(of_facet).zip(facet_holes);
        let facets = threads::each(parts, FEW, |(((vertices, frame), edges), holes)| {
            let flat = frame.is_some_and(|[a, b, c]| {
                let mut vertices = vertices.iter();
                vertices.all(|&v| points.is_on_plane([a, b, c], v))
            });
            let bulge = frame.filter(|_| !flat).map_or(0.0, |f| {
                let distances = vertices.iter().map(|&v| points.distance_to_plane(f, v));
                distances.fold(0.0, f64::max)
            });
            InputFacet {
                edges,
                vertices,
                holes,
                frame,
                flat,
                bulge,
            }
        });
        (
            Input {
                site_of,
                is_site,
                edges,
                facets,
                holes,
                regions,
                coincident,
                welded,
                places,
                repeats,
                boxes: OnceLock::new(),
                repeated,
            },
            points,
        )
    }

    /// How many facets are equal to earlier ones.
    pub(crate) fn repeated(&self) -> usize {
        self.repeated.len()
    }

    /// Whether the facet is equal to an earlier one, which stands for both.
    pub(crate) fn is_repeated(&self, facet: usize) -> bool {
        !self.repeated.is_empty() && self.repeated.binary_search_by_key(&facet, |r| r.0).is_ok()
    }

    /// The facets, without repetitions, whose boxes meet that of some points.
    pub(crate) fn facets_near(&self, points: &Points, near: &[VertexId]) -> Vec<usize> {
        let boxes = self.boxes.get_or_init(|| {
            let facets = self.facets.iter();
            Boxes::new(facets.map(|f| points.bounds(&f.vertices)).collect())
        });
        let mut found = Vec::new();
        boxes.meeting_box(&points.bounds(near), &mut found);
        found.sort_unstable();
        let facets = found.into_iter().map(|f| f as usize);
        facets.filter(|&f| !self.is_repeated(f)).collect()
    }

    /// The markers of a facet and of those that are equal to it, without repetition, in increasing order.
    pub(crate) fn markers_of(&self, plc: &Plc, facet: usize) -> Vec<i64> {
        let start = self.repeats.partition_point(|r| r.0 < facet);
        let others = self.repeats[start..].iter().take_while(|r| r.0 == facet);
        let all = std::iter::once(facet).chain(others.map(|r| r.1));
        let mut markers: Vec<i64> = all.map(|f| plc.facets[f].marker).collect();
        markers.sort_unstable();
        markers.dedup();
        markers
    }

    /// Whether the point is an input vertex.
    pub(crate) fn is_site(&self, v: VertexId) -> bool {
        self.is_site.get(v.index()).copied().unwrap_or(false)
    }
}

/// The first vertex, the one farthest from it, and the one that makes the largest triangle with both; exactly not
/// collinear, or none.
pub(crate) fn frame(points: &Points, vertices: &[VertexId]) -> Option<[VertexId; 3]> {
    let (&a, rest) = vertices.split_first()?;
    let origin = points.at(a);
    let farthest = |v: &VertexId| {
        let d = minus(points.at(*v), origin);
        dot(d, d)
    };
    let b = *rest
        .iter()
        .max_by(|v, w| farthest(v).total_cmp(&farthest(w)))?;
    let along = minus(points.at(b), origin);
    let area = |v: &VertexId| {
        let n = cross(along, minus(points.at(*v), origin));
        dot(n, n)
    };
    let c = *rest.iter().max_by(|v, w| area(v).total_cmp(&area(w)))?;
    if !points.collinear([a, b, c]) {
        return Some([a, b, c]);
    }
    // Rounding may have hidden the only vertex off the line.
    let c = *rest.iter().find(|&&v| !points.collinear([a, b, v]))?;
    Some([a, b, c])
}
