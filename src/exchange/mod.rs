//! What files, the verifier and other languages see: a PLC as it was given and its precision, a mesh as it is written,
//! and notes.

mod hull;
mod mesh;
mod note;
mod plc;
mod precision;
mod unused;

pub use mesh::{ExactPosition, ExportedEdge, ExportedFace, ExportedMesh, FaceTable};
pub use note::{Note, NoteCode};
pub use plc::{Attributes, Facet, Plc, Region, Segment};
pub use precision::{Precision, PrecisionChoice, Rounding};
