//! A traced insertion as a film: what each event takes away and adds, so that a viewer can step to and fro without
//! geometry.
//!
//! A trace has circuits and kinds of flips only. The tetrahedra follow from them: a 2-3 or 3-2 flip exchanges those of
//! the circuit's five possible tetrahedra that are there for the others; a 4-4 flip turns the edge ab of the triangle
//! abc over, which is in a plane with v and w and in four tetrahedra. At the end the tetrahedra must be those that the
//! insertion itself left; that is asserted.

use crate::flips::order::{Circuit, Insertion, exact_ranks, is_left, takes_turn};
use std::collections::BTreeSet;
use tetflip::mesh::VertexId;
use tetflip::number::Dyadic;
use tetflip::predicate::PointStore;
use tetflip::recover::flips::{
    Evaluation, ExactTimes, Fate, FlipKind, FlipTimes, PolygonMotion, RoundedTimes, Rules,
};

/// A tetrahedron, its vertices ascending.
pub type Tet = [VertexId; 4];

/// One event that did something, or was refused.
#[derive(Clone, Debug)]
pub struct Frame {
    /// v, x, y, z, w.
    pub circuit: Circuit,
    /// What became of it. Never [`Fate::Stale`].
    pub fate: Fate,
    /// The tetrahedra that it removed.
    pub removed: Vec<Tet>,
    /// The tetrahedra that it made.
    pub created: Vec<Tet>,
    /// The exact time, rounded to a double; none if exact numbers never flip the triangle (D ≤ 0).
    pub exact_time: Option<f64>,
    /// The least and the greatest time that doubles compute, by the order in which the tetrahedron's vertices are
    /// stored, which a trace does not tell; none where they would not queue it.
    pub rounded_times: Option<[f64; 2]>,
    /// The place, from 1, among the events that came off the queue alive, in exact order.
    pub rank: Option<usize>,
}

/// The film of an insertion into one region.
#[derive(Clone, Debug)]
pub struct Film {
    /// The tetrahedra before.
    pub before: Vec<Tet>,
    /// What happens.
    pub frames: Vec<Frame>,
    /// The tetrahedra in the end.
    pub end: Vec<Tet>,
}

/// A tetrahedron with its vertices ascending.
fn sorted(mut tet: [VertexId; 4]) -> Tet {
    tet.sort_unstable();
    tet
}

impl Film {
    /// Follows an insertion.
    ///
    /// # Panics
    /// If the trace is not that of an insertion, so that the tetrahedra do not follow from it.
    pub fn of<P: PointStore>(points: &P, insertion: &Insertion) -> Film {
        let before: BTreeSet<Tet> = insertion.before.iter().map(|&t| sorted(t)).collect();
        let mut now = before.clone();
        let left = |v| is_left(points, insertion.frame, v);
        let motion = PolygonMotion::new(points, insertion.frame, &left);
        let mut exact = ExactTimes::<P, Dyadic>::new(&motion);
        let mut rounded = RoundedTimes::<P, f64>::new(&motion, Evaluation::Plain, Rules::default());
        let mut ranks = exact_ranks(points, insertion).into_iter();
        let mut frames = Vec::new();
        for &(circuit, fate) in &insertion.events {
            if fate == Fate::Stale {
                continue;
            }
            let (removed, created) = match kind(fate) {
                Some(kind) => exchange(points, &now, circuit, kind),
                None => Default::default(),
            };
            for tet in &removed {
                assert!(now.remove(tet), "what is removed was there");
            }
            for &tet in &created {
                assert!(now.insert(tet), "what is made is new");
            }
            let quotient = exact.quotient(circuit);
            frames.push(Frame {
                circuit,
                fate,
                removed,
                created,
                exact_time: quotient.map(|q| -q.parts().0.quotient(q.parts().1)),
                rounded_times: rounded_times(&mut rounded, circuit),
                rank: if takes_turn(fate) {
                    ranks.next().expect("a rank for each event alive")
                } else {
                    None
                },
            });
        }
        let (_, end) = insertion.end.as_ref().expect("the insertion has ended");
        let end: BTreeSet<Tet> = end.iter().map(|&t| sorted(t)).collect();
        assert_eq!(now, end, "the flips lead to the end");
        Film {
            before: before.into_iter().collect(),
            frames,
            end: end.into_iter().collect(),
        }
    }
}

/// The range of the times of a circuit vxyzw over the even permutations of vxyz.
fn rounded_times<P: PointStore>(
    times: &mut RoundedTimes<P, f64>,
    circuit: Circuit,
) -> Option<[f64; 2]> {
    let [v, x, y, z, _] = circuit;
    let halves = [[v, x, y, z], [x, v, z, y], [y, z, v, x], [z, y, x, v]];
    let orders = halves
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c, d], [a, c, d, b], [a, d, b, c]]);
    let mut range: Option<[f64; 2]> = None;
    for order in orders {
        if let Some(timing) = times.time_across(order, circuit, |_, _| true) {
            let [least, most] = range.unwrap_or([timing.time; 2]);
            range = Some([least.min(timing.time), most.max(timing.time)]);
        }
    }
    range
}

/// The flip of an event, if there was one.
pub fn kind(fate: Fate) -> Option<FlipKind> {
    match fate {
        Fate::Flipped(kind) | Fate::FlippedFromList(kind) | Fate::FlippedNonCrossing(kind) => {
            Some(kind)
        }
        Fate::Stale | Fate::Impossible | Fate::OutsideRegion | Fate::DroppedFromList => None,
    }
}

