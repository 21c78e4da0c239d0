//! Tables for people: some columns of a CSV file, as wide as they need to be.

use super::sheet::Sheet;
use crate::measure::sample::rounded;

/// The columns with these names, which have spaces between them. Words begin at the left, numbers end at the right.
///
/// # Panics
/// If there is no such column: that is a fault of the experiment.
pub fn table(sheet: &Sheet, columns: &str) -> String {
    let columns: Vec<Vec<String>> = columns
        .split_whitespace()
        .map(|name| {
            let cells = sheet
                .all()
                .map(|row| row.text(name).expect("a column of the table"));
            std::iter::once(name.to_string())
                .chain(cells.map(cell))
                .collect()
        })
        .collect();
    let widths = columns
        .iter()
        .map(|c| c.iter().map(|cell| cell.chars().count()).max());
    let widths: Vec<usize> = widths.map(Option::unwrap_or_default).collect();
    let is_numeric = |column: &Vec<String>| {
        column[1..]
            .iter()
            .all(|c| c == NOTHING || c.parse::<f64>().is_ok())
    };
    let numeric: Vec<bool> = columns.iter().map(is_numeric).collect();
    let mut text = String::new();
    for line in 0..=sheet.all().count() {
        let mut cells = Vec::new();
        for (i, (column, &width)) in columns.iter().zip(&widths).enumerate() {
            let cell = &column[line];
            cells.push(if numeric[i] {
                format!("{cell:>width$}")
            } else {
                format!("{cell:<width$}")
            });
        }
        text += cells.join("  ").trim_end();
        text += "\n";
    }
    text
}

const NOTHING: &str = "–";

/// Fractions with four significant digits.
fn cell(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(x) if text.contains(['.', 'e']) => number(Some(x)),
        _ if text.is_empty() => NOTHING.to_string(),
        _ => text.to_string(),
    }
}

/// A number with four significant digits, or a dash.
pub fn number(x: Option<f64>) -> String {
    x.map_or(NOTHING.to_string(), |x| rounded(x).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_columns_in_the_order_given() {
        let sheet = Sheet::parse("t", "model,n,seconds\na,5,0.123456\nlong name,1234,\n");
        let text = table(&sheet.expect("a CSV"), "n model seconds");
        let expected =
            "   n  model      seconds\n   5  a           0.1235\n1234  long name        –\n";
        assert_eq!(text, expected);
    }
}
