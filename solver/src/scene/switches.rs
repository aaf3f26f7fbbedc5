//! Effects that the user switches on or off; all others are decided by the plan.

use super::effect::Effect;

/// Effects that are switched on or off.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Switches {
    forced: Vec<(Effect, bool)>,
}

impl Switches {
    /// Adds an effect that is on or off.
    #[must_use]
    pub fn with(mut self, effect: Effect, on: bool) -> Self {
        self.forced.retain(|(other, _)| *other != effect);
        self.forced.push((effect, on));
        self
    }

    /// True for an effect that is forced on, false for one forced off; `None` where the plan decides.
    pub fn of(&self, effect: Effect) -> Option<bool> {
        let mut forced = self.forced.iter();
        forced
            .find(|(other, _)| *other == effect)
            .map(|(_, on)| *on)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_switch_of_an_effect_counts() {
        let switches = Switches::default()
            .with(Effect::Friction, true)
            .with(Effect::SliderWear, true)
            .with(Effect::Friction, false);
        assert_eq!(switches.of(Effect::Friction), Some(false));
        assert_eq!(switches.of(Effect::SliderWear), Some(true));
        assert_eq!(switches.of(Effect::Relocation), None);
    }
}
