//! The impact map in plain doubles: it proposes, and proves nothing.
//!
//! Labels: proposes throughout.

use std::f64::consts::TAU;

use super::law::{Law, Side};
use super::quad::State;
use super::vector::times;
use crate::contact::first_contact_f64;
use crate::flight::Flight;
use crate::mapping::{Passage, jacobian};
use crate::number::{Kernel, kernel};
use crate::pair::{Reduced, Wall};

/// The impact map of a pair, every impact mirrored to the left wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guess {
    pair: Reduced<f64>,
    /// The radii of `D` and `e`.
    radii: [f64; 2],
}

/// The image of a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Image {
    /// Phase and speed. The phase goes on from the start's; half a forcing period is added where the far wall is touched.
    pub state: State,
    pub side: Side,
    /// The derivative of phase in forcing periods and speed over `A W`.
    pub jacobian: [[f64; 2]; 2],
    /// Displacements of the image by `D` and by `e`, each by its radius.
    pub moved: [State; 2],
}

impl Guess {
    pub fn new(law: &Law) -> Self {
        let pair = Reduced::new(1.0 / law.gap.mid(), law.restitution.mid());
        Self { pair, radii: [law.gap.rad(), law.restitution.rad()] }
    }

    /// State at the next impact; `None` where no impact is found, or its speed is 0.
    pub fn map(&self, [start, speed]: State) -> Option<Image> {
        let Reduced { beta, restitution, .. } = self.pair;
        let whole = start.floor();
        let phase = start - whole;
        let waves = kernel::sin_cos(phase);
        let flight = Flight::from_wall(&self.pair, Wall::Left, phase, restitution * speed * beta, waves);
        let contact = first_contact_f64::<Kernel>(&flight)?;
        let far = contact.wall == Wall::Right;
        let side = if far { Side::Far } else { Side::Near };
        let (sin1, _) = kernel::sin_cos(contact.phase);
        let passage =
            Passage { time: contact.time, sin0: waves.0, sin1, velocity0: -speed * beta, velocity1: contact.velocity };
        let [[a, b], [c, d]] = jacobian(beta, restitution, &passage)?;
        let sign = if far { 1.0 } else { -1.0 };
        let state = [start + contact.time + if far { 0.5 } else { 0.0 }, contact.velocity.abs() / beta];
        // Lemma D12: the delays that a wall's shift and a change of drift make, and the speeds at the later phase.
        let [gap, change] = [self.radii[0] * if far { 1.0 } else { 0.0 }, self.radii[1] * speed];
        let moved = [[gap, 0.0], [-TAU * contact.time * change, change]].map(|[ahead, drift]| {
            let delay = ahead / (TAU * sign * state[1]);
            [delay, sign * (drift + TAU * sin1 * delay)]
        });
        Some(Image { state, side, jacobian: [[a, -b * beta], [sign * c / beta, -sign * d]], moved })
    }

    /// Direction that `ahead` flights contract most, of length 1 in radians and speeds, its speed not negative.
    pub fn contracting(&self, state: State, ahead: usize) -> Option<State> {
        let mut product = [[1.0 / TAU, 0.0], [0.0, 1.0]];
        let mut at = state;
        for step in 0..ahead {
            let Some(image) = self.map(at) else {
                if step == 0 {
                    return None;
                }
                break;
            };
            at = image.state;
            product = times(image.jacobian, product);
            let size = product.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
            product = product.map(|row| row.map(|x| x / size));
        }
        // In radians on both sides.
        let [[a, b], [c, d]] = [product[0].map(|x| x * TAU), product[1]];
        let angle = 0.5 * (2.0 * (a * b + c * d)).atan2(a * a + c * c - b * b - d * d);
        let (sin, cos) = angle.sin_cos();
        // The dominant direction is (cos, sin).
        let direction = if cos < 0.0 { [sin, -cos] } else { [-sin, cos] };
        Some([direction[0] / TAU, direction[1]])
    }
}
