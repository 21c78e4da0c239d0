//! The independent check: is this mesh a (Steiner) constrained Delaunay tetrahedralization of that PLC?
//!
//! Whoever made the mesh. Constraints are recognised by geometry, and nothing that the mesh says of itself is believed.
//! Every sign that decides is exact.
//!
//! # What is shared with the construction
//! The numbers that know their sign ([`crate::number`]), the polynomials ([`crate::predicate::formula`]), the type of a
//! parameter along a segment, ids of vertices, vectors and parts of doubles, prefetching and threads. A test in
//! `signs::formulas` compares the polynomials with sums over all permutations in integers, and tests beside each way to
//! a sign compare it with exact numbers. All else is written a second time on purpose: a mistake in the filters, the
//! mesh data structure, or the recovery does not decide both what is built and what is accepted.
//!
//! # The rooms
//! | room | what is in it |
//! |---|---|
//! | `signs` | points, and exact signs of their determinants; sums of areas and volumes; distances |
//! | `lookup` | faces, edges, tetrahedra and cells of facets, by vertices and by points |
//! | `claims` | what a mesh has to satisfy, below |
//!
//! No room uses one below it in this table. Beside them: [`Verdict`], [`Violation`], [`VerifyOptions`], the input in
//! terms of the points of the mesh (`input`), and what all claims look at (`case`).
//!
//! # The claims
//! | file of `claims` | claim |
//! |---|---|
//! | `structure` | indices in range, coordinates finite |
//! | `positions` | vertices with exact positions on a segment have the coordinates of those, rounded |
//! | `orientation` | every tetrahedron is positive |
//! | `listed` | listed faces and edges are faces and edges of tetrahedra |
//! | `crossings` | faces of the boundary that are not exactly on facets cross no others |
//! | `adjacency` | faces have one tetrahedron, or one on each side; no two tetrahedra overlap |
//! | `vertices` | every input vertex in the domain is in the mesh |
//! | `segments` | every segment is a chain of mesh edges |
//! | `facets` | every facet is a union of mesh faces |
//! | `delaunay` | every other face is locally Delaunay |
//! | `markers` | the faces on facets are listed, with markers of these |
//! | `domain` | the tetrahedra fill the domain: the convex hull, or the inside without holes |
//! | `regions` | region attributes |
//!
//! Premise: the PLC is valid, or needs only repairs that move nothing: its facets and segments intersect in common
//! segments and vertices only, or in vertices and edges exactly on others, or overlap in one plane. (If it is not,
//! some claim fails, as no mesh can satisfy all of them; but the verdict does not say that this is the reason.)
//!
//! Tolerance: Steiner points of other programs, and ours once rounded to doubles, are not exactly on their segments
//! and facets. [`VerifyOptions::tolerance`] says how far off they may be to count as on them; what they then have to
//! satisfy is exact: no tetrahedra overlap (`crossings`). The verdict counts how often this was needed. With
//! tolerance 0 nothing is forgiven.

mod case;
mod claims;
mod input;
mod lookup;
mod notes;
mod options;
mod place;
mod signs;
mod verdict;
mod violation;

pub use options::{Domain, MOST_TETS, VerifyOptions};
pub use place::Place;
pub use verdict::{Counts, Verdict};
pub use violation::Violation;

use crate::exchange::ExportedMesh;
use crate::exchange::Plc;
use case::Case;
use input::Input;
use lookup::locate::Locator;
use lookup::tables::Tables;
use signs::distance::ulp;
use std::borrow::Cow;
use verdict::Findings;

/// Checks that `mesh` is a constrained Delaunay tetrahedralization of `plc`, Steiner points permitted.
///
/// O(n) for a mesh of n tetrahedra whose listed faces cover the facets and which has no vertex or edge with very many
/// tetrahedra; O(log m) for each of the m edges of a facet that is more than one polygon. Where faces have to be
/// searched for, each of them costs O(k) for k edges of its facet at its height.
pub fn verify(plc: &Plc, mesh: &ExportedMesh, options: VerifyOptions) -> Verdict {
    let mut findings = Findings::new(options.cap);
    claims::structure::check(plc, mesh, &mut findings);
    if !findings.is_empty() {
        return findings.verdict();
    }
    let mut used = vec![false; mesh.vertices.len()];
    for v in mesh.tets.iter().flatten() {
        used[v.index()] = true;
    }
    let exact = claims::positions::check(mesh, &mut findings);
    if !findings.is_empty() {
        return findings.verdict();
    }
    let (input, points) = Input::new(plc, &used, mesh, exact, options.precision);
    let asked = (plc.facets.is_empty() && plc.segments.is_empty() && mesh.regions.is_empty())
        .then(|| claims::listed::vertices(mesh, used.len()));
    let tets = Cow::Borrowed(&mesh.tets[..]);
    let mut tables = Tables::new(&points, tets, used.clone(), asked.clone());
    findings.counts.tets = mesh.tets.len();
    if !tables.is_positive || !points.are_doubles() {
        let tets = claims::orientation::check(&points, &mesh.tets, &mut findings);
        if findings.counts.turned {
            tables = Tables::new(&points, tets, used, asked);
        }
    }
    let unused = input.site_of.iter().filter(|v| !tables.is_used(**v));
    let singles = unused.chain(&input.holes).chain(&input.regions).copied();
    let case = Case {
        plc,
        mesh,
        options,
        points: &points,
        tables: &tables,
        input: &input,
        locator: Locator::new(&points, &tables, singles),
        // No number is no tolerance.
        tolerance: options.tolerance.max(0.0) * ulp(points.largest()),
        rounding: VerifyOptions::default().tolerance * ulp(points.largest()),
    };
    findings.counts.tolerance = case.tolerance;
    findings.counts.welded = case.input.welded;
    findings.counts.facets_repeated = case.input.repeated();
    let listed = claims::listed::check(&case, &mut findings);
    claims::adjacency::check(&case, &mut findings);
    claims::vertices::check(&case, &mut findings);
    let fates = claims::segments::check(&case, &listed, &mut findings);
    let cover = claims::facets::check(&case, &fates, &listed, &mut findings);
    claims::delaunay::check(
        &case,
        &cover.constrained,
        |f| cover.facet_of(f),
        &mut findings,
    );
    claims::domain::check(&case, &fates, &cover, &mut findings);
    claims::regions::check(&case, &cover.leaks, &mut findings);
    claims::crossings::check(&case, &cover, &mut findings);
    claims::markers::check(&case, &listed, &cover, &mut findings);
    notes::collect(&case, &mut findings);
    findings.counts.exact_signs = points.exact_signs();
    findings.verdict()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the checks look at, for a mesh that uses all its vertices.
    pub(crate) fn with_case(plc: &Plc, mesh: &ExportedMesh, look: impl FnOnce(&Case)) {
        let used = vec![true; mesh.vertices.len()];
        let (input, points) = Input::new(plc, &used, mesh, rustc_hash::FxHashMap::default(), 0.0);
        let tables = Tables::new(&points, Cow::Borrowed(&mesh.tets), used, None);
        look(&Case {
            plc,
            mesh,
            options: VerifyOptions::default(),
            points: &points,
            tables: &tables,
            input: &input,
            locator: Locator::new(&points, &tables, std::iter::empty()),
            tolerance: 0.0,
            rounding: 0.0,
        });
    }
}
