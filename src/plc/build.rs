//! From the input to a checked [`Complex`] (paper §2): duplicate vertices merged, every facet a polygon with known
//! sides, coplanar neighbours merged, every segment once.
//!
//! O(n log n) for n triangles and for simple polygons with short edges; see [`super::crossing`] and
//! [`super::subdivision`] for what facets of many edges cost.

use super::facet::{FacetInput, undirected};
use super::flatness::FlatnessRule;
use super::merge::Overlapping;
use super::merge_near::{self, MergeCounts};
use super::{Complex, EdgeName, FacetName, PlcError, Polygon, VertexName, merge};
use crate::exchange::{Plc, Segment};
use crate::mesh::VertexId;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::hash_map::Entry;

impl Complex {
    /// Checks a PLC. With `merge_coplanar`, facets that meet in an edge of theirs alone, have the same marker and lie
    /// exactly on one plane become one polygon, and the edges between them are no longer segments, unless they were
    /// given as segments or two-vertex polygons.
    ///
    /// An edge of a facet that bounds no part of its area (it dangles outside, or lies in a hole) is a segment but no
    /// edge of the polygon. Intersections between different facets and segments are not looked for, except facets that
    /// are given twice, and, when merging, those that overlap beside a common edge.
    pub fn new(plc: &Plc, merge_coplanar: bool) -> Result<Complex, PlcError> {
        let (complex, _) = Complex::flat_to(plc, merge_coplanar, &FlatnessRule::EXACT)?;
        Ok(complex)
    }

    /// [`Complex::new`] with a rule for what counts as flat, and what was merged by it. Facets that are merged so are
    /// merged after those that are exactly coplanar.
    ///
    /// # Errors
    /// The same.
    pub fn flat_to(
        plc: &Plc,
        merge_coplanar: bool,
        rule: &FlatnessRule,
    ) -> Result<(Complex, MergeCounts), PlcError> {
        check_points(plc)?;
        check_rows(plc)?;
        let representative = representatives(&plc.vertices);
        let given = given_segments(plc, &representative)?;
        let corners: usize = plc
            .facets
            .iter()
            .flat_map(|f| &f.polygons)
            .map(Vec::len)
            .sum();
        let mut segments = Segments::with_capacity(corners / 2 + given.len());
        let mut explicit: FxHashSet<_> = given.iter().map(|s| undirected(s.ends)).collect();
        let mut polygons = Vec::with_capacity(plc.facets.len());
        for index in 0..plc.facets.len() {
            let facet = FacetInput::new(plc, index, &representative, rule.delta)?;
            for ends in facet.edges() {
                segments.add(Segment { ends, marker: 0 });
            }
            explicit.extend(floating_edges(&facet));
            if facet.is_area() {
                let polygon = facet.polygon()?;
                if !facet.is_simple(polygon.vertices.len()) {
                    explicit.extend(loose_edges(&facet, &polygon));
                }
                polygons.push(polygon);
            }
        }
        given.into_iter().for_each(|segment| segments.add(segment));
        check_different(plc, &polygons)?;
        let mut segments = segments.list;
        if merge_coplanar {
            let merged = merge::merge(plc, polygons, &explicit, Overlapping::Refused)?;
            polygons = merged.polygons;
            if !merged.dropped.is_empty() {
                check_different(plc, &polygons)?;
                segments.retain(|s| !merged.dropped.contains(&undirected(s.ends)));
            }
        }
        let mut counts = MergeCounts::default();
        if merge_coplanar && rule.merges() {
            let merged = merge_near::merge_near(plc, polygons, &explicit, rule);
            (polygons, counts) = (merged.polygons, merged.counts);
            if !merged.dropped.is_empty() {
                check_different(plc, &polygons)?;
                segments.retain(|s| !merged.dropped.contains(&undirected(s.ends)));
            }
        }
        let complex = Complex {
            representative,
            segments,
            diagonals: 0,
            polygons,
        };
        Ok((complex, counts))
    }
}

/// The polygons of the facets that have an area, those merged that [`Complex::new`] would merge, but for polygons that
/// overlap beside a common edge. Vertices of one facet are on a plane if they are within `delta` of it.
pub(crate) fn merged_polygons(
    plc: &Plc,
    representative: &[VertexId],
    delta: f64,
) -> Result<Vec<Polygon>, PlcError> {
    let given = given_segments(plc, representative)?;
    let mut explicit: FxHashSet<_> = given.iter().map(|s| undirected(s.ends)).collect();
    let mut polygons = Vec::with_capacity(plc.facets.len());
    for index in 0..plc.facets.len() {
        let facet = FacetInput::new(plc, index, representative, delta)?;
        explicit.extend(floating_edges(&facet));
        if facet.is_area() {
            let polygon = facet.polygon()?;
            explicit.extend(loose_edges(&facet, &polygon));
            polygons.push(polygon);
        }
    }
    Ok(merge::merge(plc, polygons, &explicit, Overlapping::LeftApart)?.polygons)
}

fn check_points(plc: &Plc) -> Result<(), PlcError> {
    let infinite = |p: &[f64; 3]| !p.iter().all(|x| x.is_finite());
    if let Some(i) = plc.vertices.iter().position(infinite) {
        let vertex = VertexName::new(plc, VertexId::new(i));
        return Err(PlcError::VertexNotFinite { vertex });
    }
    let regions: Vec<[f64; 3]> = plc.regions.iter().map(|r| r.point).collect();
    let facet_holes: Vec<[f64; 3]> = plc
        .facets
        .iter()
        .flat_map(|f| f.holes.iter().copied())
        .collect();
    for (kind, points) in [
        ("hole", &plc.holes),
        ("region", &regions),
        ("facet hole", &facet_holes),
    ] {
        if let Some(index) = points.iter().position(infinite) {
            return Err(PlcError::PointNotFinite { kind, index });
        }
    }
    Ok(())
}

