//! Another program as a process: what it says, how long it takes, and an end if it takes too long.

use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// A program that runs, for who may have to end it from another thread.
pub type Partner = Mutex<Option<Child>>;

/// What became of a program.
#[derive(Clone, Debug)]
pub struct Ran {
    /// How it ended; `None` if it was ended because time was over.
    pub status: Option<ExitStatus>,
    /// What it wrote to its standard output, and to its standard error, in the order of writing.
    pub said: String,
    /// Wall clock.
    pub seconds: f64,
}

impl Ran {
    /// Whether it ended well, in time.
    pub fn is_ok(&self) -> bool {
        self.status.is_some_and(|status| status.success())
    }
}

/// Runs a program to its end, or until the limit of time. It stands in `partner` meanwhile, and stays there.
///
/// # Errors
/// If it cannot be started or waited for.
pub fn run(command: &mut Command, limit: Duration, partner: &Partner) -> io::Result<Ran> {
    let (mut reader, writer) = io::pipe()?;
    command
        .stdin(Stdio::null())
        .stdout(writer.try_clone()?)
        .stderr(writer);
    let start = Instant::now();
    let spawned = command.spawn();
    // The command has an end of the pipe, which must be closed before the reader sees the end.
    command.stdout(Stdio::null()).stderr(Stdio::null());
    *partner.lock().expect("nobody panics with it") = Some(spawned?);
    let reading = std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // What came before an error is what there is.
        let _ = reader.read_to_end(&mut bytes);
        bytes
    });
    let mut pause = Duration::from_micros(100);
    let status = loop {
        let mut locked = partner.lock().expect("nobody panics with it");
        let child = locked.as_mut().expect("it has been put there");
        if let Some(status) = child.try_wait()? {
            break Some(status);
        }
        if start.elapsed() > limit {
            // It may have ended just now.
            let _ = child.kill();
            child.wait()?;
            break None;
        }
        drop(locked);
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(2));
    };
    let seconds = start.elapsed().as_secs_f64();
    let said = reading.join().expect("reading does not panic");
    Ok(Ran {
        status,
        said: String::from_utf8_lossy(&said).into_owned(),
        seconds,
    })
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, limit: Duration) -> Ran {
        run(
            Command::new("sh").args(["-c", script]),
            limit,
            &Partner::default(),
        )
        .expect("a shell")
    }

    #[test]
    fn what_is_said_and_how_it_ends() {
        let minute = Duration::from_secs(60);
        let ran = shell("echo one; echo two >&2; echo three", minute);
        assert!(ran.is_ok() && ran.said == "one\ntwo\nthree\n", "{ran:?}");
        assert_eq!(
            shell("exit 3", minute).status.and_then(|s| s.code()),
            Some(3)
        );
        let missing = run(
            &mut Command::new("/no/such/program"),
            minute,
            &Partner::default(),
        );
        assert!(missing.is_err());
    }

    #[test]
    fn time_is_limited() {
        let ran = shell("echo begun; exec sleep 60", Duration::from_millis(200));
        assert!(
            ran.status.is_none() && ran.said == "begun\n" && ran.seconds < 30.0,
            "{ran:?}"
        );
    }
}
