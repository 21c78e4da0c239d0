//! Who takes part.

use super::process;
use crate::frame::Context;
use std::process::{Command, Stdio};
use std::time::Duration;

/// A program with its way to be called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Contestant {
    /// This library, on so many threads.
    Ours(Ours, u32),
    /// TetGen: Delaunay tetrahedralization, or a CDT by cavity retriangulation without optimization.
    TetGen {
        /// The program.
        program: String,
        /// What it says of itself.
        version: String,
    },
    /// TetGen 1.6 under its Python binding, which takes triangles only.
    TetGen16 {
        /// A Python that has the binding.
        python: String,
        /// Of the binding.
        version: String,
    },
    /// gmsh's parallel Delaunay kernel, points only.
    Hxt {
        /// A Python that has gmsh.
        python: String,
        /// Of gmsh.
        version: String,
        /// How many it may use.
        threads: u32,
    },
}

/// What of this library takes part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ours {
    /// The default where there is nothing to choose: points only.
    Delaunay,
    /// Polygons by cavity retriangulation.
    Cavity,
    /// Polygons by flips with filtered times.
    Flips,
    /// The exact verifier, on the mesh of cavity retriangulation.
    Verifier,
}

impl Ours {
    /// All of them.
    pub const ALL: [Ours; 4] = [Ours::Delaunay, Ours::Cavity, Ours::Flips, Ours::Verifier];

    /// The word of tables.
    pub fn word(self) -> &'static str {
        match self {
            Ours::Delaunay => "delaunay",
            Ours::Cavity => "cavity",
            Ours::Flips => "flips",
            Ours::Verifier => "verify",
        }
    }
}

impl Contestant {
    /// What tables call it.
    pub fn name(&self) -> &'static str {
        match self {
            Contestant::Ours(..) => "tetflip",
            Contestant::TetGen { .. } => "tetgen",
            Contestant::TetGen16 { .. } => "tetgen-1.6",
            Contestant::Hxt { .. } => "hxt",
        }
    }

    /// How it is called.
    pub fn method(&self) -> String {
        match self {
            Contestant::Ours(what, _) => what.word().to_string(),
            Contestant::TetGen { .. } | Contestant::TetGen16 { .. } => "cavity".to_string(),
            Contestant::Hxt { .. } => "delaunay".to_string(),
        }
    }

    /// Which release.
    pub fn version(&self) -> String {
        match self {
            Contestant::Ours(..) => env!("CARGO_PKG_VERSION").to_string(),
            Contestant::TetGen { version, .. }
            | Contestant::TetGen16 { version, .. }
            | Contestant::Hxt { version, .. } => version.clone(),
        }
    }

    /// How many threads it may use.
    pub fn threads(&self) -> u32 {
        match self {
            Contestant::Ours(_, threads) | Contestant::Hxt { threads, .. } => *threads,
            Contestant::TetGen { .. } | Contestant::TetGen16 { .. } => 1,
        }
    }
}

/// All that are installed, and the names of those that are not.
pub fn contestants(context: &Context) -> (Vec<Contestant>, Vec<String>) {
    let mut programs: Vec<Contestant> = Ours::ALL.map(|what| Contestant::Ours(what, 1)).into();
    let on_two = [Ours::Delaunay, Ours::Verifier];
    programs.extend(on_two.map(|what| Contestant::Ours(what, 2)));
    let mut missing = Vec::new();
    match &context.tetgen {
        Some(program) => programs.push(Contestant::TetGen {
            program: program.clone(),
            version: tetgen_version(program),
        }),
        None => missing.push("tetgen (no such program)".to_string()),
    }
    match module_version(&context.python, "tetgen") {
        Some(version) => programs.push(Contestant::TetGen16 {
            python: context.python.clone(),
            version: format!("1.6, binding {version}"),
        }),
        None => missing.push(format!(
            "tetgen-1.6 ({} has no module tetgen)",
            context.python
        )),
    }
    match module_version(&context.python, "gmsh") {
        Some(version) => programs.extend([1, 2].map(|threads| Contestant::Hxt {
            python: context.python.clone(),
            version: version.clone(),
            threads,
        })),
        None => missing.push(format!("hxt ({} has no module gmsh)", context.python)),
    }
    (programs, missing)
}

/// TetGen does not tell its version; the package that it came with may.
fn tetgen_version(program: &str) -> String {
    let query = ["-W", "-f=${Version}", program].map(str::to_string);
    let ran = process::run("dpkg-query", &query, Duration::from_secs(10));
    let first = ran.text.lines().next().unwrap_or_default().trim();
    match first {
        version if ran.ok && !version.is_empty() => version.to_string(),
        _ => "unknown".to_string(),
    }
}

fn module_version(python: &str, module: &str) -> Option<String> {
    let output = Command::new(python)
        .arg("-c")
        .arg(format!("import {module}; print({module}.__version__)"))
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .ok()?;
    let version = String::from_utf8(output.stdout).ok()?.trim().to_string();
    (output.status.success() && !version.is_empty()).then_some(version)
}
