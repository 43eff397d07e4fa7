//! Questions about a scene, and the documents that answer them: as the command line asks and writes, with less to do.

use std::ops::ControlFlow;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicUsize, Ordering};

use impact_pair::audit::{self, Audit, Columns};
use impact_pair::chaos::{
    self, BoxGraph, Chaos, Cycles, Global, GlobalSettings, HSet, Hyperbolic, Trap, WallWords, WindowSettings, Windows,
};
use impact_pair::json::WallWordsDocument;
use impact_pair::mapping::Word;
use impact_pair::orbit::{Arithmetic, Orbit, Settings};
use impact_pair::pair::Wall;
use impact_pair::periodic::bifurcation::{DiagramSettings, survey};
use impact_pair::periodic::{Budget, Precision, Problem};
use impact_pair::tangency::{Tangencies, TangencySettings};
use impact_pair::units::Units;
use impact_pair::watch::{Stage, Unwatched, proceed_if};
use impact_pair::{Effort, Error, Scene, two_impact};
use impact_pair_answers::DescribeOptions;
use impact_pair_answers::atlas::{Atlas, Plane};
use impact_pair_answers::describe::describe;
use impact_pair_answers::grid::{Grid, Survey};
use impact_pair_answers::sweep::{PointSettings, Sweep};
use impact_pair_truth::float;
use serde_json::{Value, json};

use super::boxes::Mapped;
use super::members::Member;
use super::motion::Motion;
use super::scenes::{Case, NEAR_FOLD};
use super::traits::{Question, Restitution};

/// The most bits of `auto`: what straddling starts need.
const MAX_BITS: u32 = 1024;
/// Digits of lists that are audited.
const LIST_DIGITS: usize = 40;
/// Time between impacts that are listed at least, in forcing periods.
const MIN_TIME_BETWEEN: f64 = 1e-8;
/// Boxes of regions, and questions whether to go on, that are enough here.
const BOXES: usize = 3_000;

/// Bases of figure 14.
const H_SETS: [[[f64; 2]; 3]; 3] = [
    [[0.77843, 1.234518], [0.02877, 0.082], [-0.0002976, 0.002596]],
    [[0.779603, 1.224294], [0.028826, 0.081513], [-0.0001488, 0.001298]],
    [[0.780161, 1.219425], [0.028649, 0.083055], [-0.0001116, 0.000974]],
];
/// Number of calls of the watch after which a search for all orbits is stopped.
const MAX_SEARCH_CALLS: usize = 4_000;
/// Numbers of calls of the watch after which a search is stopped: for h-sets, and for words between given ones.
const MAX_CHAOS_CALLS: [usize; 2] = [3, 1_000];

/// Cells of strips that are enough here.
const CELLS: u64 = 10_000;

/// The answer to a question.
pub enum Answer {
    /// The question is refused, in words.
    Refused(String),
    /// An orbit JSON.
    Orbit(Value),
    /// The head of a sweep and its records, and the scenes of its points.
    Sweep {
        head: Value,
        records: Vec<Value>,
        points: Vec<Scene>,
        requested: Box<PointSettings>,
    },
    /// A periodic JSON; whether all were requested.
    Periodic(Value),
    Bifurcations(Value),
    Description(Value),
    Trap(Value),
    Chaos(Value),
    /// Verdicts over a parameter.
    Cells(Value),
    Cycles(Value),
    Windows(Value),
    Global(Value),
    /// The head of an atlas and its records, and the scenes of its points.
    Atlas {
        head: Value,
        records: Vec<Value>,
        points: Vec<Scene>,
    },
    Tangency(Value),
    /// The images of boxes.
    Boxes(Vec<Mapped>),
    /// The audit of a list of true impacts.
    Audit(Value),
    /// Nothing is found, in words.
    Nothing(&'static str),
}

/// Ends what takes too long.
pub struct CallLimit(AtomicUsize);

impl CallLimit {
    pub fn new() -> Self {
        Self(AtomicUsize::new(0))
    }

    pub fn goes_on(&self, most: usize) -> ControlFlow<()> {
        proceed_if(self.0.fetch_add(1, Ordering::Relaxed) < most)
    }
}

impl Case {
    /// Asks the question of the crossing.
    pub fn ask(&mut self) -> Answer {
        match self.requested() {
            Ok(answer) => answer,
            Err(error) => Answer::Refused(error.to_string()),
        }
    }

