//! Life: the cycles until each criterion of a scene is reached.
//!
//! The cycles that a computed one represents do not pass a criterion by far (`schedule::stops`). Between two computed cycles the
//! dose at the depth of the criterion is taken as linear in the cycles, which is exact for a pressure that does not change; where
//! the wear ends at that depth, as linear with the rate before. A contact resistance, which jumps where a metal is exposed, is located in the
//! same way: among contacts whose doses are linear in the cycles (`electrical::located`), and so not before a criterion that causes it.

use serde::{Deserialize, Serialize};

use super::Exposed;
use crate::change::Change;
use crate::interpolation::part_way;
use crate::number::real_cycles;
use crate::scene::{Criterion, Scene};
use crate::sides::{Side, Sides};

/// Life by the criteria of a scene, in their order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Life {
    /// One entry a criterion.
    pub criteria: Vec<CriterionState>,
    /// One entry a limit of the contact resistance.
    pub resistance: Vec<CriterionState>,
    /// Lives with other wear coefficients over these, criteria first, for each of the scene's scattered ones.
    pub scattered: Vec<Vec<Option<f64>>>,
    /// Cycle of the last computed one.
    cycle: u64,
}

/// How far a criterion is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct CriterionState {
    /// Physical cycles at which it was reached; `None` if it was not.
    pub cycles: Option<f64>,
    /// Value after the last computed cycle: worn depth, mm, exposed part of the scar, -, or resistance, mOhm.
    pub value: f64,
    /// Value that counts as reached.
    pub limit: f64,
    /// Equivalent of the depth that the part of the scar has, mm.
    equivalent: f64,
    /// Increase per cycle in the last computed one, mm.
    rate: f64,
    /// Estimated relative error of the cycles; `None` without companions that have reached it.
    pub error: Option<f64>,
}

/// The cycles that a computed cycle stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CycleRange {
    /// Cycles done before it.
    pub(crate) from: u64,
    /// Cycles done after it.
    pub(crate) to: u64,
}

impl CycleRange {
    /// Cycles done after a part of them.
    pub(crate) fn after(self, part: f64) -> f64 {
        part_way(real_cycles(self.from), real_cycles(self.to), part)
    }
}

impl Life {
    /// The criteria and the limits of the resistance, in this order.
    fn all(&self) -> impl Iterator<Item = &CriterionState> {
        self.criteria.iter().chain(&self.resistance)
    }

    /// Cycles at which each was reached.
    pub(crate) fn cycles(&self) -> Vec<Option<f64>> {
        self.all().map(|state| state.cycles).collect()
    }

    /// States the estimated errors of [`Life::cycles`].
    pub(crate) fn state_errors(&mut self, errors: impl IntoIterator<Item = Option<f64>>) {
        let states = self.criteria.iter_mut().chain(&mut self.resistance);
        for (state, error) in states.zip(errors) {
            state.error = error;
        }
    }

    /// Takes the resistances before and after a computed cycle, mOhm, which the criteria have taken; `part_at` is the part of its cycles after
    /// which a limit between them is reached, by the state of the criteria.
    pub(crate) fn push_resistance(
        &mut self,
        limits: &[f64],
        cycles: CycleRange,
        resistance_mohm: Change<f64>,
        part_at: impl Fn(f64, &[CriterionState]) -> f64,
    ) {
        let Change { before, after } = resistance_mohm;
        self.resistance
            .resize(limits.len(), CriterionState::default());
        for (state, limit) in self.resistance.iter_mut().zip(limits) {
            (state.value, state.limit) = (after, *limit);
            if state.cycles.is_none() && before.max(after) >= *limit {
                let part = if before >= *limit {
                    0.0
                } else {
                    part_at(*limit, &self.criteria)
                };
                state.cycles = Some(cycles.after(part));
            }
        }
    }

    /// Takes the state after the next computed cycle, which is the given one.
    pub(crate) fn push<S: Exposed>(
        &mut self,
        scene: &Scene,
        cycle: u64,
        surface: impl Fn(Side) -> S,
    ) {
        self.criteria
            .resize(scene.life.len(), CriterionState::default());
        for (state, criterion) in self.criteria.iter_mut().zip(&scene.life) {
            let worn = surface(criterion.side);
            let cycles = CycleRange {
                from: self.cycle,
                to: cycle,
            };
            state.follow(scene, *criterion, &worn, cycles);
        }
        self.cycle = cycle;
    }
}

/// Depths of both sides that are below every criterion of their deepest point that is not reached after so many cycles, mm.
pub(crate) fn unreached(scene: &Scene, criteria: &[CriterionState], cycles: f64) -> Sides<f64> {
    let known = criteria.iter().zip(&scene.life);
    Sides::from_fn(|side| {
        let later = known.clone().filter(|(state, criterion)| {
            let of_deepest = criterion.side == side && criterion.part <= 0.0;
            of_deepest && state.cycles.is_none_or(|at| cycles < at)
        });
        let depths = later.map(|(_, criterion)| criterion.depth_mm.next_down());
        depths.fold(f64::INFINITY, f64::min)
    })
}

