//! Flights in lanes beside flights one by one: one run, interleaved, as ratios.
//!
//! `cargo bench --bench lanes`. Points are the first contacts of each figure's flights; sets are boxes 1e-12 wide around them,
//! with the Jacobian over each. The table gives the median time of a flight, the median of the ratios taken round by round,
//! and how many millions a second all processors together prove in lanes.

use std::hint::black_box;
use std::thread;

use impact_pair::contact::{Margins, Radii, first_contact, first_contacts_of, image_of, images_of};
use impact_pair::number::Ball;
use impact_pair::pair::{Inward, Reduced, Wall};
use impact_pair_benches::{Figure, figures, median, time};

const ROUNDS: usize = 301;
const FLIGHTS: u64 = 1000;
/// Radii of phases and of velocities.
const RADIUS: f64 = 1e-12;
/// Rounds in each thread, for the rate of all together.
const THROUGHPUT_ROUNDS: usize = 2000;

fn main() {
    // `cargo test --benches` only checks that it runs.
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let (rounds, together) = if is_bench { (ROUNDS, THROUGHPUT_ROUNDS) } else { (1, 1) };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    println!("median of {rounds} interleaved rounds, nanoseconds a flight; millions a second of {threads} threads");
    println!(
        "{:<7}{:>10}{:>10}{:>8}{:>10}   {:>10}{:>10}{:>8}{:>10}",
        "", "point", "in lanes", "ratio", "million/s", "set", "in lanes", "ratio", "million/s"
    );
    for figure in figures() {
        row(&figure, rounds, together, threads);
    }
}

fn row(figure: &Figure, rounds: usize, together: usize, threads: usize) {
    let (pair, launches) = figure.launches(FLIGHTS);
    let (margins, centre) = (Margins::new(&pair), pair.centre());
    let points: Vec<_> =
        launches.iter().map(|launch| (launch.wall, launch.phase, Ball::exact(launch.velocity))).collect();
    let ball = |mid: f64| Ball::new(mid, RADIUS);
    let before = |velocity: f64| -velocity / centre.restitution;
    let sets: Vec<_> = launches
        .iter()
        .map(|launch| (launch.wall, [ball(launch.phase), ball(launch.wall.inward(before(launch.velocity)))]))
        .collect();
    let mut times: [Vec<f64>; 4] = Default::default();
    for _ in 0..rounds {
        times[0].push(time(points.len(), || {
            launches
                .iter()
                .for_each(|launch| _ = black_box(first_contact(&launch.flight(&centre), &margins, Radii::default())));
        }));
        times[1].push(time(points.len(), || fly(&pair, &points)));
        times[2].push(time(sets.len(), || sets.iter().for_each(|set| _ = black_box(image_of(&pair, &margins, *set)))));
        times[3].push(time(sets.len(), || map(&pair, &sets)));
    }
    let ratio = |a: usize, b: usize| median(times[a].iter().zip(&times[b]).map(|(a, b)| a / b).collect());
    let [point, points_in_lanes, set, sets_in_lanes] = [0, 1, 2, 3].map(|i| median(times[i].clone()));
    let rate = |work: &(dyn Fn() + Sync)| {
        let each = time(together * points.len() * threads, || {
            thread::scope(|scope| {
                (0..threads).for_each(|_| _ = scope.spawn(|| (0..together).for_each(|_| work())));
            });
        });
        1e3 / each
    };
    println!(
        "{:<7}{point:>10.1}{points_in_lanes:>10.1}{:>8.2}{:>10.1}   {set:>10.1}{sets_in_lanes:>10.1}{:>8.2}{:>10.1}",
        figure.name,
        ratio(0, 1),
        rate(&|| fly(&pair, &points)),
        ratio(2, 3),
        rate(&|| map(&pair, &sets)),
    );
}

fn fly(pair: &Reduced<Ball>, points: &[(Wall, f64, Ball)]) {
    first_contacts_of(pair, points.iter().copied(), |verdict| _ = black_box(verdict));
}

fn map(pair: &Reduced<Ball>, sets: &[(Wall, [Ball; 2])]) {
    images_of(pair, sets.iter().copied(), |verdict| _ = black_box(verdict));
}
