//! The dependencies of DESIGN.md between modules of the library and between crates. They are acyclic.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of `src`, each with those it may import, which stand before it.
const MODULES: [(&str, &[&str]); 30] = [
    ("number", &[]),
    ("threads", &[]),
    ("units", &[]),
    ("scales", &["units"]),
    ("turns", &[]),
    ("pair", &["number", "units"]),
    ("clock", &["number", "units", "turns", "pair"]),
    ("excitation", &["number"]),
    ("mapping", &["number", "pair"]),
    ("impact", &["number", "pair", "mapping"]),
    ("switch_plane", &["number", "pair"]),
    ("flight", &["number", "pair"]),
    ("rest", &["number", "pair"]),
    ("contact", &["number", "turns", "pair", "mapping", "flight"]),
    ("several", &["number", "units", "turns", "pair", "excitation", "flight", "rest", "contact"]),
    (
        "shaken",
        &[
            "number",
            "units",
            "turns",
            "pair",
            "clock",
            "excitation",
            "mapping",
            "impact",
            "flight",
            "rest",
            "contact",
            "several",
        ],
    ),
    ("covering", &["number", "turns", "pair", "clock", "mapping", "impact", "flight", "contact", "shaken"]),
    (
        "periodic",
        &[
            "number",
            "threads",
            "pair",
            "clock",
            "excitation",
            "mapping",
            "impact",
            "flight",
            "contact",
            "several",
            "shaken",
        ],
    ),
    ("two_impact", &["units", "pair", "periodic"]),
    (
        "orbit",
        &[
            "number",
            "units",
            "turns",
            "pair",
            "clock",
            "mapping",
            "impact",
            "covering",
            "switch_plane",
            "flight",
            "rest",
            "contact",
            "several",
            "shaken",
            "periodic",
        ],
    ),
    ("impact_map", &["number", "turns", "pair", "clock", "mapping", "contact", "shaken", "orbit"]),
    ("lyapunov", &["number", "periodic", "orbit"]),
    ("chaos", &["number", "threads", "units", "pair", "flight", "mapping", "contact", "periodic", "orbit"]),
    ("tangency", &["number", "units", "pair", "periodic", "chaos"]),
    (
        "document",
        &["units", "turns", "pair", "mapping", "contact", "periodic", "two_impact", "orbit", "chaos", "tangency"],
    ),
    ("sweep", &["number", "units", "turns", "pair", "mapping", "periodic", "orbit", "lyapunov", "document"]),
    ("atlas", &["chaos", "document", "sweep"]),
    ("describe", &["several", "mapping", "orbit", "lyapunov", "chaos", "document", "sweep"]),
    ("audit", &["pair", "scales", "contact", "orbit", "document"]),
    ("trade", &["pair", "scales", "orbit", "document"]),
];

/// Our crates, each with those of ours that it may depend on.
const CRATES: [(&str, &[&str]); 5] = [
    ("crates/exact", &[]),
    ("crates/model", &["impact-pair-exact"]),
    ("crates/document", &["impact-pair-exact", "impact-pair-model"]),
    ("crates/certificate", &["impact-pair-document", "impact-pair-exact", "impact-pair-model"]),
    (".", &["impact-pair-document", "impact-pair-exact", "impact-pair-model"]),
];

fn root() -> &'static Path {
    Path::new(impact_pair_tests::ROOT)
}

/// The sources of a module, without its tests.
fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    let is_test = |path: &PathBuf| path.file_stem().is_some_and(|name| name == "tests");
    entries.filter(|path| !is_test(path)).flat_map(|path| sources(&path)).collect()
}

/// The modules that a text imports by `crate::`, in comments and in its tests left aside.
fn imports(text: &str) -> BTreeSet<String> {
    let text = text.split("#[cfg(test)]\nmod").next().unwrap();
    let code: String = text.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n");
    let name = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found = BTreeSet::new();
    for (at, what) in code.match_indices("crate::") {
        let rest = &code[at + what.len()..];
        match rest.strip_prefix('{') {
            None => found.extend([name(rest)]),
            // `use crate::{a::{b, c}, d};`: all words, for types are none of the modules.
            Some(list) => {
                let list = list.split(';').next().unwrap();
                found.extend(list.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned));
            }
        }
    }
    found
}

#[test]
fn modules_import_earlier_modules_only() {
    let known: Vec<&str> = MODULES.iter().map(|(module, _)| *module).collect();
    let found: BTreeSet<String> = fs::read_dir(root().join("src"))
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .filter(|module| module != "lib")
        .collect();
    assert_eq!(found, known.iter().map(|module| (*module).to_owned()).collect());
    for (place, (module, allowed)) in MODULES.iter().enumerate() {
        assert!(allowed.iter().all(|other| known[..place].contains(other)), "{module} stands before what it imports");
        let path = [root().join("src").join(module), root().join("src").join(format!("{module}.rs"))];
        for file in path.iter().filter(|path| path.exists()).flat_map(|path| sources(path)) {
            for import in imports(&fs::read_to_string(&file).unwrap()) {
                let is_allowed =
                    import == *module || !known.contains(&import.as_str()) || allowed.contains(&import.as_str());
                assert!(is_allowed, "{} imports {import}", file.display());
            }
        }
    }
}

/// The texts between backticks in this part of DESIGN.md.
fn quoted(part: &str) -> Vec<&str> {
    part.split('`').skip(1).step_by(2).collect()
}

