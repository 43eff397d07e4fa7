//! Hundreds of thousands of single flights: every certificate of `impact_pair::contact::first_contact` against the truth.

use crate::common::judge::{Case, From, Spread, Tally};
use crate::common::starts::{from, near_graze, phase_in_frame, wall};
use crate::common::{Random, cases};
use impact_pair::contact::Radii;
use std::f64::consts::TAU;

#[test]
fn plain_random_flights_from_a_wall_are_certified_in_narrow_brackets() {
    let mut random = Random::seeded(101);
    let mut tally = Tally::new("plain random");
    for index in 0..cases(24_000) {
        let alpha = random.magnitude(-3.0, 3.0);
        let case = Case {
            alpha,
            phase: random.uniform(-0.5, 0.5),
            velocity: match random.below(3) {
                0 => TAU * alpha * random.uniform(0.0, 1.0),
                1 => TAU * alpha * random.magnitude(-3.0, 2.0),
                _ => random.magnitude(-2.0, 2.0),
            },
            from: wall(&mut random),
        };
        tally.flight(&case, if index % 5 == 0 { 1000 } else { 0 });
    }
    tally.finish();
    assert!(tally.undecided_rate() < 1e-3);
    // In ulps of `turns + phase`, tiny ones for phases near 0 included.
    assert!(tally.quantile(0.5) <= 4.0);
}

#[test]
fn starts_inside_the_gap_at_any_speed_or_none() {
    let mut random = Random::seeded(102);
    let mut tally = Tally::new("inside");
    let mut resting = Tally::new("inside at rest");
    for index in 0..cases(6_000) {
        let alpha = random.magnitude(-3.0, 3.0);
        let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let mut start = from(&mut random);
        while !matches!(start, From::Inside(_)) {
            start = from(&mut random);
        }
        let rest = index % 5 == 0;
        let velocity = if rest { 0.0 } else { sign * TAU * alpha * random.magnitude(-6.0, 1.0) };
        let case = Case { alpha, phase: random.uniform(-0.5, 0.5), velocity, from: start };
        let tally = if rest { &mut resting } else { &mut tally };
        tally.flight(&case, if index % 4 == 0 { 1000 } else { 0 });
    }
    tally.finish();
    resting.finish();
    // The height of a start is known to 2^-53 only, and many of these are closer to a wall than 1e-9.
    assert!(tally.undecided_rate() < 1e-2 && resting.undecided_rate() < 0.1);
}

#[test]
fn releases_and_hops_of_almost_no_speed() {
    let mut random = Random::seeded(103);
    let mut released = Tally::new("v+ = 0");
    let mut tallies = [-3.0, -6.0, -9.0, -12.0, -15.0].map(|e| (e, Tally::new(&format!("chatter hops to 1e{e}"))));
    let mut free = Tally::new("tiny v+ while the wall recedes");
    for index in 0..cases(4_000) {
        let points = if index % 8 == 0 { 1000 } else { 0 };
        let (alpha, from) = (random.magnitude(-3.0, 3.0), wall(&mut random));
        let any = phase_in_frame(from, random.uniform(-0.5, 0.5));
        released.flight(&Case { alpha, phase: any, velocity: 0.0, from }, points);
        // Pressed (mirrored sine < 0): half a forcing period.
        let pressed = phase_in_frame(from, random.uniform(-0.5, 0.0));
        let receding = phase_in_frame(from, random.uniform(0.0, 0.5));
        for (exponent, tally) in &mut tallies {
            let velocity = TAU * alpha * random.magnitude(*exponent, *exponent + 3.0);
            tally.flight(&Case { alpha, phase: pressed, velocity, from }, points);
        }
        let velocity = TAU * alpha * random.magnitude(-15.0, -3.0);
        free.flight(&Case { alpha, phase: receding, velocity, from }, points);
    }
    released.finish();
    free.finish();
    for (_, tally) in &mut tallies {
        tally.finish();
        assert!(tally.undecided_rate() < 1e-2);
    }
}

#[test]
fn flights_of_up_to_a_hundred_thousand_periods_and_of_a_billionth() {
    let mut random = Random::seeded(104);
    let (mut long, mut short) = (Tally::new("long"), Tally::new("short"));
    for index in 0..cases(4_000) {
        let points = if index % 8 == 0 { 1000 } else { 0 };
        let from = wall(&mut random);
        // A small drift and no room to touch either wall in the first forcing period.
        let alpha = random.uniform(0.01, 0.5);
        let phase = phase_in_frame(from, random.uniform(0.05, 0.45));
        let mirrored = if from == From::Right { -1.0 } else { 1.0 };
        let drift = random.magnitude(-5.0, -1.0) * if random.below(3) == 0 { -1.0 } else { 1.0 };
        let velocity = drift - TAU * alpha * mirrored * (TAU * phase).cos();
        if velocity > 0.0 {
            long.flight(&Case { alpha, phase, velocity, from }, if drift.abs() > 1e-3 { points } else { 0 });
        }
        // Straight across.
        let velocity = random.magnitude(1.0, 9.0);
        let alpha = random.magnitude(-3.0, 3.0).min(velocity);
        short.flight(&Case { alpha, phase: random.uniform(-0.5, 0.5), velocity, from }, points);
    }
    long.finish();
    short.finish();
    assert!(long.undecided_rate() < 1e-2 && short.undecided_rate() < 1e-3);
}

