//! The command line program: arguments → library → files. No algorithm here.

mod cli;

use clap::{Parser, Subcommand};
use cli::Stop;
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
/// Exit status: 0 success; 1 the algorithm gave up or a verification failed; 2 bad input or usage. Notes, on what was
/// forgiven, assumed, dropped or ignored, are lines on stderr, also with --quiet: note[code]: text.
#[derive(Parser)]
#[command(version, max_term_width = 110)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// How many threads to use for what several can do. What is computed does not depend on it. [default: all
    /// processors, or what RAYON_NUM_THREADS says]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
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
    let Arguments { command, threads } = Arguments::parse();
    let result = start_threads(threads).and_then(|()| run(command));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(stop) => {
            // A closed stderr must not turn the exit status into that of a panic.
            let _ = writeln!(std::io::stderr(), "tetflip: {}", stop.message);
            ExitCode::from(stop.status)
        }
    }
}

fn run(command: Command) -> Result<(), Stop> {
    match command {
        Command::Mesh(arguments) => mesh(&arguments),
        Command::Check(arguments) => check_file(&arguments),
        Command::Verify(arguments) => verify_files(&arguments),
        Command::Delaunay(arguments) => delaunay_of_file(&arguments),
        Command::Generate(arguments) => generate_file(&arguments),
        Command::Survey(arguments) => survey(&arguments),
    }
}

/// Starts the threads, of which this one is the first: with one thread no other is needed.
fn start_threads(threads: Option<u16>) -> Result<(), Stop> {
    // None: as many as there are processors, or as the environment says.
    let number = threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number);
    pool.use_current_thread().build_global().map_err(|error| {
        Stop::failed(format!(
            "cannot start threads: {error}; --threads 1 needs none"
        ))
    })
}
