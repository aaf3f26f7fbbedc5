//! Computed cycles of a contact in sections along a line: each stands for a jump.

use super::contact::SectionedContact;
use super::record::LineRecord;
use super::slide::slide;
use super::state::{Progress, SectionsState};
use crate::scene::Motion;
use crate::schedule::attempts::{Attempts, Remedy, in_wide_zones, longest_accepted_jump};
use crate::schedule::increments;
use crate::schedule::plan::Cycles;
use crate::schedule::replay::ReplayPlan;
use crate::schedule::step::{Position, Step};

/// Computes the cycles of a contact in sections along a line.
pub(crate) struct SectionsIntegrator<C> {
    pub(crate) contact: C,
    pub(super) progress: Progress,
    /// Record of the last computed cycle.
    pub(crate) record: LineRecord,
}

/// Paths, increments and iterations before a computed cycle.
pub(super) struct Before {
    /// Integral of p |slip| of each section, N/mm mm.
    pub(super) paths: Vec<f64>,
    pub(super) increments: usize,
    pub(super) iterations: usize,
}

impl<C: SectionedContact> SectionsIntegrator<C> {
    /// For an unworn, unloaded contact.
    pub(crate) fn of(contact: C) -> Self {
        Self {
            contact,
            progress: Progress::default(),
            record: LineRecord::default(),
        }
    }

    /// Applies the load to the unworn contact; returns the state before any wear.
    ///
    /// # Errors
    /// A contact without a solution, a section that cannot be meshed.
    pub(crate) fn load(&mut self) -> Result<SectionsState<C::State>, C::Error> {
        self.in_threads(|integrator| {
            in_wide_zones(integrator, |integrator| integrator.contact.apply_load())
        })?;
        let before = Before {
            increments: 0,
            iterations: 0,
            ..self.before()
        };
        let neutral = self.contact.contacts_at(Position::Neutral);
        self.take_record(LineRecord {
            positions: vec![neutral],
            ..LineRecord::default()
        });
        self.progress.last = self.report(0, &before);
        Ok(self.state())
    }

    /// For a state of a checkpoint, to the same bits as without it.
    ///
    /// # Errors
    /// A section that cannot be meshed or condensed.
    pub(crate) fn resumed(contact: C, state: &SectionsState<C::State>) -> Result<Self, C::Error>
    where
        C::State: Sync,
    {
        let mut integrator = Self::of(contact);
        integrator.in_threads(|integrator| integrator.enter(state))?;
        Ok(integrator)
    }

    /// Does work in the threads that the sections share.
    fn in_threads<R: Send>(&mut self, work: impl FnOnce(&mut Self) -> R + Send) -> R {
        match self.contact.threads() {
            Some(threads) => threads.within(|| work(self)),
            None => work(self),
        }
    }

    /// Computes the next cycle up to a number of them, with shorter jumps until it has a solution and its error is accepted.
    ///
    /// # Errors
    /// A contact without a solution, a section that cannot be meshed; the state is then as before.
    pub(crate) fn compute_cycle(
        &mut self,
        state: &mut SectionsState<C::State>,
        until: u64,
    ) -> Result<(), C::Error> {
        self.in_threads(|integrator| {
            integrator.enter(state)?;
            integrator.next_cycle(until)?;
            *state = integrator.state();
            Ok(())
        })
    }

    fn next_cycle(&mut self, until: u64) -> Result<(), C::Error> {
        if self.progress.computed == 0 {
            self.initial_quarter()?;
        }
        self.progress.relocations += self.contact.follow_wear()?;
        let before = self.before();
        let done = self.progress.done;
        let jump = until.max(done + 1) - done;
        let first = self.contact.next_jump(Cycles { done, jump });
        let (jump, record) = longest_accepted_jump(self, first)?;
        let progress = &mut self.progress;
        progress.most_increments = progress.most_increments.max(record.increments());
        progress.done += jump;
        progress.computed += 1;
        self.take_record(record);
        self.progress.last = self.report(jump, &before);
        Ok(())
    }

