//! CSV files as HTML tables. Columns that say the same in every row are told once, above the table.

use super::contents::Pivot;
use super::guide::Guide;
use super::html::{escape, inline, script_json};
use crate::frame::query::Rows;
use crate::frame::sheet::{Sheet, SheetError};
use std::fmt::Write;

/// The columns of a CSV file that vary.
pub struct Table {
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Tables up to this length stand in the page itself; longer ones as data, from which the page makes them when they are
/// opened.
const MOST_ROWS: usize = 300;

impl Table {
    /// Takes out the columns that have one value in all of several rows.
    fn split_constants(sheet: &Sheet) -> (Table, Vec<(&str, &str)>) {
        let Some((first, others)) = sheet.cells.split_first() else {
            return (
                Table {
                    columns: sheet.header.clone(),
                    rows: Vec::new(),
                },
                Vec::new(),
            );
        };
        let is_constant =
            |i: &usize| !others.is_empty() && others.iter().all(|r| r[*i] == first[*i]);
        let (constant, varying): (Vec<usize>, Vec<usize>) =
            (0..sheet.header.len()).partition(is_constant);
        let pick = |row: &Vec<String>| varying.iter().map(|&i| row[i].clone()).collect();
        let table = Table {
            columns: pick(&sheet.header),
            rows: sheet.cells.iter().map(pick).collect(),
        };
        let constants = constant.iter().map(|&i| (&*sheet.header[i], &*first[i]));
        (table, constants.collect())
    }

    /// The table of a sheet, with a caption in HTML. `name` is that of the file without `.csv`, `stem` that of the
    /// experiment.
    pub fn html(sheet: &Sheet, guide: &Guide, stem: &str, name: &str, caption: &str) -> String {
        let (table, constants) = Table::split_constants(sheet);
        let mut html = match (caption, &constants[..]) {
            ("", []) => String::new(),
            _ => format!("<p class=\"caption\">{caption}"),
        };
        if !constants.is_empty() {
            let constants = constants.iter().map(|(column, value)| {
                let value = if value.is_empty() { "(empty)" } else { value };
                format!("<code>{}</code> {}", escape(column), escape(value))
            });
            let constants: Vec<String> = constants.collect();
            let _ = write!(
                html,
                " <span class=\"constants\">In all rows: {}.</span>",
                constants.join(", ")
            );
        }
        if !html.is_empty() {
            html += "</p>\n";
        }
        if table.rows.len() > MOST_ROWS {
            return html + &table.data(guide, stem, name);
        }
        let numeric = table.numeric();
        html += "<div class=\"scroll\" tabindex=\"0\"><table class=\"";
        html += table.class();
        html += "\"><thead><tr>";
        for (i, column) in table.columns.iter().enumerate() {
            html += &header(guide, stem, column, numeric[i]);
        }
        html += "</tr></thead>\n<tbody>\n";
        for row in &table.rows {
            html += "<tr>";
            for (cell, &numeric) in row.iter().zip(&numeric) {
                html += &data_cell(cell, numeric);
            }
            html += "</tr>\n";
        }
        html + "</tbody></table></div>\n"
    }

    /// The rows as data: CSV in JSON, and the header in HTML.
    fn data(&self, guide: &Guide, stem: &str, name: &str) -> String {
        let numeric = self.numeric();
        let headers = self.columns.iter().zip(&numeric);
        let headers: String = headers.map(|(c, &n)| header(guide, stem, c, n)).collect();
        let rows: Vec<String> = self.rows.iter().map(|row| row.join("\t")).collect();
        let json = serde_json::to_string(&rows.join("\n")).expect("a string");
        format!(
            "<div class=\"scroll\" tabindex=\"0\"><table class=\"{}\" \
             data-rows=\"rows-{name}\"><thead><tr>{headers}</tr></thead>\
             <tbody></tbody></table></div>\n<script type=\"application/json\" id=\"rows-{name}\">{}</script>\n",
            self.class(),
            script_json(&json)
        )
    }

    /// For the style: wide tables are printed in small letters.
    fn class(&self) -> &'static str {
        if self.columns.len() > 12 {
            "data wide"
        } else {
            "data"
        }
    }

    /// Which columns have numbers alone.
    fn numeric(&self) -> Vec<bool> {
        let is_numeric = |i: usize| {
            let mut cells = self.rows.iter().map(|r: &Vec<String>| r[i].as_str());
            cells.clone().any(|c| !c.is_empty())
                && cells.all(|c| c.is_empty() || c.parse::<f64>().is_ok())
        };
        (0..self.columns.len()).map(is_numeric).collect()
    }
}

/// One column by two others.
///
/// # Errors
/// If there is no such column.
pub fn pivot(sheet: &Sheet, caption: &str, pivot: &Pivot) -> Result<String, SheetError> {
    let [down, across] = pivot.by;
    let rows = Rows::all(sheet).only(pivot.only)?;
    let there = rows.by(across)?;
    let columns = pivot
        .columns
        .split(' ')
        .filter(|c| there.iter().any(|t| t.0 == *c));
    let columns: Vec<&str> = columns.collect();
    let head = columns
        .iter()
        .map(|c| format!("<th scope=\"col\" class=\"n\">{}</th>", escape(c)));
    let head: String = head.collect();
    let mut body = String::new();
    for (name, row) in rows.by(down)? {
        body += &format!("<tr><th scope=\"row\">{}</th>", escape(name));
        for column in &columns {
            let value = row.only(&format!("{across}={column}"))?.text(pivot.value)?;
            // Nothing is told by the digits of zero.
            let value = if value.parse() == Ok(0.0) {
                "0".to_string()
            } else {
                number(value)
            };
            body += &format!("<td class=\"n\">{}</td>", escape(&value));
        }
        body += "</tr>\n";
    }
    let (caption, file) = (escape(caption), &sheet.file);
    Ok(format!(
        "<p class=\"caption\">{caption} <a href=\"{file}\"><code>{file}</code></a></p>\n\
         <div class=\"scroll whole\" tabindex=\"0\"><table \
         class=\"pivot\">\
         <thead><tr><th scope=\"col\">{down}</th>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n"
    ))
}

