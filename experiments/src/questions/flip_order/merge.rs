//! Joins the results of shards: the same rows as those of one run on all inputs.

use super::plan::Plan;
use super::row::{FailureRow, Summary, joined};
use crate::families::Member;
use crate::frame::Failed;
use crate::frame::record::Results;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use tetflip::recover::polygons::FlipOrder;

/// The last column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Stamp {
    commit: String,
}

/// Reads `flip_order.csv` and `flip_order-failures.csv` of all shards and writes those of the whole, and the plot.
///
/// # Errors
/// If a file cannot be read or written, or if the shards are of different sources. (That they are all there, and none
/// twice, is not known: compare the column `inputs`.)
pub fn merge(shards: &[PathBuf], results: &Results) -> Result<Vec<PathBuf>, Failed> {
    let (mut rows, mut failures, mut stamps) = (Vec::new(), Vec::new(), Vec::new());
    for shard in shards {
        rows.extend(read::<Summary>(&shard.join("flip_order.csv"), &mut stamps)?);
        let path = shard.join("flip_order-failures.csv");
        if path.exists() {
            failures.extend(read::<FailureRow>(&path, &mut stamps)?);
        }
    }
    let stamp = stamps.first().ok_or("no rows")?;
    if stamps.iter().any(|other| other != stamp) {
        return Err("the shards are of different commits".into());
    }
    let plan = Plan::full();
    let key = |row: &FailureRow| -> Result<_, Failed> {
        let member: Member = row.input.parse()?;
        let order: FlipOrder = row.times.parse()?;
        Ok((member.key(), plan.place(order)))
    };
    let mut keyed = Vec::new();
    for row in failures {
        keyed.push((key(&row)?, row));
    }
    keyed.sort_by_key(|(key, _)| *key);
    let failures: Vec<_> = keyed.iter().map(|(_, row)| (row, stamp)).collect();
    let rows = joined(rows, &plan);
    let plot = super::precision(&rows)?;
    let rows: Vec<_> = rows.iter().map(|row| (row, stamp)).collect();
    let mut files = vec![results.rows("flip_order", &rows)?];
    if !failures.is_empty() {
        files.push(results.rows("flip_order-failures", &failures)?);
    }
    files.push(results.text("flip_order-precision.svg", &plot)?);
    Ok(files)
}

fn read<T: DeserializeOwned>(path: &Path, stamps: &mut Vec<Stamp>) -> Result<Vec<T>, Failed> {
    let named = |error: csv::Error| format!("{}: {error}", path.display());
    let mut reader = csv::Reader::from_path(path).map_err(named)?;
    let header = reader.headers().map_err(named)?.clone();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(named)?;
        stamps.push(record.deserialize(Some(&header)).map_err(named)?);
        rows.push(record.deserialize(Some(&header)).map_err(named)?);
    }
    Ok(rows)
}
