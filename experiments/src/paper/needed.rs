//! Tables and points of plots of the experiments that need nothing but this library.

use super::number::{Format, whole};
use super::sheets::Sheets;
use super::table::{Column, Table, cells, escaped};
use crate::frame::query::Rows;
use crate::frame::sheet::SheetError;

/// A file and its text.
pub type File = (String, String);

/// All of them.
///
/// # Errors
/// If a file, a column or a row is missing.
pub fn files(sheets: &Sheets) -> Result<Vec<File>, SheetError> {
    let mut files = vec![
        ("fig9-table.tex".to_string(), fig9(sheets)?),
        ("cost-table.tex".to_string(), cost(sheets)?),
        ("flip-order-families.tex".to_string(), families(sheets)?),
        ("flip-order-widths.tex".to_string(), widths(sheets)?),
        ("flip-order-outcomes.tex".to_string(), outcomes(sheets)?),
        ("flip-order-precision.dat".to_string(), precision(sheets)?),
    ];
    for (name, rows, words) in FIG_9_POINTS {
        let mut text = format!("% fig9.csv: {words}; crossing_tets, median_seconds in ms\nn ms\n");
        for row in Rows::all(sheets.get("fig9")?).only(rows)?.rows {
            let ms = row.number("median_seconds")? * 1e3;
            text += &format!("{} {ms:.4e}\n", row.text("crossing_tets")?);
        }
        files.push((format!("fig9-{name}.dat"), text));
    }
    for (name, method) in [("flips", "flip filtered"), ("cavity", "cavity")] {
        let columns = "crossing_tets, median_seconds, microseconds_per_tet";
        let mut text = format!("% growth.csv: method={method}; {columns}\nn s us\n");
        for row in Rows::all(sheets.get("growth")?)
            .only(&format!("method={method}"))?
            .rows
        {
            let (seconds, each) = (
                row.number("median_seconds")?,
                row.number("microseconds_per_tet")?,
            );
            text += &format!("{} {seconds:.4e} {each:.3}\n", row.text("crossing_tets")?);
        }
        files.push((format!("growth-{name}.dat"), text));
    }
    Ok(files)
}

const FIG_9_POINTS: [(&str, &str, &str); 4] = [
    ("cavity", "insertion=cavity, outcome=ok", "cavity "),
    ("f64", "times=f64:plain, outcome=ok", "flip f64:plain"),
    ("filtered", "times=filtered, outcome=ok", "flip filtered"),
    ("exact", "times=exact, outcome=ok", "flip exact"),
];

/// By size class.
const FIG_9: [Column; 8] = [
    (
        "cavity",
        "only[insertion=cavity](median_milliseconds)",
        Format::Rough,
    ),
    (
        "\\fsixtyfour",
        "only[times=f64:plain](median_milliseconds)",
        Format::Rough,
    ),
    (
        "filtered",
        "only[times=filtered](median_milliseconds)",
        Format::Rough,
    ),
    (
        "exact",
        "only[times=exact](median_milliseconds)",
        Format::Rough,
    ),
    (
        "$\\frac{\\text{\\fsixtyfour}}{\\text{cavity}}$",
        "only[times=f64:plain](ratio_to_cavity)",
        Format::Ratio,
    ),
    (
        "$\\frac{\\text{filtered}}{\\text{\\fsixtyfour}}$",
        "only[times=filtered](ratio_to_f64)",
        Format::Ratio,
    ),
    (
        "$\\frac{\\text{filtered}}{\\text{cavity}}$",
        "only[times=filtered](ratio_to_cavity)",
        Format::Ratio,
    ),
    (
        "$\\frac{\\text{exact}}{\\text{filtered}}$",
        "1 / only[times=filtered](ratio_to_exact)",
        Format::Ratio,
    ),
];

fn fig9(sheets: &Sheets) -> Result<String, SheetError> {
    let mut table = Table::new("lrrrrrrrrr", &["crossing tetrahedra", "scenes"], &FIG_9);
    for (from, class) in Rows::all(sheets.get("fig9-summary")?).by("crossing_from")? {
        let from = from.parse().map_or(from.to_string(), whole);
        let class_name = match class.optional("first?(crossing_below)")? {
            Some(below) => format!("{from} -- {}", whole(below - 1.0)),
            None => format!("{from} and more"),
        };
        let mut row = vec![class_name, class.text("scenes")?.to_string()];
        row.extend(cells(&class, &FIG_9)?);
        table.row(&row);
    }
    Ok(table.into_text(
        "fig9-summary.csv: median_milliseconds, ratio_to_cavity, ratio_to_f64, 1/ratio_to_exact",
    ))
}

