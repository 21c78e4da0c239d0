//! TetGen's mesh files, written: `.node`, `.ele`, `.face`, `.edge`; and what stands beside them.
//!
//! The formats of the four, and of `.steiner`, are described where they are read, [`super::tetgen_mesh`]. Our own,
//! written only:
//!
//! - `.facets` says what the faces of `.face` lie on and between. Its first part has a line for each face, after
//!   their number: the face, the region behind it, the region in front of it, its polygon. A face is counterclockwise
//!   for one who looks from the front. Regions are the parts of the domain that facets divide, numbered from 1 on in
//!   the order of their first tetrahedra in `.ele`; 0 is what is not in the mesh. The second part has a line for each
//!   polygon, after their number: the polygon, and the facets of the input that it consists of, one, or several that
//!   are coplanar. 0 is no polygon: a face of the convex hull that is on no facet. Facets are counted from 1, or from
//!   0 if the input counts its vertices from 0.
//! - `.map` has a line for each vertex of the input that is in the mesh, after their number: its number in the input
//!   and its number in the mesh. It is written only where these differ.

use super::lines::{Lines, write_lines};
use super::mesh_file::Shortest;
use crate::exchange::{ExactPosition, ExportedMesh};
use crate::mesh::VertexId;
use std::io::{self, Write};

/// Writes the vertices of a checked mesh.
pub(super) fn write_node(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    let attributes = &mesh.attributes;
    let marked = !mesh.vertex_markers.is_empty();
    let (count, columns) = (mesh.vertices.len(), attributes.per_vertex);
    writeln!(out, "{count} 3 {columns} {}", u8::from(marked))?;
    let first = u64::from(mesh.first_index);
    write_lines(out, &mesh.vertices, |line, i, p| {
        line.number(first + i as u64);
        p.iter().for_each(|&x| line.next_double(x));
        if columns > 0 {
            let row = attributes.of(VertexId::new(i));
            row.iter().for_each(|&x| line.next_double(x));
        }
        if let Some(&marker) = mesh.vertex_markers.get(i) {
            line.next_marker(marker);
        }
        line.end();
    })
}

/// Writes the tetrahedra of a checked mesh.
pub(super) fn write_ele(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    let attributes = usize::from(!mesh.regions.is_empty());
    writeln!(out, "{} 4 {attributes}", mesh.tets.len())?;
    write_lines(out, &mesh.tets, |line, i, tet| {
        write_element(line, mesh, i, tet);
        if let Some(&region) = mesh.regions.get(i) {
            line.next_double(region);
        }
        line.end();
    })
}

/// Writes the faces of a checked mesh.
pub(super) fn write_face(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    writeln!(out, "{} 1", mesh.faces.len())?;
    write_lines(out, &mesh.faces, |line, i, face| {
        write_element(line, mesh, i, &face.vertices);
        line.next_marker(face.marker);
        line.end();
    })
}

/// Writes the edges of a checked mesh.
pub(super) fn write_edge(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    writeln!(out, "{} 1", mesh.edges.len())?;
    write_lines(out, &mesh.edges, |line, i, edge| {
        write_element(line, mesh, i, &edge.vertices);
        line.next_marker(edge.marker);
        line.end();
    })
}

/// The number of an element and its vertices.
fn write_element(line: &mut Lines, mesh: &ExportedMesh, i: usize, vertices: &[VertexId]) {
    let first = u64::from(mesh.first_index);
    line.number(first + i as u64);
    for v in vertices {
        line.next(first + u64::from(v.0));
    }
}

/// Writes the exact positions of a checked mesh.
pub(super) fn write_steiner(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    writeln!(out, "{}", mesh.exact.len())?;
    let name = |v: VertexId| u64::from(mesh.first_index) + u64::from(v.0);
    for ExactPosition { vertex, ends, t } in &mesh.exact {
        let [a, b] = ends.map(name);
        write!(out, "{} {a} {b} {}", name(*vertex), Shortest(t.value))?;
        if t.rest != 0.0 {
            write!(out, " {}", Shortest(t.rest))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Writes what the faces of a checked mesh lie on and between.
pub(super) fn write_facets(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    let table = &mesh.face_table;
    let first = u64::from(mesh.first_index);
    writeln!(out, "# face, region behind, region in front, polygon")?;
    writeln!(out, "{}", table.sides.len())?;
    let rows: Vec<([u32; 2], u32)> = table
        .sides
        .iter()
        .copied()
        .zip(table.polygons.iter().copied())
        .collect();
    write_lines(out, &rows, |line, i, &([behind, front], polygon)| {
        line.number(first + i as u64);
        line.next(behind.into());
        line.next(front.into());
        line.next(polygon.into());
        line.end();
    })?;
    writeln!(out, "# polygon, facets")?;
    writeln!(out, "{}", table.facets.len())?;
    write_lines(out, &table.facets, |line, i, facets| {
        line.number(1 + i as u64);
        for &facet in facets {
            line.next(facet as u64 + first.min(1));
        }
        line.end();
    })?;
    if table.markers.is_empty() {
        return Ok(());
    }
    writeln!(out, "# polygon, markers of its facets where these differ")?;
    writeln!(out, "{}", table.markers.len())?;
    write_lines(out, &table.markers, |line, _, (polygon, markers)| {
        line.number(u64::from(*polygon));
        for &marker in markers {
            line.next_marker(marker);
        }
        line.end();
    })
}

/// Writes the old and new numbers of vertices.
pub(super) fn write_map(out: &mut dyn Write, mesh: &ExportedMesh) -> io::Result<()> {
    writeln!(out, "# number in the input, number in the mesh")?;
    writeln!(out, "{}", mesh.renumbered.len())?;
    write_lines(out, &mesh.renumbered, |line, _, &(old, new)| {
        line.marker(old);
        line.next(u64::from(mesh.first_index) + u64::from(new.0));
        line.end();
    })
}
