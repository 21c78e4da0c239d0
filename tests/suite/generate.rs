//! Generated models are what they promise: valid, of the size that was asked for, flat unless they are meant not to be,
//! the same everywhere, and meshed to the same tetrahedra by all algorithms.

use std::hash::Hasher;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::check::check;
use tetflip::error::Failure;
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::Plc;
use tetflip::generate::{Kind, generate};
use tetflip::plc::Complex;
use tetflip::predicate::Steiner;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{Verdict, VerifyOptions, verify};

fn sizes(kind: Kind, most: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(kind.least()), |size| Some(size * 7 / 4))
        .take_while(move |&s| s <= most)
}

#[test]
fn sizes_are_kept() {
    for kind in Kind::ALL {
        for (seed, size) in (0..4).flat_map(|seed| sizes(kind, 50_000).map(move |s| (seed, s))) {
            let facets = generate(kind, seed, size).facets.len();
            assert!(
                (size.div_ceil(2)..=2 * size).contains(&facets),
                "{kind}, seed {seed}: {facets} facets for {size}"
            );
        }
        for size in [0, 1] {
            assert!(
                generate(kind, 0, size).facets.len() <= 2 * kind.least(),
                "{kind}"
            );
        }
    }
}

/// Surfaces are closed, but for walls and polygons that float or stand free.
fn is_closed(kind: Kind) -> bool {
    !matches!(kind, Kind::Cells | Kind::Confetti | Kind::Fan)
}

#[test]
fn models_are_valid() {
    for kind in Kind::ALL {
        for (seed, size) in (0..4).flat_map(|seed| sizes(kind, 3000).map(move |s| (seed, s))) {
            let name = format!("{kind}, seed {seed}, size {size}");
            let plc = generate(kind, seed, size);
            let found = check(&plc, None);
            assert!(found.errors.is_empty(), "{name}: {:?}", found.errors);
            let conflicts: Vec<String> = found.conflicts.iter().map(|c| c.describe(&plc)).collect();
            assert!(conflicts.is_empty(), "{name}: {conflicts:?}");
            assert!(found.notes.duplicate_vertices.is_empty(), "{name}");
            if is_closed(kind) {
                assert!(found.notes.open_edges.is_empty(), "{name}");
            }
            if kind != Kind::Confetti {
                assert!(found.notes.unused_vertices.is_empty(), "{name}");
            }
        }
    }
}

#[test]
fn all_facets_are_exactly_flat_but_those_of_the_bend() {
    for kind in Kind::ALL {
        for seed in 0..4 {
            let complex = Complex::new(&generate(kind, seed, 1500), false).expect("valid facets");
            let flat = complex.polygons.iter().filter(|p| p.flat).count();
            match kind {
                // Most quadrangles, and certainly the cuts.
                Kind::Bend => assert!(2 * flat < complex.polygons.len(), "{flat} flat ones"),
                _ => assert_eq!(flat, complex.polygons.len(), "{kind}"),
            }
        }
    }
}

fn mesh(plc: &Plc, insertion: Insertion, steiner: Steiner) -> Result<ExportedMesh, Failure> {
    let options = Options {
        insertion,
        steiner,
        ..Options::default()
    };
    tetrahedralize(plc, &options, &mut Report::default(), &mut |_| ())
}

fn verified(plc: &Plc, mesh: &ExportedMesh, name: &str) -> Verdict {
    let verdict = verify(plc, mesh, VerifyOptions::default());
    assert!(verdict.is_ok(), "{name}: {verdict}");
    verdict
}

/// By flips and by cavities, with rounded Steiner points or, where these have no solution, with exact ones.
fn mesh_by_both(plc: &Plc, name: &str) -> ExportedMesh {
    let [flips, cavities] = [Insertion::Flip(FlipOrder::FILTERED), Insertion::Cavity];
    for steiner in [Steiner::Rounded, Steiner::Exact] {
        match (mesh(plc, flips, steiner), mesh(plc, cavities, steiner)) {
            (Ok(first), Ok(second)) => {
                assert_eq!(first, second, "{name}");
                verified(plc, &first, name);
                return first;
            }
            (first, second) => {
                for failure in [first.err(), second.err()].into_iter().flatten() {
                    let excused = steiner == Steiner::Rounded && failure.is_due_to_rounding();
                    assert!(excused, "{name}: {failure}");
                }
            }
        }
    }
    unreachable!("exact Steiner points end in a mesh or a panic")
}

#[test]
fn both_algorithms_agree() {
    for kind in Kind::ALL {
        // Steiner points are very many; flattening takes long.
        let most = match kind {
            Kind::Chazelle | Kind::Fan | Kind::Needles => 60,
            Kind::Bend => 130,
            _ => 300,
        };
        for (seed, size) in
            (0..3).flat_map(|seed| sizes(kind, most.max(kind.least())).map(move |s| (seed, s)))
        {
            let plc = generate(kind, seed, size);
            mesh_by_both(&plc, &format!("{kind}, seed {seed}, size {size}"));
        }
    }
}

