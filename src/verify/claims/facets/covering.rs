//! Which faces of the mesh cover the facets, and which parts of facets are outside the domain.

use crate::mesh::VertexId;
use crate::verify::claims::regions::Leak;

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
    /// The faces of facets that are not exactly flat, ascending.
    uneven: Vec<u32>,
    /// The first facet that each face covers, [`NONE`] for other faces.
    covers: Vec<u32>,
    /// (face, facet) for what else it covers, sorted: where facets overlap.
    covers_more: Vec<(u32, u32)>,
    /// What separates region attributes although it covers no facet.
    pub(crate) leaks: Vec<Leak>,
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
            uneven: Vec::new(),
            covers: vec![NONE; faces],
            covers_more: Vec::new(),
            leaks: Vec::new(),
        }
    }

    /// The first facet that the face covers.
    pub(crate) fn first_facet_at(&self, face: usize) -> Option<usize> {
        Some(self.covers[face] as usize).filter(|&f| f != NONE as usize)
    }

    /// One facet of each group that the face covers.
    pub(crate) fn facets_at(&self, face: usize) -> impl Iterator<Item = usize> + '_ {
        let start = self
            .covers_more
            .partition_point(|&(f, _)| (f as usize) < face);
        let more = self.covers_more[start..].iter();
        let more = more.take_while(move |&&(f, _)| f as usize == face);
        let first = self.first_facet_at(face).into_iter();
        first.chain(more.map(|&(_, facet)| facet as usize))
    }

    /// Whether the face is on a facet that is not exactly flat.
    pub(crate) fn is_uneven(&self, face: usize) -> bool {
        self.uneven.binary_search(&(face as u32)).is_ok()
    }

    /// Whether any is.
    pub(crate) fn has_uneven(&self) -> bool {
        !self.uneven.is_empty()
    }

    /// After all was appended.
    pub(crate) fn finish(&mut self) {
        self.uneven.sort_unstable();
        self.covers_more.sort_unstable();
    }

    /// A facet whose candidate the face is.
    pub(crate) fn facet_of(&self, face: usize) -> Option<usize> {
        Some(self.facet_of[face] as usize).filter(|&f| f != NONE as usize)
    }

    /// Adds what another thread says.
    pub(crate) fn append(&mut self, part: PartialCover) {
        for (f, facet) in part.constrained {
            self.constrained[f as usize] = true;
            match &mut self.covers[f as usize] {
                first if *first == NONE => *first = facet,
                _ => self.covers_more.push((f, facet)),
            }
        }
        self.uneven.extend(part.uneven);
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
    /// The mesh faces that cover them, each with a facet.
    constrained: Vec<(u32, u32)>,
    /// Those of facets that are not exactly flat.
    uneven: Vec<u32>,
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
    pub(crate) fn constrain(&mut self, faces: &[usize], facet: usize) {
        let named = faces.iter().map(|&f| (f as u32, facet as u32));
        self.constrained.extend(named);
    }

    /// The faces are on facets that are not exactly flat.
    pub(crate) fn add_uneven(&mut self, faces: &[usize]) {
        self.uneven.extend(faces.iter().map(|&f| f as u32));
    }
}
