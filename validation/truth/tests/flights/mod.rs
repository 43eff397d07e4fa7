//! Tens of thousands of single flights: every certificate of `impact_pair::contact::first_contact` against the truth.

pub mod judge;
mod near;

use impact_pair::contact::Radii;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::random::{Random, cases, on_all_cores};
use judge::{Case, From, Spread, Tally};
use near::near_graze;

/// A wall, or a place inside, near the walls or not.
fn from(random: &mut Random) -> From {
    match random.below(3) {
        0 => From::Left,
        1 => From::Right,
        _ => inside(random),
    }
}

fn inside(random: &mut Random) -> From {
    From::Inside(match random.below(4) {
        0 => 0.5,
        1 => random.magnitude(-15.0, -1.0),
        2 => 1.0 - random.magnitude(-15.0, -1.0),
        _ => random.uniform(1e-3, 0.999),
    })
}

/// Either wall.
fn wall(random: &mut Random) -> From {
    random.pick(&[From::Left, From::Right])
}

/// The phase that is `turns` in the frame mirrored onto the left wall, in [-1/2, 1/2].
fn phase_in_frame(from: From, turns: f64) -> f64 {
    let shifted = if from == From::Right { turns + 0.5 } else { turns };
    shifted - shifted.round()
}

/// What draws a flight, if it comes to one.
type Draw = dyn Fn(&mut Random) -> Option<Case> + Sync;

/// Flights that are hard for one reason: how many, the greatest part that may be undecided, and the greatest width of the middle bracket
/// of time, in units of the last place of `turns + phase`.
struct Family {
    name: String,
    cases: usize,
    most_undecided: f64,
    widest: f64,
    draw: Box<Draw>,
}

fn family(
    name: &str,
    cases: usize,
    most_undecided: f64,
    draw: impl Fn(&mut Random) -> Option<Case> + Sync + 'static,
) -> Family {
    Family { name: name.into(), cases, most_undecided, widest: f64::INFINITY, draw: Box::new(draw) }
}

fn any_phase(random: &mut Random) -> f64 {
    random.uniform(-0.5, 0.5)
}

fn any_alpha(random: &mut Random) -> f64 {
    random.magnitude(-3.0, 3.0)
}

/// At walls and in the gap, at any speed or none.
fn plain() -> Vec<Family> {
    let anywhere = family("plain random", 24_000, 1e-3, |random| {
        let alpha = any_alpha(random);
        let velocity = match random.below(3) {
            0 => TAU * alpha * random.uniform(0.0, 1.0),
            1 => TAU * alpha * random.magnitude(-3.0, 2.0),
            _ => random.magnitude(-2.0, 2.0),
        };
        Some(Case { alpha, phase: any_phase(random), velocity, from: wall(random) })
    });
    let moving = |random: &mut Random| {
        let alpha = any_alpha(random);
        let velocity = random.sign() * TAU * alpha * random.magnitude(-6.0, 1.0);
        Some(Case { alpha, phase: any_phase(random), velocity, from: inside(random) })
    };
    let resting = |random: &mut Random| {
        Some(Case { alpha: any_alpha(random), phase: any_phase(random), velocity: 0.0, from: inside(random) })
    };
    // The height of a start is known to 2^-53 only, and many of these are closer to a wall than 1e-9.
    vec![
        Family { widest: 4.0, ..anywhere },
        family("inside", 4_800, 1e-2, moving),
        family("inside at rest", 1_200, 0.1, resting),
    ]
}

