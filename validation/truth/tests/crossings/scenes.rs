//! A scene with the traits of a crossing: exact expressions drawn at random, at the corners of each class.

use impact_pair::Scene;
use impact_pair::exact::Exact;

use super::traits::{Crossing, Data, Excitation, Question, Restitution, Start};
use crate::random::Random;

/// Amplitude, frequency and gap near the fold of `LR` in one cycle, for `e = 1/2`: `A/d = 1/sqrt(4 + 9 pi^2)` (Lemma W2).
pub const NEAR_FOLD: [&str; 3] = ["1", "pi", "9.42497"];

/// A scene with its crossing.
pub struct Case {
    pub crossing: Crossing,
    /// The scene file.
    pub text: String,
    pub scene: Scene,
    /// The random numbers from which the question is drawn.
    pub random: Random,
}

/// A term of the excitation, in expressions.
#[derive(Clone)]
struct Term {
    amplitude: String,
    /// Its greatest value, where it is an interval.
    most: String,
    frequency: String,
    phase: String,
}

/// The data of a scene, in expressions.
struct Parts {
    terms: Vec<Term>,
    gap: String,
    restitution: String,
    time: String,
    wall: Option<&'static str>,
    position: String,
    velocity: String,
}

/// A, W and d: the paper's figures, and boxes that hardly move.
const SIZES: &str = "8 pi 9.42497; 8 pi 9.42497; 2 pi 9.42497; 2 10*pi 1; 10 200*pi 10; 1 2*pi 1; \
    0.9 2*pi 1; 0.1 2*pi 1; 0.05 2*pi 1; 1/2 1 6; 1/1000 2*pi 1; 3 3/2 4";

/// A, W and d of pairs of which orbits are attracted for `e = 1/2`, of 1, 2 and 16 impacts of the reduced map: found in floating point.
const ATTRACTED_PAIRS: &str = "0.25 2*pi 1; 3/2 pi 6; 0.36 2*pi 1; 0.45 3 1; 0.9 2*pi 1; 6/5 1 2";

/// Number of leading kinds of boxes that move by about a gap.
const STRONGLY_SHAKEN: usize = 7;

impl Random {
    /// `10^-k` or a power of two as small.
    pub fn small(&mut self, least: u64, most: u64) -> String {
        let k = least + self.below(most - least + 1);
        if self.below(3) == 0 { format!("1/2^{}", 10 * k / 3) } else { format!("1/10^{k}") }
    }

    /// Nothing, or a little more or less.
    fn offset(&mut self) -> String {
        match self.below(3) {
            0 => String::new(),
            1 => format!("+{}", self.small(4, 40)),
            _ => format!("-{}", self.small(4, 40)),
        }
    }
}

/// Approximate value of an expression.
pub fn value(text: &str) -> Option<f64> {
    Some(Exact::parse(text).ok()?.enclose(64).mid_rad().0)
}

impl Term {
    fn angle(&self, time: &str) -> String {
        format!("({})*({time})+({})", self.frequency, self.phase)
    }
}

/// The sum over terms of `A W^power` times a function of the phase at a time.
fn sum(terms: &[Term], time: &str, power: u32, function: &str) -> String {
    let one = |term: &Term| format!("({})*({})^{power}*{function}({})", term.most, term.frequency, term.angle(time));
    terms.iter().map(one).collect::<Vec<_>>().join("+")
}

