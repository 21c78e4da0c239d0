//! Which of several faces on a facet cover it: where a facet is flat only to rounding, both triangulations of a shim
//! tetrahedron can be candidates, and several shims on top of each other more than two.
//!
//! A cover has one face at every edge of the facet's boundary, and two or none at every other one. Faces are taken or
//! left as far as that leaves no choice; where it does, both are tried, up to [`TRIALS`] times. Whether what is found
//! also has the facet's area is for the caller to say.

use crate::mesh::VertexId;
use crate::verify::lookup::tables::sorted2;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// How often a choice is made before the search is given up.
const TRIALS: usize = 2000;

/// How many faces the cover has at an edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Need {
    /// One: the boundary of the facet.
    One,
    /// Two, or none: inside the facet, or outside.
    TwoOrNone,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Unknown,
    Taken,
    Left,
}

struct Search<'a> {
    edges_of: Vec<[usize; 3]>,
    faces_at: Vec<Vec<usize>>,
    need: Vec<Need>,
    wanted: &'a [bool],
    accept: &'a dyn Fn(&[usize]) -> bool,
    trials: usize,
}

/// The faces of a cover that the caller accepts, ascending; none if there is no such cover or it is not found. Covers
/// with all `wanted` faces are tried first.
pub(crate) fn find(
    faces: &[[VertexId; 3]],
    need: &BTreeMap<[VertexId; 2], Need>,
    wanted: &[bool],
    accept: &dyn Fn(&[usize]) -> bool,
) -> Option<Vec<usize>> {
    let mut index: FxHashMap<[VertexId; 2], usize> = FxHashMap::default();
    let mut search = Search {
        edges_of: Vec::with_capacity(faces.len()),
        faces_at: Vec::new(),
        need: Vec::new(),
        wanted,
        accept,
        trials: 0,
    };
    let mut edge = |search: &mut Search, e: [VertexId; 2]| {
        *index.entry(e).or_insert_with(|| {
            search.faces_at.push(Vec::new());
            search
                .need
                .push(need.get(&e).copied().unwrap_or(Need::TwoOrNone));
            search.need.len() - 1
        })
    };
    for &e in need.keys() {
        edge(&mut search, e);
    }
    for (f, &[a, b, c]) in faces.iter().enumerate() {
        let edges = [[a, b], [b, c], [a, c]].map(|e| edge(&mut search, sorted2(e)));
        for e in edges {
            search.faces_at[e].push(f);
        }
        search.edges_of.push(edges);
    }
    let all: Vec<usize> = (0..search.need.len()).collect();
    let unknown = vec![State::Unknown; faces.len()];
    let mut with_wanted = unknown.clone();
    for (state, _) in with_wanted.iter_mut().zip(wanted).filter(|(_, w)| **w) {
        *state = State::Taken;
    }
    search
        .solve(with_wanted, all.clone())
        .or_else(|| search.solve(unknown, all))
}

