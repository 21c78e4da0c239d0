//! TetGen as one more method, where it is installed.

use super::method::Algorithm;
use super::worker::{Findings, Job, Partner};
use std::path::Path;
use std::time::Duration;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::lab::process;
use tetflip::lab::tetgen::{Files, Switches, failure};

/// Runs it; its seconds hold reading and writing. Of the time the master takes care.
pub(super) fn run_tetgen(
    plc: &Plc,
    job: &Job,
    partner: &Partner,
    findings: &mut Findings,
) -> Option<ExportedMesh> {
    let switches = Switches {
        flips: job.algorithm == Algorithm::TetgenFlip,
        hull: job.keep_hull,
        merge: job.merge_coplanar,
        ..Switches::CAVITY
    };
    let files = match Files::write(plc, job.scratch.unwrap_or(Path::new("."))) {
        Ok(files) => files,
        Err(error) => {
            findings.ends("error", "Scratch", error.to_string());
            return None;
        }
    };
    let mut command = files.command(job.tetgen, &switches.to_string());
    let ran = match process::run(&mut command, Duration::MAX, partner) {
        Ok(ran) => ran,
        Err(error) => {
            let message = format!("{}: {error}", job.tetgen.display());
            findings.ends("error", "NotStarted", message);
            return None;
        }
    };
    findings.seconds_mesh = ran.seconds;
    if !ran.is_ok() {
        let (outcome, kind) = failure(&ran);
        findings.ends(outcome, kind, last_lines(&ran.said));
        return None;
    }
    if !files.has_mesh() {
        findings.ends("open", "NothingWritten", "no tetrahedra are written");
        return None;
    }
    match files.mesh() {
        Ok(mesh) => {
            findings.ends("ok", "", "");
            Some(mesh)
        }
        Err(error) => {
            findings.ends("gave up", "BadMesh", error.to_string());
            None
        }
    }
}

fn last_lines(said: &str) -> String {
    let lines: Vec<&str> = said.lines().rev().filter(|l| !l.is_empty()).collect();
    let last = lines.iter().take(3).rev().copied();
    last.collect::<Vec<_>>().join("; ")
}
