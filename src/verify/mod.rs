//! The independent check: is this mesh a (Steiner) constrained Delaunay tetrahedralization of that PLC?
//!
//! Whoever made the mesh. Constraints are recognised by geometry, and nothing that the mesh says of itself is believed.
//! Each file below checks one claim; every sign that decides is exact. No code is shared with the predicates' filters,
//! the recovery or the mesh data structure: only numbers that know their sign, and the formulas of the determinants.
//!
//! | file | claim |
//! |---|---|
//! | `structure` | indices in range, coordinates finite |
//! | `positions` | vertices with exact positions on a segment have the coordinates of those, rounded |
//! | `orientation` | every tetrahedron is positive |
//! | `adjacency` | faces have one tetrahedron, or one on each side; no two tetrahedra overlap |
//! | `vertices` | every input vertex in the domain is in the mesh |
//! | `segments` | every segment is a chain of mesh edges |
//! | `facets` | every facet is a union of mesh faces |
//! | `delaunay` | every other face is locally Delaunay |
//! | `domain`, `hull`, `shells`, `winding` | the tetrahedra fill the domain: the convex hull, or the inside without holes |
//! | `regions` | region attributes |
//!
//! Premise: the PLC is valid, that is, its facets and segments intersect in common segments and vertices only. (If it
//! is not, some claim fails, as no mesh can satisfy all of them; but the verdict does not say that this is the reason.)
//!
//! Tolerance: Steiner points of other programs, and ours once rounded to doubles, are not exactly on their segments and
//! facets. [`VerifyOptions::tolerance`] says how far off they may be to count as on them; what they then have to satisfy
//! is exact. The verdict counts how often this was needed. With tolerance 0 nothing is forgiven.

mod accumulator;
mod adjacency;
mod cover;
mod delaunay;
mod directions;
mod distance;
mod domain;
mod facets;
mod filter;
mod fixed;
mod formulas;
mod gather;
mod group;
mod hull;
mod input;
mod listed;
mod locate;
mod orientation;
mod places;
mod planar;
mod plane;
mod points;
mod positions;
mod probe;
mod regions;
mod segments;
mod shells;
mod slabs;
mod structure;
mod sums;
mod surface;
mod sweep;
mod tables;
mod tally;
mod verdict;
mod vertices;
mod violation;
mod winding;
mod words;

pub use verdict::{Counts, Place, Verdict};
pub use violation::Violation;

use crate::exchange::ExportedMesh;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use input::Input;
use locate::Locator;
use points::Points;
use std::borrow::Cow;
use tables::Tables;
use verdict::Findings;

/// The most tetrahedra that can be verified.
pub const MOST_TETS: usize = (1 << 29) - 1;

/// What the mesh is expected to fill.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Domain {
    /// The convex hull if the mesh is convex and does not fit the inside: a boundary face is on no facet, or a hole point
    /// is meshed. Otherwise the inside.
    #[default]
    Auto,
    /// The convex hull of the vertices.
    Hull,
    /// What the facets enclose, without the parts that hold a hole point.
    Inside,
}

/// How to verify.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerifyOptions {
    /// What the mesh is expected to fill.
    pub domain: Domain,
    /// How far a Steiner point may be from its segment or facet, in units in the last place of the largest coordinate.
    pub tolerance: f64,
    /// If given, facets with one marker may have been merged if the dihedral angle between them is at least this many
    /// degrees (TetGen: 179.9). Otherwise only exactly coplanar ones. If the mesh lists edges, such a merged edge may be an
    /// edge of the mesh by chance, but is not listed.
    pub merge_angle: Option<f64>,
    /// How many violations of each kind are listed.
    pub cap: usize,
}

impl Default for VerifyOptions {
    fn default() -> VerifyOptions {
        VerifyOptions {
            domain: Domain::Auto,
            tolerance: 8.0,
            merge_angle: None,
            cap: 20,
        }
    }
}

/// What all checks look at.
struct Case<'a> {
    plc: &'a Plc,
    mesh: &'a ExportedMesh,
    options: VerifyOptions,
    points: &'a Points,
    tables: &'a Tables<'a>,
    input: &'a Input,
    locator: Locator<'a>,
    /// [`VerifyOptions::tolerance`] as a distance.
    tolerance: f64,
    /// The default tolerance as a distance: for facets of the input that are flat only to rounding themselves.
    rounding: f64,
}

impl Case<'_> {
    /// A point with its coordinates.
    fn place(&self, id: VertexId) -> Place {
        Place {
            id,
            at: self.points.at(id),
        }
    }

    /// The point of an input vertex with its index in the input.
    fn named(&self, input_vertex: usize, point: VertexId) -> Place {
        Place {
            id: VertexId::new(input_vertex),
            at: self.points.at(point),
        }
    }
}

/// Checks that `mesh` is a constrained Delaunay tetrahedralization of `plc`, Steiner points permitted.
///
/// O(n) for a mesh of n tetrahedra whose listed faces cover the facets and which has no vertex or edge with very many
/// tetrahedra; O(log m) for each of the m edges of a facet that is more than one polygon. Where faces have to be searched for, each
/// of them costs O(k) for k edges of its facet at its height.
pub fn verify(plc: &Plc, mesh: &ExportedMesh, options: VerifyOptions) -> Verdict {
    let mut findings = Findings::new(options.cap);
    structure::check(plc, mesh, &mut findings);
    if !findings.is_empty() {
        return findings.verdict();
    }
    let mut used = vec![false; mesh.vertices.len()];
    for v in mesh.tets.iter().flatten() {
        used[v.index()] = true;
    }
    let exact = positions::check(mesh, &mut findings);
    if !findings.is_empty() {
        return findings.verdict();
    }
    let (input, points) = Input::new(plc, &used, mesh, exact);
    let asked = (plc.facets.is_empty() && plc.segments.is_empty() && mesh.regions.is_empty())
        .then(|| listed::vertices(mesh, used.len()));
    let tets = Cow::Borrowed(&mesh.tets[..]);
    let mut tables = Tables::new(&points, tets, used.clone(), asked.clone());
    findings.counts.tets = mesh.tets.len();
    if !tables.is_positive || !points.are_doubles() {
        let tets = orientation::check(&points, &mesh.tets, &mut findings);
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
    let listed = listed::check(&case, &mut findings);
    adjacency::check(&case, &mut findings);
    vertices::check(&case, &mut findings);
    let fates = segments::check(&case, &listed, &mut findings);
    let cover = facets::check(&case, &fates, &listed, &mut findings);
    delaunay::check(
        &case,
        &cover.constrained,
        |f| cover.facet_of(f),
        &mut findings,
    );
    domain::check(&case, &fates, &cover, &mut findings);
    regions::check(&case, &cover.constrained, &mut findings);
    findings.counts.exact_signs = points.exact_signs();
    findings.verdict()
}

/// The distance from a non-negative double to the next one, or, if there is none, to the one before.
fn ulp(x: f64) -> f64 {
    let next = x.next_up();
    if next.is_finite() {
        next - x
    } else {
        x - x.next_down()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the checks look at, for a mesh that uses all its vertices.
    pub(super) fn with_case(plc: &Plc, mesh: &ExportedMesh, look: impl FnOnce(&Case)) {
        let used = vec![true; mesh.vertices.len()];
        let (input, points) = Input::new(plc, &used, mesh, rustc_hash::FxHashMap::default());
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
