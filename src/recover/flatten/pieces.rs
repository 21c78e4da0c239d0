//! The polygons of a complex in pieces: which pieces are those of a polygon, and whose a piece is.

use crate::mesh::VertexId;
use crate::plc::Complex;
use std::ops::Range;
use std::sync::Arc;

/// On which sides of a piece that is flat only to rounding the mesh is constrained Delaunay when it is inserted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum Fit {
    /// On both.
    #[default]
    Both,
    /// On its right side; the other one is outside of the domain.
    Right,
    /// On its left side.
    Left,
}

/// The polygons of a complex in pieces that are exactly flat, or can be inserted as they are.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// The segments of the complex, and all pieces: polygons that were flat as they are, and the pieces of the others,
    /// whose edges are edges of the mesh. The complex itself if nothing had to be cut.
    pub complex: Arc<Complex>,
    /// The first piece of each polygon, and the number of pieces at the end.
    pub(crate) first: Vec<usize>,
    /// Which polygons are not flat.
    pub(crate) was_cut: Vec<bool>,
    /// Steiner points inside each polygon.
    pub(crate) inner: Vec<Vec<VertexId>>,
    /// How the pieces fit; empty if all do on both sides.
    pub(crate) fits: Vec<Fit>,
}

impl Pieces {
    /// Every polygon in one piece.
    pub(crate) fn whole(complex: Arc<Complex>) -> Pieces {
        let n = complex.polygons.len();
        Pieces {
            complex,
            first: (0..=n).collect(),
            was_cut: vec![false; n],
            inner: vec![Vec::new(); n],
            fits: Vec::new(),
        }
    }

    /// The pieces of polygon f.
    pub fn of(&self, f: usize) -> Range<usize> {
        self.first[f]..self.first[f + 1]
    }

    /// The first piece of each polygon, and the number of pieces.
    pub(crate) fn clone_firsts(&self) -> Vec<usize> {
        self.first.clone()
    }

    /// The polygon that piece `p` belongs to.
    pub fn polygon_of(&self, p: usize) -> usize {
        self.first.partition_point(|&first| first <= p) - 1
    }

    /// Whether polygon f had to be cut.
    pub fn is_cut(&self, f: usize) -> bool {
        self.was_cut[f]
    }

    /// The polygons that had to be cut.
    pub fn cut_polygons(&self) -> impl Iterator<Item = usize> {
        (0..self.was_cut.len()).filter(|&f| self.was_cut[f])
    }

    /// How piece `p` fits.
    pub(crate) fn fit(&self, p: usize) -> Fit {
        self.fits.get(p).copied().unwrap_or_default()
    }

    /// Steiner points inside polygon f.
    pub fn inner_points(&self, f: usize) -> &[VertexId] {
        &self.inner[f]
    }
}