impl CriterionState {
    fn follow(
        &mut self,
        scene: &Scene,
        criterion: Criterion,
        worn: &impl Exposed,
        range: CycleRange,
    ) {
        let Criterion {
            side,
            part,
            depth_mm,
        } = criterion;
        let wear = *scene.surface_wear().of(side);
        let equivalent = |depth| wear.map_or(depth, |wear| wear.equivalent(depth));
        let depth = worn.depth_of_part(part);
        let (before, after, at) = (self.equivalent, equivalent(depth), equivalent(depth_mm));
        (self.value, self.limit) = if part > 0.0 {
            (worn.exposed_part(depth_mm), part)
        } else {
            (depth, depth_mm)
        };
        self.equivalent = after;
        let cycles = real_cycles(range.to - range.from);
        let rate = (after - before) / cycles;
        let is_end = wear.is_some_and(|wear| depth_mm >= wear.deepest());
        if self.cycles.is_none() && depth >= depth_mm {
            let needed = (at - before) / if is_end { self.rate } else { rate };
            let needed = if needed.is_finite() { needed } else { cycles };
            self.cycles = Some(real_cycles(range.from) + needed.clamp(0.0, cycles));
        }
        self.rate = rate;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::record::WornSurface;
    use crate::scene::{Layer, WearLaw};

    /// A triangular scar of this depth on the receptacle, and an unworn slider.
    fn push(life: &mut Life, scene: &Scene, cycle: u64, depth: f64) {
        let x = [-1.0, -0.5, 0.0, 0.5, 1.0];
        let worn = x.map(|x: f64| (1.0 - x.abs()) * depth);
        let unworn = [0.0; 5];
        life.push(scene, cycle, |side| WornSurface {
            x: &x,
            depth: match side {
                Side::Slider => &unworn,
                Side::Receptacle => &worn,
            },
        });
    }

    #[test]
    fn a_resistance_is_reached_between_computed_cycles() {
        let mut life = Life::default();
        let limits = [1.0, 3.0, 10.0];
        let mut next = |cycle, (before, after)| {
            let cycles = CycleRange {
                from: cycle - 100,
                to: cycle,
            };
            let change = Change { before, after };
            life.push_resistance(&limits, cycles, change, |limit, _| limit / 12.0);
            life.resistance
                .iter()
                .map(|state| state.cycles)
                .collect::<Vec<_>>()
        };
        // One that is reached already has no life.
        assert_eq!(next(100, (2.0, 2.0)), [Some(0.0), None, None]);
        assert_eq!(next(200, (2.0, 6.0)), [Some(0.0), Some(125.0), None]);
        // A criterion that was reached stays reached.
        assert_eq!(next(300, (6.0, 1.0)), [Some(0.0), Some(125.0), None]);
        let open = life.resistance[2];
        assert!((open.value - 1.0).abs() < 1e-15 && (open.limit - 10.0).abs() < 1e-15);
    }

    #[test]
    fn depths_are_below_a_criterion_until_it_is_reached() {
        let mut scene = fuzz_button();
        let deepest = |depth_mm| Criterion::deepest(Side::Receptacle, depth_mm);
        let part = Criterion {
            part: 0.5,
            ..deepest(0.5e-3)
        };
        scene.life = vec![deepest(2e-3), deepest(1e-3), part];
        let mut life = Life::default();
        push(&mut life, &scene, 100, 1.6e-3);
        let reached = life.criteria[1].cycles.expect("it is reached");
        assert!((reached - 62.5).abs() < 1e-9);
        let before = unreached(&scene, &life.criteria, reached.next_down());
        assert!(before.receptacle < 1e-3 && before.slider.is_infinite());
        let after = unreached(&scene, &life.criteria, reached);
        assert!(after.receptacle > 1e-3 && after.receptacle < 2e-3);
    }

    #[test]
    fn criteria_are_reached_between_computed_cycles_by_the_dose() {
        let mut scene = fuzz_button();
        scene.receptacle.plating = vec![Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-8,
        }];
        scene.receptacle.wear = Some(WearLaw::Archard {
            k_over_h_per_mpa: 4e-8,
        });
        scene.life = vec![
            Criterion::deepest(Side::Receptacle, 1e-3),
            Criterion::deepest(Side::Receptacle, 2e-3),
            Criterion {
                side: Side::Receptacle,
                part: 0.5,
                depth_mm: 1e-3,
            },
            Criterion::deepest(Side::Slider, 1e-3),
        ];
        let mut life = Life::default();
        // 1 um of the layer in 100 cycles, so 3 um in the 75 cycles after these.
        push(&mut life, &scene, 50, 0.5e-3);
        assert!(life.criteria.iter().all(|state| state.cycles.is_none()));
        push(&mut life, &scene, 175, 4e-3);
        // Half of a triangle is at least half as deep: 0.25 um after 50 cycles, with 2 um the equivalent of 1.25 um after 175.
        let half = 50.0 + 125.0 * 0.75;
        let expected = [Some(100.0), Some(125.0), Some(half), None];
        for (found, expected) in life.criteria.iter().zip(expected) {
            assert_eq!(found.cycles.is_some(), expected.is_some());
            let apart = found.cycles.unwrap_or(0.0) - expected.unwrap_or(0.0);
            assert!(apart.abs() < 1e-6, "{found:?} {expected:?}");
        }
        // Where wear ends at the layer's bottom, the time follows from the rate before.
        scene.receptacle.wear = None;
        let mut ended = Life::default();
        push(&mut ended, &scene, 50, 0.5e-3);
        push(&mut ended, &scene, 175, 1e-3);
        let cycles = ended.criteria[0].cycles;
        assert!(
            cycles.is_some_and(|cycles| (cycles - 100.0).abs() < 1e-9),
            "{cycles:?}"
        );
        // A criterion that was reached stays reached.
        push(&mut life, &scene, 200, 5e-3);
        assert_eq!(life.criteria[0].cycles.map(f64::round), Some(100.0));
        assert!((life.criteria[0].value - 5e-3).abs() < 1e-15);
    }
}
