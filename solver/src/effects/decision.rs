//! The decision about an effect.

use super::basis::{Basis, Indicator};
use crate::scene::Effect;
use serde::{Deserialize, Serialize};

/// Decision about one effect.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    /// The effect.
    pub effect: Effect,
    /// The decision.
    pub verdict: Verdict,
    /// True if it can be simulated in the scene.
    pub is_available: bool,
    /// Basis of the decision.
    pub basis: Basis,
}

impl Decision {
    /// The indicator; `None` where there is nothing to decide.
    pub fn indicator(&self) -> Option<Indicator> {
        self.basis.indicator()
    }

    /// Returns `true` if the effect is beyond its limit and not simulated.
    pub fn is_missed(&self) -> bool {
        let indicator = self.indicator();
        !self.verdict.is_on() && indicator.is_some_and(Indicator::is_beyond_threshold)
    }

    /// Returns `true` if a run may still require the effect: it is skipped, not switched off, and can be simulated in the scene.
    pub(super) fn can_be_required(&self) -> bool {
        self.verdict == Verdict::Skipped && self.is_available
    }
}

/// A decision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// The scene requires it.
    Simulated,
    /// The scene does not require it, or has nothing to simulate.
    Skipped,
    /// Simulated because the user switched it on.
    ForcedOn,
    /// Left out because the user switched it off.
    ForcedOff,
    /// Left out because the scene lacks what it needs.
    InputMissing,
}

impl Verdict {
    /// Returns `true` if the effect is part of the model.
    pub fn is_on(self) -> bool {
        matches!(self, Self::Simulated | Self::ForcedOn)
    }
}
