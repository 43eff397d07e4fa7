//! Check of a bifurcation JSON: at each fold, pitchfork and period doubling an orbit is proved again at which an eigenvalue passes
//! 1 or -1 (Lemma V9).
//!
//! The extended systems of the certificate's computation are not used: the orbits near the claimed orbit are proved to be one curve, over
//! the parameter or, at a fold, over phase or velocity, and `det(DP - mu)` to have opposite signs at two points of the curve.

use impact_pair_model::vocabulary::Bifurcation as Kind;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::Signed;

use super::budget::Budget;
use super::contact::Doubt;
use super::curve::{Cell, Curve, PARAMETER, Point};
use super::data::{Data, Piece};
use super::distinct::Recurrence;
use super::fixed_point::FixedPoint;
use super::frame::{Frame, hull};
use super::target::{MAX_BITS, Target, narrowest};
use super::walk::compare;
use super::{DocumentCheck, Limits, Verdict};
use crate::attraction::Bounds;
use crate::bifurcation::{BifurcationCertificate, ClaimedPoint};
use impact_pair_exact::{Exact, Real};
use impact_pair_model::scene::Key;
use impact_pair_model::watch::Watch;
use impact_pair_model::{Error, ImpactPair, Start};

/// log2 of the ratio of the claimed bounds to the box in which a bifurcation is proved.
const BOX_BITS_INSIDE: i64 = 24;
/// Bits of the arithmetic beyond those of the box.
const SPARE_BITS: i64 = 128;
/// Size of the largest box, as a power of 2.
const LARGEST_BOX: i64 = -40;

/// An impact pair over a parameter.
pub(super) struct ParameterFamily<'c> {
    pub pair: &'c ImpactPair,
    pub start: &'c Start,
    pub key: Key,
}

impl BifurcationCertificate {
    /// Proves every point again but the grazes, or names a point that is refuted or undecided. The watch can stop the check and receives
    /// the number of points checked so far.
    ///
    /// # Errors
    /// None: a value beyond the range of exact expressions leaves a point undecided.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let over = ParameterFamily { pair: &self.pair, start: &self.start, key: self.over };
        let whole = DocumentCheck {
            contradiction: self.contradiction.as_deref(),
            alike: None,
            count: self.count(),
            nothing: "there is no bifurcation to check but grazes",
        };
        let claims = self.points.iter().enumerate().filter(|(_, point)| point.kind != Kind::Graze);
        let judge = |point: &ClaimedPoint, budget: &Budget<'_>, _: &dyn Watch| {
            point.judged(&over, budget, ClaimedPoint::compare)
        };
        let verdict = whole.judged(claims, limits, watch, judge);
        let is_confirmed = matches!(verdict, Verdict::Confirmed { .. });
        Ok(match is_confirmed.then(|| self.are_distinct()) {
            Some(Err(doubt)) => doubt.on(self.count()),
            _ => verdict,
        })
    }

    /// Proves that each point is listed once, grazes included. Lemma V13
    fn are_distinct(&self) -> Result<(), Doubt> {
        let open = |i: usize, j: usize| Doubt::Open(format!("points[{i}] and points[{j}] are not proved to be two"));
        for (j, other) in self.points.iter().enumerate() {
            let alike = |(_, one): &(usize, &ClaimedPoint)| one.kind == other.kind && !one.is_elsewhere(other);
            for (i, one) in self.points[..j].iter().enumerate().filter(alike) {
                let over = ParameterFamily { pair: &self.pair, start: &self.start, key: self.over };
                let (_, data) = one.data(&over)?;
                let recurrence = Recurrence::of(&data).ok_or_else(|| open(i, j))?;
                if !recurrence.are_apart(&one.orbit, &other.orbit, false) {
                    return Err(open(i, j));
                }
            }
        }
        Ok(())
    }
}

