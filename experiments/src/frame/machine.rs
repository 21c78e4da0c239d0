//! The machine on which results are made.

use std::fmt;
use std::path::Path;
use std::process::Command;

/// What a time depends on. Displayed as lines `key: value`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The model of the processor.
    pub cpu: String,
    /// The number of threads that can run at once.
    pub cores: usize,
    /// The operating system, its kernel and the architecture.
    pub os: String,
    /// The compiler that compiled this program.
    pub rustc: String,
    /// The commit of the source directory at the time of the run, with `-dirty` if tracked files
    /// other than results differ from it.
    pub commit: String,
    /// The version of tetflip.
    pub tetflip: String,
}

impl Machine {
    /// This machine; `unknown` for what it does not tell.
    pub fn detect() -> Machine {
        let unknown = || "unknown".to_string();
        let read = |path: &str| std::fs::read_to_string(path).ok();
        let cpu = read("/proc/cpuinfo").and_then(|text| value_of(&text, "model name", ':'));
        let release = read("/etc/os-release").and_then(|text| value_of(&text, "PRETTY_NAME", '='));
        let kernel = read("/proc/sys/kernel/osrelease").map(|text| text.trim().to_string());
        let system = [release, kernel].into_iter().flatten();
        let os = [std::env::consts::OS.to_string()].into_iter().chain(system);
        let os: Vec<String> = os.chain([std::env::consts::ARCH.to_string()]).collect();
        Machine {
            cpu: cpu.unwrap_or_else(unknown),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            os: os.join(", "),
            rustc: env!("RUSTC_VERSION").to_string(),
            commit: commit_of(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_or_else(unknown),
            tetflip: env!("CARGO_PKG_VERSION").to_string(),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Machine {
            cpu,
            cores,
            os,
            rustc,
            commit,
            tetflip,
        } = self;
        write!(f, "cpu: {cpu}\ncores: {cores}\nos: {os}\nrustc: {rustc}\n")?;
        write!(f, "commit: {commit}\ntetflip: {tetflip}\n")
    }
}

/// The first value of `key` in lines `key separator value`, without quotes.
fn value_of(text: &str, key: &str, separator: char) -> Option<String> {
    let mut pairs = text.lines().filter_map(|line| line.split_once(separator));
    let (_, value) = pairs.find(|(k, _)| k.trim() == key)?;
    let value = value.trim().trim_matches('"');
    (!value.is_empty()).then(|| value.to_string())
}

/// Results are not sources: they change while experiments run.
fn commit_of(directory: &Path) -> Option<String> {
    let git = |arguments: &[&str]| {
        Command::new("git")
            .arg("-C")
            .arg(directory)
            .args(arguments)
            .output()
            .ok()
    };
    let head = git(&["rev-parse", "HEAD"])?;
    let commit = String::from_utf8(head.stdout).ok()?.trim().to_string();
    if !head.status.success() || commit.is_empty() {
        return None;
    }
    let sources = [":/", ":(top,exclude)results", ":(top,exclude)paper"];
    let same = git(&[&["diff", "--quiet", "HEAD", "--"], &sources[..]].concat())?;
    Some(match same.status.code() {
        Some(0) => commit,
        _ => commit + "-dirty",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_text() {
        let text = "processor\t: 0\nmodel name\t: A: 1\nmodel name\t: B\n";
        assert_eq!(value_of(text, "model name", ':').as_deref(), Some("A: 1"));
        let quoted = value_of("X=1\nPRETTY_NAME=\"Some OS\"\n", "PRETTY_NAME", '=');
        assert_eq!(quoted.as_deref(), Some("Some OS"));
        assert_eq!(value_of(text, "flags", ':'), None);
        assert_eq!(commit_of(Path::new("no/such/directory")), None);
    }

    #[test]
    fn a_machine_is_lines() {
        let text = Machine::detect().to_string();
        let lines = text.lines().filter_map(|line| line.split_once(": "));
        let keys: Vec<&str> = lines.map(|(key, _)| key).collect();
        assert_eq!(keys, ["cpu", "cores", "os", "rustc", "commit", "tetflip"]);
        assert!(text.contains("rustc: rustc 1."), "{text}");
    }
}
