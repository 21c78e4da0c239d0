//! Steiner points of other programs that take TetGen's switches and files.

use crate::frame::program::Program;
use std::path::Path;
use std::time::Duration;
use tetflip::exchange::Plc;
use tetflip::lab::process::{self, Partner};
use tetflip::lab::tetgen::Files;

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
        let ended = |outcome, seconds, steiner_points| Run {
            steiner_points,
            seconds,
            outcome,
        };
        let Ok(directory) = tempfile::tempdir() else {
            return ended("no-directory", 0.0, None);
        };
        let Ok(files) = Files::write(plc, directory.path()) else {
            return ended("not-written", 0.0, None);
        };
        let mut command = files.command(Path::new(&self.program), &self.switches);
        match process::run(&mut command, limit, &Partner::default()) {
            Err(_) => ended("no-program", 0.0, None),
            Ok(ran) if ran.status.is_none() => ended("time-limit", ran.seconds, None),
            Ok(ran) if ran.is_ok() && files.has_mesh() => {
                ended("ok", ran.seconds, files.new_vertices(plc))
            }
            Ok(ran) => ended("failed", ran.seconds, None),
        }
    }
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
