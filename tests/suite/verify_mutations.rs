//! Meshes of generated models with one thing altered: the verifier refuses each of them.

use crate::meshes::{assert_kinds, run};
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::generate::{Kind, generate};
use tetflip::mesh::VertexId;
use tetflip::report::Report;
use tetflip::verify::{Verdict, VerifyOptions, verify};

/// Small models with Steiner points, region points, holes and not flat facets among them; with five markers.
fn models() -> Vec<(Plc, ExportedMesh)> {
    let kinds = [
        Kind::Bracket,
        Kind::Cheese,
        Kind::Cells,
        Kind::Schoenhardt,
        Kind::Bend,
        Kind::Star,
    ];
    let models = kinds.into_iter().map(|kind| {
        let mut plc = generate(kind, 2, 40);
        for (i, facet) in plc.facets.iter_mut().enumerate() {
            facet.marker = 10 + (i % 5) as i64;
        }
        let mesh = meshed(&plc);
        assert_kinds(&run(&plc, &mesh), &[]);
        (plc, mesh)
    });
    models.collect()
}

fn meshed(plc: &Plc) -> ExportedMesh {
    tetrahedralize(
        plc,
        &Options::default(),
        &mut Report::default(),
        &mut |_| (),
    )
    .expect("a mesh")
}

/// A few numbers below `n`, the same on every run.
fn some(n: usize) -> impl Iterator<Item = usize> {
    (0..n.min(12)).map(move |i| (i * 7919 + 3) % n)
}

#[track_caller]
fn assert_refused(verdict: &Verdict, what: &str) {
    assert!(!verdict.is_ok(), "{what}: {verdict}");
}

#[test]
fn no_marker_face_or_tetrahedron_is_altered_unnoticed() {
    for (plc, mesh) in models() {
        for f in some(mesh.faces.len()) {
            let mut altered = mesh.clone();
            altered.faces[f].marker += 1;
            let verdict = run(&plc, &altered);
            assert!(verdict.totals.contains_key("wrong marker"), "{verdict}");
            let mut dropped = mesh.clone();
            dropped.faces.remove(f);
            assert_refused(&run(&plc, &dropped), "a face is not listed");
            let other = (f + 1) % mesh.faces.len();
            if mesh.faces[f].marker != mesh.faces[other].marker {
                let mut swapped = mesh.clone();
                swapped.faces[f].marker = mesh.faces[other].marker;
                swapped.faces[other].marker = mesh.faces[f].marker;
                assert_refused(&run(&plc, &swapped), "two faces have each other's markers");
            }
        }
        for t in some(mesh.tets.len()) {
            let mut missing = mesh.clone();
            missing.tets.remove(t);
            if !missing.regions.is_empty() {
                missing.regions.remove(t);
            }
            assert_refused(&run(&plc, &missing), "a tetrahedron is missing");
            // Any inner face of it in place of a listed one.
            let [a, b, c, d] = mesh.tets[t];
            for face in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
                let same = |v: &[VertexId; 3]| face.iter().all(|x| v.contains(x));
                if !mesh.faces.iter().any(|f| same(&f.vertices)) {
                    let mut swapped = mesh.clone();
                    swapped.faces[t % mesh.faces.len()].vertices = face;
                    assert_refused(&run(&plc, &swapped), "an inner face is listed");
                }
            }
        }
    }
}

/// Vertices of the input by a little, Steiner points by more than the tolerance.
#[test]
fn no_vertex_moves_unnoticed() {
    for (plc, mesh) in models() {
        let input = plc.vertices.len();
        for v in some(mesh.vertices.len()) {
            let mut moved = mesh.clone();
            let [x, y, z] = moved.vertices[v];
            moved.vertices[v] = match v < input {
                true => [x, y.next_up(), z],
                false => [x + 1e-9, y + 2e-9, z - 3e-9],
            };
            assert_refused(&run(&plc, &moved), "a vertex has moved");
        }
    }
}

/// A region that the input calls a hole is meshed.
#[test]
fn no_filled_hole_is_accepted() {
    let mut holes = 0;
    for (mut plc, mesh) in models() {
        let regions = std::mem::take(&mut plc.regions);
        for region in regions {
            plc.holes = vec![region.point];
            let verdict = run(&plc, &mesh);
            assert!(verdict.totals.contains_key("hole meshed"), "{verdict}");
            holes += 1;
        }
    }
    assert!(holes > 0, "no model has a region");
}

/// The convex hull in place of the inside.
#[test]
fn no_hull_is_accepted_for_a_solid() {
    for kind in [Kind::Bracket, Kind::Star, Kind::Bend] {
        let plc = generate(kind, 2, 40);
        let options = Options {
            keep_hull: true,
            ..Options::default()
        };
        let hull = tetrahedralize(&plc, &options, &mut Report::default(), &mut |_| ());
        let hull = hull.expect("a mesh");
        let verdict = run(&plc, &hull);
        assert_refused(&verdict, "the hull");
        assert!(verdict.counts.fills_hull, "{verdict}");
        let asked = VerifyOptions {
            domain: tetflip::verify::Domain::Hull,
            ..VerifyOptions::default()
        };
        assert_kinds(&verify(&plc, &hull, asked), &[]);
        // Also without a list of its faces, where other surfaces cover facets that are not flat.
        let bare = ExportedMesh {
            faces: Vec::new(),
            ..hull
        };
        assert_kinds(&verify(&plc, &bare, asked), &[]);
    }
}

/// Where both sides of a shim on a facet are on the hull, both are listed: one of them covers the facet.
#[test]
fn hulls_of_bent_pipes_are_accepted() {
    for (seed, size) in [(3, 60), (1, 80), (2, 80)] {
        let plc = generate(Kind::Bend, seed, size);
        let options = Options {
            keep_hull: true,
            ..Options::default()
        };
        let hull = tetrahedralize(&plc, &options, &mut Report::default(), &mut |_| ());
        let mut hull = hull.expect("a mesh");
        let asked = VerifyOptions {
            domain: tetflip::verify::Domain::Hull,
            ..VerifyOptions::default()
        };
        assert_kinds(&verify(&plc, &hull, asked), &[]);
        hull.faces.clear();
        assert_kinds(&verify(&plc, &hull, asked), &[]);
    }
}
