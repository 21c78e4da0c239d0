//! The outcome of a verification: what was checked and what does not hold.

use crate::exchange::Note;
use crate::verify::options::Domain;
use crate::verify::violation::Violation;
use std::collections::BTreeMap;
use std::fmt;

/// What was counted on the way. Every exception that a check grants has its own count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counts {
    /// Tetrahedra.
    pub tets: usize,
    /// All tetrahedra were negative, and were read as if two of their vertices were exchanged.
    pub turned: bool,
    /// Vertices that tetrahedra use.
    pub vertices: usize,
    /// Those among them that are not vertices of the input.
    pub steiner_vertices: usize,
    /// Vertices with exact positions that are no doubles.
    pub exact_vertices: usize,
    /// Tetrahedra that are positive, but not with the coordinates of those vertices as they are written.
    pub spoilt_by_rounding: usize,
    /// Distinct input vertices.
    pub input_vertices: usize,
    /// Input vertices in no tetrahedron: outside the domain.
    pub input_vertices_outside: usize,
    /// Input vertices that were welded to others, to the stated precision.
    pub welded: usize,
    /// Faces.
    pub faces: usize,
    /// Faces with one tetrahedron.
    pub boundary_faces: usize,
    /// Faces that cover facets.
    pub constrained_faces: usize,
    /// Interior faces on no facet, all of which must be locally Delaunay.
    pub unconstrained_faces: usize,
    /// Those among them whose two tetrahedra have one circumsphere.
    pub cospherical_faces: usize,
    /// Segments and facet edges that are chains of mesh edges.
    pub segments: usize,
    /// The edges of those chains.
    pub subsegments: usize,
    /// Facet edges merged away between coplanar facets.
    pub segments_merged: usize,
    /// Segments and facet edges outside the domain.
    pub segments_outside: usize,
    /// Inner vertices of the chains that are exactly on the segment.
    pub segment_vertices_exact: usize,
    /// Inner vertices of the chains that are on it up to rounding.
    pub segment_vertices_rounded: usize,
    /// How far off a Steiner point may be from its segment or facet to count as on it.
    pub tolerance: f64,
    /// Faces of the boundary that are not known to be exactly on their facets: each was compared with all near it.
    pub faces_compared: usize,
    /// Listed faces with a marker of their facets.
    pub markers: usize,
    /// Listed faces with 1 or −1 on facets without a marker.
    pub markers_instead: usize,
    /// Listed faces on the boundary.
    pub faces_turned: usize,
    /// Those among them that are not oriented outward.
    pub faces_inward: usize,
    /// Facets that are equal to others.
    pub facets_repeated: usize,
    /// Facets that mesh faces cover.
    pub facets: usize,
    /// The groups into which merged edges join the facets.
    pub facet_groups: usize,
    /// Groups of facets on one plane to the stated precision only.
    pub groups_flat_to_precision: usize,
    /// Groups that are one flat facet, some of whose mesh faces are not exactly flat.
    pub facets_rounded: usize,
    /// Groups without an area.
    pub facets_degenerate: usize,
    /// Parts of facets outside the domain.
    pub facet_parts_outside: usize,
    /// Bounded components of the empty space.
    pub voids: usize,
    /// Hole points in tetrahedra, where the convex hull is kept.
    pub holes_meshed: usize,
    /// Region points whose tetrahedron was compared.
    pub regions: usize,
    /// Whether the mesh was found to fill the convex hull although that was not asked for.
    pub fills_hull: bool,
    /// Edges of the hull that are not convex, but are up to rounding.
    pub hull_dents: usize,
    /// What the mesh was taken to fill; never [`Domain::Auto`] once it is known.
    pub domain: Domain,
    /// The sum of the volumes of the tetrahedra.
    pub volume: f64,
    /// Signs of determinants that doubles did not decide, so that integers had to. (Sums of areas and volumes, and
    /// distances that are compared with the tolerance, are always exact and not counted.)
    pub exact_signs: usize,
}

impl Counts {
    /// Adds what was counted elsewhere in the same check.
    fn add(&mut self, more: Counts) {
        self.segments += more.segments;
        self.subsegments += more.subsegments;
        self.segments_merged += more.segments_merged;
        self.segments_outside += more.segments_outside;
        self.segment_vertices_exact += more.segment_vertices_exact;
        self.segment_vertices_rounded += more.segment_vertices_rounded;
        self.facets += more.facets;
        self.facet_groups += more.facet_groups;
        self.groups_flat_to_precision += more.groups_flat_to_precision;
        self.facets_rounded += more.facets_rounded;
        self.facets_degenerate += more.facets_degenerate;
        self.facet_parts_outside += more.facet_parts_outside;
    }
}

/// The outcome of [`super::verify`].
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What was checked.
    pub counts: Counts,
    /// What was forgiven or assumed.
    pub notes: Vec<Note>,
    /// What does not hold: of each kind the first [`super::options::VerifyOptions::cap`] ones.
    pub violations: Vec<Violation>,
    /// How many violations there are of each kind ([`Violation::kind`]), whether listed or not.
    pub totals: BTreeMap<&'static str, usize>,
}

