//! Effects plan: decides by numbers which effects a scene requires. Only those are simulated.
//!
//! An indicator estimates how much an effect changes the outputs, relative. It is taken for the unworn contact and at the
//! estimated end, and again after every computed cycle. An effect is skipped if its indicator is at most a fifth of the
//! tolerance and those of all skipped effects add up to at most half of it; otherwise the largest is simulated too.

mod across_width;
mod basis;
mod bending;
mod choice;
mod decision;
mod dimension;
pub mod extent;
mod facts;
mod indicators;
mod line;
mod plasticity;
mod point;
pub mod small_strain;

pub use basis::{Absence, AcrossWidth, Basis, Facts, Indicator};
pub use decision::{Decision, Verdict};
pub use plasticity::{Hardness, Yield};

use crate::electrical::ElectricalState;
use crate::scene::Effect;
use crate::scene::{Scene, SurfaceEffects};
use crate::sides::Sides;
use indicators::Indicators;
use serde::{Deserialize, Serialize};

/// Largest sum of the indicators of skipped effects over the tolerance: the rest is for mesh, increments and jumps.
const BUDGET: f64 = 0.5;

/// Decisions about all effects.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectsPlan {
    /// One decision per effect, always in the same order.
    pub decisions: Vec<Decision>,
}

/// A skipped effect that a run has required.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Crossing {
    /// The effect.
    pub effect: Effect,
    /// Physical cycles done before it was switched on.
    pub cycle: u64,
    /// Indicator after the next computed cycle without it; `None` where that has no solution.
    pub value: Option<f64>,
}

/// Decides which effects a scene requires.
pub fn plan(scene: &Scene) -> EffectsPlan {
    let indicators = Indicators::of(scene);
    let mut required = Vec::new();
    loop {
        let decisions = choice::decide(scene, &indicators, &required);
        match beyond_budget(&decisions, scene.accuracy.tolerance) {
            Some(effect) => required.push(effect),
            None => return EffectsPlan { decisions },
        }
    }
}

/// The skipped effect with the largest indicator if those of all skipped ones exceed their budget.
fn beyond_budget(decisions: &[Decision], tolerance: f64) -> Option<Effect> {
    let available = decisions.iter().filter(|decision| decision.is_available);
    largest_beyond(counted(available), BUDGET * tolerance)
}

/// Skipped effects that count, with their indicators.
fn counted<'a>(
    decisions: impl Iterator<Item = &'a Decision>,
) -> impl Iterator<Item = (Effect, f64)> {
    decisions.filter_map(|decision| {
        let indicator = decision.indicator()?;
        let counts = decision.verdict == Verdict::Skipped && decision.effect.is_counted();
        counts.then_some((decision.effect, indicator.value()))
    })
}

/// The effect with the largest value if all of them add up to more than a limit.
fn largest_beyond(values: impl Iterator<Item = (Effect, f64)>, limit: f64) -> Option<Effect> {
    let (mut sum, mut largest) = (0.0, None);
    for (effect, value) in values {
        sum += value;
        if largest.is_none_or(|(_, most)| value > most) {
            largest = Some((effect, value));
        }
    }
    largest.filter(|_| sum > limit).map(|(effect, _)| effect)
}

impl EffectsPlan {
    /// The decision about an effect.
    fn decision(&self, effect: Effect) -> Option<&Decision> {
        let mut decisions = self.decisions.iter();
        decisions.find(|decision| decision.effect == effect)
    }

    /// Returns `true` if an effect is simulated.
    pub fn simulates(&self, effect: Effect) -> bool {
        let decision = self.decision(effect);
        decision.is_some_and(|decision| decision.verdict.is_on())
    }

    /// Effects that change the wear of surfaces, as far as they are simulated.
    pub(crate) fn surface_effects(&self) -> SurfaceEffects {
        SurfaceEffects {
            plating: self.simulates(Effect::Plating),
            softening: self.simulates(Effect::ThermalSoftening),
        }
    }

    /// The decisions without their numbers.
    pub(crate) fn verdicts(&self) -> Vec<(Effect, Verdict)> {
        let decisions = self.decisions.iter();
        decisions
            .map(|decision| (decision.effect, decision.verdict))
            .collect()
    }

    /// Effects that are beyond their limits and not simulated.
    pub fn missed(&self) -> impl Iterator<Item = &Decision> {
        self.decisions
            .iter()
            .filter(|decision| decision.is_missed())
    }

    /// Relative change of the outputs by all skipped effects.
    pub(crate) fn skipped_change(&self) -> f64 {
        counted(self.decisions.iter()).fold(0.0, |sum, (_, value)| sum + value)
    }

