//! The figures that carry the answer: failure rates with their intervals, the price of the exact order, and pictures.

use super::needed::{ARMS, File};
use super::number::{Format, whole};
use super::sheets::Sheets;
use super::table::{Column, Table, cells};
use crate::frame::query::Rows;
use crate::frame::sheet::SheetError;
use std::path::Path;

/// Pictures of the results and what they are called in the paper.
const PICTURES: [(&str, &str); 3] = [
    ("failures-prism-end-78-f64-plain", "picture-failure"),
    ("fig8", "picture-before"),
    ("fig8-after", "picture-after"),
];

/// All of them.
///
/// # Errors
/// If a file, a column or a row is missing.
pub fn files(sheets: &Sheets, results: &Path) -> Result<Vec<File>, SheetError> {
    let mut files = vec![("flip-order-rates.dat".to_string(), rates(sheets)?)];
    if sheets.optional("exactness_cost-price-summary").is_some() {
        files.push(("price.dat".to_string(), price(sheets)?));
        files.push(("price-table.tex".to_string(), price_table(sheets)?));
    }
    if sheets.optional("flip_models-summary").is_some() {
        files.push(("flip-models-table.tex".to_string(), models(sheets)?));
    }
    for (name, file) in PICTURES {
        let path = results.join(format!("{name}.svg"));
        let io = |source| SheetError::Io {
            path: path.clone(),
            source,
        };
        let svg = std::fs::read_to_string(&path).map_err(io)?;
        files.push((format!("{file}.tex"), picture(name, &svg)));
    }
    Ok(files)
}

/// Square roots of failure rates in percent, and of the ends of their intervals: on that scale small rates can be seen.
fn rates(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("flip_order")?).only("subfamily=all")?;
    let mut text = String::from(
        "% flip_order.csv: subfamily=all; square roots of failure_rate in percent, and the distances to those of \
         failure_low, failure_high\nfamily name",
    );
    for i in 0..ARMS.len() {
        text += &format!(" r{i} down{i} up{i}");
    }
    text.push('\n');
    for (place, (family, rows)) in all.by("family")?.iter().enumerate() {
        text += &format!("{place} {family}");
        for (arm, _) in ARMS {
            let rows = rows.only(arm)?;
            let root = |column: &str| Ok((rows.number(&format!("only({column})"))? * 100.0).sqrt());
            let [rate, low, high] = [
                root("failure_rate")?,
                root("failure_low")?,
                root("failure_high")?,
            ];
            text += &format!(" {rate:.3} {:.3} {:.3}", rate - low, high - rate);
        }
        text.push('\n');
    }
    Ok(text)
}

/// The arms of the plot; without enclosures it would need another scale.
const PRICE: [&str; 3] = ["rounded-keys", "no-perturbation", "no-integers"];

/// Ratios of times in general position, with their intervals, where there are any.
fn price(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("exactness_cost-price-summary")?).only("input=generic")?;
    let mut text = String::from(
        "% exactness_cost-price-summary.csv: input=generic; filtered_over_arm, low, high\nabout",
    );
    for arm in PRICE {
        let arm = arm.replace('-', "");
        text += &format!(" {arm} {arm}down {arm}up");
    }
    text.push('\n');
    for (about, rows) in all.by("about")? {
        text += about;
        for arm in PRICE {
            let rows = rows.only(&format!("arm={arm}"))?;
            let ratio = rows.number("only(filtered_over_arm)")?;
            let end = |column: &str| {
                Ok(rows
                    .optional(&format!("first?({column})"))?
                    .unwrap_or(ratio))
            };
            let [low, high] = [end("low")?, end("high")?];
            text += &format!(" {ratio:.4} {:.4} {:.4}", ratio - low, high - ratio);
        }
        text.push('\n');
    }
    Ok(text)
}

/// Of one input and size: the time, and ratios.
const PRICE_COLUMNS: [Column; 1] = [(
    "filtered, \\textmu s",
    "only[arm=filtered](median_microseconds_per_tet)",
    Format::Exact,
)];

fn price_table(sheets: &Sheets) -> Result<String, SheetError> {
    const ARMS: [(&str, &str); 4] = [
        ("rounded-keys", "rounded keys"),
        ("no-perturbation", "no perturbation"),
        ("no-integers", "no integers"),
        ("no-enclosures", "no enclosures"),
    ];
    let all = Rows::all(sheets.get("exactness_cost-price-summary")?);
    let mut heads = vec!["input", "size", "inputs"];
    heads.push(PRICE_COLUMNS[0].0);
    heads.extend(ARMS.map(|a| a.1));
    let mut table = Table::new("lrrrllll", &heads, &[]);
    for (input, rows) in all.by("input")? {
        for (about, rows) in rows.by("about")? {
            let filtered = rows.only("arm=filtered")?;
            let size = about.parse().map_or(about.to_string(), whole);
            let mut row = vec![
                input.to_string(),
                size,
                filtered.text("inputs")?.to_string(),
            ];
            row.extend(cells(&rows, &PRICE_COLUMNS)?);
            for (arm, _) in ARMS {
                row.push(ratio(&rows.only(&format!("arm={arm}"))?)?);
            }
            table.row(&row);
        }
    }
    Ok(table.into_text(
        "exactness_cost-price-summary.csv: median_microseconds_per_tet; filtered_over_arm, low, high; succeeded",
    ))
}

