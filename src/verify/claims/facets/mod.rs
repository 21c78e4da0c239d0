//! Every facet is a union of mesh faces.
//!
//! Facets that share merged edges ([`super::segments`]) form a group. The faces that the mesh lists are tried first:
//! if they cover a group ([`super::super::lookup::surface`]), and if in the end every face that covers no group is
//! locally Delaunay and no other face separates region attributes, nothing has to be searched for. Else each group is
//! looked at as follows ([`group`]). The *candidates* are the mesh faces whose centroid is inside the projected area
//! of the group and whose vertices are vertices of it: its input vertices, vertices of the chains that replace its
//! edges, and inside the area any vertex exactly on its plane, and Steiner points within the tolerance of the plane
//! (for facets that are not flat, within the distance of their own vertices from it). They are found by a flood over
//! mesh faces that starts at the edges of the group.
//!
//! A set S of candidates *covers* the group if, exactly,
//! - one face of S is at each edge of the boundary of the group, and two at every other edge of S, and
//! - the projected areas of the faces of S add up to the projected area of the group.
//!
//! The boundary makes the sum of *signed* areas equal to that of the group, so that the second condition holds iff no
//! face of S is turned over: S is projected one to one onto the group. In a flat facet without rounded points all
//! candidates together are the only choice. Nearly flat vertices permit thin tetrahedra between candidates ("shims":
//! all four faces are candidates), and so several surfaces. Tried in this order: the listed faces of the mesh; a part
//! of these (where the hull is kept, its faces are listed, too); a part of the candidates that is searched for
//! ([`choice`]), with the listed faces inside the mesh; all candidates; a part with those that are *needed*, as they
//! are not locally Delaunay or separate region attributes. The first that leaves no candidate that is needed is
//! taken, else the first that covers the group.
//!
//! A part of a facet (a cell of [`Area`]) is outside the domain, and exempt, if no candidate lies in it and a step
//! from one of its convex corners into it enters no tetrahedron. The facets of a PLC intersect in common segments
//! only, so that a part is inside or outside as a whole. Exempt parts go to [`super::domain`], as they must not
//! enclose anything.

mod choice;
pub(crate) mod covering;
mod finder;
mod group;
mod misfit;
mod planes;

use crate::threads;
use crate::verify::case::Case;
use crate::verify::claims::delaunay::is_locally_delaunay;
use crate::verify::claims::flatness;
use crate::verify::claims::listed::Listed;
use crate::verify::claims::regions;
use crate::verify::claims::segments::Fate;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;
use covering::{Cover, PartialCover};
use finder::Finder;
use group::Group;
use std::sync::OnceLock;

/// Covers all facets.
pub(crate) fn check(
    case: &Case,
    fates: &[Fate],
    listed: &Listed,
    findings: &mut Findings,
) -> Cover {
    let mut trial = findings.clone();
    let cover = cover_all(case, fates, listed, true, &mut trial);
    let violated = &case.tables.spheres.violated;
    let is_delaunay = violated.iter().all(|&f| cover.constrained[f]);
    if (is_delaunay || case.options.any_triangulation) && cover.leaks.is_empty() {
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
                cover.constrain(&[face], group[0].1);
                continue;
            }
            let group: Vec<usize> = group.iter().map(|&(_, f)| f).collect();
            if !is_one_polygon(case, &group, &mut own) {
                continue;
            }
            if let Some(found) = finder.as_mut().and_then(|finder| finder.cover(&group)) {
                own.counts.facets += group.len();
                own.counts.facets_rounded += usize::from(found.rounded);
                cover.constrain(&found.faces, group[0]);
                if is_uneven(case, &group) {
                    cover.add_uneven(&found.faces);
                }
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
    let mut cover = Cover::new(faces);
    for (part, own) in parts {
        cover.append(part);
        findings.append(own);
    }
    cover.finish();
    cover.leaks = regions::leaks(case, &cover.constrained);
    findings.counts.constrained_faces = threads::count(faces, 1 << 16, |f| cover.constrained[f]);
    cover
}

/// Whether a face must be among those that cover the facets: it separates attributes, or is not locally Delaunay.
fn is_needed(case: &Case, f: usize) -> bool {
    (!case.options.any_triangulation && !is_locally_delaunay(case, f))
        || regions::separates(case, f)
}

/// Whether some of the facets may not be exactly on one plane.
fn is_uneven(case: &Case, facets: &[usize]) -> bool {
    let bent = |&f: &usize| !case.input.facets[f].flat && case.input.facets[f].frame.is_some();
    facets.iter().any(bent) || (facets.len() > 1 && case.merges_near())
}

/// Whether the facets of a group are on one plane, exactly or to the stated precision, unless they were merged by
/// angles; reports it if they are not. (What a single facet is like is up to the input.)
fn is_one_polygon(case: &Case, facets: &[usize], findings: &mut Findings) -> bool {
    if facets.len() == 1 || case.options.precision <= 0.0 || planes::planes(case, facets).len() <= 1
    {
        return true;
    }
    let is_flat = flatness::is_flat(case, facets);
    findings.counts.groups_flat_to_precision += usize::from(is_flat);
    let is_right = is_flat || case.options.merge_angle.is_some();
    if !is_right {
        findings.report(Violation::MergedNotFlat {
            facets: facets.to_vec(),
            distance: flatness::bulge(case, facets),
        });
    }
    is_right
}

/// Fewer groups are one thread's work.
const FEW: usize = 1 << 10;

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
        let joined = match fate {
            Fate::Merged => &edge.facets[..],
            Fate::Absorbed(around) => around,
            _ => continue,
        };
        for pair in joined.windows(2) {
            let (f, g) = (find(&mut leader, pair[0]), find(&mut leader, pair[1]));
            leader[f.max(g)] = f.min(g);
        }
    }
    let facets = (0..leader.len()).filter(|&f| !case.input.is_repeated(f));
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
