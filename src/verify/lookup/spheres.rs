//! Which faces have an apex inside, or on, the circumsphere of the tetrahedron on their other side.
//!
//! Each face is looked at once, when it is found ([`super::sweep`]).

use crate::number::Sign;
use crate::verify::lookup::gather::Face;
use crate::verify::signs::points::Points;

/// The faces whose tetrahedra do not just have empty circumspheres.
#[derive(Default)]
pub(crate) struct Spheres {
    /// An apex is inside the circumsphere of the other tetrahedron.
    pub(crate) violated: Vec<usize>,
    /// An apex is on it.
    pub(crate) cospherical: Vec<usize>,
    /// How many more there are of those, on no facet.
    pub(crate) cospherical_elsewhere: usize,
}

/// The sign of insphere across a face with two tetrahedra; negative on the boundary.
#[inline(always)]
pub(crate) fn side_of_sphere(points: &Points, face: &Face) -> Sign {
    if !face.is_shared() {
        return Sign::Negative;
    }
    let [a, b, c] = face.key;
    let [d, e] = face.apexes;
    // The first tetrahedron is positive.
    let [b, c] = if face.first().is_below() {
        [c, b]
    } else {
        [b, c]
    };
    points.insphere([a, b, c, d, e])
}
