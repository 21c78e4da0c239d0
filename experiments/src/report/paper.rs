//! The paper's numbers: Si and Shewchuk, "Incrementally constructing and updating constrained Delaunay tetrahedralizations
//! with finite-precision coordinates", §3.4, Table 2 (TetGen 1.5.0, g++ 4.4 -O3, 2.8 GHz Intel, 4 GB).

/// A row of a table: its number and meaning, and the values as printed, one for each model.
pub type Row = (&'static str, [&'static str; 8]);

/// Table 2, proportion of the running time spent on different tasks: rows 1 to 4 of cavity retriangulation, 5 and 6 of flips.
pub const TABLE_2: [Row; 6] = [
    (
        "cavities: constructing their Delaunay tetrahedralizations",
        [
            "74.7%", "72.5%", "79.0%", "80.0%", "72.1%", "66.4%", "60.5%", "59.2%",
        ],
    ),
    (
        "cavities: identifying cavity faces in them",
        [
            "8.5%", "9.2%", "6.5%", "7.1%", "8.4%", "11.2%", "11.2%", "11.0%",
        ],
    ),
    (
        "cavities: identifying faces on the polygon",
        [
            "0.7%", "0.9%", "0.5%", "0.3%", "1.0%", "1.9%", "2.5%", "1.7%",
        ],
    ),
    (
        "cavities: removing tetrahedra outside and merging",
        [
            "3.4%", "4.0%", "2.4%", "2.0%", "5.0%", "5.3%", "7.3%", "6.8%",
        ],
    ),
    (
        "flips: computing flip times and queueing",
        [
            "65.8%", "70.3%", "64.4%", "64.2%", "58.6%", "61.2%", "55.5%", "48.6%",
        ],
    ),
    (
        "flips: dequeueing and flipping",
        [
            "25.5%", "23.9%", "29.1%", "28.3%", "33.4%", "28.5%", "31.3%", "34.3%",
        ],
    ),
];

/// A table of the paper in HTML.
pub fn html(caption: &str, rows: &[Row]) -> String {
    use super::html::escape;
    use crate::table1::paper::TABLE_1;
    let cells = |tag: &str, values: &[&str]| -> String {
        let cell = |v: &&str| format!("<{tag} class=\"n\">{}</{tag}>", escape(v));
        values.iter().map(cell).collect()
    };
    let mut html = format!(
        "<p class=\"caption\">{caption}</p>\n<div class=\"scroll whole\" tabindex=\"0\"><table class=\"paper\"><thead><tr>\
         <th class=\"n\">row</th><th></th>{}</tr></thead>\n<tbody>\n",
        cells("th", &TABLE_1.map(|c| c.name))
    );
    for (i, (meaning, values)) in rows.iter().enumerate() {
        html += &format!(
            "<tr><td class=\"n\">{}</td><th scope=\"row\">{}</th>{}</tr>\n",
            i + 1,
            escape(meaning),
            cells("td", values)
        );
    }
    html + "</tbody></table></div>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tasks of each algorithm take most of its time, and not more than all.
    #[test]
    fn the_parts_make_a_whole() {
        for model in 0..8 {
            let part = |number: usize| -> f64 {
                let text = TABLE_2[number - 1].1[model].trim_end_matches('%');
                text.parse().expect("a number")
            };
            let cavities = (1..=4).map(part).sum::<f64>();
            assert!((78.0..91.0).contains(&cavities), "{model}: {cavities}");
            let flips = part(5) + part(6);
            assert!((82.0..95.0).contains(&flips), "{model}: {flips}");
        }
    }
}
