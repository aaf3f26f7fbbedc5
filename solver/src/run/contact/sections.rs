//! The run of sections along a line, stations or node planes: reports and snapshots are those of the reference section, and of each section
//! besides.

use std::borrow::Cow;

use super::{Bodies, Contact, Moment, Worn};
use crate::SolveError;
use crate::along_line::{
    Ending, SectionedContact, SectionsIntegrator, SectionsState, StationCycle, StationProfile,
};
use crate::change::Change;
use crate::checkpoint::{Resumable, Run};
use crate::contact::Work;
use crate::effects::EffectsPlan;
use crate::electrical::{ContactResistance, Evaluation, Touching};
use crate::fields::LineFields;
use crate::observer::Observer;
use crate::record::{
    self, Checks, CycleReport, DepthProfile, Exposed, LineEnd, Outcome, Resolution, Snapshot,
    StationSnapshot, TractionField, WornArea, tractions,
};
use crate::scene::{Motion, Scene};
use crate::schedule::mission_state::{BlockWear, MissionState};
use crate::sides::{Side, Sides};

/// Parts of a run of sections along a line that stations and node planes have each in their own way.
pub(in crate::run) trait ReportedSections:
    SectionedContact<State: Clone + Sync, Error: Into<SolveError>> + Sized
{
    /// The unworn sections without load.
    fn unworn(scene: &Scene, plan: &EffectsPlan) -> Result<SectionsIntegrator<Self>, SolveError>;
    /// For a state of the same sections.
    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &SectionsState<Self::State>,
    ) -> Result<SectionsIntegrator<Self>, SolveError>;

    /// Fields inside the bodies at the named positions of the last computed cycle.
    ///
    /// # Errors
    /// [`SolveError`] if a present surface would invert an element, or a mesh cannot be factored.
    fn fields(
        integrator: &SectionsIntegrator<Self>,
        scene: &Scene,
        last: &StationCycle,
    ) -> Result<Vec<LineFields>, SolveError>;
    /// The section whose profile stands for all.
    fn reference(integrator: &SectionsIntegrator<Self>) -> usize;
    /// Degrees of freedom, contact elements of the receptacle, and their size in mm.
    fn size(integrator: &SectionsIntegrator<Self>) -> (usize, usize, f64);

    /// History that the cycles of a motion leave for later ones of the same motion.
    type History: Default;

    /// Takes out what belongs to the present motion.
    fn take_history(state: &mut SectionsState<Self::State>) -> Self::History;
    /// Continues with what cycles of the next motion have left.
    fn continue_motion(state: &mut SectionsState<Self::State>, history: Self::History);

    /// Largest wear of a place of each side per cycle in the last computed one, mm.
    fn fastest_rate(state: &SectionsState<Self::State>) -> Sides<f64>;
    /// Work of all contact solves.
    fn work(state: &SectionsState<Self::State>) -> Work;
    /// Estimated relative error of the worn depth by the jumps so far, with those of the motions that are not under way.
    fn mean_jump_error(state: &SectionsState<Self::State>, histories: &[&Self::History]) -> f64;
    /// The run as that of a checkpoint.
    fn resumable(run: &SectionsRun<Self>) -> Resumable<'_>;
}

/// A run of sections.
type SectionsRun<S> =
    Run<SectionsState<<S as SectionedContact>::State>, <S as ReportedSections>::History>;

impl<S: ReportedSections> Bodies for SectionsIntegrator<S> {
    type State = SectionsState<S::State>;
    type History = S::History;
    type Contact<'a>
        = &'a mut Self
    where
        S: 'a;

    fn unworn(scene: &Scene, plan: &EffectsPlan, _: &mut dyn Observer) -> Result<Self, SolveError> {
        S::unworn(scene, plan)
    }

    fn resumed(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut SectionsState<S::State>,
        _: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        S::resume(scene, plan, state)
    }

    fn contact<'a>(&'a mut self, block: &'a Scene) -> &'a mut Self {
        self.contact.take_motion(block);
        self
    }
}

impl<S: ReportedSections> Contact for &mut SectionsIntegrator<S> {
    type State = SectionsState<S::State>;
    type History = S::History;
    type Worn = Worn<Vec<StationProfile>>;

    fn load(&mut self) -> Result<SectionsState<S::State>, SolveError> {
        (**self).load().map_err(Into::into)
    }

    fn compute_cycle(
        &mut self,
        state: &mut SectionsState<S::State>,
        until: u64,
        _: bool,
    ) -> Result<(), SolveError> {
        (**self).compute_cycle(state, until).map_err(Into::into)
    }

    fn cycle(state: &SectionsState<S::State>) -> u64 {
        state.last().cycle
    }

    fn max_depth_mm(state: &SectionsState<S::State>) -> Sides<f64> {
        state.last().max_depth_mm()
    }

    fn fastest_rate(state: &SectionsState<S::State>) -> Sides<f64> {
        S::fastest_rate(state)
    }

    fn cycles_left(&self, _: &SectionsState<S::State>) -> f64 {
        (**self).cycles_left()
    }

    fn is_worn_through(&self, _: &SectionsState<S::State>) -> bool {
        matches!((**self).ending(), Some(Ending::WornThrough(_)))
    }

    fn ending(&self) -> Option<Outcome> {
        (**self).ending().map(|ending| match ending {
            Ending::WornThrough(_) => Outcome::WornThrough,
            Ending::DeeperThanRadius(_) => Outcome::DeeperThanRadius,
        })
    }

