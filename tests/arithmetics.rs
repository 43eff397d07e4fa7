//! All arithmetics list the same impacts, each as far as it goes: the figures, starts that straddle branches, starts 1e15 periods after
//! time 0, 3,000 chaotic impacts at 100 digits, and intervals of data. `validation/arb` and `validation/truth` judge that these are right.

use impact_pair::Scene;
use impact_pair::contact::Reason;
use impact_pair::exact::{Enclosure, Exact};
use impact_pair::orbit::{Arithmetic, INARI, Impact, Orbit, Outcome, Progress, Settings};
use impact_pair::pair::Wall;
use num_rational::BigRational;

use crate::setup;
use crate::straddle::starts::{Dice, FAMILIES, case};

/// An arithmetic and the digits asked of it.
type Kind = (Arithmetic, u32);

/// All that certify, narrower ones first; `auto` at each of its digits; the textbook's method.
const CERTIFIED: [Kind; 11] = [
    (Arithmetic::Interval, 9),
    (Arithmetic::Bits(64), 9),
    (Arithmetic::Bits(128), 9),
    (Arithmetic::Bits(256), 9),
    (Arithmetic::Bits(512), 9),
    (Arithmetic::Auto, 3),
    (Arithmetic::Auto, 9),
    (Arithmetic::Auto, 15),
    (Arithmetic::Auto, 30),
    (Arithmetic::Auto, 100),
    (Arithmetic::Inari, 9),
];

/// Bits that decide whatever here is decidable; what is not (exact grazes) is then given up soon.
const MOST_BITS: u32 = 1 << 13;

/// An orbit that has ended.
struct Run {
    kind: Kind,
    orbit: Orbit,
    impacts: Vec<Impact>,
    /// Bounds of time and velocity of each impact.
    bounds: Vec<(Enclosure, Enclosure)>,
    /// True if it grazes or rests among the impacts: how many are listed then depends on the digits.
    rests: bool,
}

impl Run {
    fn new(scene: &Scene, kind: Kind, impacts: u64) -> Run {
        Run::within(scene, kind, impacts, MOST_BITS)
    }

    fn within(scene: &Scene, kind: Kind, impacts: u64, max_bits: u32) -> Run {
        let settings =
            Settings { arithmetic: kind.0, digits: kind.1, max_bits, impacts: Some(impacts), ..Settings::default() };
        let mut orbit = Orbit::of(scene, settings).unwrap();
        let (mut found, mut rests) = (Vec::new(), false);
        loop {
            match orbit.advance() {
                Progress::Impact(impact) => found.push(impact),
                Progress::Graze(_) | Progress::Rest(_) => rests = true,
                Progress::Retraced(_) | Progress::Release(_) => {}
                Progress::Ended => break,
            }
        }
        let bounds = found.iter().map(|impact| orbit.bounds(impact)).collect();
        Run { kind, orbit, impacts: found, bounds, rests }
    }

    fn len(&self) -> usize {
        self.impacts.len()
    }

    fn outcome(&self) -> &Outcome {
        self.orbit.outcome().expect("the orbit ended")
    }

    fn reason(&self) -> Option<Reason> {
        if let Outcome::Undecided { reason, .. } = self.outcome() { Some(*reason) } else { None }
    }

    /// Asserts that no width is beyond the requested digits, in units of `2 pi/W` and `A W`.
    fn is_narrow(&self, scene: &Scene) {
        let term = scene.pair().excitation().only().expect("one harmonic");
        let [amplitude, frequency] = [term.amplitude(), term.frequency()].map(|exact| exact.enclose(64).mid_rad().0);
        let most = 10f64.powi(-(self.kind.1 as i32));
        for (index, (time, velocity)) in self.bounds.iter().enumerate() {
            let widths = [
                time.wid().to_f64_down() * frequency / std::f64::consts::TAU,
                velocity.wid().to_f64_down() / amplitude / frequency,
            ];
            assert!(widths.iter().all(|width| *width <= most), "{:?}: impact {}: {widths:?}", self.kind, index + 1);
        }
    }

    /// Asserts that both have the same word and enclosures that meet, as far as both go.
    fn meets(&self, other: &Run, what: &str) {
        for (index, (a, b)) in self.impacts.iter().zip(&other.impacts).enumerate() {
            let both = || format!("{:?}, {:?}, impact {}: {what}", self.kind, other.kind, index + 1);
            assert_eq!(a.wall, b.wall, "{}", both());
            // After what may have been a graze no mapping may be named.
            assert!(a.mapping == b.mapping || a.mapping.is_none() || b.mapping.is_none(), "{}", both());
            let (a, b) = (&self.bounds[index], &other.bounds[index]);
            assert!(a.0.intersection(&b.0).is_some(), "times do not meet: {}", both());
            assert!(a.1.intersection(&b.1).is_some(), "velocities do not meet: {}", both());
        }
    }
}

