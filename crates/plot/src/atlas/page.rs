//! The page: a self-contained HTML file, in which each point or cell shows its proved results and how to prove them again.

use std::fmt::Write;

use anyhow::{Context, Result};
use impact_pair::chaos::GlobalSettings;
use impact_pair::json::{AtlasHead, ComponentDocument, PeriodDocument, SceneDocument, counted};
use serde_json::{Value, json};

use super::leaves::{CLASSES, Leaf, Leaves};
use super::map::{SIZE, drawn};
use crate::picture::{Look, Theme, hex, program};
use impact_pair_answers::grid::Points;

/// The page without its data; `{{NAME}}` is a placeholder.
const PAGE: &str = include_str!("page.html");

/// The page.
///
/// # Errors
/// Returns an error if the picture cannot be drawn, or the atlas cannot be read.
pub fn html(atlas: &mut Points<AtlasHead>) -> Result<String> {
    let leaves = Leaves::of(atlas)?;
    let head = &atlas.head;
    let look = |theme: Theme| Look { theme, ..Look::default() };
    let (svg, place) = drawn(head, &leaves, &Look::default())?;
    let [light, dark] = [Theme::Light, Theme::Dark].map(|theme| look(theme).of(&svg));
    let title = format!("{}: where every motion goes", head.title.as_deref().unwrap_or("The impact pair"));
    let data = json!({
        "keys": leaves.axes.each_ref().map(|axis| axis.key().to_string()),
        "range": leaves.range(),
        "place": place,
        "classes": CLASSES.map(|(name, colour, words)| json!({ "name": name, "colour": hex(colour), "words": words })),
        "leaves": leaves.all.iter().map(|leaf| leaf_text(head, leaf)).collect::<Result<Vec<_>>>()?,
        "command": format!("impact-pair global - {} <<'END'", settings(head)),
    });
    // No HTML tag can end within the data.
    let data = serde_json::to_string(&data)?.replace('<', "\\u003c");
    let parts = [
        ("TITLE", escaped(&title)),
        ("LIGHT", uri(&light)),
        ("DARK", uri(&dark)),
        ("WIDTH", SIZE.0.to_string()),
        ("HEIGHT", SIZE.1.to_string()),
        ("PROGRAM", escaped(&program())),
        ("TABLE", table(head, &leaves)),
        ("DATA", data),
    ];
    let mut page = String::new();
    for (i, piece) in PAGE.split("{{").enumerate() {
        let (name, rest) = if i == 0 { ("", piece) } else { piece.split_once("}}").context("the page is broken")? };
        page.extend(parts.iter().filter(|(own, _)| *own == name).map(|(_, text)| text.as_str()));
        page += rest;
    }
    Ok(page)
}

/// The data of a point or a cell on the page: class, components, their order, and the scene.
fn leaf_text(head: &AtlasHead, leaf: &Leaf) -> Result<Value> {
    let global = leaf.record.global(head).context("an axis is no parameter of the scene")?;
    Ok(json!({
        "ends": leaf.ends,
        "values": leaf.record.values,
        "class": leaf.class,
        "statement": global.statement,
        "components": leaf.record.components.iter().map(component).collect::<Vec<_>>(),
        "order": leaf.record.order,
        "stable": leaf.record.stable.iter().map(orbit).collect::<Vec<_>>(),
        "seconds": leaf.record.seconds,
        "scene": toml(&global.scene),
    }))
}

/// A stable periodic orbit in words.
fn orbit(own: &PeriodDocument) -> String {
    let [impacts, cycles] = [counted(own.impacts, "impact"), counted(own.cycles, "forcing period")];
    format!("stable periodic orbit {}, {impacts} in {cycles}", own.word)
}

