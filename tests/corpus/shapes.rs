//! True documents in another shape: none is read.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

use super::changes::is_position;
use super::numbers::bounds;
use super::original::Original;

/// A key that stands for another one until the document is a text, in which a key may be there twice.
const STAND_IN: &str = "stands in for a key that is there already";

/// A document in another shape: the path of the change, the change in words, and the text.
pub struct Shape {
    pub place: String,
    pub what: &'static str,
    pub text: String,
}

/// Each value of a document in another shape; items of a list that have the same keys are changed once.
pub fn shapes(original: &Original) -> Vec<Shape> {
    let (mut found, mut seen) = (Vec::new(), BTreeSet::new());
    walk(&original.document, "", &mut |pointer, value| {
        let place: Vec<&str> = pointer.split('/').filter(|step| !step.is_empty() && !is_position(step)).collect();
        let keys = value.as_object().map(|entries| entries.keys().cloned().collect::<Vec<_>>());
        if pointer.is_empty() && value.is_array() || !seen.insert((place.join("."), keys)) {
            return;
        }
        for (what, other) in others(&place.join("."), value) {
            let mut copy = original.document.clone();
            *copy.pointer_mut(pointer).unwrap() = other;
            let mut text = original.text(&copy);
            if let Some(first) = value.as_object().and_then(|entries| entries.keys().next()) {
                text = text.replace(STAND_IN, first);
            }
            found.push(Shape { place: place.join("."), what, text });
        }
    });
    found
}

fn walk(value: &Value, pointer: &str, each: &mut impl FnMut(&str, &Value)) {
    each(pointer, value);
    match value {
        Value::Object(entries) => {
            entries.iter().for_each(|(key, inner)| walk(inner, &format!("{pointer}/{key}"), each));
        }
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(i, inner)| walk(inner, &format!("{pointer}/{i}"), each));
        }
        _ => {}
    }
}

/// Half vectors of h-sets, values of a scene and of points of a grid, and coefficients of strips are no bounds.
fn is_list_of_data(place: &str) -> bool {
    let is_strip = place.split('.').any(|key| key == "strips");
    ["expanding", "contracting", "values"].iter().any(|key| place.ends_with(key))
        || place.starts_with("scene.")
        || is_strip
}

fn others(place: &str, value: &Value) -> Vec<(&'static str, Value)> {
    match value {
        Value::Object(entries) => {
            let with = |key: &str, value: &Value| {
                let mut copy = entries.clone();
                copy.insert(key.to_owned(), value.clone());
                json!(copy)
            };
            let twice = entries.values().next().map(|first| ("a key twice", with(STAND_IN, first)));
            let list = ("a list of its values", json!(entries.values().collect::<Vec<_>>()));
            [("an unknown key", with("unknown", &json!("1"))), list].into_iter().chain(twice).collect()
        }
        Value::Array(items) if !items.is_empty() => {
            let is_ordered = bounds(value).is_some_and(|[low, high]| low < high) && !is_list_of_data(place);
            let exchanged = is_ordered.then(|| ("bounds out of order", json!([items[1], items[0]])));
            let numbered = items.iter().enumerate().map(|(i, item)| (i.to_string(), item.clone()));
            let object = Value::Object(numbered.collect::<Map<_, _>>());
            std::iter::once(("a list as an object", object)).chain(exchanged).collect()
        }
        Value::String(text) => {
            let number = text.parse::<f64>().ok().map(|number| ("a text as a number", json!(number)));
            [("a text as an object", json!({ text.as_str(): null })), ("a text as a list", json!([text]))]
                .into_iter()
                .chain(number)
                .collect()
        }
        Value::Number(number) => {
            vec![("a number as a text", json!(number.to_string())), ("a number as a list", json!([number]))]
        }
        Value::Bool(is_so) => {
            vec![("a flag as a text", json!(is_so.to_string())), ("a flag as a number", json!(u8::from(*is_so)))]
        }
        _ => Vec::new(),
    }
}