#[test]
fn design_lists_the_modules_in_this_order_and_all_crates() {
    let design = fs::read_to_string(root().join("DESIGN.md")).unwrap();
    let names = |heading: &str| -> Vec<&str> {
        let part = design.split("\n## ").find(|part| part.starts_with(heading)).unwrap();
        part.lines()
            .filter(|line| line.starts_with("| `"))
            .flat_map(|line| quoted(line.split(" |").next().unwrap()))
            .collect()
    };
    let modules = names("Modules");
    let place = |name: &str| {
        modules.iter().position(|module| *module == name).unwrap_or_else(|| panic!("{name} is not listed"))
    };
    assert_eq!(modules.len(), MODULES.len(), "{modules:?}");
    for (module, allowed) in MODULES {
        assert!(allowed.iter().all(|other| place(other) < place(module)), "{module} is listed above what it imports");
    }
    let crates = names("Crates");
    assert!(CRATES.iter().all(|(path, _)| crates.contains(path)), "{crates:?}");
}

#[test]
fn design_names_files_that_are_there() {
    let design = fs::read_to_string(root().join("DESIGN.md")).unwrap();
    let is_there = |path: &str| {
        let tops = if MODULES.iter().any(|(module, _)| path.starts_with(&format!("{module}/"))) {
            root().join("src")
        } else {
            root().to_owned()
        };
        tops.join(path).exists() || tops.join(format!("{path}.rs")).exists()
    };
    // `several/{precise,graze}`: two of them.
    let each = |path: &str| -> Vec<String> {
        match path.split_once('{').and_then(|(folder, rest)| Some((folder, rest.strip_suffix('}')?))) {
            Some((folder, names)) => names.split(',').map(|name| format!("{folder}{name}")).collect(),
            None => vec![path.to_owned()],
        }
    };
    let paths = quoted(&design).into_iter().filter(|text| text.contains('/') && !text.contains([' ', '=']));
    let missing: Vec<String> = paths.flat_map(each).filter(|path| !is_there(path)).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn crates_depend_on_what_stands_before_them() {
    for (path, allowed) in CRATES {
        let manifest = fs::read_to_string(root().join(path).join("Cargo.toml")).unwrap();
        let section = manifest.split("\n[dependencies]\n").nth(1).unwrap().split("\n[").next().unwrap();
        let ours = section.lines().map(|line| line.split(['.', ' ']).next().unwrap());
        let ours: Vec<&str> = ours.filter(|name| name.starts_with("impact-pair")).collect();
        assert!(ours.iter().all(|name| allowed.contains(name)), "{path} depends on {ours:?}");
    }
}

/// Files that import one another in a circle, to be parted: no others do.
const IMPORT_CYCLES: [&[&str]; 2] = [
    &["given", "motion", "plan", "precise", "shadowed", "splice", "textbook"],
    &["release", "rest", "standing", "still", "walk"],
];

/// The modules beside it that a file imports by `super::`.
fn beside(text: &str, modules: &BTreeSet<String>) -> BTreeSet<String> {
    let text = text.split("#[cfg(test)]\nmod").next().unwrap();
    let code: String = text.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n");
    let names =
        code.split("super::").skip(1).filter_map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next());
    names.filter(|name| modules.contains(*name)).map(str::to_owned).collect()
}

/// The modules that lead back to themselves.
fn in_circles(imports: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<String> {
    let reached = |from: &String| {
        let (mut all, mut open) = (BTreeSet::new(), vec![from]);
        while let Some(next) = open.pop() {
            open.extend(imports[next].iter().filter(|name| all.insert((*name).clone())));
        }
        all
    };
    imports.keys().filter(|name| reached(name).contains(*name)).cloned().collect()
}

#[test]
fn imports_within_a_module_are_acyclic() {
    let mut folders: Vec<PathBuf> = ["src", "crates", "cli/src", "python/src"].map(|path| root().join(path)).to_vec();
    let mut left = IMPORT_CYCLES.to_vec();
    while let Some(folder) = folders.pop() {
        let entries: Vec<PathBuf> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        folders.extend(entries.iter().filter(|path| path.is_dir()).cloned());
        let name = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
        let modules: BTreeSet<String> =
            entries.iter().map(name).filter(|name| name != "mod" && name != "tests").collect();
        let mut imports: BTreeMap<String, BTreeSet<String>> =
            modules.iter().map(|name| (name.clone(), BTreeSet::new())).collect();
        for path in entries.iter().filter(|path| path.extension().is_some_and(|ending| ending == "rs")) {
            if let Some(imports) = imports.get_mut(&name(path)) {
                let text = fs::read_to_string(path).unwrap();
                imports.extend(beside(&text, &modules));
                if folder.ends_with("src") {
                    imports.extend(self::imports(&text).into_iter().filter(|name| modules.contains(name)));
                }
            }
        }
        let found = in_circles(&imports);
        let known = left.len();
        left.retain(|circle| !circle.iter().eq(&found));
        assert!(found.is_empty() || left.len() < known, "{}: {found:?} import one another", folder.display());
    }
    assert!(left.is_empty(), "{left:?} are parted: they are to be taken from the list");
}

/// The test of the test.
#[test]
fn an_import_is_found() {
    let found = imports(
        "use crate::a::B;\n// crate::c\nuse crate::{d::{E, f}, G};\nlet x = crate::h();\n#[cfg(test)]\nmod t { use crate::i; }",
    );
    for name in ["a", "d", "f", "h"] {
        assert!(found.contains(name), "{name}");
    }
    assert!(!found.contains("c") && !found.contains("i"));
}
