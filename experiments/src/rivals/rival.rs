//! Steiner points of other programs that take TetGen's switches and files.

use crate::frame::program::Program;
use std::collections::HashSet;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tetflip::exchange::Plc;
use tetflip::format::{read_plc, write_poly};

/// How a rival's run ended.
pub struct Run {
    /// Vertices of the output that are none of the input, if there is an output.
    pub steiner_points: Option<usize>,
    /// Wall clock.
    pub seconds: f64,
    /// One word.
    pub outcome: &'static str,
}

impl Program {
    /// Runs the program on a PLC in a directory of its own, for so long at most.
    pub fn run(&self, plc: &Plc, limit: Duration) -> Run {
        let failed = |outcome| Run {
            steiner_points: None,
            seconds: 0.0,
            outcome,
        };
        let Ok(directory) = tempfile::tempdir() else {
            return failed("no-directory");
        };
        let input = directory.path().join("model.poly");
        if write_poly(&input, plc).is_err() {
            return failed("not-written");
        }
        let start = Instant::now();
        let outcome = self.outcome(&input, limit);
        Run {
            seconds: start.elapsed().as_secs_f64(),
            steiner_points: (outcome == "ok")
                .then(|| new_vertices(plc, &directory.path().join("model.1.node")))
                .flatten(),
            outcome,
        }
    }

    fn outcome(&self, input: &Path, limit: Duration) -> &'static str {
        let mut command = Command::new(&self.program);
        command.arg(&self.switches).arg(input);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let Ok(mut child) = command.spawn() else {
            return "no-program";
        };
        let start = Instant::now();
        loop {
            match child.try_wait() {
                Ok(Some(status)) => {
                    let has_mesh = input.with_file_name("model.1.ele").exists();
                    return if status.success() && has_mesh {
                        "ok"
                    } else {
                        "failed"
                    };
                }
                Ok(None) if start.elapsed() < limit => {
                    std::thread::sleep(Duration::from_millis(5));
                }
                _ => {
                    // Either it is gone already, or it is now.
                    let _ = child.kill();
                    let _ = child.wait();
                    return "time-limit";
                }
            }
        }
    }
}

/// How many vertices of a file are not those of the PLC. Programs write fewer digits than there are; duplicates and unused
/// vertices of the input may be missing.
fn new_vertices(plc: &Plc, nodes: &Path) -> Option<usize> {
    let key = |p: &[f64; 3]| p.map(|x| format!("{:.12e}", x + 0.0));
    let known: HashSet<[String; 3]> = plc.vertices.iter().map(key).collect();
    let (written, _) = read_plc(nodes).ok()?;
    let new = written.vertices.iter().filter(|p| !known.contains(&key(p)));
    Some(new.count())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_program_is_an_outcome() {
        let rival: Program = "x=/no/such/program".parse().expect("name and program");
        let run = rival.run(&Plc::default(), Duration::from_secs(1));
        assert_eq!((run.outcome, run.steiner_points), ("no-program", None));
    }
}