fn header(guide: &Guide, stem: &str, column: &str, numeric: bool) -> String {
    let known = guide.column(stem, column);
    let class = if numeric { " class=\"n\"" } else { "" };
    let unit = match known.unit.as_str() {
        "" => String::new(),
        unit => format!(" <small>{}</small>", inline(unit)),
    };
    let title = match known.meaning.replace('`', "") {
        meaning if meaning.is_empty() => String::new(),
        meaning => format!(" title=\"{}\"", escape(&meaning)),
    };
    // Names may be broken at their underscores, which are spaces here.
    let name = escape(&column.replace('_', " "));
    format!("<th scope=\"col\"{class}{title}><span>{name}</span>{unit}</th>")
}

/// A number as it is read: whole ones in groups of three digits, others with four digits, like `tables.js`.
fn number(cell: &str) -> String {
    let Ok(x) = cell.parse::<f64>() else {
        return cell.to_string();
    };
    let digits = cell.trim_start_matches('-');
    if digits.bytes().all(|b| b.is_ascii_digit()) {
        if digits.len() < 5 {
            return cell.to_string();
        }
        let mut grouped = String::from(&cell[..cell.len() - digits.len()]);
        for (i, digit) in digits.chars().enumerate() {
            if i > 0 && (digits.len() - i).is_multiple_of(3) {
                grouped.push(',');
            }
            grouped.push(digit);
        }
        return grouped;
    }
    if digits.len() <= 6 || x == 0.0 {
        return cell.to_string();
    }
    match x.abs() {
        size if (1e-4..1e4).contains(&size) => {
            let places = (3 - size.log10().floor() as i32).max(0) as usize;
            let text = format!("{x:.places$}");
            match text.contains('.') {
                true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
                false => text,
            }
        }
        size if size >= 1e4 => number(&format!("{x:.0}")),
        _ => format!("{x:.3e}"),
    }
}

fn data_cell(cell: &str, numeric: bool) -> String {
    if numeric {
        return format!("<td class=\"n\">{}</td>", escape(&number(cell)));
    }
    match cell {
        "true" => "<td>yes</td>".to_string(),
        "false" => "<td class=\"bad\">no</td>".to_string(),
        "ok" => "<td class=\"good\">ok</td>".to_string(),
        "broken" | "failed" | "stuck" | "not-delaunay" => format!("<td class=\"bad\">{cell}</td>"),
        other => format!("<td>{}</td>", escape(other)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn html(csv: &str, caption: &str) -> String {
        let sheet = Sheet::parse("t.csv", csv).expect("CSV");
        Table::html(&sheet, &Guide::read(""), "t", "t", caption)
    }

    #[test]
    fn constants_are_told_once() {
        let csv = "method,ratio,outcome,commit\nflip <f64>,1.5,ok,abc\ncavity,,stuck,abc\n";
        let html = html(csv, "A table.");
        assert!(
            html.contains("In all rows: <code>commit</code> abc."),
            "{html}"
        );
        assert_eq!(html.matches("abc").count(), 1);
        let cells = "<td>flip &lt;f64&gt;</td><td class=\"n\">1.5</td><td class=\"good\">ok</td>";
        assert!(
            html.contains(cells) && html.contains("<td class=\"bad\">stuck</td>"),
            "{html}"
        );
    }

    #[test]
    fn one_column_by_two_others() {
        let csv = "f,t,s,rate\na,x,all,0.50\na,y,all,0.0\nb,x,all,1\nb,x,one,7\n";
        let sheet = Sheet::parse("t.csv", csv).expect("CSV");
        let rates = Pivot {
            only: "s=all",
            by: ["f", "t"],
            columns: "y x z",
            value: "rate",
        };
        let html = pivot(&sheet, "Rates.", &rates).expect("all columns");
        let cells = html.split("<td class=\"n\">").skip(1);
        let cells: Vec<&str> = cells.map(|c| c.split('<').next().unwrap_or("")).collect();
        assert_eq!(cells, ["0", "0.50", "", "1"], "{html}");
        let none = pivot(
            &sheet,
            "",
            &Pivot {
                value: "no",
                ..rates
            },
        )
        .expect_err("no such column");
        assert_eq!(none.to_string(), "t.csv: no column `no`");
    }

    #[test]
    fn numbers_are_formatted() {
        let pairs = [
            ("1234", "1234"),
            ("1234567", "1,234,567"),
            ("-12345", "-12,345"),
            ("0.248642", "0.2486"),
            ("0.25", "0.25"),
            ("1.5000000", "1.5"),
            ("12345.678", "12,346"),
            ("0.0000012345", "1.234e-6"),
            ("2.5e-7", "2.5e-7"),
            ("1.0", "1.0"),
            ("x", "x"),
        ];
        for (cell, shown) in pairs {
            assert_eq!(number(cell), shown, "{cell}");
        }
    }

    #[test]
    fn long_tables_are_data() {
        let rows: String = (0..MOST_ROWS + 1)
            .map(|i| format!("{i},</script>\n"))
            .collect();
        let html = html(&format!("a,b\n{rows}last,row\n"), "");
        // What a cell says does not end the script.
        assert_eq!(html.matches("</script>").count(), 1);
        assert!(html.contains("299\\t\\u003c/script>\\n300"));
    }
}
