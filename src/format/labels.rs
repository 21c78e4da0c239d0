//! Names that a file gives to what follows, in turn: objects, groups and materials. They become markers.
//!
//! Facets and segments with the same object, group and material have the same marker: 1, 2, … in the order in which
//! such three first have a facet or segment; 0 where none is named. If all facets and segments have the same three
//! names, nothing tells them apart, and all markers are 0.

use crate::exchange::Plc;
use rustc_hash::FxHashMap;

/// What has a name.
#[derive(Clone, Copy)]
pub(super) enum Label {
    Object,
    Group,
    Material,
}

/// Names in the order of the file.
#[derive(Default)]
pub(super) struct Labels {
    /// The number of facets and of segments before the name; what is named; and the name.
    begun: Vec<([usize; 2], Label, String)>,
}

impl Labels {
    /// A name that holds after so many facets and segments.
    pub fn begin(&mut self, at: [usize; 2], label: Label, name: &str) {
        self.begun
            .push((at, label, name.chars().take(200).collect()));
    }

    /// Those of the next piece of a file, before which there are so many facets and segments.
    pub fn append(&mut self, before: [usize; 2], next: Labels) {
        let shift = |at: [usize; 2]| [at[0] + before[0], at[1] + before[1]];
        let next = next.begun.into_iter();
        self.begun
            .extend(next.map(|(at, label, name)| (shift(at), label, name)));
    }

    /// Gives the facets and segments of a PLC their markers.
    pub fn mark(self, plc: &mut Plc) {
        let all = [plc.facets.len(), plc.segments.len()];
        let ends: Vec<[usize; 2]> = self
            .begun
            .iter()
            .map(|(at, _, _)| *at)
            .chain([all])
            .collect();
        let mut names: [String; 3] = Default::default();
        let mut markers: FxHashMap<[String; 3], i64> = FxHashMap::default();
        let mut runs = vec![([0, 0], ends[0], 0)];
        for ((start, label, name), &end) in self.begun.into_iter().zip(&ends[1..]) {
            names[label as usize] = name;
            if start == end {
                continue;
            }
            let next = markers.len() as i64 + 1;
            let marker = match names.iter().all(String::is_empty) {
                true => 0,
                false => *markers.entry(names.clone()).or_insert(next),
            };
            if marker == next {
                plc.marker_names.push((marker, describe(&names)));
            }
            runs.push((start, end, marker));
        }
        let mut used = runs
            .iter()
            .filter(|(start, end, _)| start != end)
            .map(|run| run.2);
        let first = used.next();
        if used.all(|marker| Some(marker) == first) {
            plc.marker_names.clear();
            return;
        }
        for (start, end, marker) in runs {
            let facets = &mut plc.facets[start[0]..end[0]];
            facets.iter_mut().for_each(|facet| facet.marker = marker);
            let segments = &mut plc.segments[start[1]..end[1]];
            segments
                .iter_mut()
                .for_each(|segment| segment.marker = marker);
        }
    }
}

/// The names that are given, with slashes between them.
fn describe(names: &[String; 3]) -> String {
    let given = names.iter().filter(|name| !name.is_empty());
    given.map(String::as_str).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::Facet;

    fn markers(names: &[(usize, Label, &str)], facets: usize) -> (Vec<i64>, Vec<(i64, String)>) {
        let mut labels = Labels::default();
        for &(at, label, name) in names {
            labels.begin([at, 0], label, name);
        }
        let mut plc = Plc {
            facets: vec![Facet::default(); facets],
            ..Plc::default()
        };
        labels.mark(&mut plc);
        (
            plc.facets.iter().map(|f| f.marker).collect(),
            plc.marker_names,
        )
    }

    #[test]
    fn each_three_names_have_one_marker() {
        use Label::*;
        let (found, names) = markers(
            &[
                (1, Object, "a"),
                (1, Group, "x"),
                (2, Material, "red"),
                (3, Material, ""),
                (4, Group, "y"),
            ],
            5,
        );
        assert_eq!(found, [0, 1, 2, 1, 3]);
        let expected = [(1, "a/x"), (2, "a/x/red"), (3, "a/y")];
        assert_eq!(
            names,
            expected.map(|(marker, name)| (marker, name.to_owned()))
        );
    }

    #[test]
    fn one_name_tells_nothing_apart() {
        let names = [(0, Label::Object, "a"), (3, Label::Object, "b")];
        assert_eq!(markers(&names, 3), (vec![0; 3], vec![]));
        assert_eq!(markers(&[], 2), (vec![0; 2], vec![]));
    }
}
