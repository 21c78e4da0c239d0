//! HTML text: escaping, and the little of Markdown that the README of this package uses.

/// The text with the characters that HTML reserves escaped.
pub fn escape(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => html += "&amp;",
            '<' => html += "&lt;",
            '>' => html += "&gt;",
            '"' => html += "&quot;",
            c => html.push(c),
        }
    }
    html
}

/// JSON that can stand in a script element.
pub fn script_json(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// One paragraph of Markdown: `code`, **strong**, *emphasis*, and links, of which only the text is kept (they lead to
/// files that a page on its own does not have).
pub fn inline(markdown: &str) -> String {
    let mut html = String::new();
    for (i, part) in markdown.split('`').enumerate() {
        if i % 2 == 1 {
            html += &format!("<code>{}</code>", escape(part));
        } else {
            html += &escape(part);
        }
    }
    let html = without_links(&html);
    pairs(&pairs(&html, "**", "strong"), "*", "em")
}

/// `[text](target)` becomes the text.
fn without_links(text: &str) -> String {
    let mut rest = text;
    let mut plain = String::new();
    while let Some((before, after)) = rest.split_once('[') {
        plain += before;
        let link = after.split_once("](").and_then(|(label, tail)| {
            let (_, tail) = tail.split_once(')')?;
            (!label.contains('[')).then_some((label, tail))
        });
        match link {
            Some((label, tail)) => {
                plain += label;
                rest = tail;
            }
            None => {
                plain.push('[');
                rest = after;
            }
        }
    }
    plain + rest
}

/// Marks in pairs become an element; an odd one stays.
fn pairs(text: &str, mark: &str, element: &str) -> String {
    let parts: Vec<&str> = text.split(mark).collect();
    let mut html = String::new();
    for (i, part) in parts.iter().enumerate() {
        if i > 0 {
            html += &match (i % 2 == 1, i + 1 == parts.len()) {
                (true, true) => mark.to_string(),
                (true, false) => format!("<{element}>"),
                (false, _) => format!("</{element}>"),
            };
        }
        html += part;
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markdown_in_a_line() {
        let cases = [
            ("a < b & c", "a &lt; b &amp; c"),
            (
                "**Q.** `x<y` *so*",
                "<strong>Q.</strong> <code>x&lt;y</code> <em>so</em>",
            ),
            (
                "see [`src/a.rs`](src/a.rs), [−1, 1]² (x)",
                "see <code>src/a.rs</code>, [−1, 1]² (x)",
            ),
            ("[0, 1] and [text](t)", "[0, 1] and text"),
            ("2 * 3", "2 * 3"),
        ];
        for (markdown, html) in cases {
            assert_eq!(inline(markdown), html);
        }
        assert_eq!(script_json("\"</script>\""), "\"\\u003c/script>\"");
    }
}