/// Of one input and size.
const COST: [Column; 8] = [
    (
        "\\fsixtyfour",
        "only[method=flip f64:plain](median_milliseconds)",
        Format::Rough,
    ),
    (
        "filtered",
        "only[method=flip filtered](median_milliseconds)",
        Format::Rough,
    ),
    (
        "cavity",
        "only[method=cavity](median_milliseconds)",
        Format::Rough,
    ),
    (
        "$\\frac{\\text{filtered}}{\\text{\\fsixtyfour}}$",
        "only[method=flip filtered](ratio_to_f64)",
        Format::Ratio,
    ),
    (
        "$\\frac{\\text{filtered}}{\\text{cavity}}$",
        "only[method=flip filtered](ratio_to_cavity)",
        Format::Ratio,
    ),
    (
        "floats",
        "only[method=flip filtered](by_floats)",
        Format::Part,
    ),
    (
        "quotients",
        "only[method=flip filtered](by_exact_quotients)",
        Format::Part,
    ),
    (
        "perturbation",
        "only[method=flip filtered](by_perturbation)",
        Format::Part,
    ),
];

/// The smallest and the largest size of each input.
fn cost(sheets: &Sheets) -> Result<String, SheetError> {
    let mut table = Table::new(
        "lrrrrrrrrrr",
        &["input", "size", "\\fsixtyfour{} ok"],
        &COST,
    );
    for (input, rows) in Rows::all(sheets.get("exactness_cost-summary")?).by("input")? {
        let sizes = rows.by("about")?;
        for (about, rows) in [&sizes[0], &sizes[sizes.len() - 1]] {
            let floats = rows.only("method=flip f64:plain")?;
            let ok = format!(
                "{} of {}",
                floats.text("succeeded")?,
                floats.text("inputs")?
            );
            let about = about.parse().map_or(about.to_string(), whole);
            let mut row = vec![escaped(input), about, ok];
            row.extend(cells(rows, &COST)?);
            table.row(&row);
        }
    }
    let source = "exactness_cost-summary.csv: smallest and largest `about`; succeeded, median_milliseconds, \
                  ratio_to_f64, ratio_to_cavity, by_floats, by_exact_quotients, by_perturbation in percent";
    Ok(table.into_text(source))
}

/// Arms that are run on all inputs: which rows, and their heads.
pub const ARMS: [(&str, &str); 7] = [
    ("numbers=f64:paper, ties=arrival, queue=all", "\\fpaper"),
    ("numbers=f64:tetgen, ties=arrival, queue=all", "\\ftetgen"),
    ("numbers=f64:plain, ties=arrival, queue=all", "\\fsixtyfour"),
    ("numbers=f64:once, ties=arrival, queue=all", "\\fonce"),
    (
        "numbers=f64:paper, ties=perturbed, queue=all",
        "\\fpaper, perturbed",
    ),
    (
        "numbers=f64:once, ties=perturbed, queue=all",
        "\\fonce, perturbed",
    ),
    ("numbers=exact", "exact"),
];

/// Failures, and below them the interval of their rate in percent.
fn families(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("flip_order")?).only("subfamily=all")?;
    let heads = ARMS.map(|(_, head)| (head, "", Format::Whole));
    let mut table = Table::new("lrrrrrrrrr", &["family", "inputs", "tied"], &heads);
    for (family, rows) in all.by("family")? {
        let of_exact = rows.only("times=exact")?;
        let mut counts = vec![family.to_string()];
        for question in ["only(inputs)", "only(exact_ties_runs)"] {
            counts.push(whole(of_exact.number(question)?));
        }
        let mut intervals = vec![String::new(); counts.len()];
        for (arm, _) in ARMS {
            let rows = rows.only(arm)?;
            counts.push(whole(rows.number("only(inputs - ok)")?));
            let [low, high] = [
                rows.number("only(failure_low)")?,
                rows.number("only(failure_high)")?,
            ];
            intervals.push(format!("{:.1}--{:.1}", low * 100.0, high * 100.0));
        }
        table.row(&counts);
        table.row(&intervals);
    }
    Ok(table.into_text(
        "flip_order.csv: subfamily=all; inputs - ok; failure_low, failure_high in percent",
    ))
}

