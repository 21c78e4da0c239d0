//! The faces and edges that the mesh lists are faces and edges of its tetrahedra.
//!
//! That they cover facets and segments is not believed, but they are where a cover is looked for first.

use crate::exchange::ExportedMesh;
use crate::mesh::VertexId;
use crate::threads;
use crate::verify::case::Case;
use crate::verify::lookup::surface::Surface;
use crate::verify::lookup::tables::sorted2;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// Fewer elements are one thread's work.
const FEW: usize = 1 << 12;

/// What the mesh lists.
pub(crate) struct Listed {
    /// Where each of its faces is in the tables, if it has it.
    pub(crate) places: Vec<Option<usize>>,
    /// The faces that it lists and has, and their edges.
    pub(crate) surface: Surface,
    /// The edges that it lists and has: those of vertex v are `ends[start[v]..start[v + 1]]`.
    start: Vec<u32>,
    ends: Vec<VertexId>,
}

impl Listed {
    /// Whether any edge is listed.
    pub(crate) fn has_edges(&self) -> bool {
        !self.ends.is_empty()
    }

    /// The other ends of the listed edges at a vertex, in the order of the list.
    pub(crate) fn neighbours(&self, v: VertexId) -> &[VertexId] {
        match self.start.get(v.index()..v.index() + 2) {
            Some(&[start, end]) => &self.ends[start as usize..end as usize],
            _ => &[],
        }
    }

    /// Whether an edge is listed.
    pub(crate) fn has(&self, [a, b]: [VertexId; 2]) -> bool {
        let [at_a, at_b] = [a, b].map(|v| self.neighbours(v));
        match at_a.len() <= at_b.len() {
            true => at_a.contains(&b),
            false => at_b.contains(&a),
        }
    }
}

/// Whether a vertex is in a listed face.
pub(crate) fn vertices(mesh: &ExportedMesh, vertices: usize) -> Vec<bool> {
    let mut listed = vec![false; vertices];
    for v in mesh.faces.iter().flat_map(|f| f.vertices) {
        listed[v.index()] = true;
    }
    listed
}

pub(crate) fn check(case: &Case, findings: &mut Findings) -> Listed {
    let places = threads::map(case.mesh.faces.len(), FEW, |i| {
        case.tables.find_face(case.mesh.faces[i].vertices)
    });
    let mut faces = Vec::with_capacity(places.len());
    for (index, place) in places.iter().enumerate() {
        match *place {
            None => findings.report(Violation::ListedNotInMesh {
                element: "face",
                index,
            }),
            Some(f) => faces.push(f as u32),
        }
    }
    faces.sort_unstable();
    faces.dedup();
    // Without facets and segments nothing will be asked.
    if case.input.edges.is_empty() {
        faces.clear();
    }
    let surface = Surface::new(case.points.len(), case.tables, faces);
    let is_edge = threads::map(case.mesh.edges.len(), FEW, |i| {
        let edge = sorted2(case.mesh.edges[i].vertices);
        edge[0] != edge[1] && (surface.has_edge(edge) || case.tables.has_edge(edge))
    });
    let mut edges = Vec::with_capacity(case.mesh.edges.len());
    let mut start = vec![0u32; case.mesh.vertices.len() + 1];
    for (index, edge) in case.mesh.edges.iter().enumerate() {
        let edge = sorted2(edge.vertices);
        if !is_edge[index] {
            findings.report(Violation::ListedNotInMesh {
                element: "edge",
                index,
            });
            continue;
        }
        edges.push(edge);
        edge.iter().for_each(|v| start[v.index() + 1] += 1);
    }
    for i in 1..start.len() {
        start[i] += start[i - 1];
    }
    let mut next = start.clone();
    let mut ends = vec![VertexId::INFINITE; 2 * edges.len()];
    for &[a, b] in &edges {
        for (v, w) in [(a, b), (b, a)] {
            let place = &mut next[v.index()];
            ends[*place as usize] = w;
            *place += 1;
        }
    }
    Listed {
        places,
        surface,
        start,
        ends,
    }
}
