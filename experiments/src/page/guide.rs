//! What the README of this package says of each experiment, so that the page says the same: the question, the inputs,
//! what is expected, and the unit and the meaning of each column.

use std::collections::BTreeMap;

/// What is known of one column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// Its unit; empty if it has none.
    pub unit: String,
    /// Markdown.
    pub meaning: String,
}

/// What is said of one experiment, in Markdown.
#[derive(Clone, Debug, Default)]
pub struct Chapter {
    paragraphs: Vec<String>,
    columns: BTreeMap<String, Column>,
}

/// The chapters by the stems of the experiments.
pub struct Guide(BTreeMap<String, Chapter>);

impl Guide {
    /// The README of this package.
    pub fn of_package() -> Guide {
        Guide::read(include_str!("../../README.md"))
    }

    /// Reads a README with one chapter for each experiment.
    pub fn read(markdown: &str) -> Guide {
        let chapters = markdown.split("\n## ").skip(1).map(|text| {
            let (stem, body) = text.split_once('\n').unwrap_or((text, ""));
            (stem.trim().to_string(), Chapter::read(body))
        });
        Guide(chapters.collect())
    }

    /// The paragraph of an experiment that begins with **`word`, without that.
    pub fn paragraph(&self, stem: &str, word: &str) -> Option<&str> {
        let start = format!("**{word}");
        let mut paragraphs = self.0.get(stem)?.paragraphs.iter();
        paragraphs.find_map(|p| {
            let rest = p.strip_prefix(&start)?.split_once("**")?.1;
            // "**Expected**, and asserted (where): …"
            let rest = rest.trim_start_matches([',', '.', ':', ' ']);
            let after = rest
                .strip_prefix("and asserted")
                .and_then(|r| r.split_once(": "));
            Some(after.map_or(rest, |(_, text)| text))
        })
    }

    /// What a column of an experiment is. "as in `other`" is followed; else the suffix of the name tells the unit.
    pub fn column(&self, stem: &str, name: &str) -> Column {
        let own = self.0.get(stem).and_then(|c| c.columns.get(name));
        let other = own.and_then(|c| {
            let text = format!("{} {}", c.unit, c.meaning);
            let stem = text.split_once("as in `")?.1.split('`').next()?.to_string();
            self.0.get(&stem)?.columns.get(name)
        });
        let mut column = other.or(own).cloned().unwrap_or_default();
        if column.unit.is_empty() {
            column.unit = unit_of(name).to_string();
        }
        column
    }
}

/// The unit that a name ends in.
fn unit_of(name: &str) -> &'static str {
    const UNITS: [(&str, &str); 6] = [
        ("microseconds", "µs"),
        ("milliseconds", "ms"),
        ("seconds", "s"),
        ("mebibytes", "MiB"),
        ("megabytes", "MB"),
        ("bytes", "bytes"),
    ];
    let in_name = UNITS.iter().find(|(word, _)| {
        name.split('_').any(|part| part == *word)
            && !name.contains("over")
            && !name.contains("ratio")
    });
    in_name.map_or("", |(_, unit)| unit)
}

impl Chapter {
    fn read(body: &str) -> Chapter {
        let rows = body.lines().filter(|line| line.starts_with("| `"));
        let columns = rows.flat_map(columns_of_row).collect();
        let text = body.split("\n\n").map(|p| p.replace('\n', " "));
        Chapter {
            paragraphs: text.map(|p| p.trim().to_string()).collect(),
            columns,
        }
    }
}

/// | `a`, `b` | unit of a, unit of b | meaning |
fn columns_of_row(row: &str) -> Vec<(String, Column)> {
    let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
    let [names, unit, meaning] = cells[..] else {
        return Vec::new();
    };
    let mut columns: Vec<(String, Column)> = Vec::new();
    let names: Vec<&str> = names.split('`').skip(1).step_by(2).collect();
    let units: Vec<&str> = unit.split(", ").collect();
    for (i, name) in names.iter().enumerate() {
        let name = match (name.strip_prefix('…'), columns.last()) {
            (Some(suffix), Some((before, _))) => format!("{before}{suffix}"),
            _ => (*name).to_string(),
        };
        let unit = if units.len() == names.len() {
            units[i]
        } else {
            unit
        };
        let unit = if unit == "–" { "" } else { unit };
        let column = Column {
            unit: unit.to_string(),
            meaning: meaning.to_string(),
        };
        columns.push((name, column));
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::ALL;

    #[test]
    fn chapters_say_what_the_page_shows() {
        let guide = Guide::of_package();
        let mut without = Vec::new();
        for e in ALL.map(|e| e.about()) {
            if !guide.0.contains_key(e.name) {
                without.push(e.name);
                continue;
            }
            for word in ["Question.", "Inputs.", "Expected"] {
                let text = guide.paragraph(e.name, word);
                assert!(text.is_some_and(|t| t.len() > 20), "{}: {word}", e.name);
            }
        }
        assert!(without.len() < 3, "no chapter in the README: {without:?}");
    }

    #[test]
    fn columns_and_their_units() {
        let guide = Guide::of_package();
        let unit = |stem, name| guide.column(stem, name).unit;
        assert_eq!(unit("fig9", "median_seconds"), "s");
        assert_eq!(unit("fig9", "half_height"), "length");
        assert_eq!(unit("growth", "crossing_tets"), "count", "as in fig9");
        assert_eq!(unit("flip_order", "discarded_outside_runs"), "inputs");
        assert_eq!(unit("scaling", "peak_mebibytes"), "MiB");
        assert_eq!(unit("rivals", "seconds_over_tetgen"), "");
        assert_eq!(unit("none", "microseconds_each"), "µs");
        let ties = guide.column("fig9", "ties");
        assert!(ties.meaning.starts_with("equal times"), "{ties:?}");
    }
}
