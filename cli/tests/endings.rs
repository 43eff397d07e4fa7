//! The ending of a file's name chooses the format, in all verbs; what cannot be written is refused before any work.

use std::fs;
use std::path::Path;

use crate::common::{folder, program};

/// The verbs that write data, each with a quick question, and the endings that it writes.
const VERBS: [(&str, &str); 15] = [
    ("run scenes/figure-12.toml --impacts 3", "txt json jsonl csv"),
    ("periodic scenes/figure-12.toml --word RL --cycles 1", "txt json"),
    ("two-impact scenes/figure-12.toml --cycles 1", "txt json"),
    ("bifurcations scenes/cascade.toml --word RL --cycles 1 --over frequency=1..2", "txt json"),
    ("trap scenes/figure-12.toml", "txt json graphml dot"),
    ("describe scenes/figure-12.toml", "txt json"),
    ("cycles scenes/figure-12.toml --impacts 1", "txt json"),
    ("windows scenes/figure-12.toml --over gap=9..10 --impacts 1", "txt json"),
    ("global scenes/figure-12.toml --effort 1e-7", "txt json"),
    ("atlas scenes/figure-12.toml --over gap=9..10:2 --over restitution=0..0.1:2 --effort 1e-7", "csv jsonl svg html"),
    ("tangency scenes/figure-12.toml --over gap=9..10 --longest 1", "txt json"),
    ("chaos scenes/figure-14.toml --depth 1 --bases docs/bases-figure-14.json", "txt json"),
    ("audit scenes/figure-12.toml cli/tests/endings/list.csv", "txt json"),
    ("check tests/chaos-0.036.json", "txt json"),
    ("sweep scenes/figure-12.toml --over gap=9..10:2 --transient 2 --impacts 1", "csv jsonl"),
];

/// The words of a command, and the endings that it writes.
fn verbs() -> impl Iterator<Item = (Vec<&'static str>, Vec<&'static str>)> {
    VERBS.into_iter().map(|(command, endings)| (command.split(' ').collect(), endings.split(' ').collect()))
}

/// The exit code, and the text on stderr.
fn answer(arguments: &[&str], more: &[&str]) -> (Option<i32>, String) {
    let done = program(&[arguments, more].concat()).output().unwrap();
    (done.status.code(), String::from_utf8(done.stderr).unwrap())
}

/// Whether a text has the format of its file's ending.
fn is_written_as(ending: &str, text: &str) -> bool {
    match ending {
        "json" => serde_json::from_str::<serde_json::Value>(text).is_ok(),
        "jsonl" => text.lines().count() > 1 && text.lines().all(|line| line.starts_with('{') && line.ends_with('}')),
        "graphml" => text.starts_with("<?xml ") && text.ends_with("</graphml>\n"),
        "svg" => text.starts_with("<svg ") && text.ends_with("</svg>\n"),
        "html" => text.starts_with("<!doctype html>") && text.ends_with("</html>\n"),
        "dot" => text.starts_with("digraph {") && text.ends_with("}\n"),
        "csv" => text.lines().next().is_some_and(|header| header.split(',').count() > 3 && !header.contains(' ')),
        _ => !text.starts_with('{') && text.contains(' '),
    }
}

#[test]
fn r35_the_ending_chooses_the_format() {
    let folder = folder("endings");
    for (arguments, endings) in verbs().filter(|(arguments, _)| arguments[0] != "check") {
        for ending in endings {
            let path = folder.join(format!("{}.{}", arguments[0], if ending == "json" { "JSON" } else { ending }));
            let (code, said) = answer(&arguments, &["--quiet", "--output", path.to_str().unwrap()]);
            assert!(code == Some(0) || code == Some(1), "{arguments:?}: {said}");
            let text = fs::read_to_string(&path).unwrap();
            assert!(is_written_as(ending, &text), "{arguments:?} {ending}: {text}");
        }
    }
}

