//! `tetflip delaunay`: the Delaunay tetrahedralization of the vertices of a file.

use super::{Stop, check_outputs, read, say};
use std::path::PathBuf;
use tetflip::delaunay::delaunay;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::format::write_mesh;
use tetflip::mesh::VertexId;
use tetflip::plc::Complex;
use tetflip::predicate::DoublePoints;

#[derive(clap::Args)]
pub(crate) struct DelaunayArguments {
    /// The points: any input format.
    input: PathBuf,
    /// Where to write the mesh.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// No summary.
    #[arg(short, long)]
    quiet: bool,
}

/// Makes the Delaunay tetrahedralization of the vertices and writes it.
pub(crate) fn delaunay_of_file(arguments: &DelaunayArguments) -> Result<(), Stop> {
    check_outputs(&arguments.input, arguments.output.as_deref(), None)?;
    let (plc, _) = read(&arguments.input)?;
    let vertices_only = Plc {
        first_index: plc.first_index,
        vertices: plc.vertices,
        ..Plc::default()
    };
    let complex = Complex::new(&vertices_only, true).map_err(Stop::input)?;
    let points = DoublePoints::new(vertices_only.vertices);
    let distinct: Vec<VertexId> = (0..complex.representative.len())
        .map(VertexId::new)
        .filter(|&v| complex.representative[v.index()] == v)
        .collect();
    let duplicates = complex.representative.len() - distinct.len();
    let mesh = delaunay(&points, &distinct).map_err(Stop::input)?.mesh;
    let (vertices, tetrahedra) = (distinct.len(), mesh.finite().count());
    if let Some(path) = &arguments.output {
        // Large inputs: what is not needed any more goes before the next array comes.
        drop((distinct, complex));
        let first_index = vertices_only.first_index;
        let mesh = ExportedMesh::of_hull(first_index, points.into_vec(), mesh);
        write_mesh(path, &mesh).map_err(Stop::input)?;
    }
    if !arguments.quiet {
        say(&format!(
            "{vertices} distinct vertices ({duplicates} duplicates merged), {tetrahedra} tetrahedra"
        ));
    }
    Ok(())
}