    fn requested(&mut self) -> Result<Answer, Error> {
        match self.crossing.question {
            Question::Impacts(arithmetic) => self.run(arithmetic, false),
            Question::Until(arithmetic) => self.run(arithmetic, true),
            Question::Sweep(key) => self.sweep(key),
            Question::Bifurcations(key) => self.bifurcations(key),
            Question::Describe => self.describe(),
            Question::Periodic => self.periodic(false),
            Question::All => self.periodic(true),
            Question::TwoImpact => self.two_impact(),
            Question::Trap => self.trap(),
            Question::Chaos => self.chaos(),
            Question::ChaosCells => self.cells(),
            Question::Cycles => self.cycles(),
            Question::Windows => self.windows(),
            Question::Global => self.global(),
            Question::Attractors => self.attractors(),
            Question::Atlas => self.atlas(),
            Question::Tangency => self.tangency(),
            Question::BoxMap => self.box_map(),
            Question::Audit => self.audit(),
        }
    }

    /// The settings of an arithmetic.
    fn settings(&mut self, name: &str) -> Settings {
        let arithmetic = match name {
            "shadow" | "splice" => Arithmetic::Shadow,
            other => other.parse().expect("an arithmetic"),
        };
        let is_near = arithmetic == Arithmetic::Shadow;
        let impacts = if is_near { 4 + self.random.below(9) } else { 1 + self.random.below(8) };
        let splice = if name == "splice" { 2 + self.random.below(7) } else { 0 };
        let digits = self.random.pick(&[3, 6, 9, 20]);
        let digits = if is_near { digits.min(8) } else { digits };
        let impacts = Some(impacts);
        Settings { arithmetic, impacts, splice, digits, max_bits: MAX_BITS, attractor: true, ..Settings::default() }
    }

    /// A time to stop at: some forcing periods later, or within an ulp or so of an impact.
    fn end(&mut self) -> Option<String> {
        let time = self.scene.start().time();
        let member = Member::new(&self.scene, || 0.0);
        if self.random.below(2) == 0 {
            let later = 1 + self.random.below(40);
            let turn = member.turns().first()?.to_f64();
            return Some(format!("{time}+{}", float(turn * later as f64 / 8.0).to_string_radix(10, Some(12))));
        }
        let mut motion = Motion::new(&member.shaken, member.start.clone());
        let count = 1 + self.random.below(5);
        let mut contact = None;
        for _ in 0..count {
            contact = motion.contact(&mut Vec::new()).ok()??.into();
        }
        let digits = self.random.pick(&[16, 17, 17, 18, 30]);
        Some(contact?.time.to_string_radix(10, Some(digits)))
    }

    fn run(&mut self, arithmetic: &str, is_until: bool) -> Result<Answer, Error> {
        let mut settings = self.settings(arithmetic);
        if is_until {
            settings.until = self.end().and_then(|end| end.parse().ok());
            settings.digits = self.random.pick(&[settings.digits, settings.digits, 40]);
        }
        // `inari` takes one harmonic only.
        Orbit::of(&self.scene, Settings { impacts: Some(0), ..settings.clone() })?;
        Ok(Answer::Orbit(json!(Orbit::new(self.scene.pair(), self.scene.start(), settings)?.document())))
    }

    /// A key with the number of a term, if there is one to be named, and its value in the scene.
    pub fn key(&mut self, key: &str) -> (String, f64) {
        let terms = self.scene.pair().excitation().terms();
        let number = if self.random.below(4) == 0 { 1 } else { terms.len() };
        let term = &terms[if key.ends_with(".K") { number - 1 } else { 0 }];
        let middle = |x: &impact_pair::exact::Exact| x.enclose(64).mid_rad().0;
        let own = match key.trim_end_matches(".K") {
            "amplitude" => middle(term.amplitude()),
            "frequency" => middle(term.frequency()),
            "gap" => middle(self.scene.pair().gap()),
            "restitution" => middle(self.scene.pair().restitution()),
            "start.time" => middle(self.scene.start().time()),
            "start.velocity" => middle(self.scene.start().velocity()),
            _ => 0.0,
        };
        (key.replace('K', &number.to_string()), own)
    }

