//! Motions with e = 1 that have a closed form: (70), (71), and those with `th1 = th0 + 2 j pi` (Lemma W7).

use std::cmp::Ordering;

use super::angle::acos;
use super::motion::{Motion, Parameters};
use crate::exact::Real;

/// The motions with `cos th0 = 0` for N odd (71), or with `th1 = th0 + 2 j pi`, and the spacings `2 j pi` that are not
/// decided.
pub(super) fn solve(parameters: &Parameters) -> (Vec<Motion>, Vec<Real>) {
    let (mut motions, mut doubts) = (Vec::new(), Vec::new());
    if parameters.cycles % 2 == 1 {
        for sin in [1, -1] {
            match quarter(parameters, sin) {
                Some(motion) => motions.extend(motion),
                None => doubts.push(parameters.half_period()),
            }
        }
    }
    for turns in 1..i64::from(parameters.cycles) {
        match whole_turns(parameters, turns) {
            Some(pair) => motions.extend(pair),
            None => doubts.push(Real::pi(parameters.bits()) * 2 * turns),
        }
    }
    (motions, doubts)
}

/// `th0 = +-pi/2`, `V = (g -+ 2)/(N pi)`: one motion, or none; `None` if that is not decided. **Equation** (71)
fn quarter(parameters: &Parameters, sin: i64) -> Option<Vec<Motion>> {
    let speed = (&parameters.ratio - 2 * sin).over(&parameters.half_period())?;
    let zero = Real::int(0, parameters.bits());
    match speed.sign()? {
        Ordering::Greater => {
            Motion::symmetric(parameters.clone(), (&zero + sin, zero), speed).map(|motion| vec![motion])
        }
        // No speed: no impact.
        Ordering::Less | Ordering::Equal => Some(Vec::new()),
    }
}

/// `th1 = th0 + 2 j pi`: two motions, or none; `None` if that is not decided.
pub(super) fn whole_turns(parameters: &Parameters, turns: i64) -> Option<Vec<Motion>> {
    let cycles = i64::from(parameters.cycles);
    let turn = Real::pi(parameters.bits()) * 2;
    let speed = (&parameters.ratio * cycles).over(&(&turn * 2 * turns * (cycles - turns)))?;
    let cos = (&speed * (cycles - 2 * turns)).over(&Real::int(cycles, parameters.bits()))?;
    let room = Real::int(1, parameters.bits()) - cos.square();
    if room.is_negative() {
        return Some(Vec::new());
    }
    let theta0 = Some(acos(&cos)?).filter(|_| room.is_positive())?;
    let motion = |theta0| Motion::unsymmetric(parameters.clone(), theta0, &turn * turns, speed.clone());
    Some(vec![motion(-&theta0), motion(theta0)])
}
