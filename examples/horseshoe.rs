//! A horseshoe, proved: `cargo run --release --example horseshoe`.
//!
//! Figure 14 of the paper: a horseshoe, two blocks of impacts that follow one another
//! in any order whatever, for ever.

use impact_pair::chaos::{Chaos, HorseshoeSettings, Word};
use impact_pair::watch::Unwatched;
use impact_pair::{Error, Scene};

const SCENE: &str = r#"
    excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    pair = { gap = 9.42497, restitution = 0.5 }
    start = { time = 0, wall = "left", velocity = -12.56636 }
"#;

fn main() -> Result<(), Error> {
    let scene = Scene::parse(SCENE)?;
    let chaos =
        Chaos::of_scene(&scene, &HorseshoeSettings { depth: Some(8), ..HorseshoeSettings::default() }, &Unwatched)?;
    println!("{} words of at most {} impacts, {} boxes", chaos.words().len(), chaos.depth(), chaos.boxes());
    println!(
        "topological entropy at least {:.4} per impact, {:.4} per forcing period",
        chaos.entropy(),
        chaos.entropy_a_cycle()
    );
    if let Some(pair) = chaos.horseshoe() {
        let [one, other] = pair.map(Word::as_block);
        println!("each block is {one} or {other}, in any order");
    }
    Ok(())
}
