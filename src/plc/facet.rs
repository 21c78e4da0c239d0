//! One facet of the input as a [`Polygon`]: which checks it must pass, and on which side of its edges its area lies.
//!
//! Triangles and other simple polygons keep the order of their corners as the counterclockwise one. Every other facet
//! (several polygons, hole points, floating edges and vertices, slits) goes through a planar subdivision
//! ([`super::subdivision`]); it is counterclockwise as its first polygon with a non-zero signed area is.

use super::crossing::{self, Conflict};
use super::frame::{self, Flatness};
use super::plane::{Projected, Projection, area_sign, collinear, convex_turn};
use super::subdivision;
use super::{EdgeName, FacetName, PlcError, Polygon, VertexName};
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::number::Sign;
use crate::number::slab::Slab;
use std::borrow::Cow;

/// The polygons of a facet after duplicate vertices have been merged.
pub(crate) struct FacetInput<'a> {
    /// The whole input.
    pub plc: &'a Plc,
    /// The facet's index.
    pub index: usize,
    /// Its polygons, checked by [`FacetInput::new`].
    pub polygons: Cow<'a, [Vec<VertexId>]>,
    /// How far vertices may be from its plane, along each axis.
    delta: f64,
}

impl<'a> FacetInput<'a> {
    /// Maps the corners to their representatives and checks that each polygon is one.
    pub fn new(
        plc: &'a Plc,
        index: usize,
        representative: &[VertexId],
        delta: f64,
    ) -> Result<FacetInput<'a>, PlcError> {
        let facet = || FacetName::new(plc, index);
        let given = &plc.facets[index].polygons;
        if given.is_empty() {
            return Err(PlcError::Empty { facet: facet() });
        }
        // Most inputs have no duplicate vertices.
        let is_itself = |v: &VertexId| representative.get(v.index()) == Some(v);
        let same = given.iter().flatten().all(is_itself);
        let mut mapped = Vec::new();
        for corners in given {
            if corners.is_empty() {
                return Err(PlcError::Empty { facet: facet() });
            }
            if same {
                check_corners(plc, index, corners, corners)?;
                continue;
            }
            let map = |&v: &VertexId| {
                let found = representative.get(v.index()).copied();
                found.ok_or_else(|| PlcError::NoSuchVertex {
                    facet: facet(),
                    vertex: VertexName::new(plc, v),
                })
            };
            let polygon: Vec<VertexId> = corners.iter().map(map).collect::<Result<_, _>>()?;
            check_corners(plc, index, corners, &polygon)?;
            mapped.push(polygon);
        }
        Ok(FacetInput {
            plc,
            index,
            polygons: if same {
                Cow::Borrowed(given)
            } else {
                Cow::Owned(mapped)
            },
            delta,
        })
    }

    /// Whether some polygon is more than a segment or a vertex.
    pub fn is_area(&self) -> bool {
        self.polygons.iter().any(|p| p.len() >= 3)
    }

    /// Whether it is one polygon without repeated corners and without holes: the order of its corners counts.
    pub fn is_simple(&self, vertices: usize) -> bool {
        let holes = &self.plc.facets[self.index].holes;
        matches!(&self.polygons[..], [corners] if holes.is_empty() && corners.len() == vertices)
    }

    /// The edges of all polygons in order, those of closed polygons as they are passed through.
    pub fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> {
        self.polygons.iter().flat_map(|p| {
            let edges = match p.len() {
                0 | 1 => 0,
                2 => 1,
                n => n,
            };
            (0..edges).map(move |i| [p[i], p[(i + 1) % p.len()]])
        })
    }

    /// The polygon in the sense of the paper.
    pub fn polygon(&self) -> Result<Polygon, PlcError> {
        let [corners] = &self.polygons[..] else {
            return self.general();
        };
        if let &[a, b, c] = &corners[..]
            && self.is_simple(3)
        {
            return self.triangle([a, b, c]);
        }
        let vertices = sorted(corners.clone());
        if self.is_simple(vertices.len()) {
            self.simple(corners, vertices)
        } else {
            self.general()
        }
    }

    fn triangle(&self, frame: [VertexId; 3]) -> Result<Polygon, PlcError> {
        if collinear(frame.map(|v| self.plc.vertices[v.index()])) {
            return Err(PlcError::ZeroArea { facet: self.name() });
        }
        let [a, b, c] = frame;
        Ok(self.finish(
            vec![[a, b], [b, c], [c, a]],
            sorted(frame.to_vec()),
            frame,
            true,
        ))
    }

    /// A polygon without repeated corners.
    fn simple(&self, corners: &[VertexId], vertices: Vec<VertexId>) -> Result<Polygon, PlcError> {
        let (frame, flat) = self.frame(&vertices)?;
        let (plane, sign) = self.project(frame)?;
        let edges: Vec<_> = self.edges().collect();
        let walk: Vec<_> = corners.iter().map(|&v| plane.at(v)).collect();
        let turn = match convex_turn(&walk) {
            Some(turn) => turn,
            None => {
                self.check_embedding(&plane, &edges, &[])?;
                area_sign(&walk)
            }
        };
        let frame = oriented(frame, sign, turn);
        Ok(self.finish(edges, vertices, frame, flat))
    }

    fn general(&self) -> Result<Polygon, PlcError> {
        let all = sorted(self.polygons.concat());
        let (frame, flat) = self.frame(&all)?;
        let (plane, sign) = self.project(frame)?;
        let mut edges: Vec<_> = self.edges().map(undirected).collect();
        edges.sort_unstable();
        edges.dedup();
        let ends = sorted(edges.concat());
        let floating: Vec<_> = all
            .iter()
            .copied()
            .filter(|v| ends.binary_search(v).is_err())
            .collect();
        self.check_embedding(&plane, &edges, &floating)?;

        let given = &self.plc.facets[self.index].holes;
        let holes: Vec<_> = given.iter().map(|&p| plane.projection.point(p)).collect();
        let area = subdivision::area(&plane, &edges, &floating, &holes);
        let area = area.map_err(|e| PlcError::HoleOnEdge {
            facet: self.name(),
            hole: e.hole,
            edge: EdgeName::new(self.plc, e.edge),
        })?;
        if area.edges.is_empty() {
            let facet = self.name();
            return Err(match area.holes_used {
                true => PlcError::NothingLeft { facet },
                false => PlcError::ZeroArea { facet },
            });
        }
        // Edges and vertices outside the area do not belong to the polygon, nor to its frame.
        let vertices = sorted([area.edges.concat(), area.floating].concat());
        let (frame, flat, sign) = if vertices == all {
            (frame, flat, sign)
        } else {
            let (frame, flat) = self.frame(&vertices)?;
            (frame, flat, plane.orient(frame))
        };
        if sign.is_zero() {
            return Err(PlcError::ZeroArea { facet: self.name() });
        }
        let turn = self.turn(&plane).unwrap_or(sign);
        let mut edges = area.edges;
        if turn.is_negative() {
            edges.iter_mut().for_each(|edge| edge.reverse());
        }
        Ok(self.finish(edges, vertices, oriented(frame, sign, turn), flat))
    }

    /// The orientation of the first polygon that has one.
    fn turn(&self, plane: &Projected) -> Option<Sign> {
        let signs = self.polygons.iter().map(|polygon| {
            let walk: Vec<_> = polygon.iter().map(|&v| plane.at(v)).collect();
            area_sign(&walk)
        });
        signs.into_iter().find(|s| !s.is_zero())
    }

    /// The frame, and whether all vertices are exactly on its plane.
    fn frame(&self, vertices: &[VertexId]) -> Result<([VertexId; 3], bool), PlcError> {
        let points = &self.plc.vertices;
        let frame = frame::choose(points, vertices);
        let frame = frame.ok_or_else(|| PlcError::ZeroArea { facet: self.name() })?;
        match frame::flatness(points, frame, vertices) {
            Flatness::Flat => Ok((frame, true)),
            Flatness::NearlyFlat => Ok((frame, false)),
            Flatness::NotPlanar(..) if self.is_flat_to_precision(frame, vertices) => {
                Ok((frame, false))
            }
            Flatness::NotPlanar(vertex, distance) => Err(PlcError::NotPlanar {
                facet: self.name(),
                vertex: VertexName::new(self.plc, vertex),
                distance,
            }),
        }
    }

    /// Whether some plane is within δ of all vertices.
    fn is_flat_to_precision(&self, frame: [VertexId; 3], vertices: &[VertexId]) -> bool {
        let at = |v: VertexId| self.plc.vertices[v.index()];
        let points: Vec<[f64; 3]> = vertices.iter().map(|&v| at(v)).collect();
        let slab = Slab::of(frame.map(at)).filter(|_| self.delta > 0.0);
        slab.is_some_and(|mut slab| slab.fit(&points, 0, self.delta))
    }

    /// The projection that suits a frame, and the orientation of the frame in it.
    fn project(&self, frame: [VertexId; 3]) -> Result<(Projected<'a>, Sign), PlcError> {
        let points = &self.plc.vertices;
        let triangle = frame.map(|v| points[v.index()]);
        let (projection, sign) = Projection::of(triangle).expect("a frame is not collinear");
        Ok((Projected { points, projection }, sign))
    }

    fn check_embedding(
        &self,
        plane: &Projected,
        edges: &[[VertexId; 2]],
        floating: &[VertexId],
    ) -> Result<(), PlcError> {
        let facet = || self.name();
        // In a polygon that is not exactly flat an edge may stand upright on it.
        if let Some(&edge) = edges.iter().find(|[a, b]| plane.at(*a) == plane.at(*b)) {
            return Err(PlcError::VertexOnEdge {
                facet: facet(),
                vertex: VertexName::new(self.plc, edge[0]),
                edge: EdgeName::new(self.plc, edge),
            });
        }
        match crossing::find(plane, edges, floating) {
            None => Ok(()),
            Some(Conflict::Cross(edges)) => Err(PlcError::EdgesCross {
                facet: facet(),
                edges: edges.map(|e| EdgeName::new(self.plc, e)),
            }),
            Some(Conflict::OnEdge(vertex, edge)) => Err(PlcError::VertexOnEdge {
                facet: facet(),
                vertex: VertexName::new(self.plc, vertex),
                edge: EdgeName::new(self.plc, edge),
            }),
        }
    }

    fn finish(
        &self,
        mut edges: Vec<[VertexId; 2]>,
        vertices: Vec<VertexId>,
        frame: [VertexId; 3],
        flat: bool,
    ) -> Polygon {
        edges.sort_unstable();
        Polygon {
            edges,
            vertices,
            frame,
            flat,
            facets: vec![self.index],
            marker: self.plc.facets[self.index].marker,
        }
    }

    fn name(&self) -> FacetName {
        FacetName::new(self.plc, self.index)
    }
}

