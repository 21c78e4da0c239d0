//! The polynomials of the predicates, over any [`Number`].
//!
//! Some are written a second time, and compared with these in tests: for speed in doubles, two at a time (`pairs`; the
//! module `machine` says what that gains), and in integers of fixed size, where each product has just the size that it
//! needs (`integers`); in the filters of [`crate::verify`] on purpose, so that one mistake does not decide both what is
//! built and what is accepted.
//!
//! # Signs
//! orient3d(a,b,c,d) = det[b−a, c−a, d−a] is positive for a positive tetrahedron. (Shewchuk's `orient3d`, and the
//! `robust` crate's, is its negative.)
//!
//! # The lifted determinant
//! Let each of five points p_i have a height h_i (for insphere: h_i = |p_i|²; a weight lowers the height: h_i = |p_i|²
//! − w_i). With e = p_4 as the origin, the 4×4 determinant with rows (p_i − e, h_i − h_e), i = 0…3, expanded along its
//! last column, is
//!
//! > −h_a·O(e,b,c,d) + h_b·O(e,a,c,d) − h_c·O(e,a,b,d) + h_d·O(e,a,b,c), heights relative to h_e,
//!
//! where O = orient3d. We take its negative, so that over a positive abcd it is positive iff e lies *below* the lifted
//! hyperplane of abcd: for insphere, inside the circumsphere. Its derivative by the weight w_i is therefore
//!
//! > c_a = −O(e,b,c,d), c_b = +O(e,a,c,d), c_c = −O(e,a,b,d), c_d = +O(e,a,b,c), c_e = O(a,b,c,d),
//!
//! with Σ c_i = 0 and Σ c_i p_i = 0: the affine dependence of the five points, their *circuit*. So
//!
//! > orient4d = −Σ c_i·(h_i − h_e), insphere = −Σ c_i·|p_i − e|².
//!
//! c_i > 0 says that p_i is on the side of e in the Radon partition of the circuit. [`circuit`] computes all five from
//! six 2×2 minors.

use crate::number::{Number, Vec3};

/// A tetrahedron vxyz from which the lifted determinants of its facets are computed: what they have in common.
///
/// The affine function through the heights of v, x, y, z relative to that of v is p ↦ G·(p − v)/V with
/// V = O(v,x,y,z) and G = h_x (y−v)×(z−v) + h_y (z−v)×(x−v) + h_z (x−v)×(y−v). A fifth point w with height h_w (also
/// relative) lies below it by
///
/// > orient4d(v,x,y,z,w) = G·(w − v) − V·h_w
///
/// times 1/V: the polynomial of [`orient4d`], factored otherwise. G is computed once for all facets of the tetrahedron.
#[derive(Clone, Debug)]
pub struct Lifted<N> {
    volume: N,
    crosses: [Vec3<N>; 3],
}

impl<N: Number> Lifted<N> {
    /// From x − v, y − v, z − v.
    #[inline(always)]
    pub fn new([x, y, z]: [&Vec3<N>; 3]) -> Self {
        let crosses = [y.cross(z), z.cross(x), x.cross(y)];
        Lifted {
            volume: x.dot(&crosses[0]),
            crosses,
        }
    }

    /// G for the heights of x, y, z relative to that of v.
    #[inline(always)]
    pub fn gradient(&self, heights: [&N; 3]) -> Vec3<N> {
        let [hx, hy, hz] = heights;
        let [x, y, z] = &self.crosses;
        let component =
            |i: usize| hx.clone() * &x.0[i] + &(hy.clone() * &y.0[i]) + &(hz.clone() * &z.0[i]);
        Vec3([component(0), component(1), component(2)])
    }

    /// V.
    #[inline(always)]
    pub fn volume(&self) -> &N {
        &self.volume
    }

    /// The volumes of the tetrahedron with w in place of x, of y, of z, from w − v: V times the barycentric coordinates
    /// of w.
    #[inline(always)]
    pub fn with_in_place(&self, w: &Vec3<N>) -> [N; 3] {
        let [x, y, z] = &self.crosses;
        [w.dot(x), w.dot(y), w.dot(z)]
    }

