//! `tetflip check`: why an input is no valid PLC.

use super::input::Input;
use super::{Stop, check_outputs, say};
use serde_json::{Value, json};
use std::path::PathBuf;
use tetflip::check::{Conflict, Findings, Part, check_to};
use tetflip::exchange::{Note, NoteCode, Plc, Precision, PrecisionChoice};
use tetflip::format::write_conflicts;
use tetflip::mesh::VertexId;
use tetflip::plc::{EdgeName, FacetName, VertexName};
use tetflip::repair::Welding;

#[derive(clap::Args)]
pub(crate) struct CheckArguments {
    /// The PLC, in any input format; `-` reads stdin.
    input: PathBuf,
    /// The format of the input, whatever its name: poly, smesh, node, off, stl, ply, obj or mesh.
    #[arg(long, value_name = "FORMAT")]
    format: Vec<String>,
    /// Print the findings as one JSON object instead of lines.
    #[arg(long)]
    json: bool,
    /// How far coordinates may be from what was meant: `auto` (what their values tell, see `mesh --help`), `exact`, or
    /// a distance. Facets may be as far from flat.
    #[arg(long, value_name = "auto|exact|DISTANCE", default_value = "auto")]
    precision: PrecisionChoice,
    /// Stop when this many intersecting pairs have been found.
    #[arg(long, value_name = "N")]
    max: Option<usize>,
    /// Write the facets and segments in question for ParaView.
    #[arg(short, long, value_name = "BAD.vtu")]
    output: Option<PathBuf>,
    /// Say nothing; only the exit status.
    #[arg(short, long, conflicts_with = "json")]
    quiet: bool,
}

/// Checks a PLC and prints what is wrong with it.
pub(crate) fn check_file(arguments: &CheckArguments) -> Result<(), Stop> {
    let input = Input::alone(&arguments.input, &arguments.format)?;
    if let Some(path) = &arguments.output {
        if path.extension().is_none_or(|e| e != "vtu") {
            let path = path.display();
            return Err(Stop::input(format!("{path}: the extension must be .vtu")));
        }
        check_outputs(&input, Some(path), None)?;
    }
    let (plc, _) = input.read()?;
    let precision = arguments.precision.of(&plc.vertices);
    let findings = check_to(&plc, arguments.max, precision.delta);
    if let Some(path) = &arguments.output {
        write_conflicts(path, &plc, &findings).map_err(Stop::input)?;
    }
    if arguments.json {
        let text = serde_json::to_string_pretty(&as_json(&plc, &findings, precision))
            .map_err(Stop::input)?;
        say(&text);
    } else if !arguments.quiet {
        lines(&plc, &findings).iter().for_each(|line| say(line));
        let near = near(&plc, precision, &findings);
        near.iter().for_each(|note| say(&note.to_string()));
    }
    if findings.is_valid() {
        Ok(())
    } else {
        Err(Stop::input(format!("{} is no valid PLC", input.name())))
    }
}

/// The findings for people.
fn lines(plc: &Plc, findings: &Findings) -> Vec<String> {
    let what = |repairable: bool| match repairable {
        true => " (mesh repairs this; refused with --strict)",
        false => "",
    };
    let errors = findings.errors.iter();
    let errors = errors.map(|e| format!("{e}{}", what(e.is_repairable())));
    let conflicts = findings.conflicts.iter();
    let conflicts = conflicts.map(|c| c.describe(plc) + what(c.repairable));
    let mut lines: Vec<String> = errors.chain(conflicts).collect();
    let [errors, pairs] = [findings.errors.len(), findings.conflicts.len()];
    let facets = plc.facets.len();
    let more = if findings.stopped {
        " (the search was stopped there)"
    } else {
        ""
    };
    lines.push(if findings.is_valid() {
        format!("valid: {facets} facets, no intersections")
    } else {
        format!("not valid: {errors} wrong for themselves, {pairs} intersecting pairs{more}, {facets} facets in all")
    });
    lines.extend(notes(plc, findings));
    lines
}

