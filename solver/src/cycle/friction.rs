//! Coefficients of friction in a computed cycle.
//!
//! A coefficient by cycle is the mean of the cycles that the computed one represents, so that the dissipated energy of gross slip is
//! exact. A coefficient by dose or by layer is that of the depths at the beginning of the computed cycle: an Euler step, whose error is
//! part of that of the jump (`ContactFriction::change`).

use super::{CycleState, Integrator};
use crate::law::friction::contact::ContactFriction;
use crate::number::real_cycles;

impl Integrator<'_> {
    /// Updates the friction to the worn surfaces and to so many cycles from now.
    pub(super) fn update_friction(&mut self, state: &CycleState, cycles: f64) {
        let done = real_cycles(state.cycle);
        self.cycle_friction = self.friction.in_cycles(&state.depth, done..done + cycles);
        self.pair.interface.friction = self.cycle_friction.coefficient;
    }

    /// Mean coefficient of friction since a number of cycles over that of the last computed cycle, -; 1 where places differ in it, whose
    /// energy [`Self::correct_extrapolated_energy`] corrects.
    pub(super) fn friction_since(&self, cycle: u64, state: &CycleState) -> f64 {
        match &self.friction {
            ContactFriction::Uniform(table) if state.friction_per_cycle > 0.0 => {
                let mean = table.mean(real_cycles(cycle), real_cycles(state.cycle));
                mean / state.friction_per_cycle
            }
            ContactFriction::Uniform(_) | ContactFriction::BySurface(_) => 1.0,
        }
    }

    /// Replaces the energy of the cycles that were extrapolated with a computed one, which was that of the computed cycle before, by
    /// the mean of both where places differ in friction: the contact moves on while the friction at a place changes. The load, which a
    /// spring reduces, is that of the extrapolation.
    pub(super) fn correct_extrapolated_energy(
        &self,
        state: &mut CycleState,
        before: &CycleState,
        computed: u64,
    ) {
        let is_even = matches!(self.friction, ContactFriction::Uniform(_));
        let of_load = |state: &CycleState| state.energy_per_cycle / state.neutral.load;
        let (old, new) = (of_load(before), of_load(state));
        let all = state.energy - before.energy;
        let extrapolated = all - state.energy_per_cycle * real_cycles(computed);
        if !is_even && old > 0.0 && new > 0.0 && extrapolated > 0.0 {
            state.energy += 0.5 * extrapolated * (new / old - 1.0);
        }
    }
}
