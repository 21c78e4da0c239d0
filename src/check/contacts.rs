//! Everything that touches in a PLC where it must not, as the repair of inputs wants it: which vertices lie on which
//! edges and facets, and whether anything crosses.

use super::findings::{Conflict, Findings};
use super::parts::Parts;
use super::rank;
use super::search::{Face, Search};
use crate::exchange::Plc;
use crate::mesh::{TetMesh, VertexId};
use rustc_hash::FxHashSet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

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

/// What one thread has found.
#[derive(Default)]
struct Found {
    pairs: FxHashSet<[u32; 2]>,
    on_edges: FxHashSet<([VertexId; 2], VertexId)>,
    on_triangles: FxHashSet<(u32, VertexId)>,
}

/// All contacts of the parts of a PLC; `None` as soon as there is one that needs a new vertex. With `merging`, edges
/// that merging coplanar facets drops may cross others.
///
/// With a tetrahedralization of all vertices, only what it does not have is looked at closely, which is much faster.
pub(crate) fn contacts(
    plc: &Plc,
    parts: &Parts,
    merging: bool,
    mesh: Option<&TetMesh>,
) -> Option<Contacts> {
    let search = Search::new(plc, parts, merging, mesh);
    let crossing = AtomicBool::new(false);
    let mut all = Found::default();
    let _ = search.equal_simplices(&mut |pair| {
        all.pairs.insert(pair);
        ControlFlow::Continue(())
    });
    let visit = |i: usize, j: usize, found: &mut Found| {
        if crossing.load(Ordering::Relaxed) || !search.touch(i, j) {
            return;
        }
        if search.needs_vertex(i, j) {
            crossing.store(true, Ordering::Relaxed);
            return;
        }
        let faces = [search.face(i), search.face(j)];
        let _ = search.pairs_of_owners(faces, &mut |pair| {
            found.pairs.insert(pair);
            ControlFlow::Continue(())
        });
        match faces {
            [Face::Vertex(v), Face::Edge(e)] => {
                let edge = &parts.edges[e];
                let owners = &parts.edge_owners[edge.owners.clone()];
                if owners.iter().any(|owner| owner.declared) {
                    found.on_edges.insert((edge.ends, v));
                }
            }
            [Face::Vertex(v), Face::Triangle(part)] => {
                found.on_triangles.insert((part, v));
            }
            _ => {}
        }
    };
    let join = |found: &mut Found, more: Found| {
        found.pairs.extend(more.pairs);
        found.on_edges.extend(more.on_edges);
        found.on_triangles.extend(more.on_triangles);
    };
    join(&mut all, search.simplices().collect(&visit, &join));
    if crossing.into_inner() {
        return None;
    }
    let mut contacts = Contacts {
        pairs: all.pairs.into_iter().collect(),
        on_edges: all.on_edges.into_iter().collect(),
        on_triangles: all.on_triangles.into_iter().collect(),
    };
    contacts.pairs.sort_unstable();
    contacts.on_edges.sort_unstable();
    contacts.on_triangles.sort_unstable();
    Some(contacts)
}

/// The first `most` pairs of parts that intersect in a way that needs a new vertex, with everything else that the check
/// says. These are found where [`contacts`] gives up.
pub(crate) fn crossings(plc: &Plc, merging: bool, most: usize) -> Findings {
    let parts = Parts::new(plc);
    let search = Search::new(plc, &parts, merging, None);
    let mut pairs: FxHashSet<[u32; 2]> = FxHashSet::default();
    let stopped = search.simplices().pairs(&mut |i, j| {
        if !search.touch(i, j) || !search.needs_vertex(i, j) {
            return ControlFlow::Continue(());
        }
        search.pairs_of_owners([search.face(i), search.face(j)], &mut |pair| {
            pairs.insert(pair);
            match pairs.len() < most {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        })
    });
    let mut pairs: Vec<_> = pairs.into_iter().collect();
    pairs.sort_unstable();
    let conflict = |[f, g]: [u32; 2]| Conflict {
        repairable: false,
        ..rank::conflict(&plc.vertices, &parts, [f as usize, g as usize])
    };
    Findings {
        conflicts: pairs.into_iter().map(conflict).collect(),
        stopped: stopped.is_break(),
        notes: super::notes(&parts),
        errors: parts.errors,
    }
}
