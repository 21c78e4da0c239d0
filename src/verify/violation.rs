//! What can be wrong with a mesh: one variant per claim, with the ids and coordinates that show it.

use crate::verify::place::Place;
use thiserror::Error;

/// A claim that does not hold. Tetrahedra, facets and segments are named by their index in the mesh and in the PLC,
/// counting from 0.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Violation {
    /// An element of the mesh or of the PLC names a vertex that does not exist.
    #[error("{element} {index} names vertex {vertex}, but there are only {vertices}")]
    IndexOutOfRange {
        /// What kind of element: "tetrahedron", "mesh face", "facet", ...
        element: &'static str,
        /// Its index.
        index: usize,
        /// The vertex that it names.
        vertex: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// There are more tetrahedra than [`MOST_TETS`](super::options::MOST_TETS).
    #[error(
        "{tets} tetrahedra; no more than {} can be verified",
        crate::verify::options::MOST_TETS
    )]
    TooManyTets {
        /// How many.
        tets: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("{element} {index} has the coordinates {at:?}")]
    NotFinite {
        /// "mesh vertex", "input vertex", "hole point", ...
        element: &'static str,
        /// Its index.
        index: usize,
        /// The coordinates.
        at: [f64; 3],
    },
    /// The exact position of a vertex is not between two vertices whose coordinates are doubles, is given twice, or
    /// is not where the coordinates of the vertex are, up to rounding.
    #[error("vertex {vertex} is said to be exactly at {t} between {} and {}, which {reason}", .ends[0], .ends[1])]
    WrongPosition {
        /// The vertex.
        vertex: Place,
        /// The ends of the segment.
        ends: [Place; 2],
        /// The parameter.
        t: f64,
        /// What is wrong.
        reason: &'static str,
    },
    /// A tetrahedron has the same vertex twice.
    #[error("tetrahedron {tet} has vertex {vertex} twice")]
    RepeatedVertex {
        /// The tetrahedron.
        tet: usize,
        /// The vertex.
        vertex: Place,
    },
    /// The list of region attributes is neither empty nor as long as the list of tetrahedra.
    #[error("{regions} region attributes for {tets} tetrahedra")]
    RegionCount {
        /// The number of attributes.
        regions: usize,
        /// The number of tetrahedra.
        tets: usize,
    },
    /// The mesh has no tetrahedra.
    #[error("the mesh has no tetrahedra")]
    Empty,
    /// Two vertices that tetrahedra use are at the same place.
    #[error("vertices {first} and {second} coincide")]
    CoincidentVertices {
        /// The one.
        first: Place,
        /// The other.
        second: Place,
    },
    /// A vertex of the input lies in the domain but is no vertex of any tetrahedron.
    #[error("input vertex {vertex} is missing from the mesh{}", near(.tet))]
    MissingVertex {
        /// The vertex, with its index in the PLC.
        vertex: Place,
        /// A tetrahedron that contains it, if any does.
        tet: Option<usize>,
    },
    /// A tetrahedron is inverted or flat although (other) tetrahedra are positive.
    #[error("tetrahedron {tet} is {}: {}, {}, {}, {}", if *.flat { "flat" } else { "inverted" },
        .vertices[0], .vertices[1], .vertices[2], .vertices[3])]
    Orientation {
        /// The tetrahedron.
        tet: usize,
        /// Whether its volume is exactly zero.
        flat: bool,
        /// Its vertices.
        vertices: [Place; 4],
    },
    /// A face of the boundary with rounded vertices, or on a facet that is not exactly flat, crosses or touches
    /// another.
    #[error("the boundary faces {}, {}, {} of tetrahedron {} and {}, {}, {} of tetrahedron {} cross",
        .faces[0][0], .faces[0][1], .faces[0][2], .tets[0], .faces[1][0], .faces[1][1], .faces[1][2], .tets[1])]
    BoundaryCrosses {
        /// The two faces.
        faces: [[Place; 3]; 2],
        /// The tetrahedra behind them.
        tets: [usize; 2],
    },
    /// Facets whose common edges are not in the mesh are not on one plane to the stated precision.
    #[error(
        "facets {facets:?} were merged, but are not on one plane: a vertex is {distance:.3e} from that of others"
    )]
    MergedNotFlat {
        /// The facets.
        facets: Vec<usize>,
        /// The largest distance of a vertex from the plane of three others.
        distance: f64,
    },
    /// The mesh lists a face that is on no facet, and not on the boundary.
    #[error("listed face {index}, {}, {}, {}, is on no facet", .face[0], .face[1], .face[2])]
    ListedNotOnFacet {
        /// Its index in the list.
        index: usize,
        /// Its vertices.
        face: [Place; 3],
    },
    /// The mesh lists faces, but not one that covers a facet.
    #[error("the face {}, {}, {} covers facet {facet} but is not listed", .face[0], .face[1], .face[2])]
    FaceNotListed {
        /// The face.
        face: [Place; 3],
        /// The facet.
        facet: usize,
    },
    /// A listed face has a marker that none of its facets has.
    #[error("listed face {index}, {}, {}, {}, has the marker {marker}, its facets have {expected:?}",
        .face[0], .face[1], .face[2])]
    WrongMarker {
        /// Its index in the list.
        index: usize,
        /// Its vertices.
        face: [Place; 3],
        /// Its marker.
        marker: i64,
        /// The markers of its facets; 0 where it is on none.
        expected: Vec<i64>,
    },
    /// More than two tetrahedra share a face.
    #[error("{} tetrahedra share the face {}, {}, {}", .tets.len(), .face[0], .face[1], .face[2])]
    CrowdedFace {
        /// The face.
        face: [Place; 3],
        /// The tetrahedra.
        tets: Vec<usize>,
    },
    /// Two tetrahedra lie on the same side of the face that they share.
    #[error("tetrahedra {} and {} lie on the same side of the face {}, {}, {}",
        .tets[0], .tets[1], .face[0], .face[1], .face[2])]
    SameSide {
        /// The face.
        face: [Place; 3],
        /// The tetrahedra.
        tets: [usize; 2],
    },
    /// A tetrahedron covers the outer side of a boundary face, or a point that another one covers.
    #[error("tetrahedra {} and {} overlap", .tets[0], .tets[1])]
    Overlap {
        /// The two.
        tets: [usize; 2],
    },
    /// An element of [`crate::exchange::ExportedMesh::faces`] or `edges` is no face or edge of any tetrahedron.
    #[error("the listed {element} {index} is not in the mesh")]
    ListedNotInMesh {
        /// "face" or "edge".
        element: &'static str,
        /// Its index in the list.
        index: usize,
    },
    /// A segment of the input is no chain of mesh edges.
    #[error("segment {}–{} (of facets {facets:?}) is not a chain of mesh edges", .ends[0], .ends[1])]
    MissingSegment {
        /// Its ends.
        ends: [Place; 2],
        /// The facets that it bounds or lies in.
        facets: Vec<usize>,
    },
    /// The mesh faces in a facet do not have the boundary of the facet.
    #[error("facets {facets:?} are not a union of mesh faces: {faces} faces meet at the edge {}–{}, not {expected}",
        .edge[0], .edge[1])]
    FacetNotCovered {
        /// The facet, or the coplanar facets that were merged.
        facets: Vec<usize>,
        /// An edge at which the faces do not fit.
        edge: [Place; 2],
        /// How many mesh faces in the facet have that edge.
        faces: usize,
        /// How many should have it.
        expected: usize,
    },
    /// A facet is so far from flat that which parts of its plane it covers cannot be told: in the projection along a
    /// coordinate axis that shows it best, an edge is a point, and others meet at an end of that edge.
    #[error("facet {facet} is not flat: its edge {}–{} is upright, and what is inside cannot be told",
        .edge[0], .edge[1])]
    FacetUpright {
        /// The facet.
        facet: usize,
        /// The edge.
        edge: [Place; 2],
    },
    /// The mesh faces in a facet have its boundary but overlap or fold.
    #[error("the mesh faces in facets {facets:?} cover {covered} of the projected area {area}")]
    FacetArea {
        /// The facet, or the coplanar facets that were merged.
        facets: Vec<usize>,
        /// The sum of the projected areas of the faces.
        covered: f64,
        /// The projected area of the facet.
        area: f64,
    },
    /// An unconstrained face has the apex of one tetrahedron inside the circumsphere of the other.
    #[error("the face {}, {}, {} of tetrahedra {} and {} (apexes {}, {}) is not locally Delaunay{}",
        .face[0], .face[1], .face[2], .tets[0], .tets[1], .apexes[0], .apexes[1], facet_of(.facet))]
    NotLocallyDelaunay {
        /// The face.
        face: [Place; 3],
        /// The tetrahedra that share it.
        tets: [usize; 2],
        /// The vertex of each that is not on the face.
        apexes: [Place; 2],
        /// An input facet whose vertices the face has, although it is not one of the faces that cover the facet.
        facet: Option<usize>,
    },
    /// A face with one tetrahedron is on no facet (where the outside is removed).
    #[error("the boundary face {}, {}, {} of tetrahedron {tet} is on no facet", .face[0], .face[1], .face[2])]
    BoundaryNotOnFacet {
        /// The face.
        face: [Place; 3],
        /// Its tetrahedron.
        tet: usize,
    },
    /// The boundary is not convex at an edge (where the convex hull is kept).
    #[error("the hull is not convex: {apex} is outside the boundary face {}, {}, {}", .face[0], .face[1], .face[2])]
    HullNotConvex {
        /// A boundary face.
        face: [Place; 3],
        /// The vertex of a neighbouring boundary face that is outside its plane.
        apex: Place,
    },
    /// The boundary of a mesh of the convex hull is not a surface at an edge.
    #[error("{faces} boundary faces meet at the edge {}–{} of the hull", .edge[0], .edge[1])]
    HullNotManifold {
        /// The edge.
        edge: [Place; 2],
        /// The number of boundary faces there.
        faces: usize,
    },
    /// Around an edge, meshed and empty space do not take turns as the boundary faces say.
    #[error("the boundary faces around the edge {}–{} contradict each other", .edge[0], .edge[1])]
    BoundaryNotEmbedded {
        /// The edge.
        edge: [Place; 2],
    },
    /// A connected part of the boundary has the signed volume zero, as no boundary of a solid and of a void has: it
    /// crosses itself.
    #[error("the boundary that face {}, {}, {} belongs to encloses as much as it leaves out: it crosses itself",
        .face[0], .face[1], .face[2])]
    BoundaryWithoutVolume {
        /// One of its faces.
        face: [Place; 3],
    },
    /// A part of the domain that is enclosed by facets, and holds no hole point, has no tetrahedra.
    #[error(
        "a part of volume {volume} with {faces} boundary faces, one at {at}, is enclosed by facets, has no hole point, \
         and is not meshed"
    )]
    MissingPart {
        /// Its volume, islands included.
        volume: f64,
        /// The number of faces and facets around it.
        faces: usize,
        /// A vertex on its boundary.
        at: Place,
    },
    /// A hole point lies in a tetrahedron.
    #[error("hole point {hole} at {at:?} lies in tetrahedron {tet}")]
    HoleMeshed {
        /// The index of the hole point.
        hole: usize,
        /// Where it is.
        at: [f64; 3],
        /// The tetrahedron.
        tet: usize,
    },
    /// The tetrahedra do not add up to the volume inside their boundary.
    #[error(
        "the volumes of the tetrahedra add up to {tets}, but their boundary encloses {boundary}"
    )]
    Volume {
        /// The sum over the tetrahedra.
        tets: f64,
        /// The volume that the boundary faces enclose.
        boundary: f64,
    },
    /// Two tetrahedra that share an unconstrained face have different region attributes.
    #[error("tetrahedra {} and {} share an unconstrained face but have the attributes {} and {}",
        .tets[0], .tets[1], .attributes[0], .attributes[1])]
    RegionLeaks {
        /// The tetrahedra.
        tets: [usize; 2],
        /// Their attributes.
        attributes: [f64; 2],
    },
    /// The tetrahedron at a region point has another attribute than the point.
    #[error("region point {region} has attribute {expected}, its tetrahedron {tet} has {found}")]
    WrongRegion {
        /// The index of the region point.
        region: usize,
        /// The tetrahedron that contains it.
        tet: usize,
        /// The attribute of the point.
        expected: f64,
        /// The attribute of the tetrahedron.
        found: f64,
    },
}

