//! LaTeX tables: those that the other modules build, and any CSV as a table.

use super::number;
use crate::frame::sheet::{PaperError, Sheet};

/// A table with a head.
#[derive(Clone, Debug)]
pub struct Table {
    columns: String,
    text: String,
}

impl Table {
    /// `columns` is the argument of `tabular`, `heads` are the heads of the columns.
    pub fn new(columns: &str, heads: &[&str]) -> Table {
        let mut table = Table {
            columns: columns.to_string(),
            text: String::new(),
        };
        table.row(heads);
        table.rule();
        table
    }

    /// One more row.
    pub fn row<S: AsRef<str>>(&mut self, cells: &[S]) {
        let cells: Vec<&str> = cells.iter().map(AsRef::as_ref).collect();
        self.text += &format!("{} \\\\\n", cells.join(" & "));
    }

    /// A line across the table.
    pub fn rule(&mut self) {
        self.text += "\\midrule\n";
    }

    /// The file; `source` says where the numbers are from.
    pub fn into_text(self, source: &str) -> String {
        format!(
            "% {source}\n\\begin{{tabular}}{{{}}}\\toprule\n{}\\bottomrule\n\\end{{tabular}}\n",
            self.columns, self.text
        )
    }
}

/// Text without what TeX would understand.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '_' | '%' | '&' | '#' | '$' | '{' | '}' => escaped.extend(['\\', c]),
            '\\' => escaped += "\\textbackslash{}",
            '~' | '^' => escaped.extend(['\\', c, '{', '}']),
            _ => escaped.push(c),
        }
    }
    escaped
}

/// A cell as it is, but fractions with three significant digits, whole numbers with thin spaces, and `yes` or `no`.
pub fn cell(text: &str) -> String {
    match text.parse::<f64>() {
        _ if text == "true" => "yes".to_string(),
        _ if text == "false" => "no".to_string(),
        Ok(x) if x.is_finite() && text.contains(['.', 'e']) => number::significant(x, 3),
        Ok(x) if x.is_finite() => number::whole(x),
        _ if text.is_empty() => "--".to_string(),
        _ => escaped(text),
    }
}

/// A table of any CSV: these columns with these heads, or all but `commit` if there are none; `turned` has a column for each row,
/// as in Table 1 of Si & Shewchuk.
///
/// # Errors
/// If a column is missing.
pub fn of_sheet(
    sheet: &Sheet,
    columns: &[(&str, &str)],
    turned: bool,
) -> Result<String, PaperError> {
    let all: Vec<(String, String)> = match columns {
        [] => {
            let names = sheet.header.iter().filter(|name| *name != "commit");
            names
                .map(|n| (n.clone(), escaped(&n.replace('_', " "))))
                .collect()
        }
        some => some
            .iter()
            .map(|(n, h)| (n.to_string(), h.to_string()))
            .collect(),
    };
    // One line for each column of the file.
    let mut lines: Vec<Vec<String>> = Vec::new();
    for (name, head) in &all {
        let mut line = vec![head.clone()];
        for row in sheet.all() {
            line.push(cell(row.text(name)?));
        }
        lines.push(line);
    }
    if !turned {
        let rows = lines.first().map_or(0, Vec::len);
        lines = (0..rows)
            .map(|i| lines.iter().map(|line| line[i].clone()).collect())
            .collect();
    }
    let width = lines.first().map_or(0, Vec::len);
    let heads: Vec<&str> = lines[0].iter().map(String::as_str).collect();
    let columns = format!("@{{}}l{}@{{}}", "r".repeat(width.saturating_sub(1)));
    let mut table = Table::new(&columns, &heads);
    lines[1..].iter().for_each(|line| table.row(line));
    Ok(table.into_text(&sheet.file))
}

/// What stands in the place of a table whose experiment has not been run.
pub fn not_measured(file: &str) -> String {
    format!(
        "% there is no {file}\n\\emph{{Not measured: these results have no \\texttt{{{}}}.}}\n",
        escaped(file)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let text = "model,n_tets,seconds,ok,commit\na_b,1234,0.123456,true,c\nx,5,,false,c\n";
        Sheet::parse("t.csv", text).expect("a CSV")
    }

    #[test]
    fn any_csv_is_a_table() {
        let text = of_sheet(&sheet(), &[], false).expect("all columns");
        let expected = "% t.csv\n\\begin{tabular}{@{}lrrr@{}}\\toprule\nmodel & n tets & seconds & ok \\\\\n\\midrule\n\
            a\\_b & 1\\,234 & 0.123 & yes \\\\\nx & 5 & -- & no \\\\\n\\bottomrule\n\\end{tabular}\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn turned_and_chosen() {
        let columns = [("model", ""), ("n_tets", "(4) tetrahedra")];
        let text = of_sheet(&sheet(), &columns, true).expect("these columns");
        assert!(
            text.contains(" & a\\_b & x \\\\\n\\midrule\n(4) tetrahedra & 1\\,234 & 5 \\\\\n"),
            "{text}"
        );
        let missing = of_sheet(&sheet(), &[("flips", "flips")], true);
        let missing = missing.expect_err("no such column").to_string();
        assert_eq!(missing, "t.csv: no column `flips`");
    }
}
