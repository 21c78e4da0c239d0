//! `tetflip delaunay`: the Delaunay tetrahedralization of the vertices of a file.

use super::input::Input;
use super::output::Output;
use super::{Stop, check_outputs};
use std::path::PathBuf;
use tetflip::delaunay::delaunay;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::mesh::VertexId;
use tetflip::plc::Complex;
use tetflip::predicate::DoublePoints;

#[derive(clap::Args)]
pub(crate) struct DelaunayArguments {
    /// The points: any input format; `-` reads stdin.
    input: PathBuf,
    /// Where to write the mesh; `-` is stdout.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// The format of the input, whatever its name, or of the output `-`: vtu. It may be given for each.
    #[arg(long, value_name = "FORMAT")]
    format: Vec<String>,
    /// No summary.
    #[arg(short, long)]
    quiet: bool,
}

/// Makes the Delaunay tetrahedralization of the vertices and writes it.
pub(crate) fn delaunay_of_file(arguments: &DelaunayArguments) -> Result<(), Stop> {
    let (input, formats) = Input::new(&arguments.input, &arguments.format)?;
    let output = Output::new(arguments.output.as_deref(), &formats, &input)?;
    check_outputs(&input, output.path(), None)?;
    let (plc, _) = input.read()?;
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
    if arguments.output.is_some() {
        // Large inputs: what is not needed any more goes before the next array comes.
        drop((distinct, complex));
        let first_index = vertices_only.first_index;
        let mesh = ExportedMesh::of_hull(first_index, points.into_vec(), mesh);
        output.save(&mesh)?;
    }
    if !arguments.quiet {
        output.say(&format!(
            "{vertices} distinct vertices ({duplicates} duplicates merged), {tetrahedra} tetrahedra"
        ));
    }
    Ok(())
}