#[test]
fn r35_an_ending_that_cannot_be_written_is_refused_before_any_work() {
    let folder = folder("endings-refused");
    for (arguments, endings) in verbs() {
        // A scene that is not there would be met first by any work.
        let arguments = [&arguments[..1], &["nowhere"], &arguments[2..]].concat();
        let others = ["xlsx", "svg", "dat", "nc"].into_iter().chain((arguments[0] != "run").then_some("ndjson"));
        for ending in others.filter(|ending| !endings.contains(ending)) {
            let path = folder.join(format!("out.{ending}"));
            let (code, said) = answer(&arguments, &["--output", path.to_str().unwrap()]);
            assert_eq!(code, Some(2), "{arguments:?}: {said}");
            let named = format!("error: --output is {}, but accepted is a name that ends in ", path.display());
            assert!(said.starts_with(&named) && said.lines().count() == 1, "{arguments:?}: {said}");
            assert!(endings.iter().all(|ending| said.contains(&format!(".{ending}"))), "{arguments:?}: {said}");
        }
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
    let (code, said) = answer(&["prove", "nowhere"], &["--output", "orbit.json"]);
    assert!(
        code == Some(2) && said.contains("--output is orbit.json, but accepted is a name that ends in .v"),
        "{said}"
    );
}

#[test]
fn r35_parquet_is_not_written_as_anything_else() {
    if cfg!(feature = "parquet") {
        return;
    }
    let sweep = ["sweep", "nowhere", "--over", "gap=9..10:2"];
    for option in ["--output", "--states"] {
        let (code, said) = answer(&sweep, &[option, "x.parquet"]);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains(&format!("{option} x.parquet is parquet, but this build lacks Parquet")), "{said}");
    }
    assert!(!Path::new("x.parquet").exists());
}

/// A requested format applies to any extension without a meaning; a contradiction of both is refused.
#[test]
fn r35_a_format_and_an_ending_that_contradict_each_other_are_refused() {
    let folder = folder("endings-and-formats");
    let run = ["run", "scenes/figure-12.toml", "--impacts", "2", "--quiet"];
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    for (format, name) in
        [("csv", "a.json"), ("json", "a.csv"), ("jsonl", "a.json"), ("table", "a.csv"), ("csv", "a.svg")]
    {
        let (code, said) = answer(&run, &["--format", format, "--output", &path(name)]);
        assert_eq!(code, Some(2), "{format} {name}");
        assert!(said.contains("--output is") && said.contains(&format!("but --format is {format}")), "{said}");
    }
    for (format, name) in [("csv", "a.dat"), ("csv", "a.txt"), ("csv", "a"), ("json", "a.json"), ("table", "a.log")] {
        assert_eq!(answer(&run, &["--format", format, "--output", &path(name)]).0, Some(0), "{format} {name}");
        let ending = if format == "table" { "txt" } else { format };
        assert!(is_written_as(ending, &fs::read_to_string(path(name)).unwrap()), "{format} {name}");
    }
}

/// Points and states are two tables, each as its ending says; of a manifold there are columns, of motions there are none.
#[test]
fn r35_each_table_has_its_own_ending() {
    let sweep = ["sweep", "nowhere", "--over", "gap=9..10:2"];
    let (code, said) = answer(&sweep, &["--output", "points.csv", "--states", "states.jsonl"]);
    assert!(
        code == Some(2) && said.contains("--states is states.jsonl, but accepted is a name that ends in .csv"),
        "{said}"
    );
    let (code, said) = answer(&sweep, &["--shard", "1/2", "--output", "one.csv"]);
    assert!(
        code == Some(2) && said.contains("--output one.csv is not jsonl, but shards are written as jsonl"),
        "{said}"
    );
    let (code, said) = answer(&["two-impact", "nowhere", "--cycles", "1"], &["--output", "motions.csv"]);
    assert!(code == Some(2) && said.contains("accepted is a name that ends in .txt or .json"), "{said}");
}
