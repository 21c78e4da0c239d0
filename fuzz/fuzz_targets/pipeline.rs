//! The pipeline on PLCs made of bytes: three bits of options, then lattice points, then triangles and quadrilaterals.
//! Whatever comes in, it ends, in a mesh or in a failure that can be described.
#![no_main]

use tetflip::cdt::{Options, tetrahedralize};
use tetflip::mesh::VertexId;
use tetflip::exchange::{Facet, Plc, Segment};
use tetflip::recover::polygons::Insertion;
use tetflip::report::Report;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let [head, bytes @ ..] = bytes else {
        return;
    };
    let points = usize::from(head >> 3) + 4;
    let Some((coordinates, facets)) = bytes.split_at_checked(3 * points) else {
        return;
    };
    let id = |byte: &u8| VertexId::new(usize::from(*byte) % points);
    let mut plc = Plc {
        vertices: coordinates
            .chunks_exact(3)
            .map(|p| [0, 1, 2].map(|i| f64::from(p[i] as i8)))
            .collect(),
        ..Plc::default()
    };
    // More would take long, and be invalid anyway.
    for facet in facets.chunks(5).take(40) {
        let [kind, corners @ ..] = facet else {
            continue;
        };
        let corners: Vec<VertexId> = corners.iter().map(id).collect();
        match (kind % 3, &corners[..]) {
            (0, &[a, b, ..]) => plc.segments.push(Segment {
                ends: [a, b],
                marker: 1,
            }),
            (kind, _) => plc.facets.push(Facet {
                polygons: vec![corners[..corners.len().min(2 + usize::from(kind))].to_vec()],
                ..Facet::default()
            }),
        }
    }
    let options = Options {
        insertion: if head & 4 == 0 {
            Options::default().insertion
        } else {
            Insertion::Cavity
        },
        keep_hull: head & 1 == 0,
        merge_coplanar: head & 2 == 0,
    };
    if let Err(failure) = tetrahedralize(&plc, &options, &mut Report::default(), &mut |_| {}) {
        assert!(!failure.describe(&plc).is_empty());
    }
});