impl Verdict {
    /// Whether all claims hold.
    pub fn is_ok(&self) -> bool {
        self.totals.is_empty()
    }
}

/// One line for each group of counts, one for each kind of violation, one for each listed violation.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let c = &self.counts;
        let domain = match c.domain {
            Domain::Auto => "unknown",
            Domain::Hull => "convex hull",
            Domain::Inside => "inside of the facets",
        };
        let turned = if c.turned {
            " (all negative: read with the other orientation)"
        } else {
            ""
        };
        writeln!(
            f,
            "tetrahedra: {}{turned}, volume {}, domain: {domain}",
            c.tets, c.volume
        )?;
        writeln!(
            f,
            "vertices: {} used, {} Steiner; input: {}, {} outside",
            c.vertices, c.steiner_vertices, c.input_vertices, c.input_vertices_outside
        )?;
        if c.exact_vertices > 0 {
            writeln!(
                f,
                "exact positions: {} vertices; with their rounded coordinates {} tetrahedra are not positive",
                c.exact_vertices, c.spoilt_by_rounding
            )?;
        }
        writeln!(
            f,
            "faces: {}, {} on the boundary, {} on facets, {} checked for local Delaunayhood ({} cospherical)",
            c.faces,
            c.boundary_faces,
            c.constrained_faces,
            c.unconstrained_faces,
            c.cospherical_faces
        )?;
        writeln!(
            f,
            "segments: {} in {} edges, inner vertices {} exact and {} rounded; {} merged away, {} outside",
            c.segments,
            c.subsegments,
            c.segment_vertices_exact,
            c.segment_vertices_rounded,
            c.segments_merged,
            c.segments_outside
        )?;
        writeln!(
            f,
            "facets: {} in {} groups, {} rounded, {} without area; {} parts outside",
            c.facets, c.facet_groups, c.facets_rounded, c.facets_degenerate, c.facet_parts_outside
        )?;
        if c.groups_flat_to_precision + c.welded > 0 {
            writeln!(
                f,
                "to the stated precision: {} groups are flat, {} input vertices welded",
                c.groups_flat_to_precision, c.welded
            )?;
        }
        writeln!(
            f,
            "voids: {}, hole points meshed: {}, region points: {}, hull edges dented by rounding: {}",
            c.voids, c.holes_meshed, c.regions, c.hull_dents
        )?;
        if c.steiner_vertices > 0 {
            writeln!(
                f,
                "tolerance: Steiner points count as on segments and facets up to {:e}; {} faces of the boundary \
                 compared with those near them",
                c.tolerance, c.faces_compared
            )?;
        }
        if c.markers + c.markers_instead > 0 {
            writeln!(
                f,
                "listed faces: {} with the marker of their facet",
                c.markers
            )?;
        }
        writeln!(f, "signs decided by integers: {}", c.exact_signs)?;
        for (kind, total) in &self.totals {
            writeln!(f, "VIOLATED {kind}: {total}")?;
        }
        for violation in &self.violations {
            writeln!(f, "  {violation}")?;
        }
        write!(f, "{}", if self.is_ok() { "accepted" } else { "refused" })
    }
}

/// Violations and counts as the checks collect them.
#[derive(Clone)]
pub(crate) struct Findings {
    pub(crate) counts: Counts,
    pub(crate) notes: Vec<Note>,
    pub(crate) violations: Vec<Violation>,
    totals: BTreeMap<&'static str, usize>,
    cap: usize,
}

impl Findings {
    pub(crate) fn new(cap: usize) -> Findings {
        Findings {
            counts: Counts::default(),
            notes: Vec::new(),
            violations: Vec::new(),
            totals: BTreeMap::new(),
            cap,
        }
    }

    /// Nothing found yet, with the same cap.
    pub(crate) fn trial(&self) -> Findings {
        Findings::new(self.cap)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.totals.is_empty()
    }

    /// Whether every face has one tetrahedron, or one on each side, as far as was checked.
    pub(crate) fn is_manifold(&self) -> bool {
        let broken = ["crowded face", "same side"];
        !broken.iter().any(|kind| self.totals.contains_key(kind))
    }

    pub(crate) fn report(&mut self, violation: Violation) {
        let total = self.totals.entry(violation.kind()).or_insert(0);
        *total += 1;
        if *total <= self.cap {
            self.violations.push(violation);
        }
    }

    /// Appends what another thread found after this, with the same cap, about segments and facets.
    pub(crate) fn append(&mut self, next: Findings) {
        self.counts.add(next.counts);
        let mut totals = self.totals.clone();
        for violation in next.violations {
            let listed = totals.entry(violation.kind()).or_insert(0);
            *listed += 1;
            if *listed <= self.cap {
                self.violations.push(violation);
            }
        }
        for (kind, total) in next.totals {
            *self.totals.entry(kind).or_insert(0) += total;
        }
    }

    pub(crate) fn verdict(self) -> Verdict {
        Verdict {
            counts: self.counts,
            notes: self.notes,
            violations: self.violations,
            totals: self.totals,
        }
    }
}
