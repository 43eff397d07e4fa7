//! The table of `docs/verified.md`: every key of every schema, and what `check` says of it.
//!
//! `KEYS_UPDATE=1` writes it. The marks are those of the recorded documents, and of these with each key that a schema has.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use impact_pair_certificate::Claims;

use crate::claimed::with_each_key;
use crate::recorded::{all, text};
use crate::schemas::{self, Step};

/// The lemmas that check a key, and why it is not checked, or where.
type Said = [BTreeSet<String>; 2];

const BEGIN: &str = "<!-- The table of keys is made by `KEYS_UPDATE=1`. -->\n";
const END: &str = "<!-- The end of the table of keys. -->\n";

fn page() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/verified.md")
}

/// What is said of the keys of each schema.
fn said() -> BTreeMap<String, BTreeMap<String, Said>> {
    let mut schemas: BTreeMap<String, BTreeMap<String, Said>> = BTreeMap::new();
    let recorded = all().into_iter().map(|(_, lines)| lines);
    for lines in recorded.chain(with_each_key()) {
        let Ok(claims) = Claims::parse(&text(&lines)) else { continue };
        let Some(schema) = lines[0]["schema"].as_str() else { continue };
        let keys = schemas.entry(schema.to_owned()).or_default();
        for (key, by, why) in claims.keys() {
            // The cells into which a tile is cut have the keys of the tile.
            let [all_by, all_whys] = keys.entry(key.replace("quarters.", "")).or_default();
            all_by.extend(Some(by.to_owned()).filter(|by| !by.is_empty()));
            all_whys.extend(Some(why.to_owned()).filter(|why| !why.is_empty()));
        }
    }
    schemas
}

fn is_in(key: &str, outer: &str) -> bool {
    outer.is_empty() || key == outer || key.strip_prefix(outer).is_some_and(|rest| rest.starts_with('.'))
}

/// The rows of a key: one, where the same is said of all that is in it.
fn rows(keys: &BTreeMap<String, Said>, outer: &str, table: &mut String) {
    let within: Vec<(&String, &Said)> = keys.iter().filter(|(key, _)| is_in(key, outer)).collect();
    let (_, first) = within[0];
    if !outer.is_empty() && within.iter().all(|(_, said)| *said == first) {
        let [by, whys] = first.each_ref().map(|all| all.iter().cloned().collect::<Vec<_>>().join("; "));
        let by = if by.is_empty() { "-" } else { &by };
        writeln!(table, "| `{outer}` | {by} | {whys} |").unwrap();
        return;
    }
    let next = |key: &str| {
        let rest = key[outer.len()..].trim_start_matches('.');
        let end = key.len() - rest.len() + rest.find('.').unwrap_or(rest.len());
        key[..end].to_owned()
    };
    let inner: BTreeSet<String> = within.iter().map(|(key, _)| next(key)).collect();
    inner.iter().for_each(|key| if key == outer { rows_of_itself(keys, outer, table) } else { rows(keys, key, table) });
}

/// The row of a key of which something else is said than of what is in it.
fn rows_of_itself(keys: &BTreeMap<String, Said>, key: &str, table: &mut String) {
    let own: BTreeMap<String, Said> = [(key.to_owned(), keys[key].clone())].into();
    rows(&own, key, table);
}

#[test]
fn the_table_of_keys_is_what_check_says() {
    let mut table = String::new();
    for (schema, keys) in &said() {
        if keys.is_empty() {
            continue;
        }
        write!(table, "\n### `{schema}`\n\n| key | checked by | not checked: why, or where |\n|---|---|---|\n")
            .unwrap();
        rows(keys, "", &mut table);
    }
    let text = fs::read_to_string(page()).unwrap();
    let (before, rest) = text.split_once(BEGIN).expect("the beginning of the table");
    let (_, after) = rest.split_once(END).expect("the end of the table");
    let expected = format!("{before}{BEGIN}{table}\n{END}{after}");
    if std::env::var_os("KEYS_UPDATE").is_some() {
        fs::write(page(), expected).unwrap();
    } else {
        assert!(text == expected, "docs/verified.md: the table of keys is another one: KEYS_UPDATE=1 writes it");
    }
}

/// Each property of each schema that is checked at all has a row, or one around it has.
#[test]
fn every_key_of_every_schema_is_in_the_table() {
    let said = said();
    let of = |name: &str| match name {
        "two-impact" => Some("periodic".to_owned()),
        "audit" | "check" | "manifold" | "trade" | "verified" => None,
        name => Some(
            ["-lines-head", "-lines-end", "-head"]
                .iter()
                .fold(name.to_owned(), |name, end| name.strip_suffix(end).map_or(name.clone(), str::to_owned)),
        ),
    };
    let file = |file: fs::DirEntry| file.file_name().into_string().unwrap().trim_end_matches(".json").to_owned();
    for name in fs::read_dir(schemas::folder()).unwrap().map(|entry| file(entry.unwrap())) {
        let (name, prefix) = match name.strip_suffix("-lines-event").or(name.strip_suffix("-point")) {
            Some(list) => (list.to_owned(), if name.ends_with("-point") { "points." } else { "events." }),
            None => (name, ""),
        };
        let Some(verb) = of(&name) else { continue };
        let keys = &said[&format!("impact-pair/{verb}/1")];
        let file = if prefix.is_empty() {
            name.clone()
        } else {
            format!("{name}{}", if prefix == "points." { "-point" } else { "-lines-event" })
        };
        for property in schemas::properties(&schemas::read(&file)) {
            let steps = property.iter().filter_map(|step| match step {
                Step::Key(key) => Some(key.as_str()),
                Step::Item => None,
            });
            let path = prefix.to_owned() + &steps.collect::<Vec<_>>().join(".");
            let is_there = keys.keys().any(|key| is_in(key, &path) || is_in(&path, key));
            let is_of_part = path.starts_with("proof") || path.starts_with("region");
            assert!(is_there || verb == "description" && is_of_part, "{file}: {path}");
        }
    }
}
