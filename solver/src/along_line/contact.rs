//! A contact that is computed in sections along a line: what stations and the planes of extruded bodies do each in their own way.

use std::sync::Arc;

use super::Along;
use super::error::SectionsError;
use super::slide::Sections;
use crate::ale::Spines;
use crate::cycle::retry::FailedIncrement;
use crate::cycle::{Checks, Neutral};
use crate::model::Interface;
use crate::scene::{Motion, Scene};
use crate::schedule::plan::{CyclePlan, Cycles};
use crate::sides::{Side, Sides};
use crate::threads::Threads;

/// A section as worn now.
pub(crate) struct WornSection<'a> {
    pub(crate) at: Along,
    /// Length of the line that it stands for, mm.
    pub(crate) weight_mm: f64,
    /// Places of the nodes of each body and the widths that they stand for, mm.
    pub(crate) x_mm: Sides<&'a [f64]>,
    pub(crate) widths_mm: Sides<&'a [f64]>,
    /// Worn depths there, mm.
    pub(crate) depth: &'a Sides<Vec<f64>>,
    /// Wear of the nodes per cycle in the last computed one, as equivalent depth, mm.
    pub(crate) rates: Sides<&'a [f64]>,
    /// Integrals of the wear rates, mm^2.
    pub(crate) worn_area: Sides<f64>,
    /// Integral of p |slip| over contact and cycles, N/mm mm.
    pub(crate) path: f64,
    /// Energy dissipated by friction, mJ/mm.
    pub(crate) energy: f64,
    pub(crate) neutral: Neutral,
    pub(crate) spines: &'a Spines,
}

impl WornSection<'_> {
    /// Integrals of the worn depths, mm^2.
    pub(super) fn area_mm2(&self) -> Sides<f64> {
        Sides::from_fn(|side: Side| {
            let nodes = self.depth.of(side).iter().zip(*self.widths_mm.of(side));
            nodes.map(|(depth, width)| depth * width).sum()
        })
    }
}

/// A contact in sections along a line.
pub(crate) trait SectionedContact: Sections + Send {
    /// State of the sections between two computed cycles.
    type State: Send;
    /// Why a cycle has no solution.
    type Error: From<SectionsError> + Send;

    /// The plane section.
    fn plane(&self) -> &Scene;
    /// Laws and supports of the sections.
    fn interface(&self) -> &Interface;
    /// Motion of the slider.
    fn motion(&self) -> Motion;
    /// Normal force, N.
    fn force_n(&self) -> f64;
    /// Threads that the sections share.
    fn threads(&self) -> Option<Arc<Threads>>;

    /// Applies the load at the neutral position, without sliding.
    ///
    /// # Errors
    /// There is no equilibrium.
    fn apply_load(&mut self) -> Result<(), Self::Error>;
    /// Increments of a cycle of a motion for the present contact.
    fn increments_of(&self, motion: Motion) -> usize;
    /// Takes the motion of a block of a mission, or of the whole run.
    fn take_motion(&mut self, block: &Scene);
    /// Meshes and condenses again what has drifted from the geometry of the operators; returns how many times.
    ///
    /// # Errors
    /// A section that cannot be meshed or condensed.
    fn follow_wear(&mut self) -> Result<u64, Self::Error>;
    /// Gives the sections wider zones of fine elements if an error needs them; returns `true` then.
    ///
    /// # Errors
    /// A section that cannot be meshed or condensed.
    fn widen(&mut self, error: &Self::Error) -> Result<bool, Self::Error>;
    /// The error of an increment after so many cycles.
    fn failure(&self, cycle: u64, failed: FailedIncrement<Self::Unsolved>) -> Self::Error;

    /// The state after the last cycle.
    fn state(&self) -> Self::State;
    /// Takes the state that the next cycle begins with.
    ///
    /// # Errors
    /// A section that cannot be meshed or condensed.
    fn enter(&mut self, state: &Self::State) -> Result<(), Self::Error>;
    /// Takes the contacts of the neutral position of each section.
    fn take_neutral(&mut self, found: &[Neutral]);

    /// The next jump after so many cycles, at most that of `most`.
    fn next_jump(&mut self, most: Cycles) -> u64;
    /// Increments and replays of a cycle.
    fn cycle_plan(&self, cycles: Cycles) -> CyclePlan;
    /// Measures the error of a jump; a shorter one where it is too large, with the control as before the jump.
    fn rejected(&mut self, before: &Self::Saved, jump: u64) -> Option<u64>;
    /// Limits the next jump.
    fn limit(&mut self, most: u64);
    /// Largest estimated relative error of the wear of a section in the last jump.
    fn jump_error(&self) -> f64;

    /// Increments of the run, and iterations in these.
    fn solves(&self) -> (usize, usize);
    /// Worst residuals so far, without those of worn areas.
    fn checks(&self) -> Checks;
    /// The sections as worn now.
    fn worn(&self) -> Vec<WornSection<'_>>;
}
