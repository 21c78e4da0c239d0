//! Plots and pictures, inlined.

use super::files::Files;
use super::html::escape;
use std::fmt::Write;

/// `NAME.svg` with a caption; an error says what is wrong with it.
pub fn plot(files: &Files, name: &str, caption: &str) -> Result<String, String> {
    let svg = files.text(&format!("{name}.svg"))?;
    let svg = inlined(&svg, name, caption);
    let svg = svg.ok_or_else(|| format!("{name}.svg is no SVG, or it has a program in it"))?;
    Ok(format!(
        "<figure>\n{svg}\n<figcaption>{} <code>{name}.svg</code></figcaption>\n</figure>\n",
        escape(caption)
    ))
}

/// The svg element, with a name for those who cannot see it; its width follows the page. None if it is no such element
/// or would run a program.
fn inlined(svg: &str, name: &str, caption: &str) -> Option<String> {
    let svg = &svg[svg.find("<svg")?..];
    let (start, rest) = svg.split_at(svg.find('>')?);
    let end = rest.rfind("</svg>")? + "</svg>".len();
    if rest.contains("<script") || rest.contains("<foreignObject") {
        return None;
    }
    let start = start.replace(" xmlns=\"http://www.w3.org/2000/svg\"", "");
    let label = if caption.is_empty() { name } else { caption };
    let label = escape(label);
    Some(format!(
        "{start} role=\"img\" aria-label=\"{label}\"{}",
        &rest[..end]
    ))
}

/// All `NAME.png` of a directory beside the results; an error says that there are none.
pub fn pictures(files: &Files, directory: &str, caption: &str) -> Result<String, String> {
    let mut html = String::new();
    for (name, bytes) in files.pictures(directory)? {
        let _ = writeln!(
            html,
            "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>",
            escape(&name),
            base64(&bytes)
        );
    }
    Ok(format!(
        "<p class=\"caption\">{} <code>{directory}/</code></p>\n<div class=\"pictures\">\n{html}</div>\n",
        escape(caption)
    ))
}

/// RFC 4648, §4.
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |i: usize| u32::from(*chunk.get(i).unwrap_or(&0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= chunk.len() { digit as char } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_element_alone_is_taken() {
        let svg = "<?xml version=\"1.0\"?>\n<svg width=\"1\" xmlns=\"http://www.w3.org/2000/svg\"><g/></svg>\n";
        let html = inlined(svg, "a", "So <it> is.").expect("an SVG");
        let expected = "<svg width=\"1\" role=\"img\" aria-label=\"So &lt;it&gt; is.\"><g/></svg>";
        assert_eq!(html, expected);
        assert_eq!(inlined("<svg><script/></svg>", "a", ""), None);
        assert_eq!(inlined("no", "a", ""), None);
    }

    #[test]
    fn the_examples_of_the_rfc() {
        let cases = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        for (text, expected) in cases {
            assert_eq!(base64(text.as_bytes()), expected);
        }
        assert_eq!(base64(&[251, 255, 0]), "+/8A");
    }
}