/// Releases, and hops of almost no speed: where the wall presses (mirrored sine < 0) and where it recedes.
fn slow() -> Vec<Family> {
    let released = |random: &mut Random| {
        let from = wall(random);
        let phase = phase_in_frame(from, random.uniform(-0.5, 0.5));
        Some(Case { alpha: any_alpha(random), phase, velocity: 0.0, from })
    };
    let hop = |phases: [f64; 2], powers: [f64; 2]| {
        move |random: &mut Random| {
            let (alpha, from) = (any_alpha(random), wall(random));
            let phase = phase_in_frame(from, random.uniform(phases[0], phases[1]));
            Some(Case { alpha, phase, velocity: TAU * alpha * random.magnitude(powers[0], powers[1]), from })
        }
    };
    let chatter = |power: i32| {
        let powers = [f64::from(power), f64::from(power) + 3.0];
        family(&format!("chatter hops to 1e{power}"), 4_000, 1e-2, hop([-0.5, 0.0], powers))
    };
    let others = [
        family("v+ = 0", 4_000, 1.0, released),
        family("tiny v+ while the wall recedes", 4_000, 1.0, hop([0.0, 0.5], [-15.0, -3.0])),
    ];
    [-3, -6, -9, -12, -15].map(chatter).into_iter().chain(others).collect()
}

/// Of up to a hundred thousand periods and of a billionth; with shaking enormous, tiny and absent.
fn extreme() -> Vec<Family> {
    // A small drift and no room to touch either wall in the first forcing period.
    let long = |random: &mut Random| {
        let (from, alpha) = (wall(random), random.uniform(0.01, 0.5));
        let phase = phase_in_frame(from, random.uniform(0.05, 0.45));
        let mirrored = if from == From::Right { -1.0 } else { 1.0 };
        let drift = random.magnitude(-5.0, -1.0) * if random.below(3) == 0 { -1.0 } else { 1.0 };
        let velocity = drift - TAU * alpha * mirrored * (TAU * phase).cos();
        (velocity > 0.0).then_some(Case { alpha, phase, velocity, from })
    };
    let across = |random: &mut Random| {
        let velocity = random.magnitude(1.0, 9.0);
        Some(Case { alpha: any_alpha(random).min(velocity), phase: any_phase(random), velocity, from: wall(random) })
    };
    let huge = |random: &mut Random| {
        let alpha = random.magnitude(3.0, 9.0);
        let velocity = TAU * alpha * random.magnitude(-9.0, 1.0);
        Some(Case { alpha, phase: any_phase(random), velocity, from: from(random) })
    };
    let tiny = |random: &mut Random| {
        let alpha = if random.below(4) == 0 { 0.0 } else { random.magnitude(-12.0, -3.0) };
        Some(Case { alpha, phase: any_phase(random), velocity: random.magnitude(-4.0, 3.0), from: from(random) })
    };
    vec![
        family("long", 4_000, 1e-2, long),
        family("short", 4_000, 1e-3, across),
        family("huge alpha", 3_000, 1.0, huge),
        family("tiny alpha", 3_000, 1e-2, tiny),
    ]
}

/// Drifts within ulps of beta, and phases at quarter and half periods or next to them.
fn borders() -> Vec<Family> {
    let drift = |random: &mut Random| {
        let (alpha, from) = (random.magnitude(-3.0, 2.0), from(random));
        let phase = any_phase(random);
        let mirrored = if from == From::Right { -1.0 } else { 1.0 };
        let side = if random.below(8) == 0 && matches!(from, From::Inside(_)) { -1.0 } else { 1.0 };
        let mut velocity = TAU * alpha * (side - mirrored * (TAU * phase).cos());
        match random.below(3) {
            0 => (0..random.below(9)).for_each(|_| velocity = velocity.next_up()),
            1 => (0..random.below(9)).for_each(|_| velocity = velocity.next_down()),
            _ => velocity *= 1.0 + random.magnitude(-16.0, -6.0) * random.sign(),
        }
        (velocity >= 0.0 || matches!(from, From::Inside(_))).then_some(Case { alpha, phase, velocity, from })
    };
    let quarter = |random: &mut Random| {
        let alpha = any_alpha(random);
        let phase =
            0.25 * (random.below(5) as f64 - 2.0) + random.pick(&[0.0, 1.0, -1.0]) * random.magnitude(-17.0, -2.0);
        let speeds = [0.0, 1.0, 2.0, random.magnitude(-6.0, 1.0)];
        let velocity = TAU * alpha * random.pick(&speeds);
        Some(Case { alpha, phase, velocity, from: from(random) })
    };
    vec![family("monotone border", 5_000, 1.0, drift), family("quarter turns", 5_000, 1.0, quarter)]
}

