//! What must hold whatever a reader is given.

use tetflip::format::FormatError;
use tetflip::exchange::{Note, Plc};

/// What is accepted is finite, in range, and no larger than the file; what is refused can be said.
pub fn check(bytes: &[u8], result: Result<(Plc, Vec<Note>), FormatError>) {
    let (plc, notes) = match result {
        Ok(read) => read,
        Err(error) => {
            assert!(error.to_string().len() < 1000);
            return;
        }
    };
    assert!(!plc.vertices.is_empty());
    assert!(notes.iter().all(|note| note.count > 0 && note.text.len() < 2000));
    // A corner of a strip of triangles can be a byte, and make a facet.
    assert!(plc.vertices.len() + plc.facets.len() + plc.segments.len() <= 2 * bytes.len());
    assert!(plc.vertices.iter().flatten().all(|x| x.is_finite()));
    let polygons = plc.facets.iter().flat_map(|f| &f.polygons);
    let ends = plc.segments.iter().flat_map(|s| s.ends);
    for v in polygons.flatten().copied().chain(ends) {
        assert!(v.index() < plc.vertices.len());
    }
}
