//! Programs as processes, with their processor time and memory.
//!
//! The operating system tells the greatest memory of all children that a process has had, not of one: so each program
//! is run by a copy of this program that has no other child ([`limited`]).

use std::process::{Command, Stdio};
use std::time::Duration;
use tetflip::lab::process::{self, Partner};
use tetflip::lab::tetgen::number_after;

/// The processor time of this process so far, all threads, in seconds.
#[cfg(unix)]
pub fn processor_seconds() -> f64 {
    use nix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).expect("the clock exists");
    time.tv_sec() as f64 + time.tv_nsec() as f64 * 1e-9
}

/// Elsewhere: wall clock.
#[cfg(not(unix))]
pub fn processor_seconds() -> f64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START
        .get_or_init(std::time::Instant::now)
        .elapsed()
        .as_secs_f64()
}

/// The most memory that any child of this process had, in kibibytes, where the system tells.
#[cfg(unix)]
fn peak_of_children() -> Option<i64> {
    use nix::sys::resource::{UsageWho, getrusage};
    Some(getrusage(UsageWho::RUSAGE_CHILDREN).ok()?.max_rss())
}

#[cfg(not(unix))]
fn peak_of_children() -> Option<i64> {
    None
}

/// What became of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ran {
    /// Whether it ended well, in time.
    pub ok: bool,
    /// What it wrote to its standard output.
    pub text: String,
    /// The most memory that it had, in mebibytes.
    pub peak_mebibytes: Option<f64>,
}

/// What [`limited`] adds to the output of its program.
const PEAK: &str = "peak kibibytes:";

/// Runs a program under a copy of this one, for so long at most.
pub fn run(program: &str, arguments: &[String], limit: Duration) -> Ran {
    let Ok(this) = std::env::current_exe() else {
        return Ran::default();
    };
    let mut command = Command::new(this);
    command
        .args(["limited", &limit.as_secs().to_string(), program])
        .args(arguments);
    let Ok(output) = command.stdin(Stdio::null()).stderr(Stdio::null()).output() else {
        return Ran::default();
    };
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    Ran {
        ok: output.status.success(),
        peak_mebibytes: number_after(&text, PEAK).map(|kibibytes| kibibytes / 1024.0),
        text,
    }
}

/// Runs a program, passes on its output, tells its peak memory, and whether it ended well; kills it when the time is
/// over.
///
/// # Errors
/// If it cannot be started.
pub fn limited(seconds: u64, program: &str, arguments: &[String]) -> std::io::Result<bool> {
    let mut command = Command::new(program);
    command.args(arguments);
    let limit = Duration::from_secs(seconds);
    let ran = process::run(&mut command, limit, &Partner::default())?;
    println!("{}", ran.said);
    if let Some(peak) = peak_of_children() {
        println!("{PEAK} {peak}");
    }
    Ok(ran.is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn processor_time_passes() {
        let start = processor_seconds();
        let mut x = 1.0f64;
        while processor_seconds() < start + 0.01 {
            x = (x + 1.0).sqrt();
        }
        assert!(x > 0.0);
    }
}
