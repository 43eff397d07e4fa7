//! The looks of pictures, in all verbs that draw: their size, their header, their letters.

use std::fs;

use crate::common::{folder, program};

/// The verbs that draw, each with a quick question.
const VERBS: [&str; 8] = [
    "plot scenes/figure-12.toml --panel c --impacts 20 --output",
    "trap scenes/figure-12.toml --plot",
    "chaos scenes/figure-14.toml --depth 1 --bases docs/bases-figure-14.json --plot",
    "two-impact scenes/figure-10.toml --manifold frequency=5..60:6 --inset 10..20:0.1..2 --plot",
    "sweep scenes/cascade.toml --over gap=9..10:2 --transient 2 --impacts 1 --plot",
    "atlas scenes/figure-12.toml --over gap=9..10:2 --over restitution=0..0.1:2 --effort 1e-7 --plot",
    "describe scenes/figure-13.toml --plot",
    "trade scenes/figure-12.toml --impacts 3 --plot",
];

fn words(command: &str) -> Vec<&str> {
    command.split(' ').collect()
}

#[test]
fn r35_pictures_have_the_requested_size_and_font_and_no_header() {
    let folder = folder("looks");
    let drawn = |arguments: &[&str], name: &str, look: &[&str]| {
        let path = folder.join(format!("{}-{name}.svg", arguments[0]));
        let done = program(&[arguments, &[path.to_str().unwrap()], look].concat()).output().unwrap();
        assert!(matches!(done.status.code(), Some(0 | 1)), "{arguments:?} {look:?}: {done:?}");
        fs::read_to_string(path).ok()
    };
    for arguments in VERBS.map(words) {
        let arguments = &arguments;
        // Nothing may be drawn if nothing is proved.
        let Some(own) = drawn(arguments, "own", &[]) else { continue };
        assert!(own.contains("impact-pair\u{a0}") || own.contains("impact-pair 0"), "{arguments:?}: no header");
        let look = ["--no-header", "--size", "500x400", "--font", "Courier New"];
        let svg = drawn(arguments, "other", &look).unwrap();
        assert!(svg.starts_with("<svg width=\"500\" height=\"400\" "), "{arguments:?}: {}", &svg[..80]);
        assert!(!svg.contains("impact-pair"), "{arguments:?}: there is a header");
        assert!(svg.contains("font-family=\"Courier New, sans-serif\"") && !svg.contains("font-family=\"sans-serif\""));
    }
}

#[test]
fn r35_other_looks_are_refused() {
    for (look, said) in [
        (&["--size", "20x20"][..], "accepted are sizes in pixels from 400x300 to 10000x10000, such as 600x450"),
        (&["--size", "90mm"], "accepted are sizes in pixels"),
        (&["--font", "a\"b"], "accepted is the name of a family"),
    ] {
        let done = program(&[&words(VERBS[0])[..], &["a.svg"], look].concat()).output().unwrap();
        let error = String::from_utf8(done.stderr).unwrap();
        assert!(done.status.code() == Some(2) && error.contains(said), "{look:?}: {error}");
    }
    let done = program(&["trap", "scenes/figure-12.toml", "--no-header"]).output().unwrap();
    let error = String::from_utf8(done.stderr).unwrap();
    assert!(done.status.code() == Some(2) && error.contains("--plot"), "{error}");
}
