//! What can be wrong with a mesh file, or with a mesh that is to be written.

use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// A mesh could not be read or written.
#[derive(Debug, Error)]
pub enum MeshFileError {
    /// The operating system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The extension names no format of a mesh that can be written.
    #[error("{}: a mesh is written as .node, .ele, .face or .edge (all four files) or .vtu", .path.display())]
    WriteExtension {
        /// The path given.
        path: PathBuf,
    },
    /// The extension names no format of a mesh that can be read.
    #[error(
        "{}: a mesh is read from .node, .ele, .face or .edge (of the same stem), or .mesh (Medit, ASCII)",
        .path.display()
    )]
    ReadExtension {
        /// The path given.
        path: PathBuf,
    },
    /// The format is not one of a single file.
    #[error("{format:?} is no format of a mesh in one file; \"vtu\" is")]
    SingleFile {
        /// The format given.
        format: String,
    },
    /// A line of a file is wrong.
    #[error("{}:{line}: {reason}", .path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        reason: MeshLineError,
    },
    /// The mesh itself is not one that a file can hold; nothing was written.
    #[error("the mesh cannot be written: {0}")]
    Unwritable(#[from] UnwritableMesh),
}

/// What is wrong with a line of a `.node`, `.ele`, `.face` or `.edge` file.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MeshLineError {
    /// The file has no line but comments.
    #[error("the file is empty, not even a header")]
    NoHeader,
    /// A line ends too early.
    #[error("{0} is missing")]
    Missing(&'static str),
    /// A field is no number of the kind that stands there.
    #[error("{what} cannot be `{found}`")]
    BadNumber {
        /// The name of the field.
        what: &'static str,
        /// Its text.
        found: String,
    },
    /// A field is infinite or not a number, or overflows a double.
    #[error("{what} is not finite: `{found}`")]
    NotFinite {
        /// The name of the field.
        what: &'static str,
        /// Its text.
        found: String,
    },
    /// The header promises more lines than there are.
    #[error("the file ends after {found} of {promised} lines")]
    TooFewLines {
        /// The count in the header.
        promised: usize,
        /// The lines found.
        found: usize,
    },
    /// The header promises fewer lines than there are.
    #[error("one line more than the {promised} that the header promises")]
    TooManyLines {
        /// The count in the header.
        promised: usize,
    },
    /// More vertices than 32-bit ids can name.
    #[error("{0} vertices are more than 32-bit ids can name")]
    TooManyVertices(usize),
    /// Vertices are not three-dimensional.
    #[error("dimension {0}, not 3")]
    Dimension(usize),
    /// Vertices are not numbered 0, 1, 2, … or 1, 2, 3, ….
    #[error("vertex number {found}, expected {expected}")]
    VertexNumber {
        /// The number in the file.
        found: i64,
        /// The number that comes next (for the first vertex, 1; 0 would do as well).
        expected: i64,
    },
    /// A tetrahedron, face or edge names a vertex that the `.node` file does not have.
    #[error("vertex {found} does not exist; there are {count}, numbered from {first}")]
    NoSuchVertex {
        /// The number in the file.
        found: i64,
        /// The number of the first vertex.
        first: u32,
        /// The number of vertices.
        count: usize,
    },
    /// Tetrahedra with more or fewer than four vertices: 10 in TetGen's second order meshes.
    #[error(
        "tetrahedra with {0} nodes; only 4 are understood (10 are of second order: tetgen -o2)"
    )]
    NodesPerTet(usize),
}

/// What keeps a mesh from being written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum UnwritableMesh {
    /// The numbers of the vertices would be too large.
    #[error("its first index is {0}, too large for numbers of 32 bits")]
    FirstIndex(u32),
    /// A coordinate is infinite or not a number.
    #[error("vertex {0} has a coordinate that is not finite")]
    Vertex(usize),
    /// The number of region attributes is neither 0 nor that of the tetrahedra.
    #[error("{regions} region attributes for {tets} tetrahedra")]
    RegionCount {
        /// The number of attributes.
        regions: usize,
        /// The number of tetrahedra.
        tets: usize,
    },
    /// A table has not as many rows as what it is about.
    #[error("{rows} {what}, where {expected} are expected")]
    RowCount {
        /// What the rows are.
        what: &'static str,
        /// How many rows there are.
        rows: usize,
        /// How many there should be.
        expected: usize,
    },
    /// An attribute of a vertex is infinite or not a number.
    #[error("vertex {0} has an attribute that is not finite")]
    Attribute(usize),
    /// A face lies on a polygon that is not there, or that has no facets.
    #[error("face {0} lies on a polygon that does not exist")]
    FacePolygon(usize),
    /// A region attribute is infinite or not a number.
    #[error("tetrahedron {0} has a region attribute that is not finite")]
    Region(usize),
    /// A tetrahedron names a vertex that is not there.
    #[error("tetrahedron {0} has a vertex that does not exist")]
    Tet(usize),
    /// A face names a vertex that is not there.
    #[error("face {0} has a vertex that does not exist")]
    Face(usize),
    /// An edge names a vertex that is not there.
    #[error("edge {0} has a vertex that does not exist")]
    Edge(usize),
    /// An exact position names a vertex that is not there, or is not finite.
    #[error(
        "exact position {0} has a vertex that does not exist, or a parameter that is not finite"
    )]
    ExactPosition(usize),
}