#[test]
fn every_tetrahedron_is_in_a_region_where_there_are_any() {
    for (kind, most) in [
        (Kind::Crankcase, 3),
        (Kind::Bend, 2),
        (Kind::Cells, 75),
        (Kind::Terrain, 3),
    ] {
        for seed in 0..3 {
            let plc = generate(kind, seed, 220);
            let mesh = mesh_by_both(&plc, kind.name());
            assert_eq!(mesh.regions.len(), mesh.tets.len());
            assert!(
                mesh.regions
                    .iter()
                    .all(|&r| (1.0..=f64::from(most)).contains(&r)),
                "{kind}, seed {seed}"
            );
        }
    }
}

#[test]
fn volumes_are_as_constructed() {
    // Menger's sponge of depth 1, and a row of two: 20 unit cubes each.
    for (size, cubes) in [(72, 20.0), (130, 40.0)] {
        let plc = generate(Kind::Sponge, 5, size);
        let mesh = mesh_by_both(&plc, "sponge");
        assert_eq!(verified(&plc, &mesh, "sponge").counts.volume, cubes);
    }
    // The bore, the walls, and 1/2 below the corridors are left of a disc of height 3/2: less than that.
    let plc = generate(Kind::Maze, 5, 300);
    let volume = verified(&plc, &mesh_by_both(&plc, "maze"), "maze")
        .counts
        .volume;
    let radius = plc.vertices.iter().map(|p| p[0]).fold(0.0, f64::max);
    let disc = std::f64::consts::PI * radius * radius;
    assert!(
        0.5 * 0.8 * disc < volume && volume < 1.0 * disc,
        "{volume} of {disc}"
    );
}

/// Schönhardt's polyhedron has no tetrahedralization without more vertices.
#[test]
fn schoenhardts_polyhedron_needs_steiner_points() {
    for seed in 0..10 {
        let plc = generate(Kind::Schoenhardt, seed, 8);
        assert_eq!((plc.vertices.len(), plc.facets.len()), (6, 8));
        assert!(mesh_by_both(&plc, "schoenhardt").vertices.len() > 6);
    }
}

/// FNV-1a of all coordinates and corners.
struct Fnv(u64);

impl Hasher for Fnv {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

fn fingerprint(plc: &Plc) -> u64 {
    let mut hash = Fnv(0xcbf2_9ce4_8422_2325);
    let mut number = |x: u64| hash.write(&x.to_le_bytes());
    let regions = plc.regions.iter().map(|r| r.point);
    let facet_holes = plc.facets.iter().flat_map(|f| f.holes.iter().copied());
    let points = plc.vertices.iter().chain(&plc.holes).copied();
    for p in points.chain(regions).chain(facet_holes) {
        p.into_iter().for_each(|x| number(x.to_bits()));
    }
    for polygon in plc.facets.iter().flat_map(|f| &f.polygons) {
        number(polygon.len() as u64);
        polygon.iter().for_each(|v| number(u64::from(v.0)));
    }
    for end in plc.segments.iter().flat_map(|s| s.ends) {
        number(u64::from(end.0));
    }
    hash.finish()
}

/// A change of the generators would make old tables incomparable.
#[test]
fn seeds_give_the_same_bits() {
    let known: [u64; Kind::ALL.len()] = [
        0x40b00909ec0ad00d, // bracket
        0x4a2b91b6ed997ced, // part
        0xc9431bada55e3272, // crankcase
        0xec71e121811926ae, // maze
        0x1915b09b63d3b777, // cheese
        0xf6a3c6c4e65fc582, // bend
        0x67609576a1664791, // gear
        0xc74978e62926aa7a, // shaft
        0x225e0b28419dee98, // cells
        0xb5f5e00714d44308, // terrain
        0xa788dc2c0590f154, // star
        0x9826691efbd03a4c, // schoenhardt
        0xd607e2cf39bcd7ac, // chazelle
        0xf9fcac61618659ee, // sponge
        0xc95eabbf00bdbebe, // knot
        0x0508c9f68bdd019b, // confetti
        0x6b7a536139321d75, // sphere
        0x8ee456b86bb16c05, // fan
        0x2bb5f3abb1e3ffaf, // needles
    ];
    let found = Kind::ALL.map(|kind| fingerprint(&generate(kind, 7, 700)));
    for (kind, (known, found)) in Kind::ALL.into_iter().zip(known.into_iter().zip(found)) {
        assert_eq!(
            known,
            found,
            "{kind}; all: {:#018x?}",
            Kind::ALL.map(|kind| fingerprint(&generate(kind, 7, 700)))
        );
        // A seed of its own gives a model of its own; only the axis of a sponge depends on it.
        if kind != Kind::Sponge {
            assert_ne!(found, fingerprint(&generate(kind, 8, 700)), "{kind}");
        }
    }
}

#[test]
fn names_are_parsed() {
    for kind in Kind::ALL {
        assert_eq!(kind.to_string().parse(), Ok(kind));
        assert!(!kind.about().is_empty());
    }
    let unknown = "mazes".parse::<Kind>().expect_err("no such kind");
    assert!(unknown.to_string().contains("mazes"));
}
