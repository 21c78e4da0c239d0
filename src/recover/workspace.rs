//! What polygons are inserted into and deleted from: a PLC that has a CDT, and its tetrahedralization.

use super::flatten::Pieces;
use super::flips::FlipScratch;
use super::region::{Region, SideTable};
use super::retriangulate::cavity::CavityScratch;
use super::segments::Subsegments;
use super::subpolygons::Subpolygons;
use crate::clock::{TaskClock, TaskSeconds};
use crate::mesh::{Incidence, TetId, TetMesh};

/// An *edge-protected* PLC (paper §2): all its subsegments are edges of the Delaunay tetrahedralization of its
/// vertices, so that it has a CDT if its polygons are flat. Insertions and deletions of polygons do not change it.
#[derive(Clone, Debug)]
pub(crate) struct EdgeProtectedPlc<P> {
    /// The vertices: those of the input, then Steiner points.
    pub points: P,
    /// Its segments as they are divided.
    pub subsegments: Subsegments,
    /// Its polygons in exactly flat pieces, which are inserted and deleted one by one.
    pub pieces: Pieces,
}

/// The tetrahedralization of an edge-protected PLC, with some of its polygons.
#[derive(Clone, Debug)]
pub(crate) struct ConstrainedMesh {
    /// The tetrahedra, ghosts included.
    pub mesh: TetMesh,
    /// A tetrahedron at each vertex.
    pub incidence: Incidence,
    /// The triangles on polygons.
    pub subpolygons: Subpolygons,
    /// Which pieces of polygons are in the mesh.
    pub inserted: Vec<bool>,
    /// Memory used again for every polygon.
    pub scratch: Scratch,
}

impl ConstrainedMesh {
    /// The given tetrahedralization, with none of so many polygons.
    pub fn new(mesh: TetMesh, incidence: Incidence, polygons: usize) -> ConstrainedMesh {
        ConstrainedMesh {
            mesh,
            incidence,
            subpolygons: Subpolygons::default(),
            inserted: vec![false; polygons],
            scratch: Scratch::default(),
        }
    }

    /// Notes new tetrahedra at their vertices.
    pub fn created(&mut self, tets: &[TetId]) {
        self.incidence.update(&self.mesh, tets);
    }
}

/// Tables that are kept from polygon to polygon. After a failure some are left behind, and grow anew.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    pub flips: FlipScratch,
    pub cavity: CavityScratch,
    pub sides: SideTable,
    pub region: Region,
    pub star: Vec<TetId>,
}

impl Scratch {
    /// From now on, tasks are timed.
    pub fn time_tasks(&mut self) {
        self.cavity.clock = TaskClock::started();
        self.flips.clock = TaskClock::started();
    }

    /// The seconds of tasks since [`Scratch::time_tasks`].
    pub fn task_seconds(&self) -> TaskSeconds {
        self.cavity.clock.seconds().and(self.flips.clock.seconds())
    }
}