/// A median, its interval, and how many insertions had to be given up.
fn ratio(rows: &Rows) -> Result<String, SheetError> {
    if rows.rows.is_empty() {
        return Ok("--".to_string());
    }
    let failed = rows.number("only(inputs - succeeded)")?;
    let Some(median) = rows.optional("first?(filtered_over_arm)")? else {
        return Ok("all fail".to_string());
    };
    let ends = rows
        .optional("first?(low)")?
        .zip(rows.optional("first?(high)")?);
    let mut text = format!("{median:.2}");
    if let Some((low, high)) = ends {
        text += &format!(" ({low:.2}--{high:.2})");
    }
    if failed > 0.0 {
        text += &format!(", {} fail", whole(failed));
    }
    Ok(text)
}

const MODELS: [Column; 8] = [
    ("models", "only(models_with_regions)", Format::Whole),
    ("tied", "only(models_with_ties)", Format::Whole),
    ("regions", "only(regions)", Format::Whole),
    ("tied", "only(tied_regions)", Format::Whole),
    ("patched", "only(patched_regions)", Format::Whole),
    ("failed", "only(failed_regions)", Format::Whole),
    ("of these tied", "only(failed_tied)", Format::Whole),
    ("failed models", "only(failed_models)", Format::Whole),
];

fn models(sheets: &Sheets) -> Result<String, SheetError> {
    let all = Rows::all(sheets.get("flip_models-summary")?).only("source=generated")?;
    let mut table = Table::new("lrrrrrrrrr", &["arm"], &MODELS);
    for (times, rows) in all.by("times")? {
        let name = match times {
            "f64:paper" => "\\fpaper",
            "f64:tetgen" => "\\ftetgen",
            "f64:plain" => "\\fsixtyfour",
            "f64:once" => "\\fonce",
            "f64:paper,ties=perturbed" => "\\fpaper, perturbed",
            "f64:once,ties=perturbed" => "\\fonce, perturbed",
            "f32" => "\\fthirtytwo",
            other => other,
        };
        let mut row = vec![name.to_string()];
        row.extend(cells(&rows, &MODELS)?);
        table.row(&row);
    }
    Ok(table.into_text("flip_models-summary.csv: source=generated"))
}

/// A picture of the results as TikZ: lines, polygons, discs and the labels beside discs, which is all that they are
/// made of. Text on lines of its own is left to the caption.
fn picture(name: &str, svg: &str) -> String {
    let mut text =
        format!("% {name}.svg\n\\begin{{tikzpicture}}[x=\\pictureunit,y=-\\pictureunit]\n");
    for line in svg.lines() {
        let of = |key: &str| {
            let after = line.split_once(&format!(" {key}=\""))?.1;
            Some(after.split('"').next().unwrap_or_default())
        };
        let number = |key: &str| of(key).and_then(|v| v.parse::<f64>().ok()).unwrap_or(0.0) / 5.0;
        let colour = |key: &str| {
            of(key)
                .unwrap_or("#000000")
                .trim_start_matches('#')
                .to_uppercase()
        };
        if line.starts_with("<line ") {
            text += &format!(
                "\\definecolor{{c}}{{HTML}}{{{}}}\\draw[c,line width={}pt] ({:.2},{:.2})--({:.2},{:.2});\n",
                colour("stroke"),
                number("stroke-width") * 2.5,
                number("x1"),
                number("y1"),
                number("x2"),
                number("y2"),
            );
        } else if line.starts_with("<polygon ") {
            let corners = of("points").unwrap_or_default().split(' ').filter_map(|p| {
                let (x, y) = p.split_once(',')?;
                Some((x.parse::<f64>().ok()? / 5.0, y.parse::<f64>().ok()? / 5.0))
            });
            let path: String = corners.map(|(x, y)| format!("({x:.2},{y:.2})--")).collect();
            text += &format!(
                "\\definecolor{{c}}{{HTML}}{{{}}}\\fill[c,fill opacity={}] {path}cycle;\n",
                colour("fill"),
                of("fill-opacity").unwrap_or("1"),
            );
        } else if line.starts_with("<circle ") {
            let (x, y) = (number("cx"), number("cy"));
            text += &format!(
                "\\definecolor{{c}}{{HTML}}{{{}}}\\fill[c] ({x:.2},{y:.2}) circle[radius={}pt];\n",
                colour("fill"),
                number("r") * 2.0,
            );
            let label = line
                .split_once("<text ")
                .and_then(|(_, t)| t.split_once('>')?.1.split_once('<'));
            if let Some((label, _)) = label {
                text += &format!(
                    "\\node[above right,inner sep=1pt,font=\\scriptsize] at ({x:.2},{y:.2}) {{{label}}};\n"
                );
            }
        }
    }
    text + "\\end{tikzpicture}\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_lines_polygons_and_discs() {
        let svg = "<svg>\n<line x1=\"5\" y1=\"10\" x2=\"15\" y2=\"20\" stroke=\"#555555\" stroke-width=\"0.8\"/>\n\
            <polygon points=\"0,0 5,0 5,5\" fill=\"#d55e00\" fill-opacity=\"0.2\"/>\n\
            <circle cx=\"5\" cy=\"5\" r=\"4\" fill=\"#222222\"/><text x=\"6\" y=\"4\">7</text>\n\
            <text x=\"1\" y=\"2\">t</text>\n";
        let tikz = picture("p", svg);
        assert!(
            tikz.contains("\\draw[c,line width=0.4pt] (1.00,2.00)--(3.00,4.00);"),
            "{tikz}"
        );
        assert!(
            tikz.contains("D55E00")
                && tikz.contains("fill opacity=0.2] (0.00,0.00)--(1.00,0.00)--(1.00,1.00)--cycle")
        );
        assert!(tikz.contains("{7};") && !tikz.contains("{t}"));
    }
}
