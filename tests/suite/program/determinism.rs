//! The same input gives the same bytes: in every process (the seeds of hash tables differ), for every format that is
//! written, and with several runs at once in one process.

use crate::program::input::{ROOMS, stl};
use crate::program::place::Place;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::exchange::ExportedMesh;
use tetflip::format::{read_plc, write_mesh};
use tetflip::report::Report;

/// A column of four stars whose points stand above the notches of the next one. (At every height, the section is
/// star-shaped around the axis.)
fn spiky() -> String {
    let mut text = "OFF\n26 48 0\n".to_owned();
    let rings = 4;
    let around = 6;
    for ring in 0..rings {
        for k in 0..around {
            let angle = f64::from(k) * std::f64::consts::TAU / f64::from(around);
            let radius = if (ring + k) % 2 == 0 { 1.0 } else { 5.0 };
            let (y, x) = angle.sin_cos();
            text += &format!("{} {} {}\n", radius * x, radius * y, ring);
        }
    }
    text += "0 0 -0.5\n0 0 3.5\n";
    let id = |ring: i32, k: i32| ring * around + k % around;
    for k in 0..around {
        text += &format!("3 24 {} {}\n", id(0, k + 1), id(0, k));
        text += &format!("3 25 {} {}\n", id(rings - 1, k), id(rings - 1, k + 1));
        for ring in 0..rings - 1 {
            let (a, b) = (id(ring, k), id(ring, k + 1));
            let (c, d) = (id(ring + 1, k + 1), id(ring + 1, k));
            text += &format!("3 {a} {b} {c}\n3 {a} {c} {d}\n");
        }
    }
    text
}

/// Two layers of crossed wires, a square between them, and points among the wires: Steiner points.
fn wires() -> String {
    let mut text = "36 3\n".to_owned();
    for i in 0..4 {
        let n = 4 * i;
        text += &format!("{n} -5 {i} 0\n{} 5 {i} 0\n", n + 1);
        text += &format!("{} {i} -5 0.2\n{} {i} 5 0.2\n", n + 2, n + 3);
    }
    text += "16 -1 -1 0.1\n17 4 -1 0.1\n18 4 4 0.1\n19 -1 4 0.1\n";
    for n in 0..16 {
        let (x, y) = (n % 4, n / 4);
        text += &format!(
            "{} {x}.5 {y}.5 {}\n",
            n + 20,
            if n % 3 == 0 { 0.25 } else { -0.05 }
        );
    }
    text += "9 0\n1\n4 16 17 18 19\n";
    for i in 0..8 {
        text += &format!("1\n2 {} {}\n", 2 * i, 2 * i + 1);
    }
    text
}

#[test]
fn every_process_writes_the_same_bytes() {
    let place = Place::with(&[
        ("spiky.off", &spiky()),
        ("wires.poly", &wires()),
        ("rooms.poly", ROOMS),
        ("cube.stl", &stl()),
    ]);
    let names = ["x.node", "x.ele", "x.face", "x.edge", "x.vtu"];
    for command in [
        "mesh spiky.off --verify",
        "mesh spiky.off --hull --insert cavity",
        "mesh wires.poly --hull --verify",
        "mesh wires.poly --hull --insert cavity",
        "mesh spiky.off --times naive:8",
        "mesh rooms.poly --no-merge",
        "mesh cube.stl --insert gift-wrap",
        "delaunay spiky.off",
    ] {
        let mut first: Option<(Vec<Vec<u8>>, String)> = None;
        for _ in 0..5 {
            let run = place.run(&format!("{command} -o x.node"));
            let again = place.run(&format!("{command} -o x.vtu"));
            assert_eq!(run.output, again.output, "{command}");
            let files = names.map(|name| std::fs::read(place.path(name)).unwrap_or_default());
            let said = format!("{:?}", run.output);
            let first = first.get_or_insert((files.to_vec(), said.clone()));
            assert!(first.0 == files, "{command}");
            assert_eq!(first.1, said, "{command}");
        }
    }
    // Rounded insertions may fail, but the others may not.
    place.run("mesh spiky.off --verify").ends_with(0);
    let run = place.run("mesh wires.poly --hull --verify").ends_with(0);
    assert!(
        !run.stdout().contains("(0 Steiner points)"),
        "{}",
        run.stdout()
    );
}

/// Enough of everything for several threads to share it.
#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    let place = Place::with(&[]);
    place
        .run("generate terrain --size 120000 --seed 3 -o big.poly")
        .ends_with(0);
    let names = ["x.node", "x.ele", "x.face", "x.edge"];
    for command in ["delaunay big.poly", "mesh big.poly --verify"] {
        let mut first = None;
        for threads in [1, 2, 5] {
            let run = place.run(&format!("{command} -o x.node --threads {threads}"));
            let run = run.ends_with(0);
            let files = names.map(|name| std::fs::read(place.path(name)).unwrap_or_default());
            let (known, said) = first.get_or_insert((files.to_vec(), run.stdout().to_owned()));
            assert!(*known == files, "{command} --threads {threads}");
            assert_eq!(*said, run.stdout(), "{command} --threads {threads}");
        }
    }
    let none = place.run("delaunay big.poly --threads 0").ends_with(2);
    assert!(none.stderr().contains("--threads"), "{}", none.stderr());
}

#[test]
fn threads_do_not_disturb_each_other() {
    let place = Place::with(&[("spiky.off", &spiky()), ("wires.poly", &wires())]);
    let mesh = |name: &str| -> ExportedMesh {
        let (plc, _) = read_plc(&place.path(name)).expect("a good file");
        let options = Options {
            keep_hull: true,
            ..Options::default()
        };
        tetrahedralize(&plc, &options, &mut Report::default(), &mut |_| {}).expect("a mesh")
    };
    let bytes = |mesh: &ExportedMesh, stem: &str| -> Vec<Vec<u8>> {
        let mut paths = Vec::new();
        for extension in ["node", "vtu"] {
            let path = place.path(stem).with_extension(extension);
            paths.extend(write_mesh(&path, mesh).expect("a writable directory"));
        }
        let files = paths
            .iter()
            .map(|path| std::fs::read(path).expect("a file"));
        files.collect()
    };
    let alone = ["spiky.off", "wires.poly"].map(|name| bytes(&mesh(name), "alone"));
    std::thread::scope(|scope| {
        for i in 0..8 {
            let (mesh, bytes, alone) = (&mesh, &bytes, &alone);
            scope.spawn(move || {
                for round in 0..3 {
                    let which = (i + round) % 2;
                    let name = ["spiky.off", "wires.poly"][which];
                    assert!(
                        bytes(&mesh(name), &format!("t{i}")) == alone[which],
                        "{name}"
                    );
                }
            });
        }
    });
}