fn excitation(random: &mut Random, kind: Excitation, size: [&str; 3]) -> Vec<Term> {
    let [amplitude, frequency, _] = size.map(str::to_owned);
    let phase = random.pick(&["0", "0", "pi", "pi/2", "0.3", "pi/5"]).to_owned();
    let one = Term { most: amplitude.clone(), amplitude, frequency, phase };
    let second = |random: &mut Random, ratio: &str| {
        let most = format!("{}*{}", one.amplitude, random.pick(&["1/3", "1/10", "1/1000", "1"]));
        let phase = if random.below(2) == 0 { one.phase.clone() } else { "pi/3".into() };
        Term { amplitude: most.clone(), most, frequency: format!("{}*{ratio}", one.frequency), phase }
    };
    match kind {
        Excitation::One => vec![one],
        Excitation::Unshaken => vec![Term { amplitude: "0".into(), most: "0".into(), ..one }],
        Excitation::Commensurate => {
            let ratio = random.pick(&["2", "3", "1/2", "3/2"]);
            vec![one.clone(), second(random, ratio)]
        }
        Excitation::Incommensurate => {
            let ratio = random.pick(&["sqrt(2)", "(1+sqrt(5))/2", "sqrt(3)/3"]);
            vec![one.clone(), second(random, ratio)]
        }
        Excitation::MayVanish => {
            let vanishes = |term: Term, most: String| Term { amplitude: format!("[0, {most}]"), most, ..term };
            match random.below(3) {
                0 => vec![vanishes(one.clone(), format!("{}*{}", one.most, random.small(0, 14)))],
                1 => {
                    let (ratio, small) = (random.pick(&["2", "3", "sqrt(2)"]), random.small(1, 14));
                    let term = second(random, ratio);
                    vec![one.clone(), vanishes(term.clone(), format!("{}*{small}", term.most))]
                }
                // A sweep over its amplitude begins at 0.
                _ => vec![one.clone(), second(random, "3")],
            }
        }
    }
}

/// A time, in periods of the first term now and then.
fn time(random: &mut Random, terms: &[Term]) -> String {
    match random.below(6) {
        0 | 1 => "0".into(),
        2 => "1/3".into(),
        3 => format!("{}/37", random.below(74)),
        4 => format!("{}*2*pi/({})", random.pick(&["1/4", "1/2", "3", "-5/4"]), terms[0].frequency),
        _ => random.pick(&["2^40", "-2^20+1/7", "10^6"]).into(),
    }
}

/// Draws a start on a wall before an impact, slow or fast.
fn on_wall(random: &mut Random, parts: &mut Parts) {
    parts.time = time(random, &parts.terms);
    let speed = match random.below(4) {
        0 => random.small(1, 30),
        _ => format!("{}/7*({})", 1 + random.below(20), scale(&parts.terms)),
    };
    push(random, parts, &speed);
}

/// Draws a start on one of the walls, towards it.
fn push(random: &mut Random, parts: &mut Parts, speed: &str) {
    let (wall, sign) = random.pick(&[("left", "-"), ("right", "")]);
    (parts.wall, parts.velocity) = (Some(wall), format!("{sign}({speed})"));
}

/// `A W`, or the speed of a gap in a unit of time.
fn scale(terms: &[Term]) -> String {
    if terms[0].most == "0" { "1".into() } else { format!("{}*{}", terms[0].most, terms[0].frequency) }
}

/// Draws a start on a wall with no velocity and a contact force on it.
fn at_rest(random: &mut Random, parts: &mut Parts) -> Option<()> {
    parts.time = time(random, &parts.terms);
    let pressure = value(&sum(&parts.terms, &parts.time, 2, "sin"))?;
    let is_right = if pressure == 0.0 { random.below(2) == 0 } else { pressure > 0.0 };
    (parts.wall, parts.velocity) = (Some(if is_right { "right" } else { "left" }), "0".into());
    Some(())
}

/// Draws a start with no velocity at the very phase at which the contact force ends: all terms at 0 on the left, at pi on the right.
fn at_release(random: &mut Random, parts: &mut Parts) {
    let (wall, phase) = random.pick(&[("left", "0"), ("right", "pi")]);
    parts.terms.iter_mut().for_each(|term| term.phase = phase.into());
    parts.time = match &parts.terms[..] {
        [one] => format!("{}*2*pi/({})", random.pick(&["0", "1", "-3", "2^30"]), one.frequency),
        _ => "0".into(),
    };
    parts.time += &if random.below(4) == 0 { random.offset() } else { String::new() };
    (parts.wall, parts.velocity) = (Some(wall), "0".into());
}

