//! Everything that touches in a PLC where it must not, as the repair of inputs wants it: which vertices lie on which
//! edges and facets, and whether anything crosses.

use super::findings::{Conflict, Findings};
use super::parts::Parts;
use super::rank;
use super::search::{Face, Search};
use super::tree::{Cell, Simplices};
use crate::exchange::Plc;
use crate::mesh::{TetMesh, VertexId};
use rustc_hash::FxHashSet;
use std::ops::ControlFlow;

/// Contacts of different parts elsewhere than in vertices and edges that both have. All lists are sorted.
#[derive(Default)]
pub(crate) struct Contacts {
    /// Pairs of parts by their indices, the lower first.
    pub pairs: Vec<[u32; 2]>,
    /// Vertices in the interior of declared edges, whose ends increase.
    pub on_edges: Vec<([VertexId; 2], VertexId)>,
    /// Parts, and vertices on their triangles that are not corners of these.
    pub on_triangles: Vec<(u32, VertexId)>,
}

/// One thread looks at so many times as many simplices as there are, in all cells together, before others help: where
/// many parts cross, a few are found at once.
const ALONE: usize = 4;

/// What one thread has found.
#[derive(Default)]
struct Found {
    /// Pairs of parts that need a new vertex, and others.
    crossing: FxHashSet<[u32; 2]>,
    pairs: FxHashSet<[u32; 2]>,
    on_edges: FxHashSet<([VertexId; 2], VertexId)>,
    on_triangles: FxHashSet<(u32, VertexId)>,
}

impl Found {
    fn add(&mut self, more: Found) {
        self.crossing.extend(more.crossing);
        self.pairs.extend(more.pairs);
        self.on_edges.extend(more.on_edges);
        self.on_triangles.extend(more.on_triangles);
    }

    /// Adds the parts of two simplices to a set of pairs.
    fn add_pairs(
        &mut self,
        search: &Search,
        [i, j]: [usize; 2],
        set: fn(&mut Found) -> &mut FxHashSet<[u32; 2]>,
    ) {
        let set = set(self);
        let _ = search.pairs_of_owners([search.face(i), search.face(j)], &mut |pair| {
            set.insert(pair);
            ControlFlow::Continue(())
        });
    }

    /// Adds two simplices that touch.
    fn add_contact(&mut self, search: &Search, [i, j]: [usize; 2]) {
        self.add_pairs(search, [i, j], |found| &mut found.pairs);
        match [search.face(i), search.face(j)] {
            [Face::Vertex(v), Face::Edge(e)] => {
                let edge = &search.parts.edges[e];
                let owners = &search.parts.edge_owners[edge.owners.clone()];
                if owners.iter().any(|owner| owner.declared) {
                    self.on_edges.insert((edge.ends, v));
                }
            }
            [Face::Vertex(v), Face::Triangle(part)] => {
                self.on_triangles.insert((part, v));
            }
            _ => {}
        }
    }
}

