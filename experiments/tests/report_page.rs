//! The page of results: well-formed, on its own, the same twice, and working in a real browser, where one is installed.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const EXPERIMENTS: &str = env!("CARGO_BIN_EXE_experiments");

/// The least that a page of all results may not exceed.
const MOST_BYTES: usize = 3_000_000;

/// Browsers by their names on the path; all of them take the same switches.
const BROWSERS: [&str; 5] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
];

fn run(arguments: &[&str]) {
    let status = Command::new(EXPERIMENTS)
        .args(arguments)
        .stdout(Stdio::null())
        .status()
        .expect("the program runs");
    assert!(status.success(), "{arguments:?}");
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

/// A page of results made now, by a run of one experiment that ends with it.
fn quick_page(directory: &Path) -> PathBuf {
    run(&["--quick", "--only", "growth", "--results", text(directory)]);
    directory.join("report.html")
}

/// A page of the results that come with the sources.
fn full_page(directory: &Path) -> PathBuf {
    let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("../results");
    let page = directory.join("full.html");
    run(&["report", "--results", text(&results), "-o", text(&page)]);
    page
}

#[test]
fn the_page_is_well_formed_and_needs_nothing_else() {
    let directory = TempDir::new().expect("a directory");
    for page in [quick_page(directory.path()), full_page(directory.path())] {
        let html = std::fs::read_to_string(&page).expect("a page");
        assert!(html.len() < MOST_BYTES, "{} bytes", html.len());
        for network in [
            "http://", "https://", "src=\"h", "src=\"/", "url(", "@import", "import(",
        ] {
            assert!(!html.contains(network), "{network} in {}", page.display());
        }
        check_elements(&html);
    }
    let quick = std::fs::read_to_string(directory.path().join("report.html")).expect("a page");
    assert!(
        quick.contains("fig9-summary.csv is missing"),
        "what is missing is named"
    );
    assert!(quick.contains("results are of the quick form"));
    assert!(
        quick.contains("every expectation holds"),
        "the run that has been made"
    );
}

#[test]
fn the_same_results_give_the_same_bytes() {
    let directory = TempDir::new().expect("a directory");
    let first = std::fs::read(full_page(directory.path())).expect("a page");
    let second = std::fs::read(full_page(directory.path())).expect("a page");
    assert!(first == second);
}

#[test]
fn no_page_of_no_directory() {
    let missing = ["report", "--results", "/no/such/directory"];
    let output = Command::new(EXPERIMENTS).args(missing).output();
    let output = output.expect("the program runs");
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("/no/such/directory"));
}

/// Steps through all films with the page's own controls and compares them with what was recorded; opens all tables.
#[test]
fn the_page_works_in_a_browser() {
    let Some(browser) = browser() else {
        eprintln!(
            "SKIPPED report page in a browser: no browser is installed ({})",
            BROWSERS.join(", ")
        );
        return;
    };
    let directory = TempDir::new().expect("a directory");
    for page in [quick_page(directory.path()), full_page(directory.path())] {
        let (dom, messages) = open(browser, &page, directory.path());
        let test = dom.split_once("<pre id=\"selftest\">");
        let test = test.and_then(|(_, rest)| rest.split_once("</pre>"));
        let (outcome, _) =
            test.unwrap_or_else(|| panic!("no self-test in {}: {messages}", page.display()));
        assert!(outcome.starts_with("PASSED: 5 scenes"), "{outcome}");
        println!("{}: {outcome}", page.display());
        for trouble in ["Uncaught", "Refused to", "violates the following"] {
            assert!(!messages.contains(trouble), "{messages}");
        }
        assert!(dom.contains("<table class=\"claims\">") && dom.contains("<table class=\"data"));
        assert!(
            dom.matches("<option value=").count() >= 5,
            "the scenes can be chosen"
        );
    }
}

fn browser() -> Option<&'static str> {
    let is_there = |name: &&str| {
        let version = Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        version.is_ok_and(|status| status.success())
    };
    BROWSERS.iter().copied().find(|name| is_there(name))
}

/// The document after its self-test, and what the browser has written to stderr.
fn open(browser: &str, page: &Path, directory: &Path) -> (String, String) {
    let page = page.canonicalize().expect("a page");
    let url = format!("file://{}#selftest", text(&page));
    let profile = format!("--user-data-dir={}", text(&directory.join("profile")));
    // No sandbox: continuous integration runs as root, and the page is our own.
    let mut child = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-dev-shm-usage",
            "--no-first-run",
        ])
        .args([
            "--enable-unsafe-swiftshader",
            "--enable-logging=stderr",
            "--virtual-time-budget=100000",
        ])
        .args([&*profile, "--dump-dom", &url])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the browser starts");
    let mut stdout = child.stdout.take().expect("a pipe");
    let mut stderr = child.stderr.take().expect("a pipe");
    let dom = std::thread::spawn(move || read(&mut stdout));
    let messages = std::thread::spawn(move || read(&mut stderr));
    let start = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if start.elapsed() > Duration::from_secs(300) {
            let _ = child.kill();
            panic!("the browser takes more than five minutes");
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    let of = |thread: std::thread::JoinHandle<String>| thread.join().expect("read");
    (of(dom), of(messages))
}

fn read(pipe: &mut impl Read) -> String {
    let mut bytes = Vec::new();
    let _ = pipe.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Every element is closed, in the right order; attributes are quoted, and no id is there twice.
fn check_elements(html: &str) {
    const VOID: [&str; 5] = ["meta", "link", "br", "input", "img"];
    let mut open: Vec<&str> = Vec::new();
    let mut ids: Vec<&str> = Vec::new();
    let mut rest = html
        .strip_prefix("<!DOCTYPE html>")
        .expect("a document type");
    while let Some(start) = rest.find('<') {
        assert!(
            !rest[..start].contains('>'),
            "a bare > in {:?}",
            &rest[..start]
        );
        let tag = &rest[start + 1..];
        let end = tag.find('>').expect("the end of a tag");
        let (tag, after) = (&tag[..end], &tag[end + 1..]);
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "the end of an element");
            continue;
        }
        assert!(
            !tag.contains('<') && tag.matches('"').count() % 2 == 0,
            "{tag}"
        );
        let name = tag.split([' ', '\n', '/']).next().expect("a name");
        ids.extend(
            tag.split_once(" id=\"")
                .and_then(|(_, id)| id.split('"').next()),
        );
        if tag.ends_with('/') || VOID.contains(&name) {
            continue;
        }
        if ["script", "style"].contains(&name) {
            let close = format!("</{name}>");
            rest = &rest[rest.find(&close).expect("the end of a script") + close.len()..];
            continue;
        }
        open.push(name);
    }
    assert!(open.is_empty(), "{open:?}");
    let all = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), all, "ids are unique");
}