impl Search<'_> {
    fn solve(&mut self, mut state: Vec<State>, changed: Vec<usize>) -> Option<Vec<usize>> {
        self.propagate(&mut state, changed)?;
        let Some(f) = self.choice(&state) else {
            // Nothing that is taken needs any of the rest.
            let taken = (0..state.len()).filter(|&f| state[f] == State::Taken);
            let taken: Vec<usize> = taken.collect();
            return (self.accept)(&taken).then_some(taken);
        };
        let first = if self.wanted[f] {
            [State::Taken, State::Left]
        } else {
            [State::Left, State::Taken]
        };
        first.into_iter().find_map(|choice| {
            self.trials += 1;
            if self.trials > TRIALS {
                return None;
            }
            let mut trial = state.clone();
            trial[f] = choice;
            self.solve(trial, self.edges_of[f].to_vec())
        })
    }

    /// A face that may be the one missing at some edge.
    fn choice(&self, state: &[State]) -> Option<usize> {
        (0..self.need.len()).find_map(|e| {
            let taken = self.count(e, state, State::Taken);
            let open = match self.need[e] {
                Need::One => taken == 0,
                Need::TwoOrNone => taken == 1,
            };
            let mut unknown = self.faces_at[e].iter();
            unknown
                .find(|&&f| open && state[f] == State::Unknown)
                .copied()
        })
    }

    fn count(&self, e: usize, state: &[State], wanted: State) -> usize {
        let faces = self.faces_at[e].iter();
        faces.filter(|&&f| state[f] == wanted).count()
    }

    /// Takes and leaves faces where there is no choice; none if that is a contradiction.
    fn propagate(&self, state: &mut [State], mut changed: Vec<usize>) -> Option<()> {
        while let Some(e) = changed.pop() {
            let taken = self.count(e, state, State::Taken);
            let unknown = self.count(e, state, State::Unknown);
            let decided = match (self.need[e], taken, unknown) {
                (Need::One, 1, _) | (Need::TwoOrNone, 2, _) => State::Left,
                (Need::One, 0, 1) | (Need::TwoOrNone, 1, 1) => State::Taken,
                (Need::TwoOrNone, 0, 1) => State::Left,
                (Need::One, 0, 0) | (Need::TwoOrNone, 1, 0) => return None,
                (Need::One, 2.., _) | (Need::TwoOrNone, 3.., _) => return None,
                _ => continue,
            };
            for &f in &self.faces_at[e] {
                if state[f] == State::Unknown {
                    state[f] = decided;
                    changed.extend(self.edges_of[f]);
                }
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn face(v: [u32; 3]) -> [VertexId; 3] {
        v.map(VertexId)
    }

    fn boundary(ring: &[u32]) -> BTreeMap<[VertexId; 2], Need> {
        let next = ring.iter().cycle().skip(1);
        let edges = ring.iter().zip(next);
        edges
            .map(|(&a, &b)| (sorted2([VertexId(a), VertexId(b)]), Need::One))
            .collect()
    }

    fn all(_: &[usize]) -> bool {
        true
    }

    /// Both triangulations of a square: the one with the face that is wanted.
    #[test]
    fn takes_one_side_of_a_shim() {
        let faces = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]].map(face);
        let square = boundary(&[0, 1, 2, 3]);
        let wanted = |f: usize| (0..4).map(|g| f == g).collect::<Vec<_>>();
        assert_eq!(find(&faces, &square, &wanted(1), &all), Some(vec![0, 1]));
        assert_eq!(find(&faces, &square, &wanted(2), &all), Some(vec![2, 3]));
        assert_eq!(
            find(&faces[1..], &square, &[false; 3], &all),
            Some(vec![1, 2])
        );
        assert_eq!(find(&faces[1..3], &square, &[false; 2], &all), None);
    }

    /// The caller refuses the first cover, so that it is the other one.
    #[test]
    fn goes_on_until_a_cover_is_accepted() {
        let faces = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]].map(face);
        let square = boundary(&[0, 1, 2, 3]);
        for half in [0, 2] {
            let accept = |taken: &[usize]| taken.contains(&half);
            let wanted = [half == 2, false, half == 0, false];
            let found = find(&faces, &square, &wanted, &accept);
            assert_eq!(found, Some(vec![half, half + 1]));
        }
        assert_eq!(find(&faces, &square, &[false; 4], &|_| false), None);
    }

    /// A square with a vertex in the middle, a shim over half of it, and the shim's upright face.
    #[test]
    fn an_upright_face_is_no_part_of_a_cover() {
        let faces = [
            [0, 1, 4],
            [1, 2, 4],
            [2, 3, 4],
            [0, 3, 4],
            [0, 1, 3],
            [1, 3, 4],
        ]
        .map(face);
        let square = boundary(&[0, 1, 2, 3]);
        let cover = find(&faces, &square, &[false; 6], &all).expect("there are two");
        assert!(cover == [0, 1, 2, 3] || cover == [1, 2, 4, 5], "{cover:?}");
        let wanted = [true, false, false, false, false, false];
        assert_eq!(find(&faces, &square, &wanted, &all), Some(vec![0, 1, 2, 3]));
    }
}
