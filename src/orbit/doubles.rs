//! Motions in a build without multiprecision: none in more than doubles.

use std::sync::Arc;

use super::motion::Motion;
use super::plan::Plan;
use crate::exact::Exact;
use crate::shaken::Origin;

/// No motion: this build has no multiprecision.
pub(super) fn motion<S>(_: Arc<S>, _: &Origin<Exact>, _: Plan) -> Option<Box<dyn Motion>> {
    None
}
