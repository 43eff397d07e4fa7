//! Test of a simulator of one's own: `cargo run --release --example simulator_on_trial`.
//!
//! Fixed steps, an impact where the ball is beyond a wall at the end of one, its time by linear interpolation: as many write it
//! first. On figure 14 the audit names the impact at which it diverges from the true orbit.

use std::f64::consts::PI;

use impact_pair::audit::{Audit, AuditSettings, Columns, read};
use impact_pair::watch::Unwatched;
use impact_pair::{Error, Scene};

const SCENE: &str = r#"
    excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    pair = { gap = 9.42497, restitution = 0.5 }
    start = { time = 0, wall = "left", velocity = -12.56636 }
"#;

/// `time,wall,velocity` of `impacts` impacts of the scene above.
fn simulated(step: f64, impacts: usize) -> String {
    let (amplitude, gap, restitution) = (8.0, 9.42497, 0.5);
    let acceleration = |t: f64| amplitude * PI * PI * (PI * t).sin();
    let (mut t, mut y, mut v) = (0.0f64, -gap / 2.0, 12.56636 * restitution);
    let mut list = String::from("time,wall,velocity\n");
    let mut listed = 0;
    while listed < impacts {
        let (before, a) = (y, acceleration(t));
        y += step * (v + 0.5 * step * a);
        v += 0.5 * step * (a + acceleration(t + step));
        t += step;
        if y.abs() >= gap / 2.0 {
            let wall = if y > 0.0 { "right" } else { "left" };
            let hit = t - step * (y.abs() - gap / 2.0) / (y - before).abs();
            list += &format!("{hit:?},{wall},{v:?}\n");
            y = gap / 2.0 * y.signum();
            v *= -restitution;
            listed += 1;
        }
    }
    list
}

fn main() -> Result<(), Error> {
    let scene = Scene::parse(SCENE)?;
    let requested = AuditSettings { tolerance: "1e-3".parse().expect("a number"), ..AuditSettings::default() };
    for step in [1e-4, 1e-5, 1e-6] {
        let list = read(&simulated(step, 60), &Columns::default(), scene.pair())?;
        let audit = Audit::of(&scene, list, &requested, &Unwatched)?;
        let right = audit.findings().iter().take_while(|finding| !finding.verdict.disagrees()).count();
        println!(
            "steps of {step:e}: the first {right} of 60 impacts are within a thousandth of a period; {}",
            audit.conclusion()
        );
    }
    Ok(())
}
