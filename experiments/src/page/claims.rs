//! What the paper says in words of its experiments, beside what the results here say of the same.

use super::files::Files;
use super::html::escape;
use crate::frame::query::Rows;
use crate::frame::sheet::Sheet;

/// A statement of the paper, and how to find ours. An error says what is missing.
struct Claim {
    place: &'static str,
    paper: &'static str,
    ours: fn(&Files) -> Result<String, String>,
}

const CLAIMS: [Claim; 6] = [
    Claim {
        place: "§3.4, Fig. 9",
        paper: "“At this scale, the running times of both algorithms appear to be linear in the number of crossing \
                tetrahedra.”",
        ours: growth,
    },
    Claim {
        place: "§3.4, Fig. 9",
        paper: "“For larger cavities, the cavity retriangulation algorithm is about twice as fast as the flip \
                algorithm, …”",
        ours: |files| ratios(files, &["100", "300", "1000"]),
    },
    Claim {
        place: "§3.4, Fig. 9",
        paper: "“… but for very small cavities the flip algorithm is somewhat faster.”",
        ours: |files| ratios(files, &["0", "30"]),
    },
    Claim {
        place: "§3.4, Table 1",
        paper: "Of the eight models of Table 1, rows 14 and 15: “The running times differ by less than 6%, and less \
                than 1% of the total CDT construction time.”",
        ours: polygons,
    },
    Claim {
        place: "§3.4, the failure case",
        paper: "“We observed one PLC for which the flip algorithm failed because it got stuck”, at Schönhardt’s \
                polyhedron, after flips in the wrong order: “rounding errors in the flip time computations or our \
                failure to account for the weight perturbations”.",
        ours: stuck,
    },
    Claim {
        place: "§3.4, recommendation",
        paper: "Cavity retriangulation, “unless resources are available to implement the latter algorithm’s priority \
                queue comparisons with exact arithmetic and symbolic weight perturbations”.",
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

/// What the only such row of `NAME.csv` has in a column.
fn cell(sheet: &Sheet, conditions: &str, column: &str) -> Result<String, String> {
    let rows = Rows::all(sheet)
        .only(conditions)
        .map_err(|e| e.to_string())?;
    match rows.text(column).map_err(|e| e.to_string())? {
        "" => Err(format!("{} has no {column} with {conditions}", sheet.file)),
        text => Ok(escape(text)),
    }
}

fn growth(files: &Files) -> Result<String, String> {
    let table = files.table("growth-summary")?;
    let (from, to) = (
        cell(&table, "", "from_vertices")?,
        cell(&table, "", "to_vertices")?,
    );
    let exponent = |method| {
        cell(
            &table,
            &format!("method={method}, from_vertices={from}"),
            "exponent",
        )
    };
    Ok(format!(
        "Seconds grow as n<sup>{}</sup> for flips in exact order and as n<sup>{}</sup> for cavities, from {from} to \
         {to} vertices (3.3 crossing tetrahedra each).",
        exponent("flip filtered")?,
        exponent("cavity")?
    ))
}

/// Medians of flips over cavities, by size class.
fn ratios(files: &Files, classes: &[&str]) -> Result<String, String> {
    let table = files.table("fig9-summary")?;
    let mut parts = Vec::new();
    for class in classes {
        let of = |times, column| {
            cell(
                &table,
                &format!("crossing_from={class}, insertion=flip, times={times}"),
                column,
            )
        };
        // A quick run has fewer classes.
        let Ok(below) = of("f64:plain", "crossing_below") else {
            continue;
        };
        parts.push(format!(
            "{class}–{below} crossing tetrahedra: <strong>{}</strong> (f64:plain, rounded), <strong>{}</strong> (exact \
             order)",
            of("f64:plain", "ratio_to_cavity")?,
            of("filtered", "ratio_to_cavity")?
        ));
    }
    if parts.is_empty() {
        return Err("fig9-summary.csv has none of these size classes".to_string());
    }
    let parts = parts.join("; ");
    Ok(format!(
        "Median time of flips over that of cavities: {parts}."
    ))
}

/// What is asked of some rows ([`crate::frame::query`]).
fn asked(sheet: &Sheet, conditions: &str, question: &str) -> Result<f64, String> {
    let rows = Rows::all(sheet).only(conditions);
    rows.and_then(|rows| rows.number(question))
        .map_err(|e| e.to_string())
}

/// The worst of our models in `table1.csv`, of those that succeeded.
fn polygons(files: &Files) -> Result<String, String> {
    let table = files.table("table1")?;
    let ours = "source!=paper, outcome=ok, cavity_seconds!=, flip_seconds!=, total_seconds!=";
    let worst = |part: &str| {
        let most = asked(&table, ours, &format!("most({part})"))?;
        Ok::<_, String>(format!("{:.1} %", 100.0 * most))
    };
    let difference = "abs(cavity_seconds - flip_seconds)";
    // The greater of two numbers is half of their sum and their difference.
    let slower = format!("(cavity_seconds + flip_seconds + {difference})");
    Ok(format!(
        "On {} models they differ by at most {} of the slower, and by at most {} of the whole construction; polygons \
         by cavities take at most {} of that.",
        asked(&table, ours, "sum(1)")?,
        worst(&format!("2 * {difference} / {slower}"))?,
        worst(&format!("{difference} / total_seconds"))?,
        worst("cavity_seconds / total_seconds")?
    ))
}

fn stuck(files: &Files) -> Result<String, String> {
    let table = files.table("flip_order")?;
    let of = |arm: &str, question| {
        asked(
            &table,
            &format!("subfamily=all, {arm}, queue=all"),
            question,
        )
    };
    let paper = |question| of("numbers=f64:paper, ties=arrival", question);
    Ok(format!(
        "With times as the paper evaluates them (f64:paper), {} of {} small inputs made for it fail: {} get stuck, {} \
         of them at Schönhardt’s polyhedron, and {} end in what is not the CDT; {} of these inputs have ties that only \
         the perturbation breaks. With N and D each rounded once, and ties broken by the perturbation, {} fail. <a \
         href=\"#viewer\">A failure of plain doubles, step by step.</a>",
        paper("sum(inputs - ok)")?,
        paper("sum(inputs)")?,
        paper("sum(stuck)")?,
        paper("sum(stuck_schoenhardt)")?,
        paper("sum(not_delaunay)")?,
        paper("sum(failed_with_exact_ties)")?,
        of("numbers=f64:once, ties=perturbed", "sum(inputs - ok)")?
    ))
}

fn exact(files: &Files) -> Result<String, String> {
    let table = files.table("flip_order")?;
    let exact = |question| asked(&table, "subfamily=all, times=filtered", question);
    Ok(format!(
        "In exact order with the perturbation, {} of {} inputs fail, with {} pairs of flips in the wrong order and {} \
         uses of a patch.",
        exact("sum(inputs - ok)")?,
        exact("sum(inputs)")?,
        exact("sum(kendall)")?,
        exact("sum(postponed + non_crossing + discarded_outside)")?
    ))
}
