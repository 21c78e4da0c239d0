//! The verifier says the same with any number of threads: violations, their order, and everything that is counted; of
//! meshes that are accepted, and of broken ones. The meshes are large enough to be shared out.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::Plc;
use tetflip::generate::{Kind, generate};
use tetflip::mesh::VertexId;
use tetflip::predicate::Steiner;
use tetflip::report::Report;
use tetflip::verify::{Verdict, VerifyOptions, verify};

fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().expect("a pool").install(work)
}

/// The verdict, which is the same with one thread and with three.
fn verdict(name: &str, plc: &Plc, mesh: &ExportedMesh, options: VerifyOptions) -> Verdict {
    let [alone, together] = [1, 3].map(|n| with_threads(n, || verify(plc, mesh, options)));
    assert_eq!(format!("{alone:?}"), format!("{together:?}"), "{name}");
    alone
}

fn meshed(plc: &Plc, steiner: Steiner) -> ExportedMesh {
    let options = Options {
        steiner,
        keep_hull: plc.facets.is_empty(),
        ..Options::default()
    };
    let mesh = tetrahedralize(plc, &options, &mut Report::default(), &mut |_| {});
    mesh.expect("a mesh")
}

type Damage = fn(&mut ExportedMesh, &mut ChaCha8Rng);

/// Ways to break a mesh, and one that does not.
const DAMAGES: [(&str, Damage); 12] = [
    ("nothing listed", |mesh, _| {
        mesh.faces.clear();
        mesh.edges.clear();
    }),
    ("some faces not listed", |mesh, random| {
        mesh.faces.retain(|_| random.random_ratio(9, 10));
    }),
    ("tetrahedra are missing", |mesh, random| {
        mesh.tets.retain(|_| random.random_ratio(999, 1000));
        mesh.regions.clear();
    }),
    ("the first part is missing", |mesh, _| {
        mesh.tets.drain(..20_000);
        mesh.regions.clear();
    }),
    ("tetrahedra are doubled", |mesh, random| {
        let doubled: Vec<_> = mesh
            .tets
            .iter()
            .copied()
            .filter(|_| random.random_ratio(1, 500))
            .collect();
        mesh.tets.extend(doubled);
        mesh.regions.clear();
    }),
    ("tetrahedra are inverted", |mesh, random| {
        let some = mesh.tets.iter_mut().filter(|_| random.random_ratio(1, 500));
        some.for_each(|tet| tet.swap(0, 1));
    }),
    ("all are inverted", |mesh, _| {
        mesh.tets.iter_mut().for_each(|tet| tet.swap(0, 1));
    }),
    ("vertices have moved", |mesh, random| {
        for _ in 0..20 {
            let v = random.random_range(0..mesh.vertices.len());
            mesh.vertices[v][2] += 1e-3;
        }
    }),
    ("vertices coincide", |mesh, random| {
        for _ in 0..5 {
            let [v, w] = [(); 2].map(|()| random.random_range(0..mesh.vertices.len()));
            mesh.vertices[v] = mesh.vertices[w];
        }
    }),
    ("other vertices", |mesh, random| {
        for _ in 0..20 {
            let t = random.random_range(0..mesh.tets.len());
            let v = random.random_range(0..mesh.vertices.len() as u32);
            if !mesh.tets[t].contains(&VertexId(v)) {
                mesh.tets[t][3] = VertexId(v);
            }
        }
    }),
    ("other regions", |mesh, random| {
        let some = mesh
            .regions
            .iter_mut()
            .filter(|_| random.random_ratio(1, 100));
        some.for_each(|region| *region += 1.0);
    }),
    ("reversed", |mesh, _| {
        mesh.tets.reverse();
        mesh.regions.reverse();
        mesh.faces.reverse();
    }),
];

/// Whether the mesh, and what each damage makes of it, have the same verdict with any number of threads; how many of
/// those were refused.
fn compare(name: &str, plc: &Plc, mesh: &ExportedMesh, options: VerifyOptions) -> usize {
    assert!(mesh.tets.len() >= 40_000, "{name}: {}", mesh.tets.len());
    let whole = verdict(name, plc, mesh, options);
    assert!(whole.is_ok(), "{name}: {whole}");
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut refused = 0;
    for (what, damage) in DAMAGES {
        let mut broken = mesh.clone();
        damage(&mut broken, &mut random);
        let verdict = verdict(&format!("{name}: {what}"), plc, &broken, options);
        refused += usize::from(!verdict.is_ok());
    }
    refused
}

#[test]
fn terrains() {
    let plc = generate(Kind::Terrain, 3, 16_000);
    assert!(!plc.regions.is_empty());
    let mesh = meshed(&plc, Steiner::Rounded);
    assert!(compare("terrain", &plc, &mesh, VerifyOptions::default()) >= 8);
    let lenient = VerifyOptions {
        merge_angle: Some(150.0),
        cap: 3,
        ..VerifyOptions::default()
    };
    compare("lenient", &plc, &mesh, lenient);
}

#[test]
fn exact_positions() {
    let plc = generate(Kind::Terrain, 5, 16_000);
    let mesh = meshed(&plc, Steiner::Exact);
    assert!(!mesh.exact.is_empty());
    let options = VerifyOptions {
        tolerance: 0.0,
        ..VerifyOptions::default()
    };
    assert!(compare("exact", &plc, &mesh, options) >= 8);
}

/// Points on a lattice: most signs are zero, and integers decide many of those that are not.
#[test]
fn points() {
    let side = 22;
    let all = (0..side * side * side).map(|i| [i % side, i / side % side, i / side / side]);
    let plc = Plc {
        vertices: all.map(|p| p.map(|x| f64::from(x) / 10.0 + 1e3)).collect(),
        ..Plc::default()
    };
    let mesh = meshed(&plc, Steiner::Rounded);
    let options = VerifyOptions::default();
    assert!(verdict("lattice", &plc, &mesh, options).counts.exact_signs > 1000);
    assert!(compare("lattice", &plc, &mesh, options) >= 6);
}
