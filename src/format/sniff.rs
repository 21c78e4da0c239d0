//! What a file is by its first bytes, whatever its name: for messages, and for files without a name.

use super::PlcFormat;
use super::error::{FilePosition, FormatError, Reason};
use super::stl_binary::announced_size;
use super::text::{Syntax, Text};

/// Refuses files that no reader here can read but that are well known by their first bytes.
pub(super) fn refuse_packed(bytes: &[u8]) -> Result<(), FormatError> {
    const PACKED: [(&[u8], &str); 6] = [
        (b"\x1f\x8b", "gzip"),
        (b"PK\x03\x04", "zip"),
        (b"BZh", "bzip2"),
        (b"\xfd7zXZ\0", "xz"),
        (b"\x28\xb5\x2f\xfd", "zstd"),
        (b"7z\xbc\xaf\x27\x1c", "7z"),
    ];
    let packed = PACKED.iter().find(|(start, _)| bytes.starts_with(start));
    let reason = match packed {
        Some((_, name)) => Reason::Compressed(name),
        None if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") => Reason::Utf16,
        None => return Ok(()),
    };
    Err(FormatError::Malformed {
        at: FilePosition::Byte(0),
        reason,
    })
}

/// What a file looks like, if it looks like anything: the format in which we would read it, or none, and its name.
pub(super) fn looks_like(bytes: &[u8]) -> Option<(Option<PlcFormat>, &'static str)> {
    let foreign: [(&[u8], &str); 8] = [
        (b"<!doctype html", "a web page"),
        (b"<html", "a web page"),
        (
            b"version https://git-lfs",
            "a pointer of git-lfs, not the file itself",
        ),
        (b"# vtk datafile", "a VTK file"),
        (b"<?xml", "an XML file"),
        (b"$meshformat", "a Gmsh file"),
        (b"iso-10303-21", "a STEP file"),
        (b"gltf", "a glTF file"),
    ];
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = start.trim_ascii_start();
    let starts = |word: &[u8]| {
        let head = start.get(..word.len());
        head.is_some_and(|head| head.eq_ignore_ascii_case(word))
    };
    if let Some((_, name)) = foreign.iter().find(|(word, _)| starts(word)) {
        return Some((None, name));
    }
    if bytes.starts_with(b"\x01\0\0\0") || bytes.starts_with(b"\0\0\0\x01") {
        return Some((Some(PlcFormat::Medit), "a binary Medit file"));
    }
    if announced_size(bytes) == Some(bytes.len() as u64) {
        return Some((Some(PlcFormat::Stl), "a binary STL file"));
    }
    let mut text = Text::new(bytes, Syntax::Hash);
    text.advance();
    let word = text.token()?.to_ascii_lowercase();
    Some(match &word[..] {
        b"ply" => (Some(PlcFormat::Ply), "a PLY file"),
        b"solid" => (Some(PlcFormat::Stl), "an STL file"),
        b"meshversionformatted" => (Some(PlcFormat::Medit), "a Medit file"),
        b"v" | b"vn" | b"vt" | b"mtllib" | b"o" | b"g" => (Some(PlcFormat::Obj), "an OBJ file"),
        word if word.len() < 9 && word.ends_with(b"off") => (Some(PlcFormat::Off), "an OFF file"),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_by_the_first_word() {
        let name = |bytes: &[u8]| looks_like(bytes).map(|(_, name)| name);
        assert_eq!(name(b"ply\nformat"), Some("a PLY file"));
        assert_eq!(name(b"# a cube\n\n v 1 2 3"), Some("an OBJ file"));
        assert_eq!(name(b"STCNOFF 3"), Some("an OFF file"));
        assert_eq!(name(b"\xef\xbb\xbf<!DOCTYPE HTML>"), Some("a web page"));
        assert_eq!(name(b"8 3 0 0\n"), None);
        assert_eq!(name(b""), None);
        assert!(refuse_packed(b"\x1f\x8b\x08").is_err());
        assert!(refuse_packed(b"").is_ok());
    }
}
