//! Inside and outside (paper §2: the polyhedra of the PLC): which tetrahedra are kept, and the region of each.
//!
//! The subpolygons divide the tetrahedra into components. Those connected to the ghosts are outside; those that hold a
//! hole point are holes; the rest is the domain. A region point gives its attribute to its component.

use crate::error::InvalidPlc;
use crate::exchange::Plc;
use crate::mesh::{Incidence, SimplexIndex, TetId, TetMesh};
use crate::predicate::PointStore;
use crate::threads;

/// Fewer tetrahedra are one thread's work.
const FEW: usize = 1 << 16;

/// Which tetrahedra are in the domain, and their region attributes.
#[derive(Clone, Debug, Default)]
pub struct DomainMarks {
    /// Whether a tetrahedron is kept, by id.
    pub kept: Vec<bool>,
    /// The region attribute of a tetrahedron, by id; empty if the PLC has no region points.
    pub region: Vec<f64>,
}

/// Divides the mesh at `walls`, the subpolygons. With `keep_hull` everything in the convex hull is kept. Linear time.
///
/// # Errors
/// If a hole point or region point lies on a facet, or two region points disagree on one region.
pub(crate) fn mark_domain<P: PointStore>(
    plc: &Plc,
    points: &P,
    mesh: &TetMesh,
    walls: &SimplexIndex<2>,
    keep_hull: bool,
) -> Result<DomainMarks, InvalidPlc> {
    let mut flood = Flood {
        mesh,
        walls,
        component: vec![u32::MAX; mesh.capacity()],
    };
    let mut kept_component = vec![keep_hull];
    if walls.is_empty() {
        // Nothing divides them.
        mesh.all().for_each(|t| flood.component[t.index()] = 0);
    } else {
        flood.fill(mesh.all().filter(|&t| mesh.is_ghost(t)).collect(), 0);
    }
    for t in mesh.finite() {
        if flood.component[t.index()] == u32::MAX {
            let id = kept_component.len() as u32;
            kept_component.push(true);
            flood.fill(vec![t], id);
        }
    }
    let component = flood.component;
    let mut near = mesh.finite().next();
    let mut find = |kind, index, point| {
        locate(points, mesh, walls, &mut near, point)
            .map_err(|OnPolygon| InvalidPlc::PointOnPolygon { kind, index })
    };
    let holes: &[[f64; 3]] = if keep_hull { &[] } else { &plc.holes };
    for (index, &hole) in holes.iter().enumerate() {
        if let Some(t) = find("hole", index, hole)? {
            kept_component[component[t.index()] as usize] = false;
        }
    }
    let mut named_by: Vec<Option<usize>> = vec![None; kept_component.len()];
    for (index, region) in plc.regions.iter().enumerate() {
        if let Some(t) = find("region", index, region.point)? {
            let first = *named_by[component[t.index()] as usize].get_or_insert(index);
            if plc.regions[first].attribute != region.attribute {
                let points = [first, index];
                return Err(InvalidPlc::RegionsDisagree { points });
            }
        }
    }
    let attribute: Vec<Option<f64>> = named_by
        .into_iter()
        .map(|index| Some(plc.regions[index?].attribute))
        .collect();
    let of = |t: usize| component[t] as usize;
    let alive = |t: usize| component[t] != u32::MAX;
    Ok(DomainMarks {
        kept: threads::map(component.len(), FEW, |t| {
            alive(t) && kept_component[of(t)] && !mesh.is_ghost(TetId::new(t))
        }),
        region: if plc.regions.is_empty() {
            Vec::new()
        } else {
            (0..component.len())
                .map(|t| {
                    if alive(t) {
                        attribute[of(t)].unwrap_or(0.0)
                    } else {
                        0.0
                    }
                })
                .collect()
        },
    })
}

struct Flood<'a> {
    mesh: &'a TetMesh,
    walls: &'a SimplexIndex<2>,
    component: Vec<u32>,
}

impl Flood<'_> {
    fn fill(&mut self, mut stack: Vec<TetId>, id: u32) {
        for &t in &stack {
            self.component[t.index()] = id;
        }
        while let Some(t) = stack.pop() {
            for slot in 0..4 {
                let c = t.corner(slot);
                let n = self.mesh.neighbor(c);
                if self.component[n.index()] == u32::MAX
                    && self.walls.triangle(self.mesh.facet(c)).is_none()
                {
                    self.component[n.index()] = id;
                    self.mesh.prefetch(n);
                    stack.push(n);
                }
            }
        }
    }
}

/// The point lies on a polygon, so it names no part of space.
struct OnPolygon;

/// The most steps of a walk.
const MOST_STEPS: usize = 1000;

/// A finite tetrahedron that contains the point, if it is in the convex hull. A walk from `near`, which need not end in a
/// constrained tetrahedralization. If it does not, or if the point is in no interior, a walk from the first tetrahedron, then
/// a search of all.
fn locate<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    walls: &SimplexIndex<2>,
    near: &mut Option<TetId>,
    point: [f64; 3],
) -> Result<Option<TetId>, OnPolygon> {
    let sides = |t: TetId| points.sides_of(mesh.vertices(t), point);
    let outward = |t: TetId| sides(t).iter().position(|s| s.is_negative());
    let mut at = *near;
    for _ in 0..MOST_STEPS {
        let Some(t) = at else { break };
        if let Some(slot) = outward(t) {
            at = Some(mesh.neighbor(t.corner(slot))).filter(|&n| !mesh.is_ghost(n));
        } else if sides(t).iter().all(|s| s.is_positive()) {
            *near = at;
            return Ok(at);
        } else {
            break;
        }
    }
    let mut found = None;
    let mut at = mesh.finite().next();
    for _ in 0..MOST_STEPS {
        let Some(t) = at else { break };
        match outward(t) {
            None => {
                found = Some(t);
                break;
            }
            Some(slot) => at = Some(mesh.neighbor(t.corner(slot))).filter(|&n| !mesh.is_ghost(n)),
        }
    }
    let found = found.or_else(|| mesh.finite().find(|&t| outward(t).is_none()));
    let on_polygon = found.is_some_and(|t| {
        let on_facet = sides(t).map(|s| s.is_zero());
        (0..4).any(|slot| on_facet[slot] && walls.triangle(mesh.facet(t.corner(slot))).is_some())
    });
    if on_polygon {
        Err(OnPolygon)
    } else {
        Ok(found)
    }
}

/// Whether the edge ab is an edge of a kept tetrahedron.
pub fn keeps_edge(
    mesh: &TetMesh,
    incidence: &Incidence,
    marks: &DomainMarks,
    a: crate::mesh::VertexId,
    b: crate::mesh::VertexId,
) -> bool {
    incidence
        .tet_at_edge(mesh, a, b)
        .is_some_and(|t| mesh.around(t, a, b).any(|t| marks.kept[t.index()]))
}
