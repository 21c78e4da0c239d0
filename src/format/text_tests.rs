//! Lines of all endings, and numbers that are none.

use super::*;

#[test]
fn counts_lines_of_all_endings() {
    let mut text = Text::new(b"\xef\xbb\xbfa\r\n\r\n# b\rc # d\n\n e", Syntax::Hash);
    let mut seen = Vec::new();
    while text.advance() {
        seen.push((text.number, text.token().unwrap()));
        assert_eq!(text.token(), None);
    }
    assert_eq!(seen, [(1, &b"a"[..]), (4, &b"c"[..]), (6, &b"e"[..])]);
}

#[test]
fn numbers_are_strict() {
    let mut text = Text::new(b"", Syntax::Hash);
    assert_eq!(text.real(b"-1.5e3").unwrap(), -1500.0);
    for bad in [
        &b"1.0x"[..],
        b"1,0",
        b"nan",
        b"-inf",
        b"1e999",
        b"\xff",
        b"",
    ] {
        assert!(text.real(bad).is_err(), "{bad:?}");
    }
    for comma in [&b"1,5"[..], b"-2,50e3"] {
        let reason = Reason::DecimalComma(shorten(comma));
        assert_eq!(
            text.real(comma).unwrap_err().to_string(),
            text.error(reason).to_string()
        );
    }
    for bad in [
        &b"1.0"[..],
        b"0x1",
        b"99999999999999999999",
        b"-",
        b"--1",
        b"+-1",
    ] {
        assert!(text.integer(bad).is_err(), "{bad:?}");
    }
    for good in [
        "0",
        "-0",
        "+7",
        "-12",
        "000000000000000000000012",
        "999999999999999999",
        "-9223372036854775808",
    ] {
        let number = text.integer(good.as_bytes()).unwrap();
        assert_eq!(number, good.parse::<i64>().unwrap());
    }
    assert!(text.count(b"-1", "it").is_err());
}
