//! First flights put to the library through its public orbit and judged by the truth: right, wrong or undecided, and
//! how long each took.
#![allow(dead_code)] // each test crate uses a part

use super::aim::BITS;
use super::displacement;
use super::scene::{Scene, objection};
use impact_pair::orbit::{Arithmetic, Orbit, Outcome, Settings};
use impact_pair_truth::{Contact, Truth, Wall, first_contact};
use rug::Float;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// An extremum near a wall.
#[derive(Clone, Debug)]
pub struct Graze {
    pub wall: Wall,
    /// The time of the extremum, whether or not the wall is in the way.
    pub time: Float,
    /// Height of the extremum beyond the wall; negative where it falls short of it.
    pub past: Float,
}

/// One flight, and what makes it hard.
#[derive(Clone, Debug)]
pub struct Question {
    pub family: &'static str,
    /// The hardness is 10 to this power: a depth, a short time, a number of forcing periods.
    pub exponent: i32,
    pub scene: Scene,
    pub graze: Option<Graze>,
}

impl Question {
    /// The true first contact; a truth that decides nothing is a fault of the test.
    pub fn truth(&self) -> Contact {
        let (problem, start) = self.scene.question(BITS, [0.0; 5]);
        match first_contact(&problem, &start) {
            Truth::Contact { time, wall, velocity_before } => Contact { time, wall, velocity_before },
            other => panic!("the truth says {other:?}: {self:?}"),
        }
    }

    /// Asserts that the flight is as hard as claimed, by eq. (11) and by the truth's contact: the extremum is one,
    /// `past` beyond the wall within a tenth, and the contact comes just before it there, or after it.
    fn assert_graze(&self, graze: &Graze, truth: &Contact) {
        let (problem, start) = self.scene.question(BITS, [0.0; 5]);
        let past =
            |time: &Float| displacement(&problem, &start, time) * graze.wall.sign() - problem.wall_at(Wall::Right);
        let at_top = past(&graze.time);
        let claimed = Float::with_val(64, graze.past.abs_ref());
        let off = Float::with_val(64, &at_top - &graze.past).abs();
        assert!(off < claimed / 10, "not {} but {at_top:.20} past: {self:?}", graze.past.to_f64());
        let soon = Float::with_val(BITS, 1e-10) / &problem.omega;
        for beside in [Float::with_val(BITS, &graze.time - &soon), Float::with_val(BITS, &graze.time + &soon)] {
            assert!(past(&beside) < at_top, "no extremum: {self:?}");
        }
        let touches = graze.past > 0;
        assert_eq!(touches, truth.time < graze.time, "the contact is at {:.20}: {self:?}", truth.time);
        assert!(!touches || truth.wall == graze.wall, "{self:?}");
    }
}

/// The verdict on the library's answer for a flight.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    Right,
    Undecided(String),
    Wrong(String),
}

/// Asks the library for the first impact; the time is that of `Orbit::new` and `next`.
pub fn ask(question: &Question, truth: &Contact) -> (Answer, Duration) {
    let (pair, start) = question.scene.library().unwrap_or_else(|error| panic!("{error}: {question:?}"));
    let settings = Settings { impacts: Some(1), digits: 9, arithmetic: Arithmetic::Auto, ..Settings::default() };
    let clock = Instant::now();
    let answer = catch_unwind(AssertUnwindSafe(|| {
        let mut orbit = Orbit::new(&pair, &start, settings)?;
        let impact = orbit.next();
        Ok::<_, impact_pair::Error>((orbit, impact))
    }));
    let elapsed = clock.elapsed();
    let answer = match answer {
        Err(_) => Answer::Wrong("a panic".into()),
        Ok(Err(error)) => Answer::Wrong(format!("refused: {error}")),
        Ok(Ok((orbit, None))) => match orbit.outcome() {
            Some(Outcome::Undecided { reason, wall, .. }) => Answer::Undecided(format!("{reason:?} {wall:?}")),
            other => Answer::Wrong(format!("no impact, but {other:?}")),
        },
        Ok(Ok((orbit, Some(impact)))) => match objection(&orbit, &[impact], std::slice::from_ref(truth)) {
            None => Answer::Right,
            Some(objection) => Answer::Wrong(objection),
        },
    };
    (answer, elapsed)
}

/// The answers to a family of questions.
#[derive(Default)]
struct Family {
    right: usize,
    wrong: usize,
    /// Asked and undecided, for each exponent.
    levels: BTreeMap<i32, (usize, usize)>,
    times: Vec<Duration>,
}

/// All the answers, by family.
#[derive(Default)]
pub struct Report {
    families: Vec<(&'static str, Family)>,
    slowest: Vec<(Duration, String)>,
    pub wrong: Vec<String>,
    pub undecided: Vec<String>,
    pub requested: usize,
}

impl Report {
    /// Checks that the question is what it claims, asks it and counts the answer.
    pub fn put(&mut self, question: &Question) {
        let truth = question.truth();
        if let Some(graze) = &question.graze {
            question.assert_graze(graze, &truth);
        }
        let (answer, elapsed) = ask(question, &truth);
        self.requested += 1;
        let place = self.families.iter().position(|(name, _)| *name == question.family).unwrap_or_else(|| {
            self.families.push((question.family, Family::default()));
            self.families.len() - 1
        });
        let family = &mut self.families[place].1;
        family.times.push(elapsed);
        let level = family.levels.entry(question.exponent).or_default();
        level.0 += 1;
        let line = |what: &str| format!("{what}: {} 1e{}: {:?}", question.family, question.exponent, question.scene);
        self.slowest.push((elapsed, line(&format!("{elapsed:?}"))));
        match answer {
            Answer::Right => family.right += 1,
            Answer::Undecided(why) => {
                level.1 += 1;
                self.undecided.push(line(&why));
            }
            Answer::Wrong(why) => {
                family.wrong += 1;
                self.wrong.push(line(&why));
            }
        }
    }

    /// Prints counts and times for each family, the undecided ones for each exponent, and the slowest flights.
    pub fn print(&mut self) {
        println!("| family | asked | right | wrong | undecided | median us | 90 % | 99 % | slowest |");
        println!("|---|---|---|---|---|---|---|---|---|");
        for (name, family) in &mut self.families {
            family.times.sort();
            let last = family.times.len() - 1;
            let [median, most, nearly_all, slowest] =
                [0.5, 0.9, 0.99, 1.0].map(|part| family.times[(last as f64 * part) as usize].as_secs_f64() * 1e6);
            let undecided: usize = family.levels.values().map(|level| level.1).sum();
            println!(
                "| {name} | {} | {} | {} | {undecided} | {median:.1} | {most:.1} | {nearly_all:.1} | {slowest:.1} |",
                last + 1,
                family.right,
                family.wrong,
            );
        }
        for (name, family) in &self.families {
            let levels = family.levels.iter().rev();
            let counts: Vec<_> =
                levels.map(|(exponent, (requested, open))| format!("1e{exponent} {open}/{requested}")).collect();
            println!("undecided, {name}: {}", counts.join(", "));
        }
        self.slowest.sort_by_key(|flight| Reverse(flight.0));
        for (_, flight) in self.slowest.iter().take(5) {
            println!("slow: {flight}");
        }
    }
}
