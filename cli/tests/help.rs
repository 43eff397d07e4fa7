//! Help, version and manual: every example in the help runs, and every verb has some.

use std::fs;
use std::path::PathBuf;

use crate::common::program;

const VERBS: &str = "run describe periodic bifurcations trap chaos cycles windows global atlas tangency sweep plot check prove trade \
                     two-impact audit man completions";

fn help(verb: &str) -> String {
    let answer = program(&[verb, "--help"]).output().unwrap();
    assert!(answer.status.success());
    String::from_utf8(answer.stdout).unwrap()
}

/// The commands below `Examples:`; one that ends in a pipe goes on in the next line.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().skip_while(|line| *line != "Examples:").skip(1).take_while(|line| line.starts_with("  "));
    let mut examples: Vec<String> = Vec::new();
    for line in lines {
        match examples.last_mut().filter(|last| last.ends_with('|')) {
            Some(last) => last.push_str(line),
            None => examples.push(line.trim().to_owned()),
        }
    }
    examples
}

#[test]
fn every_verb_is_listed_and_has_examples() {
    let answer = program(&["--help"]).output().unwrap();
    let text = String::from_utf8(answer.stdout).unwrap();
    let verbs = text.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let names = verbs.filter(|line| !line.starts_with("   ")).map(|line| line.split_whitespace().next().unwrap());
    for verb in names.filter(|&verb| verb != "help") {
        let count = examples(&help(verb)).len();
        assert!((2..=3).contains(&count), "{verb} has {count} examples");
    }
    for verb in VERBS.split(' ') {
        assert!(text.contains(&format!("\n  {verb} ")), "no {verb}");
    }
}

/// A folder with the scenes and a list, as the examples have them.
#[cfg(unix)]
fn folder() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("help");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("scenes")).unwrap();
    for scene in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes")).unwrap() {
        let scene = scene.unwrap();
        fs::copy(scene.path(), folder.join("scenes").join(scene.file_name())).unwrap();
    }
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/bases-figure-14.json"), folder.join("bases.json")).unwrap();
    fs::write(folder.join("events.csv"), "time,wall,velocity\n0.5513480202185213,right,35.45263760123459\n").unwrap();
    fs::write(folder.join("sol.txt"), "0.5513480202185213 0 1 35.45263760123459\n").unwrap();
    folder
}

#[cfg(unix)]
#[test]
fn every_example_runs() {
    runs_examples(&[
        "chaos scenes/figure-14.toml --depth 4",
        "describe scenes/figure-15.toml",
        "amplitude.2=0..2",
        "windows scenes/figure-14.toml",
        "tangency scenes/figure-14.toml --over gap=9.4245",
        "global scenes/figure-12.toml",
        "start.time=0..2:9",
        "trade scenes/figure-14.toml",
        "--over amplitude=1..1.1:2 --plot proved.svg",
        "-o a.html",
    ]);
}

#[test]
#[ignore = "deep: the examples that take seconds; by default every_example_runs"]
fn every_example_runs_slow_ones_included() {
    runs_examples(&[]);
}

/// Runs the examples of all verbs but those with these words.
fn runs_examples(left_out: &[&str]) {
    let folder = folder();
    let bin = std::path::Path::new(env!("CARGO_BIN_EXE_impact-pair")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    for verb in VERBS.split(' ') {
        for example in examples(&help(verb)) {
            if left_out.iter().any(|words| example.contains(words)) {
                continue;
            }
            let answer = std::process::Command::new("sh")
                .args(["-c", &example])
                .current_dir(&folder)
                .env("PATH", &path)
                .output()
                .unwrap();
            let stderr = String::from_utf8_lossy(&answer.stderr);
            // An example may also be a command that leaves something undecided.
            assert!(answer.status.code().is_some_and(|code| code <= 1), "{example}: {stderr}");
        }
    }
    let written = "impacts.csv audit.json Figure14.v orbit.jsonl trade.svg figure-10.svg figure-14.svg diagram.svg one.jsonl \
                   man/impact-pair-run.1";
    for written in written.split(' ') {
        assert!(folder.join(written).is_file(), "no {written}");
    }
}

#[test]
fn the_manual_has_a_page_for_each_verb() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("manual");
    let _ = fs::remove_dir_all(&folder);
    let answer = program(&["man", "--output", folder.to_str().unwrap()]).output().unwrap();
    assert!(answer.status.success() && answer.stdout.is_empty(), "{answer:?}");
    for verb in VERBS.split(' ') {
        let page = fs::read_to_string(folder.join(format!("impact-pair-{verb}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS") && page.contains("Examples:"), "{verb}");
    }
    let page = String::from_utf8(program(&["man"]).output().unwrap().stdout).unwrap();
    assert_eq!(page, fs::read_to_string(folder.join("impact-pair.1")).unwrap());
    assert!(page.contains("impact\\-pair\\-audit(1)"), "{page}");
}

#[test]
fn the_version_says_what_it_was_built_with() {
    let version = |flag: &str| String::from_utf8(program(&[flag]).output().unwrap().stdout).unwrap();
    let short = concat!("impact-pair ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!(version("-V"), short);
    let long = version("--version");
    assert!(long.starts_with(short) && long.contains(std::env::consts::ARCH), "{long}");
    assert!(long.contains("BITS") && !long.contains("MPFR") && long.contains("fma "), "{long}");
    assert!(long.contains("arithmetics: auto, float, interval"), "{long}");
}

#[test]
fn nothing_is_coloured_where_colours_are_off() {
    let is_coloured = |command: &mut std::process::Command| {
        let answer = command.env("CLICOLOR_FORCE", "1").output().unwrap();
        answer.stdout.contains(&0x1b) || answer.stderr.contains(&0x1b)
    };
    for arguments in [&["run", "--help"][..], &["juggle"], &["run"]] {
        assert!(is_coloured(program(arguments).env_remove("NO_COLOR")), "{arguments:?}");
        assert!(!is_coloured(&mut program(arguments)), "{arguments:?}");
    }
}
