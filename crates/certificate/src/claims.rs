//! Documents of every verb, and what `check` proves of them.

use std::sync::atomic::AtomicBool;

use serde_json::{Deserializer, Value};

use crate::document::{BIFURCATION_SCHEMA, MANIFOLD_SCHEMA, PERIODIC_SCHEMA, SWEEP_SCHEMA};
use crate::{BifurcationCertificate, Certificate, ClaimKind, Effort, Finding, PeriodicCertificate, Verdict};
use impact_pair_model::Error;

/// What a document claims.
#[derive(Clone, Debug)]
pub enum Claims {
    /// An orbit JSON: all its events and its outcome are checked.
    Orbit(Box<Certificate>),
    /// A periodic JSON, or that of two-impact motions: all its orbits are checked, not that there are no others.
    Periodic(Box<PeriodicCertificate>),
    /// A bifurcation JSON: its folds, pitchforks and period doublings are checked, not its grazes, and not that there are no others.
    Bifurcations(Box<BifurcationCertificate>),
    /// Nothing of it is checked, for the reason told.
    Unchecked(&'static str),
}

impl Claims {
    /// Reads a document of any verb, by its schema; an orbit JSON where there is none.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let head = Deserializer::from_str(text).into_iter::<Value>().next().and_then(Result::ok);
        let schema = head.as_ref().and_then(|head| head["schema"].as_str());
        Ok(match schema {
            Some(PERIODIC_SCHEMA)
                if head
                    .as_ref()
                    .is_some_and(|head| !matches!(head["solved_for"].as_str(), None | Some("velocity"))) =>
            {
                Self::Unchecked("motions solved for the amplitude or the gap: their scene has another one")
            }
            Some(PERIODIC_SCHEMA) => Self::Periodic(Box::new(PeriodicCertificate::parse(text)?)),
            Some(BIFURCATION_SCHEMA) => Self::Bifurcations(Box::new(BifurcationCertificate::parse(text)?)),
            Some(MANIFOLD_SCHEMA) => Self::Unchecked("manifolds: that their points solve (66)-(69)"),
            Some(SWEEP_SCHEMA) => Self::Unchecked("sweep points: run their scenes, and check what run writes"),
            _ => Self::Orbit(Box::new(Certificate::parse(text)?)),
        })
    }

    /// Proves every claim again, or says which one is not true or not proved, until `stop` is set, if there is one. `progress` is told
    /// the claims confirmed so far.
    ///
    /// # Errors
    /// When the scene's values are beyond what exact expressions hold.
    pub fn check_until(
        &self,
        effort: &Effort,
        stop: Option<&'static AtomicBool>,
        progress: impl FnMut(usize),
    ) -> Result<Verdict, Error> {
        match self {
            Self::Orbit(certificate) => certificate.check_until(effort, stop, progress),
            Self::Periodic(certificate) => certificate.check_until(effort, stop, progress),
            Self::Bifurcations(certificate) => certificate.check_until(effort, stop, progress),
            Self::Unchecked(_) => {
                Ok(Verdict::Undecided(Finding { event: 0, message: "nothing of it is checked".to_owned() }))
            }
        }
    }

    /// How many claims come one after another: events, orbits.
    pub fn count(&self) -> usize {
        match self {
            Self::Orbit(certificate) => certificate.events().len(),
            Self::Periodic(certificate) => certificate.count(),
            Self::Bifurcations(certificate) => certificate.count(),
            Self::Unchecked(_) => 0,
        }
    }

    /// What of it is not judged: keys, or words.
    pub fn unjudged(&self) -> Vec<&str> {
        match self {
            Self::Orbit(certificate) => certificate.unjudged().iter().map(String::as_str).collect(),
            Self::Periodic(certificate) => certificate.unjudged().iter().map(String::as_str).collect(),
            Self::Bifurcations(certificate) => certificate.unjudged().iter().map(String::as_str).collect(),
            Self::Unchecked(why) => vec![why],
        }
    }

    /// The first claims, in words.
    pub fn first(&self, count: usize) -> String {
        match self {
            Self::Orbit(certificate) => {
                let is_impact = |kind: &ClaimKind| matches!(kind, ClaimKind::Impact { .. });
                let impacts = certificate.events()[..count].iter().filter(|claim| is_impact(&claim.kind)).count();
                let events = counted(count, "event");
                if impacts == 0 { events } else { format!("{events}, impacts 1..{impacts}") }
            }
            Self::Bifurcations(_) => counted(count, "bifurcation"),
            Self::Periodic(_) | Self::Unchecked(_) => counted(count, "orbit"),
        }
    }

    /// All claims, in words.
    pub fn all(&self) -> String {
        match self {
            Self::Orbit(certificate) => format!("{} and the outcome", counted(certificate.events().len(), "event")),
            Self::Periodic(certificate) => counted(certificate.count(), "orbit"),
            Self::Bifurcations(certificate) => counted(certificate.checked(), "bifurcation"),
            Self::Unchecked(_) => "nothing".to_owned(),
        }
    }

    /// Which claim, and what is wrong with it.
    pub fn described(&self, Finding { event, message }: &Finding) -> String {
        match self {
            Self::Orbit(certificate) => certificate.described(*event, message),
            Self::Periodic(certificate) if *event < certificate.count() => format!("orbits[{event}]: {message}"),
            Self::Bifurcations(certificate) if *event < certificate.count() => format!("points[{event}]: {message}"),
            Self::Periodic(_) | Self::Bifurcations(_) | Self::Unchecked(_) => message.clone(),
        }
    }
}

impl Certificate {
    /// Which claim, and what is wrong with it.
    pub fn described(&self, event: usize, message: &str) -> String {
        let claim = match self.events().get(event).map(|claim| &claim.kind) {
            None => "outcome".to_owned(),
            Some(ClaimKind::Impact { index, .. }) => format!("events[{event}], impact {index}"),
            Some(ClaimKind::Graze) => format!("events[{event}], a graze"),
            Some(ClaimKind::Rest { .. }) => format!("events[{event}], a rest"),
            Some(ClaimKind::Release) => format!("events[{event}], a release"),
        };
        format!("{claim}: {message}")
    }
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
