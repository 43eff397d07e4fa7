//! Motions that are not equispaced: all solutions of (62), (63) for given `d/A`, e and N, odd or even (Lemmas W5-W7).

use std::cmp::Ordering;

use super::angle::angle;
use super::isolate::{Interval, Part, refine, zeros};
use super::jet::Jet;
use super::motion::{Motion, Parameters};
use crate::exact::Real;
use crate::watch::Watch;

/// The equation of Lemma W5, whose zeros `eps` in `(0, N pi/2)` are the motions with `th1 - th0 = N pi + 2 eps`.
pub(super) struct Spacing<'p> {
    parameters: &'p Parameters,
    /// `lambda = (1 - e)/(1 + e)`; `None` for e = 1.
    lambda: Option<Real>,
    /// The sign of `2 - g`.
    room: Option<Ordering>,
}

/// The factors of the equation of Lemma W5, on one piece.
struct Factors {
    /// `|s|`
    sine: Jet,
    /// `E`
    width: Jet,
    /// `C`
    cosine: Jet,
    /// `P`
    product: Jet,
}

/// The piece of `(0, N pi/2)` between `quarter` and `quarter + 1` times `pi/2`, on which the signs are constant.
#[derive(Clone, Copy)]
struct Piece {
    cycles: u32,
    quarter: u32,
}

impl Piece {
    fn is_odd(self) -> bool {
        self.cycles % 2 == 1
    }

    /// Whether `sigma = sign(s k)` is 1.
    fn sigma(self) -> bool {
        (self.cycles + self.quarter).is_multiple_of(2)
    }

    fn sine_is_positive(self) -> bool {
        self.quarter % 4 < 2
    }

    fn cosine_is_positive(self) -> bool {
        matches!(self.quarter % 4, 0 | 3)
    }

    /// Whether `s = sin(N pi/2 + eps)` is positive.
    fn s_is_positive(self) -> bool {
        let of_eps = if self.is_odd() { self.cosine_is_positive() } else { self.sine_is_positive() };
        // sin(N pi/2) for N odd, cos(N pi/2) for N even.
        of_eps == (self.cycles % 4 < 2)
    }

    /// Whether `k = 0` at the beginning of the piece (`end` 0) or at its end (`end` 1), a multiple of `pi/2`.
    fn k_vanishes(self, end: u32) -> bool {
        // k is +-sin eps for N odd, +-cos eps for N even.
        (self.quarter + end).is_multiple_of(2) == self.is_odd()
    }
}

impl<'p> Spacing<'p> {
    /// `room` is the sign of `2 - g`, `Equal` where it is known to be exactly 0.
    pub fn new(parameters: &'p Parameters, room: Option<Ordering>) -> Self {
        let e = &parameters.restitution;
        let below = Real::int(1, e.bits()) - e;
        let is_elastic = below.sign() == Some(Ordering::Equal);
        let lambda = (!is_elastic).then(|| below.over(&(e + 1)).expect("e is not negative"));
        Self { parameters, lambda, room }
    }

    /// All motions that are not equispaced, mirror images included, and the undecided parts of `th1 - th0`: all remaining ones when the watch
    /// stops the search.
    pub fn solve(&self, watch: &dyn Watch) -> (Vec<Motion>, Vec<Real>) {
        let (mut motions, mut doubts) = (Vec::new(), Vec::new());
        let cycles = self.parameters.cycles;
        for quarter in 0..cycles {
            let piece = Piece { cycles, quarter };
            if !watch.goes_on() {
                let last = self.interval(Piece { cycles, quarter: cycles - 1 });
                doubts.extend(self.doubt(Part::Doubt(self.interval(piece).x.hull(&last.x))));
                break;
            }
            for part in zeros(&self.interval(piece), |eps| self.equation(eps, piece)) {
                match self.motion(&part, piece) {
                    Some(motion) => motions.extend([motion.mirrored(), motion]),
                    None => doubts.extend(self.doubt(part)),
                }
            }
        }
        (motions, doubts)
    }

    /// Whether the equispaced motion is the only one with `th1 - th0` within `2 reach` of `N pi`, N odd.
    pub fn is_alone(&self, reach: &Real) -> bool {
        let eps = Real::int(0, reach.bits()).hull(reach);
        let piece = Piece { cycles: self.parameters.cycles, quarter: 0 };
        let is_inside = (Real::pi(reach.bits()).half() - reach).is_positive();
        is_inside
            && self
                .equation(&eps, piece)
                .is_some_and(|f| matches!(f.value.sign(), Some(Ordering::Less | Ordering::Greater)))
    }

    /// The spacings of a part, and those of its mirror image.
    fn doubt(&self, part: Part) -> [Real; 2] {
        let (Part::Zero { x: eps, .. } | Part::Doubt(eps)) = part;
        let middle = self.parameters.half_period();
        [&middle - &eps * 2, middle + eps * 2]
    }

