//! The machine of `MACHINE.txt`.

use super::Builder;
use super::table::escaped;
use crate::frame::sheet::PaperError;
use std::path::Path;

const FILE: &str = "MACHINE.txt";

/// Adds it.
pub fn add(builder: &mut Builder, results: &Path) -> Result<(), PaperError> {
    let text = std::fs::read_to_string(results.join(FILE)).map_err(|e| PaperError::Unreadable {
        file: FILE.to_string(),
        reason: e.to_string(),
    })?;
    for (name, key) in [("Cpu", "cpu"), ("Cores", "cores"), ("Compiler", "rustc")] {
        let value = field(&text, key).ok_or_else(|| PaperError::NoColumn {
            file: FILE.to_string(),
            column: key.to_string(),
        })?;
        builder.macros.define(
            &format!("Machine{name}"),
            &escaped(value),
            &format!("{FILE}: {key}"),
        );
    }
    Ok(())
}

/// The value of a line `key: value`, without what is in parentheses at its end.
fn field<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let value = text.lines().find_map(|line| {
        let (name, value) = line.split_once(": ")?;
        (name == key).then_some(value)
    })?;
    Some(value.split(" (").next().unwrap_or(value).trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields() {
        let text = "cpu: Some_CPU\ncores: 2\nrustc: rustc 1.95.0 (59807616e 2026-04-14)\n";
        assert_eq!(field(text, "cpu"), Some("Some_CPU"));
        assert_eq!(field(text, "rustc"), Some("rustc 1.95.0"));
        assert_eq!(field(text, "os"), None);
    }
}
