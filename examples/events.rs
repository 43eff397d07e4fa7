//! Lists the events of an orbit, each with its bounds, and how it ends: `cargo run --release --example events`.
//!
//! A ball that chatters: infinitely many impacts in finite time, rest, release, and so on for ever.

use impact_pair::orbit::{Orbit, Outcome};
use impact_pair::{Error, Scene};

const SCENE: &str = r#"
    [excitation]
    amplitude = 1
    frequency = "pi"
    phase = "pi"

    [pair]
    gap = 9.42497
    restitution = 0.3

    [start]
    time = 0
    wall = "left"
    velocity = -0.5

    [run]
    impacts = 40
    digits = 9
"#;

fn main() -> Result<(), Error> {
    let scene = Scene::parse(SCENE)?;
    println!("{}", scene.pair().in_words());
    let mut orbit = Orbit::new(scene.pair(), scene.start(), scene.settings())?;
    for event in orbit.events() {
        println!("{event}");
    }
    match orbit.outcome() {
        Some(Outcome::Periodic(period)) => {
            println!("proved to repeat for ever: {} listed impacts every {} cycles", period.impacts, period.cycles);
        }
        Some(outcome) => println!("{}", outcome.kind()),
        None => println!("it goes on"),
    }
    Ok(())
}
