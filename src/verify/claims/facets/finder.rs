//! The faces that the mesh lists on a group of facets all of which is in the domain.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::verify::case::Case;
use crate::verify::claims::facets::planes::{is_on_planes, planes};
use crate::verify::claims::flatness;
use crate::verify::claims::listed::Listed;
use crate::verify::claims::segments::{Fate, axes_of};
use crate::verify::lookup::area::{Area, distinct};
use crate::verify::lookup::surface::Flood;
use crate::verify::lookup::tables::sorted2;
use crate::verify::signs::points::Points;
use crate::verify::signs::sums::Areas;

/// Listed faces that cover a group.
pub(crate) struct Found {
    pub(crate) faces: Vec<usize>,
    /// As in [`crate::verify::verdict::Counts::facets_rounded`].
    pub(crate) rounded: bool,
}

/// Finds them where all of the group is in the domain.
pub(crate) struct Finder<'a> {
    case: &'a Case<'a>,
    fates: &'a [Fate],
    flood: Flood<'a>,
    /// The number of the group that has a vertex, or whose planes were asked about it, and the answer.
    own: Vec<u32>,
    asked: Vec<(u32, bool)>,
    group: u32,
}

impl<'a> Finder<'a> {
    pub(crate) fn new(case: &'a Case<'a>, fates: &'a [Fate], listed: &'a Listed) -> Finder<'a> {
        Finder {
            case,
            fates,
            flood: Flood::new(&listed.surface, case.points),
            own: vec![0; case.points.len()],
            asked: vec![(0, false); case.points.len()],
            group: 0,
        }
    }

    /// Those of a group, if they cover it.
    pub(crate) fn cover(&mut self, facets: &[usize]) -> Option<Found> {
        let case = self.case;
        let frame = facets.iter().find_map(|&f| case.input.facets[f].frame)?;
        let axes = match facets {
            [_] => axes_of(case, frame)?,
            _ => flatness::axes(case, facets)?,
        };
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

/// The directed edges of a facet with one polygon that passes no vertex twice, counterclockwise, with their chains in
/// place and without those that were merged away.
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
            Fate::Absorbed(_) | Fate::Outside | Fate::Missing => return None,
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
            Fate::Absorbed(_) | Fate::Outside | Fate::Missing => return None,
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
