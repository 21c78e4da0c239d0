//! No number of the text is typed by hand: digits are found outside of the places where they may be.
//!
//! They may be in comments, in the arguments of commands that refer to something (`\ref`, `\cite`, `\input`, …), in the
//! names of flips (2-3, 3-2, 4-4), and on lines that end with a comment `% digits: why`, for definitions of inputs,
//! say.

/// A line with digits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// From 1.
    pub line: usize,
    /// Without what digits are allowed in.
    pub rest: String,
}

/// Commands whose arguments may have digits.
const REFERENCES: [&str; 11] = [
    "ref",
    "eqref",
    "cite",
    "label",
    "input",
    "bibitem",
    "url",
    "texttt",
    "includegraphics",
    "vspace",
    "fitted",
];

const FLIPS: [&str; 3] = ["2-3", "3-2", "4-4"];

/// The lines of a LaTeX text with digits where there should be none.
pub fn digits(text: &str) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let (code, comment) = split_comment(line);
        if comment.trim_start().starts_with("digits:") {
            continue;
        }
        let mut rest = without_references(code);
        for flip in FLIPS {
            rest = rest.replace(flip, "");
        }
        if rest.contains(|c: char| c.is_ascii_digit()) {
            findings.push(Finding { line: i + 1, rest });
        }
    }
    findings
}

/// The text before the first `%` that is not escaped, and what is after it.
fn split_comment(line: &str) -> (&str, &str) {
    let bytes = line.as_bytes();
    let comment = (0..bytes.len()).find(|&i| bytes[i] == b'%' && (i == 0 || bytes[i - 1] != b'\\'));
    comment.map_or((line, ""), |i| (&line[..i], &line[i + 1..]))
}

/// Without the arguments of [`REFERENCES`], optional ones included.
fn without_references(code: &str) -> String {
    let mut rest = String::new();
    let mut left = code;
    while let Some(i) = left.find('\\') {
        rest += &left[..=i];
        left = &left[i + 1..];
        let letters = left
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(left.len());
        let (name, after) = left.split_at(letters);
        rest += name;
        left = after;
        if REFERENCES.contains(&name) {
            for (open, close) in [('[', ']'), ('{', '}')] {
                if left.starts_with(open) {
                    left = left.split_once(close).map_or("", |(_, after)| after);
                }
            }
        }
    }
    rest + left
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(text: &str) -> Vec<usize> {
        digits(text).iter().map(|f| f.line).collect()
    }

    #[test]
    fn digits_are_found() {
        assert_eq!(lines("takes 5 ms\nnone\nfails on 12\\,\\% of all"), [1, 3]);
        assert_eq!(lines("\\ref{sec:1} in 7 cases"), [1]);
    }

    #[test]
    fn digits_are_allowed_in_some_places() {
        let fine = "see \\cite[Fig.~9]{ss2012} and Table~\\ref{tab:1}\n% 5 ms\na 2-3 flip\n\
            $z=0$ % digits: the plane of the rectangle\n\\input{generated/table1-table}";
        assert_eq!(digits(fine), []);
    }

    /// The parts of the paper that speak of measurements.
    #[test]
    fn no_number_of_the_paper_is_typed_by_hand() {
        let paper = Path::new(env!("CARGO_MANIFEST_DIR")).join("../paper");
        for name in ["abstract", "introduction", "experiments", "conclusion"] {
            let path = paper.join(format!("{name}.tex"));
            let text = std::fs::read_to_string(&path).expect("a part of the paper");
            let findings = digits(&text);
            assert!(findings.is_empty(), "{name}.tex: {findings:#?}");
        }
    }
}
