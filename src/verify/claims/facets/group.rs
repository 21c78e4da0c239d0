//! One group of facets: its candidates, which of them cover it, and which parts of it are outside the domain; see
//! [`super::super::facets`].

use crate::mesh::VertexId;
use crate::verify::case::Case;
use crate::verify::claims::facets::choice::{self, Need};
use crate::verify::claims::facets::covering::{OutsidePart, PartialCover};
use crate::verify::claims::facets::misfit::Misfit;
use crate::verify::claims::facets::planes::{is_on_planes, planes};
use crate::verify::claims::facets::{is_needed, is_uneven};
use crate::verify::claims::flatness;
use crate::verify::claims::segments::Fate;
use crate::verify::lookup::area::{Area, distinct};
use crate::verify::lookup::slabs::Slabs;
use crate::verify::lookup::tables::sorted2;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

use rustc_hash::{FxHashMap, FxHashSet};

/// From how many facets on those of a group are sorted by slabs.
const MANY: usize = 8;

/// One facet, or several that were merged.
pub(crate) struct Group<'a> {
    pub(crate) case: &'a Case<'a>,
    pub(crate) facets: Vec<usize>,
    pub(crate) axes: [usize; 2],
    pub(crate) areas: Vec<Area<'a>>,
    /// The bounding boxes of the areas, and the areas by slabs along the second axis, if there are many.
    boxes: Vec<[[f64; 2]; 2]>,
    slabs: Option<Slabs>,
    /// Three points of each plane of the facets, and how far off Steiner points may be.
    planes: Vec<([VertexId; 3], f64)>,
    /// All edges with their chains in place.
    edges: Vec<[VertexId; 2]>,
    /// The edges that were merged away.
    merged: FxHashSet<[VertexId; 2]>,
    /// Whether facets of it overlap, so that some of those edges are inside others.
    overlaps: bool,
    /// Sorted.
    vertices: Vec<VertexId>,
    /// The chains in place of edges that a vertex is on, and where in them.
    on_chains: FxHashMap<VertexId, Vec<(usize, usize)>>,
}

