//! What can be wrong with a file, and where.

use std::fmt;
use std::path::PathBuf;

/// Why a file could not be read as a PLC.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// The operating system did not give the file.
    #[error("cannot read {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The extension is none that we know.
    #[error(
        "unknown file extension {0:?}: expected .poly, .smesh, .node, .off, .stl, .ply, .obj or .mesh"
    )]
    UnknownExtension(String),
    /// The list of vertices is empty, which refers to a `.node` file beside the file; but there is only one file.
    #[error("the vertices are in a .node file, which can only be found beside a file with a name")]
    NodesElsewhere,
    /// The file itself is wrong.
    #[error("{at}: {reason}")]
    Malformed {
        /// Where.
        at: FilePosition,
        /// Why.
        reason: Reason,
    },
    /// The file is wrong as what its extension says, and looks like something else.
    #[error("{error} (the file looks like {found}, whatever its extension)")]
    LooksLike {
        /// What is wrong with it.
        #[source]
        error: Box<FormatError>,
        /// What it looks like.
        found: &'static str,
    },
    /// The `.node` file that holds the vertices of a `.poly` or `.smesh` file is wrong.
    #[error("in the .node file of the vertices: {0}")]
    NodeFile(#[source] Box<FormatError>),
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilePosition {
    /// A line of a text file, counted from 1.
    Line(usize),
    /// An offset in a binary file, counted from 0.
    Byte(usize),
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FilePosition::Line(n) => write!(f, "line {n}"),
            FilePosition::Byte(n) => write!(f, "byte {n}"),
        }
    }
}

/// What is wrong at a place in a file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Reason {
    /// The file ends too early.
    #[error("the file ends where {0} should be")]
    Truncated(&'static str),
    /// The line ends too early.
    #[error("the line ends where {0} should be")]
    LineEnds(&'static str),
    /// A word that is not what should stand there.
    #[error("{token:?} is not {expected}")]
    BadToken {
        /// The word, shortened.
        token: String,
        /// What should be there.
        expected: &'static str,
    },
    /// A number written with a decimal comma.
    #[error("{0:?} has a comma where a number has a decimal point")]
    DecimalComma(String),
    /// A coordinate that is infinite, not a number, or too large for a double.
    #[error("{0} is not a finite number")]
    NotFinite(String),
    /// A count below zero.
    #[error("{what} is negative: {count}")]
    NegativeCount {
        /// What is counted.
        what: &'static str,
        /// The count.
        count: i64,
    },
    /// More vertices than ids.
    #[error("{0} vertices are too many")]
    TooManyVertices(u64),
    /// Two vertices have one number.
    #[error("there are two vertices with the number {0}")]
    NumberTwice(i64),
    /// A corner that is no vertex.
    #[error("there is no vertex {index}: vertices are numbered from {first} to {last}")]
    IndexOutOfRange {
        /// The number in the file.
        index: i64,
        /// The first vertex.
        first: i64,
        /// The last vertex.
        last: i64,
    },
    /// Points in the plane, or in four dimensions.
    #[error("the points have dimension {0} instead of 3")]
    Dimension(i64),
    /// A file without vertices.
    #[error("the file has no vertices")]
    NoVertices,
    /// A facet or a polygon without vertices.
    #[error("a facet has no vertices")]
    EmptyFacet,
    /// A face with fewer than three vertices, in a format whose faces are areas.
    #[error("a face has only {0} vertices")]
    ShortFace(i64),
    /// Something follows where the line or the file should end: some count is too small.
    #[error("{0:?} is more than was announced")]
    Trailing(String),
    /// What follows the end of a file may be a part of it that its header does not count.
    #[error("{bytes} bytes follow the last {what}; is its number wrong?")]
    TrailingBytes {
        /// How many bytes.
        bytes: usize,
        /// What is counted.
        what: &'static str,
    },
    /// Something that the format allows, or that programs write, but that no reader here understands.
    #[error("{0} not supported")]
    Unsupported(&'static str),
    /// Something without which the file says nothing.
    #[error("{0} missing")]
    Missing(&'static str),
    /// Something that can be given but once.
    #[error("{0} given twice")]
    Twice(&'static str),
    /// A compressed file.
    #[error("the file is compressed ({0}); unpack it first")]
    Compressed(&'static str),
    /// A text file of 16-bit characters.
    #[error("the file is text in UTF-16; save it as ASCII or UTF-8")]
    Utf16,
    /// A binary STL file whose size is not that of its triangles.
    #[error("{triangles} triangles take {expected} bytes, but the file has {found}")]
    StlSize {
        /// The number of triangles in the header.
        triangles: u32,
        /// The size a file with so many triangles has.
        expected: u64,
        /// The size of the file.
        found: u64,
    },
}