    /// Moves the slider from the turning point of another motion of a mission to that of the present one, without wear.
    ///
    /// # Errors
    /// As [`Self::compute_cycle`].
    pub(crate) fn change_motion(
        &mut self,
        state: &mut SectionsState<C::State>,
        from: Motion,
    ) -> Result<(), C::Error> {
        self.in_threads(|integrator| {
            integrator.enter(state)?;
            integrator.progress.end_motion(from);
            let steps = integrator.steps(from.outer());
            integrator.slide_unworn(increments::first_quarter(&steps))?;
            integrator.initial_quarter()?;
            *state = integrator.state();
            Ok(())
        })
    }

    /// Slides to the turning point where cycles begin, without wear.
    fn initial_quarter(&mut self) -> Result<(), C::Error> {
        let steps = self.steps(self.contact.motion());
        self.slide_unworn(increments::initial_quarter(&steps))
    }

    /// Steps of a cycle of a motion for the present contact.
    fn steps(&self, motion: Motion) -> Vec<Step> {
        increments::steps(motion, self.contact.increments_of(motion))
    }

    /// Takes steps without wear.
    fn slide_unworn(&mut self, steps: &[Step]) -> Result<(), C::Error> {
        in_wide_zones(self, |integrator| {
            integrator.slide(steps, 0, &ReplayPlan::default())?;
            Ok(())
        })
    }

    /// Takes steps that stand for a jump.
    fn slide(
        &mut self,
        steps: &[Step],
        jump: u64,
        replays: &ReplayPlan,
    ) -> Result<LineRecord, C::Error> {
        let done = self.progress.done;
        slide(&mut self.contact, steps, Cycles { done, jump }, replays)
            .map_err(|failed| self.contact.failure(done, failed))
    }

    fn before(&self) -> Before {
        let (increments, iterations) = self.contact.solves();
        let sections = self.contact.worn().into_iter();
        Before {
            paths: sections.map(|section| section.path).collect(),
            increments,
            iterations,
        }
    }

    /// Takes the record of a cycle, with the contacts of its neutral position.
    fn take_record(&mut self, record: LineRecord) {
        self.contact.take_neutral(record.neutral());
        self.record = record;
    }

    /// Takes the state that the next cycle begins with.
    fn enter(&mut self, state: &SectionsState<C::State>) -> Result<(), C::Error> {
        self.progress.clone_from(&state.progress);
        self.contact.enter(&state.sections)
    }

    /// The state after the last cycle.
    fn state(&self) -> SectionsState<C::State> {
        SectionsState {
            sections: self.contact.state(),
            progress: self.progress.clone(),
        }
    }
}

impl<C: SectionedContact> Attempts for SectionsIntegrator<C> {
    type Saved = C::Saved;
    type Record = LineRecord;
    type Error = C::Error;

    fn attempt(&mut self, jump: u64) -> Result<LineRecord, C::Error> {
        let done = self.progress.done;
        let plan = self.contact.cycle_plan(Cycles { done, jump });
        let steps = increments::steps(self.contact.motion(), plan.steps);
        self.slide(&steps, jump, &plan.replays)
    }

    fn rejected(&mut self, before: &Self::Saved, _: &LineRecord, jump: u64) -> Option<u64> {
        self.contact.rejected(before, jump)
    }

    fn save(&self) -> Self::Saved {
        self.contact.save()
    }

    fn go_back(&mut self, before: &Self::Saved) {
        self.contact.go_back(before);
    }

    fn remedy(&mut self, error: &C::Error) -> Result<Remedy, C::Error> {
        if !self.contact.widen(error)? {
            return Ok(Remedy::ShorterJump);
        }
        self.progress.relocations += 1;
        Ok(Remedy::WiderZones)
    }

    fn limit(&mut self, most: u64) -> u64 {
        self.contact.limit(most);
        most
    }
}
