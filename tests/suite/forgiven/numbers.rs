//! Numbers of vertices, what they and faces carry, and how corners follow one another.

use super::*;

#[test]
fn vertices_numbered_from_anywhere() {
    let from = |first: i64| {
        let node = (0..4).map(|i| format!("{} {} {} {}\n", first + i, i == 1, i == 2, i == 3));
        let node = node
            .collect::<String>()
            .replace("false", "0")
            .replace("true", "1");
        let corners = [0, 1, 2].map(|i| (first + i).to_string()).join(" ");
        poly(format!("4 3\n{node}1 1\n1 0 7\n3 {corners}\n").as_bytes()).expect("a good file")
    };
    let (expected, _) = poly(whole_poly().as_bytes()).expect("a good file");
    for first in [0, 1, 5, 1000, -7, 1 << 40] {
        let (plc, notes) = from(first);
        assert!(notes.is_empty(), "{notes:?}");
        assert_eq!(
            (&plc.vertices, &plc.facets),
            (&expected.vertices, &expected.facets)
        );
        let numbers: Vec<i64> = (first..first + 4).collect();
        match first {
            0..=1000 => assert_eq!((i64::from(plc.first_index), plc.numbers), (first, vec![])),
            _ => assert_eq!(plc.numbers, numbers),
        }
    }
}

#[test]
fn vertices_numbered_with_gaps() {
    let text = "4 3\n10 0 0 0\n20 1 0 0\n3 0 1 0\n4 0 0 1\n1 1\n1 0 7\n3 10 20 3\n";
    let (plc, notes) = poly(text.as_bytes()).expect("numbers");
    let (expected, _) = poly(whole_poly().as_bytes()).expect("a good file");
    assert_eq!(
        (&plc.vertices, &plc.facets),
        (&expected.vertices, &expected.facets)
    );
    assert_eq!(
        (plc.first_index, &plc.numbers[..]),
        (1, &[10, 20, 3, 4][..])
    );
    assert_eq!(
        (notes[0].code, &notes[0].lines[..]),
        (NoteCode::VertexNumbers, &[3, 4][..])
    );
    for bad in ["3 10 20 5", "3 10 20 0"] {
        let error = poly(text.replacen("3 10 20 3", bad, 1).as_bytes()).expect_err("no vertex");
        assert!(
            error.to_string().contains("numbered from 3 to 20"),
            "{error}"
        );
    }
    assert!(poly(text.replacen("4 0 0 1", "20 0 0 1", 1).as_bytes()).is_err());
}

