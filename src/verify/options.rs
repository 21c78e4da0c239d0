//! How to verify.

/// The most tetrahedra that can be verified.
pub const MOST_TETS: usize = (1 << 29) - 1;

/// What the mesh is expected to fill.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Domain {
    /// What the facets enclose, as [`Domain::Inside`]. Only where they enclose nothing in the mesh, and this is convex,
    /// the convex hull; hole points must not be meshed then, either.
    #[default]
    Auto,
    /// The convex hull of the vertices. Hole points may be meshed, as there are two opinions on what a hole is in a
    /// mesh that keeps its convex hull.
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
    /// The precision of the input: adjacent facets with one marker may have been merged if some plane is within this
    /// distance, along each axis, of all their vertices. 0 if only exactly coplanar ones may have been.
    pub precision: f64,
    /// If given, facets with one marker may have been merged if the dihedral angle between them is at least this many
    /// degrees (TetGen: 179.9). Otherwise only exactly coplanar ones. If the mesh lists edges, such a merged edge may
    /// be an edge of the mesh by chance, but is not listed.
    pub merge_angle: Option<f64>,
    /// Whether faces that are on no facet need not be locally Delaunay: everything else is checked.
    pub any_triangulation: bool,
    /// How many violations of each kind are listed.
    pub cap: usize,
}

impl Default for VerifyOptions {
    fn default() -> VerifyOptions {
        VerifyOptions {
            domain: Domain::Auto,
            tolerance: 8.0,
            precision: 0.0,
            merge_angle: None,
            any_triangulation: false,
            cap: 20,
        }
    }
}
