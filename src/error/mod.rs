//! The ways in which a run can end without a mesh. Bad input and an algorithm that gave up are different things, and
//! both name the vertices and facets in question.
//!
//! Every error has one text. It displays with ids, which count from 0; [`Failure::describe`] writes the same text
//! with the numbers of the user's file.

mod deletion;
mod domain;
mod gave_up;
mod invalid;
mod names;

pub use crate::plc::PlcError;
pub use deletion::{DeletionRefused, Obstacle};
pub use domain::DomainError;
pub use gave_up::{GaveUp, Nearest, NotFlatReason};
pub use invalid::InvalidPlc;
pub(crate) use names::Coordinates;
use names::Names;
pub use names::PointKind;

use crate::delaunay::DelaunayError;
use crate::exchange::Plc;
use std::fmt;

/// Why there is no tetrahedralization.
#[derive(Clone, PartialEq, Debug)]
pub enum Failure {
    /// The vertices do not span space.
    Delaunay(DelaunayError),
    /// The input is no PLC: one of its facets or segments is not what it must be.
    Plc(PlcError),
    /// The input is no PLC: parts of it intersect.
    Invalid(InvalidPlc),
    /// The facets do not say what is inside.
    Domain(DomainError),
    /// The algorithm gave up on what may be a valid PLC.
    GaveUp(GaveUp),
    /// The complex has no polygon of this index.
    NoSuchPolygon(usize),
    /// Who watches the run has stopped it.
    Stopped,
}

impl Failure {
    /// The message, with vertices and facets numbered as in the user's file.
    pub fn describe(&self, plc: &Plc) -> String {
        self.text(Names::of(plc))
    }

    fn text(&self, names: Names) -> String {
        match self {
            Failure::Delaunay(error) => error.to_string(),
            // Its names are those of the file already.
            Failure::Plc(error) => format!("invalid PLC: {error}"),
            Failure::Invalid(error) => format!("invalid PLC: {}", error.text(names)),
            Failure::Domain(error) => error.text(names),
            Failure::GaveUp(error) => format!("gave up: {}", error.text(names)),
            Failure::NoSuchPolygon(index) => format!("there is no polygon {index}"),
            Failure::Stopped => "the run was stopped".to_owned(),
        }
    }

    /// Names the facets of the input that those of a repaired PLC come from ([`Plc::origins`]).
    pub(crate) fn name_origins(&mut self, plc: &Plc) {
        let lists = match self {
            Failure::Invalid(error) => error.facets_mut(),
            Failure::GaveUp(error) => error.facets_mut(),
            // What names facets otherwise has names of the input.
            _ => Vec::new(),
        };
        for facets in lists {
            *facets = plc.of_input(facets);
        }
    }

    /// Whether the input is to blame, and not the algorithm.
    pub fn is_of_input(&self) -> bool {
        !matches!(self, Failure::GaveUp(_))
    }

    /// The region of the polygon that flips have failed to insert, as a PLC in which they can be tried again
    /// ([`region_as_plc`](crate::recover::region::region_as_plc)).
    pub fn region(&self) -> Option<&Plc> {
        match self {
            Failure::GaveUp(
                GaveUp::Stuck { region, .. }
                | GaveUp::NotDelaunay { region, .. }
                | GaveUp::FlipOrder { region, .. }
                | GaveUp::Inverted { region, .. }
                | GaveUp::Displaced { region, .. }
                | GaveUp::Endless { region, .. },
            ) => Some(region),
            _ => None,
        }
    }

    /// Whether Steiner points rounded to doubles can be the reason, so that exact ones are worth a try.
    pub fn is_due_to_rounding(&self) -> bool {
        matches!(
            self,
            Failure::GaveUp(
                GaveUp::NotFlat { .. }
                    | GaveUp::SegmentsTooClose { .. }
                    | GaveUp::SegmentTooShort { .. }
                    | GaveUp::TooManySteinerPoints { .. }
            )
        )
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(Names::IDS))
    }
}

impl std::error::Error for Failure {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Failure::Delaunay(error) => Some(error),
            Failure::Plc(error) => Some(error),
            Failure::Invalid(error) => Some(error),
            Failure::Domain(error) => Some(error),
            Failure::GaveUp(error) => Some(error),
            Failure::NoSuchPolygon(_) | Failure::Stopped => None,
        }
    }
}

/// An error with a text that [`Names`] are filled in to: it displays with ids.
macro_rules! displays_with_ids {
    ($error:ty) => {
        impl std::fmt::Display for $error {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(&self.text($crate::error::Names::IDS))
            }
        }

        impl std::error::Error for $error {}
    };
}
use displays_with_ids;

macro_rules! failure_from {
    ($($variant:ident($error:ty)),*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Failure {
                Failure::$variant(error)
            }
        })*
    };
}
failure_from!(
    Delaunay(DelaunayError),
    Plc(PlcError),
    Invalid(InvalidPlc),
    Domain(DomainError),
    GaveUp(GaveUp)
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::Facet;
    use crate::mesh::VertexId;

    #[test]
    fn one_text_with_ids_or_with_the_numbers_of_the_file() {
        let triangle = [0, 1, 2].map(VertexId).to_vec();
        let plc = Plc {
            first_index: 1,
            facets: vec![Facet {
                polygons: vec![triangle],
                ..Facet::default()
            }],
            holes: vec![[4.0, 0.1, -1e-9]],
            ..Plc::default()
        };
        let segment = [VertexId(0), VertexId(2)];
        let facets = vec![0];
        let crossed = Failure::from(InvalidPlc::SegmentThroughPolygon { facets, segment });
        assert_eq!(
            crossed.to_string(),
            "invalid PLC: segment 0-2 passes through facet 0"
        );
        assert_eq!(
            crossed.describe(&plc),
            "invalid PLC: segment 1-3 passes through facet 1 (1 2 3)"
        );
        let kind = PointKind::Hole;
        let on_facet = Failure::from(DomainError::PointOnFacet { kind, index: 0 });
        assert_eq!(on_facet.to_string(), "hole point 0 lies on a facet");
        assert_eq!(
            on_facet.describe(&plc),
            "hole point 1 (4, 0.1, -0.000000001) lies on a facet"
        );
    }

    #[test]
    fn lists_are_cut() {
        let edges: Vec<[VertexId; 2]> = (0..25).map(|i| [VertexId(i), VertexId(i + 1)]).collect();
        let text = DomainError::Open { edges }.to_string();
        assert!(text.contains("25 edges"), "{text}");
        assert!(text.contains(", 19-20 and 5 more"), "{text}");
    }
}