/// Attributes, markers and numbers, if there are any, are those of the vertices.
fn check_rows(plc: &Plc) -> Result<(), PlcError> {
    let vertices = plc.vertices.len();
    let columns = plc.attributes.per_vertex;
    let full = columns.checked_mul(vertices) == Some(plc.attributes.values.len());
    let attributes = plc.attributes.values.len() / columns.max(1);
    for (what, rows, right) in [
        ("rows of attributes", attributes, full),
        (
            "markers of vertices",
            plc.vertex_markers.len(),
            plc.vertex_markers.is_empty() || plc.vertex_markers.len() == vertices,
        ),
        (
            "numbers of vertices",
            plc.numbers.len(),
            plc.numbers.is_empty() || plc.numbers.len() == vertices,
        ),
    ] {
        if !right {
            return Err(PlcError::RowCount {
                what,
                rows,
                vertices,
            });
        }
    }
    Ok(())
}

/// The first vertex with the coordinates of each one, where −0 = 0.
pub(crate) fn representatives(vertices: &[[f64; 3]]) -> Vec<VertexId> {
    let mut first = FxHashMap::with_capacity_and_hasher(vertices.len(), Default::default());
    let ids = vertices.iter().enumerate().map(|(i, point)| {
        let key = point.map(|x| (x + 0.0).to_bits());
        *first.entry(key).or_insert_with(|| VertexId::new(i))
    });
    ids.collect()
}

/// The segments that the input gives for themselves, between representatives.
fn given_segments(plc: &Plc, representative: &[VertexId]) -> Result<Vec<Segment>, PlcError> {
    let check = |segment: &Segment| {
        let name = EdgeName::new(plc, segment.ends);
        let mut ends = segment.ends;
        for v in &mut ends {
            let found = representative.get(v.index());
            *v = *found.ok_or_else(|| PlcError::NoSuchSegmentEnd {
                segment: name,
                vertex: VertexName::new(plc, *v),
            })?;
        }
        if ends[0] == ends[1] {
            return Err(PlcError::DegenerateSegment { segment: name });
        }
        Ok(Segment { ends, ..*segment })
    };
    plc.segments.iter().map(check).collect()
}

/// The two-vertex polygons of a facet.
fn floating_edges(facet: &FacetInput) -> Vec<[VertexId; 2]> {
    let pairs = facet
        .polygons
        .iter()
        .filter_map(|p| <[VertexId; 2]>::try_from(&p[..]).ok());
    pairs.map(undirected).collect()
}

/// The edges of a facet that are no edges of its polygon.
pub(crate) fn loose_edges(facet: &FacetInput, polygon: &Polygon) -> Vec<[VertexId; 2]> {
    let is_edge = |[a, b]: [VertexId; 2]| {
        [[a, b], [b, a]]
            .iter()
            .any(|e| polygon.edges.binary_search(e).is_ok())
    };
    facet
        .edges()
        .filter(|&e| !is_edge(e))
        .map(undirected)
        .collect()
}

/// No two polygons have the same edges with the same sides, as seen from one side or from both.
fn check_different(plc: &Plc, polygons: &[Polygon]) -> Result<(), PlcError> {
    // A sum over the edges that does not know their direction; nearly always they differ.
    let fingerprint = |polygon: &Polygon| {
        let edges = polygon.edges.iter().map(|&e| hash(undirected(e)));
        edges.fold(0u64, u64::wrapping_add)
    };
    let mut fingerprints: Vec<u64> = polygons.iter().map(fingerprint).collect();
    fingerprints.sort_unstable();
    if fingerprints.windows(2).all(|pair| pair[0] != pair[1]) {
        return Ok(());
    }
    let mut seen = FxHashMap::default();
    for polygon in polygons {
        let mut reversed: Vec<_> = polygon.edges.iter().map(|&[a, b]| [b, a]).collect();
        reversed.sort_unstable();
        let key = reversed.min(polygon.edges.clone());
        match seen.entry(key) {
            Entry::Vacant(entry) => {
                entry.insert(polygon.facets[0]);
            }
            Entry::Occupied(entry) => {
                return Err(PlcError::SameFacet {
                    first: FacetName::new(plc, *entry.get()),
                    second: FacetName::new(plc, polygon.facets[0]),
                });
            }
        }
    }
    Ok(())
}

/// Well-mixed bits of an edge (the finalizer of SplitMix64: Steele, Lea & Flood 2014).
fn hash([a, b]: [VertexId; 2]) -> u64 {
    let x = u64::from(a.0) << 32 | u64::from(b.0);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Segments by their ends, in order of first appearance.
struct Segments {
    list: Vec<Segment>,
    index: FxHashMap<[VertexId; 2], usize>,
}

impl Segments {
    fn with_capacity(n: usize) -> Segments {
        Segments {
            list: Vec::with_capacity(n),
            index: FxHashMap::with_capacity_and_hasher(n, Default::default()),
        }
    }

    /// Adds a segment, or gives its marker to the one that is there if that has none.
    fn add(&mut self, segment: Segment) {
        match self.index.entry(undirected(segment.ends)) {
            Entry::Vacant(entry) => {
                entry.insert(self.list.len());
                self.list.push(segment);
            }
            Entry::Occupied(entry) => {
                let marker = &mut self.list[*entry.get()].marker;
                if *marker == 0 {
                    *marker = segment.marker;
                }
            }
        }
    }
}
