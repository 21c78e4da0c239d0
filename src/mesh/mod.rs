//! The tetrahedral mesh: topology alone. Nothing here knows a coordinate or a number type.

mod export;
mod flip;
mod ids;
mod incidence;
mod topology;

pub use export::{ExactPosition, ExportedEdge, ExportedFace, ExportedMesh};
pub(crate) use ids::any_infinite;
pub use ids::{Corner, TetId, VertexId};
pub use incidence::Incidence;
pub(crate) use topology::slot_of;
pub use topology::{FACET, NEXT, TetMesh, TopologyError};
