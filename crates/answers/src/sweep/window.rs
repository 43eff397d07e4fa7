//! Data of a point's orbit: the impacts after the transient, their frequency, and the growth of a disturbance.

use impact_pair::json::SweepImpact;

use impact_pair::exact::Enclosure;
use impact_pair::lyapunov::Disturbance;
use impact_pair::number::{Ball, Number};
use impact_pair::orbit::{Impact, Orbit, Progress, Reference};

/// The data kept of an orbit after its transient.
pub(super) struct Window<'u> {
    unit: &'u Reference,
    transient: u64,
    pub listed: u64,
    summary: bool,
    pub states: Vec<SweepImpact<Enclosure>>,
    /// `None` during the transient.
    pub disturbance: Option<Disturbance>,
    /// The first and the last impact.
    ends: Option<[Impact; 2]>,
    has_chatter: bool,
}

impl<'u> Window<'u> {
    pub fn new(orbit: &Orbit, (transient, summary): (u64, bool), unit: &'u Reference) -> Self {
        let disturbance = (transient == 0).then(|| Disturbance::of(orbit).in_turns_of(unit.rate()));
        let ends = orbit.start_impact().filter(|_| transient == 0).map(|start| [start.clone(), start]);
        Self { unit, transient, listed: 0, summary, states: Vec::new(), disturbance, ends, has_chatter: false }
    }

    pub fn follow(&mut self, orbit: &Orbit, event: &Progress) {
        if let Some(disturbance) = &mut self.disturbance {
            disturbance.follow(orbit, event);
            self.has_chatter |= matches!(event, Progress::Rest(rest) if rest.is_accumulation);
        }
        let Progress::Impact(impact) = event else { return };
        self.listed = impact.index;
        if impact.index < self.transient {
            return;
        }
        if impact.index == self.transient {
            self.disturbance = Some(Disturbance::at(orbit, impact.clone()).in_turns_of(self.unit.rate()));
        } else if !self.summary {
            let (phase, velocity) = (self.unit.phase(orbit, impact), orbit.velocity(impact));
            self.states.push(SweepImpact { index: impact.index, wall: impact.wall, phase, velocity });
        }
        match &mut self.ends {
            Some([_, last]) => *last = impact.clone(),
            None => self.ends = Some([impact.clone(), impact.clone()]),
        }
    }

    pub fn impacts_per_cycle(&self, orbit: &Orbit) -> Option<Ball> {
        let [first, last] = self.ends.as_ref().filter(|[first, last]| first.index < last.index)?;
        if self.has_chatter {
            return Some(Ball::exact(f64::INFINITY));
        }
        let turns = orbit.turns_between(first, last);
        let cycles = self.unit.rate().map_or(turns, |rate| turns * rate);
        Ball::exact((last.index - first.index) as f64).checked_div(cycles)
    }
}
