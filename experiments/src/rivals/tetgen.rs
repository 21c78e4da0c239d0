//! TetGen's output.

use super::process::{Ran, number_after};

/// What a program tells of a successful run.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Processor time of the algorithm.
    pub seconds: f64,
    /// Of these, for polygons (and TetGen's segments).
    pub polygon_seconds: Option<f64>,
    /// Wall clock of the algorithm.
    pub wall: Option<f64>,
    /// Tetrahedra in the end.
    pub tetrahedra: usize,
    /// New vertices.
    pub steiner_points: Option<usize>,
}

/// The switches: no files; a CDT with the hull and without optimization, if there are facets.
pub fn switches(has_facets: bool) -> String {
    if has_facets { "-pcO0NEF" } else { "-NEF" }.to_string()
}

/// What it tells of a run: seconds are of the phases up to the CDT.
pub fn figures(ran: &Ran) -> Option<Figures> {
    let after = |heading| number_after(&ran.text, heading);
    let delaunay = after("Delaunay seconds:")?;
    let recovery: Vec<f64> = [
        "Constrained Delaunay seconds:",
        "Boundary recovery seconds:",
    ]
    .into_iter()
    .filter_map(after)
    .collect();
    let count = |heading| after(heading).map(|n| n as usize);
    let tetrahedra = count("Mesh tetrahedra:")?;
    let polygons: f64 = recovery.iter().sum();
    Some(Figures {
        seconds: delaunay + after("Surface mesh seconds:").unwrap_or(0.0) + polygons,
        polygon_seconds: (!recovery.is_empty()).then_some(polygons),
        wall: None,
        tetrahedra,
        steiner_points: Some(count("Mesh points:")?.saturating_sub(count("Input points:")?)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_and_counts() {
        let text = "Delaunay seconds:  0.5\nSurface mesh seconds:  0.25\nConstrained Delaunay seconds:  2\n\
                    Exterior tets removal seconds:  9\n  Input points: 10\n  Mesh points: 12\n  Mesh tetrahedra: 17\n";
        let ran = Ran {
            text: text.to_string(),
            ..Ran::default()
        };
        let figures = figures(&ran).expect("a success");
        assert_eq!(
            (figures.seconds, figures.polygon_seconds),
            (2.75, Some(2.0))
        );
        assert_eq!((figures.tetrahedra, figures.steiner_points), (17, Some(2)));
        let crashed = Ran {
            text: text[..30].to_string(),
            ..Ran::default()
        };
        assert_eq!(super::figures(&crashed), None);
    }
}
