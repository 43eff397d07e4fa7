//! The dependencies of DESIGN.md: modules and crates import only what the page allows, and files beside one another not in circles.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Files that import one another in a circle, to be parted: no others do.
const IMPORT_CYCLES: [&[&str]; 2] = [
    &["given", "motion", "plan", "precise", "shadowed", "splice", "textbook"],
    &["release", "rest", "standing", "still", "walk"],
];

fn root(path: &str) -> PathBuf {
    Path::new(impact_pair_tests::ROOT).join(path)
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(path).unwrap()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| name(path) != "tests").collect()
}

/// The module of a file or a folder.
fn name(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}

/// The modules that a text imports by `crate::` or `super::`, those in comments and in its tests left aside.
fn imports(text: &str, from: &str) -> BTreeSet<String> {
    let text = text.split("#[cfg(test)]\nmod").next().unwrap();
    let code: String = text.lines().map(|line| line.split("//").next().unwrap().to_owned() + "\n").collect();
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned).collect()
    };
    // `use crate::{a::{b, c}, d};`: all words, for types are none of the modules.
    let found = code.split(from).skip(1).map(|rest| match rest.strip_prefix('{') {
        Some(list) => words(list.split(';').next().unwrap()),
        None => words(rest).into_iter().take(1).collect(),
    });
    found.flatten().collect()
}

/// The texts between backticks in a part of DESIGN.md.
fn quoted(part: &str) -> impl Iterator<Item = &str> {
    part.split('`').skip(1).step_by(2)
}

/// The rows of the table below a heading of DESIGN.md that name a module or a crate, cell by cell.
fn rows<'d>(design: &'d str, heading: &str) -> Vec<Vec<&'d str>> {
    let part = design.split("\n## ").find(|part| part.starts_with(heading)).unwrap();
    part.lines().filter(|line| line.starts_with("| `")).map(|line| line.split('|').skip(1).collect()).collect()
}

#[test]
fn modules_import_modules_above_them() {
    let design = read(root("DESIGN.md"));
    let listed: Vec<&str> = rows(&design, "Modules").iter().flat_map(|row| quoted(row[0])).collect();
    let paths: Vec<PathBuf> = entries(&root("src")).into_iter().filter(|path| name(path) != "lib").collect();
    let known: BTreeSet<String> = paths.iter().map(|path| name(path)).collect();
    assert!(listed.len() == known.len() && listed.iter().all(|module| known.contains(*module)), "{listed:?} {known:?}");
    for path in paths {
        let place = listed.iter().position(|module| *module == name(&path)).unwrap();
        for file in impact_pair_tests::sources(path, false) {
            let below =
                imports(&read(&file), "crate::").into_iter().find(|import| listed[place + 1..].contains(&&**import));
            assert_eq!(below, None, "{} imports a module below it", file.display());
        }
    }
}

/// The checker shares no code with what it checks: neither it nor what it uses depends on the library.
#[test]
fn crates_depend_on_what_design_allows() {
    let design = read(root("DESIGN.md"));
    for row in rows(&design, "Crates").into_iter().filter(|row| row[0].contains("crates/") || row[0].contains("`.`")) {
        let manifest = read(root(quoted(row[0]).next().unwrap()).join("Cargo.toml"));
        let section = manifest.split("\n[dependencies]\n").nth(1).unwrap().split("\n[").next().unwrap();
        let used = section.lines().map(|line| line.split(['.', ' ']).next().unwrap());
        for own in used.filter_map(|name| name.strip_prefix("impact-pair")) {
            let own = if own.is_empty() { "`impact-pair`" } else { &own[1..] };
            assert!(row[2].split(',').any(|allowed| allowed.trim() == own), "{} depends on {own}", row[0]);
        }
    }
}

#[test]
fn design_names_files_that_are_there() {
    let design = read(root("DESIGN.md"));
    // Of `several/{precise,graze}` the folder.
    let paths = quoted(&design).filter(|text| text.contains('/') && !text.contains([' ', '=']));
    let is_there = |path: &&str| {
        let path = path.split('{').next().unwrap();
        ["", "src/"].iter().any(|top| [path, &format!("{path}.rs")].iter().any(|path| root(top).join(path).exists()))
    };
    let missing: Vec<&str> = paths.filter(|path| !is_there(path)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The modules that lead back to themselves.
fn in_circles(imports: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<String> {
    let reached = |from: &String| {
        let (mut all, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(next) = open.pop() {
            open.extend(imports[next].iter().filter(|name| imports.contains_key(*name) && all.insert((*name).clone())));
        }
        all
    };
    imports.keys().filter(|name| reached(name).contains(*name)).cloned().collect()
}

#[test]
fn imports_within_a_module_are_acyclic() {
    let mut folders: Vec<PathBuf> = ["src", "crates", "cli/src", "python/src"].map(root).to_vec();
    let mut left = IMPORT_CYCLES.to_vec();
    while let Some(folder) = folders.pop() {
        let mut imported: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for path in entries(&folder).into_iter().filter(|path| name(path) != "mod") {
            let text = if path.extension().is_some_and(|ending| ending == "rs") { read(&path) } else { String::new() };
            let from: &[&str] = if folder.ends_with("src") { &["super::", "crate::"] } else { &["super::"] };
            imported.entry(name(&path)).or_default().extend(from.iter().flat_map(|from| imports(&text, from)));
            folders.extend(Some(path).filter(|path| path.is_dir()));
        }
        let found = in_circles(&imported);
        let known = left.len();
        left.retain(|circle| !circle.iter().eq(&found));
        assert!(found.is_empty() || left.len() < known, "{}: {found:?} import one another", folder.display());
    }
    assert!(left.is_empty(), "{left:?} are parted: they are to be taken from the list");
}

/// The test of the test.
#[test]
fn an_import_is_found() {
    let text = "use crate::a::B;\n// crate::c\nuse crate::{d::{E, f}, G};\nlet x = crate::h();\n#[cfg(test)]\nmod t { use crate::i; }";
    let found = imports(text, "crate::");
    assert!(
        ["a", "d", "f", "h"].iter().all(|name| found.contains(*name)) && !found.contains("c") && !found.contains("i")
    );
}