    fn interval(&self, piece: Piece) -> Interval {
        let quarter = self.parameters.half_period().over(&Real::int(2 * i64::from(piece.cycles), self.bits()));
        let quarter = quarter.expect("N is not 0");
        let [low, high] = [0, 1].map(|end| &quarter * i64::from(piece.quarter + end));
        let signs = [(0, &low), (1, &high)].map(|(end, at)| self.sign_at(piece, end, at));
        Interval { x: low.hull(&high), signs }
    }

    /// The sign of the equation at an end of a piece (Lemma W5).
    fn sign_at(&self, piece: Piece, end: u32, at: &Real) -> Option<Ordering> {
        let index = piece.quarter + end;
        let is_last = index == piece.cycles;
        match (piece.k_vanishes(end), &self.lambda) {
            (true, _) if index > 0 => {
                if piece.sigma() {
                    self.room
                } else {
                    Some(Ordering::Less)
                }
            }
            (false, Some(_)) => Some(Ordering::Less),
            (false, None) if is_last => Some(Ordering::Less),
            _ => self.equation(at, piece)?.value.sign(),
        }
    }

    fn bits(&self) -> u32 {
        self.parameters.bits()
    }

    /// `|s|`, `E`, `C` and `P` of Lemma W5; `None` where `sin eps/eps` cannot be enclosed.
    fn factors(&self, eps: &Real, piece: Piece) -> Option<Factors> {
        let x = Jet::argument(eps);
        let sin = x.sin().signed(piece.sine_is_positive());
        let cos = x.cos().signed(piece.cosine_is_positive());
        let quarter = Jet::constant(&self.parameters.half_period().half().square());
        let product = &quarter - &x.square();
        Some(if piece.is_odd() {
            let one = Jet::constant(&Real::int(1, self.bits()));
            let ratio = if piece.quarter == 0 { x.sinc() } else { x.sin_over()? };
            Factors { sine: cos, width: one, cosine: ratio.signed(piece.sine_is_positive()), product }
        } else {
            Factors { sine: sin, width: x, cosine: cos, product }
        })
    }

    /// `f` of Lemma W5, or of W7 (c) for e = 1.
    fn equation(&self, eps: &Real, piece: Piece) -> Option<Jet> {
        let factors = self.factors(eps, piece)?;
        let Factors { sine, width, cosine, product } = &factors;
        let ratio = Jet::constant(&self.parameters.ratio);
        let sum = &(width * sine).signed(piece.sigma()) + &(product * cosine);
        Some(match self.root(&factors) {
            None => &(&sum * 2) - &(&ratio * width),
            Some(root) => &(&(sine * &sum) * 4) - &(&ratio * &root?),
        })
    }

    /// `R`; none for e = 1, where it is `2E|s|`.
    fn root(&self, factors: &Factors) -> Option<Option<Jet>> {
        let lambda = self.lambda.as_ref()?;
        let swing = &Jet::constant(&(lambda * self.parameters.half_period())) * &factors.cosine;
        Some((&(&(&factors.width * &factors.sine).square() * 4) + &swing.square()).sqrt())
    }

    /// The motion of a zero; `None` if it cannot be enclosed.
    fn motion(&self, part: &Part, piece: Piece) -> Option<Motion> {
        let Part::Zero { x, left } = part else { return None };
        let eps = refine(x.clone(), *left, |eps| self.equation(eps, piece));
        let parameters = self.parameters;
        let factors = self.factors(&eps, piece)?;
        let (sine, width, cosine) = (&factors.sine.value, &factors.width.value, &factors.cosine.value);
        let period = parameters.half_period();
        let is_positive = piece.s_is_positive();
        let signed = |x: Real, is_positive: bool| if is_positive { x } else { -x };
        let (mean, speed) = match (self.root(&factors), &self.lambda) {
            (Some(root), Some(lambda)) => {
                let root = root?.value;
                let cos = signed((width * sine * 2).over(&root)?, is_positive != piece.sigma());
                let sin = signed((lambda * &period * cosine).over(&root)?, is_positive);
                let divisor = (&parameters.restitution + 1) * root;
                (angle(&sin, &cos)?, (&period * sine * cosine * 2).over(&divisor)?)
            }
            // cos m = -sigma sign(s), sin m = 0.
            _ => {
                let half_turn =
                    if is_positive == piece.sigma() { Real::pi(self.bits()) } else { Real::int(0, self.bits()) };
                (half_turn, (&period * cosine).over(&(width * 2))?)
            }
        };
        let theta0 = mean - period.half() - &eps;
        let spacing = period + eps * 2;
        speed.is_positive().then(|| Motion::unsymmetric(parameters.clone(), theta0, spacing, speed))
    }
}