/// What `mesh` welds, and what it would weld with a coarser precision.
fn near(plc: &Plc, precision: Precision, findings: &Findings) -> Vec<Note> {
    let mut notes = Welding::of(plc, precision.delta).notes(plc, precision.delta);
    let open = !findings.notes.open_edges.is_empty();
    let coarser = open.then(|| Welding::coarser(plc, precision.delta));
    if let Some((coarser, vertices)) = coarser.flatten() {
        let text = format!(
            "{vertices} vertices of open edges are near others; --precision {coarser:.2e} would weld them (it is \
             {precision} now)"
        );
        notes.push(Note::new(NoteCode::NearVertices, vertices, text));
    }
    notes
}

/// What is unusual, one line for each kind.
fn notes(plc: &Plc, findings: &Findings) -> Vec<String> {
    /// How many are named.
    const SHOWN: usize = 5;
    let mut lines = Vec::new();
    let mut note = |code: &str, count: usize, what: &str, names: Vec<String>| {
        if count > 0 {
            let more = if count > names.len() { ", …" } else { "" };
            lines.push(format!(
                "note[{code}]: {count} {what}: {}{more}",
                names.join(", ")
            ));
        }
    };
    let vertex = |v: VertexId| VertexName::new(plc, v);
    let edge = |ends: [VertexId; 2]| EdgeName::new(plc, ends).to_string();
    let found = &findings.notes;
    let duplicates = found.duplicate_vertices.iter().take(SHOWN);
    note(
        "duplicate-vertices",
        found.duplicate_vertices.len(),
        "vertices coincide with earlier ones and are taken for them",
        duplicates
            .map(|&[v, first]| format!("{} = {}", vertex(v), vertex(first)))
            .collect(),
    );
    let unused = found.unused_vertices.iter().take(SHOWN);
    note(
        "unused-vertices",
        found.unused_vertices.len(),
        "vertices belong to no facet and no segment",
        unused.map(|&v| vertex(v).to_string()).collect(),
    );
    note(
        "open-edges",
        found.open_edges.len(),
        "edges bound one facet only (open surface)",
        found
            .open_edges
            .iter()
            .take(SHOWN)
            .map(|&e| edge(e))
            .collect(),
    );
    let branching = found.branching_edges.iter().take(SHOWN);
    note(
        "branching-edges",
        found.branching_edges.len(),
        "edges bound more than two facets",
        branching
            .map(|&(e, count)| format!("{} ({count})", edge(e)))
            .collect(),
    );
    lines
}

/// The findings for programs: numbers are those of the file.
fn as_json(plc: &Plc, findings: &Findings, precision: Precision) -> Value {
    let vertex = |v: VertexId| VertexName::new(plc, v).number;
    let edge = |ends: [VertexId; 2]| ends.map(vertex);
    let part = |part: Part| match part {
        Part::Facet(index) => {
            let number = FacetName::new(plc, index).number;
            let polygons = plc.facets[index].polygons.iter();
            let polygons: Vec<Vec<i64>> = polygons
                .map(|p| p.iter().map(|&v| vertex(v)).collect())
                .collect();
            json!({"facet": number, "polygons": polygons})
        }
        Part::Segment(index) => json!({"segment": edge(plc.segments[index].ends)}),
        Part::Vertex(v) => json!({"vertex": vertex(v)}),
    };
    let conflict = |c: &Conflict| {
        json!({
            "kind": c.kind.word(),
            "parts": c.parts.map(part),
            "vertex": c.kind.vertex().map(vertex),
            "edges": c.kind.edges().into_iter().map(edge).collect::<Vec<_>>(),
            "point": c.point,
            "repairable": c.repairable,
            "message": c.describe(plc),
        })
    };
    let notes = &findings.notes;
    let branching = notes.branching_edges.iter();
    json!({
        "valid": findings.is_valid(),
        "repairable": findings.is_repairable(),
        "precision": precision,
        "near": near(plc, precision, findings),
        "stopped": findings.stopped,
        "errors": findings.errors.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "conflicts": findings.conflicts.iter().map(conflict).collect::<Vec<_>>(),
        "notes": {
            "duplicate_vertices": notes.duplicate_vertices.iter().map(|&e| edge(e)).collect::<Vec<_>>(),
            "unused_vertices": notes.unused_vertices.iter().map(|&v| vertex(v)).collect::<Vec<_>>(),
            "open_edges": notes.open_edges.iter().map(|&e| edge(e)).collect::<Vec<_>>(),
            "branching_edges": branching
                .map(|&(e, count)| json!({"edge": edge(e), "facets": count}))
                .collect::<Vec<_>>(),
        },
    })
}
