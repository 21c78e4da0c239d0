//! Every facet is a union of mesh faces.
//!
//! Facets that share merged edges ([`super::segments`]) form a group. The faces that the mesh lists are tried first: if they cover
//! a group ([`super::surface`]), and if in the end every face that covers no group is locally Delaunay, nothing has to be
//! searched for. Else each group is looked at as follows ([`super::group`]).
//! The *candidates* are the mesh faces whose centroid
//! is inside the projected area of the group and whose vertices are vertices of it: its input vertices, vertices of the
//! chains that replace its edges, and inside the area any vertex exactly on its plane, and Steiner points within the tolerance of the plane
//! (for facets that are not flat, within the distance of their own vertices from it). They are found by a flood over mesh
//! faces that starts at the edges of the group.
//!
//! A set S of candidates *covers* the group if, exactly,
//! - one face of S is at each edge of the boundary of the group, and two at every other edge of S, and
//! - the projected areas of the faces of S add up to the projected area of the group.
//!
//! The boundary makes the sum of *signed* areas equal to that of the group, so that the second condition holds iff no
//! face of S is turned over: S is projected one to one onto the group. In a flat facet without rounded points all
//! candidates together are the only choice. Nearly flat vertices permit thin tetrahedra between candidates ("shims": all four
//! faces are candidates), and so several surfaces. Tried in this order: the listed faces of the mesh; a part of the
//! candidates that is searched for ([`super::cover`]), with the listed faces inside the mesh; all candidates; a part with those
//! that are not locally Delaunay. The first that leaves no candidate that is not locally Delaunay is taken,
//! else the first that covers the group.
//!
//! A part of a facet (a cell of [`Area`]) is outside the domain, and exempt, if no candidate lies in it and a step from
//! one of its convex corners into it enters no tetrahedron. The facets of a PLC intersect in common segments only, so that
//! a part is inside or outside as a whole. Exempt parts go to [`super::domain`], as they must not enclose anything.

use super::group::{Group, is_on_planes, planes};
use super::listed::Listed;
use super::planar::{Area, distinct};
use super::points::Points;
use super::segments::{Fate, axes_of};
use super::sums::Areas;
use super::surface::Flood;
use super::tables::sorted2;
use super::{Case, Findings};
use crate::mesh::VertexId;
use crate::number::Sign;
use crate::threads;
use std::sync::OnceLock;

/// A part of a facet outside the domain.
pub(super) struct OutsidePart {
    /// The facet.
    pub(super) facet: usize,
    /// Three points of its plane, counterclockwise where the boundary has the part on its left.
    pub(super) frame: [VertexId; 3],
    /// Directed edges with the part to their left.
    pub(super) boundary: Vec<[VertexId; 2]>,
}

/// Which faces cover the facets.
pub(super) struct Cover {
    /// For each mesh face, whether it is one of those that cover a facet.
    pub(super) constrained: Vec<bool>,
    /// The first facet of each candidate, [`NONE`] for other faces.
    facet_of: Vec<u32>,
    /// The exempt parts.
    pub(super) outside: Vec<OutsidePart>,
}

/// No facet.
const NONE: u32 = u32::MAX;

impl Cover {
    /// A facet whose candidate the face is.
    pub(super) fn facet_of(&self, face: usize) -> Option<usize> {
        Some(self.facet_of[face] as usize).filter(|&f| f != NONE as usize)
    }