fn near(tet: &Option<usize>) -> String {
    tet.map_or(String::new(), |t| {
        format!(", although it lies in tetrahedron {t}")
    })
}

fn facet_of(facet: &Option<usize>) -> String {
    facet.map_or(String::new(), |f| {
        format!("; its vertices are on facet {f}")
    })
}

impl Violation {
    /// The name of the variant, under which [`super::Verdict::totals`] counts it.
    pub fn kind(&self) -> &'static str {
        match self {
            Violation::IndexOutOfRange { .. } => "index out of range",
            Violation::TooManyTets { .. } => "too many tetrahedra",
            Violation::NotFinite { .. } => "coordinate not finite",
            Violation::WrongPosition { .. } => "wrong position",
            Violation::RepeatedVertex { .. } => "repeated vertex",
            Violation::RegionCount { .. } => "region count",
            Violation::Empty => "empty mesh",
            Violation::CoincidentVertices { .. } => "coincident vertices",
            Violation::MissingVertex { .. } => "missing vertex",
            Violation::Orientation { .. } => "orientation",
            Violation::BoundaryCrosses { .. } => "boundary crosses",
            Violation::MergedNotFlat { .. } => "merged but not flat",
            Violation::ListedNotOnFacet { .. } => "listed but not on a facet",
            Violation::FaceNotListed { .. } => "face not listed",
            Violation::WrongMarker { .. } => "wrong marker",
            Violation::CrowdedFace { .. } => "crowded face",
            Violation::SameSide { .. } => "same side",
            Violation::Overlap { .. } => "overlap",
            Violation::ListedNotInMesh { .. } => "listed but not in mesh",
            Violation::MissingSegment { .. } => "missing segment",
            Violation::FacetNotCovered { .. } => "facet not covered",
            Violation::FacetUpright { .. } => "facet upright",
            Violation::FacetArea { .. } => "facet area",
            Violation::NotLocallyDelaunay { .. } => "not locally Delaunay",
            Violation::BoundaryWithoutVolume { .. } => "boundary without volume",
            Violation::BoundaryNotOnFacet { .. } => "boundary not on facet",
            Violation::HullNotConvex { .. } => "hull not convex",
            Violation::HullNotManifold { .. } => "hull not manifold",
            Violation::BoundaryNotEmbedded { .. } => "boundary not embedded",
            Violation::MissingPart { .. } => "missing part",
            Violation::HoleMeshed { .. } => "hole meshed",
            Violation::Volume { .. } => "volume",
            Violation::RegionLeaks { .. } => "region leaks",
            Violation::WrongRegion { .. } => "wrong region",
        }
    }
}