/// Whether the corners of a polygon, which become `polygon` after duplicate vertices have been merged, are distinct
/// enough.
fn check_corners(
    plc: &Plc,
    index: usize,
    corners: &[VertexId],
    polygon: &[VertexId],
) -> Result<(), PlcError> {
    let repeated = (0..polygon.len()).find(|&i| {
        let previous = if i == 0 { polygon.len() } else { i } - 1;
        i != previous && polygon[i] == polygon[previous]
    });
    if let Some(i) = repeated {
        return Err(PlcError::RepeatedVertex {
            facet: FacetName::new(plc, index),
            vertex: VertexName::new(plc, corners[i]),
        });
    }
    // Neighbours differ, so that there are two vertices at least.
    if polygon.len() >= 3 && polygon.iter().all(|v| polygon[..2].contains(v)) {
        let facet = FacetName::new(plc, index);
        return Err(PlcError::TooFewVertices { facet });
    }
    Ok(())
}

/// The frame turned so that its orientation in the projection, now `sign`, becomes `wanted`.
fn oriented([a, b, c]: [VertexId; 3], sign: Sign, wanted: Sign) -> [VertexId; 3] {
    if sign == wanted { [a, b, c] } else { [a, c, b] }
}

/// The ends in increasing order.
pub(crate) fn undirected([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    [a.min(b), a.max(b)]
}

/// Sorted, without repetitions.
pub(crate) fn sorted(mut vertices: Vec<VertexId>) -> Vec<VertexId> {
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}
