//! The numbers of the paper's Table 2 ([`crate::questions::table2::paper`]) as its authors print them: a line for each task.

use super::html::escape;
use crate::questions::table2::paper::TABLE_2;

/// What the shares of a column are of: rows 1 to 4 of the running time of cavity retriangulation, 5 and 6 of that of flips.
const TASKS: [&str; 6] = [
    "cavities: constructing their Delaunay tetrahedralizations",
    "cavities: identifying cavity faces in them",
    "cavities: identifying faces on the polygon",
    "cavities: removing tetrahedra outside and merging",
    "flips: computing flip times and queueing",
    "flips: dequeueing and flipping",
];

/// The table in HTML.
pub fn table_2(caption: &str) -> String {
    let cells = |tag: &str, values: [String; 8]| -> String {
        let cell = |v: &String| format!("<{tag} class=\"n\">{}</{tag}>", escape(v));
        values.iter().map(cell).collect()
    };
    let mut html = format!(
        "<p class=\"caption\">{caption}</p>\n<div class=\"scroll whole\" tabindex=\"0\"><table class=\"paper\"><thead><tr>\
         <th class=\"n\">row</th><th></th>{}</tr></thead>\n<tbody>\n",
        cells("th", TABLE_2.map(|(model, _)| model.to_string()))
    );
    for (i, task) in TASKS.iter().enumerate() {
        html += &format!(
            "<tr><td class=\"n\">{}</td><th scope=\"row\">{}</th>{}</tr>\n",
            i + 1,
            escape(task),
            cells(
                "td",
                TABLE_2.map(|(_, shares)| format!("{:.1}%", shares[i]))
            )
        );
    }
    html + "</tbody></table></div>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_as_in_the_paper() {
        let html = table_2("c");
        let line = "flips: dequeueing and flipping</th><td class=\"n\">25.5%</td><td class=\"n\">23.9%</td>";
        assert!(html.contains(line), "{html}");
        assert!(html.contains("<th class=\"n\">nasty_cheese</th>"));
    }
}
