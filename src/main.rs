//! The command line program: arguments → library → files. No algorithm here.

mod cli;

use clap::{Parser, Subcommand};
use cli::check::{CheckArguments, check_file};
use cli::delaunay::{DelaunayArguments, delaunay_of_file};
use cli::generate::{GenerateArguments, generate_file};
use cli::mesh::{MeshArguments, mesh};
use cli::survey::{SurveyArguments, survey};
use cli::verify::{VerifyArguments, verify_files};
use std::io::Write;
use std::process::ExitCode;

/// Constrained Delaunay tetrahedralizations, by cavity retriangulation or by exactly ordered bistellar flips.
///
/// Exit status: 0 success; 1 the algorithm gave up or a verification failed; 2 bad input or usage.
#[derive(Parser)]
#[command(version, max_term_width = 110)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Make the CDT of a PLC.
    Mesh(MeshArguments),
    /// Find out why an input is no valid PLC: all facets that are wrong, all pairs that intersect.
    Check(CheckArguments),
    /// Check a mesh, whoever wrote it, against its PLC, in exact arithmetic.
    Verify(VerifyArguments),
    /// Make the Delaunay tetrahedralization of the vertices of a file, ignoring its facets.
    Delaunay(DelaunayArguments),
    /// Make a model of a kind and size, from a seed.
    Generate(GenerateArguments),
    /// Make meshes of a whole collection, each by several methods, and a table of what came of it.
    Survey(SurveyArguments),
}

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Mesh(arguments) => mesh(&arguments),
        Command::Check(arguments) => check_file(&arguments),
        Command::Verify(arguments) => verify_files(&arguments),
        Command::Delaunay(arguments) => delaunay_of_file(&arguments),
        Command::Generate(arguments) => generate_file(&arguments),
        Command::Survey(arguments) => survey(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(stop) => {
            // A closed stderr must not turn the exit status into that of a panic.
            let _ = writeln!(std::io::stderr(), "tetflip: {}", stop.message);
            ExitCode::from(stop.status)
        }
    }
}