/// What a flip removes from the tetrahedra and what it makes.
fn exchange<P: PointStore>(
    points: &P,
    now: &BTreeSet<Tet>,
    circuit: Circuit,
    kind: FlipKind,
) -> (Vec<Tet>, Vec<Tet>) {
    if kind == FlipKind::FourFour {
        return turn_edge_over(points, now, circuit);
    }
    let without = |i: usize| {
        let rest = (0..5).filter(|&j| j != i).map(|j| circuit[j]);
        let rest: Vec<VertexId> = rest.collect();
        sorted(rest.try_into().expect("four of five"))
    };
    (0..5).map(without).partition(|tet| now.contains(tet))
}

/// A 4-4 flip: the star of ab, with the link v c w u, becomes that of vw, with the link a c b u.
fn turn_edge_over<P: PointStore>(
    points: &P,
    now: &BTreeSet<Tet>,
    [v, x, y, z, w]: Circuit,
) -> (Vec<Tet>, Vec<Tet>) {
    for [a, b, c] in [[x, y, z], [y, z, x], [z, x, y]] {
        let star: Vec<Tet> = now
            .iter()
            .copied()
            .filter(|t| t.contains(&a) && t.contains(&b))
            .collect();
        let link: BTreeSet<VertexId> = star.iter().flatten().copied().collect();
        let others: Vec<VertexId> = link
            .into_iter()
            .filter(|u| ![a, b, c, v, w].contains(u))
            .collect();
        let ([u], 4, true) = (
            &others[..],
            star.len(),
            points.orient3d([v, w, a, b]).is_zero(),
        ) else {
            continue;
        };
        let u = *u;
        let created = [[a, c], [c, b], [b, u], [u, a]].map(|[p, q]| sorted([v, w, p, q]));
        return (star, created.to_vec());
    }
    panic!("a 4-4 flip has an edge in four tetrahedra")
}

/// The triangles between two of the tetrahedra that are not on the polygon's plane and not locally Delaunay.
pub fn not_delaunay<P: PointStore>(
    points: &P,
    frame: [VertexId; 3],
    tets: &[Tet],
) -> Vec<[VertexId; 3]> {
    let mut sides = std::collections::BTreeMap::<[VertexId; 3], Vec<VertexId>>::new();
    for &[a, b, c, d] in tets {
        for (facet, apex) in [
            ([b, c, d], a),
            ([a, c, d], b),
            ([a, b, d], c),
            ([a, b, c], d),
        ] {
            sides.entry(facet).or_default().push(apex);
        }
    }
    let is_bad = |&([x, y, z], ref apices): &([VertexId; 3], Vec<VertexId>)| {
        let &[v, w] = &apices[..] else { return false };
        let [a, b, c] = frame;
        let on_plane = [x, y, z]
            .iter()
            .all(|&p| points.orient3d([a, b, c, p]).is_zero());
        let inside = points.insphere([v, x, y, z, w]).is_positive()
            == points.orient3d([v, x, y, z]).is_positive();
        !on_plane && inside
    };
    sides.into_iter().filter(is_bad).map(|(f, _)| f).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::Member;
    use crate::questions::flip_order::measure::watched;
    use tetflip::recover::polygons::{FlipOrder, NumberType};

    fn films(member: &str, times: FlipOrder) -> Vec<Film> {
        let member: Member = member.parse().expect("a name");
        let cdt = member.prepare().cdt;
        let (_, _, trace) = watched(&cdt, times);
        let film = |i| Film::of(cdt.points(), i);
        trace.insertions.iter().map(film).collect()
    }

    #[test]
    fn films_of_all_kinds_of_flips_lead_to_the_end() {
        let (mut four, mut listed, mut patched) = (0, 0, 0);
        for seed in 0..12 {
            for family in [
                "lattice/layers",
                "sphere/centre",
                "prism/right",
                "rectangle/slab",
            ] {
                for times in [FlipOrder::EXACT, FlipOrder::new(NumberType::F64Plain)] {
                    for film in films(&format!("{family}:{seed}"), times) {
                        let count = |f: fn(&Fate) -> bool| {
                            film.frames.iter().filter(|frame| f(&frame.fate)).count()
                        };
                        four += count(|f| kind(*f) == Some(FlipKind::FourFour));
                        listed += count(|f| matches!(f, Fate::FlippedFromList(_)));
                        patched += count(|f| matches!(f, Fate::FlippedNonCrossing(_)));
                        let exact: Vec<_> = film.frames.iter().map(|f| f.rank).collect();
                        if times == FlipOrder::EXACT {
                            assert!(exact.iter().all(Option::is_some) && exact.is_sorted());
                        }
                    }
                }
            }
        }
        assert!(
            four > 20 && listed > 5 && patched > 20,
            "{four} {listed} {patched}"
        );
    }

    #[test]
    fn the_paper_failure_leaves_seven_tetrahedra() {
        let film = &films("prism/end:78", FlipOrder::new(NumberType::F64Plain))[0];
        assert_eq!((film.before.len(), film.end.len()), (7, 8));
        let exact = &films("prism/end:78", FlipOrder::EXACT)[0];
        let kinds: Vec<_> = exact.frames.iter().map(|f| kind(f.fate)).collect();
        assert_eq!(kinds, [Some(FlipKind::ThreeTwo); 3]);
    }
}
