//! What the paper says in words of its experiments, beside what the results here say of the same.

use super::files::Files;
use super::html::escape;
use super::table::Table;

/// A statement of the paper, and how to find ours. An error says what is missing.
struct Claim {
    place: &'static str,
    paper: &'static str,
    ours: fn(&Files) -> Result<String, String>,
}

const CLAIMS: [Claim; 6] = [
    Claim {
        place: "§3.4, Fig. 9",
        paper: "“At this scale, the running times of both algorithms appear to be linear in the number of crossing tetrahedra.”",
        ours: growth,
    },
    Claim {
        place: "§3.4, Fig. 9",
        paper: "“For larger cavities, the cavity retriangulation algorithm is about twice as fast as the flip algorithm, …”",
        ours: |files| ratios(files, &["100", "300", "1000"]),
    },
    Claim {
        place: "§3.4, Fig. 9",
        paper: "“… but for very small cavities the flip algorithm is somewhat faster.”",
        ours: |files| ratios(files, &["0", "30"]),
    },
    Claim {
        place: "§3.4, Table 1",
        paper: "Of the eight models of Table 1, rows 14 and 15: “The running times differ by less than 6%, and less than 1% of the \
                total CDT construction time.”",
        ours: polygons,
    },
    Claim {
        place: "§3.4, the failure case",
        paper: "“We observed one PLC for which the flip algorithm failed because it got stuck”, at Schönhardt’s polyhedron, after \
                flips in the wrong order: “rounding errors in the flip time computations or our failure to account for the weight \
                perturbations”.",
        ours: stuck,
    },
    Claim {
        place: "§3.4, recommendation",
        paper: "Cavity retriangulation, “unless resources are available to implement the latter algorithm’s priority queue comparisons \
                with exact arithmetic and symbolic weight perturbations”.",
        ours: exact,
    },
];

/// All of them, in HTML.
pub fn html(files: &Files) -> String {
    let mut html = String::from(
        "<div class=\"scroll whole\" tabindex=\"0\"><table class=\"claims\"><thead><tr><th>where</th><th>the paper</th>\
         <th>these results</th></tr></thead>\n<tbody>\n",
    );
    for claim in &CLAIMS {
        let ours = match (claim.ours)(files) {
            Ok(text) => text,
            Err(missing) => format!("<em class=\"missing\">{}</em>", escape(&missing)),
        };
        html += &format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td>{ours}</td></tr>\n",
            claim.place, claim.paper
        );
    }
    html + "</tbody></table></div>\n"
}

fn cell<'t>(
    table: &'t Table,
    name: &str,
    keys: &[(&str, &str)],
    column: &str,
) -> Result<&'t str, String> {
    let found = table.find(keys, column).filter(|value| !value.is_empty());
    found.ok_or_else(|| {
        let keys: Vec<&str> = keys.iter().map(|(_, value)| *value).collect();
        format!("{name}.csv has no {column} of {}", keys.join(", "))
    })
}

fn growth(files: &Files) -> Result<String, String> {
    let table = files.table("growth-summary")?;
    let from = table
        .rows
        .first()
        .and_then(|r| Some(&*r[table.column("from_vertices")?]));
    let to = table
        .rows
        .first()
        .and_then(|r| Some(&*r[table.column("to_vertices")?]));
    let (from, to) = from.zip(to).ok_or("growth-summary.csv has no rows")?;
    let exponent = |method| {
        let keys = [("method", method), ("from_vertices", from)];
        cell(&table, "growth-summary", &keys, "exponent").map(escape)
    };
    Ok(format!(
        "Seconds grow as n<sup>{}</sup> for flips in exact order and as n<sup>{}</sup> for cavities, from {from} to {to} vertices \
         (3.3 crossing tetrahedra each).",
        exponent("flip filtered")?,
        exponent("cavity")?
    ))
}

