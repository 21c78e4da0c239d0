//! Pieces of files are read as whole files are, with the same notes and errors: here by one, two and five threads, with
//! pieces of any size.

use super::super::tetgen_mesh::read_table;
use super::super::*;
use crate::exchange::{Note, Plc};
use proptest::prelude::*;
use std::cell::Cell;
use std::sync::LazyLock;

thread_local! {
    static SIZE: Cell<usize> = const { Cell::new(1 << 17) };
}

pub(super) fn piece_size() -> usize {
    SIZE.get()
}

/// A window of lines of the facets in which the beginning of one is looked for: mostly it ends within one.
pub(in super::super) fn window() -> usize {
    7 + SIZE.get() % 97
}

/// What is read, or the error, as texts.
type Read = Box<dyn Fn(&[u8]) -> Result<String, String> + Send + Sync>;

type Reading = Result<(Plc, Vec<Note>), FormatError>;

fn plc(read: fn(&[u8]) -> Reading) -> Read {
    Box::new(move |bytes| {
        let (plc, notes) = read(bytes).map_err(|error| error.to_string())?;
        Ok(format!("{plc:?} {notes:?}"))
    })
}

fn table(extension: &'static str) -> Read {
    Box::new(|bytes| read_table(extension, bytes))
}

/// A file of each format, of about 60 rows, some of which are longer than a line.
fn files() -> Vec<(Read, String)> {
    const N: usize = 60;
    let point = |i: usize| format!("{} {}.5 {}e-1", i % 7, i % 5, i * i % 11);
    let rows = |row: &dyn Fn(usize) -> String| (0..N).map(row).collect::<String>();
    let numbered = rows(&|i| format!("{} {} 7 # a\n", i + 1, point(i)));
    let corners = |i: usize| [i, (i + 1) % N, (7 * i + 2) % N];
    let [a, b, c] = [0, 1, 2].map(|k| move |i: usize| corners(i)[k] + 1);
    let poly = rows(&|i| match i % 9 {
        0 => format!(
            "2 1 {i}\n3 {} {}\n\n {}\n2 1 2\n1 0 0 {i}\n",
            a(i),
            b(i),
            c(i)
        ),
        1 => format!("1 0 4\n2 {} {}\n", a(i), b(i)),
        _ => format!("1 0 {i}\n3 {} {} {}\n", a(i), b(i), c(i)),
    });
    let smesh = rows(&|i| format!("3 {} {} {} {i}\r\n", a(i), b(i), c(i)));
    let off = rows(&|i| {
        let [a, b, c] = corners(i);
        format!("3 {a} {b}{}{c} 0 9\n", [" ", "\n"][usize::from(i % 8 == 0)])
    });
    let obj = rows(&|i| {
        let next = if i % 10 == 3 { "\\\n" } else { "" };
        let index = if i % 12 == 5 { -1 } else { c(i) as i64 };
        format!("v {}\nf {}//1 {next} {} {index}\n", point(i), a(i), b(i))
    });
    let stl = rows(&|i| {
        let corners = [i, i + 1, i + 2].map(|k| format!("vertex {}\n", point(k)));
        let solid = if i % 20 == 19 {
            "endsolid a\nsolid b\n"
        } else {
            ""
        };
        format!(
            "{solid}facet normal 0 0 1\n outer loop\n{}endloop\nendfacet\n",
            corners.concat()
        )
    });
    let ply = "ply\nformat ascii 1.0\nelement vertex 60\nproperty float x\nproperty float y\nproperty float z\n\
        element face 60\nproperty list uchar int vertex_index\nelement edge 60\nproperty int vertex1\n\
        property int vertex2\nend_header\n";
    let attributed = rows(&|i| match i % 10 {
        7 => format!("{} {} 1.5 // c\n", i + 1, point(i)),
        8 => format!("{} {} 1.5 -2 {i} 9\n", i + 1, point(i)),
        _ => format!("{} {} 1.5 -2 {i}\n", i + 1, point(i)),
    });
    let rings = rows(&|i| {
        let [a, b, c] = corners(i);
        format!("4 {a} {b} {c} {a}\n")
    });
    let obj_named = rows(&|i| {
        let name = ["g a\n", "o b\n", "usemtl c\n", "g\n"]
            .get(i / 5 % 7)
            .unwrap_or(&"");
        format!(
            "v {}\n{name}f {} {} {}\nl 1 2\n",
            point(i),
            a(i),
            b(i),
            c(i)
        )
    });
    let ends = [
        "endloop\nendfacet\n",
        "end loop\nendfacet\n",
        "endfacet\n",
        "endloop\n",
        "",
    ];
    let stl_bare = rows(&|i| {
        let corners = [i, i + 1, i + 2].map(|k| format!("vertex {}\n", point(k)));
        let solid = if i % 20 == 19 { "solid b\n" } else { "" };
        let end = ends[if i % 3 == 0 { i / 3 % 5 } else { 0 }];
        format!(
            "{solid}facet normal 0 0 1\nouter loop\n{}{end}",
            corners.concat()
        )
    });
    let points = rows(&|i| format!("{}\n", point(i)));
    let triangles = rows(&|i| format!("3 {} {} {}\n", a(i) - 1, b(i) - 1, c(i) - 1));
    let edges = rows(&|i| format!("{} {}\n", a(i) - 1, b(i) - 1));
    let references = rows(&|i| format!("{} {}", point(i), ["0\n", "0 "][usize::from(i % 6 == 0)]));
    let medit = rows(&|i| format!("{} {} {} {i}\n", a(i), b(i), c(i)));
    let tets = rows(&|i| format!("{i} {} {}, {} 1 {}.5\n", a(i), b(i), c(i), i % 4));
    let faces = rows(&|i| format!("{i} {} {} {} {i}\n", a(i), b(i), c(i)));
    vec![
        (plc(read_node), format!("{N} 3 0 1\n{numbered}")),
        (
            plc(|bytes| read_poly(bytes, || Ok(Vec::new()))),
            format!("{N} 3\n{numbered}{N} 1\n{poly}1\n1 0 0 0\n0\n"),
        ),
        (
            plc(|bytes| read_smesh(bytes, || Ok(Vec::new()))),
            format!("{N} 3\n{numbered}{N} 1\n{smesh}0\n"),
        ),
        (plc(read_off), format!("OFF\n{N} {N} 0\n{points}{off}")),
        (plc(read_obj), obj),
        (plc(read_stl), format!("solid a\n{stl}endsolid b\n")),
        (plc(read_ply), format!("{ply}{points}{triangles}{edges}")),
        (
            plc(read_medit),
            format!(
                "MeshVersionFormatted 2\nDimension 3\nVertices\n{N}\n{references}\nTriangles {N}\n{medit}End\n"
            ),
        ),
        (plc(read_node), format!("{N} 3 2 1\n{attributed}")),
        (
            plc(read_node),
            format!("{N} 3 1\n{}", numbered.replace("31 ", "310 ")),
        ),
        (
            plc(read_node),
            format!("{N} 3 1\n{}", numbered.replace(' ', ", ")),
        ),
        (
            plc(read_off),
            format!("OFF\n{N} {N} 0\n{}{rings}", points.replace("e-1", "D-1")),
        ),
        (plc(read_stl), format!("solid a\n{}", stl_bare)),
        (plc(read_obj), obj_named),
        (table("node"), format!("{N} 3 0 1\n{numbered}")),
        (table("ele"), format!("{N} 4 1\n{tets}\n# {N}\n")),
        (table("face"), format!("{N}, 1\n\n{faces}")),
    ]
}

