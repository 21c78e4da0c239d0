//! The meshes of generated models are the recorded ones, byte by byte, by every method of insertion.
//!
//! `recorded.csv` has one row a model, method and file: a hash of the file. A change of what is written is recorded in
//! a commit of its own, which says why: the test leaves the new table in the directory that it names.

use super::place::Place;
use std::hash::Hasher;
use std::path::Path;

/// FNV-1a with 64 bits: the same on every machine and with every version of the compiler.
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

fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = Fnv(0xcbf2_9ce4_8422_2325);
    hasher.write(bytes);
    hasher.finish()
}

/// The ways in which polygons are inserted, and Steiner points placed.
const METHODS: [&str; 4] = [
    "--insert cavity",
    "--insert flip --times filtered",
    "--insert flip --times exact --steiner exact",
    "--insert gift-wrap",
];

#[test]
fn the_meshes_of_generated_models_are_the_recorded_ones() {
    let place = Place::with(&[]);
    let kinds = place.run("generate --list").ends_with(0).stdout();
    let mut table = String::from("model,arguments,file,hash\n");
    for line in kinds.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (kind, size) = (words[0], words[1]);
        place
            .run(&format!(
                "generate {kind} --size {size} --seed 3 -o in.poly --quiet"
            ))
            .ends_with(0);
        for method in METHODS {
            place
                .run(&format!(
                    "mesh in.poly -o x.node --quiet --precision exact {method}"
                ))
                .ends_with(0);
            for file in ["node", "ele", "face", "edge"] {
                let hash = hash(&place.bytes(&format!("x.{file}")));
                table += &format!("{kind}-{size},{method},{file},{hash:016x}\n");
            }
        }
    }
    let recorded = include_str!("recorded.csv");
    if table != recorded {
        let new = Path::new(env!("CARGO_TARGET_TMPDIR")).join("recorded.csv");
        std::fs::write(&new, &table).expect("the new table can be written");
        let differ: Vec<&str> = table
            .lines()
            .filter(|row| !recorded.contains(row))
            .collect();
        panic!(
            "{} rows differ, see {}:\n{}",
            differ.len(),
            new.display(),
            differ.join("\n")
        );
    }
}