    /// orient4d(v,x,y,z,w), from G, w − v and the height of w relative to that of v.
    #[inline(always)]
    pub fn below(&self, gradient: &Vec3<N>, w: &Vec3<N>, height: &N) -> N {
        gradient.dot(w) - &(self.volume.clone() * height)
    }
}

/// det[b−a, c−a], twice the signed area of abc: positive iff abc turns counterclockwise.
#[inline]
pub fn orient2d<N: Number>([a, b, c]: [&[N; 2]; 3]) -> N {
    let [bx, by] = relative(b, a);
    let [cx, cy] = relative(c, a);
    bx * &cy - &(by * &cx)
}

/// (b−a)·(c−a).
#[inline]
pub fn dot2d<N: Number>([a, b, c]: [&[N; 2]; 3]) -> N {
    let [bx, by] = relative(b, a);
    let [cx, cy] = relative(c, a);
    bx * &cx + &(by * &cy)
}

/// Positive iff d is inside the circumcircle of a counterclockwise abc.
///
/// This is the determinant with rows (p − d, |p − d|²) for p = a, b, c, expanded along its last column.
#[inline]
pub fn incircle<N: Number>([a, b, c, d]: [&[N; 2]; 4]) -> N {
    let (a, b, c) = (relative(a, d), relative(b, d), relative(c, d));
    let lift = |[x, y]: &[N; 2]| x.clone() * x + &(y.clone() * y);
    let minor = |[px, py]: &[N; 2], [qx, qy]: &[N; 2]| px.clone() * qy - &(py.clone() * qx);
    lift(&a) * &minor(&b, &c) + &(lift(&b) * &minor(&c, &a)) + &(lift(&c) * &minor(&a, &b))
}

#[inline(always)]
fn relative<N: Number>([x, y]: &[N; 2], [ox, oy]: &[N; 2]) -> [N; 2] {
    [x.clone() - ox, y.clone() - oy]
}

/// det[b−a, c−a, d−a], six times the signed volume of abcd.
#[inline]
pub fn orient3d<N: Number>([a, b, c, d]: [&Vec3<N>; 4]) -> N {
    b.sub(a).dot(&c.sub(a).cross(&d.sub(a)))
}

/// The five coefficients c_i of the circuit of a, b, c, d, e (see the module's text), and the differences to e.
#[inline]
pub fn circuit<N: Number>([a, b, c, d, e]: [&Vec3<N>; 5]) -> ([N; 5], [Vec3<N>; 4]) {
    let q = [a.sub(e), b.sub(e), c.sub(e), d.sub(e)];
    // minor(i,j) = x_i y_j − x_j y_i
    let minor = |i: usize, j: usize| -> N {
        let ([xi, yi, _], [xj, yj, _]) = (&q[i].0, &q[j].0);
        xi.clone() * yj - &(xj.clone() * yi)
    };
    let (ab, ac, ad) = (minor(0, 1), minor(0, 2), minor(0, 3));
    let (bc, bd, cd) = (minor(1, 2), minor(1, 3), minor(2, 3));
    let (az, bz, cz, dz) = (&q[0].0[2], &q[1].0[2], &q[2].0[2], &q[3].0[2]);
    // det3(i,j,k) = O(e,i,j,k) = z_i·minor(j,k) − z_j·minor(i,k) + z_k·minor(i,j)
    let bcd = bz.clone() * &cd - &(cz.clone() * &bd) + &(dz.clone() * &bc);
    let acd = az.clone() * &cd - &(cz.clone() * &ad) + &(dz.clone() * &ac);
    let abd = az.clone() * &bd - &(bz.clone() * &ad) + &(dz.clone() * &ab);
    let abc = az.clone() * &bc - &(bz.clone() * &ac) + &(cz.clone() * &ab);
    // c_e = −(c_a + c_b + c_c + c_d) because Σ c_i = 0.
    let ce = bcd.clone() - &acd + &abd - &abc;
    let zero = N::from_f64(0.0);
    ([zero.clone() - &bcd, acd, zero - &abd, abc, ce], q)
}

/// The lifted determinant with arbitrary heights of a, b, c, d relative to that of e.
#[inline]
pub fn orient4d<N: Number>(circuit: &[N; 5], heights: [&N; 4]) -> N {
    let [ca, cb, cc, cd, _] = circuit;
    let [ha, hb, hc, hd] = heights;
    let outer = ca.clone() * ha + &(cc.clone() * hc);
    let inner = cb.clone() * hb + &(cd.clone() * hd);
    N::from_f64(0.0) - &(outer + &inner)
}