/// A multiple of a quarter period up to 2 forcing periods away, and 2^-1 to 2^-70 before, at or after it, as far as doubles go.
fn next_to_quarter(random: &mut Random) -> f64 {
    let quarter = 0.25 * (random.below(17) as f64 - 8.0);
    quarter + random.pick(&[0.0, 1.0, 1.0, -1.0, -1.0]) * (-1.0 - random.below(70) as f64).exp2()
}

/// A little: 10^-1 to 10^-60, or as small a power of two; now and then nothing.
fn little(random: &mut Random) -> f64 {
    match random.below(6) {
        0 => 0.0,
        1 | 2 => (-1.0 - random.below(200) as f64).exp2(),
        _ => random.magnitude(-60.0, -1.0),
    }
}

/// From a wall, and from next to one, beside quarter periods.
fn straddling() -> Vec<Family> {
    let amplitude =
        |random: &mut Random| random.pick(&[1.0, 1.0, 0.1, 0.5, 10.0, 1e-3, 1e3, 1e-30]) * random.pick(&[1.0, 0.9]);
    let on_wall = move |random: &mut Random| {
        let (alpha, phase) = (amplitude(random), next_to_quarter(random));
        let resting = TAU * alpha * (1.0 - (TAU * phase).cos());
        let velocity = match random.below(8) {
            0 => resting,
            1 => (resting * (1.0 + little(random))).abs(),
            2 => TAU * alpha * random.magnitude(-3.0, 1.0),
            _ => little(random),
        };
        Some(Case { alpha, phase, velocity, from: wall(random) })
    };
    let beside = move |random: &mut Random| {
        let (alpha, phase, sign) = (amplitude(random), next_to_quarter(random), random.sign());
        let height = match random.below(4) {
            0 => 1.0 - random.magnitude(-15.9, -1.0),
            1 => 0.5,
            2 => random.magnitude(-16.0, -1.0),
            _ => random.magnitude(-60.0, -1.0),
        };
        let velocity = match random.below(6) {
            0 => TAU * alpha * (sign - (TAU * phase).cos()),
            1 => -TAU * alpha * (TAU * phase).cos() + sign * little(random),
            2 => sign * TAU * alpha * random.magnitude(-3.0, 1.0),
            _ => sign * little(random),
        };
        Some(Case { alpha, phase, velocity, from: From::Inside(height) })
    };
    // A hop of about 1e-19 forcing periods, back to the same wall.
    let hop =
        |_: &mut Random| Some(Case { alpha: 1.0, phase: 0.5 - (-54f64).exp2(), velocity: 1e-33, from: From::Right });
    vec![
        family("walls, quarter turns", 20_000, 0.5, on_wall),
        family("next to walls, quarter turns", 20_000, 0.5, beside),
        family("a hop at a quarter turn", 1, 1.0, hop),
    ]
}

/// Grazes missed or cut by 1e-1 to 1e-15 of the gap.
fn grazes() -> Vec<Family> {
    let missed = |digits: i32| {
        let most_undecided = if digits <= 8 { 0.02 } else { 1.0 };
        family(&format!("graze missed or cut by 1e-{digits}"), 500, most_undecided, move |random| {
            let miss = random.sign() * 10f64.powi(-digits) * random.uniform(0.3, 1.0);
            near_graze(random, miss)
        })
    };
    (1..=15).map(missed).collect()
}

