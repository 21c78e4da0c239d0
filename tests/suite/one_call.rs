//! The one call for users: no input makes it panic, and nothing that vertices carry is lost.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tetflip::cdt::{MeshOptions, SteinerChoice};
use tetflip::exchange::{Attributes, Facet, NoteCode, Plc, Region, Segment};
use tetflip::format::{MeshFileError, write_mesh_to};
use tetflip::mesh::VertexId;
use tetflip::recover::polygons::{FlipOrder, Insertion};

/// Coordinates: mostly small integers, so that vertices coincide and facets are flat, and everything that can go wrong.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        12 => (0..4i32).prop_map(f64::from),
        1 => prop::sample::select(vec![
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN,
            1e300,
            5e-324,
            -0.0,
        ]),
    ]
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(coordinate())
}

/// An id, which need not exist.
fn id() -> impl Strategy<Value = VertexId> {
    prop_oneof![
        30 => (0..12u32).prop_map(VertexId),
        1 => prop::sample::select(vec![VertexId(40), VertexId(u32::MAX - 1), VertexId::INFINITE]),
    ]
}

fn facet() -> impl Strategy<Value = Facet> {
    let polygon = prop::collection::vec(id(), 0..6);
    let polygons = prop_oneof![
        4 => prop::collection::vec(prop::collection::vec(id(), 3..5), 1..2),
        1 => prop::collection::vec(polygon, 0..3),
    ];
    (polygons, prop::collection::vec(point(), 0..2), any::<i64>()).prop_map(
        |(polygons, holes, marker)| Facet {
            polygons,
            holes: if marker % 7 == 0 { holes } else { Vec::new() },
            marker,
        },
    )
}

/// Any PLC that the types allow.
fn any_plc() -> impl Strategy<Value = Plc> {
    let rows = (
        0..3usize,
        prop::collection::vec(coordinate(), 0..30),
        prop::collection::vec(any::<i64>(), 0..12),
        prop::collection::vec(any::<i64>(), 0..12),
        0..4u8,
    );
    let region = (point(), coordinate(), prop::option::of(coordinate()));
    (
        prop::collection::vec(point(), 0..12),
        prop::collection::vec(facet(), 0..10),
        prop::collection::vec(prop::array::uniform2(id()), 0..3),
        prop::collection::vec(point(), 0..2),
        prop::collection::vec(region, 0..2),
        any::<u32>(),
        rows,
    )
        .prop_map(
            |(vertices, facets, segments, holes, regions, first, rows)| {
                let segment = |ends| Segment { ends, marker: 1 };
                let region = |(point, attribute, max_volume)| Region {
                    point,
                    attribute,
                    max_volume,
                };
                let (per_vertex, values, vertex_markers, numbers, which) = rows;
                let with_rows = which == 0;
                Plc {
                    first_index: if which < 2 { first } else { first % 2 },
                    numbers: if with_rows { numbers } else { Vec::new() },
                    attributes: if with_rows {
                        Attributes { per_vertex, values }
                    } else {
                        Attributes::default()
                    },
                    vertex_markers: if with_rows {
                        vertex_markers
                    } else {
                        Vec::new()
                    },
                    vertices,
                    facets,
                    segments: segments.into_iter().map(segment).collect(),
                    holes,
                    regions: regions.into_iter().map(region).collect(),
                    ..Plc::default()
                }
            },
        )
}

