//! Where a PLC comes from: a file, or stdin.

use super::{Stop, warn};
use std::io::Read;
use std::path::Path;
use tetflip::exchange::{Note, Plc};
use tetflip::format::{FormatError, PlcFormat, read_plc_as, read_plc_bytes};

/// The path that stands for stdin.
const STDIN: &str = "-";

/// A PLC that is to be read.
pub(super) struct Input<'a> {
    path: &'a Path,
    /// The format, whatever the name of the file.
    format: Option<PlcFormat>,
}

impl<'a> Input<'a> {
    /// Of the arguments: of the formats, one may be that of the input. The others are returned.
    pub fn new<'f>(
        path: &'a Path,
        formats: &'f [String],
    ) -> Result<(Input<'a>, Vec<&'f str>), Stop> {
        let mut format = None;
        let mut others = Vec::new();
        for word in formats {
            match word.parse() {
                Err(_) => others.push(word.as_str()),
                Ok(given) if format.replace(given).is_none() => {}
                Ok(_) => return Err(Stop::input("--format is given twice for the input")),
            }
        }
        Ok((Input { path, format }, others))
    }

    /// The same, where there is no other format than that of the input.
    pub fn alone(path: &'a Path, formats: &[String]) -> Result<Input<'a>, Stop> {
        let (input, others) = Input::new(path, formats)?;
        match others[..] {
            [] => Ok(input),
            [other, ..] => Err(Stop::input(format!(
                "--format {other} is none of a PLC; {}",
                names()
            ))),
        }
    }

    /// Whether it is stdin.
    pub fn is_stdin(&self) -> bool {
        self.path == STDIN
    }

    /// The file, if it is one.
    pub fn file(&self) -> Option<&'a Path> {
        (!self.is_stdin()).then_some(self.path)
    }

    /// The name of the format, if it is given.
    pub fn format_name(&self) -> Option<&'static str> {
        let given = self.format?;
        let known = PlcFormat::ALL.iter().find(|(format, _)| *format == given);
        known.map(|&(_, name)| name)
    }

    /// What it is called in messages.
    pub fn name(&self) -> String {
        match self.is_stdin() {
            true => "standard input".to_owned(),
            false => self.path.display().to_string(),
        }
    }

    /// How it is given to another command.
    pub fn words(&self) -> String {
        let path = self.path.display();
        match self.format_name() {
            Some(name) => format!("{path} --format {name}"),
            None => path.to_string(),
        }
    }

    /// Reads it and prints the notes of its reader, which are returned, too; the message of a failure names the file.
    pub fn read(&self) -> Result<(Plc, Vec<Note>), Stop> {
        let read = match self.is_stdin() {
            true => {
                let mut bytes = Vec::new();
                let read = std::io::stdin().lock().read_to_end(&mut bytes);
                read.map_err(|error| Stop::input(format!("standard input: {error}")))?;
                read_plc_bytes(&bytes, self.format)
            }
            false => read_plc_as(self.path, self.format),
        };
        let (plc, notes) = read.map_err(|error| match error {
            FormatError::Io { .. } => Stop::input(error),
            FormatError::UnknownExtension(_) if self.is_stdin() => Stop::input(format!(
                "standard input: it looks like no format; {}",
                names()
            )),
            FormatError::UnknownExtension(_) => Stop::input(format!(
                "{}: {error}; or --format says what it is",
                self.name()
            )),
            error => Stop::input(format!("{}: {error}", self.name())),
        })?;
        notes.iter().for_each(|note| warn(&note.to_string()));
        Ok((plc, notes))
    }
}

/// The formats that there are.
fn names() -> String {
    let names: Vec<&str> = PlcFormat::ALL.iter().map(|(_, name)| *name).collect();
    format!("--format is one of {}", names.join(", "))
}
