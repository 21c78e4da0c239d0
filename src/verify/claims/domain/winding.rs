//! How often the boundary of the mesh winds around a point, exactly: the faces that a ray upwards (along the third
//! axis) from the point crosses, +1 where it leaves the mesh and −1 where it enters.
//!
//! The ray is moved by an infinitesimal amount sideways, the same for all faces
//! ([`crate::verify::signs::ray::crossing`]), so that it meets no vertex and no edge. O(k) for a point that k faces
//! are beside of, if many points are asked for; O(n) else.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::verify::case::Case;
use crate::verify::lookup::slabs::Slabs;
use crate::verify::signs::ray::crossing;

/// From how many points on faces are sorted by slabs.
const MANY: usize = 8;

/// Boundary faces.
pub(crate) struct Boundary<'a> {
    case: &'a Case<'a>,
    /// By index in the tables.
    faces: Vec<usize>,
    /// The faces by slabs along the second axis, if many points are asked for.
    slabs: Option<Slabs>,
}

impl<'a> Boundary<'a> {
    /// Of these faces; about so many points will be asked for.
    pub(crate) fn new(case: &'a Case<'a>, faces: Vec<usize>, questions: usize) -> Boundary<'a> {
        let slabs = (questions >= MANY).then(|| {
            let interval = |&f: &usize| {
                let key = case.tables.faces[f].key;
                let wobble = case.points.wobble(&key);
                let [a, b, c] = key.map(|v| case.points.at(v)[1]);
                [a.min(b).min(c) - wobble, a.max(b).max(c) + wobble]
            };
            Slabs::new(&faces.iter().map(interval).collect::<Vec<_>>())
        });
        Boundary { case, faces, slabs }
    }

    /// How often it winds around the centroid of up to four points; none if that is on a face.
    pub(crate) fn winding(&self, q: &[VertexId]) -> Option<i32> {
        self.sum(q, None)
    }

    /// How often it winds around a point just outside of the centroid of one of the faces; none if the face is upright,
    /// or that is on another face.
    pub(crate) fn outside(&self, face: usize) -> Option<i32> {
        self.sum(&self.case.tables.faces[face].key, Some(face))
    }

    fn sum(&self, q: &[VertexId], own: Option<usize>) -> Option<i32> {
        let points = self.case.points;
        let (at, slack) = points.centroid(q);
        let mut sum = 0;
        let mut visit = |f: usize| -> Option<()> {
            let key = self.case.tables.faces[f].key;
            let [a, b, c] = key.map(|v| points.at(v));
            let slack = slack + points.wobble(&key);
            let beside = |i: usize| {
                a[i].max(b[i]).max(c[i]) < at[i] - slack || a[i].min(b[i]).min(c[i]) > at[i] + slack
            };
            if beside(0) || beside(1) {
                return Some(());
            }
            let [a, c, b] = self.case.tables.inward(self.case.tables.faces[f].first());
            let turn: i32 = [[a, b], [b, c], [c, a]]
                .iter()
                .map(|&edge| crossing(points, [0, 1], edge, q))
                .sum();
            if own == Some(f) {
                // Outside means above a face that turns counterclockwise, and below one that turns clockwise.
                sum += turn.min(0);
                return (turn != 0).then_some(());
            }
            if turn != 0 {
                // The face is above the point if the point is below its plane.
                let above = match turn > 0 {
                    true => Sign::Negative,
                    false => Sign::Positive,
                };
                match points.side([a, b, c], q) {
                    Sign::Zero => return None,
                    side => sum += if side == above { turn } else { 0 },
                }
            }
            Some(())
        };
        match &self.slabs {
            None => self.faces.iter().try_for_each(|&f| visit(f))?,
            Some(slabs) => {
                let mut found = Vec::new();
                slabs.around(at[1] - slack, at[1] + slack, &mut found);
                found
                    .iter()
                    .try_for_each(|&i| visit(self.faces[i as usize]))?;
            }
        }
        Some(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::ExportedMesh;
    use crate::exchange::Plc;
    use crate::verify::tests::with_case;

    /// A tetrahedron in another one, one of them twice, apart and shifted.
    #[test]
    fn winds_around_what_is_inside() {
        let at = |x: f64, r: f64| [[x, 0.0, 0.0], [x + r, 0.0, 0.0], [x, r, 0.0], [x, 0.0, r]];
        let mut vertices = [at(0.0, 8.0), at(1.0, 1.0)].concat();
        vertices.extend([
            [0.5, 0.5, 0.5],
            [1.25, 0.25, 0.25],
            [7.0, 7.0, 7.0],
            [1.0, 0.0, 5.0],
        ]);
        let tets = [[0, 1, 2, 3], [4, 5, 6, 7]].map(|t| t.map(VertexId));
        let mesh = ExportedMesh {
            vertices,
            tets: tets.to_vec(),
            ..ExportedMesh::default()
        };
        with_case(&Plc::default(), &mesh, |case| {
            for questions in [1, 100] {
                let all = case.tables.boundary().map(|(f, _)| f).collect();
                let boundary = Boundary::new(case, all, questions);
                let windings = [8, 9, 10].map(|v| boundary.winding(&[VertexId(v)]));
                assert_eq!(windings, [Some(1), Some(2), Some(0)]);
                // On a face.
                assert_eq!(
                    boundary.winding(&[VertexId(0), VertexId(1), VertexId(2)]),
                    None
                );
                // Outside of an inner face there is the other one; outside of an outer one there is nothing.
                for (f, face) in case.tables.boundary() {
                    let inner = face.key.contains(&VertexId(5));
                    let oblique = face.key.iter().filter(|v| ![0, 4].contains(&v.0)).count() == 3;
                    if oblique {
                        assert_eq!(boundary.outside(f), Some(i32::from(inner)));
                    }
                }
            }
        });
    }
}