/// Positive iff e is inside the circumsphere of a positive abcd: [`orient4d`] with the parabolic heights.
#[inline]
pub fn insphere<N: Number>(points: [&Vec3<N>; 5]) -> N {
    let (c, q) = circuit(points);
    let [a, b, c4, d] = &q;
    orient4d(&c, [&a.dot(a), &b.dot(b), &c4.dot(c4), &d.dot(d)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Dyadic, Exact, Sign};

    fn points<const N: usize>(p: [[i32; 3]; N]) -> [Vec3<Dyadic>; N] {
        p.map(|q| Vec3::from_f64(q.map(f64::from)))
    }

    #[test]
    fn orientation_is_the_crates() {
        let p = points([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]);
        assert_eq!(orient3d(p.each_ref()).exact_sign(), Sign::Positive);
    }

    #[test]
    fn formulas_of_the_plane() {
        let sign = |number: Dyadic| number.exact_sign();
        let plane = |x: i32, y: i32| [x, y].map(|x| Dyadic::from_f64(f64::from(x)));
        let [a, b, c] = [plane(0, 0), plane(2, 0), plane(0, 2)];
        assert_eq!(sign(orient2d([&a, &b, &c])), Sign::Positive);
        assert_eq!(sign(orient2d([&a, &c, &b])), Sign::Negative);
        assert_eq!(sign(dot2d([&a, &b, &c])), Sign::Zero);
        assert_eq!(sign(dot2d([&b, &a, &c])), Sign::Positive);
        let at = |x, y| sign(incircle([&a, &b, &c, &plane(x, y)]));
        assert_eq!(
            [at(1, 1), at(2, 2), at(3, 2), at(-1, -1)],
            [Sign::Positive, Sign::Zero, Sign::Negative, Sign::Negative]
        );
    }

    #[test]
    fn insphere_is_positive_inside() {
        let at = |z| {
            let p = points([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [1, 1, z]]);
            insphere(p.each_ref()).exact_sign()
        };
        assert_eq!(at(1), Sign::Positive);
        assert_eq!(at(9), Sign::Negative);
        let p = points([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [4, 4, 4]]);
        assert_eq!(insphere(p.each_ref()).exact_sign(), Sign::Zero);
    }

    #[test]
    fn lifted_is_orient4d() {
        let p = points([[3, 1, 4], [1, 5, 9], [2, 6, 5], [3, 5, 8], [9, 7, 9]]);
        let heights = [2, 7, 1, 8, -3].map(|h| Dyadic::from_f64(f64::from(h)));
        let (c, _) = circuit(p.each_ref());
        let relative = [0, 1, 2, 3].map(|i: usize| heights[i].clone() - &heights[4]);
        let expected = orient4d(&c, relative.each_ref());
        let from_v = [1, 2, 3, 4].map(|i: usize| p[i].sub(&p[0]));
        let relative = [1, 2, 3, 4].map(|i: usize| heights[i].clone() - &heights[0]);
        let lifted = Lifted::new([&from_v[0], &from_v[1], &from_v[2]]);
        let gradient = lifted.gradient([&relative[0], &relative[1], &relative[2]]);
        assert_eq!(lifted.below(&gradient, &from_v[3], &relative[3]), expected);
        assert_ne!(expected.exact_sign(), Sign::Zero);
    }

    #[test]
    fn circuit_is_made_of_orientations() {
        let p = points([[3, 1, 4], [1, 5, 9], [2, 6, 5], [3, 5, 8], [9, 7, 9]]);
        let [a, b, c, d, e] = p.each_ref();
        let (circuit, _) = circuit([a, b, c, d, e]);
        let zero = Dyadic::ZERO;
        assert_eq!(circuit[0], zero.clone() - &orient3d([e, b, c, d]));
        assert_eq!(circuit[1], orient3d([e, a, c, d]));
        assert_eq!(circuit[2], zero - &orient3d([e, a, b, d]));
        assert_eq!(circuit[3], orient3d([e, a, b, c]));
        assert_eq!(circuit[4], orient3d([a, b, c, d]));
    }
}