    fn append(&mut self, part: PartialCover) {
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
pub(super) struct PartialCover {
    /// The mesh faces that cover them.
    constrained: Vec<u32>,
    /// Their candidates, each with a facet.
    candidates: Vec<(u32, u32)>,
    /// Their exempt parts.
    pub(super) outside: Vec<OutsidePart>,
}

impl PartialCover {
    /// The faces are candidates.
    pub(super) fn add_candidates(&mut self, faces: &[usize], facet: usize) {
        let named = faces.iter().map(|&f| (f as u32, facet as u32));
        self.candidates.extend(named);
    }

    /// The faces cover a facet.
    pub(super) fn constrain(&mut self, faces: &[usize]) {
        self.constrained.extend(faces.iter().map(|&f| f as u32));
    }
}

/// Covers all facets.
pub(super) fn check(
    case: &Case,
    fates: &[Fate],
    listed: &Listed,
    findings: &mut Findings,
) -> Cover {
    let mut trial = findings.clone();
    let cover = cover_all(case, fates, listed, true, &mut trial);
    let spheres = &case.tables.spheres;
    if spheres.violated.iter().all(|&f| cover.constrained[f]) {
        *findings = trial;
        return cover;
    }
    cover_all(case, fates, listed, false, findings)
}

/// Covers all facets, by listed faces where they do and that is `quick` enough.
fn cover_all(
    case: &Case,
    fates: &[Fate],
    listed: &Listed,
    quick: bool,
    findings: &mut Findings,
) -> Cover {
    let faces = case.tables.faces.len();
    let groups = groups(case, fates);
    let groups: Vec<&[(usize, usize)]> = groups.chunk_by(|f, g| f.0 == g.0).collect();
    let is_listed = OnceLock::new();
    let is_listed = || {
        is_listed.get_or_init(|| {
            let mut is_listed = vec![false; faces];
            for &f in &listed.surface.faces {
                is_listed[f as usize] = true;
            }
            is_listed
        })
    };
    let trial = findings.trial();
    let parts = threads::in_parts(groups.len(), FEW, |range| {
        let (mut cover, mut own) = (PartialCover::default(), trial.clone());
        let mut finder = quick.then(|| Finder::new(case, fates, listed));
        for group in &groups[range] {
            own.counts.facet_groups += 1;
            if let Some(face) = same_face(case, fates, group) {
                own.counts.facets += 1;
                cover.constrain(&[face]);
                continue;
            }
            let group: Vec<usize> = group.iter().map(|&(_, f)| f).collect();
            if let Some(found) = finder.as_mut().and_then(|finder| finder.cover(&group)) {
                own.counts.facets += group.len();
                own.counts.facets_rounded += usize::from(found.rounded);
                cover.constrain(&found.faces);
                cover.add_candidates(&found.faces, group[0]);
                continue;
            }
            match Group::new(case, fates, group) {
                Some(group) => group.check(is_listed(), &mut cover, &mut own),
                None => own.counts.facets_degenerate += 1,
            }
        }
        (cover, own)
    });
    let mut cover = Cover {
        constrained: vec![false; faces],
        facet_of: vec![NONE; faces],
        outside: Vec::new(),
    };
    for (part, own) in parts {
        cover.append(part);
        findings.append(own);
    }
    findings.counts.constrained_faces = threads::count(faces, 1 << 16, |f| cover.constrained[f]);
    cover
}

/// Fewer groups are one thread's work.
const FEW: usize = 1 << 10;

/// Listed faces that cover a group.
struct Found {
    faces: Vec<usize>,
    /// As in [`super::verdict::Counts::facets_rounded`].
    rounded: bool,
}

/// Finds them where all of the group is in the domain.
struct Finder<'a> {
    case: &'a Case<'a>,
    fates: &'a [Fate],
    flood: Flood<'a>,
    /// The number of the group that has a vertex, or whose planes were asked about it, and the answer.
    own: Vec<u32>,
    asked: Vec<(u32, bool)>,
    group: u32,
}

impl<'a> Finder<'a> {
    fn new(case: &'a Case<'a>, fates: &'a [Fate], listed: &'a Listed) -> Finder<'a> {
        Finder {
            case,
            fates,
            flood: Flood::new(&listed.surface, case.points),
            own: vec![0; case.points.len()],
            asked: vec![(0, false); case.points.len()],
            group: 0,
        }
    }

    fn cover(&mut self, facets: &[usize]) -> Option<Found> {
        let case = self.case;
        let frame = facets.iter().find_map(|&f| case.input.facets[f].frame)?;
        let axes = axes_of(case, frame)?;
        let mut boundary = Vec::new();
        for &f in facets {
            let quickly = polygon(case, self.fates, f, axes);
            boundary.extend(quickly.or_else(|| cells(case, self.fates, f, axes))?);
        }
        self.group += 1;
        let group = self.group;
        for v in boundary.iter().flatten() {
            self.own[v.index()] = group;
        }
        for v in facets.iter().flat_map(|&f| &case.input.facets[f].vertices) {
            self.own[v.index()] = group;
        }
        let known = std::cell::OnceCell::new();
        let mut accepts = |v: VertexId| {
            if self.own[v.index()] == group {
                return true;
            }
            let memory = &mut self.asked[v.index()];
            if memory.0 != group {
                let planes = known.get_or_init(|| planes(case, facets));
                *memory = (group, is_on_planes(case, planes, v));
            }
            memory.1
        };
        let faces = self.flood.cover(axes, &boundary, &mut accepts)?;
        let rounded = match facets {
            [f] => case.input.facets[*f].flat && self.is_rounded(frame, *f, &faces),
            _ => false,
        };
        Some(Found { faces, rounded })
    }

    /// Whether a vertex of the faces is not exactly on the plane. Those of the facet are.
    fn is_rounded(&self, frame: [VertexId; 3], facet: usize, faces: &[usize]) -> bool {
        let case = self.case;
        let vertices = &case.input.facets[facet].vertices;
        let mut others = faces.iter().flat_map(|&f| case.tables.faces[f].key);
        others.any(|v| vertices.binary_search(&v).is_err() && !case.points.is_on_plane(frame, v))
    }
}

