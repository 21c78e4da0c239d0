//! Which faces of the mesh cover the facets, and which parts of facets are outside the domain.

use crate::mesh::VertexId;

/// A part of a facet outside the domain.
pub(crate) struct OutsidePart {
    /// The facet.
    pub(crate) facet: usize,
    /// Three points of its plane, counterclockwise where the boundary has the part on its left.
    pub(crate) frame: [VertexId; 3],
    /// Directed edges with the part to their left.
    pub(crate) boundary: Vec<[VertexId; 2]>,
}

/// Which faces cover the facets.
pub(crate) struct Cover {
    /// For each mesh face, whether it is one of those that cover a facet.
    pub(crate) constrained: Vec<bool>,
    /// The first facet of each candidate, [`NONE`] for other faces.
    facet_of: Vec<u32>,
    /// The exempt parts.
    pub(crate) outside: Vec<OutsidePart>,
}

/// No facet.
const NONE: u32 = u32::MAX;

impl Cover {
    /// No facets are covered yet by any of so many faces.
    pub(crate) fn new(faces: usize) -> Cover {
        Cover {
            constrained: vec![false; faces],
            facet_of: vec![NONE; faces],
            outside: Vec::new(),
        }
    }

    /// A facet whose candidate the face is.
    pub(crate) fn facet_of(&self, face: usize) -> Option<usize> {
        Some(self.facet_of[face] as usize).filter(|&f| f != NONE as usize)
    }

    /// Adds what another thread says.
    pub(crate) fn append(&mut self, part: PartialCover) {
        for f in part.constrained {
            self.constrained[f as usize] = true;
        }
        for (f, facet) in part.candidates {
            let of = &mut self.facet_of[f as usize];
            *of = (*of).min(facet);
        }
        self.outside.extend(part.outside);
    }
}

/// What one thread says of some of the facets.
#[derive(Default)]
pub(crate) struct PartialCover {
    /// The mesh faces that cover them.
    constrained: Vec<u32>,
    /// Their candidates, each with a facet.
    candidates: Vec<(u32, u32)>,
    /// Their exempt parts.
    pub(crate) outside: Vec<OutsidePart>,
}

impl PartialCover {
    /// The faces are candidates.
    pub(crate) fn add_candidates(&mut self, faces: &[usize], facet: usize) {
        let named = faces.iter().map(|&f| (f as u32, facet as u32));
        self.candidates.extend(named);
    }

    /// The faces cover a facet.
    pub(crate) fn constrain(&mut self, faces: &[usize]) {
        self.constrained.extend(faces.iter().map(|&f| f as u32));
    }
}
