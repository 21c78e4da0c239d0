//! Inside and outside (paper §2: the polyhedra of the PLC): the parts into which the polygons divide space, and which
//! tetrahedra are kept of them. What is decided by which part is in [`crate::cdt`].

use crate::mesh::{Incidence, SimplexIndex, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;

/// Which tetrahedra are in the domain, and their region attributes.
#[derive(Clone, Debug, Default)]
pub struct DomainMarks {
    /// Whether a tetrahedron is kept, by id.
    pub kept: Vec<bool>,
    /// The region attribute of a tetrahedron, by id; empty if the PLC has no region points.
    pub region: Vec<f64>,
}

/// The components of the tetrahedra, ghosts included, where those are neighbours that no wall divides.
#[derive(Clone, Debug)]
pub struct Components {
    of: Vec<u32>,
    count: usize,
}

impl Components {
    /// The component of all ghosts, which is what no wall encloses.
    pub const OUTSIDE: u32 = 0;

    /// Divides the mesh at `walls`, the subpolygons. Linear time.
    pub(crate) fn new(mesh: &TetMesh, walls: &SimplexIndex<2>) -> Components {
        let mut flood = Flood {
            mesh,
            walls,
            component: vec![u32::MAX; mesh.capacity()],
        };
        if walls.is_empty() {
            // Nothing divides them.
            mesh.all()
                .for_each(|t| flood.component[t.index()] = Components::OUTSIDE);
        } else {
            let ghosts = mesh.all().filter(|&t| mesh.is_ghost(t)).collect();
            flood.fill(ghosts, Components::OUTSIDE);
        }
        let mut count = 1;
        for t in mesh.finite() {
            if flood.component[t.index()] == u32::MAX {
                flood.fill(vec![t], count);
                count += 1;
            }
        }
        Components {
            of: flood.component,
            count: count as usize,
        }
    }

    /// How many there are, the outside included.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The component of a tetrahedron, if the id is that of one.
    pub fn of(&self, t: TetId) -> Option<u32> {
        let component = self.of[t.index()];
        (component != u32::MAX).then_some(component)
    }
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
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct OnPolygon;

/// The most steps of a walk.
const MOST_STEPS: usize = 1000;

/// A finite tetrahedron that contains the point, if it is in the convex hull. A walk from `near`, which need not end
/// in a constrained tetrahedralization. If it does not, or if the point is in no interior, a walk from the first
/// tetrahedron, then a search of all.
pub(crate) fn locate<P: PointStore>(
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
    a: VertexId,
    b: VertexId,
) -> bool {
    incidence
        .tet_at_edge(mesh, a, b)
        .is_some_and(|t| mesh.around(t, a, b).any(|t| marks.kept[t.index()]))
}
