//! What a mesh has to satisfy, one claim a file; a claim that needs more than one has a directory.

pub(crate) mod adjacency;
pub(crate) mod crossings;
pub(crate) mod delaunay;
pub(crate) mod domain;
pub(crate) mod facets;
pub(crate) mod flatness;
pub(crate) mod listed;
pub(crate) mod markers;
pub(crate) mod orientation;
pub(crate) mod positions;
pub(crate) mod regions;
pub(crate) mod segments;
pub(crate) mod structure;
pub(crate) mod vertices;