    /// The plan with the effects that a run has required.
    #[must_use]
    pub fn after(&self, crossings: &[Crossing]) -> Self {
        let mut plan = self.clone();
        for crossing in crossings {
            for decision in &mut plan.decisions {
                if decision.effect == crossing.effect && decision.verdict == Verdict::Skipped {
                    decision.verdict = Verdict::Simulated;
                }
            }
        }
        plan
    }

    /// The skipped effects that the largest worn depths after so many physical cycles require, mm; a run goes back to the
    /// cycle before.
    pub(crate) fn crossed(
        &self,
        scene: &Scene,
        back_to: u64,
        cycle: u64,
        depth: Sides<f64>,
    ) -> Vec<Crossing> {
        let indicators = Indicators::of(scene);
        let depth = self.with_skipped_wear(depth, indicators.worn_depth_after(cycle));
        let skipped = self
            .decisions
            .iter()
            .filter(|decision| decision.can_be_required())
            .filter_map(|decision| {
                let indicator = decision.indicator()?;
                let value = indicators.value(decision.effect, depth);
                Some((decision.effect, value, indicator))
            });
        let alone = skipped
            .clone()
            .find(|(_, value, indicator)| *value > indicator.threshold)
            .map(|(effect, ..)| effect);
        let counted = skipped
            .clone()
            .filter(|(effect, ..)| effect.is_counted())
            .map(|(effect, value, _)| (effect, value));
        let effect = alone.or_else(|| largest_beyond(counted, BUDGET * scene.accuracy.tolerance));
        effect.map_or_else(Vec::new, |effect| {
            self.required(effect, back_to, |effect| {
                Some(indicators.value(effect, depth))
            })
        })
    }

    /// Heat of the current, if it was skipped and the resistance of the contact requires it; a run goes back to the cycle before.
    pub(crate) fn crossed_by_current(
        &self,
        scene: &Scene,
        back_to: u64,
        electrical: &ElectricalState,
    ) -> Vec<Crossing> {
        let decision = self.decision(Effect::JouleHeating);
        let skipped = decision.filter(|decision| decision.can_be_required());
        let Some(indicator) = skipped.and_then(Decision::indicator) else {
            return Vec::new();
        };
        let rise_k = scene.joule_rise_k(electrical.constriction_mohm());
        let value = Indicators::of(scene).change_by_heat(rise_k);
        if value > indicator.threshold {
            self.required(Effect::JouleHeating, back_to, |_| Some(value))
        } else {
            Vec::new()
        }
    }

    /// Depths with those that skipped sides would have.
    fn with_skipped_wear(&self, depth: Sides<f64>, estimated: Sides<f64>) -> Sides<f64> {
        let of = |effect, depth: f64, estimated: f64| {
            if self.simulates(effect) {
                depth
            } else {
                estimated
            }
        };
        Sides {
            slider: of(Effect::SliderWear, depth.slider, estimated.slider),
            receptacle: of(
                Effect::ReceptacleWear,
                depth.receptacle,
                estimated.receptacle,
            ),
        }
    }

    /// An effect that a run has required. Where friction acts on the bodies, nodes may stick unless that is switched off or, as in sections
    /// along a line, every node slips.
    fn required(
        &self,
        effect: Effect,
        cycle: u64,
        value: impl Fn(Effect) -> Option<f64>,
    ) -> Vec<Crossing> {
        let with = match effect {
            Effect::Friction => Some(Effect::StickMemory),
            _ => None,
        };
        let is_skipped = |effect: &Effect| {
            let decision = self.decision(*effect);
            decision.is_some_and(Decision::can_be_required)
        };
        [effect]
            .into_iter()
            .chain(with.filter(is_skipped))
            .map(|effect| Crossing {
                effect,
                cycle,
                value: value(effect),
            })
            .collect()
    }

    /// The skipped effects that a contact without a solution requires, after so many physical cycles: one that jams where
    /// every node has to slip may stick.
    pub(crate) fn required_after_failure(&self, cycle: u64) -> Vec<Crossing> {
        let skipped = |effect: &Effect| {
            self.decision(*effect).is_some_and(|decision| {
                decision.can_be_required() && decision.indicator().is_some()
            })
        };
        let mut effects = [Effect::Friction, Effect::StickMemory].into_iter();
        let effect = effects.find(skipped);
        effect.map_or_else(Vec::new, |effect| self.required(effect, cycle, |_| None))
    }
}

#[cfg(test)]
mod tests;
