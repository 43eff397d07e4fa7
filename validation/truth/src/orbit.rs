//! Many impacts in a row.

use crate::flight::{Truth, first_contact};
use crate::problem::{Problem, Start, Wall};
use rug::Float;

/// One impact of an orbit.
#[derive(Clone, Debug)]
pub struct Contact {
    /// Absolute time.
    pub time: Float,
    /// The wall met.
    pub wall: Wall,
    /// y' just before; it points into the wall.
    pub velocity_before: Float,
}

impl Contact {
    /// The state just after this impact: v+ = -e v-, eq. (15).
    pub fn after(&self, problem: &Problem) -> Start {
        Start {
            time: self.time.clone(),
            position: problem.wall_at(self.wall),
            velocity_after: -Float::with_val(problem.precision(), &problem.restitution * &self.velocity_before),
            on: Some(self.wall),
        }
    }
}

/// The next `count` impacts from `start` (just after an impact, which is not repeated, or inside the gap).
///
/// Shorter than `count` when the ball rests, never meets a wall again or grazes ([`Truth`] of the last state tells
/// which). **Accuracy**: every impact is rounded to P bits, and the orbit multiplies earlier errors: chaos eats about
/// 0.6 bits an impact (figures 14 and 17), a slow impact its own log2(A W / v), a long chatter more. Choose P so
/// that what is left at the end is enough, and run again with 2 P if in doubt.
pub fn orbit(problem: &Problem, start: &Start, count: usize) -> Vec<Contact> {
    let mut contacts = Vec::with_capacity(count.min(1 << 20));
    let mut state = start.clone();
    while contacts.len() < count {
        let Truth::Contact { time, wall, velocity_before } = first_contact(problem, &state) else {
            break;
        };
        let contact = Contact { time, wall, velocity_before };
        state = contact.after(problem);
        contacts.push(contact);
    }
    contacts
}
