//! The traits of a scene, all that can be asked of it, and a covering array of both.

use std::collections::BTreeSet;

use crate::random::Random;

/// A trait with all its values.
macro_rules! values {
    ($(#[$doc:meta])* $name:ident { $($value:ident),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum $name { $($value),+ }

        impl $name {
            pub const ALL: &'static [Self] = &[$(Self::$value),+];
        }
    };
}

values! {
    /// The start of the motion.
    Start { OnWall, AtRest, Release, Inside, Still, Uncertain, AtGraze }
}

values! {
    /// The excitation of the box; `Unshaken`: `A = 0`.
    Excitation { One, Commensurate, Incommensurate, MayVanish, Unshaken }
}

values! {
    Restitution { Zero, AroundZero, Half, AroundHalf, One }
}

values! {
    /// The data that are intervals, beside those of the traits above.
    Data { Points, Gap, Velocity }
}

/// Arithmetics of `run`, by the words of the command line; the last two are shadows, and shadows after a splice.
pub const ARITHMETICS: [&str; 8] = ["float", "interval", "auto", "64", "256", "inari", "shadow", "splice"];
/// Keys that bifurcations are sought over.
pub const PARAMETERS: [&str; 5] = ["amplitude", "frequency", "gap", "restitution", "amplitude.K"];
/// Keys of a sweep; `K` is the number of a term.
pub const KEYS: &str = "amplitude frequency phase gap restitution start.time start.phase start.position start.velocity \
    amplitude.K frequency.K phase.K";

/// A question about a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Question {
    /// A run in an arithmetic, for some impacts.
    Impacts(&'static str),
    /// A run up to a time.
    Until(&'static str),
    Sweep(&'static str),
    Bifurcations(&'static str),
    Describe,
    Periodic,
    All,
    TwoImpact,
    Trap,
    Chaos,
    ChaosCells,
    Cycles,
    Windows,
    Global,
    Attractors,
    Atlas,
    Tangency,
    BoxMap,
    Audit,
}

impl Question {
    pub fn all() -> Vec<Self> {
        let others = [Self::Describe, Self::Periodic, Self::All, Self::TwoImpact];
        let chaos = [Self::Trap, Self::Chaos, Self::Cycles, Self::Windows, Self::Tangency, Self::Global, Self::Atlas];
        let others =
            others.into_iter().chain(chaos).chain([Self::ChaosCells, Self::BoxMap, Self::Audit, Self::Attractors]);
        let runs = ARITHMETICS.into_iter().flat_map(|name| [Self::Impacts(name), Self::Until(name)]);
        let over = PARAMETERS.into_iter().map(Self::Bifurcations);
        runs.chain(KEYS.split(' ').map(Self::Sweep)).chain(over).chain(others).collect()
    }
}

/// One value of each trait, and a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Crossing {
    pub start: Start,
    pub excitation: Excitation,
    pub restitution: Restitution,
    pub data: Data,
    pub question: Question,
}

/// The pairs of values of two traits, and the triples of three, that are tested.
#[derive(Default)]
pub struct Coverage {
    pairs: BTreeSet<[(usize, usize); 2]>,
    triples: BTreeSet<(Start, Excitation, Question)>,
}

impl Crossing {
    /// The number of the value of each trait.
    fn places(&self, questions: &[Question]) -> [usize; 5] {
        let question = questions.iter().position(|question| *question == self.question).expect("one of all");
        [self.start as usize, self.excitation as usize, self.restitution as usize, self.data as usize, question]
    }

    fn pairs(&self, questions: &[Question]) -> Vec<[(usize, usize); 2]> {
        let places = self.places(questions);
        let of = |a: usize| (a + 1..5).map(move |b| [(a, places[a]), (b, places[b])]);
        (0..5).flat_map(of).collect()
    }
}

impl Coverage {
    pub fn add(&mut self, crossing: &Crossing) {
        self.pairs.extend(crossing.pairs(&Question::all()));
        self.triples.insert((crossing.start, crossing.excitation, crossing.question));
    }

    /// Pairs asked, all pairs, triples asked, all triples.
    pub fn counts(&self) -> [usize; 4] {
        let sizes =
            [Start::ALL.len(), Excitation::ALL.len(), Restitution::ALL.len(), Data::ALL.len(), Question::all().len()];
        let all = (0..5).flat_map(|a| (a + 1..5).map(move |b| sizes[a] * sizes[b])).sum();
        [self.pairs.len(), all, self.triples.len(), sizes[0] * sizes[1] * sizes[4]]
    }
}

/// A covering array: every triple of start, excitation and question, with the restitution and the data that cover the most pairs which
/// no row has yet; in an order that does not depend on the values.
pub fn array(seed: u64) -> Vec<Crossing> {
    let (questions, mut random) = (Question::all(), Random::new(seed));
    let mut left: Vec<(Start, Excitation, Question)> = Vec::new();
    for &start in Start::ALL {
        for &excitation in Excitation::ALL {
            left.extend(questions.iter().map(|&question| (start, excitation, question)));
        }
    }
    let (mut rows, mut covered) = (Vec::new(), BTreeSet::new());
    while !left.is_empty() {
        let (start, excitation, question) = left.swap_remove(random.below(left.len() as u64) as usize);
        let others = Restitution::ALL.iter().flat_map(|&e| Data::ALL.iter().map(move |&data| (e, data)));
        let row = |(restitution, data)| Crossing { start, excitation, restitution, data, question };
        let candidates: Vec<_> = others.map(row).collect();
        let new = |row: &Crossing| row.pairs(&questions).iter().filter(|pair| !covered.contains(*pair)).count();
        let most = candidates.iter().map(new).max().expect("candidates");
        let best: Vec<_> = candidates.into_iter().filter(|row| new(row) == most).collect();
        let row = best[random.below(best.len() as u64) as usize];
        covered.extend(row.pairs(&questions));
        rows.push(row);
    }
    rows
}

/// The crossing of a number: the array again and again, each time with the next restitution or data.
pub fn crossing(array: &[Crossing], number: u64) -> Crossing {
    let (row, round) = (array[number as usize % array.len()], number as usize / array.len());
    let (e, data) = (Restitution::ALL.len(), Data::ALL.len());
    let shift = row.restitution as usize + e * row.data as usize + round;
    Crossing { restitution: Restitution::ALL[shift % e], data: Data::ALL[shift / e % data], ..row }
}
