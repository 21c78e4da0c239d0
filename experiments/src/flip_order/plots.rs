//! `flip_order-precision.svg`: the failure rate of rounded times against their precision, by family.

use crate::family::FAMILIES;
use crate::flip_order::row::{ALL, Summary};
use crate::plot::{Plot, PlotError, Scale, Series};

/// The plot. Families without a failure at some precision have no point there, because the axes are logarithmic.
///
/// # Errors
/// If nothing has failed at all.
pub fn precision(rows: &[Summary]) -> Result<String, PlotError> {
    let series = FAMILIES.iter().map(|family| {
        let of_family = rows
            .iter()
            .filter(|r| r.family == family.name && r.subfamily == ALL);
        let points = of_family.filter_map(|r| Some((f64::from(r.precision?), r.failure_rate)));
        Series {
            name: family.name.to_string(),
            points: points.filter(|&(_, rate)| rate > 0.0).collect(),
        }
    });
    let plot = Plot {
        title: "Rounded flip times that do not end in the CDT".to_string(),
        x_label: "bits of the significand".to_string(),
        y_label: "part of the inputs".to_string(),
        scale: Scale::Log,
        series: series.filter(|s| !s.points.is_empty()).collect(),
        guides: Vec::new(),
    };
    plot.svg()
}
