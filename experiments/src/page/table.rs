//! CSV files as HTML tables. Columns that say the same in every row are told once, above the table.

use super::contents::Pivot;
use super::guide::Guide;
use super::html::{escape, inline, script_json};
use std::fmt::Write;

/// A CSV file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// The header.
    pub columns: Vec<String>,
    /// The rows, as long as the header.
    pub rows: Vec<Vec<String>>,
}

/// Tables up to this length stand in the page itself; longer ones as data, from which the page makes them when they are opened.
const MOST_ROWS: usize = 300;

impl Table {
    /// Reads CSV.
    ///
    /// # Errors
    /// If it is none.
    pub fn read(bytes: &[u8]) -> Result<Table, csv::Error> {
        let mut reader = csv::Reader::from_reader(bytes);
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_string).collect();
        let columns = cells(reader.headers()?);
        let rows = reader.records().map(|r| r.map(|r| cells(&r)));
        Ok(Table {
            columns,
            rows: rows.collect::<Result<_, _>>()?,
        })
    }

    /// The place of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|c| c == name)
    }

    /// The cell of `column` in the first row in which all the given columns have the given values.
    pub fn find(&self, keys: &[(&str, &str)], column: &str) -> Option<&str> {
        let at = self.column(column)?;
        let keys: Option<Vec<(usize, &str)>> = keys
            .iter()
            .map(|(name, value)| Some((self.column(name)?, *value)))
            .collect();
        let keys = keys?;
        let mut rows = self.rows.iter();
        let row = rows.find(|row| keys.iter().all(|&(i, value)| row[i] == value))?;
        Some(&row[at])
    }

    /// Takes out the columns that have one value in all of several rows.
    fn split_constants(&self) -> (Table, Vec<(&str, &str)>) {
        let Some((first, others)) = self.rows.split_first() else {
            return (self.clone(), Vec::new());
        };
        let is_constant =
            |i: &usize| !others.is_empty() && others.iter().all(|r| r[*i] == first[*i]);
        let (constant, varying): (Vec<usize>, Vec<usize>) =
            (0..self.columns.len()).partition(is_constant);
        let pick = |row: &Vec<String>| varying.iter().map(|&i| row[i].clone()).collect();
        let table = Table {
            columns: pick(&self.columns),
            rows: self.rows.iter().map(pick).collect(),
        };
        let constants = constant.iter().map(|&i| (&*self.columns[i], &*first[i]));
        (table, constants.collect())
    }

    /// The table, with a caption in HTML. `name` is that of the file without `.csv`, `stem` that of the experiment.
    pub fn html(&self, guide: &Guide, stem: &str, name: &str, caption: &str) -> String {
        let (table, constants) = self.split_constants();
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
            "<div class=\"scroll\" tabindex=\"0\"><table class=\"{}\" data-rows=\"rows-{name}\"><thead><tr>{headers}</tr></thead>\
             <tbody></tbody></table></div>\n<script type=\"application/json\" id=\"rows-{name}\">{}</script>\n",
            self.class(),
            script_json(&json)
        )
    }

    /// One column by two others.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn pivot(&self, pivot: &Pivot) -> Result<String, String> {
        let at = |name: &str| {
            let place = self.column(name);
            place.ok_or_else(|| format!("{}.csv has no column {name}", pivot.file))
        };
        let [(only, wanted), (down, across)] = [
            (at(pivot.only[0])?, at(pivot.value)?),
            (at(pivot.by[0])?, at(pivot.by[1])?),
        ];
        let rows = self.rows.iter().filter(|r| r[only] == pivot.only[1]);
        let mut names: Vec<&str> = Vec::new();
        for row in rows.clone() {
            if !names.contains(&&*row[down]) {
                names.push(&row[down]);
            }
        }
        let columns: Vec<&str> = pivot.columns.to_vec();
        let columns = columns
            .into_iter()
            .filter(|c| rows.clone().any(|r| r[across] == *c));
        let columns: Vec<&str> = columns.collect();
        let cell = |name: &str, column: &str| {
            let row = rows
                .clone()
                .find(|r| r[down] == name && r[across] == column);
            let value = row.map_or("", |r| &r[wanted]);
            // Nothing is told by the digits of zero.
            let value = if value.parse() == Ok(0.0) { "0" } else { value };
            format!("<td class=\"n\">{}</td>", escape(value))
        };
        let head: String = columns
            .iter()
            .map(|c| format!("<th scope=\"col\" class=\"n\">{}</th>", escape(c)))
            .collect();
        let body: String = names
            .iter()
            .map(|name| {
                let cells: String = columns.iter().map(|c| cell(name, c)).collect();
                format!("<tr><th scope=\"row\">{}</th>{cells}</tr>\n", escape(name))
            })
            .collect();
        Ok(format!(
            "<p class=\"caption\">{} <code>{}.csv</code></p>\n<div class=\"scroll whole\" tabindex=\"0\"><table class=\"pivot\">\
             <thead><tr><th scope=\"col\">{}</th>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n",
            escape(pivot.caption),
            pivot.file,
            pivot.by[0]
        ))
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

fn data_cell(cell: &str, numeric: bool) -> String {
    if numeric {
        return format!("<td class=\"n\">{}</td>", escape(cell));
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

    const CSV: &str = "method,ratio,outcome,commit\nflip <f64>,1.5,ok,abc\ncavity,,stuck,abc\n";

    #[test]
    fn constants_are_told_once() {
        let table = Table::read(CSV.as_bytes()).expect("CSV");
        let html = table.html(&Guide::read(""), "t", "t", "A table.");
        assert!(
            html.contains("In all rows: <code>commit</code> abc."),
            "{html}"
        );
        assert_eq!(html.matches("abc").count(), 1);
        assert!(html.contains(
            "<td>flip &lt;f64&gt;</td><td class=\"n\">1.5</td><td class=\"good\">ok</td>"
        ));
        assert!(html.contains("<td class=\"bad\">stuck</td>"));
        assert_eq!(
            table.find(&[("method", "cavity")], "outcome"),
            Some("stuck")
        );
        assert_eq!(table.find(&[("method", "cavity")], "none"), None);
    }

    #[test]
    fn one_column_by_two_others() {
        let table =
            Table::read("f,t,s,rate\na,x,all,0.50\na,y,all,0.0\nb,x,all,1\nb,x,one,7\n".as_bytes());
        let pivot = Pivot {
            file: "t",
            caption: "Rates.",
            only: ["s", "all"],
            by: ["f", "t"],
            columns: &["y", "x", "z"],
            value: "rate",
        };
        let table = table.expect("CSV");
        let html = table.pivot(&pivot).expect("all columns");
        let cells: Vec<&str> = html
            .split("<td class=\"n\">")
            .skip(1)
            .map(|c| c.split('<').next().unwrap_or(""))
            .collect();
        assert_eq!(cells, ["0", "0.50", "", "1"], "{html}");
        let none = Pivot {
            value: "no",
            ..pivot
        };
        assert_eq!(
            table.pivot(&none),
            Err("t.csv has no column no".to_string())
        );
    }

    #[test]
    fn long_tables_are_data() {
        let rows: String = (0..MOST_ROWS + 1)
            .map(|i| format!("{i},</script>\n"))
            .collect();
        let table = Table::read(format!("a,b\n{rows}last,row\n").as_bytes()).expect("CSV");
        let html = table.html(&Guide::read(""), "t", "t", "");
        assert_eq!(
            html.matches("</script>").count(),
            1,
            "what a cell says does not end the script"
        );
        assert!(html.contains("299\\t\\u003c/script>\\n300"));
    }
}
