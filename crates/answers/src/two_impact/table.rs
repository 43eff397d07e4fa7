//! Human-readable tables of two-impact motions and parameter manifolds.

use impact_pair::Scene;
use impact_pair::exact::{Enclosure, decimal_digits};
use impact_pair::pair::Wall;
use impact_pair::two_impact::word;
use impact_pair::two_impact::{Answer, Axis, Manifold, MeasuredOrbit, Orbit, Part, Stability, Unknown};

use crate::periodic::orbits;

/// The bits that eigenvalues are shown to.
const EIGENVALUE_BITS: u32 = 24;

/// The motions of each N.
pub fn motions(scene: &Scene, unknown: &Unknown, answers: &[Answer], wall: Wall) -> String {
    let mut lines: Vec<String> = scene.title().map(str::to_owned).into_iter().collect();
    lines.push(scene.pair().in_words());
    match unknown {
        Unknown::Velocity => {
            lines.push("given A and d: all motions with two impacts in N cycles, without sticking".into())
        }
        Unknown::Amplitude(speed) => lines.push(format!("given d and |v| = {speed}: A_N (68), equispaced")),
        Unknown::Gap(speed) => lines.push(format!("given A and |v| = {speed}: d (67), equispaced")),
    }
    for answer in answers {
        lines.push(format!("\nN = {}, {}: {}", answer.problem().cycles(), word(wall), description(answer)));
        for (index, found) in answer.orbits.iter().enumerate() {
            lines.extend(orbit(index + 1, found, unknown, wall));
        }
        for spacing in &answer.undecided {
            lines.push(format!("  undecided: there may be others with th1 - th0 = {}", decimal_digits(spacing)));
        }
    }
    lines.join("\n") + "\n"
}

/// Returns the number of orbits, and whether they are proved to be all orbits without sticking.
fn description(answer: &Answer) -> String {
    let count = orbits(answer.orbits.len());
    if answer.is_exhaustive { format!("{count}, proved to be all without sticking") } else { count }
}

fn orbit(index: usize, orbit: &Orbit, unknown: &Unknown, wall: Wall) -> Vec<String> {
    let mut lines = vec![format!("{index:>3}  {}", kind(&orbit.measured))];
    match unknown {
        Unknown::Velocity => {}
        Unknown::Amplitude(_) => lines.push(format!("     A = {}", decimal_digits(&orbit.amplitude))),
        Unknown::Gap(_) => lines.push(format!("     d = {}", decimal_digits(&orbit.gap))),
    }
    for impact in &orbit.measured.listed_from(wall).impacts {
        let (phase, velocity) = (decimal_digits(&impact.phase), decimal_digits(&impact.velocity));
        lines.push(format!("     {:5}  W t + tau = {phase:24} v = {velocity}", impact.wall.name()));
    }
    lines.push(format!("     eigenvalues {}", eigenvalues(&orbit.measured)));
    lines
}

fn kind(orbit: &MeasuredOrbit) -> String {
    let symmetry =
        if orbit.symmetric == Some(true) { "equispaced, its own mirror image" } else { "not its own mirror image" };
    let contacts = match orbit.physical {
        Some(true) => "no earlier contact",
        Some(false) => "VIRTUAL: a wall is touched earlier",
        None => "earlier contact undecided",
    };
    let stability = match orbit.stability {
        Stability::Stable | Stability::Unstable | Stability::Elliptic => orbit.stability.to_string(),
        Stability::Undecided => "stability undecided".to_owned(),
    };
    let unique = if orbit.unique { "" } else { "; others may be within these bounds" };
    format!("{symmetry}; {contacts}; {stability}{unique}")
}

fn eigenvalues(orbit: &MeasuredOrbit) -> String {
    let few = |x: &Enclosure| decimal_digits(&x.rounded(EIGENVALUE_BITS));
    let is_zero = |x: &Enclosure| x.inf().is_zero() && x.sup().is_zero();
    let [large, small] = &orbit.eigenvalues;
    if is_zero(&large.im) && is_zero(&small.im) {
        format!("{} and {}", few(&large.re), few(&small.re))
    } else {
        format!("{} +- {} i", few(&large.re), few(&large.im))
    }
}

/// The changes along the parameter manifolds.
pub fn manifolds(scene: &Scene, axis: Axis, curves: &[Manifold]) -> String {
    let mut lines: Vec<String> = scene.title().map(str::to_owned).into_iter().collect();
    let name = match axis {
        Axis::Frequency => "W",
        Axis::Velocity(_) => "v",
    };
    lines.push(format!("{}\nA_N (68) over {name}: where something changes\n", scene.pair().in_words()));
    lines.push(format!("{:>4}  {:9}  {name:26}{:26}from there on", "N", "mark", "A_N"));
    for curve in curves {
        let last = curve.points.len() - 1;
        for (index, point) in curve.points.iter().enumerate() {
            let mark = match point.mark {
                Some(mark) => mark.to_string(),
                None if index == 0 => "first".to_owned(),
                None if index == last => "last".to_owned(),
                None => continue,
            };
            let (at, amplitude) = (decimal_digits(&point.at), decimal_digits(&point.amplitude));
            let after = point.after.map_or(String::new(), part);
            lines.push(format!("{:>4}  {mark:9}  {at:26}{amplitude:26}{after}", curve.cycles).trim_end().to_owned());
        }
    }
    lines.join("\n") + "\n"
}

fn part(Part { is_solid, is_physical, stability }: Part) -> String {
    let sine = if is_solid { "sin th0 > 0" } else { "sin th0 < 0" };
    let contacts = if is_physical { "no earlier contact" } else { "virtual" };
    format!("{sine}, {contacts}, {stability}")
}