#[test]
fn no_contact_of_a_single_flight_is_false() {
    let families: Vec<_> =
        [plain(), slow(), extreme(), borders(), straddling(), grazes()].into_iter().flatten().collect();
    let (random, next) = (Random::seeded(101), AtomicUsize::new(0));
    let work = || {
        while let Some(family) = families.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (mut random, mut tally) = (random.clone(), Tally::new(&family.name));
            while tally.requested < cases(family.cases) {
                if let Some(case) = (family.draw)(&mut random) {
                    tally.flight(&case);
                }
            }
            tally.finish(family.most_undecided, family.widest);
        }
    };
    on_all_cores(work);
}

/// All corners of a box, and some of its members.
fn offsets(random: &mut Random) -> Vec<[f64; 4]> {
    let corner = |bits: u64| [0, 1, 2, 3].map(|axis| if bits >> axis & 1 == 0 { -1.0 } else { 1.0 });
    (0..16).map(corner).chain((0..4).map(|_| [0; 4].map(|_| random.uniform(-1.0, 1.0)))).collect()
}

#[test]
fn boxes_hold_the_contacts_of_their_members() {
    let mut random = Random::seeded(110);
    let mut tallies = [Tally::new("boxes 1e-3..1e-8"), Tally::new("boxes 1e-8..1e-14")];
    for index in 0..cases(3_000) {
        let alpha = random.magnitude(-2.0, 2.0);
        let from = from(&mut random);
        let velocity = TAU * alpha * random.magnitude(if index % 3 == 0 { -6.0 } else { -1.0 }, 1.0);
        let case = Case { alpha, phase: any_phase(&mut random), velocity, from };
        let case = if index % 4 == 0 { near_graze(&mut random, 1e-4).unwrap_or(case) } else { case };
        let exponents = [(-8.0, -3.0), (-14.0, -8.0)][index % 2];
        let sizes = [0; 4].map(|_| if random.below(3) == 0 { 0.0 } else { random.magnitude(exponents.0, exponents.1) });
        let point = case.point().radii;
        let radii = Radii {
            phase: sizes[0],
            velocity: sizes[1] * case.velocity.abs(),
            height: if point.height > 0.0 { point.height + sizes[2] } else { 0.0 },
        };
        let spread = Spread { radii, alpha: sizes[3] * case.alpha };
        tallies[index % 2].members(&case, spread, &offsets(&mut random));
    }
    tallies.iter_mut().for_each(|tally| tally.finish(1.0, f64::INFINITY));
}

/// Boxes around a start without velocity are certified for all their members, or not at all.
#[test]
fn boxes_that_may_rest_hold_the_contacts_of_their_members() {
    let mut random = Random::seeded(111);
    let mut tally = Tally::new("boxes around rest");
    for index in 0..cases(1_600) {
        let (alpha, from) = (random.magnitude(-2.0, 2.0), from(&mut random));
        let near = 0.5 * random.below(2) as f64 + random.magnitude(-9.0, -1.0) * random.sign();
        let phase = phase_in_frame(from, if index % 2 == 0 { near } else { any_phase(&mut random) });
        let velocity = TAU * alpha * random.magnitude(-9.0, -1.0);
        let case = Case { alpha, phase, velocity, from };
        // From less than the velocity to beyond it: in half of the boxes a member starts with exactly none.
        let share = if random.below(2) == 0 { 1.0 } else { random.uniform(0.1, 2.0) };
        let radius = if random.below(2) == 0 { 0.0 } else { random.magnitude(-12.0, -2.0) };
        let point = case.point();
        let spread = Spread { radii: Radii { phase: radius, velocity: share * velocity, ..point.radii }, ..point };
        let ends = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|at| [at, -1.0, 0.0, 0.0]);
        let offsets: Vec<_> = ends.into_iter().chain(offsets(&mut random)).collect();
        tally.members(&case, spread, &offsets);
    }
    tally.finish(1.0, f64::INFINITY);
}
