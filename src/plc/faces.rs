//! The bounded faces of a plane graph as lists of corners, for what divides facets and puts them together again.

use super::plane::{Point, Projected};
use super::subdivision::Subdivision;
use crate::mesh::VertexId;

/// A bounded face.
pub(crate) struct Face {
    /// The closed walks along its boundary, the outer one first, with the face on their left. An edge with the face on
    /// both sides is passed twice.
    pub walks: Vec<Vec<VertexId>>,
}

impl Face {
    /// The directed edges of the boundary, with the face on their left.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.walks.iter().flat_map(|walk| {
            let n = walk.len();
            (0..n).map(move |i| [walk[i], walk[(i + 1) % n]])
        })
    }
}

/// The bounded faces of a plane graph.
pub(crate) struct Faces {
    graph: Subdivision,
    /// The face of each walk that bounds one from outside.
    index: Vec<usize>,
    /// The faces.
    pub list: Vec<Face>,
}

impl Faces {
    /// The faces of distinct edges that meet in common ends only. O(k log k + ck) for k edges in c components.
    pub fn new(plane: &Projected, edges: &[[VertexId; 2]]) -> Faces {
        let graph = Subdivision::new(plane, edges);
        let mut corners = graph.corners();
        let mut index = vec![usize::MAX; corners.len()];
        let mut list = Vec::new();
        for walk in (0..corners.len()).filter(|&w| graph.bounded[w]) {
            index[walk] = list.len();
            list.push(Face {
                walks: vec![std::mem::take(&mut corners[walk])],
            });
        }
        for walk in (0..corners.len()).filter(|&w| !graph.bounded[w]) {
            if let Some(face) = graph.face[walk] {
                let inner = std::mem::take(&mut corners[walk]);
                list[index[face]].walks.push(inner);
            }
        }
        Faces { graph, index, list }
    }

    /// The face that contains a point which is on no edge. Linear time.
    pub fn at(&self, point: Point) -> Option<usize> {
        self.graph.face_at(point).map(|walk| self.index[walk])
    }
}
