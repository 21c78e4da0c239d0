//! Other programs that take TetGen's switches and files.

use std::str::FromStr;

/// A program and what tables call it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// The column `method`.
    pub name: String,
    /// The program, by path or name.
    pub program: String,
    /// Its switches.
    pub switches: String,
}

/// A PLC and its hull, constrained Delaunay, quietly and without optimization.
pub const SWITCHES: &str = "-pcO0Q";

impl FromStr for Program {
    type Err = String;

    /// NAME=PROGRAM, or NAME=PROGRAM:SWITCHES.
    fn from_str(word: &str) -> Result<Program, String> {
        let (name, rest) = word.split_once('=').ok_or("expected NAME=PROGRAM")?;
        let (program, switches) = rest.rsplit_once(':').unwrap_or((rest, SWITCHES));
        Ok(Program {
            name: name.to_string(),
            program: program.to_string(),
            switches: switches.to_string(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_have_names_and_switches() {
        let program: Program = "tetgen=/opt/tetgen".parse().expect("name and program");
        assert_eq!(
            (&*program.program, &*program.switches),
            ("/opt/tetgen", SWITCHES)
        );
        let program: Program = "t=tetgen:-pcQM".parse().expect("with switches");
        assert_eq!((&*program.program, &*program.switches), ("tetgen", "-pcQM"));
        assert!("tetgen".parse::<Program>().is_err());
    }
}