fn kinds(scene: &Scene) -> impl Iterator<Item = Kind> {
    let is_known = INARI && scene.pair().excitation().only().is_some();
    CERTIFIED.into_iter().filter(move |kind| kind.0 != Arithmetic::Inari || is_known)
}

/// Runs every certified arithmetic; each meets all others, and what `auto` lists is narrow.
fn stable(scene: &Scene, impacts: u64, what: &str) -> Vec<Run> {
    let runs: Vec<Run> = kinds(scene).map(|kind| Run::new(scene, kind, impacts)).collect();
    for (index, run) in runs.iter().enumerate() {
        // What follows an untold graze is of both its continuations, of which other bits take one.
        let others = runs[..index].iter().filter(|other| run.rests == other.rests);
        others.for_each(|other| run.meets(other, what));
    }
    runs
}

fn figure(number: u32) -> Scene {
    setup::scene(&format!("figure-{number}"))
}

/// The scene of one harmonic, with the entries of its tables `pair` and `start`.
fn scene(amplitude: &str, frequency: &str, phase: &str, pair: &str, start: &str) -> Scene {
    let text = format!(
        "excitation = {{ amplitude = \"{amplitude}\", frequency = \"{frequency}\", phase = \"{phase}\" }}\n\
         pair = {{ {pair} }}\nstart = {{ {start} }}"
    );
    Scene::parse(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn the_figures_are_the_same_in_every_arithmetic() {
    for number in 12..=17 {
        let scene = figure(number);
        for run in stable(&scene, 200, "a figure").iter().filter(|run| run.kind.0 == Arithmetic::Auto) {
            assert_eq!(run.len(), 200, "figure {number}, {:?}: {:?}", run.kind, run.outcome());
            run.is_narrow(&scene);
        }
    }
}

#[test]
fn straddling_starts_are_the_same_in_every_arithmetic() {
    let mut impacts = 0;
    for number in 0..2 * FAMILIES.len() as u64 {
        let case = case(&mut Dice(701 ^ number << 20), number);
        let Ok(_) = Orbit::of(&case.scene, Settings::default()) else { continue };
        let runs = stable(&case.scene, 6, &case.text);
        // More bits go farther; `Bits(64)` has no more to offer than doubles have.
        for pair in runs[2..5].windows(2) {
            let is_farther = pair[0].len() <= pair[1].len() || pair[0].rests;
            assert!(is_farther, "{:?} goes farther than {:?}: {}", pair[0].kind, pair[1].kind, case.text);
        }
        let autos = &runs[5..10];
        impacts += autos[0].len();
        for run in autos {
            assert!(
                run.rests || runs[0].rests || run.len() >= runs[0].len(),
                "{:?} {}: {}",
                run.kind,
                run.len(),
                case.text
            );
            let same = (run.len(), run.outcome().kind(), run.reason())
                == (autos[0].len(), autos[0].outcome().kind(), autos[0].reason());
            assert!(run.rests || autos[0].rests || same, "{:?}: {}", run.kind, case.text);
        }
    }
    assert!(impacts > 40, "{impacts}");
}

#[test]
fn figure_14_at_100_digits_for_3_000_impacts() {
    let scene = figure(14);
    let [nine, hundred] = [9, 100].map(|digits| Run::new(&scene, (Arithmetic::Auto, digits), 3_000));
    assert_eq!((nine.len(), hundred.len()), (3_000, 3_000));
    for run in [&nine, &hundred] {
        run.is_narrow(&scene);
        assert!(run.orbit.first_wide().is_none());
    }
    hundred.meets(&nine, "figure 14");
}

/// Equations (70), (71) with tau at a crest: cos th = 0, impacts at `i N pi/W`, |v| = (d -+ 2 A) W/(N pi) for odd N and d W/(N pi) for even
/// N. `A W <= |v|`: the flights are monotone. Others, of which nothing is known, meet more digits.
#[test]
fn elastic_orbits_of_1_000_impacts_at_30_digits() {
    for (n, tau, velocity) in [(1, "pi/2", "-29/5"), (1, "-pi/2", "-31/5"), (2, "pi/2", "-3"), (3, "-pi/2", "-31/15")] {
        let start = format!("time = 0, wall = \"left\", velocity = \"{velocity}\"");
        let scene = scene("0.05", "2*pi", tau, "gap = 3, restitution = 1", &start);
        let run = Run::new(&scene, (Arithmetic::Auto, 30), 1000);
        assert_eq!(run.len(), 1000);
        run.is_narrow(&scene);
        let speed = -velocity.parse::<Exact>().unwrap().as_rational().unwrap().clone();
        for (index, (impact, (time, velocity))) in (1..).zip(run.impacts.iter().zip(&run.bounds)) {
            let is_left = index % 2 == 0;
            assert_eq!(impact.wall == Wall::Left, is_left);
            assert!(time.contains(&BigRational::new((n * index).into(), 2.into())), "N = {n}, {tau}: impact {index}");
            assert!(
                velocity.contains(&if is_left { -speed.clone() } else { speed.clone() }),
                "N = {n}, {tau}: {index}"
            );
        }
    }
    for (amplitude, velocity) in [("2", "-9"), ("30", "0")] {
        let start = format!("time = 0, wall = \"left\", velocity = {velocity}");
        let scene = scene(amplitude, "2*pi", "0.3", "gap = 1, restitution = 1", &start);
        let [run, more] = [30, 60].map(|digits| Run::new(&scene, (Arithmetic::Auto, digits), 1000));
        assert_eq!((run.len(), more.len()), (1000, 1000), "A = {amplitude}");
        run.is_narrow(&scene);
        run.meets(&more, amplitude);
    }
}

#[test]
fn whole_periods_before_the_start_change_nothing() {
    let data = [
        ("8", "2*pi", "0", "0.5"),
        ("0.3", "200*pi", "pi/3", "1"),
        ("1", "pi", "1.047196", "0.8"),
        ("2", "20*pi/3", "-2", "0"),
    ];
    let places =
        ["wall = \"left\", velocity = -2.5", "wall = \"right\", velocity = 2.5", "position = 0.1, velocity = -2.5"];
    for ((amplitude, frequency, phase, e), place) in data.into_iter().flat_map(|data| places.map(|place| (data, place)))
    {
        let pair = format!("gap = 1, restitution = {e}");
        let after = |turns: &str| {
            let start = format!("time = \"({turns} + 0.3)*2*pi/({frequency})\", {place}");
            scene(amplitude, frequency, phase, &pair, &start)
        };
        for kind in kinds(&after("0")).chain([(Arithmetic::Float, 9)]) {
            let runs = ["0", "-10^15", "1234567890123456789012345678901234567890"]
                .map(|turns| Run::new(&after(turns), kind, 30));
            for run in &runs[1..] {
                assert_eq!(run.impacts, runs[0].impacts, "{kind:?} {frequency} {place}");
                assert_eq!(run.outcome().kind(), runs[0].outcome().kind());
            }
        }
    }
}

/// A figure with one datum replaced.
fn with(number: u32, key: &str, value: &str) -> Scene {
    let value = value.parse().unwrap();
    figure(number).with(&[(key.parse().unwrap(), value)]).unwrap()
}

/// Asserts that the run holds the orbits of four members, which are proved to 30 digits.
fn holds_members(run: &Run, number: u32, key: &str, [low, high]: [&str; 2]) {
    for part in ["0", "0.375", "0.8125", "1"] {
        let member = with(number, key, &format!("({low}) + (({high}) - ({low}))*{part}"));
        Run::new(&member, (Arithmetic::Auto, 30), run.len() as u64).meets(run, key);
    }
}

#[test]
fn intervals_of_data_end_by_their_own_width() {
    for (number, key, ends) in [
        (12, "gap", ["9.42496", "9.42498"]),
        (13, "gap", ["9.42496", "9.42498"]),
        (14, "gap", ["9.42496", "9.42498"]),
        (14, "gap", ["9", "10"]),
        (14, "gap", ["5", "15"]),
        (14, "start.velocity", ["-12.6", "-12.5"]),
        (14, "start.velocity", ["-20", "-1"]),
        (16, "start.velocity", ["-2.0000001", "-2"]),
        (17, "start.velocity", ["-1e-9", "0"]),
        (15, "gap", ["1", "1.000000000001"]),
        (14, "start.velocity", ["-12.56636 - 1e-40", "-12.56636 + 1e-40"]),
    ] {
        let scene = with(number, key, &format!("[{}, {}]", ends[0], ends[1]));
        let interval = Run::new(&scene, (Arithmetic::Interval, 9), 250);
        holds_members(&interval, number, key, ends);
        for kind in
            [(Arithmetic::Auto, 9), (Arithmetic::Auto, 30), (Arithmetic::Bits(256), 9), (Arithmetic::Bits(64), 9)]
        {
            let run = Run::new(&scene, kind, 250);
            holds_members(&run, number, key, ends);
            assert!(run.len() >= interval.len(), "{kind:?}: {} of {}", run.len(), interval.len());
            assert!(
                matches!(run.reason(), None | Some(Reason::Width | Reason::Graze)),
                "{kind:?}: {:?}",
                run.outcome()
            );
            // Narrower than doubles: followed farther.
            let is_fine = ends[0].ends_with("1e-40") && kind != (Arithmetic::Bits(64), 9);
            assert!(
                !is_fine || run.len() > 180 && interval.len() < 100 && run.reason().is_some(),
                "{kind:?} {}",
                run.len()
            );
        }
    }
}

#[test]
fn few_bits_at_most_end_in_precision() {
    let scene = figure(14);
    let whole = Run::new(&scene, (Arithmetic::Auto, 100), 1000);
    for (digits, max_bits) in [(15, 64), (30, 64), (30, 100), (9, 100), (100, 100), (100, 300)] {
        let run = Run::within(&scene, (Arithmetic::Auto, digits), 1000, max_bits);
        assert_eq!(run.reason(), Some(Reason::Precision), "{digits} digits, {max_bits} bits");
        run.is_narrow(&scene);
        run.meets(&whole, "figure 14");
    }
}

/// Without velocity at theta = 0 or pi only the third derivative moves the ball, very little at first.
#[test]
fn releases_are_decided_in_every_arithmetic() {
    let places = [
        ("pi", "position = 0.3"),
        ("0", "position = 0.3"),
        ("pi", "position = -0.49"),
        ("0", "wall = \"left\""),
        ("pi", "wall = \"right\""),
    ];
    for (amplitude, (tau, place)) in
        ["1e-9", "1e-3", "1", "1e3", "1e9"].into_iter().flat_map(|a| places.map(|place| (a, place)))
    {
        let scene =
            scene(amplitude, "2*pi", tau, "gap = 1, restitution = 0.9", &format!("time = 0, {place}, velocity = 0"));
        let whole = Run::new(&scene, (Arithmetic::Auto, 100), 1);
        for kind in (64..=256).step_by(8).map(|bits| (Arithmetic::Bits(bits), 9)).chain(kinds(&scene)) {
            let run = Run::new(&scene, kind, 1);
            let doubles = matches!(kind.0, Arithmetic::Interval | Arithmetic::Inari);
            assert!(doubles || run.len() == 1, "{kind:?}: {:?}", run.outcome());
            run.meets(&whole, place);
        }
    }
}

/// Motions that no precision decides cost little: a ball that grazes its wall once in each forcing period for ever (the paper's model II), and
/// a drift that takes more than 2^52 forcing periods to cross the gap.
#[test]
fn exact_grazes_cost_little() {
    for (time, end) in [("0", "periodic"), ("-1e-60", "undecided")] {
        let start = format!("time = {time}, wall = \"left\", velocity = 0");
        let run =
            Run::new(&scene("0.01", "2*pi", "pi/2", "gap = 1, restitution = 1", &start), (Arithmetic::Auto, 9), 5);
        assert_eq!(run.outcome().kind().to_string(), end);
        assert!(run.reason().is_none_or(|reason| reason == Reason::Budget), "{:?}", run.outcome());
        assert!(run.orbit.bits() < 5_000, "{} bits", run.orbit.bits());
    }
}

/// Flights of more than 2^39 forcing periods, which doubles leave to multiprecision: the forcing period of the contact is a division.
#[test]
fn flights_of_a_trillion_periods_end_in_the_right_period() {
    for (number, wall) in (0..8).flat_map(|number| ["left", "right"].map(|wall| (number, wall))) {
        let speed = f64::from(number) * 0.7 * if wall == "left" { -1.0 } else { 1.0 };
        let start = format!("time = 0, wall = \"{wall}\", velocity = {speed:.2}e-13");
        let scene = scene(
            &format!("0.{}e-13", 3 + number),
            "2*pi",
            &format!("{}/11", 3 * number - 10),
            "gap = 1, restitution = 1",
            &start,
        );
        let whole = Run::new(&scene, (Arithmetic::Auto, 100), 1);
        for kind in [(Arithmetic::Bits(128), 9), (Arithmetic::Bits(256), 9), (Arithmetic::Auto, 9)] {
            let run = Run::new(&scene, kind, 1);
            run.meets(&whole, wall);
            assert_eq!(
                (run.len(), run.outcome().kind()),
                (whole.len(), whole.outcome().kind()),
                "{kind:?} {speed} {wall}"
            );
        }
    }
}
