//! ParaView's unstructured grids, `.vtu` (VTK XML, ASCII), written only.
//!
//! The tetrahedra come first, then the faces as triangles. Cell data cover both: `kind` (3 for a tetrahedron, 2 for a
//! triangle), `region` (the attribute of the region; 0 for triangles and where there are no regions), `marker` (0 for
//! tetrahedra), and what is known beyond these: `behind` and `front`, the numbers of the regions on both sides of a
//! triangle, both the region of a tetrahedron (0: not in the mesh); `polygon` and `facet`, the polygon of a triangle
//! and the first of its facets (0 for tetrahedra; see `tetgen_writer`). Point data: the attributes and the markers of
//! vertices, if there are any. ParaView's orientation of a tetrahedron is ours: the first three vertices are
//! counterclockwise for one who looks from the side away from the fourth.
//!
//! Written by hand, since the stable release of the crate `vtkio` (0.6) stands on releases of `nom` and `quick-xml`
//! that rustc announces to reject, and 0.7 is a release candidate. ASCII keeps doubles: they have as many digits as
//! they need.

use super::mesh_file::Shortest;
use crate::exchange::ExportedMesh;
use crate::mesh::VertexId;
use std::fmt::Display;
use std::io::{self, Write};

const TETRAHEDRON: u8 = 10;
const TRIANGLE: u8 = 5;

