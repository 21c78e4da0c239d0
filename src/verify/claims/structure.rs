//! Indices are in range, coordinates are finite, no tetrahedron repeats a vertex. Nothing else is checked where this
//! fails.

use crate::exchange::ExportedMesh;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::verify::options::MOST_TETS;
use crate::verify::place::Place;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// Sides of faces are numbered in 32 bits.
fn check_size(tets: usize, findings: &mut Findings) {
    if tets > MOST_TETS {
        findings.report(Violation::TooManyTets { tets });
    }
}

pub(crate) fn check(plc: &Plc, mesh: &ExportedMesh, findings: &mut Findings) {
    check_size(mesh.tets.len(), findings);
    let finite = |findings: &mut Findings,
                  element: &'static str,
                  places: &mut dyn Iterator<Item = [f64; 3]>| {
        for (index, at) in places.enumerate() {
            if at.iter().any(|x| !x.is_finite()) {
                findings.report(Violation::NotFinite { element, index, at });
            }
        }
    };
    finite(findings, "mesh vertex", &mut mesh.vertices.iter().copied());
    finite(findings, "input vertex", &mut plc.vertices.iter().copied());
    finite(findings, "hole point", &mut plc.holes.iter().copied());
    finite(
        findings,
        "region point",
        &mut plc.regions.iter().map(|r| r.point),
    );
    finite(
        findings,
        "facet hole point",
        &mut plc.facets.iter().flat_map(|f| f.holes.iter().copied()),
    );

    let mut range = |element: &'static str, index: usize, ids: &[VertexId], vertices: usize| {
        for id in ids {
            if id.index() >= vertices {
                let vertex = id.index();
                findings.report(Violation::IndexOutOfRange {
                    element,
                    index,
                    vertex,
                    vertices,
                });
            }
        }
    };
    let (n, m) = (mesh.vertices.len(), plc.vertices.len());
    // One pass without branches, as a rule.
    let greatest = mesh.tets.iter().flatten().fold(0, |m, v| m.max(v.0));
    if greatest as usize >= n {
        for (i, t) in mesh.tets.iter().enumerate() {
            range("tetrahedron", i, t, n);
        }
    }
    mesh.faces
        .iter()
        .enumerate()
        .for_each(|(i, f)| range("mesh face", i, &f.vertices, n));
    mesh.edges
        .iter()
        .enumerate()
        .for_each(|(i, e)| range("mesh edge", i, &e.vertices, n));
    mesh.exact
        .iter()
        .enumerate()
        .for_each(|(i, p)| range("exact position", i, &[p.vertex, p.ends[0], p.ends[1]], n));
    plc.segments
        .iter()
        .enumerate()
        .for_each(|(i, s)| range("segment", i, &s.ends, m));
    for (i, facet) in plc.facets.iter().enumerate() {
        facet.polygons.iter().for_each(|p| range("facet", i, p, m));
    }
    if !findings.is_empty() {
        return;
    }
    for (tet, &[a, b, c, d]) in mesh.tets.iter().enumerate() {
        if (a == b) | (a == c) | (a == d) | (b == c) | (b == d) | (c == d) {
            let id = match () {
                () if (a == b) | (a == c) | (a == d) => a,
                () if (b == c) | (b == d) => b,
                () => c,
            };
            let vertex = Place {
                id,
                at: mesh.vertices[id.index()],
            };
            findings.report(Violation::RepeatedVertex { tet, vertex });
        }
    }
    if !mesh.regions.is_empty() && mesh.regions.len() != mesh.tets.len() {
        findings.report(Violation::RegionCount {
            regions: mesh.regions.len(),
            tets: mesh.tets.len(),
        });
    }
    if mesh.tets.is_empty() {
        findings.report(Violation::Empty);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_many_tetrahedra_are_a_violation() {
        let verdict = |tets| {
            let mut findings = Findings::new(1);
            check_size(tets, &mut findings);
            findings.verdict()
        };
        assert!(verdict(MOST_TETS).violations.is_empty());
        let expected = Violation::TooManyTets { tets: 1 << 29 };
        assert_eq!(verdict(1 << 29).violations, [expected]);
    }
}
