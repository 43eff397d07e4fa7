//! Costs of proofs: one run, interleaved, as ratios, with the width beside the time.
//!
//! `cargo bench --bench ratios`. Each figure's flights are solved by four programs in turn, again and again, and
//! the table gives the median time of each and the medians of the ratios taken round by round: plain doubles with
//! the standard library's trigonometry, plain doubles with our kernel, the certified flight, and the certified
//! step of an orbit. `width` is the median bracket in units in the last place of the time since the start.

use std::hint::black_box;

use impact_pair::contact::{Contact, Margins, Radii, Verdict, first_contact, first_contact_f64};
use impact_pair::flight::Flight;
use impact_pair::number::{Ball, Kernel, Std, Trigonometry};
use impact_pair::orbit::Arithmetic;
use impact_pair::pair::{Reduced, Wall};
use impact_pair_benches::{Figure, Launch, figures, median, time};

const ROUNDS: usize = 301;
const FLIGHTS: u64 = 1000;

fn main() {
    // `cargo test --benches` only checks that it runs.
    let rounds = if std::env::args().any(|argument| argument == "--bench") { ROUNDS } else { 1 };
    println!("median of {rounds} interleaved rounds, nanoseconds a flight");
    println!(
        "{:<7}{:>10}{:>10}{:>10}{:>10}  {:>9}{:>9}{:>9}{:>8}{:>10}",
        "", "plain std", "plain", "certified", "step", "cert/std", "cert/own", "step/cert", "width", "undecided"
    );
    for figure in figures() {
        row(&figure, rounds);
    }
    long_flights(rounds);
}

fn row(figure: &Figure, rounds: usize) {
    let (pair, launches) = figure.launches(FLIGHTS);
    let centre = pair.centre();
    let margins = Margins::new(&pair);
    // As many impacts as doubles certify, at most.
    let reach = figure.orbit(Arithmetic::Interval, FLIGHTS).count() as u64;
    let mut times: [Vec<f64>; 4] = Default::default();
    for _ in 0..rounds {
        times[0].push(time(launches.len(), || launches.iter().for_each(|launch| plain::<Std>(&centre, launch))));
        times[1].push(time(launches.len(), || launches.iter().for_each(|launch| plain::<Kernel>(&centre, launch))));
        times[2].push(time(launches.len(), || launches.iter().for_each(|launch| certified(&centre, launch, &margins))));
        let mut orbit = figure.orbit(Arithmetic::Interval, reach);
        times[3].push(time(reach as usize, || orbit.by_ref().for_each(|impact| _ = black_box(impact))));
    }
    let ratio = |a: usize, b: usize| median(times[a].iter().zip(&times[b]).map(|(a, b)| a / b).collect());
    let [std, own, proof, step] = [0, 1, 2, 3].map(|i| median(times[i].clone()));
    let verdicts: Vec<_> =
        launches.iter().map(|launch| first_contact(&launch.flight(&centre), &margins, Radii::default())).collect();
    let undecided = verdicts.iter().filter(|verdict| matches!(verdict, Verdict::Undecided(_))).count();
    let widths = verdicts.into_iter().filter_map(Verdict::certified).map(|contact| ulps(&contact)).collect();
    println!(
        "{:<7}{std:>10.1}{own:>10.1}{proof:>10.1}{step:>10.1}  {:>9.2}{:>9.2}{:>9.2}{:>8.1}{undecided:>10}",
        figure.name,
        ratio(2, 0),
        ratio(2, 1),
        ratio(3, 2),
        median(widths),
    );
}

/// The cost of a flight of a hundred thousand forcing periods beside that of one.
fn long_flights(rounds: usize) {
    // A slow drift carries the ball across while the box swings 0.4 gaps: contact after 1/c forcing periods.
    let exact = Ball::exact;
    let pair =
        Reduced { alpha: exact(0.4), beta: Ball::new(0.4 * std::f64::consts::TAU, 1e-15), restitution: exact(0.5) };
    let margins = Margins::new(&pair);
    let pair = pair.centre();
    let launch = |turns: f64| {
        let phase = 0.25;
        Launch { wall: Wall::Left, phase, velocity: 0.2 / turns }
    };
    let flights: Vec<Vec<Launch>> =
        [1.0, 1e5].map(|turns| (0..1000).map(|i| launch(turns * (1.0 + f64::from(i) * 1e-4))).collect()).into();
    let turns = |i: usize| {
        let contacts = flights[i]
            .iter()
            .filter_map(|launch| first_contact(&launch.flight(&pair), &margins, Radii::default()).certified());
        median(contacts.map(|contact| contact.time.mid()).collect())
    };
    let mut ratios = Vec::new();
    for _ in 0..rounds {
        let [short, long] =
            [0, 1].map(|i| time(1000, || flights[i].iter().for_each(|launch| certified(&pair, launch, &margins))));
        ratios.push(long / short);
    }
    println!("a flight of {:.0} turns costs {:.2} times one of {:.1}", turns(1), median(ratios), turns(0));
}

#[inline(never)]
fn plain<T: Trigonometry>(pair: &Reduced<f64>, launch: &Launch) {
    let flight: Flight<f64> = launch.flight_with(pair, T::sin_cos(launch.phase));
    black_box(first_contact_f64::<T>(&flight));
}

#[inline(never)]
fn certified(pair: &Reduced<f64>, launch: &Launch, margins: &Margins) {
    black_box(first_contact(&launch.flight(pair), margins, Radii::default()));
}

fn ulps(contact: &Contact<Ball>) -> f64 {
    let time = contact.time.mid();
    2.0 * contact.phase.rad() / (time.next_up() - time)
}
