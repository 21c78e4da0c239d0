//! One run: a process of this same program that does the work ([`super::worker`]), with limits of time and memory.

use super::method::Method;
use super::worker::{Findings, Job, Line};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tetflip::exchange::PrecisionChoice;
use tetflip::lab::tetgen::signal_name;

/// How long a process that has been told to end may take over it.
const GRACE: Duration = Duration::from_secs(2);

/// What is the same in all runs of a survey.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub keep_hull: bool,
    pub merge_coplanar: bool,
    pub precision: PrecisionChoice,
    pub verify: bool,
    /// MiB.
    pub memory: u64,
    /// Seconds.
    pub timeout: f64,
    pub tetgen: PathBuf,
}

/// Makes a mesh of a model in a process of its own, and waits for it. Whatever happens there is an outcome.
///
/// # Errors
/// If no process or directory can be had: that is no fault of the model.
pub(super) fn run(model: &Path, method: Method, settings: &Settings) -> io::Result<Findings> {
    // Gone when this function returns.
    let scratch = match method.algorithm.is_foreign() {
        true => Some(tempfile::tempdir()?),
        false => None,
    };
    let job = Job {
        algorithm: method.algorithm,
        steiner: method.steiner,
        keep_hull: settings.keep_hull,
        merge_coplanar: settings.merge_coplanar,
        precision: settings.precision,
        verify: settings.verify,
        memory: settings.memory,
        timeout: settings.timeout,
        tetgen: &settings.tetgen,
        scratch: scratch.as_ref().map(|directory| directory.path()),
    };
    let mut child = Command::new(this_program()?)
        // There are as many runs at once as processors.
        .args(["survey", "--worker", "--threads", "1"])
        .args(arguments(&job))
        .arg("--")
        .arg(model)
        // Addresses are different every time.
        .env("RUST_BACKTRACE", "0")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let out = drain(child.stdout.take().expect("piped"));
    let err = drain(child.stderr.take().expect("piped"));
    let (status, late) = wait(&mut child, Duration::from_secs_f64(settings.timeout))?;
    let out = out.join().expect("reading does not panic");
    let err = err.join().expect("reading does not panic");
    Ok(outcome(&out, &err, status, late, settings))
}

/// The program that is running, even if its file has been replaced since.
fn this_program() -> io::Result<PathBuf> {
    let linux = Path::new("/proc/self/exe");
    if linux.exists() {
        return Ok(linux.to_owned());
    }
    std::env::current_exe()
}

fn arguments(job: &Job) -> Vec<std::ffi::OsString> {
    let mut words: Vec<std::ffi::OsString> = vec![
        format!("--methods={}", job.algorithm).into(),
        format!("--steiner={}", job.steiner).into(),
        format!("--precision={}", job.precision).into(),
        format!("--memory={}", job.memory).into(),
        format!("--timeout={}", job.timeout).into(),
    ];
    for (on, word) in [
        (job.keep_hull, "--hull"),
        (!job.merge_coplanar, "--no-merge"),
        (!job.verify, "--no-verify"),
    ] {
        if on {
            words.push(word.into());
        }
    }
    if let Some(scratch) = job.scratch {
        words.extend(["--scratch".into(), scratch.into()]);
        words.extend(["--tetgen".into(), job.tetgen.into()]);
    }
    words
}

fn drain(mut pipe: impl Read + Send + 'static) -> JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // What came before an error is what there is.
        let _ = pipe.read_to_end(&mut bytes);
        bytes
    })
}

/// The exit status, and whether time was over.
fn wait(child: &mut Child, timeout: Duration) -> io::Result<(ExitStatus, bool)> {
    let start = Instant::now();
    let mut pause = Duration::from_micros(200);
    while start.elapsed() < timeout {
        if let Some(status) = child.try_wait()? {
            return Ok((status, false));
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(10));
    }
    // It ends itself, and TetGen, when this line closes.
    drop(child.stdin.take());
    let told = Instant::now();
    while told.elapsed() < GRACE {
        if let Some(status) = child.try_wait()? {
            return Ok((status, true));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    // It may have ended just now.
    let _ = child.kill();
    Ok((child.wait()?, true))
}

fn outcome(
    out: &[u8],
    err: &[u8],
    status: ExitStatus,
    late: bool,
    settings: &Settings,
) -> Findings {
    let mut findings = Findings::default();
    let mut stage = "starting".to_owned();
    let mut peak = None;
    let mut done = false;
    for line in String::from_utf8_lossy(out).lines() {
        // The last line of a process that died may be a part of one.
        match serde_json::from_str(line) {
            Ok(Line::Stage(word)) => {
                stage = word;
                done = false;
            }
            Ok(Line::Result(result)) => {
                findings = *result;
                done = true;
            }
            Ok(Line::Peak(mib)) => peak = mib,
            Err(_) => {}
        }
    }
    if done && !late && status.success() {
        return findings;
    }
    findings.peak_mib = peak.or(findings.peak_mib);
    let text = String::from_utf8_lossy(err);
    let said: Vec<&str> = text
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with("note: "))
        .collect();
    let said = said[..said.len().min(3)].join("; ");
    if late {
        let message = format!("{} s are over, {stage}", settings.timeout);
        findings.ends("timeout", "", message);
    } else if text.contains("memory allocation of") || text.contains("Cannot allocate memory") {
        let message = format!("{} MiB are not enough, {stage}: {said}", settings.memory);
        findings.ends("memory", "", message);
    } else {
        findings.ends("crash", ending(status), format!("{stage}: {said}"));
    }
    findings
}

/// How a process ended that did not finish.
fn ending(status: ExitStatus) -> String {
    match status.code() {
        // Rust's own.
        Some(101) => "Panic".to_owned(),
        Some(code) => format!("Exit{code}"),
        None => signal_name(status),
    }
}
