//! Plots, inlined.

use super::files::Files;
use super::html::escape;

/// `NAME.svg` with a caption; an error says what is wrong with it.
pub fn html(files: &Files, name: &str, caption: &str) -> Result<String, String> {
    let svg = files.text(&format!("{name}.svg"))?;
    let svg = inlined(&svg, name, caption);
    let svg = svg.ok_or_else(|| format!("{name}.svg is no SVG, or it has a program in it"))?;
    Ok(format!(
        "<figure>\n{svg}\n<figcaption>{} <code>{name}.svg</code></figcaption>\n</figure>\n",
        escape(caption)
    ))
}

/// The svg element, with a name for those who cannot see it; its width follows the page. None if it is no such element or would
/// run a program.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_element_alone_is_taken() {
        let svg = "<?xml version=\"1.0\"?>\n<svg width=\"1\" xmlns=\"http://www.w3.org/2000/svg\"><g/></svg>\n";
        let html = inlined(svg, "a", "So <it> is.").expect("an SVG");
        assert_eq!(
            html,
            "<svg width=\"1\" role=\"img\" aria-label=\"So &lt;it&gt; is.\"><g/></svg>"
        );
        assert_eq!(inlined("<svg><script/></svg>", "a", ""), None);
        assert_eq!(inlined("no", "a", ""), None);
    }
}
