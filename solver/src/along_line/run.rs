//! The cycles of a contact in sections without a service around them.

use std::ops::ControlFlow;

use super::contact::SectionedContact;
use super::integrator::SectionsIntegrator;
use super::state::SectionsState;
use super::{Ending, StationCycle};

/// How a run of sections ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionsOutcome {
    /// All cycles are done.
    Completed,
    /// A body is nearly consumed in a section.
    WornThrough {
        /// Number.
        section: usize,
    },
    /// The groove of a section is as deep below an end of its surface as the slider's radius: no graph describes walls that overhang.
    DeeperThanRadius {
        /// Number.
        section: usize,
    },
    /// The receiver of its cycles ended it.
    Stopped,
}

impl<C: SectionedContact> SectionsIntegrator<C> {
    /// Computes cycles up to a number of them. They are delivered as they are computed; `Break` ends the run after that cycle.
    ///
    /// # Errors
    /// A contact without a solution, a section that cannot be meshed.
    pub(crate) fn run(
        &mut self,
        state: &mut SectionsState<C::State>,
        mut on_cycle: impl FnMut(&StationCycle) -> ControlFlow<()>,
    ) -> Result<SectionsOutcome, C::Error> {
        let cycles = self.contact.plane().cycles;
        while state.cycle() < cycles {
            self.compute_cycle(state, cycles)?;
            if on_cycle(state.last()).is_break() {
                return Ok(SectionsOutcome::Stopped);
            }
            match self.ending() {
                Some(Ending::WornThrough(section)) => {
                    return Ok(SectionsOutcome::WornThrough { section });
                }
                Some(Ending::DeeperThanRadius(section)) => {
                    return Ok(SectionsOutcome::DeeperThanRadius { section });
                }
                None => {}
            }
        }
        Ok(SectionsOutcome::Completed)
    }
}
