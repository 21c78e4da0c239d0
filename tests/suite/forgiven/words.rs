//! Words: numbers, commas, comments, and line breaks.

use super::*;

#[test]
fn exponents_of_fortran() {
    let code = NoteCode::FortranExponent;
    replaced(poly, &whole_poly(), "2 1 0 0", "2 1.0D+00 0d0 0", code, 3);
    replaced(read_off, OFF, "0 1 0\n", "0 .1d1 0\n", code, 5);
    replaced(
        read_stl,
        &stl(),
        "vertex 1 0 0",
        "vertex +1.D0 0 0",
        code,
        5,
    );
    replaced(read_ply, PLY, "1 0 0\n", "10d-1 0 0\n", code, 11);
    replaced(read_obj, OBJ, "v 0 1 0", "v 0 1.D0 0", code, 3);
    replaced(read_medit, MEDIT, "0 1 0 0", "0 1.D0 0 0", code, 7);
    // Two numbers, or an exponent without its letter?
    assert!(read_off(OFF.replacen("1 0 0", "1.0-100 0 0", 1).as_bytes()).is_err());
}

#[test]
fn commas_as_separators() {
    let code = NoteCode::CommaSeparator;
    replaced(poly, &whole_poly(), "2 1 0 0", "2, 1, 0, 0", code, 3);
    replaced(poly, &whole_poly(), "2 1 0 0", "2,1,0,0", code, 3);
    replaced(poly, &whole_poly(), "2 1 0 0", "2 ,1 , 0\t,0", code, 3);
    replaced(poly, &whole_poly(), "1 1\n", "1,1\n", code, 6);
    replaced(read_off, OFF, "0 1 0\n", "0,1,0\n", code, 5);
    replaced(read_off, OFF, "4 2 0\n", "4, 2, 0,\n", code, 2);
    replaced(read_stl, &stl(), "vertex 1 0 0", "vertex 1, 0, 0", code, 5);
    replaced(read_ply, PLY, "1 0 0\n", "1, 0, 0\n", code, 11);
    replaced(read_obj, OBJ, "f 1 2 3", "f 1, 2, 3", code, 5);
    replaced(read_medit, MEDIT, "1 2 3 7", "1, 2, 3, 7", code, 11);
    let all: String = whole_poly()
        .lines()
        .map(|line| line.replace(' ', ", ") + "\n")
        .collect();
    let (_, notes) = poly(all.as_bytes()).expect("commas everywhere");
    assert_eq!((notes.len(), notes[0].count), (1, 8));
}

/// A comma within a word is more likely a decimal one, and two commas have something missing between them.
#[test]
fn ambiguous_commas_are_errors() {
    for row in [
        "0 1,5 0",
        "0,5 1,5 0,5",
        "0,5, 1,5, 0,5",
        "0,5,1,5,0,5",
        "1,000,000",
        "0,,1 0",
        ",0,1,0",
        "0;1;0",
    ] {
        let text = OFF.replacen("0 1 0\n", &format!("{row}\n"), 1);
        assert!(read_off(text.as_bytes()).is_err(), "{row}");
        let text = whole_poly().replacen("3 0 1 0\n", &format!("3 {row}\n"), 1);
        assert!(poly(text.as_bytes()).is_err(), "{row}");
    }
    for row in ["2,1,5,0,5,0,5", "2,1,0", "2,100,000"] {
        let text = whole_poly().replacen("2 1 0 0", row, 1);
        assert!(poly(text.as_bytes()).is_err(), "{row}");
    }
}