    /// Three points around the scene's own value, or from 0 on.
    fn sweep(&mut self, key: &str) -> Result<Answer, Error> {
        let (name, own) = self.key(key);
        let (low, high) = match key.trim_end_matches(".K") {
            "amplitude" => (if self.random.below(3) > 0 { 0.0 } else { own }, own * 1.25 + 0.125),
            "frequency" => (own * 0.5, own * 1.5),
            "gap" => (own, own * 1.5),
            "restitution" => (0.0, 1.0),
            "start.velocity" => match self.scene.start().place() {
                impact_pair::orbit::Place::Wall(Wall::Left) => (own * 1.5 - 0.5, 0.0),
                impact_pair::orbit::Place::Wall(_) => (0.0, own * 1.5 + 0.5),
                impact_pair::orbit::Place::Inside(_) => (own - 0.5, own + 0.5),
            },
            "start.position" => (-0.125, 0.125),
            "start.time" => (own, own + 1.0),
            _ => (0.0, 3.0),
        };
        let grid = Grid::new(vec![format!("{name}={low}..{high}:3").parse()?])?;
        let arithmetic = self.random.pick(&["auto", "interval", "auto", "128", "shadow"]);
        let digits = self.random.pick(&[6, 9, 15]);
        let settings = Settings { impacts: None, digits, splice: 0, ..self.settings(arithmetic) };
        let impacts = 1 + self.random.below(5);
        let (transient, reference) = (self.random.below(3), grid.reference(&self.scene)?);
        let requested = PointSettings { transient, impacts, summary: false, reference, settings };
        let (mut records, mut points) = (Vec::new(), Vec::new());
        let sweep = Sweep::new(&self.scene, grid.clone(), requested.clone(), None);
        for point in 0..grid.points() {
            let values = grid.values(point)?;
            records.push(json!(sweep.record(point, &values, &Unwatched)?.expect("nobody stops it")));
            points.push(self.scene.with(&values)?);
        }
        Ok(Answer::Sweep { head: json!(sweep.head()), records, points, requested: Box::new(requested) })
    }

    /// A word and its cycles: whole common periods.
    fn word(&mut self) -> (Word, u32) {
        let word = self.random.pick(&["LR", "LR", "RL", "LLR", "LRR", "L"]);
        let terms = self.scene.pair().excitation().terms().len();
        let cycles = if terms == 1 { self.random.pick(&[1, 1, 2, 3]) } else { self.random.pick(&[1, 2, 3, 6]) };
        (word.parse().expect("a word"), cycles)
    }

    fn periodic(&mut self, is_all: bool) -> Result<Answer, Error> {
        let (word, cycles) = self.word();
        let problem = Problem::new(self.scene.pair(), &word, cycles)?;
        let units = Units::gaps(problem.pair())?;
        let precision = Precision { digits: 9, max_bits: 256 };
        let (limit, budget) = (CallLimit::new(), Budget { boxes: 1_500, halvings: 30 });
        let census = match is_all {
            true => problem
                .find_all_while(self.scene.start(), precision, budget, &|_: Stage<'_>| limit.goes_on(MAX_SEARCH_CALLS)),
            false => problem.find(self.scene.start(), precision),
        };
        Ok(Answer::Periodic(json!(units.document(&problem, self.scene.start(), &census))))
    }

    fn two_impact(&mut self) -> Result<Answer, Error> {
        let cycles = self.random.pick(&[1, 1, 2, 3]);
        let question = two_impact::Problem::new(self.scene.pair(), cycles, two_impact::Unknown::Velocity)?;
        let wall = self.random.pick(&[Wall::Left, Wall::Right]);
        Ok(Answer::Periodic(json!(question.answer(9).document(self.scene.start(), wall))))
    }

    fn bifurcations(&mut self, key: &str) -> Result<Answer, Error> {
        let (name, own) = self.key(key);
        let is_near_fold = self.scene.pair().excitation().terms()[0].amplitude().text() == NEAR_FOLD[0];
        let (low, high) = match key.trim_end_matches(".K") {
            "restitution" => (0.05, 0.95),
            _ if is_near_fold => (own * 0.5, own * 1.75),
            _ => (if self.random.below(2) == 0 { 0.0 } else { own * 0.5 }, own * 1.75 + 0.125),
        };
        let over = format!("{name}={low}..{high}").parse()?;
        let precision = Precision { digits: 9, max_bits: 512 };
        let diagram_settings = DiagramSettings { over, doublings: 0, precision };
        let (word, cycles) = if is_near_fold { ("LR".parse()?, 1) } else { self.word() };
        let limit = CallLimit::new();
        let watch = |_: Stage<'_>| limit.goes_on(if is_near_fold { 3_999 } else { 399 });
        let diagram = survey(self.scene.pair(), self.scene.start(), (&word, cycles), &diagram_settings, &watch)?;
        let found = diagram.document(self.scene.start(), (&word, cycles))?;
        Ok(Answer::Bifurcations(json!(found)))
    }

    /// Asks for a description without the horseshoe, which takes a second to find.
    fn describe(&mut self) -> Result<Answer, Error> {
        let impacts = self.random.pick(&[1, 80, 80, 80]);
        let request = DescribeOptions { impacts, depth: 2, max_bits: MAX_BITS };
        let watch = |at: Stage<'_>| match at {
            Stage::Region(boxes) => proceed_if(boxes < BOXES),
            at => proceed_if(!matches!(at, Stage::Horseshoe { .. })),
        };
        let found = describe(&self.scene, &request, &watch)?;
        Ok(Answer::Description(json!(found.document(&self.scene, "scene.toml")?)))
    }

