//! Starts that straddle the branches of the code, and motions of all kinds of scenes: what the library lists, in each arithmetic, against the
//! truth. The same starts are given to `check` by `tests/straddle`, and to Arb by `validation/arb`.

#[path = "../../../tests/straddle/starts.rs"]
mod starts;

use std::collections::BTreeMap;

use impact_pair::Scene;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use serde_json::{Value, json};

use crate::crossings::members::Member;
use crate::crossings::motion::{self, Halt};
use crate::crossings::scenes;
use crate::crossings::traits::{array, crossing};
use crate::random::{Random, cases};
use starts::{Dice, FAMILIES, case};

const ARITHMETICS: [Arithmetic; 6] = [
    Arithmetic::Interval,
    Arithmetic::Inari,
    Arithmetic::Bits(64),
    Arithmetic::Bits(256),
    Arithmetic::Bits(128),
    Arithmetic::Auto,
];

/// Findings on the listings of a family: right, open, refused, wrong.
#[derive(Default)]
struct Findings {
    counts: BTreeMap<String, [usize; 3]>,
    impacts: usize,
    wrong: Vec<String>,
}

impl Findings {
    /// What is listed of a scene in one of the arithmetics, by the motions of its members.
    fn add(&mut self, family: &str, scene: &Scene, text: &str, number: usize, impacts: u64, random: &mut Random) {
        let arithmetic = ARITHMETICS[number % ARITHMETICS.len()];
        let settings = Settings { arithmetic, impacts: Some(impacts), max_bits: 1024, ..Settings::default() };
        let counts = self.counts.entry(family.to_owned()).or_default();
        // Out of range, or of several harmonics in `inari`.
        let Ok(orbit) = Orbit::of(scene, settings).map(|mut orbit| orbit.document()) else {
            counts[2] += 1;
            return;
        };
        let listed = json!(orbit);
        self.impacts += listed["outcome"]["impacts"].as_u64().unwrap_or(0) as usize;
        for member in Member::all(scene, random) {
            match motion::judge(&listed, &member) {
                Ok(()) => counts[0] += 1,
                Err(Halt::Open(_)) => counts[1] += 1,
                Err(Halt::Wrong(words)) => self.wrong.push(format!("{family} in {arithmetic}: {words}\n{text}")),
            }
        }
    }

    fn judged(&self) {
        println!("family: right, open, refused: {:#?}; {} impacts", self.counts, self.impacts);
        let wrong = &self.wrong;
        assert!(wrong.is_empty(), "{} are wrong:\n{}", wrong.len(), wrong[..wrong.len().min(8)].join("\n"));
        // A judge that is never asked, or never tells, would pass anything.
        let [right, open, refused] = [0, 1, 2].map(|i| self.counts.values().map(|counts| counts[i]).sum::<usize>());
        assert!(right > 4 * open && right > 4 * refused, "{right} right, {open} open, {refused} refused");
    }
}

#[test]
fn impacts_near_branch_boundaries_are_right() {
    let (mut random, mut findings) = (Random::seeded(1101), Findings::default());
    for number in 0..cases(2_000) {
        let case = case(&mut Dice(random.bits()), number as u64);
        // What the truth is allowed to be off is of units about one: in others `check` and Arb judge.
        if ["1e-280", "1e290", "1e-290", "1e280"].iter().any(|unit| case.text.contains(unit)) {
            continue;
        }
        findings.add(case.family, &case.scene, &case.text, number / FAMILIES.len(), case.impacts, &mut random);
    }
    findings.judged();
}

/// Scenes of the crossings, followed for longer, and every fifth of the random ones that Arb is given.
#[test]
fn long_motions_hold_the_truth() {
    let (mut random, mut findings) = (Random::seeded(201), Findings::default());
    let array = array(random.bits());
    for number in 0..cases(1_600) {
        let crossing = crossing(&array, number as u64);
        let Some(case) = scenes::case(crossing, Random::new(random.bits())) else { continue };
        findings.add(&format!("{:?}", crossing.start), &case.scene, &case.text, number, 30, &mut random);
    }
    let recorded = include_str!("../../arb/random.jsonl").lines().enumerate();
    for (number, line) in recorded.step_by(if cases(8) > 1 { 1 } else { 5 }) {
        let line: Value = serde_json::from_str(line).unwrap();
        let [family, text] = ["family", "scene"].map(|key| line[key].as_str().unwrap());
        findings.add(family, &Scene::parse(text).unwrap(), text, number / 5, 30, &mut random);
    }
    findings.judged();
    assert!(findings.impacts > cases(10_000), "{} impacts", findings.impacts);
}
