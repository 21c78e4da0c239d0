//! What all checks look at.

use crate::exchange::{ExportedMesh, Plc};
use crate::mesh::VertexId;
use crate::verify::input::Input;
use crate::verify::lookup::locate::Locator;
use crate::verify::lookup::tables::Tables;
use crate::verify::options::VerifyOptions;
use crate::verify::place::Place;
use crate::verify::signs::points::Points;

/// The mesh, the PLC and the tables made of them.
pub(crate) struct Case<'a> {
    pub(crate) plc: &'a Plc,
    pub(crate) mesh: &'a ExportedMesh,
    pub(crate) options: VerifyOptions,
    pub(crate) points: &'a Points,
    pub(crate) tables: &'a Tables<'a>,
    pub(crate) input: &'a Input,
    pub(crate) locator: Locator<'a>,
    /// [`VerifyOptions::tolerance`] as a distance.
    pub(crate) tolerance: f64,
    /// The default tolerance as a distance: for facets of the input that are flat only to rounding themselves.
    pub(crate) rounding: f64,
}

impl Case<'_> {
    /// Whether facets may have been merged that are not exactly coplanar.
    pub(crate) fn merges_near(&self) -> bool {
        self.options.merge_angle.is_some() || self.options.precision > 0.0
    }

    /// A point with its coordinates.
    pub(crate) fn place(&self, id: VertexId) -> Place {
        Place {
            id,
            at: self.points.at(id),
        }
    }

    /// The point of an input vertex with its index in the input.
    pub(crate) fn named(&self, input_vertex: usize, point: VertexId) -> Place {
        Place {
            id: VertexId::new(input_vertex),
            at: self.points.at(point),
        }
    }
}