/// Writes a checked mesh.
pub(super) fn write(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    let (tets, faces) = (mesh.tets.len(), mesh.faces.len());
    let cells = tets + faces;
    begin(out, &mesh.vertices, cells)?;

    writeln!(out, "<Cells>")?;
    let id = |v: VertexId| v.0;
    open(out, r#"type="Int64" Name="connectivity""#)?;
    rows(out, mesh.tets.iter().map(|t| t.map(id)))?;
    rows(out, mesh.faces.iter().map(|f| f.vertices.map(id)))?;
    close(out)?;
    let ends = (1..=tets).map(|i| 4 * i);
    let ends = ends.chain((1..=faces).map(|i| 4 * tets + 3 * i));
    array(out, r#"type="Int64" Name="offsets""#, ends.map(|end| [end]))?;
    let per_kind = |tet: u8, face: u8| {
        let kinds = std::iter::repeat_n([tet], tets);
        kinds.chain(std::iter::repeat_n([face], faces))
    };
    array(
        out,
        r#"type="UInt8" Name="types""#,
        per_kind(TETRAHEDRON, TRIANGLE),
    )?;
    writeln!(out, "</Cells>")?;

    writeln!(out, r#"<CellData Scalars="region">"#)?;
    let regions = mesh.regions.iter().copied();
    let regions = regions.chain(std::iter::repeat_n(0.0, cells - mesh.regions.len()));
    array(
        out,
        r#"type="Float64" Name="region""#,
        regions.map(|x| [Shortest(x)]),
    )?;
    let markers = std::iter::repeat_n(0, tets).chain(mesh.faces.iter().map(|f| f.marker));
    array(out, r#"type="Int64" Name="marker""#, markers.map(|m| [m]))?;
    array(out, r#"type="UInt8" Name="kind""#, per_kind(3, 2))?;
    face_table(out, mesh)?;
    writeln!(out, "</CellData>")?;
    point_data(out, mesh)?;

    writeln!(out, "</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// What is known of cells beyond the files of TetGen, if it is.
fn face_table(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    let table = &mesh.face_table;
    if table.sides.is_empty() {
        return Ok(());
    }
    for (side, name) in ["behind", "front"].into_iter().enumerate() {
        let tets = mesh.region_numbers.iter().copied();
        let numbers = tets.chain(table.sides.iter().map(|sides| sides[side]));
        let attributes = format!(r#"type="Int64" Name="{name}""#);
        array(out, &attributes, numbers.map(|x| [x]))?;
    }
    let tets = mesh.tets.len();
    let polygons = std::iter::repeat_n(0, tets).chain(table.polygons.iter().copied());
    array(
        out,
        r#"type="Int64" Name="polygon""#,
        polygons.clone().map(|x| [x]),
    )?;
    let first = mesh.first_index.min(1) as usize;
    let facet = |polygon: u32| {
        let polygon = polygon.checked_sub(1)?;
        Some(table.facets[polygon as usize][0] + first)
    };
    let facets = polygons.map(|polygon| facet(polygon).unwrap_or(0));
    array(out, r#"type="Int64" Name="facet""#, facets.map(|x| [x]))
}

/// The attributes and markers of vertices, if there are any.
fn point_data(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    let columns = mesh.attributes.per_vertex;
    if columns == 0 && mesh.vertex_markers.is_empty() {
        return Ok(());
    }
    writeln!(out, "<PointData>")?;
    if columns > 0 {
        let name = format!(r#"type="Float64" Name="attributes" NumberOfComponents="{columns}""#);
        let values = mesh.attributes.values.iter();
        array(out, &name, values.map(|&x| [Shortest(x)]))?;
    }
    if !mesh.vertex_markers.is_empty() {
        let markers = mesh.vertex_markers.iter();
        array(out, r#"type="Int64" Name="marker""#, markers.map(|&m| [m]))?;
    }
    writeln!(out, "</PointData>")
}

/// Everything up to the cells.
pub(super) fn begin(out: &mut dyn Write, points: &[[f64; 3]], cells: usize) -> io::Result<()> {
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(
        out,
        r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">"#
    )?;
    writeln!(out, "<UnstructuredGrid>")?;
    writeln!(
        out,
        r#"<Piece NumberOfPoints="{}" NumberOfCells="{cells}">"#,
        points.len()
    )?;
    writeln!(out, "<Points>")?;
    array(
        out,
        r#"type="Float64" Name="Points" NumberOfComponents="3""#,
        points.iter().map(|p| p.map(Shortest)),
    )?;
    writeln!(out, "</Points>")
}

pub(super) fn array<T: Display, const N: usize>(
    out: &mut dyn Write,
    attributes: &str,
    values: impl Iterator<Item = [T; N]>,
) -> io::Result<()> {
    open(out, attributes)?;
    rows(out, values)?;
    close(out)
}

pub(super) fn open(out: &mut dyn Write, attributes: &str) -> io::Result<()> {
    writeln!(out, r#"<DataArray {attributes} format="ascii">"#)
}

pub(super) fn rows<T: Display, const N: usize>(
    out: &mut dyn Write,
    values: impl Iterator<Item = [T; N]>,
) -> io::Result<()> {
    for row in values {
        for (i, x) in row.iter().enumerate() {
            let space = if i == 0 { "" } else { " " };
            write!(out, "{space}{x}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

pub(super) fn close(out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "</DataArray>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::ExportedFace;

    #[test]
    fn two_tetrahedra_and_a_face() {
        let v = |i| VertexId(i);
        let mesh = ExportedMesh {
            first_index: 1,
            vertices: vec![
                [0.0, 0.0, 0.5],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1e300],
                [0.0, 0.0, -1.0],
            ],
            tets: vec![[v(0), v(1), v(2), v(3)], [v(0), v(2), v(1), v(4)]],
            regions: vec![7.0, 2.5],
            faces: vec![ExportedFace {
                vertices: [v(0), v(1), v(2)],
                marker: -4,
            }],
            edges: vec![],
            exact: vec![],
            ..ExportedMesh::default()
        };
        let mut bytes = Vec::new();
        write(&mut bytes, &mesh).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let values = |name: &str| -> Vec<&str> {
            let (_, rest) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
            let (_, rest) = rest.split_once(">\n").unwrap();
            rest.split_once('<').unwrap().0.split_whitespace().collect()
        };
        assert!(text.contains(r#"NumberOfPoints="5" NumberOfCells="3""#));
        assert_eq!(values("Points")[9..], ["0", "0", "1e300", "0", "0", "-1"]);
        assert_eq!(
            values("connectivity"),
            ["0", "1", "2", "3", "0", "2", "1", "4", "0", "1", "2"]
        );
        assert_eq!(values("offsets"), ["4", "8", "11"]);
        assert_eq!(values("types"), ["10", "10", "5"]);
        assert_eq!(values("region"), ["7", "2.5", "0"]);
        assert_eq!(values("marker"), ["0", "0", "-4"]);
        assert_eq!(values("kind"), ["3", "3", "2"]);
    }
}