    fn change_motion(
        &mut self,
        state: &mut SectionsState<S::State>,
        from: Motion,
    ) -> Result<(), SolveError> {
        (**self).change_motion(state, from).map_err(Into::into)
    }

    fn totals(&self, _: &SectionsState<S::State>) -> BlockWear {
        (**self).totals()
    }

    fn nodal_depths<'a>(&self, _: &'a SectionsState<S::State>) -> Sides<Cow<'a, [f64]>> {
        (**self).nodal_depths().map(Cow::Owned)
    }

    fn cycles_left_at(&self, _: &SectionsState<S::State>, rates: Sides<&[f64]>) -> f64 {
        (**self).cycles_left_at(rates)
    }

    fn take_history(state: &mut SectionsState<S::State>) -> S::History {
        S::take_history(state)
    }

    fn continue_motion(state: &mut SectionsState<S::State>, history: S::History) {
        S::continue_motion(state, history);
    }

    /// Nothing conducts: the resistance of sections is not simulated.
    fn touching(
        &self,
        _: &Scene,
        _: &Evaluation<'_>,
        _: Change<&SectionsState<S::State>>,
        _: Moment,
    ) -> Touching {
        Touching::default()
    }

    /// The scars are those over the whole line.
    fn worn(&self, state: &SectionsState<S::State>) -> Worn<Vec<StationProfile>> {
        let sections = 0..state.last().stations.len();
        let profiles: Vec<StationProfile> = sections.map(|section| self.profile(section)).collect();
        Worn {
            scars: Sides::from_fn(|side| {
                let cells = profiles.iter().flat_map(|station| station.cells(side));
                WornArea::of_cells(cells)
            }),
            places: profiles,
        }
    }

    fn surface<'a>(
        &'a self,
        _: &'a SectionsState<S::State>,
        worn: &'a Worn<Vec<StationProfile>>,
        side: Side,
    ) -> impl Exposed + 'a {
        worn.scars.of(side)
    }

    fn report(
        &self,
        scene: &Scene,
        state: &SectionsState<S::State>,
        worn: &Worn<Vec<StationProfile>>,
        _: Option<&ContactResistance>,
    ) -> CycleReport {
        record::line_report(&LineEnd {
            scene,
            cycle: state.last(),
            profiles: &worn.places,
            reference: S::reference(self),
        })
    }

    fn snapshot(
        &self,
        scene: &Scene,
        state: &SectionsState<S::State>,
        worn: &Worn<Vec<StationProfile>>,
    ) -> Result<Snapshot, SolveError> {
        let line_fields = if scene.output.fields {
            S::fields(self, scene, state.last())?
        } else {
            Vec::new()
        };
        Ok(Snapshot {
            line_fields,
            ..snapshot(self, state.last(), &worn.places)
        })
    }

    fn resolution(&self, run: &SectionsRun<S>) -> Resolution {
        let state = &run.state;
        let (dofs, contact_elements, contact_element_mm) = S::size(self);
        let (computed_cycles, most_increments) = state.computed();
        let histories = run.mission.iter().flat_map(MissionState::histories);
        let histories: Vec<&S::History> = histories.collect();
        Resolution {
            contact_element_mm,
            contact_elements,
            increments_per_cycle: u32::try_from(most_increments).unwrap_or(u32::MAX),
            computed_cycles,
            work: S::work(state),
            dofs,
            relocations: state.relocations(),
            estimated_relative_error: S::mean_jump_error(state, &histories),
        }
    }

    fn checks(&self, _: &SectionsState<S::State>, _: &CycleReport) -> Checks {
        self.residuals()
    }

    fn resumable(run: &SectionsRun<S>) -> Resumable<'_> {
        S::resumable(run)
    }
}

/// The snapshot of a cycle.
fn snapshot<S: ReportedSections>(
    sections: &SectionsIntegrator<S>,
    cycle: &StationCycle,
    worn: &[StationProfile],
) -> Snapshot {
    let reports = cycle.stations.iter();
    let stations: Vec<StationSnapshot> = reports
        .zip(worn)
        .enumerate()
        .map(|(number, (report, profile))| StationSnapshot {
            report: *report,
            receptacle: depths(profile, Side::Receptacle),
            slider: depths(profile, Side::Slider),
            positions: placed(sections, number, profile),
        })
        .collect();
    let reference = &stations[S::reference(sections)];
    Snapshot {
        cycle: cycle.cycle,
        receptacle: reference.receptacle.clone(),
        slider: reference.slider.clone(),
        positions: reference.positions.clone(),
        friction_loop: sections.friction_loop().clone(),
        fields: Vec::new(),
        line_fields: Vec::new(),
        area: None,
        stations,
    }
}

fn depths(profile: &StationProfile, side: Side) -> DepthProfile {
    DepthProfile {
        x_mm: profile.x_mm.of(side).clone(),
        depth_mm: profile.depth_mm.of(side).clone(),
    }
}

/// Tractions of a section at the named positions of the last computed cycle.
fn placed<S: ReportedSections>(
    sections: &SectionsIntegrator<S>,
    number: usize,
    profile: &StationProfile,
) -> Vec<TractionField> {
    let slave = sections.contact.interface().slave;
    let nodes = profile.x_mm.of(slave);
    let contacts = sections.contacts(number);
    contacts
        .map(|at| TractionField {
            slider_x_mm: at.slider_x_mm,
            ..tractions(at.position, slave, nodes, at.contact)
        })
        .collect()
}
