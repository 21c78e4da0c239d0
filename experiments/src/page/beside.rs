//! Table 1 of the paper with `table1.csv` beside it: of each of its models the paper's column, then ours of the same model, or of
//! one of its kind and size.

use super::html::escape;
use super::table::Table;
use crate::questions::table1::paper::{Column, TABLE_1};

/// A row: its meaning, the paper's value, and our column.
type Row = (&'static str, fn(&Column) -> String, &'static str);

/// The paper's rows (1) to (16).
const ROWS: [Row; 16] = [
    ("input vertices", |c| c.sizes[0].to_string(), "vertices"),
    ("input polygons", |c| c.sizes[1].to_string(), "polygons"),
    (
        "Steiner points",
        |c| c.sizes[2].to_string(),
        "steiner_points",
    ),
    (
        "output tetrahedra",
        |c| c.sizes[3].to_string(),
        "tetrahedra",
    ),
    (
        "output subpolygons",
        |c| c.sizes[4].to_string(),
        "subpolygons",
    ),
    (
        "recovered subpolygons",
        |c| c.regions[0].to_string(),
        "recovered",
    ),
    (
        "… most in one missing region",
        |c| c.regions[1].to_string(),
        "most_recovered",
    ),
    ("flips", |c| c.regions[2].to_string(), "flips"),
    (
        "crossing tetrahedra",
        |c| c.regions[3].to_string(),
        "crossing_tets",
    ),
    (
        "… most in one missing region",
        |c| c.regions[4].to_string(),
        "largest_region",
    ),
    (
        "… mean per missing region",
        |c| c.mean_region.to_string(),
        "mean_region",
    ),
    (
        "Delaunay tetrahedralization, s",
        |c| seconds(c, 0),
        "delaunay_seconds",
    ),
    ("segment recovery, s", |c| seconds(c, 1), "segment_seconds"),
    ("polygons, cavities, s", |c| seconds(c, 2), "cavity_seconds"),
    ("polygons, flips, s", |c| seconds(c, 3), "flip_seconds"),
    ("all, with cavities, s", |c| seconds(c, 4), "total_seconds"),
];

fn seconds(column: &Column, i: usize) -> String {
    format!("{:.4}", column.seconds[i])
}

/// The table; without ours the paper's alone.
pub fn html(ours: Option<&Table>) -> String {
    let models =
        TABLE_1.map(|column| (column, ours.map_or(Vec::new(), |t| beside(t, column.name))));
    let (mut above, mut names) = (String::new(), String::new());
    for (column, ours) in &models {
        above += &format!(
            "<th scope=\"colgroup\" colspan=\"{}\">{}</th>",
            1 + ours.len(),
            escape(column.name)
        );
        names += "<th scope=\"col\" class=\"n\">paper</th>";
        for row in ours {
            names += &format!(
                "<th scope=\"col\" class=\"n ours\">{}</th>",
                escape(row.name)
            );
        }
    }
    let mut html = format!(
        "<div class=\"scroll whole\" tabindex=\"0\"><table class=\"paper wide\"><thead><tr><th></th><th></th>{above}</tr>\n\
         <tr><th class=\"n\">row</th><th></th>{names}</tr></thead>\n<tbody>\n"
    );
    for (i, (meaning, paper, column)) in ROWS.iter().enumerate() {
        html += &format!(
            "<tr><td class=\"n\">{}</td><th scope=\"row\">{meaning}</th>",
            i + 1
        );
        for (of_paper, ours) in &models {
            html += &format!("<td class=\"n\">{}</td>", escape(&paper(of_paper)));
            for row in ours {
                html += &format!("<td class=\"n ours\">{}</td>", escape(row.value(column)));
            }
        }
        html += "</tr>\n";
    }
    html + "</tbody></table></div>\n"
}

/// One of our models.
struct Ours<'t> {
    table: &'t Table,
    row: &'t [String],
    name: &'t str,
}

impl Ours<'_> {
    fn value(&self, column: &str) -> &str {
        self.table.column(column).map_or("", |i| &self.row[i])
    }
}

/// Our rows that stand beside a column of the paper.
fn beside<'t>(table: &'t Table, model: &str) -> Vec<Ours<'t>> {
    let columns = ["source", "model", "beside"].map(|name| table.column(name));
    let [Some(source), Some(name), Some(beside)] = columns else {
        return Vec::new();
    };
    let rows = table.rows.iter();
    rows.filter(|row| row[beside] == model && row[source] != "paper")
        .map(|row| Ours {
            table,
            row,
            name: &row[name],
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ours_stand_beside_the_papers() {
        let csv = "source,model,beside,vertices,total_seconds\npaper,anc101,anc101,1378,0.1433\n\
                   generated,part/1378,anc101,1400,0.02\nmodels,other,,7,0.1\n";
        let table = Table::read(csv.as_bytes()).expect("CSV");
        let html = html(Some(&table));
        assert!(html.contains("<th scope=\"colgroup\" colspan=\"2\">anc101</th>"));
        assert!(html.contains(
            "<td class=\"n\">1378</td><td class=\"n ours\">1400</td><td class=\"n\">1392</td>"
        ));
        assert!(html.contains("<td class=\"n\">0.1433</td><td class=\"n ours\">0.02</td>"));
        assert!(!html.contains("other"));
    }

    #[test]
    fn the_paper_stands_alone_if_need_be() {
        let html = html(None);
        assert_eq!(html.matches("class=\"n ours\"").count(), 0);
        assert_eq!(html.matches("<tr>").count(), 18);
    }
}
