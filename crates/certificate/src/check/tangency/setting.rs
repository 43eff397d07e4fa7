//! The data of a pair as data of its reduced map, `D = d/A` and `e`, over one parameter.

use super::saddle::Family;
use crate::check::contact::Doubt;
use crate::check::units::ratio;
use impact_pair_exact::{Exact, Real};
use impact_pair_model::scene::Key;
use impact_pair_model::{Error, ImpactPair};

/// The exact data of a pair in the units of its reduced map, and the parameter in these units.
pub(in crate::check) struct Setting {
    /// `A` if the gap varies, `d` if the amplitude varies; 1 if the restitution varies.
    pub unit: Exact,
    /// `e`, or `D = d/A` if the restitution varies.
    pub other: Exact,
    pub key: Key,
}

impl Setting {
    /// The data of a pair with one harmonic, all points but the parameter.
    pub fn new(pair: &ImpactPair, key: Key) -> Result<Self, Doubt> {
        let setting = Self::of_all(pair, key)?;
        if setting.other.is_point() {
            Ok(setting)
        } else {
            Err(Doubt::open("only reduced maps of a pair whose other data are points are checked"))
        }
    }

    /// The data of a pair with one harmonic, where `e`, or `D` if the restitution varies, may be an interval.
    pub fn of_all(pair: &ImpactPair, key: Key) -> Result<Self, Doubt> {
        let reason = |error: Error| Doubt::Open(error.to_string());
        let harmonic = pair
            .excitation()
            .only()
            .ok_or_else(|| Doubt::open("with several harmonics, reduced maps are not checked"))?;
        let restitution = || pair.restitution().clone();
        let (unit, other) = match key {
            Key::Gap => (harmonic.amplitude().clone(), restitution()),
            Key::Amplitude(_) => match pair.harmonic_of(key).map_err(reason)? {
                (_, None) => (pair.gap().clone(), restitution()),
                (_, Some(_)) => return Err(Doubt::open("reduced maps over one of several terms are not checked")),
            },
            Key::Restitution => (Exact::from(1), ratio(pair, harmonic).map_err(reason)?),
            _ => return Err(Doubt::open("only reduced maps over gap, amplitude and restitution are checked")),
        };
        if unit.is_point() {
            Ok(Self { unit, other, key })
        } else {
            Err(Doubt::open("over the gap only pairs of one amplitude are checked, over the amplitude of one gap"))
        }
    }

    /// The reduced maps for all values of the parameter.
    pub fn family(&self, bits: u32) -> Family {
        Family { is_restitution: self.is_restitution(), other: Real::of(&self.other, bits) }
    }

    /// `D = d/A` or `e` for values of the parameter.
    pub fn reduced(&self, parameter: &Real) -> Result<Real, Doubt> {
        let unit = Real::of(&self.unit, parameter.bits());
        let quotient = if self.is_falling() { unit.over(parameter) } else { parameter.over(&unit) };
        quotient.filter(Real::is_positive).ok_or_else(|| Doubt::open("the parameter is not proved to be positive"))
    }

    /// The parameter for values of `D` or `e`.
    pub fn parameter(&self, reduced: &Real) -> Option<Real> {
        let unit = Real::of(&self.unit, reduced.bits());
        if self.is_falling() { unit.over(reduced) } else { Some(unit * reduced) }
    }

    /// Whether the parameter is `e`.
    pub fn is_restitution(&self) -> bool {
        self.key == Key::Restitution
    }

    /// Whether `D` decreases as the parameter grows.
    pub fn is_falling(&self) -> bool {
        matches!(self.key, Key::Amplitude(_))
    }
}