/// All contacts of the parts of a PLC or, if there are any that need a new vertex, the first `most` pairs of parts that
/// have such, sorted. With `merging`, edges that merging coplanar facets drops may cross others.
///
/// With a tetrahedralization of all vertices, only what it does not have is looked at closely, which is much faster.
pub(crate) fn contacts(
    plc: &Plc,
    parts: &Parts,
    merging: bool,
    most: usize,
    mesh: Option<&TetMesh>,
) -> Result<Contacts, Vec<[u32; 2]>> {
    let search = Search::new(plc, parts, merging, mesh);
    let simplices = search.simplices();
    let mut cells = vec![simplices.everything()];
    let mut all = Found::default();
    let _ = search.equal_simplices(&mut |pair| {
        all.pairs.insert(pair);
        ControlFlow::Continue(())
    });
    let mut crossing = Crossing {
        search: &search,
        most,
        pairs: FxHashSet::default(),
    };
    let mut left = ALONE * cells[0].list.len();
    while let Some(next) = cells.last().map(|cell| cell.list.len())
        && next <= left
    {
        left -= next;
        let visit = &mut |i: usize, j: usize| match search.touch(i, j) {
            true => crossing.add([i, j], &mut all),
            false => ControlFlow::Continue(()),
        };
        if simplices.advance(&mut cells, visit).is_break() {
            break;
        }
    }
    if !crossing.pairs.is_empty() {
        crossing.search_in(&simplices, cells);
        return Err(crossing.sorted());
    }
    let visit = |i: usize, j: usize, found: &mut Found| {
        if search.touch(i, j) {
            match search.needs_vertex(i, j) {
                true => found.add_pairs(&search, [i, j], |found| &mut found.crossing),
                false => found.add_contact(&search, [i, j]),
            }
        }
    };
    all.add(simplices.collect(cells, &visit, &Found::add));
    if !all.crossing.is_empty() {
        crossing.pairs = all.crossing;
        return Err(crossing.sorted());
    }
    let mut contacts = Contacts {
        pairs: all.pairs.into_iter().collect(),
        on_edges: all.on_edges.into_iter().collect(),
        on_triangles: all.on_triangles.into_iter().collect(),
    };
    contacts.pairs.sort_unstable();
    contacts.on_edges.sort_unstable();
    contacts.on_triangles.sort_unstable();
    Ok(contacts)
}

/// Pairs of parts that intersect in a way that needs a new vertex.
struct Crossing<'s, 'p> {
    search: &'s Search<'p>,
    most: usize,
    pairs: FxHashSet<[u32; 2]>,
}

impl Crossing<'_, '_> {
    /// Adds two simplices that touch to the crossings or to the other contacts; whether to go on.
    fn add(&mut self, [i, j]: [usize; 2], found: &mut Found) -> ControlFlow<()> {
        match self.search.needs_vertex(i, j) {
            true => self.add_crossing([i, j]),
            false => {
                found.add_contact(self.search, [i, j]);
                ControlFlow::Continue(())
            }
        }
    }

    fn add_crossing(&mut self, [i, j]: [usize; 2]) -> ControlFlow<()> {
        let Crossing {
            search,
            most,
            pairs,
        } = self;
        search.pairs_of_owners([search.face(i), search.face(j)], &mut |pair| {
            if pairs.len() < *most {
                pairs.insert(pair);
            }
            match pairs.len() < *most {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        })
    }

    /// Looks for more, one after the other.
    fn search_in(&mut self, simplices: &Simplices, mut cells: Vec<Cell>) {
        let search = self.search;
        let mut found = ControlFlow::Continue(());
        while self.pairs.len() < self.most && found.is_continue() && !cells.is_empty() {
            found = simplices.advance(&mut cells, &mut |i, j| match search.touch(i, j)
                && search.needs_vertex(i, j)
            {
                true => self.add_crossing([i, j]),
                false => ControlFlow::Continue(()),
            });
        }
    }

    fn sorted(self) -> Vec<[u32; 2]> {
        let mut pairs: Vec<_> = self.pairs.into_iter().collect();
        pairs.sort_unstable();
        pairs.truncate(self.most);
        pairs
    }
}

/// What the check says of pairs of parts that intersect in a way that needs a new vertex, of which `stopped` tells that
/// there may be more.
pub(crate) fn crossing_findings(
    plc: &Plc,
    parts: &Parts,
    pairs: &[[u32; 2]],
    stopped: bool,
) -> Findings {
    let conflict = |&[f, g]: &[u32; 2]| Conflict {
        repairable: false,
        ..rank::conflict(&plc.vertices, parts, [f as usize, g as usize])
    };
    Findings {
        conflicts: pairs.iter().map(conflict).collect(),
        stopped,
        notes: super::notes(parts),
        errors: parts.errors.clone(),
    }
}