    fn trap(&mut self) -> Result<Answer, Error> {
        let found = Trap::of(&self.scene, Effort::default(), &|at: Stage<'_>| {
            proceed_if(!matches!(at, Stage::Region(BOXES..)))
        })?;
        let Ok(region) = found else { return Ok(Answer::Nothing("no region")) };
        let impacts = 1 + self.random.below(8) as u32;
        let words = WallWords::of(&BoxGraph::of(self.scene.pair(), &region)?, impacts, &|at: Stage<'_>| {
            proceed_if(!matches!(at, Stage::Sets(BOXES..)))
        });
        let mut document = region.document(&self.scene)?;
        document.words = words.ok().as_ref().map(WallWordsDocument::from);
        Ok(Answer::Trap(json!(document)))
    }

    fn chaos(&mut self) -> Result<Answer, Error> {
        // To find some takes a second.
        let amplitude = self.scene.pair().excitation().terms()[0].amplitude().text();
        let is_half = matches!(self.crossing.restitution, Restitution::Half | Restitution::AroundHalf);
        let is_given = amplitude == "8" && is_half;
        let bases =
            if is_given { H_SETS.map(|[at, long, short]| HSet::new(at, long, short)).to_vec() } else { Vec::new() };
        let question = chaos::HorseshoeSettings { depth: Some(3), bases, ..Default::default() };
        let limit = CallLimit::new();
        let watch = |at: Stage<'_>| match at {
            Stage::Horseshoe { boxes, .. } if boxes >= 4 * BOXES as u64 => proceed_if(false),
            _ => limit.goes_on(MAX_CHAOS_CALLS[usize::from(is_given)]),
        };
        let found = Chaos::of_scene(&self.scene, &question, &watch)?;
        let is_hyperbolic = found.entropy() > 0.0 && self.random.below(2) == 0;
        let watch = |at: Stage<'_>| match at {
            Stage::Cones(cells) => proceed_if(cells < CELLS),
            _ => proceed_if(true),
        };
        let set = is_hyperbolic.then(|| Hyperbolic::of(self.scene.pair(), &found, &watch)).transpose()?;
        Ok(Answer::Chaos(json!(found.document(&self.scene, None, set.as_ref()))))
    }

    /// Near the scene's own gap, of few impacts.
    fn windows(&mut self) -> Result<Answer, Error> {
        let (name, own) = self.key("gap");
        let over = format!("{name}={}..{}", own * 0.75, own * 1.25).parse()?;
        let precision = Precision { digits: 9, max_bits: 512 };
        let settings = WindowSettings { over, impacts: 4_000, longest: 6, most: 1, precision };
        let found = Windows::of(&self.scene, &settings, &Unwatched)?;
        Ok(Answer::Windows(json!(found.document(&self.scene, &settings)?)))
    }

    /// Asks for a global analysis by few boxes.
    fn global(&mut self) -> Result<Answer, Error> {
        let settings = GlobalSettings {
            boxes: 1 << 10,
            halvings: 8,
            most: 6_000,
            precision: Precision { digits: 9, max_bits: 512 },
            ..GlobalSettings::default()
        };
        let found = Global::of(self.scene.pair(), &settings, &Unwatched)?;
        Ok(Answer::Global(json!(found.document(&self.scene, &settings)?)))
    }

    /// Asks for an atlas of the scene's own parameters and others of which more is proved, by few boxes: a stronger forcing, and less restitution.
    fn atlas(&mut self) -> Result<Answer, Error> {
        let key = self.random.pick(&["gap", "amplitude"]);
        let ((length, own), (_, restitution)) = (self.key(key), self.key("restitution"));
        let other = if length == "gap" { own / 8.0 } else { own * 8.0 + 0.125 };
        let (least, most) = (own.min(other), own.max(other));
        let over = [
            format!("{length}={least}..{most}:2"),
            format!("restitution={}..{}:2", restitution / 8.0, restitution + 0.0625),
        ];
        let axes = over.iter().map(|axis| axis.parse()).collect::<Result<_, _>>()?;
        let plane = Plane::new(axes, false)?;
        let settings = GlobalSettings {
            boxes: 1 << 8,
            halvings: 6,
            most: 1_000,
            work: 1 << 20,
            precision: Precision { digits: 9, max_bits: 512 },
            ..GlobalSettings::default()
        };
        let (mut records, mut points) = (Vec::new(), Vec::new());
        let atlas = Atlas::new(&self.scene, plane.clone(), settings, None);
        for point in 0..plane.points() {
            let values = plane.values(point)?;
            records.push(json!(atlas.record(point, &values, &Unwatched)?.expect("nobody stops it")));
            points.push(self.scene.with(&values)?);
        }
        Ok(Answer::Atlas { head: json!(atlas.head()), records, points })
    }

    /// Asks for tangencies about the scene's own gap or restitution, along few flights.
    fn tangency(&mut self) -> Result<Answer, Error> {
        let key = self.random.pick(&["gap", "restitution"]);
        let (name, own) = self.key(key);
        let over = format!("{name}={}..{}", own * 0.75, own * 1.25).parse()?;
        let precision = Precision { digits: 9, max_bits: 512 };
        let (word, effort) = (Some("FFNFF".parse()?), Effort::default());
        let settings = TangencySettings { over, word, longest: 5, most: 1, effort, precision };
        let found = Tangencies::of(&self.scene, &settings, &Unwatched)?;
        Ok(Answer::Tangency(json!(found.document(&self.scene))))
    }

    fn cycles(&mut self) -> Result<Answer, Error> {
        let requested: RangeInclusive<u32> = 1..=2;
        let limit = CallLimit::new();
        let watch = |at: Stage<'_>| match at {
            Stage::Cycles { .. } => limit.goes_on(2_000),
            at => proceed_if(!matches!(at, Stage::Region(BOXES..))),
        };
        let precision = Precision { digits: 9, max_bits: 512 };
        let found = Cycles::of(&self.scene, Effort::default(), &requested, precision, &watch)?;
        Ok(Answer::Cycles(json!(Cycles::document(&self.scene, &requested, found.as_ref().map_err(|why| *why))?)))
    }

    /// The audit of true impacts, in forty digits.
    fn audit(&mut self) -> Result<Answer, Error> {
        let member = Member::new(&self.scene, || 0.5);
        let mut motion = Motion::new(&member.shaken, member.start.clone());
        let mut list = "time,wall,velocity\n".to_owned();
        let (mut releases, mut last) = (Vec::new(), None);
        let shortest = member.turns().into_iter().reduce(|a, b| a.min(&b)).expect("a harmonic");
        for _ in 0..1 + self.random.below(6) {
            let Ok(Some(contact)) = motion.contact(&mut releases) else { break };
            // Of two impacts nearer to one another than the tolerance the audit may take one for the other.
            let since = float(&contact.time - last.as_ref().unwrap_or(&member.start.time));
            if last.is_some() && since < float(&shortest * MIN_TIME_BETWEEN) {
                break;
            }
            last = Some(contact.time.clone());
            let wall = if contact.wall == impact_pair_truth::Wall::Left { "left" } else { "right" };
            let [time, velocity] =
                [&contact.time, &contact.velocity_before].map(|x| x.to_string_radix(10, Some(LIST_DIGITS)));
            list += &format!("{time},{wall},{velocity}\n");
        }
        let list = audit::read(&list, &Columns::default(), self.scene.pair())?;
        let requested = audit::AuditSettings { max_bits: 256, ..audit::AuditSettings::default() };
        let found = Audit::of(&self.scene, list, &requested, &Unwatched)?;
        Ok(Answer::Audit(json!(found.document())))
    }
}
