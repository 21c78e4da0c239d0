//! Pictures of a directory, inlined.

use super::files::Files;
use super::html::escape;
use std::fmt::Write;

/// All `NAME.png` of a directory beside the results; an error says that there are none.
pub fn html(files: &Files, directory: &str, caption: &str) -> Result<String, String> {
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
