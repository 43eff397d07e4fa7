//! The JSON Schemas: all their properties, and values that fit.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

/// A step from a value to one in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    Key(String),
    Item,
}

/// The folder of the schemas, from the folder of whichever package reads them.
pub fn folder() -> PathBuf {
    let folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().map(|folder| folder.join("docs/schemas"));
    folders.into_iter().find(|folder| folder.is_dir()).expect("the folder of the schemas")
}

pub fn read(name: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(folder().join(format!("{name}.json"))).unwrap()).unwrap()
}

/// A schema with its reference resolved, and the schemas that it is made of.
fn parts<'s>(schema: &'s Value, root: &'s Value) -> Vec<&'s Value> {
    if let Some(reference) = schema["$ref"].as_str() {
        return parts(root.pointer(reference.trim_start_matches('#')).unwrap(), root);
    }
    let lists = ["anyOf", "oneOf", "allOf"].into_iter().filter_map(|key| schema[key].as_array());
    let inner: Vec<&Value> = lists.flatten().flat_map(|part| parts(part, root)).collect();
    [vec![schema], inner].concat()
}

/// Whether the value is the whole schema again: cells consist of cells.
fn is_itself(schema: &Value) -> bool {
    schema["$ref"] == "#"
}

/// The paths of all properties, however deep; of a schema within itself none.
pub fn properties(root: &Value) -> Vec<Vec<Step>> {
    fn walk(schema: &Value, root: &Value, path: &[Step], found: &mut Vec<Vec<Step>>) {
        for part in parts(schema, root) {
            for (key, inner) in part["properties"].as_object().into_iter().flatten() {
                let path = [path, &[Step::Key(key.clone())]].concat();
                found.push(path.clone());
                walk(inner, root, &path, found);
            }
            if part["items"].is_object() && !is_itself(&part["items"]) {
                walk(&part["items"], root, &[path, &[Step::Item]].concat(), found);
            }
        }
    }
    let mut found = Vec::new();
    walk(root, root, &[], &mut found);
    found
}

/// A value of a schema.
pub fn sample(schema: &Value, root: &Value) -> Value {
    let parts = parts(schema, root);
    let is = |kind: &str| {
        parts.iter().any(|part| match &part["type"] {
            Value::Array(kinds) => kinds.contains(&json!(kind)),
            one => *one == kind,
        })
    };
    let named = parts.iter().find_map(|part| part["enum"].as_array()?.first().or(Some(&part["const"])));
    let named = named.or_else(|| parts.iter().map(|part| &part["const"]).find(|value| !value.is_null()));
    if let Some(value) = named.filter(|value| !value.is_null()) {
        return value.clone();
    }
    if is("object") {
        let mut entries = Map::new();
        for part in &parts {
            for (key, inner) in part["properties"].as_object().into_iter().flatten() {
                entries.insert(key.clone(), if key == "key" { json!("pair.gap") } else { sample(inner, root) });
            }
            if part["additionalProperties"].is_object() {
                entries.insert("1".into(), sample(&part["additionalProperties"], root));
            }
        }
        return entries.into();
    }
    let part = |key: &str| parts.iter().map(|part| &part[key]).find(|value| !value.is_null());
    if is("array") {
        let count = part("minItems").and_then(Value::as_u64).unwrap_or(1);
        return match (part("prefixItems").and_then(Value::as_array), part("items")) {
            (Some(items), _) => items.iter().map(|item| sample(item, root)).collect(),
            (None, Some(item)) if is_itself(item) => json!([]),
            (None, Some(item)) => (0..count).map(|_| sample(item, root)).collect(),
            (None, None) => json!([]),
        };
    }
    match ["string", "integer", "number", "boolean"].into_iter().find(|kind| is(kind)) {
        Some("string") => json!("1"),
        Some("integer") => json!(1),
        Some("number") => json!(0.5),
        Some(_) => json!(true),
        None => Value::Null,
    }
}

/// Puts a value that fits where a path leads, and where nothing is on the way to it.
pub fn ensure(value: &mut Value, path: &[Step], root: &Value) {
    fn put(value: &mut Value, path: &[Step], schema: &Value, root: &Value) {
        let Some((step, rest)) = path.split_first() else {
            if value.is_null() {
                *value = sample(schema, root);
            }
            return;
        };
        let inner = |of: &dyn Fn(&Value) -> Value| {
            parts(schema, root).into_iter().map(of).find(|inner| !inner.is_null()).unwrap_or_default()
        };
        match step {
            Step::Key(key) => {
                if !value.is_object() {
                    *value = sample(schema, root);
                }
                let schema = inner(&|part| part["properties"][key].clone());
                put(&mut value[key.as_str()], rest, &schema, root);
            }
            Step::Item => {
                if !value.is_array() {
                    *value = sample(schema, root);
                }
                let schema = inner(&|part| part["items"].clone());
                let items = value.as_array_mut().unwrap();
                if items.is_empty() {
                    items.push(sample(&schema, root));
                }
                put(&mut items[0], rest, &schema, root);
            }
        }
    }
    put(value, path, root, root);
}
