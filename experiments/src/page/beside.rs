//! The paper's tables. Table 1 with `table1.csv` beside it: of each of its models the paper's column, then ours of the
//! same model, or of one of its kind and size. Table 2 as its authors print it: a line for each task.

use super::html::escape;
use crate::frame::query::Rows;
use crate::frame::sheet::{Row, Sheet};
use crate::questions::table1::paper::{Column, TABLE_1};
use crate::questions::table2::paper::TABLE_2;

/// The paper's rows (1) to (16): their meaning, and our column.
const ROWS: [(&str, &str); 16] = [
    ("input vertices", "vertices"),
    ("input polygons", "polygons"),
    ("Steiner points", "steiner_points"),
    ("output tetrahedra", "tetrahedra"),
    ("output subpolygons", "subpolygons"),
    ("recovered subpolygons", "recovered"),
    ("… most in one missing region", "most_recovered"),
    ("flips", "flips"),
    ("crossing tetrahedra", "crossing_tets"),
    ("… most in one missing region", "largest_region"),
    ("… mean per missing region", "mean_region"),
    ("Delaunay tetrahedralization, s", "delaunay_seconds"),
    ("segment recovery, s", "segment_seconds"),
    ("polygons, cavities, s", "cavity_seconds"),
    ("polygons, flips, s", "flip_seconds"),
    ("all, with cavities, s", "total_seconds"),
];

/// The paper's values of these rows.
fn values(column: &Column) -> Vec<String> {
    let sizes = column.sizes.iter().map(ToString::to_string);
    let regions = column.regions.iter().map(ToString::to_string);
    let counts = sizes.chain(regions).chain([column.mean_region.to_string()]);
    counts
        .chain(column.seconds.iter().map(|s| format!("{s:.4}")))
        .collect()
}

/// Table 1; without ours the paper's alone.
pub fn table_1(ours: Option<&Sheet>) -> String {
    // Ours are the rows that stand beside a column of the paper.
    let beside = |model: &str| {
        let rows = ours.and_then(|o| {
            Rows::all(o)
                .only(&format!("beside={model}, source!=paper"))
                .ok()
        });
        rows.map_or(Vec::new(), |rows| rows.rows)
    };
    let models = TABLE_1.map(|column| (column.name, values(&column), beside(column.name)));
    let text = |row: &Row, column| escape(row.text(column).unwrap_or(""));
    let (mut above, mut names) = (String::new(), String::new());
    for (name, _, ours) in &models {
        let (span, name) = (1 + ours.len(), escape(name));
        above += &format!("<th scope=\"colgroup\" colspan=\"{span}\">{name}</th>");
        names += "<th scope=\"col\" class=\"n\">paper</th>";
        for row in ours {
            names += &format!(
                "<th scope=\"col\" class=\"n ours\">{}</th>",
                text(row, "model")
            );
        }
    }
    let mut html = format!(
        "<div class=\"scroll whole\" tabindex=\"0\"><table class=\"paper \
         wide\"><thead><tr><th></th><th></th>{above}</tr>\n\
         <tr><th class=\"n\">row</th><th></th>{names}</tr></thead>\n<tbody>\n"
    );
    for (i, (meaning, column)) in ROWS.into_iter().enumerate() {
        html += &format!(
            "<tr><td class=\"n\">{}</td><th scope=\"row\">{meaning}</th>",
            i + 1
        );
        for (_, of_paper, ours) in &models {
            html += &format!("<td class=\"n\">{}</td>", escape(&of_paper[i]));
            for row in ours {
                html += &format!("<td class=\"n ours\">{}</td>", text(row, column));
            }
        }
        html += "</tr>\n";
    }
    html + "</tbody></table></div>\n"
}

/// What the shares of Table 2 are of: rows 1 to 4 of the running time of cavity retriangulation, 5 and 6 of that of
/// flips.
const TASKS: [&str; 6] = [
    "cavities: constructing their Delaunay tetrahedralizations",
    "cavities: identifying cavity faces in them",
    "cavities: identifying faces on the polygon",
    "cavities: removing tetrahedra outside and merging",
    "flips: computing flip times and queueing",
    "flips: dequeueing and flipping",
];

/// Table 2.
pub fn table_2(caption: &str) -> String {
    let cells = |tag: &str, values: [String; 8]| -> String {
        let cell = |v: &String| format!("<{tag} class=\"n\">{}</{tag}>", escape(v));
        values.iter().map(cell).collect()
    };
    let models = cells("th", TABLE_2.map(|(model, _)| model.to_string()));
    let mut html = format!(
        "<p class=\"caption\">{caption}</p>\n<div class=\"scroll whole\" tabindex=\"0\"><table \
         class=\"paper\"><thead><tr>\
         <th class=\"n\">row</th><th></th>{models}</tr></thead>\n<tbody>\n"
    );
    for (i, task) in TASKS.into_iter().enumerate() {
        let (row, task) = (i + 1, escape(task));
        let shares = cells(
            "td",
            TABLE_2.map(|(_, shares)| format!("{:.1}%", shares[i])),
        );
        html +=
            &format!("<tr><td class=\"n\">{row}</td><th scope=\"row\">{task}</th>{shares}</tr>\n");
    }
    html + "</tbody></table></div>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ours_stand_beside_the_papers() {
        let csv = "source,model,beside,vertices,total_seconds\npaper,anc101,anc101,1378,0.1433\n\
                   generated,part/1378,anc101,1400,0.02\nmodels,other,,7,0.1\n";
        let html = table_1(Some(&Sheet::parse("table1.csv", csv).expect("CSV")));
        assert!(html.contains("<th scope=\"colgroup\" colspan=\"2\">anc101</th>"));
        let vertices =
            "<td class=\"n\">1378</td><td class=\"n ours\">1400</td><td class=\"n\">1392</td>";
        assert!(html.contains(vertices), "{html}");
        assert!(html.contains("<td class=\"n\">0.1433</td><td class=\"n ours\">0.02</td>"));
        assert!(!html.contains("other"));
        // The paper stands alone if need be.
        let html = table_1(None);
        assert_eq!(
            (
                html.matches("class=\"n ours\"").count(),
                html.matches("<tr>").count()
            ),
            (0, 18)
        );
    }

    #[test]
    fn printed_as_in_the_paper() {
        let html = table_2("c");
        let line = "flips: dequeueing and flipping</th><td class=\"n\">25.5%</td><td class=\"n\">23.9%</td>";
        assert!(html.contains(line), "{html}");
        assert!(html.contains("<th class=\"n\">nasty_cheese</th>"));
    }
}
