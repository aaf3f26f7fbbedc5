//! Contacts on the surfaces without the skew of a jump.
//!
//! They are solved without the wear of the passes, as if a pass did not reshape the contact (`Tuning::unskewed_to`), and with
//! the normals of those surfaces.

use std::mem;

use super::{CycleRecord, CycleState, Integrator, Neutral};
use crate::contact::{ContactError, ContactState, Displacement, WarmStart, slopes_of_both};
use crate::law::surface;
use crate::schedule::increments::Position;

impl Integrator<'_> {
    /// Replaces the recorded contact at the neutral position, or those at all positions, by those on the surfaces without the
    /// skew; the steps of the cycle have a length, mm. A contact that cannot be solved is skipped; that of the computed cycle
    /// is reported instead.
    pub(super) fn remove_skew(
        &mut self,
        state: &mut CycleState,
        record: &mut CycleRecord,
        step: f64,
        all: bool,
    ) {
        let wear = self.wear;
        let equivalents = state.skew.removed_from(&self.equivalents(&state.depth));
        let depth = wear
            .zip(equivalents)
            .map(|(wear, depth)| surface::depths(wear, depth));
        let mut unskewed = state.clone();
        unskewed.depth.clone_from(&depth);
        let slope = slopes_of_both(self.pair.operators, &unskewed.depth);
        let slope_of_cycle = mem::replace(&mut self.slope, slope);
        let mut contacts = record.contacts.iter();
        let leftmost = contacts.find(|(at, _)| *at == Position::Leftmost);
        let leftmost = leftmost.map(|(_, contact)| contact.clone());
        for (position, contact) in &mut record.contacts {
            // From the turning point before it.
            let (from, last_step) = match position {
                Position::Leftmost => (Some(&state.contact), 0.0),
                Position::Neutral => (leftmost.as_ref(), step),
                Position::Rightmost => (leftmost.as_ref(), 0.0),
            };
            let (Some(from), true) = (from, all || *position == Position::Neutral) else {
                continue;
            };
            unskewed.contact.clone_from(from);
            if self
                .solve_unskewed(&mut unskewed, contact, last_step)
                .is_ok()
            {
                contact.clone_from(&unskewed.contact);
            }
            unskewed.depth.clone_from(&depth);
            if *position == Position::Neutral {
                state.neutral = Neutral::of(contact, &self.pair);
            }
        }
        self.slope = slope_of_cycle;
        state.work = unskewed.work;
        state.checks = unskewed.checks;
    }

    /// Displaces the slider to where a contact was found, as a single cycle up to a last step of a length, mm, that wears
    /// the whole jump: the edges of a worn contact would stand out without.
    fn solve_unskewed(
        &mut self,
        state: &mut CycleState,
        found: &ContactState,
        last_step: f64,
    ) -> Result<(), ContactError> {
        let (first, end) = found.active_range().unwrap_or_default();
        let to = Displacement {
            slider_x: found.slider_x - last_step,
            surface_slip: 0.0,
            along: 0.0,
            height: None,
            repeated: false,
            cycles: 1.0,
            lemke: false,
            start: Some(WarmStart {
                first,
                status: &found.status[first..end],
                pressure: &found.pressure[first..end],
            }),
        };
        self.increment(state, to)?;
        if last_step > 0.0 {
            let last = Displacement {
                slider_x: found.slider_x,
                cycles: state.skew.jump,
                ..to
            };
            self.increment(state, last)?;
        }
        Ok(())
    }
}
