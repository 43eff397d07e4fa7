//! The text on a picture of a sweep.

use impact_pair::json::{SceneDocument, SweepHead, Written};
use impact_pair::scene::{Key, Term};

use super::Drawn;
use crate::picture::{self, Canvas, Look, greek};

/// Draws title, parameters and method; returns their height.
pub fn caption(head: &SweepHead, (root, look): (&Canvas<'_>, &Look)) -> Drawn<i32> {
    let varied: Vec<String> = varied(head).map(|key| format!("${}$", key.symbol().0)).collect();
    let varied = format!("{} varied", varied.join(" and "));
    let title = head.title.as_ref().map_or(varied.clone(), |title| format!("{title}; {varied}"));
    let last = head.transient + head.impacts;
    let impacts = match head.impacts {
        1 => format!("impact {last}"),
        _ => format!("impacts {} to {last}", head.transient + 1),
    };
    let left_out = if head.transient > 0 { " (the transient before is left out)" } else { "" };
    let arithmetic = &head.arithmetic.kind;
    let certified = match (head.certified, head.claim) {
        (true, None) => format!("certified ({arithmetic}, {} digits)", head.digits),
        (true, Some(_)) => format!("certified ({} digits; chaos: one true orbit near each start)", head.digits),
        (false, _) => "floating point, not certified".into(),
    };
    let shown = format!("{} points, {impacts} of each{left_out}", head.points);
    let made = format!("{certified}; {}", head.program);
    picture::caption(root, look, &title, &[parameters(head), shown, made])
}

/// The parameters that vary.
fn varied(head: &SweepHead) -> impl Iterator<Item = Key> {
    head.over.iter().filter_map(|over| over.key.parse().ok())
}

/// The parameters and the start that do not vary.
fn parameters(head: &SweepHead) -> String {
    let varies = |keys: &[Key]| varied(head).any(|key| keys.contains(&key));
    let terms = |terms: &[Written], of: fn(Option<Term>) -> Key| {
        // Harmonics that vary are given by their symbols.
        let term = |(number, term): (u16, &Written)| {
            let key = of(Term::new(number));
            if varies(&[key]) { key.symbol().0 } else { term.0.text() }
        };
        let terms: Vec<String> = (1..).zip(terms).map(term).collect();
        Some(if terms.len() == 1 { terms.concat() } else { format!("({})", terms.join(", ")) })
    };
    let number = |number: &Written| Some(number.0.text());
    let SceneDocument { excitation, gap, restitution, start } = &head.scene;
    let entries = [
        ("A", terms(&excitation.amplitude, Key::Amplitude), &[Key::Amplitude(None)][..]),
        ("Ω", terms(&excitation.frequency, Key::Frequency), &[Key::Frequency(None)]),
        ("τ", terms(&excitation.phase, Key::Phase), &[Key::Phase(None)]),
        ("d", number(gap), &[Key::Gap]),
        ("e", number(restitution), &[Key::Restitution]),
        ("t₀", number(&start.time), &[Key::StartTime, Key::StartPhase]),
        ("y₀", start.position.as_ref().and_then(number), &[Key::StartPosition]),
        ("v₀", number(&start.velocity), &[Key::StartVelocity]),
    ];
    let shown = entries.into_iter().filter(|(_, _, keys)| !varies(keys));
    let mut words: Vec<String> =
        shown.filter_map(|(symbol, value, _)| Some(format!("{symbol} = {}", value?))).collect();
    if let Some(wall) = start.wall {
        words.push(format!("from the {} wall", wall.name()));
    }
    if excitation.frequency.len() > 1 {
        words.push("phases are those of the greatest Ω".to_owned());
    }
    greek(&words.join(", "))
}

/// Name, symbol and unit of a key.
pub fn described(key: Key) -> String {
    let name = match key {
        Key::Amplitude(_) => "amplitude of the box",
        Key::Frequency(_) => "angular frequency",
        Key::Phase(_) => "phase of the excitation",
        Key::Gap => "gap",
        Key::Restitution => "coefficient of restitution",
        Key::StartTime => "time of the start",
        Key::StartPhase => "phase at the start",
        Key::StartPosition => "relative displacement at the start",
        Key::StartVelocity => "relative velocity at the start",
    };
    match key.symbol() {
        (symbol, "") => format!("{name} ${symbol}$"),
        (symbol, unit) => format!("{name} ${symbol}$ [{unit}]"),
    }
}
