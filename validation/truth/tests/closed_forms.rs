//! Orbits known in closed form, equations (56)-(71): exact parameters, exact impacts, no simulator as the judge.
//!
//! On S- with theta0 = tau (a start at t = 0), N odd, e < 1: v = -[2 A W/(1-e)] cos tau (66) and
//! d = 2 A sin tau + kappa N pi A cos tau (67), kappa = (1+e)/(1-e); impacts at t_i = i N pi/W on walls in turn, with
//! velocities -+v. e = 1: cos tau = 0 and d = +-2 A - N pi v/W (71); N even: |v| = d W/(N pi).

use crate::common::scene;
use crate::common::scene::{At, Scene, Value, objection};
use crate::common::{Random, cases};
use impact_pair::orbit::Impact;
use impact_pair_truth::{Contact, Wall, pi_times};
use rug::Float;
use std::f64::consts::PI;

const BITS: u32 = 512;

/// theta_g (Lemma W3): beyond it the near wall is grazed first; pi/2 when there is none.
fn grazing_angle(kappa: f64) -> f64 {
    // cos a = kappa cos th, cos a (a + th) = sin a + sin th; the left side minus the right one at th.
    let excess = |th: f64| {
        let a = (kappa * th.cos()).min(1.0).acos();
        a.cos() * (a + th) - a.sin() - th.sin()
    };
    let (mut low, mut high) = ((1.0 / kappa).acos(), PI / 2.0);
    if excess(low) <= 0.0 {
        return low;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Impacts every N pi/W with speed |v|, on walls in turn after the start's.
fn equispaced(scene: &Scene, n: u64, impacts: usize) -> Vec<Contact> {
    let At::Wall(start) = scene.at else { unreachable!() };
    let spacing = pi_times(BITS, n as i32) / scene.omega.member(BITS, 0.0);
    let exact = scene.velocity.exact().enclose(BITS);
    let speed = Float::with_val(BITS, scene::float(exact.inf()).abs());
    (1..=impacts)
        .map(|index| {
            let wall = if index % 2 == 0 { start } else { start.opposite() };
            let time = Float::with_val(BITS, &spacing * index as u32);
            Contact { time, wall, velocity_before: Float::with_val(BITS, &speed * wall.sign()) }
        })
        .collect()
}

/// Number of impacts that the library certifies, all of them on the closed form.
fn certified(scene: &Scene, n: u64, impacts: usize) -> usize {
    let mut orbit = scene.orbit(impacts as u64).unwrap_or_else(|error| panic!("{error}: {scene:?}"));
    let found: Vec<Impact> = orbit.by_ref().collect();
    if let Some(objection) = objection(&orbit, &found, &equispaced(scene, n, impacts)) {
        panic!("{objection}; N = {n}, {scene:?}");
    }
    found.len()
}

fn decimal(value: f64, digits: usize) -> f64 {
    format!("{value:.digits$}").parse().expect("a decimal")
}

fn frequency(random: &mut Random) -> String {
    if random.below(2) == 0 {
        format!("{}*pi", 1 + random.below(60))
    } else {
        format!("{}", decimal(random.magnitude(-1.0, 3.0), 4).max(0.01))
    }
}

#[test]
fn equispaced_orbits_of_66_to_69_return_after_every_n_pi_over_w() {
    let mut random = Random::seeded(301);
    let (mut stable, mut unstable, mut fewest) = (0, 0, 20);
    for _ in 0..cases(600) {
        let n = [1, 3, 5][random.below(3) as usize];
        let e = if random.below(6) == 0 { 0.0 } else { decimal(random.uniform(0.05, 0.9), 2) };
        let kappa = (1.0 + e) / (1.0 - e);
        let amplitude = decimal(random.magnitude(-1.0, 1.5), 3);
        let low = if kappa > 1.0 { -0.9 * grazing_angle(kappa) } else { 0.0 };
        // Half of them where the theory says stable.
        let upper = (2.0 / (n as f64 * PI * kappa)).atan();
        let lower = -(2.0 * kappa / (n as f64 * PI)).atan();
        let th = if random.below(2) == 0 {
            random.uniform(low.max(0.98 * lower), 0.98 * upper)
        } else {
            random.uniform(low, 1.4)
        };
        let th = decimal(th, 4);
        let slope = th.tan();
        let is_stable = 0.98 * lower < slope.atan() && slope.atan() < 0.98 * upper;
        let (tau, sign, wall) = if random.below(2) == 0 {
            (format!("({th})"), "", Wall::Left)
        } else {
            (format!("({th} + pi)"), "-", Wall::Right)
        };
        let omega = frequency(&mut random);
        let ratio = format!("({amplitude})*(1 + {e})/(1 - {e})");
        let gap = format!("{sign}(2*({amplitude})*sin{tau} + {ratio}*{n}*pi*cos{tau})");
        let velocity = format!("-2*({amplitude})*({omega})/(1 - {e})*cos{tau}");
        let scene = Scene {
            amplitude: Value::decimal(amplitude),
            omega: omega.as_str().into(),
            tau: tau.as_str().into(),
            gap: gap.as_str().into(),
            restitution: Value::decimal(e),
            time: "0".into(),
            velocity: velocity.as_str().into(),
            at: At::Wall(wall),
        };
        let found = certified(&scene, n, 20);
        if is_stable {
            stable += 1;
            assert_eq!(found, 20, "stable, N = {n}: {scene:?}");
        } else {
            unstable += 1;
            fewest = fewest.min(found);
            assert!(found >= 5, "{found} impacts, N = {n}: {scene:?}");
        }
    }
    println!("{stable} stable, {unstable} unstable equispaced orbits; the fewest impacts certified: {fewest}");
    assert!(stable > cases(100) && unstable > cases(100));
}

#[test]
fn elastic_orbits_of_70_and_71() {
    let mut random = Random::seeded(302);
    let mut all = 0;
    for _ in 0..cases(300) {
        let n = 1 + random.below(6);
        let gap = decimal(random.magnitude(-1.0, 2.0), 3);
        let (wall, direction) = if random.below(2) == 0 { (Wall::Left, "-") } else { (Wall::Right, "") };
        // sin tau in the frame of the wall: +1 or -1. The drift |v| is at least A W: monotone, no earlier contact.
        let crest = random.below(2) == 0;
        let tau = if crest == (wall == Wall::Left) { "pi/2" } else { "-pi/2" };
        let most = gap / (n as f64 * PI + if n % 2 == 1 && crest { 2.0 } else { 0.0 });
        let amplitude = decimal(most * random.uniform(0.01, 0.99), 5).max(1e-5);
        let omega = frequency(&mut random);
        let swing = match (n % 2, crest) {
            (0, _) => "",
            (_, true) => "- 2*",
            (_, false) => "+ 2*",
        };
        let reach = if swing.is_empty() { format!("{gap}") } else { format!("({gap} {swing}{amplitude})") };
        let velocity = format!("{direction}{reach}*({omega})/({n}*pi)");
        let scene = Scene {
            amplitude: Value::decimal(amplitude),
            omega: omega.as_str().into(),
            tau: tau.into(),
            gap: Value::decimal(gap),
            restitution: "1".into(),
            time: "0".into(),
            velocity: velocity.as_str().into(),
            at: At::Wall(wall),
        };
        // Elliptic or hyperbolic, by the sine of the phase and the length of the flight.
        let found = certified(&scene, n, 20);
        assert!(found >= 5, "{found} impacts, N = {n}: {scene:?}");
        all += usize::from(found == 20);
    }
    println!("{all} of {} elastic orbits certified for 20 impacts", cases(300));
    assert!(all > cases(100));
}

#[test]
fn figure_12_made_exact_comes_back_a_thousand_times() {
    let scene = Scene {
        amplitude: "1".into(),
        omega: "pi".into(),
        tau: "0".into(),
        gap: "3*pi".into(),
        restitution: "0.5".into(),
        time: "0".into(),
        velocity: "-4*pi".into(),
        at: At::Wall(Wall::Left),
    };
    assert_eq!(certified(&scene, 1, 1000), 1000);
    let mut orbit = scene.orbit(1000).expect("a scene");
    let last = orbit.by_ref().last().expect("impacts");
    let (time, velocity) = orbit.bounds(&last);
    let widths = [time, velocity].map(|bounds| bounds.wid().to_f64_up());
    println!("impact 1000: time within {:e}, velocity within {:e}", widths[0], widths[1]);
    assert!(widths[0] < 1e-13 && widths[1] < 1e-12);
}
