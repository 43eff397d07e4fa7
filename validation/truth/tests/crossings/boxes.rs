//! Images of boxes: the next impact of a true motion with an impact in a box is in the image of the box (Lemma D33).

use impact_pair::chaos::{BoxImage, BoxMap, Rectangle, Unmapped};
use impact_pair::{Error, Scene};
use impact_pair_truth::{Contact, Wall, float};
use rug::Float;
use rug::float::Constant;

use super::members::Member;
use super::motion::{Compared, Halt, Motion, shown, wrong};
use super::questions::Answer;
use super::scenes::Case;

/// Impacts of a motion that have boxes, and that are looked at.
const IMPACTS: usize = 6;
/// Error allowed in the independent simulator, in forcing periods and in `A W`.
const SIMULATOR_TOLERANCE: f64 = 1e-60;

/// A box, and its claimed image.
pub struct Mapped {
    rect: Rectangle,
    image: Result<BoxImage, Unmapped>,
}

/// An impact in reduced coordinates, mirrored to the left wall, and whether no rest was on the way to it.
struct Reduced {
    phase: Float,
    speed: Float,
    is_flight: bool,
    contact: Contact,
}

/// A number modulo 1.
fn modulo_1(x: Float) -> Float {
    let whole = float(x.floor_ref());
    x - whole
}

/// The first impacts of a motion, as far as the truth follows it.
fn impacts(member: &Member) -> Vec<Reduced> {
    let tone = &member.tones[0];
    let fastest = float(&tone.amplitude * &tone.frequency);
    let mut motion = Motion::new(&member.shaken, member.start.clone());
    let mut found = Vec::new();
    while found.len() < IMPACTS {
        let mut releases = Vec::new();
        let Ok(Some(contact)) = motion.contact(&mut releases) else { break };
        let angle = float(&tone.frequency * &contact.time) + &tone.phase;
        let lead = if contact.wall == Wall::Right { 0.5 } else { 0.0 };
        let phase = modulo_1(float(angle / (float(Constant::Pi) * 2)) + lead);
        let speed = float(contact.velocity_before.abs_ref()) / &fastest;
        found.push(Reduced { phase, speed, is_flight: releases.is_empty(), contact });
    }
    found
}

/// Whether a state is in a rectangle, whose phases are modulo 1; `at_edge` is the answer at its edge.
fn holds(rect: &Rectangle, state: &Reduced, at_edge: bool) -> bool {
    let slack = if at_edge { SIMULATOR_TOLERANCE } else { 0.0 };
    let [[low, high], [slow, fast]] = [rect.phase, rect.speed];
    let beyond = float(&state.phase - float(low)) + slack;
    modulo_1(beyond) <= float(high) - float(low) + 2.0 * slack
        && float(&state.speed - float(slow)) >= -slack
        && float(&state.speed - float(fast)) <= slack
}

impl Case {
    /// Takes the harmonics after the first one away, and lets that one shake, as there is no reduced map under several or none: most of the
    /// scenes are to have one.
    pub fn keep_one_harmonic(&mut self) {
        let terms = self.scene.pair().excitation().terms();
        let [frequency, phase] = [terms[0].frequency().to_string(), terms[0].phase().to_string()];
        let is_shaken = terms[0].amplitude().enclose(64).to_f64_bounds().0 > 0.0;
        if terms.len() == 1 && is_shaken {
            return;
        }
        let amplitude = if is_shaken { terms[0].amplitude().to_string() } else { self.random.pick(&["1", "8"]).into() };
        let (_, rest) = self.text.split_once('\n').expect("a line of the excitation");
        let text = format!(
            "excitation = {{ amplitude = \"{amplitude}\", frequency = \"{frequency}\", phase = \"{phase}\" }}\n{rest}"
        );
        if let Ok(scene) = Scene::parse(&text) {
            (self.text, self.scene) = (text, scene);
        }
    }

    /// The images of boxes around impacts of the motion in the middle of the data.
    pub fn box_map(&mut self) -> Result<Answer, Error> {
        if self.random.below(8) > 0 {
            self.keep_one_harmonic();
        }
        let map = BoxMap::new(self.scene.pair(), self.random.pick(&[16, 256, 4096]))?;
        let mut images = Vec::new();
        for state in impacts(&Member::new(&self.scene, || 0.5)) {
            let width = self.random.pick(&[0.0, 1e-12, 1e-3, 0.1]);
            let mut around = |x: f64| [x - self.random.uniform(0.0, width), x + self.random.uniform(0.0, width)];
            let (phase, speed) = (around(state.phase.to_f64()), around(state.speed.to_f64()));
            let rect = Rectangle { phase, speed: speed.map(|speed| speed.max(0.0)) };
            if let Some(image) = map.image(&rect) {
                images.push(Mapped { rect, image });
            }
        }
        Ok(Answer::Boxes(images))
    }
}

/// Checks that no impact of this member that follows one in a box is outside of the image.
pub fn judge(images: &[Mapped], member: &Member) -> Compared<()> {
    let states = impacts(member);
    let mut judged = 0;
    for pair in states.windows(2).filter(|pair| pair[1].is_flight) {
        for Mapped { rect, image } in images.iter().filter(|mapped| holds(&mapped.rect, &pair[0], false)) {
            let Ok(image) = image else { continue };
            let is_near = pair[0].contact.wall == pair[1].contact.wall;
            let of_wall = if is_near { image.near } else { image.far };
            if ![of_wall, image.hull].iter().all(|part| part.is_some_and(|part| holds(&part, &pair[1], true))) {
                return wrong(format!("{rect:?} goes to {image:?}, but the truth is {}", shown(&pair[1].contact)));
            }
            judged += 1;
        }
    }
    if judged > 0 { Ok(()) } else { Err(Halt::Open("no flight from a box with an image")) }
}

/// The outcome in words: whether any image is bounded.
pub fn outcome(images: &[Mapped]) -> &'static str {
    match images.iter().filter(|mapped| mapped.image.is_ok()).count() {
        0 => "no image",
        _ => "images of boxes",
    }
}