#[test]
fn attributes_and_markers_of_vertices() {
    let node = "3 3 2 1\n1 0 0 0 1.5 -2 7\n2 1 0 0 3 4 -9999999999\n3 0 1 0 5 6 0\n";
    let (plc, notes) = read_node(node.as_bytes()).expect("a good file");
    assert!(notes.is_empty());
    assert_eq!(plc.attributes.per_vertex, 2);
    assert_eq!(plc.attributes.values, [1.5, -2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(plc.vertex_markers, [7, -9999999999, 0]);
    let beside = || Ok(node.as_bytes().to_vec());
    let (both, _) = read_poly(b"0 3\n1 0\n1\n3 1 2 3\n", beside).expect("a good file");
    assert_eq!(
        (both.attributes, both.vertex_markers),
        (plc.attributes, plc.vertex_markers)
    );

    let zero = node.replacen("5 6 0", "5 0 0", 1);
    replaced(read_node, &zero, "5 0 0", "5", NoteCode::MissingColumns, 4);
    replaced(
        read_node,
        node,
        "5 6 0",
        "5 6 0 8 9",
        NoteCode::ExtraColumns,
        4,
    );
    let (plc, _) = read_node(node.replacen("1.5 -2 7", "1.5 -2 7.0", 1).as_bytes()).expect("7.0");
    assert_eq!(plc.vertex_markers[0], 7);
    assert!(read_node(node.replacen("1.5 -2 7", "1.5 -2 7.5", 1).as_bytes()).is_err());
    assert!(read_node(node.replacen("1.5", "nan", 1).as_bytes()).is_err());
    assert!(read_node(b"1 3 4000000000 1\n1 0 0 0\n").is_err());
}

#[test]
fn notes_of_the_node_file_say_so() {
    let node = || Ok(b"3 3\n1 0 0 0\n2 1.0d0 0 0\n3 0 1 0\n".to_vec());
    let (_, notes) = read_poly(b"0 3\n1 0\n1\n3 1 2 3\n", node).expect("a good file");
    assert!(
        notes[0]
            .text
            .starts_with("in the .node file of the vertices: "),
        "{}",
        notes[0]
    );
    assert_eq!(notes[0].lines, [3]);
}

#[test]
fn what_follows_the_last_region() {
    let good = whole_poly();
    let code = NoteCode::TrailingData;
    forgiven(poly, &format!("{good}# part 5\n0 1\n"), &good, code, 12);
    forgiven(poly, &format!("{good}2\n1 0 5\n2 0 7\n"), &good, code, 11);
    // A marker may be written as a real number.
    let real = good.replacen("1 0 7\n", "1 0 7.0\n", 1);
    assert_eq!(
        poly(real.as_bytes()).expect("a marker"),
        poly(good.as_bytes()).expect("a good file")
    );
    assert!(poly(good.replacen("1 0 7\n", "1 0 7.5\n", 1).as_bytes()).is_err());
    // One more region, perhaps: then the number of them is wrong.
    assert!(poly(format!("{good}1 .5 .5 .5 3 -1\n").as_bytes()).is_err());
    let unmarked = good.replacen("1 1\n1 0 7", "1 0\n1 0 0", 1);
    replaced(
        poly,
        &unmarked,
        "1 0\n1 0 0\n",
        "1 0\n1 0 7\n",
        NoteCode::ExtraColumns,
        7,
    );
}

#[test]
fn rings_that_are_closed_by_hand() {
    let code = NoteCode::ClosedRing;
    let poly_text = whole_poly();
    replaced(poly, &poly_text, "3 1 2 3", "4 1 2 3 1", code, 8);
    replaced(read_off, OFF, "3 2 1 3", "4 2 1 3 2", code, 8);
    replaced(read_ply, PLY, "3 2 1 3", "4 2 1 3 2", code, 15);
    replaced(read_obj, OBJ, "f 3 2 4", "f 3 2 4 3", code, 6);
    replaced(
        read_medit,
        &MEDIT.replacen("End", "Quadrilaterals 0 End", 1),
        "Triangles\n2\n1 2 3 7\n3 2 4 7",
        "Quadrilaterals 1 1 2 3 1 7 Triangles 1\n3 2 4 7",
        code,
        9,
    );
    // By its coordinates.
    let again = OFF
        .replacen("4 2 0", "5 2 0", 1)
        .replacen("3 0 1 2", "0 0 0\n3 0 1 2", 1);
    replaced(read_off, &again, "3 0 1 2", "4 0 1 2 4", code, 8);
    // What is degenerate otherwise is not for the reader.
    let (plc, notes) = read_off(OFF.replacen("3 0 1 2", "3 0 1 0", 1).as_bytes()).expect("a face");
    assert!(notes.is_empty() && plc.facets[0].polygons[0].len() == 3);
}

#[test]
fn strips_of_triangles() {
    let text = PLY
        .replacen("element face 2", "element tristrips 1", 1)
        .replacen("3 0 1 2\n3 2 1 3\n", "12 0 1 2 3 3 0 -1 0 1 3 3 3\n", 1);
    let (plc, notes) = read_ply(text.as_bytes()).expect("strips");
    let triangles: Vec<[u32; 3]> = plc
        .facets
        .iter()
        .map(|f| [0, 1, 2].map(|i| f.polygons[0][i].0))
        .collect();
    assert_eq!(triangles, [[0, 1, 2], [2, 1, 3], [0, 1, 3]]);
    assert!(notes.is_empty());
    assert!(read_ply(text.replacen("12 0", "12 4", 1).as_bytes()).is_err());
    assert!(read_ply(text.replacen("-1", "-2", 1).as_bytes()).is_err());
}

#[test]
fn labels_and_colours_of_ply() {
    let with = |properties: &str, first: &str, second: &str| {
        let text = PLY
            .replacen(
                "vertex_indices\n",
                &format!("vertex_indices\n{properties}"),
                1,
            )
            .replacen("3 0 1 2", &format!("3 0 1 2 {first}"), 1)
            .replacen("3 2 1 3", &format!("3 2 1 3 {second}"), 1);
        let (plc, notes) = read_ply(text.as_bytes()).expect("a good file");
        assert!(notes.is_empty());
        (
            plc.facets.iter().map(|f| f.marker).collect::<Vec<_>>(),
            plc.marker_names,
        )
    };
    assert_eq!(
        with("property int64 label\n", "-8", "9999999999"),
        (vec![-8, 9999999999], vec![])
    );
    let colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let names = vec![(1, "255 0 9".to_owned()), (2, "0 0 0".to_owned())];
    assert_eq!(with(colours, "255 0 9", "0 0 0"), (vec![1, 2], names));
    assert_eq!(with(colours, "1 2 3", "1 2 3"), (vec![0, 0], vec![]));
    let both = format!("{colours}property uchar label\nproperty double quality\n");
    assert_eq!(
        with(&both, "1 2 3 6 .5", "0 0 0 7 nan"),
        (vec![6, 7], vec![])
    );
}

#[test]
fn groups_of_obj() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\no box\ng side \\\n wall\nf 3 2 4\nusemtl red\nf 1 2 4\n\
        l 1 4\n\
        g side wall\nusemtl\nf 1 3 4\n";
    let (plc, notes) = read_obj(text.as_bytes()).expect("groups");
    assert!(notes.is_empty());
    let markers: Vec<i64> = plc.facets.iter().map(|f| f.marker).collect();
    assert_eq!(
        (&markers[..], plc.segments[0].marker),
        (&[0, 1, 2, 1][..], 2)
    );
    let names = [
        (1, "box/side wall".to_owned()),
        (2, "box/side wall/red".to_owned()),
    ];
    assert_eq!(plc.marker_names, names);
}

/// Each solid has its marker and its name, whether or not its end is there.
#[test]
fn solids_of_stl() {
    let two = format!(
        "solid first one\n{FACET}endsolid\nsolid empty\nendsolid\nSOLID b\n{FACET}{FACET}endsolid b\n"
    );
    for text in [two.clone(), two.replacen("endsolid\n", "", 1)] {
        let (plc, _) = read_stl(text.as_bytes()).expect("solids");
        let markers: Vec<i64> = plc.facets.iter().map(|f| f.marker).collect();
        assert_eq!(markers, [1, 2, 2]);
        let names = [(1, "first one".to_owned()), (2, "b".to_owned())];
        assert_eq!(plc.marker_names, names);
    }
    let (plc, _) = read_stl(stl().as_bytes()).expect("one solid");
    assert!(plc.marker_names.is_empty() && plc.facets.iter().all(|f| f.marker == 0));
}

#[test]
fn references_of_medit_are_markers_of_vertices() {
    let (plc, _) =
        read_medit(MEDIT.replacen("0 0 1 0", "0 0 1 99999999999", 1).as_bytes()).expect("64 bits");
    assert_eq!(plc.vertex_markers, [0, 0, 0, 99999999999]);
    assert!(
        read_medit(MEDIT.as_bytes())
            .expect("a good file")
            .0
            .vertex_markers
            .is_empty()
    );
}
