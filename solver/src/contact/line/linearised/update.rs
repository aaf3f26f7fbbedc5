//! Update of the closed nodes of a linearised contact by the signs of its solution, and growth of its window.

use super::super::active_window::{candidates, undeformed_gaps, widened};
use super::super::error::ContactError;
use super::super::status::Status;
use super::super::unknown::Unknown;
use super::{LinearisedContact, PassPosition, Place};
use crate::linear::vector::{add_scaled, vectorized};

/// Pressure of a closed node over the peak, and gap of an open one over the indentation, that count as none: far above the
/// round-off of the inverse.
const SIGN_TOLERANCE: f64 = 1e-9;

impl LinearisedContact {
    /// Updates the closed nodes by the signs of the last solution, which was on the depths of the place; returns the number of
    /// nodes that have changed. `undeformed` is a buffer.
    ///
    /// # Errors
    /// [`ContactError`] if the contact has outgrown its zones.
    pub(crate) fn update(
        &mut self,
        place: Place<'_>,
        undeformed: &mut Vec<f64>,
    ) -> Result<usize, ContactError> {
        self.evaluate_gaps(place.position);
        let slipping = Status::slip(place.position.direction);
        let it = &mut self.iterate;
        let peak = it.pressure.iter().fold(0.0, |m: f64, p| m.max(*p));
        let mut changes = 0;
        for (status, (pressure, gap)) in it.status.iter_mut().zip(it.pressure.iter().zip(&it.gap)) {
            let required = if *status == Status::Open {
                *gap < -SIGN_TOLERANCE * it.indentation
            } else {
                *pressure >= -SIGN_TOLERANCE * peak
            };
            let required = if required { slipping } else { Status::Open };
            changes += usize::from((*status == Status::Open) != (required == Status::Open));
            *status = required;
        }
        if it.status.iter().all(|status| *status == Status::Open) {
            let gaps = self.geometry.gap.iter().enumerate();
            let lowest = gaps.fold(
                (0, f64::INFINITY),
                |m, (i, g)| {
                    if *g < m.1 { (i, *g) } else { m }
                },
            );
            it.status[lowest.0] = slipping;
        }
        self.is_factored &= changes == 0;
        let grown = self.grown_window(place, undeformed);
        if grown != self.window {
            self.widen(place, grown)?;
            changes += 1;
        }
        Ok(changes)
    }

    /// Gaps of all nodes of the window under the pressures, and the indentation.
    fn evaluate_gaps(&mut self, position: PassPosition) {
        let (geometry, response, it) = (&self.geometry, &self.response, &mut self.iterate);
        let status = Status::slip(position.direction);
        let mut gap = std::mem::take(&mut it.gap);
        gap.clear();
        gap.resize(it.status.len(), 0.0);
        vectorized(
            #[inline(always)]
            || {
                for node in &self.closed {
                    let (column, _) = response.column(Unknown::Pressure(*node, status));
                    add_scaled(&mut gap, it.pressure[*node], column);
                }
            },
        );
        let raised = |i: usize| (1.0 + geometry.sag[i]) * it.height + geometry.gap[i];
        let indentations = self.closed.iter().map(|i| raised(*i).abs());
        it.indentation = indentations.fold(0.0, f64::max);
        for (i, gap) in gap.iter_mut().enumerate() {
            *gap += raised(i);
        }
        for node in &self.closed {
            gap[*node] = 0.0;
        }
        it.gap = gap;
    }

    /// The window with all candidates on the depths of the place.
    fn grown_window(&self, place: Place<'_>, undeformed: &mut Vec<f64>) -> (usize, usize) {
        let Place { pair, surfaces, .. } = place;
        let covered = place.covered();
        let slider_x = place.position.slider_x;
        undeformed_gaps(pair, &surfaces, slider_x, covered, undeformed);
        let it = &self.iterate;
        let needed = candidates(undeformed, covered.0, it.indentation, it.height);
        let both = (self.window.0.min(needed.0), self.window.1.max(needed.1));
        if both == self.window {
            both
        } else {
            widened(both, covered)
        }
    }

    /// Widens the window; the closed nodes stay.
    fn widen(&mut self, place: Place<'_>, window: (usize, usize)) -> Result<(), ContactError> {
        let shift = self.window.0 - window.0;
        let statuses = std::mem::take(&mut self.iterate.status);
        let pressures = std::mem::take(&mut self.iterate.pressure);
        self.assemble(place, window)?;
        let it = &mut self.iterate;
        it.status[shift..shift + statuses.len()].copy_from_slice(&statuses);
        it.pressure[shift..shift + pressures.len()].copy_from_slice(&pressures);
        Ok(())
    }
}
