//! A periodic orbit and a covering relation, proved with the impact map: `cargo run --release --example impact_map`.
//!
//! Figure 14, with every impact mirrored to the left wall: states are phase and speed, `[u, w]`, in forcing periods.

use impact_pair::impact_map::ImpactMap;
use impact_pair::number::{Ball, Number};
use impact_pair::{Scene, pair::Wall};

type Vector = [Ball; 2];
type Matrix = [Vector; 2];

/// Encloses the `count`-th images of a box, the phases counted from `near`, and the Jacobian over it.
fn image(map: &ImpactMap, states: Vector, count: usize, near: f64) -> (Vector, Matrix) {
    let states = map.states(Wall::Left, states[0], -states[1]).expect("speeds");
    let image = map.iterate(&states, count).expect("narrow enough");
    let [phase, speed] = image.states.mirrored();
    let whole = (phase.mid() - near).round();
    ([phase - Ball::exact(whole), speed], image.jacobian_of_speeds(Wall::Left))
}

fn times(m: &Matrix, x: Vector) -> Vector {
    [m[0][0] * x[0] + m[0][1] * x[1], m[1][0] * x[0] + m[1][1] * x[1]]
}

fn inverse([[a, b], [c, d]]: Matrix) -> Matrix {
    let unit = Ball::exact(1.0).checked_div(a * d - b * c).expect("regular");
    [[d * unit, -b * unit], [-c * unit, a * unit]]
}

/// One step of the interval Newton method for `f(x) = x`: all fixed points within `radius` of `x` lie in what it returns.
fn newton(map: &ImpactMap, x: [f64; 2], radius: f64, count: usize) -> Vector {
    let centre = x.map(Ball::exact);
    let (value, _) = image(map, centre, count, x[0]);
    let (_, [[a, b], [c, d]]) = image(map, x.map(|x| Ball::new(x, radius)), count, x[0]);
    let slope = [[a - Ball::exact(1.0), b], [c, d - Ball::exact(1.0)]];
    let step = times(&inverse(slope), [value[0] - centre[0], value[1] - centre[1]]);
    [centre[0] - step[0], centre[1] - step[1]]
}

/// The fixed point of the `count`-th iterate near `x`; the only one within `1e-7`, where Newton's step lies inside that box.
fn proved(map: &ImpactMap, mut x: [f64; 2], count: usize) -> Vector {
    (0..6).for_each(|_| x = newton(map, x, 0.0, count).map(Ball::mid));
    let found = newton(map, x, 1e-7, count);
    assert!(found.iter().zip(x).all(|(ball, x)| (ball.mid() - x).abs() + ball.rad() < 1e-7));
    found
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::parse(&std::fs::read_to_string("scenes/figure-14.toml")?)?;
    let map = ImpactMap::new(scene.pair())?;
    let orbit = proved(&map, [0.76987, 6.3426], 3);
    println!("an orbit of 3 impacts: phase and speed {orbit:?}");
    let saddle = proved(&map, [0.80279, 6.9469], 1).map(Ball::mid);

    // The h-set: `saddle + B x` with `|x0|, |x1| <= 1`, the columns of `B` along the eigenvectors, the expanding one first.
    let [[a, b], [c, d]] = image(&map, saddle.map(Ball::exact), 1, saddle[0]).1.map(|row| row.map(Ball::mid));
    let half = 0.5 * (a + d);
    let root = (half * half - a * d + b * c).sqrt().copysign(half);
    let sizes = [half + root, half - root].map(|eigenvalue| 1e-3 / b.hypot(eigenvalue - a));
    let basis = [[b * sizes[0], b * sizes[1]], [(half + root - a) * sizes[0], (half - root - a) * sizes[1]]];
    let basis = basis.map(|row| row.map(Ball::exact));
    let hull =
        [0, 1].map(|i| Ball::exact(saddle[i]) + Ball::new(0.0, basis[i][0].mag()) + Ball::new(0.0, basis[i][1].mag()));
    let (_, jacobian) = image(&map, hull, 1, saddle[0]);
    let (centre, _) = image(&map, saddle.map(Ball::exact), 1, saddle[0]);
    let column = |j: usize| times(&inverse(basis), times(&jacobian, [basis[0][j], basis[1][j]]));
    let [along, across] = [column(0), column(1)];
    let shift = times(&inverse(basis), [0, 1].map(|i| centre[i] - Ball::exact(saddle[i])));
    // `x0 = -1` and `x0 = 1` are mapped to either side of the h-set, and all of it between the sides `x1 = -1` and `x1 = 1`.
    assert!(along[0].mid().abs() - along[0].rad() - across[0].mag() - shift[0].mag() > 1.0);
    assert!(along[1].mag() + across[1].mag() + shift[1].mag() < 1.0);
    println!("a covering relation: an h-set at {saddle:?} covers itself, expanded {:.2} times", along[0].mid());
    Ok(())
}
