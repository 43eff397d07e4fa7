//! H-sets, proposed from a floating-point orbit: parallelograms along the leaves of an attractor. Covering relations are proved
//! later.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::flights::is_positive;
use super::guess::Guess;
use super::law::Law;
use super::propose::Making;
use super::quad::State;
use super::seen::{AttractorOrbit, step};
use super::trials::{DEPTH, Rounds, SLOW, Trials};
use super::tube::side_of;
use super::vector::{GENERIC, apart, cross};
use super::words::HSet;
use crate::watch::Watch;

/// The most impacts of returns that are looked for, and the number of nearest returns that are kept of each.
const MAX_RETURN_IMPACTS: usize = 12;
const KEPT_RETURNS: usize = 8;
/// Distance within which a state counts as a return, and beyond which two returns count as different; phases in radians.
const RETURN_DISTANCE: f64 = 0.02;
/// Numbers of phases and of speeds at which transients begin, and the factor of the greatest speed over the greatest one seen.
const TRANSIENT_STARTS: [usize; 2] = [48, 24];
const SPEED_FACTOR: f64 = 1.5;
/// The impacts from which on transients are looked at, and up to which, and the distance from the orbit within which they end.
const TRANSIENT_IMPACTS: [usize; 2] = [6, 80];
const ORBIT_DISTANCE: f64 = 0.01;
/// The least number of impacts, and the least growth per impact, of transients that see a saddle.
const MIN_TRANSIENT: usize = 16;
const MIN_GROWTH: f64 = 0.1;
/// The most impacts of words by which bundles of leaves are compared.
const COMPARED_DEPTH: usize = 20;
/// Parts of the depth up to which words are seen, by which h-sets from everywhere are compared: long ones are often seen where none are proved.
const DEPTH_FRACTIONS: [f64; 3] = [1.0, 0.75, 0.5];
/// Half lengths, phases in radians, and half widths relative to them.
pub(super) const LENGTHS: [f64; 7] = [0.3, 0.2, 0.13, 0.08, 0.05, 0.03, 0.015];
const WIDTHS: [f64; 7] = [0.001, 0.002, 0.005, 0.01, 0.02, 0.04, 0.08];
impl AttractorOrbit {
    /// Transients of a regular orbit: points of orbits from elsewhere before they come near it. A horseshoe may be there as a
    /// saddle.
    pub fn transients(&self, guess: &Guess) -> Self {
        let attractor: Vec<State> =
            self.points.iter().rev().take(MAX_RETURN_IMPACTS * MAX_RETURN_IMPACTS).map(|(state, _)| *state).collect();
        let fastest = SPEED_FACTOR * attractor.iter().fold(0.0, |most: f64, state| most.max(state[1]));
        let mut points = Vec::new();
        for start in 0..TRANSIENT_STARTS[0] * TRANSIENT_STARTS[1] {
            let (i, j) = (start / TRANSIENT_STARTS[1], start % TRANSIENT_STARTS[1]);
            let mut state = [
                (i as f64 + 0.5) / TRANSIENT_STARTS[0] as f64,
                fastest * (j as f64 + 0.5) / TRANSIENT_STARTS[1] as f64,
            ];
            let (mut direction, mut passed, mut sum) = (GENERIC, Vec::new(), 0.0);
            for k in 0..TRANSIENT_IMPACTS[1] {
                let Some(growth) = step(guess, &mut state, &mut direction) else { break };
                if attractor.iter().any(|&other| apart(state, other) < ORBIT_DISTANCE) {
                    break;
                }
                if k >= TRANSIENT_IMPACTS[0] {
                    passed.push((state, direction));
                    sum += growth.ln();
                }
            }
            if passed.len() >= MIN_TRANSIENT && sum > MIN_GROWTH * passed.len() as f64 {
                points.append(&mut passed);
            }
        }
        Self { points, exponent: self.exponent }
    }

    /// Points that the orbit comes back to very closely: saddles are near.
    fn centres(&self) -> Vec<(State, State)> {
        let mut found: Vec<(State, State)> = Vec::new();
        for period in 1..=MAX_RETURN_IMPACTS {
            let mut returns: Vec<(f64, usize)> = (0..self.points.len().saturating_sub(period))
                .map(|k| (apart(self.points[k].0, self.points[k + period].0), k))
                .filter(|(distance, _)| *distance < RETURN_DISTANCE)
                .collect();
            returns.sort_by(|a, b| a.0.total_cmp(&b.0));
            let before = found.len();
            for (_, k) in returns {
                let point = self.points[k];
                if found.iter().all(|other| apart(point.0, other.0) > RETURN_DISTANCE) {
                    found.push(point);
                }
                if found.len() == before + KEPT_RETURNS {
                    break;
                }
            }
        }
        found
    }