impl<'a> Group<'a> {
    /// None if it has no area.
    pub(crate) fn new(case: &'a Case<'a>, fates: &[Fate], facets: Vec<usize>) -> Option<Group<'a>> {
        let axes = flatness::axes(case, &facets)?;
        let edges_of = |f: usize| {
            let edges = case.input.facets[f].edges.iter();
            distinct(edges.flat_map(|&e| fates[e].edges(case.input.edges[e].ends)))
        };
        let mut edges = Vec::new();
        let (mut areas, mut boxes) = (Vec::new(), Vec::new());
        for &f in &facets {
            let own = edges_of(f);
            areas.push(Area::new(
                case.points,
                axes,
                &own,
                &case.input.facets[f].holes,
            ));
            boxes.push(box_of(case, axes, &own));
            edges.extend(own);
        }
        let edges = distinct(edges.into_iter());
        let slabs = (facets.len() >= MANY).then(|| {
            let intervals: Vec<[f64; 2]> = boxes.iter().map(|b: &[[f64; 2]; 2]| b[1]).collect();
            Slabs::new(&intervals)
        });
        let mut all = facets.iter().flat_map(|&f| &case.input.facets[f].edges);
        let overlaps = all.any(|&e| matches!(fates[e], Fate::Absorbed(_)));
        let own_edges = facets.iter().flat_map(|&f| &case.input.facets[f].edges);
        let merged = own_edges
            .filter(|&&e| matches!(fates[e], Fate::Merged | Fate::Absorbed(_)))
            .map(|&e| case.input.edges[e].ends)
            .collect();
        let own = facets
            .iter()
            .flat_map(|&f| case.input.facets[f].vertices.iter().copied());
        let mut vertices: Vec<VertexId> = own.chain(edges.iter().flatten().copied()).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let planes = planes(case, &facets);
        let mut on_chains: FxHashMap<VertexId, Vec<(usize, usize)>> = FxHashMap::default();
        for &f in &facets {
            for &e in &case.input.facets[f].edges {
                if let Fate::Chain(chain) = &fates[e] {
                    for (i, &v) in chain.iter().enumerate() {
                        on_chains.entry(v).or_default().push((e, i));
                    }
                }
            }
        }
        Some(Group {
            on_chains,
            case,
            facets,
            axes,
            areas,
            boxes,
            slabs,
            planes,
            edges,
            merged,
            overlaps,
            vertices,
        })
    }

    /// Covers it.
    pub(crate) fn check(
        mut self,
        listed: &[bool],
        cover: &mut PartialCover,
        findings: &mut Findings,
    ) {
        for (&facet, area) in self.facets.iter().zip(&self.areas) {
            if let Some(edge) = area.upright {
                let edge = edge.map(|v| self.case.place(v));
                findings.report(Violation::FacetUpright { facet, edge });
                return;
            }
        }
        let mut filled = FxHashSet::default();
        let candidates = self.candidates(&mut filled);
        cover.add_candidates(&candidates, self.facets[0]);
        self.exempt(&filled, cover, findings);
        if self.overlaps {
            self.areas = vec![self.union()];
        }
        let expected = self.expected();
        let given = candidates.iter().copied().filter(|&f| listed[f]);
        let needed = |f: usize| is_needed(self.case, f);
        // Where the mesh is convex, the faces of its hull are listed, too, whether on a facet or not.
        let given_inside = |f: usize| listed[f] && self.case.tables.faces[f].is_shared();
        let choices: [&dyn Fn() -> Vec<usize>; 5] = [
            &|| given.clone().collect(),
            &|| self.chosen(&given.clone().collect::<Vec<_>>(), &expected, &needed),
            &|| match candidates.iter().any(|&f| given_inside(f)) {
                true => self.chosen(&candidates, &expected, &given_inside),
                false => Vec::new(),
            },
            &|| candidates.clone(),
            &|| self.chosen(&candidates, &expected, &needed),
        ];
        let (mut covering, mut first_misfit) = (None, None);
        for (i, choice) in choices.into_iter().enumerate() {
            let choice = choice();
            match self.misfit(&choice, &expected) {
                None => {
                    let mut others = candidates
                        .iter()
                        .filter(|f| choice.binary_search(f).is_err());
                    let explains = others.all(|&f| !is_needed(self.case, f));
                    if explains || covering.is_none() {
                        covering = Some(choice);
                    }
                    if explains {
                        break;
                    }
                }
                // Of the failures, that of all candidates says most.
                Some(misfit) if i == 3 => first_misfit = Some(misfit),
                Some(_) => {}
            }
        }
        if let Some(choice) = covering {
            findings.counts.facets += self.facets.len();
            findings.counts.facets_rounded += usize::from(self.is_rounded(&choice));
            cover.constrain(&choice, self.facets[0]);
            if is_uneven(self.case, &self.facets) {
                cover.add_uneven(&choice);
            }
            return;
        }
        let facets = self.facets.clone();
        findings.report(match first_misfit.expect("all candidates were tried") {
            Misfit::Edge(edge, faces, expected) => Violation::FacetNotCovered {
                facets,
                edge: edge.map(|v| self.case.place(v)),
                faces,
                expected,
            },
            Misfit::Area(covered, area) => Violation::FacetArea {
                facets,
                covered,
                area,
            },
        });
    }

    /// The cells of the areas that hold the centroid of q and belong to them.
    fn kept_cells_at(&self, q: &[VertexId]) -> Vec<(usize, usize)> {
        let points = self.case.points;
        let wobble = points.wobble(q);
        let bounds = self.axes.map(|i| {
            let all = || q.iter().map(|&v| points.at(v)[i]);
            let (low, high) = (
                all().fold(f64::INFINITY, f64::min),
                all().fold(f64::NEG_INFINITY, f64::max),
            );
            [low - wobble, high + wobble]
        });
        let mut near = Vec::new();
        match &self.slabs {
            None => near.extend(0..self.areas.len() as u32),
            Some(slabs) => slabs.around(bounds[1][0], bounds[1][1], &mut near),
        }
        let meets = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[1] && b[0] <= a[1];
        let near = near.into_iter().map(|i| i as usize).filter(|&i| {
            let own = &self.boxes[i];
            meets(&own[0], &bounds[0]) && meets(&own[1], &bounds[1])
        });
        near.map(|i| (i, self.areas[i].cell_at(q)))
            .filter(|&(i, cell)| self.areas[i].is_kept(cell))
            .collect()
    }

    /// The candidate faces, sorted; `filled` are the cells that hold the centroid of one.
    fn candidates(&self, filled: &mut FxHashSet<(usize, usize)>) -> Vec<usize> {
        let tables = &self.case.tables;
        let is_barrier = |e: &[VertexId; 2]| self.edges.binary_search(e).is_ok();
        let mut accepted = FxHashMap::default();
        let mut seen = FxHashSet::default();
        let mut found = Vec::new();
        let mut stack = self.edges.clone();
        while let Some(edge) = stack.pop() {
            for f in tables.fan(edge) {
                let key = tables.faces[f].key;
                if seen.contains(&f) || !key.iter().all(|&v| self.accepts(v, &mut accepted)) {
                    continue;
                }
                seen.insert(f);
                let [a, b, c] = key;
                if [[a, b], [b, c], [a, c]]
                    .iter()
                    .any(|&[v, w]| self.bridges(v, w))
                {
                    continue;
                }
                let cells = self.kept_cells_at(&key);
                if !cells.is_empty() {
                    filled.extend(cells);
                    found.push(f);
                    let [a, b, c] = key;
                    stack.extend(
                        [[a, b], [b, c], [a, c]]
                            .into_iter()
                            .filter(|e| !is_barrier(e)),
                    );
                }
            }
        }
        found.sort_unstable();
        found
    }

    /// Whether vw bridges vertices of a chain. Where those are rounded, it may be an edge of the mesh, but is none of
    /// f.
    fn bridges(&self, v: VertexId, w: VertexId) -> bool {
        let (Some(of_v), Some(of_w)) = (self.on_chains.get(&v), self.on_chains.get(&w)) else {
            return false;
        };
        let bridged = |&(e, i): &(usize, usize)| {
            of_w.iter()
                .any(|&(other, j)| e == other && i.abs_diff(j) > 1)
        };
        of_v.iter().any(bridged)
    }

    fn accepts(&self, v: VertexId, memory: &mut FxHashMap<VertexId, bool>) -> bool {
        let on_plane = || is_on_planes(self.case, &self.planes, v);
        // A vertex on the plane but beyond the border: a face with it may lie mostly in the facet, nearly coplanar
        // with the facet's neighbour.
        let inside = || !self.kept_cells_at(&[v]).is_empty();
        self.vertices.binary_search(&v).is_ok()
            || *memory.entry(v).or_insert_with(|| on_plane() && inside())
    }

    /// Takes the parts outside the domain out of the areas. Parts at merged edges are outside together or not at all.
    fn exempt(
        &mut self,
        filled: &FxHashSet<(usize, usize)>,
        cover: &mut PartialCover,
        findings: &mut Findings,
    ) {
        let tables = &self.case.tables;
        let is_joined = |area: &Area, cell| {
            let mut edges = area.edges_around(cell).into_iter().map(sorted2);
            !self.merged.is_empty() && edges.any(|e| self.merged.contains(&e))
        };
        let mut empty = Vec::new();
        let mut joined_is_filled = false;
        for (i, area) in self.areas.iter().enumerate() {
            for cell in area.kept_cells() {
                let joined = is_joined(area, cell);
                if filled.contains(&(i, cell)) {
                    joined_is_filled |= joined;
                } else {
                    empty.push((i, cell, joined));
                }
            }
        }
        for (i, cell, joined) in empty {
            let area = &mut self.areas[i];
            let Some(corner) = area.corner(cell).filter(|_| !(joined && joined_is_filled)) else {
                continue;
            };
            let [before, v, after] = corner;
            if !tables.is_used(v) || !self.case.locator.enters(v, &[before, after]) {
                findings.counts.facet_parts_outside += 1;
                cover.outside.push(OutsidePart {
                    facet: self.facets[i],
                    frame: corner,
                    boundary: area.edges_around(cell),
                });
                area.drop_cell(cell);
            }
        }
    }

    /// The area of all facets together, as far as it is not exempt, divided by the edges that were not merged away.
    fn union(&self) -> Area<'a> {
        let edges = self
            .edges
            .iter()
            .copied()
            .filter(|e| !self.merged.contains(e));
        let edges: Vec<[VertexId; 2]> = edges.collect();
        let mut whole = Area::new(self.case.points, self.axes, &edges, &[]);
        for cell in whole.kept_cells() {
            // A facet is on the left of an edge of the cell, or holds its middle.
            let has = |area: &Area, edge: [VertexId; 2]| match area.sides(edge) {
                Some([left, _]) => left,
                None => area.is_kept(area.cell_at(&edge)),
            };
            let around = whole.edges_around(cell);
            let is_covered = around
                .first()
                .is_some_and(|&e| self.areas.iter().any(|a| has(a, e)));
            if !is_covered {
                whole.drop_cell(cell);
            }
        }
        whole
    }

    /// A part of the candidates that covers the group, if one is found: with those that are wanted, if possible.
    fn chosen(
        &self,
        candidates: &[usize],
        expected: &[([VertexId; 2], usize)],
        is_wanted: &dyn Fn(usize) -> bool,
    ) -> Vec<usize> {
        let tables = &self.case.tables;
        // A face that stands upright is a side of a shim; it covers nothing.
        let lies = |&f: &usize| {
            !self
                .case
                .points
                .orient2d(self.axes, tables.faces[f].key)
                .is_zero()
        };
        let lying: Vec<usize> = candidates.iter().copied().filter(lies).collect();
        let keys: Vec<[VertexId; 3]> = lying.iter().map(|&f| tables.faces[f].key).collect();
        let wanted: Vec<bool> = lying.iter().map(|&f| is_wanted(f)).collect();
        let need = expected.iter().map(|&(edge, faces)| match faces {
            1 => (edge, Need::One),
            _ => (edge, Need::TwoOrNone),
        });
        let in_mesh = |cover: &[usize]| cover.iter().map(|&i| lying[i]).collect::<Vec<_>>();
        let accept = |cover: &[usize]| self.misfit(&in_mesh(cover), expected).is_none();
        let cover = choice::find(&keys, &need.collect(), &wanted, &accept);
        cover.map_or_else(|| lying.clone(), |cover| in_mesh(&cover))
    }
}

/// The bounding box of edges in the plane of the axes.
fn box_of(case: &Case, axes: [usize; 2], edges: &[[VertexId; 2]]) -> [[f64; 2]; 2] {
    axes.map(|i| {
        let ends = edges.iter().flatten();
        ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
            let (x, wobble) = (case.points.at(v)[i], case.points.wobble(&[v]));
            [low.min(x - wobble), high.max(x + wobble)]
        })
    })
}