impl ClaimedPoint {
    /// Proves that the point is a bifurcation, and returns the bits used; `compare` checks the other claims about the point. A different
    /// bifurcation nearby refutes nothing: there may be several.
    pub(super) fn judged(
        &self,
        parameter: &ParameterFamily<'_>,
        budget: &Budget,
        compare: impl Fn(&Self, &Curve<'_>, &Cell) -> Result<(), Doubt>,
    ) -> Result<u32, Doubt> {
        let open = |message: &str| Doubt::open(message);
        let over = parameter.key;
        match over {
            // Lemma R1
            Key::Frequency(_) if parameter.pair.excitation().only().is_some() => {
                return Err(Doubt::False("nothing bifurcates over the frequency".into()));
            }
            Key::Frequency(_) => {
                return Err(open("with several harmonics, bifurcations over a frequency are not supported"));
            }
            _ => {}
        }
        let (there, data) = self.data(parameter)?;
        let data = Data { budget: budget.clone(), ..data };
        let harmonic = match over {
            Key::Amplitude(_) => there.harmonic_of(over).map_err(|error| Doubt::Open(error.to_string()))?,
            _ => (0, None),
        };
        // Lemma V9: an orbit that runs through a shorter orbit several times has the bifurcations of the shorter orbit
        if self.orbit.times != Some(1) {
            return Err(open("only bifurcations of orbits of their least period are checked"));
        }
        let target = Target::new(&data, &self.word, self.cycles, &self.orbit)?;
        let is_symmetric = self.orbit.symmetric == Some(true);
        if self.kind == Kind::Pitchfork && !is_symmetric {
            return Err(Doubt::False("only a symmetric orbit has a pitchfork".into()));
        }
        let is_half = is_symmetric && self.kind != Kind::PeriodDoubling;
        let (walls, half) = (&target.walls, target.walls.len() / 2);
        let is_mirrored = (BigInt::from(self.cycles) / &target.turns).is_odd() && data.has_mirror() == Some(true);
        if is_half && !(is_mirrored && walls.len() % 2 == 0 && (0..half).all(|i| walls[i] != walls[i + half])) {
            return Err(Doubt::False("no orbit of the word is symmetric".into()));
        }
        let size = LARGEST_BOX.min(narrowest(self.bounds()).unwrap_or(0) - BOX_BITS_INSIDE); // proposes: a size to try
        let bits = SPARE_BITS - size;
        let bits = u32::try_from(bits)
            .ok()
            .filter(|&bits| bits <= MAX_BITS)
            .ok_or_else(|| open("the bounds are too narrow"))?;
        let found = self.found(&target, (over, harmonic), (bits, size, is_half), compare);
        found.map(|()| bits).map_err(|doubt| match doubt {
            Doubt::False(message) | Doubt::Open(message) => Doubt::Open(message),
        })
    }

    /// A pair near the point that has every harmonic with a positive amplitude nearby, and its data: the value in the scene, or an
    /// end of the bounds, may leave out a harmonic. Lemma V9
    fn data<'o>(&self, over: &ParameterFamily<'o>) -> Result<(ImpactPair, Data<'o>), Doubt> {
        let reason = |error: Error| Doubt::Open(error.to_string());
        let middle = (&self.parameter[0] + &self.parameter[1]) / BigInt::from(2);
        if !middle.is_positive() {
            return Err(Doubt::open("the parameter is not proved to be one of a pair"));
        }
        let there = over.pair.with(over.key, Exact::from_rational(middle)).map_err(reason)?;
        let data = Data::new(&there, over.start).map_err(reason)?;
        Ok((there, data))
    }

    /// Whether the bounds of two parameters are disjoint.
    fn is_elsewhere(&self, other: &Self) -> bool {
        self.parameter[1] < other.parameter[0] || other.parameter[1] < self.parameter[0]
    }

    /// The bounds that determine the size of the box.
    fn bounds(&self) -> impl Iterator<Item = &Bounds> {
        let impacts = self.orbit.impacts.iter().flat_map(|impact| [&impact.phase, &impact.velocity]);
        impacts.chain([&self.parameter])
    }