#[test]
fn shaking_enormous_tiny_and_absent() {
    let mut random = Random::seeded(105);
    let (mut huge, mut tiny) = (Tally::new("huge alpha"), Tally::new("tiny alpha"));
    for index in 0..cases(3_000) {
        let points = if index % 8 == 0 { 1000 } else { 0 };
        let from = from(&mut random);
        let phase = random.uniform(-0.5, 0.5);
        let alpha = random.magnitude(3.0, 9.0);
        let velocity = TAU * alpha * random.magnitude(-9.0, 1.0);
        huge.flight(&Case { alpha, phase, velocity, from }, points);
        let alpha = if random.below(4) == 0 { 0.0 } else { random.magnitude(-12.0, -3.0) };
        let velocity = random.magnitude(-4.0, 3.0);
        tiny.flight(&Case { alpha, phase, velocity, from }, points);
    }
    huge.finish();
    tiny.finish();
    assert!(tiny.undecided_rate() < 1e-2);
}

#[test]
fn drifts_within_ulps_of_beta() {
    let mut random = Random::seeded(106);
    let mut tally = Tally::new("monotone border");
    for index in 0..cases(5_000) {
        let (alpha, from) = (random.magnitude(-3.0, 2.0), from(&mut random));
        let phase = random.uniform(-0.5, 0.5);
        let mirrored = if from == From::Right { -1.0 } else { 1.0 };
        let (beta, cos) = (TAU * alpha, mirrored * (TAU * phase).cos());
        let side = if random.below(8) == 0 && matches!(from, From::Inside(_)) { -1.0 } else { 1.0 };
        let mut velocity = beta * (side - cos);
        match random.below(3) {
            0 => (0..random.below(9)).for_each(|_| velocity = velocity.next_up()),
            1 => (0..random.below(9)).for_each(|_| velocity = velocity.next_down()),
            _ => velocity *= 1.0 + random.magnitude(-16.0, -6.0) * if random.below(2) == 0 { 1.0 } else { -1.0 },
        }
        tally.flight(&Case { alpha, phase, velocity, from }, if index % 8 == 0 { 1000 } else { 0 });
    }
    tally.finish();
}

#[test]
fn phases_at_quarter_and_half_periods() {
    let mut random = Random::seeded(107);
    let mut tally = Tally::new("quarter turns");
    for index in 0..cases(5_000) {
        let alpha = random.magnitude(-3.0, 3.0);
        let quarter = 0.25 * (random.below(5) as f64 - 2.0);
        let phase = match random.below(3) {
            0 => quarter,
            1 => quarter + random.magnitude(-17.0, -2.0),
            _ => quarter - random.magnitude(-17.0, -2.0),
        };
        let velocity = match random.below(4) {
            0 => 0.0,
            1 => TAU * alpha,
            2 => 2.0 * TAU * alpha,
            _ => TAU * alpha * random.magnitude(-6.0, 1.0),
        };
        let case = Case { alpha, phase, velocity, from: from(&mut random) };
        tally.flight(&case, if index % 8 == 0 { 1000 } else { 0 });
    }
    tally.finish();
}

#[test]
fn near_grazes_on_either_side() {
    let mut random = Random::seeded(108);
    let mut misses = Vec::new();
    for digits in 1..=15 {
        let mut tally = Tally::new(&format!("graze missed or cut by 1e-{digits}"));
        while tally.requested < cases(500) {
            let side = if random.below(2) == 0 { 1.0 } else { -1.0 };
            let miss = side * 10f64.powi(-digits) * random.uniform(0.3, 1.0);
            if let Some(case) = near_graze(&mut random, miss) {
                let points = if tally.requested.is_multiple_of(5) { 1000 } else { 0 };
                tally.flight(&case, points);
            }
        }
        misses.push(tally);
    }
    misses.iter_mut().for_each(Tally::finish);
    assert!(misses[..8].iter().all(|tally| tally.undecided_rate() < 0.02));
}

