//! Certifies the next impacts of many states, each by itself, and says the seconds it took and how many are decided:
//! `python/benches/overhead` asks Python for the same.

use std::time::Instant;

use impact_pair::Scene;
use impact_pair::orbit::Arrivals;
use impact_pair::pair::Wall;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count: u32 = std::env::args().nth(1).as_deref().unwrap_or("1000").parse()?;
    let scene = Scene::parse(include_str!("../../scenes/figure-14.toml"))?;
    let begun = Instant::now();
    let arrivals = Arrivals::new(scene.pair())?;
    let mut found = Vec::new();
    for i in 0..count {
        let wall = if i % 2 == 0 { Wall::Left } else { Wall::Right };
        let speed = 1.0 + f64::from(i * 37 % 1000) * 0.03;
        found.push(arrivals.next(wall, f64::from(i) * 0.001, -wall.sign() * speed)?.ok());
    }
    let took = begun.elapsed().as_secs_f64();
    println!("{took} {}", found.iter().flatten().count());
    Ok(())
}
