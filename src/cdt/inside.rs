//! Which components of the tetrahedra are the domain, and what the input's points have to say about it.
//!
//! # Open edges
//! A segment is *open* if exactly one polygon is on exactly one side of it: the edges in the mesh that it consists of
//! have one triangle on polygons each, as the polygons meet like those of a PLC (`recover::output::embedding`). One
//! goes around such an edge from one side of that triangle to its other side without crossing a polygon, so all
//! tetrahedra there, and both sides of the polygon, are in *one* component. That is the definition:
//!
//! - an open edge is *outside* if the tetrahedra around it are in the component of the ghosts. Then a facet ends
//!   there that has the outside on both sides: what it was meant to enclose leaks, or it is a fin of the outer
//!   surface. Nobody knows which, and so this is an error, [`DomainError::Open`];
//! - an open edge in a component that a hole point removes is where the hole may leak from the part of space that it
//!   was meant for:
//!   [`DomainError::HoleLeaks`];
//! - other open edges are those of fins, cracks and sheets that float in the domain. They are legal, and counted.
//!
//! All of it is combinatorial, hence exact. A facet that is missing where three or more meet leaves no open edge: of
//! two rooms without their wall nobody can know that there should be two, unless two region points disagree about
//! them.

use crate::error::{Coordinates, DomainError, PointKind};
use crate::exchange::{Note, NoteCode, Plc, Region};
use crate::mesh::{TetId, TetMesh, VertexId};
use crate::recover::domain::{Components, DomainMarks};
use crate::threads;

/// Fewer tetrahedra are one thread's work.
const FEW: usize = 1 << 16;

/// Where the points of the input lie.
pub(super) struct Located {
    /// The component of each hole point, or `None` outside of the convex hull.
    pub holes: Vec<Option<u32>>,
    /// The same of each region point.
    pub regions: Vec<Option<u32>>,
}

/// Where facets end: an open segment, by its ends, and the component around it.
pub(super) type OpenEdge = ([VertexId; 2], u32);

/// What is inside.
pub(super) struct Inside {
    /// Whether each component is kept.
    kept: Vec<bool>,
    /// The region point that names each component.
    named_by: Vec<Option<usize>>,
}

impl Inside {
    /// Decides without the convex hull. Something is enclosed, and no open edge is outside.
    ///
    /// # Errors
    /// [`DomainError`], where what is inside is not known.
    pub fn of_facets(
        plc: &Plc,
        components: &Components,
        open: &[OpenEdge],
        located: &Located,
        notes: &mut Vec<Note>,
    ) -> Result<Inside, DomainError> {
        let mut kept = vec![true; components.count()];
        kept[Components::OUTSIDE as usize] = false;
        let mut removed_by: Vec<Option<usize>> = vec![None; components.count()];
        let mut outside = Vec::new();
        for (hole, component) in located.holes.iter().enumerate() {
            match component {
                None | Some(Components::OUTSIDE) => outside.push(plc.holes[hole]),
                Some(c) => {
                    let edges = open_in(open, *c);
                    if !edges.is_empty() {
                        return Err(DomainError::HoleLeaks { hole, edges });
                    }
                    kept[*c as usize] = false;
                    removed_by[*c as usize].get_or_insert(hole);
                }
            }
        }
        for (region, component) in located.regions.iter().enumerate() {
            if let Some(hole) = component.and_then(|c| removed_by[c as usize]) {
                return Err(DomainError::HoleInRegion { hole, region });
            }
        }
        if !kept.contains(&true) {
            let mut holes: Vec<usize> = removed_by.into_iter().flatten().collect();
            holes.sort_unstable();
            return Err(DomainError::HolesLeaveNothing { holes });
        }
        notes.extend(about_points(
            NoteCode::HoleOutside,
            outside,
            |points| {
                format!("{points} outside of everything that the facets enclose: no harm is done")
            },
            PointKind::Hole,
        ));
        let is_inside = |c: u32| c != Components::OUTSIDE;
        Inside::named(plc, kept, located, &is_inside, notes)
    }

    /// Keeps everything in the convex hull.
    ///
    /// # Errors
    /// If two region points disagree.
    pub fn hull(
        plc: &Plc,
        components: &Components,
        located: &Located,
        notes: &mut Vec<Note>,
    ) -> Result<Inside, DomainError> {
        notes.extend(about_points(
            NoteCode::HoleIgnored,
            plc.holes.clone(),
            |points| format!("{points} ignored: the whole convex hull is kept"),
            PointKind::Hole,
        ));
        let kept = vec![true; components.count()];
        Inside::named(plc, kept, located, &|_| true, notes)
    }