fn place(random: &mut Random, parts: &mut Parts) {
    parts.wall = None;
    parts.position = match random.below(4) {
        0 => "0".into(),
        1 => format!("{}(({})/2-{})", random.pick(&["", "-"]), parts.gap, random.small(1, 20)),
        _ => format!("({})*{}/40", parts.gap, random.below(39) as i64 - 19),
    };
}

/// Draws a start inside the gap; now and then with hardly any drift.
fn inside(random: &mut Random, parts: &mut Parts) {
    parts.time = time(random, &parts.terms);
    place(random, parts);
    parts.velocity = match random.below(3) {
        0 => format!("{}-({})", random.small(1, 12), sum(&parts.terms, &parts.time, 1, "cos")),
        _ => format!("({})*{}/10", scale(&parts.terms), random.below(41) as i64 - 20),
    };
}

/// Draws a start without any drift.
fn still(random: &mut Random, parts: &mut Parts) {
    parts.time = time(random, &parts.terms);
    place(random, parts);
    parts.velocity = format!("-({})", sum(&parts.terms, &parts.time, 1, "cos"));
}

/// Inside the gap with a velocity of which enclosures do not say the sign: 0 in disguise, or nearly none.
fn uncertain(random: &mut Random, parts: &mut Parts) {
    parts.time = random.pick(&["1/3", "1.3", "0", "5/7"]).into();
    place(random, parts);
    parts.velocity = random.pick(&["cos(pi/5)-cos(2*pi/5)-1/2", "[-1e-13, 1e-13]", "sqrt(2)*sqrt(3)-sqrt(6)"]).into();
}

/// An extremum at a random phase after the start touches a wall, exactly or nearly.
fn at_graze(random: &mut Random, parts: &mut Parts) {
    parts.time = random.pick(&["0", "1/3", "1/7"]).into();
    if parts.terms[0].most == "0" {
        place(random, parts);
        parts.velocity = "0".into();
        return;
    }
    let (terms, start) = (&parts.terms, &parts.time);
    let later = match random.below(3) {
        // The extremum of a motion without drift.
        0 => format!("({}*pi-({}))/({})", random.pick(&["1/2", "3/2"]), terms[0].phase, terms[0].frequency),
        _ => format!("{start}+{}/5/({})", 1 + random.below(60), terms[0].frequency),
    };
    let drift = format!("({})", sum(terms, &later, 1, "cos"));
    let velocity = format!("{drift}-({})", sum(terms, start, 1, "cos"));
    let travel =
        format!("{drift}*({later}-({start}))-({}-({}))", sum(terms, &later, 0, "sin"), sum(terms, start, 0, "sin"));
    let is_made_for_it = parts.restitution == "1/2" || parts.restitution == "1";
    let is_from_left = value(&velocity).is_some_and(|v| v > 1e-9) && value(&travel).is_some_and(|travel| travel > 1e-9);
    if is_made_for_it && is_from_left && random.below(2) == 0 {
        parts.gap = format!("{travel}{}", random.offset());
        (parts.wall, parts.velocity) = (Some("left"), format!("-({velocity})/({})", parts.restitution));
        return;
    }
    let wall = random.pick(&["", "-"]);
    parts.position = format!("{wall}({})/2-({travel}){}", parts.gap, random.offset());
    (parts.wall, parts.velocity) = (None, velocity);
}

/// An interval from a value on, so wide, to the side where there is no other limit.
fn widened(random: &mut Random, parts: &mut Parts, data: Data) {
    let width = random.small(2, 16);
    match data {
        Data::Points => {}
        Data::Gap => parts.gap = format!("[{}, {}+{width}]", parts.gap, parts.gap),
        Data::Velocity if parts.velocity.starts_with('[') => {}
        Data::Velocity => {
            let (low, high) = match parts.wall {
                Some("left") => (format!("-{width}"), String::new()),
                Some(_) => (String::new(), format!("+{width}")),
                None => (format!("-{width}"), format!("+{width}")),
            };
            parts.velocity = format!("[{}{low}, {}{high}]", parts.velocity, parts.velocity);
        }
    }
}