static FILES: LazyLock<Vec<(Read, String)>> = LazyLock::new(files);

fn pool(threads: usize) -> rayon::ThreadPool {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().expect("a pool")
}

static POOLS: LazyLock<[rayon::ThreadPool; 3]> = LazyLock::new(|| [1, 2, 5].map(pool));

/// What is read, or the error, by one thread, and by two and five that read pieces of some size.
fn read_by_all(read: &Read, bytes: &[u8], size: usize) -> [Result<String, String>; 3] {
    POOLS.each_ref().map(|pool| {
        pool.install(|| {
            let before = SIZE.replace(size);
            let result = read(bytes);
            SIZE.set(before);
            result
        })
    })
}

#[test]
fn whole_files_are_read_alike() {
    for (read, file) in FILES.iter() {
        for size in 1..300 {
            let [alone, two, five] = read_by_all(read, file.as_bytes(), size);
            assert!(
                alone == two && two == five,
                "{size} {file} {alone:?} {two:?} {five:?}"
            );
            assert!(alone.is_ok(), "{alone:?} {file}");
        }
    }
}

/// An edit: at a place, so many bytes are replaced.
fn edit() -> impl Strategy<Value = (usize, usize, String)> {
    let snippets = prop::sample::select(vec![
        "",
        "\n",
        "\r",
        "\r\n",
        " ",
        "#",
        "# 3 1 2 3 3 1 2 3\n",
        "\\\n",
        "x",
        "-1 ",
        "1e999 ",
        "3 1 2 3\n",
        "1 0 1\n",
        "endsolid\n",
        "solid\n",
        "facet\n",
        "1 0 0 0\n",
        "f 1 2 99\n",
        "v 1 2 3\n",
        "Triangles 2\n",
        ", ",
        ",",
        "1.5D+00 ",
        "// c\n",
        " ! c\n",
        "{ c }",
        "end solid\n",
        "end facet\n",
        "endloop\n",
        "o a\n",
        "usemtl b\n",
        "Unknown 1\n",
        "\0",
        "0",
        "61 0 0 0\n",
    ]);
    (any::<usize>(), 0usize..20, snippets.prop_map(str::to_owned))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]
    /// Files that were edited, most of which are malformed, give the same PLC, or the same error with the same line.
    #[test]
    fn edited_files_are_read_alike(
        format in 0usize..FILES.len(),
        edits in prop::collection::vec(edit(), 1..4),
        size in 1usize..400,
        cut in prop::option::weighted(0.2, any::<usize>()),
    ) {
        let (read, file) = &FILES[format];
        let mut bytes = file.clone().into_bytes();
        for (place, length, snippet) in edits {
            let place = place % bytes.len();
            let end = (place + length).min(bytes.len());
            bytes.splice(place..end, snippet.into_bytes());
        }
        if let Some(cut) = cut {
            bytes.truncate(cut % (bytes.len() + 1));
        }
        let [alone, two, five] = read_by_all(read, &bytes, size);
        prop_assert_eq!(&alone, &two);
        prop_assert_eq!(alone, five);
    }
}