/// Medians of flips over cavities, by size class.
fn ratios(files: &Files, classes: &[&str]) -> Result<String, String> {
    let table = files.table("fig9-summary")?;
    let mut parts = Vec::new();
    for &class in classes {
        let of = |times, column| {
            let keys = [
                ("crossing_from", class),
                ("insertion", "flip"),
                ("times", times),
            ];
            cell(&table, "fig9-summary", &keys, column).map(escape)
        };
        // A quick run has fewer classes.
        let Ok(below) = of("f64", "crossing_below") else {
            continue;
        };
        parts.push(format!(
            "{class}–{below} crossing tetrahedra: <strong>{}</strong> (f64, as the paper), <strong>{}</strong> (exact order)",
            of("f64", "ratio_to_cavity")?,
            of("filtered", "ratio_to_cavity")?
        ));
    }
    if parts.is_empty() {
        return Err("fig9-summary.csv has none of these size classes".to_string());
    }
    Ok(format!(
        "Median time of flips over that of cavities: {}.",
        parts.join("; ")
    ))
}

/// The worst of our models in `table1.csv`, of those that succeeded.
fn polygons(files: &Files) -> Result<String, String> {
    let table = files.table("table1")?;
    let at = |name: &str| {
        let place = table.column(name);
        place.ok_or_else(|| format!("table1.csv has no column {name}"))
    };
    let (source, outcome) = (at("source")?, at("outcome")?);
    let columns = [
        at("cavity_seconds")?,
        at("flip_seconds")?,
        at("total_seconds")?,
    ];
    let ours = table.rows.iter();
    let ours = ours.filter(|r| r[source] != "paper" && r[outcome] == "ok");
    let seconds = ours.filter_map(|r| {
        let [cavities, flips, all] = columns.map(|i| r[i].parse::<f64>().ok());
        Some((cavities?, flips?, all?))
    });
    let seconds: Vec<(f64, f64, f64)> = seconds.collect();
    if seconds.is_empty() {
        return Err("table1.csv has no times".to_string());
    }
    let worst = |part: &dyn Fn(&(f64, f64, f64)) -> f64| {
        let most = seconds.iter().map(part).fold(0.0, f64::max);
        format!("{:.1} %", 100.0 * most)
    };
    Ok(format!(
        "On {} models they differ by at most {} of the slower, and by at most {} of the whole construction; polygons by cavities take at \
         most {} of that.",
        seconds.len(),
        worst(&|&(c, f, _)| (c - f).abs() / c.max(f)),
        worst(&|&(c, f, all)| (c - f).abs() / all),
        worst(&|&(c, _, all)| c / all)
    ))
}

/// Sums over all families of `flip_order.csv`.
fn sum(table: &Table, times: &str, column: &str) -> Result<u64, String> {
    let at = |name: &str| {
        let place = table.column(name);
        place.ok_or_else(|| format!("flip_order.csv has no column {name}"))
    };
    let (subfamily, number, value) = (at("subfamily")?, at("times")?, at(column)?);
    let rows = table.rows.iter();
    let rows = rows.filter(|r| r[subfamily] == "all" && r[number] == times);
    rows.map(|r| {
        r[value]
            .parse::<u64>()
            .map_err(|_| format!("flip_order.csv: {column} is no count"))
    })
    .sum()
}

fn stuck(files: &Files) -> Result<String, String> {
    let table = files.table("flip_order")?;
    let f64 = |column| sum(&table, "f64", column);
    Ok(format!(
        "With times in f64, {} of {} small inputs made for it fail: {} get stuck, {} of them at Schönhardt’s polyhedron, and {} end in \
         what is not the CDT. <a href=\"#viewer\">One of them, step by step.</a>",
        f64("inputs")? - f64("ok")?,
        f64("inputs")?,
        f64("stuck")?,
        f64("stuck_schoenhardt")?,
        f64("not_delaunay")?
    ))
}

fn exact(files: &Files) -> Result<String, String> {
    let table = files.table("flip_order")?;
    let exact = |column| sum(&table, "filtered", column);
    Ok(format!(
        "In exact order with the perturbation, {} of {} inputs fail, with {} pairs of flips in the wrong order and {} uses of a patch.",
        exact("inputs")? - exact("ok")?,
        exact("inputs")?,
        exact("kendall")?,
        exact("postponed")? + exact("non_crossing")? + exact("discarded_outside")?
    ))
}
