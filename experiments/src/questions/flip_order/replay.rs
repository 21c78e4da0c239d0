//! One input again, with everything that happens.

use super::measure::{run, watched};
use crate::families::{Member, Prepared};
use crate::flips::order::{Insertion, disorder, exact_ranks, is_left, takes_turn};
use std::fmt::Write;
use tetflip::mesh::VertexId;
use tetflip::predicate::PointStore;
use tetflip::recover::flips::Fate;
use tetflip::recover::polygons::FlipOrder;

/// What happens when the polygons of a member are inserted with the given number type: all events that came off the
/// queue alive, each with its rank in the exact order, and the end.
pub fn replay(member: Member, times: FlipOrder) -> String {
    let Prepared {
        plc,
        cdt,
        steiner_points,
    } = member.prepare();
    let (reference, _, _) = watched(&cdt, FlipOrder::EXACT);
    let (result, _, trace) = watched(&cdt, times);
    let mut text = format!(
        "{member}: {} vertices, {} polygons, {steiner_points} Steiner points; times {}\n",
        plc.vertices.len(),
        plc.facets.len(),
        times
    );
    for insertion in &trace.insertions {
        text += &describe(cdt.points(), insertion, times);
    }
    let run = run(&cdt, times, reference.as_ref().ok());
    match result {
        Ok(_) => text += &format!("outcome: {}\n", run.outcome),
        Err(failure) => text += &format!("outcome: {}: {}\n", run.outcome, failure.describe(&plc)),
    }
    for piece in &run.pieces {
        text += &format!("left: {piece}\n");
        for tet in &piece.tets {
            text += &format!("  {}\n", names(tet));
        }
        for (vertices, triangles) in &piece.locked_halves {
            text += &format!(
                "  one half, {vertices} vertices and {triangles} triangles beside the polygon, has no \
                 tetrahedralization\n"
            );
        }
    }
    if reference.is_err() {
        text += "EXACT ORDER FAILED\n";
    }
    text
}

fn names(vertices: &[VertexId]) -> String {
    let names: Vec<String> = vertices.iter().map(VertexId::to_string).collect();
    names.join(" ")
}

fn describe<P: PointStore>(points: &P, insertion: &Insertion, times: FlipOrder) -> String {
    let mut vertices: Vec<VertexId> = insertion.before.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let left: Vec<VertexId> = vertices
        .iter()
        .copied()
        .filter(|&v| is_left(points, insertion.frame, v))
        .collect();
    let mut text = format!(
        "polygon {}, through {}: {} crossing tetrahedra with {} vertices, left of it {}\n",
        insertion.polygon,
        names(&insertion.frame),
        insertion.before.len(),
        vertices.len(),
        names(&left)
    );
    let mut ranks = exact_ranks(points, insertion).into_iter();
    for &(circuit, fate) in &insertion.events {
        let rank = match takes_turn(fate).then(|| ranks.next()).flatten() {
            Some(Some(rank)) => format!("{rank:>4}"),
            Some(None) => "   –".to_string(),
            None => "    ".to_string(),
        };
        if fate != Fate::Stale {
            let _ = writeln!(text, "{rank}  {:<24} {fate:?}", names(&circuit));
        }
    }
    let d = disorder(points, insertion, times);
    let _ = writeln!(
        text,
        "{} events taken off alive (first column: their places in the exact order), {} pairs in the wrong \
         order, list L at most {}, {} left",
        d.events, d.kendall, d.longest_list, d.list_left
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::recover::polygons::NumberType;

    #[test]
    fn a_replay_tells_the_order_and_the_end() {
        let member: Member = "prism/end:78".parse().expect("a name");
        let text = replay(member, FlipOrder::new(NumberType::F64Plain));
        assert!(text.contains("schoenhardt: 7 tets, 7 vertices"), "{text}");
        assert!(!text.contains(" 0 pairs in the wrong order"), "{text}");
        let text = replay(member, FlipOrder::EXACT);
        assert!(
            text.contains("outcome: ok") && text.contains(" 0 pairs in the wrong order"),
            "{text}"
        );
    }
}
