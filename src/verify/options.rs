//! How to verify.

/// The most tetrahedra that can be verified.
pub const MOST_TETS: usize = (1 << 29) - 1;

/// What the mesh is expected to fill.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Domain {
    /// The convex hull if the mesh is convex and does not fit the inside: a boundary face is on no facet, or a hole
    /// point is meshed. Otherwise the inside.
    #[default]
    Auto,
    /// The convex hull of the vertices.
    Hull,
    /// What the facets enclose, without the parts that hold a hole point.
    Inside,
}

/// How to verify.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerifyOptions {
    /// What the mesh is expected to fill.
    pub domain: Domain,
    /// How far a Steiner point may be from its segment or facet, in units in the last place of the largest coordinate.
    pub tolerance: f64,
    /// If given, facets with one marker may have been merged if the dihedral angle between them is at least this many
    /// degrees (TetGen: 179.9). Otherwise only exactly coplanar ones. If the mesh lists edges, such a merged edge may
    /// be an edge of the mesh by chance, but is not listed.
    pub merge_angle: Option<f64>,
    /// How many violations of each kind are listed.
    pub cap: usize,
}

impl Default for VerifyOptions {
    fn default() -> VerifyOptions {
        VerifyOptions {
            domain: Domain::Auto,
            tolerance: 8.0,
            merge_angle: None,
            cap: 20,
        }
    }
}
