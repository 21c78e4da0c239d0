//! How a run ended, as one word and one number for a table.

use tetflip::error::{Failure, GaveUp};

/// The word of a run that succeeded.
pub const OK: &str = "ok";

/// The column `outcome`: [`OK`], or what kind of failure.
pub fn word<T>(result: &Result<T, Failure>) -> &'static str {
    match result {
        Ok(_) => OK,
        Err(Failure::Delaunay(_)) => "flat-vertex-set",
        Err(
            Failure::Plc(_) | Failure::Invalid(_) | Failure::NoSuchPolygon(_) | Failure::Stopped,
        ) => "invalid-plc",
        Err(Failure::Domain(_)) => "nothing-inside",
        Err(Failure::GaveUp(gave_up)) => match gave_up {
            GaveUp::SegmentTooShort { .. } => "segment-too-short",
            GaveUp::TooManySteinerPoints { .. } => "too-many-steiner-points",
            GaveUp::SegmentsTooClose { .. } => "segments-too-close",
            GaveUp::NotFlat { .. } => "not-flat",
            GaveUp::Stuck { .. } => "stuck",
            GaveUp::NotDelaunay { .. } => "not-delaunay",
            GaveUp::FlipOrder { .. } => "flip-order",
            GaveUp::Inverted { .. } => "inverted",
            GaveUp::Displaced { .. } => "displaced",
            GaveUp::Endless { .. } => "endless",
        },
    }
}

/// The column `left`: the crossing tetrahedra that stuck flips left, the faces that are not locally Delaunay, the
/// inverted tetrahedra, or the displaced triangles of other polygons.
pub fn left<T>(result: &Result<T, Failure>) -> usize {
    match result {
        Err(Failure::GaveUp(GaveUp::Stuck { crossing, .. })) => *crossing,
        Err(Failure::GaveUp(GaveUp::NotDelaunay { faces, .. })) => *faces,
        Err(Failure::GaveUp(GaveUp::Inverted { tets, .. })) => *tets,
        Err(Failure::GaveUp(GaveUp::Displaced { triangles, .. })) => *triangles,
        _ => 0,
    }
}

/// How many of the rows failed, and which, for people: of each row the name, the columns `outcome` and `left`.
pub fn failures<R>(rows: &[R], of: impl Fn(&R) -> (String, &'static str, usize)) -> String {
    let failed: Vec<_> = rows.iter().map(of).filter(|(_, o, _)| *o != OK).collect();
    let mut text = format!("{} runs, {} of them failed\n", rows.len(), failed.len());
    for (name, outcome, left) in failed {
        text += &format!("  {name}: {outcome}, {left} left\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failed(gave_up: GaveUp) -> Result<(), Failure> {
        Err(gave_up.into())
    }

    #[test]
    fn words_and_what_is_left() {
        let facets = vec![0];
        let stuck = failed(GaveUp::Stuck {
            facets: facets.clone(),
            crossing: 5,
            region: Box::default(),
        });
        let dented = failed(GaveUp::NotDelaunay {
            facets,
            faces: 2,
            region: Box::default(),
        });
        assert_eq!((word(&stuck), left(&stuck)), ("stuck", 5));
        assert_eq!((word(&dented), left(&dented)), ("not-delaunay", 2));
        assert_eq!((word(&Ok(())), left(&Ok(()))), (OK, 0));
    }
}
