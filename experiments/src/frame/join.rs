//! The tables of several shards as one. Counts are added up exactly, so that the joined table is the one that a single
//! machine would have made.

use super::sheet::{Sheet, SheetError};
use std::path::{Path, PathBuf};

/// `STEM.csv` of each directory.
///
/// # Errors
/// If one cannot be read, or if they are not of the same columns and the same sources.
pub fn read(shards: &[PathBuf], stem: &str) -> Result<Vec<Sheet>, SheetError> {
    let sheets = shards
        .iter()
        .map(|shard| read_one(&shard.join(format!("{stem}.csv"))));
    let sheets = sheets.collect::<Result<Vec<Sheet>, SheetError>>()?;
    for sheet in &sheets {
        let commit = |sheet: &Sheet| {
            sheet
                .all()
                .next()
                .and_then(|row| row.text("commit").ok().map(str::to_string))
        };
        let reason = match &sheets[0] {
            first if first.header != sheet.header => "other columns than the first shard's",
            first if commit(first) != commit(sheet) => "made by other sources than the first shard",
            _ => continue,
        };
        return Err(SheetError::Unreadable {
            file: sheet.file.clone(),
            reason: reason.to_string(),
        });
    }
    Ok(sheets)
}

fn read_one(path: &Path) -> Result<Sheet, SheetError> {
    let text = std::fs::read_to_string(path);
    let text = text.map_err(|source| SheetError::Io {
        path: path.to_path_buf(),
        source,
    })?;
    Sheet::parse(&path.to_string_lossy(), &text)
}

/// What a column is, given the counts of the others.
pub type Compute<'a> = &'a dyn Fn(&dyn Fn(&str) -> u64) -> String;

/// Adds up the rows that have the same in all `keys`, in order of appearance: of the columns of `greatest` the
/// greatest, of all others the sum, nothing if a part has nothing. What is neither a key nor a count is `computed`
/// anew.
///
/// # Errors
/// If a cell is no count.
pub fn added(
    shards: &[Sheet],
    keys: &[&str],
    greatest: &[&str],
    computed: (&str, Compute),
) -> Result<Sheet, SheetError> {
    let header = &shards[0].header;
    let is_key = |column: &str| keys.contains(&column) || column == "commit";
    let mut joined = Sheet {
        file: shards[0].file.clone(),
        header: header.clone(),
        cells: Vec::new(),
    };
    for row in shards.iter().flat_map(Sheet::all) {
        let cells = header
            .iter()
            .map(|column| row.text(column).map(str::to_string));
        let cells = cells.collect::<Result<Vec<String>, SheetError>>()?;
        let same = |known: &&mut Vec<String>| {
            (0..header.len()).all(|i| !is_key(&header[i]) || known[i] == cells[i])
        };
        let Some(known) = joined.cells.iter_mut().find(same) else {
            joined.cells.push(cells);
            continue;
        };
        for (i, column) in header.iter().enumerate() {
            if is_key(column) || column == computed.0 {
                continue;
            }
            let count = |cell: &str| {
                cell.parse::<u64>().map_err(|_| SheetError::NoNumber {
                    file: shards[0].file.clone(),
                    line: row.line(),
                    column: column.clone(),
                    value: cell.to_string(),
                })
            };
            if known[i].is_empty() || cells[i].is_empty() {
                known[i].clear();
                continue;
            }
            let (a, b) = (count(&known[i])?, count(&cells[i])?);
            known[i] = if greatest.contains(&&**column) {
                a.max(b)
            } else {
                a + b
            }
            .to_string();
        }
    }
    let at = joined.column(computed.0)?;
    for row in &mut joined.cells {
        let count = |column: &str| {
            let place = header.iter().position(|name| name == column);
            place.and_then(|i| row[i].parse().ok()).unwrap_or(0)
        };
        row[at] = computed.1(&count);
    }
    Ok(joined)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_added() {
        let shards = [
            "family,inputs,ok,longest,ties,rate,commit\na,3,2,9,1,0.333333,c\nb,1,1,0,,0,c\n",
            "family,inputs,ok,longest,ties,rate,commit\nb,2,1,4,5,0.5,c\na,1,1,2,2,0,c\n",
        ];
        let shards = shards.map(|text| Sheet::parse("t.csv", text).expect("a CSV"));
        let rate = |count: &dyn Fn(&str) -> u64| (count("inputs") - count("ok")).to_string();
        let joined = added(&shards, &["family"], &["longest"], ("rate", &rate)).expect("counts");
        assert_eq!(
            joined.cells,
            [
                ["a", "4", "3", "9", "3", "1", "c"],
                ["b", "3", "2", "4", "", "1", "c"]
            ]
        );
        let words =
            Sheet::parse("t.csv", "family,inputs,rate,commit\na,x,0,c\na,1,0,c\n").expect("a CSV");
        let error = added(&[words], &["family"], &[], ("rate", &rate)).expect_err("no count");
        assert!(error.to_string().contains("`x` is no number"), "{error}");
    }
}
