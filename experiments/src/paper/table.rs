//! LaTeX tables: those that the other modules build, and any CSV as a table.

use super::number::{self, Format};
use crate::frame::query::Rows;
use crate::frame::sheet::{Sheet, SheetError};

/// A column of a table: its head, what it asks of rows ([`crate::frame::query`]), and how it is printed.
pub type Column<'a> = (&'a str, &'a str, Format);

/// What columns say of rows.
///
/// # Errors
/// If a column of the file is missing.
pub fn cells(rows: &Rows, columns: &[Column]) -> Result<Vec<String>, SheetError> {
    let cell = |&(_, question, format): &Column| Ok(format.print(rows.optional(question)?));
    columns.iter().map(cell).collect()
}

/// A table with a head.
#[derive(Clone, Debug)]
pub struct Table {
    columns: String,
    text: String,
}

impl Table {
    /// `columns` says how the columns are set, as in `tabular`; the heads of the first ones, and the others.
    pub fn new(columns: &str, heads: &[&str], others: &[Column]) -> Table {
        let mut table = Table {
            columns: format!("@{{}}{columns}@{{}}"),
            text: String::new(),
        };
        let heads = heads.iter().copied().chain(others.iter().map(|c| c.0));
        table.row(&heads.collect::<Vec<_>>());
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

/// Columns of a CSV as a table, each with its head.
///
/// # Errors
/// If a column is missing.
pub fn of_sheet(
    sheet: &Sheet,
    conditions: &str,
    columns: &[(&str, &str)],
) -> Result<String, SheetError> {
    let heads: Vec<&str> = columns.iter().map(|c| c.1).collect();
    let mut table = Table::new(&format!("l{}", "r".repeat(heads.len() - 1)), &heads, &[]);
    for row in Rows::all(sheet).only(conditions)?.rows {
        let cells = columns.iter().map(|(name, _)| Ok(cell(row.text(name)?)));
        table.row(&cells.collect::<Result<Vec<_>, SheetError>>()?);
    }
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

    #[test]
    fn columns_of_a_sheet() {
        let text =
            "model,n_tets,seconds,ok,commit\na_b,1234,0.123456,true,c\nx,5,,false,c\nx,6,,,d\n";
        let sheet = Sheet::parse("t.csv", text).expect("a CSV");
        let columns = [
            ("model", "model"),
            ("n_tets", "tets"),
            ("seconds", "s"),
            ("ok", "ok"),
        ];
        let text = of_sheet(&sheet, "commit=c", &columns).expect("these columns");
        let expected = "% t.csv\n\\begin{tabular}{@{}lrrr@{}}\\toprule\nmodel & tets & s & ok \\\\\n\\midrule\n\
            a\\_b & 1\\,234 & 0.123 & yes \\\\\nx & 5 & -- & no \\\\\n\\bottomrule\n\\end{tabular}\n";
        assert_eq!(text, expected);
        let missing = of_sheet(&sheet, "", &[("flips", "flips")]).expect_err("no such column");
        assert_eq!(missing.to_string(), "t.csv: no column `flips`");
    }
}