    fn found(
        &self,
        target: &Target<'_>,
        (over, harmonic): (Key, (usize, Option<Exact>)),
        (bits, size, is_half): (u32, i64, bool),
        compare: impl Fn(&Self, &Curve<'_>, &Cell) -> Result<(), Doubt>,
    ) -> Result<(), Doubt> {
        let open = |message: &str| Doubt::open(message);
        let parameter = hull(&self.parameter.each_ref().map(|bound| Real::rational(bound, bits)));
        let mut curve = Curve {
            target,
            frame: Frame::new(target.data, &Piece::default(), bits),
            over,
            harmonic,
            is_half,
            mu: if self.kind == Kind::Fold { 1 } else { -1 },
            units: [0; 3],
            times: Vec::new(),
        };
        let own = self.from.as_ref().map_or_else(|| parameter.middle(), |from| Real::rational(from, bits));
        curve.frame.parameters = curve.parameters(super::affine::Affine::fixed(own.middle()));
        if curve.frame.parameters.columns() > 0 {
            return Err(open("only bifurcations of a pair whose other data are points are checked"));
        }
        let first = target.first(&curve.frame);
        let guess = [first.phase.centre, first.velocity.centre, parameter.middle()];
        let unit = |x: &Real| x.enclosure().mag().top().ok_or_else(|| open("a velocity, or the parameter, is 0"));
        curve.units = [0, unit(&guess[1])?, unit(&guess[2])?]; // proposes: scales
        curve.times = target.times(&curve.frame)?;
        let near = self.crossed(&mut curve, guess.clone(), size, &compare);
        // The orbit of a window may be too far from its ends.
        if near.is_ok() || self.from.is_none() {
            return near;
        }
        curve.times = target.times(&curve.frame)?;
        let [phase, velocity, to] = guess;
        let guess = curve.walked([phase, velocity, own], &to)?;
        self.crossed(&mut curve, guess, size, &compare)
    }

    /// Proves that an eigenvalue passes 1 or -1 at an orbit near a guess, and that the orbit is as claimed.
    fn crossed(
        &self,
        curve: &mut Curve<'_>,
        guess: Point,
        size: i64,
        compare: &impl Fn(&Self, &Curve<'_>, &Cell) -> Result<(), Doubt>,
    ) -> Result<(), Doubt> {
        let at = curve.polish(guess)?;
        // A fold is a curve over phase or velocity, the other kinds over the parameter.
        let along: &[usize] = if self.kind == Kind::Fold { &[0, 1] } else { &[PARAMETER] };
        let mut answer = Err(Doubt::open("nothing is tried"));
        for &j in along {
            answer = curve.crossing(&at, j, size).and_then(|cell| compare(self, curve, &cell));
            if answer.is_ok() {
                break;
            }
        }
        answer
    }

    /// Proves that the parameter values of a box are as claimed.
    pub(super) fn compare_parameter(&self, curve: &Curve<'_>, cell: &Cell) -> Result<(), Doubt> {
        compare("parameter", &curve.spanned(cell, PARAMETER).hull(), &self.parameter)
    }

    /// Proves that all orbits of a box are as claimed.
    fn compare(&self, curve: &Curve<'_>, cell: &Cell) -> Result<(), Doubt> {
        self.compare_parameter(curve, cell)?;
        let value = curve.spanned(cell, PARAMETER);
        let one = Real::int(1, value.centre.bits());
        if !value.hull().is_positive() || curve.over == Key::Restitution && !value.hull().is_below(&one) {
            return Err(Doubt::open("the parameter is not proved to be one of a pair"));
        }
        let image = curve.image(cell, false)?;
        let derivative = image.derivative();
        let parameters = curve.parameters(value.clone());
        let frame = Frame { parameters, clock: curve.frame.clock.clone(), turn: curve.frame.turn.clone() };
        let mut data = curve.target.data.clone();
        if curve.over == Key::Restitution {
            let ends = value.hull().ends().map(|end| Exact::from_rational(end.mid().to_rational()));
            data.restitution = Exact::interval(&ends[0], &ends[1]).map_err(|error| Doubt::Open(error.to_string()))?;
        }
        let target = Target::new(&data, &self.word, self.cycles, &self.orbit)?;
        let round = target.round(&frame, curve.times.clone(), target.is_physical());
        target.compare(&frame, &FixedPoint::of_box(&round, image.landings, derivative, curve.is_half))
    }
}
