//! Models of any size, made rather than collected: the kinds of the paper's Table 1 (parts with bores, mazes, blocks of
//! crossing bores, a bent pipe with cuts that are not quite flat) and others that are hard in ways of their own.
//!
//! ```
//! use tetflip::generate::{Kind, generate};
//! let plc = generate(Kind::Cheese, 1, 5000);
//! assert_eq!(plc, generate(Kind::Cheese, 1, 5000));
//! assert!((2500..10_000).contains(&plc.facets.len()));
//! assert!(tetflip::check::check(&plc, None).conflicts.is_empty());
//! ```
//!
//! # Valid by construction
//! No model is the result of a boolean operation, and none is tried and thrown away: facets are drawn where they
//! belong. Bores meet in cubic cells, features have places of their own, and what is drawn twice has the same
//! coordinates. Facets of more than three corners are exactly planar, since they lie across a coordinate axis, or have
//! two edges parallel to one, or come from lattices whose points are exact; all but those of [`Kind::Bend`], whose
//! purpose is that they are not.
//!
//! # Reproducible
//! Kind, seed and size give the same bits on every platform: random numbers are ChaCha8's, and there is no arithmetic
//! but sums, products, quotients and square roots (`draw`). In time all generators are linear in the size, but for
//! sorting.

mod bend;
mod cells;
mod cheese;
mod classic;
mod confetti;
mod crankcase;
mod draft;
mod draw;
mod knot;
mod maze;
mod part;
mod radial;
mod round;
mod sponge;
mod terrain;
mod thin;
mod turned;

use crate::exchange::Plc;
use draw::Draw;
use std::fmt;
use std::str::FromStr;

/// The largest size: a size above it is taken for it.
pub const MOST_FACETS: usize = 20_000_000;