    /// Adds the region points, of which those in components that are not `inside` name nothing.
    fn named(
        plc: &Plc,
        kept: Vec<bool>,
        located: &Located,
        inside: &dyn Fn(u32) -> bool,
        notes: &mut Vec<Note>,
    ) -> Result<Inside, DomainError> {
        let mut named_by: Vec<Option<usize>> = vec![None; kept.len()];
        let mut outside = Vec::new();
        for (index, component) in located.regions.iter().enumerate() {
            let Some(c) = component.filter(|&c| inside(c)) else {
                outside.push(plc.regions[index].point);
                continue;
            };
            let first = *named_by[c as usize].get_or_insert(index);
            if plc.regions[first].attribute != plc.regions[index].attribute {
                let points = [first, index];
                return Err(DomainError::RegionsDisagree { points });
            }
        }
        notes.extend(about_points(
            NoteCode::RegionOutside,
            outside,
            |points| format!("{points} outside of the domain and names nothing"),
            PointKind::Region,
        ));
        Ok(Inside { kept, named_by })
    }

    /// The marks of all tetrahedra.
    pub fn marks(&self, plc: &Plc, mesh: &TetMesh, components: &Components) -> DomainMarks {
        let component = |t: usize| components.of(TetId::new(t)).map(|c| c as usize);
        let attribute = |c: usize| self.named_by[c].map_or(0.0, |r| plc.regions[r].attribute);
        let attributes: Vec<f64> = (0..self.kept.len()).map(attribute).collect();
        let n = mesh.capacity();
        DomainMarks {
            kept: threads::map(n, FEW, |t| {
                component(t).is_some_and(|c| self.kept[c]) && !mesh.is_ghost(TetId::new(t))
            }),
            region: if plc.regions.is_empty() {
                Vec::new()
            } else {
                (0..n)
                    .map(|t| component(t).map_or(0.0, |c| attributes[c]))
                    .collect()
            },
        }
    }

    /// How many open edges are in components that are kept, with a note.
    pub fn count_open(
        &self,
        open: &[OpenEdge],
        numbers: &dyn Fn(VertexId) -> i64,
        notes: &mut Vec<Note>,
    ) -> usize {
        let inner: Vec<[VertexId; 2]> = open
            .iter()
            .filter(|&&(_, c)| self.kept[c as usize])
            .map(|&(edge, _)| edge)
            .collect();
        if !inner.is_empty() {
            let text = format!(
                "{} {} of one facet only inside the domain (fins, cracks or floating sheets), at: {}",
                inner.len(),
                if inner.len() == 1 {
                    "edge is an edge"
                } else {
                    "edges are edges"
                },
                inner
                    .iter()
                    .take(Note::LISTED)
                    .map(|e| e.map(numbers).map(|v| v.to_string()).join("-"))
                    .collect::<Vec<_>>()
                    .join(", ")
            );
            let mut ends: Vec<i64> = inner.iter().flatten().map(|&v| numbers(v)).collect();
            ends.sort_unstable();
            ends.dedup();
            notes.push(Note::new(NoteCode::OpenEdges, inner.len(), text).on_vertices(ends));
        }
        inner.len()
    }
}

/// The open edges around which a component is.
pub(super) fn open_in(open: &[OpenEdge], component: u32) -> Vec<[VertexId; 2]> {
    let there = open.iter().filter(|&&(_, c)| c == component);
    there.map(|&(edge, _)| edge).collect()
}

/// What is known of the region points before any work: bounds of volumes, which are not applied.
pub(super) fn volumes_not_applied(plc: &Plc) -> Option<Note> {
    let bounded: Vec<(&Region, f64)> = plc
        .regions
        .iter()
        .filter_map(|r| Some((r, r.max_volume?)))
        .collect();
    let (first, volume) = bounded.first()?;
    let others = match bounded.len() {
        1 => String::new(),
        count => format!(" and {} more", count - 1),
    };
    let text = format!(
        "the volume bound {volume} of region point {}{others}: not applied, as tetflip does not refine",
        Coordinates(first.point)
    );
    let points = bounded.iter().map(|(r, _)| r.point);
    Some(Note::new(NoteCode::RegionVolume, bounded.len(), text).at_points(points))
}

/// A note about points, if there are some; `text` makes it of a phrase like "hole point (1, 2, 3) is".
fn about_points(
    code: NoteCode,
    points: Vec<[f64; 3]>,
    text: impl Fn(&str) -> String,
    kind: PointKind,
) -> Option<Note> {
    const NAMED: usize = 4;
    let named: Vec<String> = points
        .iter()
        .take(NAMED)
        .map(|&p| Coordinates(p).to_string())
        .collect();
    let phrase = match points.len() {
        0 => return None,
        1 => format!("{kind} point {} is", named[0]),
        2..=NAMED => format!("{kind} points {} are", named.join(", ")),
        more => format!(
            "{kind} points {} and {} more are",
            named.join(", "),
            more - NAMED
        ),
    };
    Some(Note::new(code, points.len(), text(&phrase)).at_points(points))
}
