//! The one call repairs what is exactly repairable, says so, and refuses it if it is to be strict; the mesh is verified
//! against the input as it was given. What really crosses stays an error.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tetflip::cdt::{MeshError, MeshOptions, Meshed};
use tetflip::check::check;
use tetflip::exchange::{ExportedMesh, Facet, NoteCode, Plc, Segment};
use tetflip::mesh::VertexId;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// The faces of a box whose corner i has the high coordinate k where bit k of i is set, turned outward.
const FACES: [[u32; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

fn facet(corners: &[u32]) -> Facet {
    Facet {
        polygons: vec![corners.iter().map(|&v| VertexId(v)).collect()],
        ..Facet::default()
    }
}

/// A box with vertices of its own.
fn add_box(plc: &mut Plc, low: [f64; 3], high: [f64; 3], triangles: bool, marker: i64) {
    let first = plc.vertices.len() as u32;
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
    plc.vertices.extend((0..8).map(corner));
    for [a, b, c, d] in FACES.map(|face| face.map(|v| v + first)) {
        let pieces = match triangles {
            true => vec![facet(&[a, b, c]), facet(&[a, c, d])],
            false => vec![facet(&[a, b, c, d])],
        };
        let marked = pieces.into_iter().map(|facet| Facet { marker, ..facet });
        plc.facets.extend(marked);
    }
}

/// A box of the given size with vertices 0 to 7, made of quadrilaterals.
fn a_box(high: [f64; 3]) -> Plc {
    let mut plc = Plc::default();
    add_box(&mut plc, [0.0; 3], high, false, 0);
    plc
}

fn volume(mesh: &ExportedMesh) -> f64 {
    let of = |tet: &[VertexId; 4]| {
        let [a, b, c, d] = tet.map(|v| mesh.vertices[v.index()]);
        let [u, v, w] = [b, c, d].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
        let cross = [
            v[1] * w[2] - v[2] * w[1],
            v[2] * w[0] - v[0] * w[2],
            v[0] * w[1] - v[1] * w[0],
        ];
        (u[0] * cross[0] + u[1] * cross[1] + u[2] * cross[2]) / 6.0
    };
    mesh.tets.iter().map(of).sum()
}

const STRICT: MeshOptions = MeshOptions {
    strict: true,
    ..MeshOptions::DEFAULT
};

/// Why the verifier refuses a mesh of an input.
fn refused(plc: &Plc, mesh: &ExportedMesh, domain: Domain) -> Option<String> {
    let options = VerifyOptions {
        domain,
        ..VerifyOptions::default()
    };
    let verdict = verify(plc, mesh, options);
    (!verdict.is_ok()).then(|| verdict.to_string())
}

/// Meshes an input that needs a repair, which a strict run refuses and the check announces; the mesh has the given
/// volume, and the notes these codes.
fn repaired(plc: &Plc, expected_volume: f64, codes: &[NoteCode]) -> Meshed {
    let findings = check(plc, None);
    assert!(!findings.is_valid() && findings.is_repairable());
    let strict = tetflip::mesh(plc, &STRICT).expect_err("it needs a repair");
    assert!(strict.is_of_input() && strict.is_repairable(), "{strict}");
    let mut first = None;
    for merge_coplanar in [true, false] {
        let options = MeshOptions {
            merge_coplanar,
            ..MeshOptions::default()
        };
        let meshed = tetflip::mesh(plc, &options).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(refused(plc, &meshed.mesh, Domain::Inside), None);
        assert!((volume(&meshed.mesh) - expected_volume).abs() < 1e-12);
        let found: Vec<NoteCode> = meshed.notes().iter().map(|note| note.code).collect();
        assert_eq!(found, codes);
        assert_eq!(meshed.report.input_facets, plc.facets.len());
        first.get_or_insert(meshed);
    }
    let hull = MeshOptions {
        keep_hull: true,
        ..MeshOptions::default()
    };
    let hull = tetflip::mesh(plc, &hull).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(refused(plc, &hull.mesh, Domain::Hull), None);
    first.expect("two runs")
}

/// What a run says that has to fail.
fn fails(plc: &Plc, options: &MeshOptions) -> MeshError {
    tetflip::mesh(plc, options).expect_err("it has to be refused")
}

#[test]
fn a_vertex_on_an_edge_of_the_neighbour() {
    let mut plc = a_box([2.0, 1.0, 1.0]);
    plc.vertices.push([1.0, 0.0, 0.0]);
    plc.facets[0] = facet(&[0, 2, 3, 1, 8]);
    let meshed = repaired(&plc, 2.0, &[NoteCode::VertexOnEdge]);
    let note = &meshed.notes()[0];
    assert!(note.text.contains("vertex 8 on edge 0-1"), "{}", note.text);
    assert_eq!((note.count, &note.vertices[..]), (1, &[8][..]));
    // In steps of thirds, which are no doubles, there is a gap, and nothing to repair.
    plc.vertices[8] = [2.0 / 3.0, 1e-16, 0.0];
    assert!(fails(&plc, &MeshOptions::default()).is_of_input());
}

#[test]
fn a_vertex_on_a_facet() {
    let mut plc = a_box([1.0; 3]);
    plc.vertices.push([0.5, 0.25, 1.0]);
    let meshed = repaired(&plc, 1.0, &[NoteCode::VertexOnFacet]);
    assert!(
        meshed
            .mesh
            .faces
            .iter()
            .any(|f| f.vertices.contains(&VertexId(8)))
    );
}

#[test]
fn an_edge_in_a_facet() {
    let mut plc = a_box([4.0, 4.0, 2.0]);
    plc.vertices
        .extend([[1.0, 1.0, 0.0], [3.0, 2.0, 0.0], [2.0, 1.5, 1.0]]);
    plc.facets.push(facet(&[8, 9, 10]));
    let codes = [
        NoteCode::VertexOnFacet,
        NoteCode::EdgeInFacet,
        NoteCode::OpenEdges,
    ];
    let meshed = repaired(&plc, 32.0, &codes);
    let edge = [8, 9].map(VertexId);
    assert!(meshed.mesh.edges.iter().any(|e| e.vertices == edge));
}

#[test]
fn a_wall_on_a_floor() {
    let mut plc = a_box([4.0, 2.0, 2.0]);
    let wall = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|[y, z]| [1.0, y, z]);
    plc.vertices.extend(wall);
    plc.facets.push(facet(&[8, 9, 10, 11]));
    let codes = [NoteCode::VertexOnEdge, NoteCode::EdgeInFacet];
    let meshed = repaired(&plc, 16.0, &codes);
    assert_eq!(meshed.report.output_regions, 2);
}

#[test]
fn a_box_on_a_box() {
    let mut plc = Plc {
        first_index: 1,
        ..Plc::default()
    };
    add_box(&mut plc, [0.0; 3], [6.0, 6.0, 2.0], false, 1);
    add_box(&mut plc, [1.0, 2.0, 2.0], [4.0, 4.0, 7.0], true, 2);
    let codes = [
        NoteCode::VertexOnFacet,
        NoteCode::EdgeInFacet,
        NoteCode::FacetsOverlap,
    ];
    let meshed = repaired(&plc, 102.0, &codes);
    assert_eq!(meshed.report.output_regions, 2);
    // The table of faces has facets of the input: the lower box's top, and both triangles of the upper one's bottom.
    let mut shared = Vec::new();
    for (face, sides) in meshed.mesh.faces.iter().zip(&meshed.mesh.face_table.sides) {
        if sides[1] > 0 {
            assert_eq!(face.marker, 1);
            shared.push(face);
        }
    }
    assert!(!shared.is_empty());
    let table = &meshed.mesh.face_table;
    assert!(table.facets.contains(&vec![1, 6, 7]), "{:?}", table.facets);
    assert!(table.markers.iter().any(|(_, markers)| markers == &[1, 2]));
    // Facets outside of the domain have the numbers of the input.
    let mut flag = plc.clone();
    flag.vertices
        .extend([[9.0, 0.0, 0.0], [9.0, 1.0, 0.0], [9.0, 0.0, 1.0]]);
    flag.facets.push(facet(&[16, 17, 18]));
    flag.facets.push(facet(&[16, 18, 17]));
    let error = fails(&flag, &MeshOptions::default());
    assert!(error.to_string().contains("17-18, 17-19, 18-19"), "{error}");
}

#[test]
fn two_solids_with_a_wall_each() {
    let mut plc = Plc::default();
    add_box(&mut plc, [0.0; 3], [1.0; 3], false, 1);
    add_box(&mut plc, [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], false, 2);
    let meshed = repaired(&plc, 2.0, &[NoteCode::RepeatedFacets]);
    assert_eq!(meshed.report.output_regions, 2);
    // One wall, with both facets and both markers.
    let table = &meshed.mesh.face_table;
    let wall = table.facets.iter().position(|of| of == &[5, 10]);
    let polygon = wall.expect("the wall") as u32 + 1;
    assert_eq!(table.markers, [(polygon, vec![1, 2])]);
    // All of it equally marked, and in triangles with other diagonals.
    let mut plc = Plc::default();
    add_box(&mut plc, [0.0; 3], [1.0; 3], true, 0);
    add_box(&mut plc, [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], true, 0);
    let meshed = tetflip::mesh(&plc, &MeshOptions::default()).expect("two cubes");
    assert_eq!(refused(&plc, &meshed.mesh, Domain::Inside), None);
    assert!((volume(&meshed.mesh) - 2.0).abs() < 1e-12);
}

#[test]
fn the_same_facet_again() {
    let mut plc = a_box([1.0; 3]);
    plc.facets.push(facet(&[7, 6, 4, 5]));
    plc.facets.push(facet(&[4, 6, 7, 5]));
    let meshed = repaired(&plc, 1.0, &[NoteCode::RepeatedFacets]);
    assert_eq!(meshed.notes()[0].facets, [1, 6, 7]);
    assert!(meshed.mesh.face_table.facets.contains(&vec![1, 6, 7]));
}

#[test]
fn facets_without_area_and_segments_without_length() {
    let mut plc = a_box([2.0, 1.0, 1.0]);
    plc.vertices.push([1.0, 0.0, 0.0]);
    plc.facets[0] = facet(&[0, 2, 3, 1, 8]);
    plc.facets[2] = facet(&[0, 8, 1, 5, 4]);
    assert!(check(&plc, None).is_valid());
    plc.facets.push(facet(&[0, 1, 0]));
    plc.facets.push(facet(&[0, 8, 1]));
    plc.segments.push(Segment {
        ends: [3, 3].map(VertexId),
        marker: 1,
    });
    let codes = [NoteCode::DegenerateFacets, NoteCode::RepeatedCorner];
    let meshed = repaired(&plc, 2.0, &codes);
    assert_eq!(meshed.notes()[0].count, 3);
}

#[test]
fn repeated_corners() {
    let mut plc = a_box([1.0; 3]);
    // In a row, and the first one at the end.
    plc.facets[0] = facet(&[0, 2, 2, 3, 1]);
    plc.facets[1] = facet(&[4, 5, 7, 6, 4]);
    // The same place with another number.
    plc.vertices.push(plc.vertices[1]);
    plc.facets[2] = facet(&[0, 1, 8, 5, 4]);
    let meshed = repaired(&plc, 1.0, &[NoteCode::RepeatedCorner]);
    assert_eq!(meshed.notes()[0].count, 3);
}

#[test]
fn what_crosses_stays_an_error() {
    let options = MeshOptions::default();
    let mut plc = Plc::default();
    add_box(&mut plc, [0.0; 3], [2.0; 3], false, 0);
    add_box(&mut plc, [1.0; 3], [3.0; 3], false, 0);
    let error = fails(&plc, &options);
    assert!(error.is_of_input() && !error.is_repairable());
    assert!(error.to_string().contains("cross"), "{error}");
    // Faces in one plane whose edges cross, beside a wall that is there twice.
    let mut plc = Plc::default();
    add_box(&mut plc, [0.0; 3], [1.0, 3.0, 1.0], true, 0);
    add_box(&mut plc, [1.0, 1.0, -1.0], [2.0, 2.0, 2.0], true, 0);
    plc.facets.push(plc.facets[0].clone());
    let error = fails(&plc, &options);
    assert!(error.is_of_input() && !error.is_repairable());
    let findings = error.findings.expect("what crosses");
    assert!(
        findings
            .conflicts
            .iter()
            .all(|conflict| !conflict.repairable)
    );
    // A fin through a face of an open surface.
    let mut plc = a_box([2.0; 3]);
    plc.facets.pop();
    plc.vertices
        .extend([[1.0, 1.0, 1.0], [1.0, 1.5, 3.0], [1.5, 1.0, 3.0]]);
    plc.facets.push(facet(&[8, 9, 10]));
    let error = fails(&plc, &options);
    assert!(error.to_string().contains("cross"), "{error}");
}

/// One thing that goes wrong in a file.
#[derive(Clone, Debug)]
enum Defect {
    /// A facet is missing.
    Missing(usize),
    /// A facet has a vertex in the middle of an edge, which its neighbours do not have.
    Junction(usize, usize),
    /// A facet is turned around.
    Turned(usize),
    /// A vertex is elsewhere.
    Shifted(usize, [i8; 3]),
    /// A facet is there twice.
    Twice(usize),
    /// A facet has vertices of its own.
    Apart(usize),
    /// A vertex in the middle of a facet, which nobody has.
    Inside(usize),
    /// A facet with any three vertices.
    Any([usize; 3]),
}

fn defect() -> impl Strategy<Value = Defect> {
    let i = || 0..1000usize;
    prop_oneof![
        2 => i().prop_map(Defect::Missing),
        3 => (i(), i()).prop_map(|(f, e)| Defect::Junction(f, e)),
        2 => i().prop_map(Defect::Turned),
        2 => (i(), [-1..2i8, -1..2i8, -1..2i8]).prop_map(|(v, by)| Defect::Shifted(v, by)),
        1 => i().prop_map(Defect::Twice),
        1 => i().prop_map(Defect::Apart),
        1 => i().prop_map(Defect::Inside),
        1 => [i(), i(), i()].prop_map(Defect::Any),
    ]
}

fn spoil(plc: &mut Plc, defect: &Defect) {
    let n = plc.facets.len();
    let middle = |plc: &Plc, corners: &[VertexId]| {
        let sum = |k: usize| {
            corners
                .iter()
                .map(|v| plc.vertices[v.index()][k])
                .sum::<f64>()
        };
        [0, 1, 2].map(|k| sum(k) / corners.len() as f64)
    };
    match *defect {
        Defect::Missing(f) => drop(plc.facets.remove(f % n)),
        Defect::Junction(f, e) => {
            let corners = plc.facets[f % n].polygons[0].clone();
            let e = e % corners.len();
            let ends = [corners[e], corners[(e + 1) % corners.len()]];
            let v = VertexId::new(plc.vertices.len());
            plc.vertices.push(middle(plc, &ends));
            plc.facets[f % n].polygons[0].insert(e + 1, v);
        }
        Defect::Turned(f) => plc.facets[f % n].polygons[0].reverse(),
        Defect::Shifted(v, by) => {
            let v = v % plc.vertices.len();
            (0..3).for_each(|k| plc.vertices[v][k] += f64::from(by[k]));
        }
        Defect::Twice(f) => plc.facets.push(plc.facets[f % n].clone()),
        Defect::Apart(f) => {
            for v in &mut plc.facets[f % n].polygons[0] {
                plc.vertices.push(plc.vertices[v.index()]);
                *v = VertexId::new(plc.vertices.len() - 1);
            }
        }
        Defect::Inside(f) => {
            let corners = plc.facets[f % n].polygons[0].clone();
            plc.vertices.push(middle(plc, &corners[..3]));
        }
        Defect::Any(corners) => {
            let ids = corners.map(|v| (v % plc.vertices.len()) as u32);
            plc.facets.push(facet(&ids));
        }
    }
}

/// Boxes in a row, some of triangles, with walls of their own where they touch or apart.
fn boxes() -> impl Strategy<Value = Plc> {
    let one = (
        prop::array::uniform3(1..4i32),
        any::<bool>(),
        0..3i32,
        0..2i64,
    );
    prop::collection::vec(one, 1..4).prop_map(|list| {
        let (mut plc, mut x) = (Plc::default(), 0.0);
        for (size, triangles, gap, marker) in list {
            x += f64::from(gap / 2);
            let [a, b, c] = size.map(f64::from);
            add_box(&mut plc, [x, 0.0, 0.0], [x + a, b, c], triangles, marker);
            x += a;
        }
        plc
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::with_cases(1500)
    })]

    /// Whatever is wrong, the input is refused with an error that says why, or the mesh is right for the verifier,
    /// which reads the input as it is.
    #[test]
    fn a_defect_is_refused_or_does_no_harm(
        plc in boxes(),
        defects in prop::collection::vec(defect(), 1..4),
        choices in any::<[bool; 2]>(),
    ) {
        let mut plc = plc;
        defects.iter().for_each(|defect| spoil(&mut plc, defect));
        let [keep_hull, merge_coplanar] = choices;
        let options = MeshOptions { keep_hull, merge_coplanar, ..MeshOptions::default() };
        match tetflip::mesh(&plc, &options) {
            Ok(meshed) => {
                let domain = if keep_hull { Domain::Hull } else { Domain::Inside };
                prop_assert_eq!(refused(&plc, &meshed.mesh, domain), None);
                let strict = tetflip::mesh(&plc, &MeshOptions { strict: true, ..options });
                let valid = check(&plc, Some(1)).is_valid();
                prop_assert_eq!(strict.is_ok(), valid);
                if let Ok(strict) = strict {
                    prop_assert_eq!(strict.mesh, meshed.mesh);
                }
            }
            Err(error) => {
                prop_assert!(error.is_of_input(), "{}", error);
                prop_assert!(!error.to_string().is_empty());
            }
        }
    }
}
