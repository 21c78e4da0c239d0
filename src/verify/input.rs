//! The PLC in terms of the points of the mesh: every input vertex is the used mesh vertex with the same coordinates, or
//! a point of its own if there is none.

use crate::exchange::ExportedMesh;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::number::vector::{cross, dot, minus};
use crate::number::{Dyadic, Vec3};
use crate::threads;
use crate::verify::lookup::places::Places;
use crate::verify::lookup::tables::sorted2;
use crate::verify::signs::points::Points;
use rustc_hash::FxHashMap;

/// Fewer elements are one thread's work.
const FEW: usize = 1 << 12;

/// An edge of facets or a segment given for itself; several coinciding ones are one.
pub(crate) struct InputEdge {
    /// Its ends, smaller first.
    pub(crate) ends: [VertexId; 2],
    /// The facets that have it as an edge of one of their polygons, in increasing order.
    pub(crate) facets: Vec<usize>,
    /// Whether [`Plc::segments`] or a polygon with two vertices lists it.
    pub(crate) explicit: bool,
}

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
}

impl Input {
    /// `used[v]` says whether mesh vertex v is in a tetrahedron. `exact` are those that are not where their doubles
    /// say.
    pub(crate) fn new(
        plc: &Plc,
        used: &[bool],
        mesh: &ExportedMesh,
        exact: FxHashMap<VertexId, Vec3<Dyadic>>,
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
        let (edges, edges_of) = edges(plc, &site_of);
        let parts = plc.facets.iter().zip(edges_of).zip(facet_holes);
        let facets = threads::each(parts, FEW, |((facet, edges), holes)| {
            let corners = facet.polygons.iter().flatten();
            let mut vertices: Vec<VertexId> = corners.map(|v| site_of[v.index()]).collect();
            vertices.sort_unstable();
            vertices.dedup();
            let frame = frame(&points, &vertices);
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
                places,
            },
            points,
        )
    }

    /// Whether the point is an input vertex.
    pub(crate) fn is_site(&self, v: VertexId) -> bool {
        self.is_site.get(v.index()).copied().unwrap_or(false)
    }
}

/// All edges, and for each facet the indices of its own.
fn edges(plc: &Plc, site_of: &[VertexId]) -> (Vec<InputEdge>, Vec<Vec<usize>>) {
    // (ends, facet, whether it is listed for itself), where no facet comes last.
    let mut uses: Vec<([VertexId; 2], u32, bool)> = Vec::new();
    let key = |a: VertexId, b: VertexId| sorted2([site_of[a.index()], site_of[b.index()]]);
    for (f, facet) in plc.facets.iter().enumerate() {
        for polygon in &facet.polygons {
            let n = polygon.len();
            // A polygon with two vertices is one edge, and one vertex is none.
            for i in 0..if n == 2 { 1 } else { n } {
                uses.push((key(polygon[i], polygon[(i + 1) % n]), f as u32, n == 2));
            }
        }
    }
    let segments = plc.segments.iter();
    uses.extend(segments.map(|s| (key(s.ends[0], s.ends[1]), u32::MAX, true)));
    uses.retain(|(ends, ..)| ends[0] != ends[1]);
    threads::sort(&mut uses, FEW);
    let mut of_facet = vec![Vec::new(); plc.facets.len()];
    let mut edges: Vec<InputEdge> = Vec::new();
    for uses in uses.chunk_by(|x, y| x.0 == y.0) {
        let facets = uses.iter().map(|u| u.1 as usize);
        let mut facets: Vec<usize> = facets.filter(|&f| f != u32::MAX as usize).collect();
        facets.dedup();
        for &f in &facets {
            of_facet[f].push(edges.len());
        }
        edges.push(InputEdge {
            ends: uses[0].0,
            facets,
            explicit: uses.iter().any(|u| u.2),
        });
    }
    (edges, of_facet)
}

/// The first vertex, the one farthest from it, and the one that makes the largest triangle with both; exactly not
/// collinear, or none.
fn frame(points: &Points, vertices: &[VertexId]) -> Option<[VertexId; 3]> {
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