/// A kind of model.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Kind {
    /// An L of two plates with a fillet and rows of bores, some with a counterbore.
    Bracket,
    /// A block with bores, counterbores, pockets and bosses on all sides.
    Part,
    /// A case with cylinders, liners and a crankshaft: regions in regions, and parts that do not touch.
    Crankcase,
    /// A maze on a wheel: level polygons with very many corners, with islands.
    Maze,
    /// A block full of crossing bores, some of them closed voids.
    Cheese,
    /// A bent pipe, cut at a slant and in its middle: polygons that are flat only to rounding.
    Bend,
    /// A helical gear: long thin triangles, and faces with many corners and holes.
    Gear,
    /// A shaft of steps and chamfers: rings of cocircular and cospherical vertices.
    Shaft,
    /// A box of rooms, every room a region; some walls are missing, some rooms are holes.
    Cells,
    /// Layers of ground that thin out, every part a region.
    Terrain,
    /// A ball with spikes.
    Star,
    /// Schönhardt's polyhedra, twisted prisms that need Steiner points.
    Schoenhardt,
    /// Chazelle's polyhedron, which needs quadratically many.
    Chazelle,
    /// Menger's sponge: most vertices coplanar and cospherical with many others.
    Sponge,
    /// A tube around a torus knot.
    Knot,
    /// Polygons, segments and vertices that float in a box.
    Confetti,
    /// A sphere of triangles, all vertices cospherical up to rounding.
    Sphere,
    /// Pages that meet in one edge at small angles.
    Fan,
    /// Layers of long thin tetrahedra that pass each other closely.
    Needles,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Kind; 19] = [
        Kind::Bracket,
        Kind::Part,
        Kind::Crankcase,
        Kind::Maze,
        Kind::Cheese,
        Kind::Bend,
        Kind::Gear,
        Kind::Shaft,
        Kind::Cells,
        Kind::Terrain,
        Kind::Star,
        Kind::Schoenhardt,
        Kind::Chazelle,
        Kind::Sponge,
        Kind::Knot,
        Kind::Confetti,
        Kind::Sphere,
        Kind::Fan,
        Kind::Needles,
    ];

    /// Its name, as it is parsed.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// What it is, in a line.
    pub fn about(self) -> &'static str {
        self.row().2
    }

    /// The least size that can be kept; sizes below it give the smallest model of the kind, or one near it.
    pub fn least(self) -> usize {
        self.row().1
    }

    fn row(self) -> (&'static str, usize, &'static str) {
        match self {
            Kind::Bracket => ("bracket", 60, "an L of two plates with rows of bores"),
            Kind::Part => (
                "part",
                60,
                "a block with bores, pockets and bosses on all sides",
            ),
            Kind::Crankcase => (
                "crankcase",
                200,
                "a case with cylinders, liners, bearings and a crankshaft; 3 regions",
            ),
            Kind::Maze => (
                "maze",
                60,
                "a maze on a wheel: polygons of very many corners, with islands",
            ),
            Kind::Cheese => ("cheese", 200, "a block full of crossing bores, with voids"),
            Kind::Bend => (
                "bend",
                40,
                "a bent pipe, cut three times: polygons flat only to rounding; 2 regions",
            ),
            Kind::Gear => (
                "gear",
                100,
                "a helical gear: long thin triangles, faces of many corners and holes",
            ),
            Kind::Shaft => (
                "shaft",
                40,
                "steps and chamfers: rings of cocircular and cospherical vertices",
            ),
            Kind::Cells => (
                "cells",
                40,
                "a box of rooms, each a region; walls are missing, rooms are holes",
            ),
            Kind::Terrain => (
                "terrain",
                150,
                "layers of ground that thin out, each part a region",
            ),
            Kind::Star => ("star", 96, "a ball with spikes"),
            Kind::Schoenhardt => (
                "schoenhardt",
                8,
                "twisted prisms, which need Steiner points",
            ),
            Kind::Chazelle => (
                "chazelle",
                16,
                "notches along z = xy, which need quadratically many Steiner points",
            ),
            Kind::Sponge => (
                "sponge",
                72,
                "Menger's sponge: coplanar and cospherical vertices",
            ),
            Kind::Knot => ("knot", 700, "a tube around a torus knot"),
            Kind::Confetti => (
                "confetti",
                12,
                "polygons, segments and vertices that float in a box",
            ),
            Kind::Sphere => (
                "sphere",
                32,
                "triangles with vertices cospherical up to rounding",
            ),
            Kind::Fan => ("fan", 12, "pages that meet in one edge at small angles"),
            Kind::Needles => (
                "needles",
                12,
                "layers of long thin tetrahedra that pass each other closely",
            ),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// No kind has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no kind of model is called `{0}`")]
pub struct UnknownKind(String);

impl FromStr for Kind {
    type Err = UnknownKind;

    fn from_str(name: &str) -> Result<Kind, UnknownKind> {
        let found = Kind::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| UnknownKind(name.to_owned()))
    }
}

/// The model of a kind with about `size` facets: at least half and at most twice as many, if that is at least
/// [`Kind::least`]. Which models have which number of facets is part of the definition of a kind.
pub fn generate(kind: Kind, seed: u64, size: usize) -> Plc {
    let make = match kind {
        Kind::Bracket => part::bracket,
        Kind::Part => part::machined_part,
        Kind::Crankcase => crankcase::crankcase,
        Kind::Maze => maze::maze,
        Kind::Cheese => cheese::cheese,
        Kind::Bend => bend::bend,
        Kind::Gear => round::gear,
        Kind::Shaft => round::shaft,
        Kind::Cells => cells::cells,
        Kind::Terrain => terrain::terrain,
        Kind::Star => radial::star,
        Kind::Schoenhardt => classic::schoenhardt,
        Kind::Chazelle => classic::chazelle,
        Kind::Sponge => sponge::sponge,
        Kind::Knot => knot::knot,
        Kind::Confetti => confetti::confetti,
        Kind::Sphere => radial::sphere,
        Kind::Fan => thin::fan,
        Kind::Needles => thin::needles,
    };
    make(&mut Draw::new(seed, kind as u64), size.min(MOST_FACETS))
}
