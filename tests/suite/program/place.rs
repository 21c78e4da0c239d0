//! A directory to run the program in, and what came of it.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A directory with an input file, and a program to run in it.
pub struct Place {
    pub directory: TempDir,
}

impl Place {
    pub fn with(files: &[(&str, &str)]) -> Place {
        let directory = tempfile::tempdir().expect("a temporary directory");
        for (name, text) in files {
            std::fs::write(directory.path().join(name), text).expect("a file in it");
        }
        Place { directory }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// How many elements the header of a mesh file announces.
    pub fn count(&self, name: &str) -> usize {
        let text = String::from_utf8(self.bytes(name)).expect("UTF-8");
        let first = text.split_whitespace().next().expect("a header");
        first.parse().expect("a count")
    }

    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.directory.path()).expect("the directory");
        let mut names: Vec<String> = entries
            .map(|e| {
                e.expect("an entry")
                    .file_name()
                    .into_string()
                    .expect("UTF-8")
            })
            .collect();
        names.sort();
        names
    }

    /// Runs `tetflip` with the words of `arguments`.
    pub fn run(&self, arguments: &str) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_tetflip"))
            .args(arguments.split_whitespace())
            .current_dir(self.directory.path())
            .output()
            .expect("the program starts");
        Run {
            arguments: arguments.to_owned(),
            output,
        }
    }

    /// The same with bytes on stdin.
    pub fn run_with(&self, arguments: &str, stdin: &[u8]) -> Run {
        let mut child = Command::new(env!("CARGO_BIN_EXE_tetflip"))
            .args(arguments.split_whitespace())
            .current_dir(self.directory.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut pipe = child.stdin.take().expect("a pipe");
        // A program that refuses its arguments need not read.
        let _ = pipe.write_all(stdin);
        drop(pipe);
        Run {
            arguments: arguments.to_owned(),
            output: child.wait_with_output().expect("the program ends"),
        }
    }

    /// Runs `tetflip`, which must refuse with `status` and a message that holds all of `parts`, and leave no new file.
    pub fn refuses(&self, arguments: &str, status: i32, parts: &[&str]) {
        let before = self.names();
        let run = self.run(arguments).ends_with(status);
        for part in parts {
            assert!(
                run.stderr().contains(part),
                "{arguments}: {part:?} is not in {:?}",
                run.stderr()
            );
        }
        assert!(run.stderr().starts_with("tetflip: "), "{}", run.stderr());
        assert_eq!(run.stdout(), "", "{arguments}");
        assert_eq!(self.names(), before, "{arguments} leaves files");
    }
}

pub struct Run {
    pub arguments: String,
    pub output: Output,
}

impl Run {
    pub fn ends_with(self, status: i32) -> Run {
        let code = self.output.status.code();
        assert_eq!(code, Some(status), "{}: {}", self.arguments, self.stderr());
        self
    }

    pub fn stdout(&self) -> String {
        String::from_utf8(self.output.stdout.clone()).expect("UTF-8")
    }

    pub fn stderr(&self) -> String {
        String::from_utf8(self.output.stderr.clone()).expect("UTF-8")
    }
}