    /// H-sets along the leaves, most often crossed first.
    fn candidates(&self, guess: &Guess, making: Making) -> Vec<HSet> {
        let mut scored: Vec<(f64, HSet)> = Vec::new();
        for (centre, along) in self.centres() {
            let Some(across) = guess.contracting(centre, making.ahead) else { continue };
            let determinant = cross(along, across);
            if TAU * determinant.abs() < 0.2 {
                continue;
            }
            // `(xi, eta)` and the leaf's slope there.
            let in_coordinates = |[u, w]: State| {
                [(u * across[1] - w * across[0]) / determinant, (along[0] * w - along[1] * u) / determinant]
            };
            let near: Vec<[f64; 3]> = self
                .points
                .iter()
                .filter_map(|&([u, w], direction)| {
                    let phase = u - centre[0];
                    let [xi, eta] = in_coordinates([phase - phase.round(), w - centre[1]]);
                    let [run, rise] = in_coordinates(direction);
                    (xi.abs() < LENGTHS[0] && eta.abs() < LENGTHS[0] * 0.1).then(|| [xi, eta, rise / run])
                })
                .collect();
            for long in LENGTHS {
                let best = WIDTHS
                    .iter()
                    .map(|width| {
                        let width = width * long;
                        let crosses = |&&[xi, eta, slope]: &&[f64; 3]| {
                            let at = |end: f64| (eta + slope * (end * 1.1 * long - xi)).abs() < 0.9 * width;
                            xi.abs() < long && eta.abs() < 0.9 * width && at(1.0) && at(-1.0)
                        };
                        let is_in_strip = |&&[xi, eta, _]: &&[f64; 3]| xi.abs() < long && eta.abs() < 1.2 * width;
                        let good = near.iter().filter(crosses).count() as f64;
                        let all = near.iter().filter(is_in_strip).count() as f64;
                        (good * (good / (all + 1.0)), width)
                    })
                    .fold((0.0, 0.0), |best, next| if next.0 > best.0 { next } else { best });
                if best.0 > 0.0 {
                    let base = HSet::new(centre, along.map(|x| x * long), across.map(|x| x * best.1));
                    scored.push((best.0, base));
                }
            }
        }
        scored.sort_by(|a, b| b.0.total_cmp(&a.0));
        scored.into_iter().map(|(_, base)| base).filter(HSet::is_convex).collect()
    }

    /// H-sets with the most entropy of all candidates: about bundles of leaves, or else along saddles, or else from everywhere.
    pub fn bases(
        &self,
        law: &Law,
        ([making, fine], depth): ([Making; 2], usize),
        rounds: Rounds,
        watch: &dyn Watch,
    ) -> Vec<HSet> {
        let guess = Guess::new(law);
        let trials = Trials { law, making, depth, rounds, watch };
        if rounds.bundled {
            let impacts = depth.min(COMPARED_DEPTH);
            let bundles = self.bundles(&guess, impacts, watch);
            let found = [making, fine].into_iter().find_map(|making| {
                let trials = Trials { making, ..trials };
                trials.best_bundle(&bundles, &|bundle| self.with_gap_toggled(&guess, bundle, impacts))
            });
            if let Some(found) = found {
                return found;
            }
        }
        let found = trials.best(&self.candidates(&guess, making));
        if !found.is_empty() || !rounds.everywhere || !watch.goes_on() {
            return found;
        }
        let from_everywhere = |depth: usize| {
            let trials = Trials { making: fine, depth, rounds: SLOW, ..trials };
            trials.best(&self.crossed(&guess, (fine, depth)))
        };
        let mut depths = DEPTH_FRACTIONS.map(|part| (part * depth.min(DEPTH) as f64) as usize).to_vec();
        depths.dedup();
        depths
            .into_iter()
            .filter(|depth| *depth > 0)
            .map(from_everywhere)
            .find(|found| !found.is_empty() || !watch.goes_on())
            .unwrap_or_default()
    }
}

impl HSet {
    /// Whether this h-set and `other`, also shifted by whole forcing periods, are disjoint: an edge separates them. Lemma D9
    pub fn is_apart(&self, other: &Self) -> bool {
        (-3..=3).all(|turns| self.is_parted(other, f64::from(turns)) || other.is_parted(self, f64::from(-turns)))
    }

    /// Whether the h-set is disjoint from its translates by whole forcing periods. An edge separates it from its translate by
    /// one forcing period, and so from all, as the h-set is convex. Lemma D9
    pub fn is_apart_from_its_translates(&self) -> bool {
        self.is_parted(self, 1.0) || self.is_parted(self, -1.0)
    }

    /// Whether all phases of the h-set are from -1 to 2 and all speeds positive.
    pub fn is_near(&self) -> bool {
        let corners = [self.left.bottom, self.left.top, self.right.bottom, self.right.top];
        corners.iter().all(|&[phase, speed]| (-1.0..=2.0).contains(&phase) && speed > 0.0)
    }

    fn is_parted(&self, other: &Self, turns: f64) -> bool {
        let [one, two] = [self, other].map(|Self { left, right }| [left.bottom, right.bottom, right.top, left.top]);
        (0..4).any(|i| two.iter().all(|&state| is_positive(-side_of(one[i], one[(i + 1) % 4], state, turns))))
    }
}
