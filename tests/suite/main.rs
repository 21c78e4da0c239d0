//! All integration tests, as one program: linking one takes a few seconds, linking one a file took most of the time.

mod agreement;
mod architecture;
mod check;
mod common;
mod complex;
mod delaunay;
mod deletion;
mod domains;
mod exact_steiner;
mod examples;
mod fixtures;
mod forgiven;
mod format;
mod fuzz_formats;
mod fuzz_pipeline;
mod generate;
mod merging;
mod mesh_files;
mod meshes;
mod not_flat;
mod number_agreement;
mod one_call;
mod one_call_repairs;
mod precision;
#[cfg(feature = "cli")]
mod program;
mod repair;
mod rounded_flips;
mod segments;
mod surface_formats;
#[cfg(feature = "cli")]
mod survey;
mod verify_islands;
mod verify_listed;
mod verify_mutations;
mod verify_rejects;
mod verify_threads;
mod verify_tolerance;
mod verify_unrepaired;
mod wide_floats;