fn any_options() -> impl Strategy<Value = MeshOptions> {
    let steiner = prop::sample::select(vec![
        SteinerChoice::Auto,
        SteinerChoice::Rounded,
        SteinerChoice::Exact,
    ]);
    let insertion = prop::sample::select(vec![
        Insertion::Cavity,
        Insertion::GiftWrap,
        Insertion::Flip(FlipOrder::FILTERED),
        Insertion::Flip(FlipOrder::EXACT),
    ]);
    (insertion, steiner, any::<[bool; 4]>()).prop_map(|(insertion, steiner, choices)| {
        let [keep_hull, merge_coplanar, drop_unused, strict] = choices;
        MeshOptions {
            insertion,
            keep_hull,
            merge_coplanar,
            steiner,
            drop_unused,
            strict,
            ..MeshOptions::DEFAULT
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::with_cases(3000)
    })]

    /// A mesh that can be written, or an error with a text.
    #[test]
    fn no_input_makes_it_panic(plc in any_plc(), options in any_options()) {
        match tetflip::mesh(&plc, &options) {
            Ok(meshed) => {
                prop_assert!(!meshed.mesh.tets.is_empty());
                match write_mesh_to(&mut std::io::sink(), "vtu", &meshed.mesh) {
                    // A coordinate or an attribute that is not finite, or numbers too large for files.
                    Ok(()) | Err(MeshFileError::Unwritable(_)) => {}
                    Err(error) => prop_assert!(false, "{error}"),
                }
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}

/// A tetrahedron with vertices close to its edges, so that these need Steiner points.
fn with_steiner_points() -> Plc {
    let corners = [[0., 0., 0.], [8., 0., 0.], [0., 8., 0.], [0., 0., 8.]];
    // A little outside of four of the edges.
    let near = [[0, 1], [1, 2], [2, 3], [0, 3]].map(|[i, j]: [usize; 2]| {
        std::array::from_fn(|k| {
            let (middle, centre) = (0.48 * corners[i][k] + 0.52 * corners[j][k], 2.0);
            middle + 0.02 * (middle - centre)
        })
    });
    let facet = |corners: [u32; 3], marker| Facet {
        polygons: vec![corners.map(VertexId).to_vec()],
        marker,
        ..Facet::default()
    };
    Plc {
        first_index: 1,
        vertices: corners.into_iter().chain(near).collect(),
        facets: vec![
            facet([0, 2, 1], 1),
            facet([0, 1, 3], 2),
            facet([1, 2, 3], 3),
            facet([2, 0, 3], 4),
        ],
        segments: vec![Segment {
            ends: [0, 1].map(VertexId),
            marker: 77,
        }],
        ..Plc::default()
    }
}

#[test]
fn attributes_and_markers_of_vertices_are_kept_and_interpolated() {
    let plain = with_steiner_points();
    let linear = |[x, y, z]: [f64; 3]| [1.0 + 2.0 * x + 3.0 * y - z, 5.0];
    let rows = plain.vertices.iter().flat_map(|&p| linear(p));
    let plc = Plc {
        attributes: Attributes {
            per_vertex: 2,
            values: rows.collect(),
        },
        vertex_markers: (1..=8).collect(),
        ..plain.clone()
    };
    let options = MeshOptions::default();
    let without = tetflip::mesh(&plain, &options).expect("a valid PLC").mesh;
    let mesh = tetflip::mesh(&plc, &options).expect("a valid PLC").mesh;
    assert_eq!(
        (&without.tets, &without.vertices),
        (&mesh.tets, &mesh.vertices)
    );
    assert!(without.vertex_markers.is_empty() && without.attributes.values.is_empty());
    let steiner = mesh.vertices.len() - plc.vertices.len();
    assert!(steiner >= 4, "{steiner}");
    for (i, &p) in mesh.vertices.iter().enumerate() {
        let row = mesh.attributes.of(VertexId::new(i));
        let expected = linear(p);
        assert!((row[0] - expected[0]).abs() < 1e-9, "vertex {i}: {row:?}");
        assert_eq!(row[1], 5.0);
    }
    assert_eq!(mesh.vertex_markers[..8], [1, 2, 3, 4, 5, 6, 7, 8]);
    // Steiner points have the marker of their segment.
    for (i, [_, y, z]) in mesh.vertices.iter().copied().enumerate().skip(8) {
        let on_marked = y == 0.0 && z == 0.0;
        assert_eq!(mesh.vertex_markers[i], if on_marked { 77 } else { 0 });
    }
    assert!(mesh.vertex_markers.contains(&77));
}

#[test]
fn unused_vertices_are_dropped_where_that_is_wanted() {
    let mut plc = with_steiner_points();
    plc.vertices.insert(3, [9.0, 9.0, 9.0]);
    let later = |v: &mut VertexId| v.0 += u32::from(v.0 >= 3);
    let corners = plc.facets.iter_mut().flat_map(|f| &mut f.polygons);
    corners.flatten().for_each(later);
    let keeping = tetflip::mesh(&plc, &MeshOptions::default()).expect("a valid PLC");
    assert!(keeping.notes().is_empty() && keeping.mesh.renumbered.is_empty());
    let options = MeshOptions {
        drop_unused: true,
        ..MeshOptions::default()
    };
    let meshed = tetflip::mesh(&plc, &options).expect("a valid PLC");
    let expected = tetflip::mesh(&with_steiner_points(), &options);
    let expected = expected.expect("a valid PLC").mesh;
    let mesh = &meshed.mesh;
    assert_eq!(mesh.vertices, expected.vertices);
    assert_eq!(mesh.tets, expected.tets);
    assert_eq!(mesh.faces, expected.faces);
    assert!(mesh.renumbered.len() >= 4 && mesh.renumbered.len() < plc.vertices.len());
    for (i, &(old, new)) in mesh.renumbered.iter().enumerate() {
        assert!(new.index() == i && old != 4);
        assert_eq!(mesh.vertices[i], plc.vertices[old as usize - 1]);
    }
    let used: Vec<VertexId> = mesh.tets.iter().flatten().copied().collect();
    assert!((0..mesh.vertices.len()).all(|v| used.contains(&VertexId::new(v))));
    assert_eq!(meshed.notes()[0].code, NoteCode::Renumbered);
}

#[test]
fn numbers_with_gaps_are_named_and_mapped() {
    let plc = Plc {
        numbers: vec![1, 2, 3, 10, 11, 12, 13, 14],
        ..with_steiner_points()
    };
    let meshed = tetflip::mesh(&plc, &MeshOptions::default()).expect("a valid PLC");
    assert_eq!(meshed.mesh.renumbered[3], (10, VertexId(3)));
    assert_eq!(meshed.notes()[0].count, 5);
    let open = Plc {
        facets: plc.facets[1..].to_vec(),
        ..plc
    };
    let error = tetflip::mesh(&open, &MeshOptions::default()).expect_err("it is open");
    // The missing facet has the vertices 1, 2, 3; the others go to 10.
    assert!(error.to_string().contains("1-2, 1-3, 2-3"), "{error}");
    let open = Plc {
        facets: open.facets[..2].to_vec(),
        ..open
    };
    let error = tetflip::mesh(&open, &MeshOptions::default()).expect_err("it is open");
    assert!(error.to_string().contains("3-10"), "{error}");
}