/// Number types that are run on a sample.
const WIDTHS: [(&str, &str); 7] = [
    ("f32", "\\fthirtytwo"),
    ("bits:53", "53 bits"),
    ("bits:106", "106 bits"),
    ("bits:256", "256 bits"),
    ("once:53", "53 bits, once"),
    ("once:256", "256 bits, once"),
    ("naive", "naive"),
];

fn widths(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("flip_order")?).only("subfamily=all")?;
    let heads = WIDTHS.map(|(_, head)| (head, "", Format::Whole));
    let mut table = Table::new("lrrrrrrr", &["family"], &heads);
    for (family, rows) in all.by("family")? {
        let mut cells = vec![family.to_string()];
        for (times, _) in WIDTHS {
            let rows = rows.only(&format!("times={times}"))?;
            let [failed, of] = [
                rows.number("only(inputs - ok)")?,
                rows.number("only(inputs)")?,
            ];
            cells.push(format!("{} of {}", whole(failed), whole(of)));
        }
        table.row(&cells);
    }
    Ok(table.into_text("flip_order.csv: subfamily=all; inputs - ok, inputs"))
}

const OUTCOMES: [(&str, &str); 8] = [
    (
        "not_delaunay",
        "crossing tetrahedra gone, faces not locally Delaunay",
    ),
    (
        "stuck_schoenhardt",
        "stuck: half of what is left is Sch\\\"onhardt's polyhedron",
    ),
    (
        "stuck_no_tetrahedralization",
        "stuck: what is left has no tetrahedralization",
    ),
    (
        "stuck_tetrahedralizable",
        "stuck: what is left has one that was not found",
    ),
    ("stuck_undecided", "stuck: too large for the search"),
    ("displaced", "triangles of other polygons torn out"),
    ("endless", "flips go round in circles"),
    ("inputs - ok", "all failures"),
];

/// Of the arms in the order of arrival.
fn outcomes(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("flip_order")?).only("subfamily=all")?;
    let arms = &ARMS[..4];
    let mut heads = vec!["outcome of failed insertions"];
    heads.extend(arms.iter().map(|(_, head)| head));
    let mut table = Table::new("lrrrr", &heads, &[]);
    for (what, name) in OUTCOMES {
        if name == "all failures" {
            table.rule();
        }
        let mut row = vec![name.to_string()];
        for (arm, _) in arms {
            row.push(whole(all.only(arm)?.number(&format!("sum({what})"))?));
        }
        table.row(&row);
    }
    Ok(table.into_text("flip_order.csv: subfamily=all; sums over families"))
}

/// Failures by precision, a column for each family.
fn precision(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("flip_order")?).only("subfamily=all")?;
    let families = all.by("family")?;
    let names: Vec<String> = families.iter().map(|f| f.0.replace('-', "")).collect();
    let mut text = format!(
        "% flip_order.csv: subfamily=all; failure_rate in percent by precision\nbits {}\n",
        names.join(" ")
    );
    for (times, _) in all.only("times=bits:*")?.by("times")? {
        text += times.trim_start_matches("bits:");
        for (_, rows) in &families {
            let rate = rows.number(&format!("only[times={times}](failure_rate)"))?;
            text += &format!(" {:.3}", rate * 100.0);
        }
        text.push('\n');
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::sheet::Sheet;

    #[test]
    fn families_are_columns_of_the_plot() {
        let text = "family,subfamily,times,failure_rate\n\
            a-b,all,bits:8,0.5\na-b,all,f64,0.1\nc,all,bits:8,0.0\nc,all,f64,0.2\n";
        let sheet = Sheet::parse("flip_order.csv", text).expect("a CSV");
        let points = precision(&Sheets::of([("flip_order", sheet)])).expect("complete");
        assert!(points.ends_with("bits ab c\n8 50.000 0.000\n"), "{points}");
    }
}
