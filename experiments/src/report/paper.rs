//! The paper's numbers: Si and Shewchuk, "Incrementally constructing and updating constrained Delaunay tetrahedralizations
//! with finite-precision coordinates", §3.4 with Fig. 9, Tables 1 and 2 (TetGen 1.5.0, g++ 4.4 -O3, 2.8 GHz Intel, 4 GB).

/// The models of Tables 1 and 2, from the INRIA GAMMA repository.
pub const MODELS: [&str; 8] = [
    "DEMO04", "DEMO05", "anc101", "monster4", "mohne-a", "thru-maz", "cognit", "nasty_ch",
];

/// A row of a table: its number and meaning, and the values as printed, one for each model.
pub type Row = (&'static str, [&'static str; 8]);

/// Table 1, statistics for CDT construction. Times are in seconds.
pub const TABLE_1: [Row; 16] = [
    (
        "input vertices",
        [
            "1,180", "1,128", "1,378", "1,392", "2,760", "2,781", "2,992", "8,630",
        ],
    ),
    (
        "input polygons",
        [
            "2,372", "2,280", "2,772", "2,784", "5,560", "5,622", "5,792", "17,782",
        ],
    ),
    (
        "Steiner points added",
        [
            "2,615", "1,551", "249", "1,024", "6,995", "749", "8,490", "42,408",
        ],
    ),
    (
        "output tetrahedra",
        [
            "11,810", "7,470", "5,654", "7,198", "27,956", "8,378", "39,386", "149,757",
        ],
    ),
    (
        "output subpolygons (triangles covering input polygons)",
        [
            "7,602", "5,382", "3,270", "4,832", "19,550", "7,120", "23,000", "102,604",
        ],
    ),
    (
        "recovered subpolygons",
        ["24", "25", "60", "71", "41", "87", "148", "112"],
    ),
    (
        "most recovered subpolygons in one missing region",
        ["9", "5", "15", "11", "6", "15", "9", "14"],
    ),
    (
        "flips of the flip algorithm",
        ["133", "206", "386", "730", "296", "167", "232", "290"],
    ),
    (
        "crossing tetrahedra",
        ["169", "261", "391", "860", "397", "266", "460", "456"],
    ),
    (
        "most crossing tetrahedra of one missing region",
        ["55", "49", "63", "159", "100", "28", "23", "54"],
    ),
    (
        "mean crossing tetrahedra per missing region",
        ["28", "24", "33", "41", "19", "7", "5", "9"],
    ),
    (
        "initial Delaunay tetrahedralization, s",
        [
            "0.0685", "0.0631", "0.0795", "0.0724", "0.1483", "0.1496", "0.0948", "1.4972",
        ],
    ),
    (
        "segment recovery, s",
        [
            "0.1332", "0.0806", "0.0288", "0.1399", "0.3273", "0.0436", "0.3254", "3.1978",
        ],
    ),
    (
        "polygons, by cavity retriangulation, s",
        [
            "0.0255", "0.0184", "0.0224", "0.0432", "0.0429", "0.0293", "0.0472", "0.2311",
        ],
    ),
    (
        "polygons, by flips, s",
        [
            "0.0254", "0.0195", "0.0237", "0.0440", "0.0427", "0.0285", "0.0456", "0.2300",
        ],
    ),
    (
        "the CDT, by cavity retriangulation, s",
        [
            "0.2449", "0.1759", "0.1433", "0.2701", "0.5667", "0.2476", "0.5385", "5.3380",
        ],
    ),
];

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
    let cells = |tag: &str, values: &[&str]| -> String {
        let cell = |v: &&str| format!("<{tag} class=\"n\">{}</{tag}>", escape(v));
        values.iter().map(cell).collect()
    };
    let mut html = format!(
        "<p class=\"caption\">{caption}</p>\n<div class=\"scroll whole\" tabindex=\"0\"><table class=\"paper\"><thead><tr>\
         <th class=\"n\">row</th><th></th>{}</tr></thead>\n<tbody>\n",
        cells("th", &MODELS)
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

    fn row(table: &[Row], number: usize) -> [f64; 8] {
        table[number - 1].1.map(|v| {
            let plain = v.replace([',', '%'], "");
            plain.parse().expect("a number")
        })
    }

    /// What the paper says of its tables, and how their rows depend on each other, holds for the numbers as they stand here.
    #[test]
    fn the_numbers_agree_with_each_other() {
        let one = |number| row(&TABLE_1, number);
        for model in 0..8 {
            let at = |number| one(number)[model];
            let difference = (at(14) - at(15)).abs();
            assert!(difference / at(15) < 0.06 && difference / at(16) < 0.01);
            let phases = at(12) + at(13) + at(14);
            assert!(
                phases <= at(16) && at(16) - phases < 0.42,
                "{}",
                MODELS[model]
            );
            assert!(at(10) <= at(9) && at(11) <= at(10) && at(7) <= at(6));
            // A whole number of missing regions gives the mean, which is rounded.
            let regions = (at(9) / at(11)).round();
            assert!((at(9) / regions - at(11)).abs() < 1.0, "{}", MODELS[model]);
            let two = |number| row(&TABLE_2, number)[model];
            assert!(
                (78.0..91.0).contains(&((1..=4).map(two).sum::<f64>())),
                "{}",
                MODELS[model]
            );
            assert!(
                (82.0..95.0).contains(&(two(5) + two(6))),
                "{}",
                MODELS[model]
            );
        }
    }
}