/// A component in words.
fn component(own: &ComponentDocument) -> String {
    let mut words = own.kind.to_string();
    if let Some(impacts) = own.reduced_impacts {
        let _ = write!(words, ", period {impacts} of the reduced map");
    }
    if let Some(word) = &own.word {
        let _ = write!(words, ", word {word}");
    }
    if let Some(cycles) = own.cycles {
        let _ = write!(words, ", {}", counted(cycles, "forcing period"));
    }
    if let Some([low, high]) = own.spectral_radius.as_deref() {
        let _ = write!(words, ", spectral radius in [{}, {}]", low.text(), high.text());
    }
    if own.boxes > 0 {
        let area = match own.area.text() {
            "0.000000" => "below 0.000001".to_owned(),
            area => area.to_owned(),
        };
        let boxes = if own.boxes == 1 { "box" } else { "boxes" };
        let _ = write!(words, ", {} {boxes}, area {area}", own.boxes);
    }
    if let Some(horseshoe) = &own.horseshoe {
        let _ = write!(words, ", horseshoe of entropy {}", horseshoe.entropy.per_impact.text());
    }
    if own.closed { words + ", closed" } else { words }
}

/// A scene file of these parameters.
fn toml(scene: &SceneDocument) -> String {
    let list = |terms: &[impact_pair::json::Written]| {
        let terms: Vec<String> = terms.iter().map(|term| format!("\"{}\"", term.0)).collect();
        if terms.len() == 1 { terms.concat() } else { format!("[{}]", terms.join(", ")) }
    };
    let SceneDocument { excitation, gap, restitution, start } = scene;
    let mut text = format!(
        "excitation = {{ amplitude = {}, frequency = {}, phase = {} }}\npair = {{ gap = \"{}\", restitution = \"{}\" }}\n",
        list(&excitation.amplitude),
        list(&excitation.frequency),
        list(&excitation.phase),
        gap.0,
        restitution.0
    );
    let place = match (&start.position, start.wall) {
        (Some(position), _) => format!("position = \"{}\"", position.0),
        (None, Some(wall)) => format!("wall = \"{}\"", wall.name()),
        (None, None) => String::new(),
    };
    let _ = writeln!(text, "start = {{ time = \"{}\", {place}, velocity = \"{}\" }}", start.time.0, start.velocity.0);
    text
}

/// The options with which `global` maps as many boxes as the atlas for a point or a cell; it may halve them more often.
fn settings(head: &AtlasHead) -> String {
    let horseshoes = head.horseshoes.map_or(String::new(), |depth| format!(" --horseshoes {depth}"));
    let effort = head.most as f64 / GlobalSettings::default().most as f64; // shown
    format!("--effort {effort} --digits {}{horseshoes}", head.digits)
}

/// All points or cells as the rows of a table.
fn table(head: &AtlasHead, leaves: &Leaves) -> String {
    let mut text = String::from("<thead><tr>");
    let names = leaves.axes.iter().map(|axis| axis.key().to_string());
    let counts = ["class", "attracting", "with rests", "saddles", "undecided"].map(str::to_owned);
    for name in names.chain(counts) {
        let _ = write!(text, "<th scope=\"col\">{}</th>", escaped(&name));
    }
    text += "</tr></thead>\n<tbody>\n";
    for Leaf { record, .. } in &leaves.all {
        let counts = [record.n_attracting, record.n_rest, record.n_saddle, record.n_undecided];
        let cells =
            record.values.iter().cloned().chain([record.class.to_string()]).chain(counts.map(|n| n.to_string()));
        let cells: String = cells.map(|cell| format!("<td>{}</td>", escaped(&cell))).collect();
        let _ = writeln!(text, "<tr>{cells}</tr>");
    }
    let _ = write!(text, "</tbody><caption>{}</caption>", escaped(&format!("{} records", head.points)));
    text
}

/// Text with HTML's special characters escaped.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A picture as a `data:` address.
fn uri(svg: &str) -> String {
    let mut text = String::from("data:image/svg+xml,");
    for byte in svg.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b' ' | b'-' | b'.' | b'/' | b':' | b'=' => {
                text.push(char::from(byte))
            }
            // Writing to a String cannot fail.
            _ => drop(write!(text, "%{byte:02X}")),
        }
    }
    text
}
