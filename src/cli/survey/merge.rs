//! One table of several: those of shards, or of different methods.

use super::table::{Row, TableError, header, line_of, parse, write_all};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Makes one table of several, in the order of the models' names, as one survey would have made it. Returns its rows,
/// and how many more were the same as one of them but for what depends on the machine.
pub(super) fn merge(tables: &[PathBuf], output: &Path) -> Result<(Vec<Row>, usize), TableError> {
    let (mut rows, mut known, mut repeated) =
        (Vec::<Row>::new(), BTreeMap::<[String; 4], usize>::new(), 0);
    let mut models = BTreeMap::<String, usize>::new();
    let header = header();
    let lasting: Vec<&str> = header.iter().filter(|name| !fleeting(name)).collect();
    let begin = line_of(&header);
    for path in tables {
        let bytes = std::fs::read(path).map_err(|source| TableError::Io {
            path: path.clone(),
            source,
        })?;
        if !bytes.starts_with(begin.as_bytes()) {
            return Err(TableError::Header { path: path.clone() });
        }
        if !bytes.ends_with(b"\n") {
            return Err(TableError::Torn { path: path.clone() });
        }
        for row in parse(path, &bytes)? {
            // All rows of a model are about the same bytes.
            let of_model = models
                .get(row.get("file"))
                .map(|&i| (i, &["bytes", "hash"][..]));
            let of_run = known.get(&row.key()).map(|&i| (i, &lasting[..]));
            for (other, columns) in of_model.into_iter().chain(of_run) {
                let place = |c: &&&str| {
                    header
                        .iter()
                        .position(|name| name == **c)
                        .expect("a column")
                };
                let differs = |c: &&&str| row.0[place(c)] != rows[other].0[place(c)];
                if let Some(column) = columns.iter().find(differs) {
                    let values = [&row.0[place(&column)], &rows[other].0[place(&column)]];
                    let (file, method, [this, other]) = (row.get("file"), row.method(), values);
                    let row = format!("{file}, {method}: {column} is `{this}`, not `{other}`");
                    return Err(TableError::Conflict {
                        path: path.clone(),
                        row,
                    });
                }
            }
            models
                .entry(row.get("file").to_owned())
                .or_insert(rows.len());
            if of_run.is_some() {
                repeated += 1;
            } else {
                known.insert(row.key(), rows.len());
                rows.push(row);
            }
        }
    }
    rows.sort_by(|a, b| a.get("file").cmp(b.get("file")));
    write_all(output, &rows, None)?;
    Ok((rows, repeated))
}

/// Whether a column depends on the machine, so that two runs may differ in it.
fn fleeting(column: &str) -> bool {
    column.starts_with("seconds") || column == "peak_mib" || column == "system"
}