#[test]
fn mirror_images_get_the_same_bracket() {
    let mut random = Random::seeded(109);
    let (mut pairs, mut same) = (0, 0);
    let mut tally = Tally::new("mirrored");
    for _ in 0..cases(3_000) {
        let alpha = random.magnitude(-3.0, 3.0);
        // A multiple of 2^-53 in [-1/2, 0]: adding 1/2 is exact.
        let phase = -(random.below(1 << 52) as f64) / (1u64 << 53) as f64;
        let velocity = TAU * alpha * random.magnitude(-5.0, 1.0);
        let left = tally.flight(&Case { alpha, phase, velocity, from: From::Left }, 0);
        let right = tally.flight(&Case { alpha, phase: phase + 0.5, velocity, from: From::Right }, 0);
        let (Some(left), Some(right)) = (left, right) else {
            assert!(left.is_none() && right.is_none(), "{alpha} {phase} {velocity}: {left:?} {right:?}");
            continue;
        };
        pairs += 1;
        same += usize::from(left.time == right.time && left.velocity == -right.velocity);
        let close = (left.time.mid() - right.time.mid()).abs() <= left.time.rad() + right.time.rad();
        assert!(close && left.wall == right.wall.other(), "{alpha} {phase} {velocity}: {left:?} {right:?}");
    }
    println!("{same} of {pairs} mirrored brackets are the same doubles");
    tally.finish();
}

#[test]
fn boxes_hold_the_contacts_of_their_members() {
    let mut random = Random::seeded(110);
    let mut wide = Tally::new("boxes 1e-3..1e-8");
    let mut narrow = Tally::new("boxes 1e-8..1e-14");
    for index in 0..cases(3_000) {
        let alpha = random.magnitude(-2.0, 2.0);
        let from = from(&mut random);
        let velocity = TAU * alpha * random.magnitude(if index % 3 == 0 { -6.0 } else { -1.0 }, 1.0);
        let case = Case { alpha, phase: random.uniform(-0.5, 0.5), velocity, from };
        let case = if index % 4 == 0 { near_graze(&mut random, 1e-4).unwrap_or(case) } else { case };
        let exponents = if index % 2 == 0 { (-8.0, -3.0) } else { (-14.0, -8.0) };
        let sizes = [0; 4].map(|_| if random.below(3) == 0 { 0.0 } else { random.magnitude(exponents.0, exponents.1) });
        let point = case.point().radii;
        let radii = Radii {
            phase: sizes[0],
            velocity: sizes[1] * case.velocity.abs(),
            height: if point.height > 0.0 { point.height + sizes[2] } else { 0.0 },
        };
        let spread = Spread { radii, alpha: sizes[3] * case.alpha };
        let corner = |bits: u64| [0, 1, 2, 3].map(|axis| if bits >> axis & 1 == 0 { -1.0 } else { 1.0 });
        let mut offsets: Vec<[f64; 4]> = (0..16).map(corner).collect();
        offsets.extend((0..4).map(|_| [0; 4].map(|_| random.uniform(-1.0, 1.0))));
        let tally = if index % 2 == 0 { &mut wide } else { &mut narrow };
        tally.members(&case, spread, &offsets);
    }
    wide.finish();
    narrow.finish();
}

#[test]
fn boxes_that_may_rest_are_certified_for_all_their_members_or_not_at_all() {
    let mut random = Random::seeded(111);
    let mut tally = Tally::new("boxes around rest");
    for index in 0..cases(1_600) {
        let (alpha, from) = (random.magnitude(-2.0, 2.0), from(&mut random));
        let release = 0.5 * random.below(2) as f64;
        let near = release + random.magnitude(-9.0, -1.0) * if random.below(2) == 0 { 1.0 } else { -1.0 };
        let phase = phase_in_frame(from, if index % 2 == 0 { near } else { random.uniform(-0.5, 0.5) });
        let velocity = TAU * alpha * random.magnitude(-9.0, -1.0);
        let case = Case { alpha, phase, velocity, from };
        // From less than the velocity to beyond it: in half of the boxes a member starts with exactly none.
        let share = if random.below(2) == 0 { 1.0 } else { random.uniform(0.1, 2.0) };
        let radius = if random.below(2) == 0 { 0.0 } else { random.magnitude(-12.0, -2.0) };
        let point = case.point();
        let spread = Spread { radii: Radii { phase: radius, velocity: share * velocity, ..point.radii }, ..point };
        let mut offsets = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|at| [at, -1.0, 0.0, 0.0]).to_vec();
        offsets.extend([-1.0, 1.0].map(|at| [at, 1.0, 0.0, 0.0]));
        offsets.extend((0..3).map(|_| [0; 4].map(|_| random.uniform(-1.0, 1.0))));
        tally.members(&case, spread, &offsets);
    }
    tally.finish();
}