fn restitution(random: &mut Random, kind: Restitution) -> &'static str {
    match kind {
        Restitution::Zero => "0",
        Restitution::AroundZero => random.pick(&["[0, 1/1000]", "[0, 1e-12]", "1e-30", "1/1000"]),
        Restitution::Half => "1/2",
        Restitution::AroundHalf => "[1/2-1e-9, 1/2+1e-9]",
        Restitution::One => "1",
    }
}

fn triples(table: &'static str) -> Vec<[&'static str; 3]> {
    table.split("; ").map(|row| row.split(' ').collect::<Vec<_>>().try_into().expect("three numbers")).collect()
}

fn parts(random: &mut Random, crossing: &Crossing) -> Option<Parts> {
    let sizes = triples(SIZES);
    let size = match crossing.question {
        Question::Chaos => sizes[0],
        // Of a box that hardly moves flights are too long for images of boxes.
        Question::BoxMap => random.pick(&sizes[..STRONGLY_SHAKEN]),
        Question::Bifurcations(_) if matches!(crossing.restitution, Restitution::Half | Restitution::AroundHalf) => {
            NEAR_FOLD
        }
        // Figure 12's pair attracts.
        Question::Describe | Question::ChaosCells
            if matches!(crossing.restitution, Restitution::Half | Restitution::AroundHalf) =>
        {
            NEAR_FOLD
        }
        Question::Attractors if matches!(crossing.restitution, Restitution::Half | Restitution::AroundHalf) => {
            random.pick(&triples(ATTRACTED_PAIRS))
        }
        Question::Impacts("shadow" | "splice") if random.below(2) == 0 => sizes[0],
        _ => random.pick(&sizes),
    };
    let terms = excitation(random, crossing.excitation, size);
    let (gap, restitution) = (size[2].to_owned(), restitution(random, crossing.restitution).to_owned());
    let [time, position, velocity] = [const { String::new() }; 3];
    let mut parts = Parts { terms, gap, restitution, time, wall: None, position, velocity };
    match crossing.start {
        Start::OnWall => on_wall(random, &mut parts),
        Start::AtRest => at_rest(random, &mut parts)?,
        Start::Release => at_release(random, &mut parts),
        Start::Inside => inside(random, &mut parts),
        Start::Still => still(random, &mut parts),
        Start::Uncertain => uncertain(random, &mut parts),
        Start::AtGraze => at_graze(random, &mut parts),
    }
    widened(random, &mut parts, crossing.data);
    Some(parts)
}

impl Parts {
    fn text(&self) -> String {
        let list = |of: fn(&Term) -> &String| {
            let all: Vec<_> = self.terms.iter().map(|term| format!("\"{}\"", of(term))).collect();
            if all.len() == 1 { all[0].clone() } else { format!("[{}]", all.join(", ")) }
        };
        let start = match self.wall {
            Some(wall) => format!("wall = \"{wall}\""),
            None => format!("position = \"{}\"", self.position),
        };
        format!(
            "excitation = {{ amplitude = {}, frequency = {}, phase = {} }}\n\
             pair = {{ gap = \"{}\", restitution = \"{}\" }}\n\
             start = {{ time = \"{}\", {start}, velocity = \"{}\" }}\n",
            list(|term| &term.amplitude),
            list(|term| &term.frequency),
            list(|term| &term.phase),
            self.gap,
            self.restitution,
            self.time,
            self.velocity,
        )
    }
}

/// Draws that may be no scenes: a position beyond the gap, a velocity away from the wall.
const MAX_DRAWS: u32 = 60;

/// A scene of a crossing; `None` where none of the draws is one.
pub fn case(crossing: Crossing, mut random: Random) -> Option<Case> {
    for _ in 0..MAX_DRAWS {
        let Some(parts) = parts(&mut random, &crossing) else { continue };
        let text = parts.text();
        if let Ok(scene) = Scene::parse(&text) {
            return Some(Case { crossing, text, scene, random });
        }
    }
    None
}
