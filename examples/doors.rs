//! Deletes the wall between the rooms of `examples/rooms.poly`, and puts it back.

use std::error::Error;
use tetflip::cdt::Cdt;
use tetflip::cdt::Insertion;
use tetflip::cdt::flips::FlipOrder;
use tetflip::format::read_plc;
use tetflip::report::Report;

/// The wall's place among the facets of the file.
const WALL: usize = 10;

fn main() -> Result<(), Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/rooms.poly");
    let (mut plc, _) = read_plc(path.as_ref())?;
    // Without the wall the two region points would be in one region.
    plc.regions.clear();
    let insertion = Insertion::Flip(FlipOrder::FILTERED);
    let mut report = Report::default();
    let mut cdt = Cdt::with_segments(&plc, true, &mut report)?;
    cdt.insert_polygons(insertion, &mut report, &mut |_polygons_done| {})?;
    let closed = cdt.export(&plc, false, &mut report)?;

    let wall = cdt.polygon_of_facet(WALL).expect("the wall has an area");
    let counts = cdt.delete_polygon(wall)?;
    let open = cdt.export(&plc, false, &mut report)?;
    println!(
        "deleted by {} flips: {} tetrahedra, {} faces on facets; before: {}, {}",
        counts.flips.flips(),
        open.tets.len(),
        open.faces.len(),
        closed.tets.len(),
        closed.faces.len(),
    );

    cdt.insert_polygon(wall, insertion, &mut report)?;
    assert_eq!(cdt.export(&plc, false, &mut report)?, closed);
    Ok(())
}
