//! An increment: the contact solve at the temperature and the pace of its displacement, and what it wears.

use super::{CycleError, CycleState, Integrator, wear_limit};
use crate::contact::{ContactError, Displacement, slopes_of_both};
use crate::sides::Side;

impl Integrator<'_> {
    /// Takes the temperature that the contact has in the next computed cycle.
    ///
    /// # Errors
    /// [`CycleError::Melts`] if it is beyond the melting temperature of a surface.
    pub(super) fn heat(&mut self, state: &mut CycleState) -> Result<(), CycleError> {
        let Some(heating) = &mut self.heating else {
            return Ok(());
        };
        let (rise_k, wear) = heating.begin_cycle(self.scene, &self.pair.interface, state);
        if let Some((hottest_k, melting_k)) = heating.melts() {
            return Err(CycleError::Melts {
                cycle: state.cycle,
                temperature_c: self.scene.temperature_c + hottest_k,
                melting_c: self.scene.temperature_c + melting_k,
            });
        }
        state.temperature_rise_k = rise_k;
        state.hottest_rise_k = state.hottest_rise_k.max(heating.hottest_k());
        let constant = self.scene.timed_motion().constant();
        self.wear =
            wear.map(|wear| wear.map(|wear| constant.map_or(wear, |pace| wear.during(pace, 0.0))));
        Ok(())
    }

    pub(super) fn increment(
        &mut self,
        state: &mut CycleState,
        to: Displacement<'_>,
    ) -> Result<(), ContactError> {
        let surfaces = Self::surfaces(&self.cycle_friction, &state.depth, &self.slope);
        let last = &state.contact;
        let pace = self.timed.between(self.stroke, last.slider_x, to.slider_x);
        let distance = (to.slider_x - last.slider_x).abs() + to.surface_slip.abs();
        let wear = match &self.heating {
            Some(heating) => heating.at_speed(pace.speed()),
            None => self.wear,
        };
        let (from_x, to_x) = (last.slider_x, to.slider_x);
        self.pair.interface.wear = wear.map(|wear| {
            wear.map(|wear| {
                self.timed
                    .wear_between(wear, self.stroke, from_x, to_x, distance)
            })
        });
        let done = self
            .solver
            .advance(&self.pair, &surfaces, last, to, &mut self.next)?;
        wear_limit::check(
            &self.spines,
            &state.depth,
            to.slider_x,
            done.first,
            done.recession,
        )?;
        for side in Side::BOTH {
            *state.worn_area.of_mut(side) += done.worn_area.of(side);
            let depths = &mut state.depth.of_mut(side)[*done.first.of(side)..];
            for (depth, recession) in depths.iter_mut().zip(*done.recession.of(side)) {
                *depth += recession;
            }
        }
        state.energy += to.cycles * done.energy;
        state.work += done.work;
        let checks = &mut state.checks;
        checks.force_balance = checks.force_balance.max(done.force_balance);
        checks.complementarity = checks.complementarity.max(done.complementarity);
        checks.friction_cone = checks.friction_cone.max(done.friction_cone);
        std::mem::swap(&mut state.contact, &mut self.next);
        if state.contact.friction > 0.0 {
            let used = state.contact.friction_use(&self.pair.slave().widths);
            state.checks.friction_use = state.checks.friction_use.max(used);
        }
        Ok(())
    }

    /// The balance of forces with the normals of the surfaces as worn now.
    pub(super) fn force_balance_with_present_normals(&mut self, state: &CycleState) -> f64 {
        let slope = slopes_of_both(self.pair.operators, &state.depth);
        let surfaces = Self::surfaces(&self.cycle_friction, &state.depth, &slope);
        self.solver
            .force_balance_on(&self.pair, &surfaces, &state.contact)
    }
}