#[test]
fn comments_of_other_formats() {
    let code = NoteCode::ForeignComment;
    for comment in ["// a comment", "! a comment, too"] {
        replaced(
            poly,
            &whole_poly(),
            "2 1 0 0",
            &format!("2 1 0 0 {comment}"),
            code,
            3,
        );
        replaced(
            read_off,
            OFF,
            "0 1 0\n",
            &format!("{comment}\n0 1 0\n"),
            code,
            5,
        );
        replaced(
            read_stl,
            &stl(),
            "facet",
            &format!("{comment}\nfacet"),
            code,
            2,
        );
        replaced(
            read_ply,
            PLY,
            "0 1 0\n",
            &format!("{comment}\n0 1 0\n"),
            code,
            12,
        );
        replaced(read_obj, OBJ, "f 1", &format!("{comment}\nf 1"), code, 5);
        replaced(
            read_medit,
            MEDIT,
            "Triangles",
            &format!("{comment}\nTriangles"),
            code,
            9,
        );
    }
    replaced(read_stl, &stl(), "facet", "# a comment\nfacet", code, 2);
    replaced(read_ply, PLY, "0 1 0\n", "0 1 0 # a comment\n", code, 12);
    // What the format itself has needs no note.
    for (text, comment) in [(OFF, "# c\n"), (OBJ, "#\n"), (MEDIT, " # c\n")] {
        assert!(text.contains('\n') && comment.ends_with('\n'));
    }
    let (_, notes) = read_off(OFF.replace('\n', " # c\r\n").as_bytes()).expect("comments");
    assert!(notes.is_empty());
}

/// Comments as the paper on PLY has them.
#[test]
fn braces_in_ply() {
    let (expected, _) = read_ply(PLY.as_bytes()).expect("a good file");
    let text = PLY
        .replacen(
            "element vertex 4",
            "element vertex 4 { define \"vertex\" element }",
            1,
        )
        .replacen("vertex_indices", "vertex_indices { a list }", 1)
        .replacen(
            "0 0 0\n",
            "0 0 0 { start of vertex list }\n{ on a line }\n",
            1,
        )
        .replacen("3 2 1 3", "{ last } 3 2 1 3", 1);
    let (plc, notes) = read_ply(text.as_bytes()).expect("braces");
    assert_eq!((plc, notes), (expected, vec![]));
    assert!(read_ply(text.replacen("{ last }", "{ last", 1).as_bytes()).is_err());
}

#[test]
fn byte_order_marks_and_padding() {
    let texts: [(Reader, String); 8] = [
        (poly, whole_poly()),
        (read_node, NODE.to_owned()),
        (smesh, format!("{NODE}1 1\n3 1 2 3 7\n0\n0\n")),
        (read_off, OFF.to_owned()),
        (read_stl, stl()),
        (read_ply, PLY.to_owned()),
        (read_obj, OBJ.to_owned()),
        (read_medit, MEDIT.to_owned()),
    ];
    for (read, text) in texts {
        let (expected, none) = read(text.as_bytes()).expect("a good file");
        assert!(none.is_empty());
        for marked in [
            format!("\u{feff}{text}"),
            text.replace('\n', "\r"),
            text.replace('\n', "\r\n").replace(' ', "\t  "),
            text.trim_end().to_owned(),
            format!("\n\n {text}\n \n"),
        ] {
            assert_eq!(
                read(marked.as_bytes()).expect("the same"),
                (expected.clone(), vec![])
            );
        }
        let lines = text.lines().count();
        for end in ["\0", "\0\0\0", "\u{1a}", "\0\u{1a}\0"] {
            forgiven(
                read,
                &format!("{text}{end}"),
                &text,
                NoteCode::TrailingData,
                lines,
            );
        }
    }
}

#[test]
fn words_on_any_lines() {
    let code = NoteCode::LineBreaks;
    let one_line = OFF.replace('\n', " ");
    forgiven(read_off, &one_line, OFF, code, 1);
    replaced(read_off, OFF, "0 0 0\n1 0 0\n", "0 0 0 1 0\n0 ", code, 2);
    replaced(read_off, OFF, "4 2 0\n", "4\n2\n0\n", code, 3);
    let (head, body) = PLY.split_once("end_header\n").expect("a header");
    let body = body.replace('\n', " ");
    forgiven(
        read_ply,
        &format!("{head}end_header\n{body}"),
        PLY,
        code,
        10,
    );
    forgiven(
        read_ply,
        &format!("{} end_header {body}", head.replace('\n', " ")),
        PLY,
        code,
        1,
    );
    // Medit has no lines.
    let (plc, notes) = read_medit(MEDIT.replace('\n', " ").as_bytes()).expect("one line");
    assert_eq!(
        (plc, notes),
        read_medit(MEDIT.as_bytes()).expect("a good file")
    );
    // Every word must be used.
    assert!(read_off(format!("{one_line} 1").as_bytes()).is_err());
    assert!(read_ply(format!("{head}end_header\n{body} 1").as_bytes()).is_err());
}
