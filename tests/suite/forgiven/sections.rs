//! Keywords, sections, prefixes, and what follows the end.

use super::*;

#[test]
fn keywords_of_stl() {
    let code = NoteCode::Keywords;
    let good = stl();
    replaced(read_stl, &good, "endsolid a", "end solid a", code, 16);
    replaced(read_stl, &good, "endloop", "End Loop", code, 7);
    replaced(read_stl, &good, "endfacet", "end facet", code, 8);
    replaced(read_stl, &good, "endfacet\n", "", code, 8);
    replaced(read_stl, &good, "endloop\n", "", code, 7);
    replaced(read_stl, &good, "endloop\nendfacet\n", "", code, 7);
    replaced(read_stl, &good, "endsolid a\n", "", code, 15);
    replaced(read_stl, &good, "solid a\n", "", code, 1);
    let bare = good
        .replace("endloop\n", "")
        .replace("endfacet\n", "")
        .replace("endsolid a\n", "");
    let (plc, notes) = read_stl(bare.as_bytes()).expect("no end at all");
    assert_eq!(plc, read_stl(good.as_bytes()).expect("a good file").0);
    assert_eq!((notes.len(), notes[0].code), (1, code));
    // A corner too many, or too few.
    let more = good.replacen("endloop", "vertex 9 9 9\nendloop", 1);
    assert!(read_stl(more.as_bytes()).is_err());
    let fewer = bare.replacen("vertex 0 1 0\n", "", 1);
    assert!(read_stl(fewer.as_bytes()).is_err());
}

#[test]
fn stl_on_one_line() {
    let text = stl().replace('\n', " ");
    let (plc, notes) = read_stl(text.as_bytes()).expect("one line");
    assert_eq!(
        (plc, notes),
        read_stl(stl().as_bytes()).expect("a good file")
    );
    let two = format!("{text}{text}");
    assert_eq!(
        read_stl(two.as_bytes())
            .expect("two solids")
            .0
            .marker_names
            .len(),
        2
    );
}

fn binary_stl(end: &[u8]) -> Reading {
    let mut bytes = vec![b' '; 80];
    bytes.extend(1u32.to_le_bytes());
    bytes.extend([0; 12]);
    let corners = [[0.0f32, 0.5, 0.25], [1.0, 0.5, 0.25], [0.0, 1.5, 0.25]];
    bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend([0; 2]);
    bytes.extend(end);
    read_stl(&bytes)
}

/// Bytes that cannot be a triangle are ignored; others mean that the number of triangles is wrong.
#[test]
fn bytes_after_the_last_triangle() {
    let (expected, none) = binary_stl(&[]).expect("a good file");
    assert!(none.is_empty());
    let text = [b'x'; 30].repeat(3);
    for end in [
        &[1u8][..],
        &[1, 2, 3, 4, 5, 6, 7, 8, 9, 0],
        &[0; 500],
        &text,
    ] {
        let (plc, notes) = binary_stl(end).expect("bytes that say nothing");
        assert_eq!(plc, expected);
        assert_eq!((notes.len(), notes[0].code), (1, NoteCode::TrailingData));
        assert!(
            notes[0].text.contains(&format!("{} byte", end.len())),
            "{}",
            notes[0]
        );
        assert!(notes[0].text.contains("from byte 134 on"), "{}", notes[0]);
    }
    let triangle: Vec<u8> = (0..50).collect();
    assert!(binary_stl(&triangle).is_err());
}

#[test]
fn sections_of_medit() {
    let unknown = "Identifier\n\"G=dom;1, Date: 21/04 End\"\nVertexOnGeometricVertex 1\n1 1\n";
    let (expected, _) = read_medit(MEDIT.as_bytes()).expect("a good file");
    let text = MEDIT.replacen("Triangles", &format!("{unknown}Triangles"), 1);
    let (plc, notes) = read_medit(text.as_bytes()).expect("sections of bamg");
    assert_eq!(plc, expected);
    let [note] = &notes[..] else {
        panic!("{notes:?}");
    };
    assert_eq!(
        (note.code, &note.lines[..]),
        (NoteCode::UnknownSection, &[9, 11][..])
    );
    assert!(
        note.text.contains("Identifier, VertexOnGeometricVertex"),
        "{note}"
    );

    replaced(read_medit, MEDIT, "End\n", "", NoteCode::Keywords, 12);
    replaced(
        read_medit,
        MEDIT,
        "End\n",
        "End\nand more\n",
        NoteCode::TrailingData,
        14,
    );
    for version in ["0", "7"] {
        let head = format!("Formatted {version}");
        replaced(
            read_medit,
            MEDIT,
            "Formatted 2",
            &head,
            NoteCode::FormatVersion,
            1,
        );
    }
    let tets = "Tetrahedra 1\n1 2 3 4 0\nEnd";
    replaced(read_medit, MEDIT, "End", tets, NoteCode::VolumeElements, 13);
    let extra = "Corners 2\n1 2\nRequiredVertices 1 1\nRidges 1\n1\nEdges 1\n1 2 5\nEnd";
    let (plc, notes) = read_medit(MEDIT.replacen("End", extra, 1).as_bytes()).expect("corners");
    assert!(notes.is_empty() && plc.segments[0].marker == 5);
    // What is skipped may hold the surface; and a number where a keyword should be means that a count is wrong.
    assert!(read_medit(MEDIT.replacen("Triangles", "TrianglesP2", 1).as_bytes()).is_err());
    assert!(read_medit(MEDIT.replacen("Triangles\n2", "Triangles\n1", 1).as_bytes()).is_err());
    assert!(read_medit(MEDIT.replacen("Triangles\n2", "Triangles\n3", 1).as_bytes()).is_err());
}

#[test]
fn off_with_prefixes_in_any_order() {
    for (head, extra) in [("NCOFF", 7), ("CNOFF", 7), ("CSTOFF", 6)] {
        let rows = OFF.replacen("OFF", head, 1);
        assert!(read_off(rows.as_bytes()).is_ok(), "{head}");
        let numbers = " 0.5".repeat(extra);
        let words = rows
            .replacen(
                "0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                &["0 0 0", "1 0 0", "0 1 0", "0 0 1", ""].join(&format!("{numbers}\n")),
                1,
            )
            .replace('\n', " ");
        assert_eq!(
            read_off(words.as_bytes()).expect(head).0,
            read_off(OFF.as_bytes()).expect("a good file").0
        );
    }
    assert!(read_off(OFF.replacen("OFF", "4OFF", 1).as_bytes()).is_err());
}