/// (first facet of its group, facet) for the facets joined by merged edges, sorted.
fn groups(case: &Case, fates: &[Fate]) -> Vec<(usize, usize)> {
    let mut leader: Vec<usize> = (0..case.input.facets.len()).collect();
    fn find(leader: &mut [usize], mut f: usize) -> usize {
        while leader[f] != f {
            leader[f] = leader[leader[f]];
            f = leader[f];
        }
        f
    }
    for (edge, fate) in case.input.edges.iter().zip(fates) {
        if let (Fate::Merged, [f, g]) = (fate, &edge.facets[..]) {
            let (f, g) = (find(&mut leader, *f), find(&mut leader, *g));
            leader[f.max(g)] = f.min(g);
        }
    }
    let facets = 0..leader.len();
    let mut groups: Vec<_> = facets.map(|f| (find(&mut leader, f), f)).collect();
    groups.sort_unstable();
    groups
}

/// The frequent case: the facet is a triangle, and a mesh face.
fn same_face(case: &Case, fates: &[Fate], group: &[(usize, usize)]) -> Option<usize> {
    let [(_, f)] = group else { return None };
    let facet = &case.input.facets[*f];
    let [a, b, c] = facet.vertices[..] else {
        return None;
    };
    let whole = facet.edges.len() == 3 && facet.holes.is_empty();
    let direct = facet.edges.iter().all(|&e| fates[e] == Fate::Edge);
    case.tables.find_face([a, b, c]).filter(|_| whole && direct)
}

/// The directed edges of a facet with one polygon that passes no vertex twice, counterclockwise, with their chains in place and
/// without those that were merged away.
fn polygon(case: &Case, fates: &[Fate], f: usize, axes: [usize; 2]) -> Option<Vec<[VertexId; 2]>> {
    let facet = &case.input.facets[f];
    let [polygon] = &case.plc.facets[f].polygons[..] else {
        return None;
    };
    let n = polygon.len();
    if n < 3 || facet.vertices.len() != n || facet.edges.len() != n || !facet.holes.is_empty() {
        return None;
    }
    let mut merged = Vec::new();
    let mut edges = Vec::with_capacity(n);
    for i in 0..n {
        let [a, b] = [polygon[i], polygon[(i + 1) % n]].map(|v| case.input.site_of[v.index()]);
        let ends = sorted2([a, b]);
        // Edges are sorted by their ends.
        let found = facet
            .edges
            .binary_search_by_key(&ends, |&e| case.input.edges[e].ends);
        match &fates[facet.edges[found.ok()?]] {
            Fate::Edge => edges.push([a, b]),
            Fate::Merged => merged.push([a, b]),
            Fate::Chain(chain) => {
                let pairs = chain.windows(2);
                edges.extend(pairs.map(|w| {
                    if a == ends[0] {
                        [w[0], w[1]]
                    } else {
                        [w[1], w[0]]
                    }
                }));
            }
            Fate::Outside | Fate::Missing => return None,
        }
    }
    match sign_of_area(case.points, axes, edges.iter().chain(&merged).copied()) {
        Sign::Positive => {}
        Sign::Negative => edges.iter_mut().for_each(|e| e.reverse()),
        Sign::Zero => return None,
    }
    Some(edges)
}

/// The same for any facet.
fn cells(case: &Case, fates: &[Fate], f: usize, axes: [usize; 2]) -> Option<Vec<[VertexId; 2]>> {
    let facet = &case.input.facets[f];
    let mut edges = Vec::new();
    let mut merged = Vec::new();
    for &e in &facet.edges {
        let ends = case.input.edges[e].ends;
        match &fates[e] {
            Fate::Outside | Fate::Missing => return None,
            Fate::Merged => merged.push(ends),
            Fate::Edge | Fate::Chain(_) => {}
        }
        edges.extend(fates[e].edges(ends));
    }
    let area = Area::new(
        case.points,
        axes,
        &distinct(edges.into_iter()),
        &facet.holes,
    );
    if area.upright.is_some() {
        return None;
    }
    let mut boundary = area.boundary();
    boundary.retain(|&e| merged.is_empty() || !merged.contains(&sorted2(e)));
    (!boundary.is_empty()).then_some(boundary)
}

/// The sign of the area that a closed polygon has on its left.
fn sign_of_area(
    points: &Points,
    axes: [usize; 2],
    edges: impl Iterator<Item = [VertexId; 2]> + Clone,
) -> Sign {
    let Some([origin, _]) = edges.clone().next() else {
        return Sign::Zero;
    };
    let quickly = points.quick_area(axes, origin, edges.clone());
    quickly.unwrap_or_else(|| {
        let mut sum = Areas::new(axes);
        for [a, b] in edges.filter(|e| !e.contains(&origin)) {
            sum.add(points, [origin, a, b]);
        }
        sum.sign()
    })
}
