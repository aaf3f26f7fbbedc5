//! Coefficients of friction in a computed cycle.
//!
//! A coefficient by cycle is the mean of the cycles that the computed one represents, so that the dissipated energy of gross slip is
//! exact. A coefficient by dose or by layer is that of the depths at the beginning of the computed cycle: an Euler step, whose error is
//! part of that of the jump,
//!   1/2 sum w dD |mu_after - mu_before| / sum w dD mu_after
//! over the nodes of both surfaces with their widths w and doses dD: that of the energy dissipated in gross slip.

use super::{CycleState, Integrator};
use crate::change::Change;
use crate::law::surface::SurfaceWear;
use crate::model::friction::ContactFriction;
use crate::number::real_cycles;
use crate::sides::{Side, Sides};

impl Integrator<'_> {
    /// Updates the friction to the worn surfaces and to so many cycles from now.
    pub(super) fn update_friction(&mut self, state: &CycleState, cycles: f64) {
        self.nodal_friction = self.friction.nodal(&state.depth);
        let from = real_cycles(state.cycle);
        let (friction, nodal) = (&self.friction, &self.nodal_friction);
        self.pair.interface.friction = friction.between(from, from + cycles, nodal);
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

    /// Half the relative change of the coefficient of friction from one state to another, both given by their worn depths and
    /// their equivalents, mm; none where it is the same everywhere.
    pub(super) fn change_of_friction(
        &self,
        depth: Change<&Sides<Vec<f64>>>,
        worn: Change<Sides<&[f64]>>,
    ) -> f64 {
        let (mut change, mut total) = (0.0, 0.0);
        for side in Side::BOTH {
            let Some(friction) = self.friction.of_surface(side) else {
                continue;
            };
            let depths = depth.before.of(side).iter().zip(depth.after.of(side));
            let worn = worn.before.of(side).iter().zip(*worn.after.of(side));
            let widths = &self.pair.operators.of(side).widths;
            let rate = self.wear.of(side).and_then(SurfaceWear::dose_rate);
            let rate = rate.unwrap_or(1.0);
            for (((before, after), (from, to)), width) in depths.zip(worn).zip(widths) {
                let (dose, mu) = (width * (to - from) / rate, friction.at(*after));
                change += dose * (mu - friction.at(*before)).abs();
                total += dose * mu;
            }
        }
        if total > 0.0 {
            0.5 * change / total
        } else {
            0.0
        }
    }
}
