//! TetGen as one more method, where it is installed: it gets the PLC in its own format, and its mesh is read back.
//!
//! Its exit statuses (TetGen 1.5): 1 out of memory, 2 a bug, 3 self-intersection, 4 and 5 features below its tolerance,
//! 10 bad input.

use super::worker::{Findings, Partner};
use std::fs::File;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::Plc;
use tetflip::format::{read_mesh, write_poly};

/// How it is called.
pub(super) struct Tetgen<'a> {
    pub program: &'a Path,
    /// A directory for its files.
    pub scratch: &'a Path,
    pub flips: bool,
    pub keep_hull: bool,
    pub merge_coplanar: bool,
}

impl Tetgen<'_> {
    /// `p` a PLC, `O0` no optimization afterwards, `c` the convex hull, `L` flips, `M` no merging of facets.
    fn switches(&self) -> String {
        let switch = |on: bool, letter: &'static str| if on { letter } else { "" };
        format!(
            "-p{}{}{}O0Q",
            switch(self.flips, "L"),
            switch(self.keep_hull, "c"),
            switch(!self.merge_coplanar, "M"),
        )
    }
}

/// Runs it. Its seconds hold reading and writing.
pub(super) fn run_tetgen(
    plc: &Plc,
    tetgen: &Tetgen,
    partner: &Partner,
    findings: &mut Findings,
) -> Option<ExportedMesh> {
    let input = tetgen.scratch.join("model.poly");
    let log = tetgen.scratch.join("log.txt");
    if let Err(error) = write_poly(&input, plc) {
        findings.ends("error", "Scratch", error.to_string());
        return None;
    }
    let start = Instant::now();
    let status = match run(tetgen, &input, &log, partner) {
        Ok(status) => status,
        Err(error) => {
            let message = format!("{}: {error}", tetgen.program.display());
            findings.ends("error", "NotStarted", message);
            return None;
        }
    };
    findings.seconds_mesh = start.elapsed().as_secs_f64();
    if !status.success() {
        let said = last_lines(&log);
        let (outcome, kind) = words(status, &said);
        findings.ends(outcome, kind, said);
        return None;
    }
    if !tetgen.scratch.join("model.1.ele").exists() {
        findings.ends("open", "NothingWritten", "no tetrahedra are written");
        return None;
    }
    match read_mesh(&tetgen.scratch.join("model.1.node")) {
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

fn run(
    tetgen: &Tetgen,
    input: &Path,
    log: &Path,
    partner: &Partner,
) -> std::io::Result<ExitStatus> {
    let out = File::create(log)?;
    let child = Command::new(tetgen.program)
        .arg(tetgen.switches())
        .arg(input)
        .stdin(Stdio::null())
        .stdout(out.try_clone()?)
        .stderr(out)
        .spawn()?;
    *partner.lock().expect("nobody panics with it") = Some(child);
    loop {
        if let Some(child) = partner.lock().expect("nobody panics with it").as_mut()
            && let Some(status) = child.try_wait()?
        {
            return Ok(status);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn words(status: ExitStatus, said: &str) -> (&'static str, String) {
    match status.code() {
        // Where the program is linked with its library, it stops by an exception that nobody catches.
        None if said.contains("instance of 'int'") => ("gave up", "Stopped".to_owned()),
        None if said.contains("bad_alloc") => ("memory", "OutOfMemory".to_owned()),
        Some(1) => ("memory", "OutOfMemory".to_owned()),
        Some(2) => ("gave up", "InternalError".to_owned()),
        Some(3) => ("invalid", "SelfIntersection".to_owned()),
        Some(4 | 5) => ("gave up", "TooClose".to_owned()),
        Some(10) => ("unreadable", "InputError".to_owned()),
        Some(code) => ("gave up", format!("Exit{code}")),
        None => ("crash", super::run::signal_name(status)),
    }
}

fn last_lines(log: &Path) -> String {
    let bytes = std::fs::read(log).unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes);
    let lines: Vec<&str> = text.lines().rev().filter(|l| !l.is_empty()).collect();
    let last = lines.iter().take(3).rev().copied();
    last.collect::<Vec<_>>().join("; ")
}
