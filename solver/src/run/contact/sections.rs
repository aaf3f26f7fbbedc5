//! The run of sections along a line, stations or node planes: reports and snapshots are those of the reference section, and of each section
//! besides.

use super::{Bodies, Contact, Moment, Worn};
use crate::SolveError;
use crate::along_line::{Ending, StationCycle, StationProfile};
use crate::change::Change;
use crate::checkpoint::{Resumable, Run};
use crate::contact::{ContactState, Work};
use crate::cycle::FrictionLoop;
use crate::effects::EffectsPlan;
use crate::electrical::{ContactResistance, Evaluation, Touching};
use crate::fields::LineFields;
use crate::observer::Observer;
use crate::record::{
    self, Checks, CycleReport, DepthProfile, Exposed, LineEnd, Outcome, Resolution, Snapshot,
    StationSnapshot, TractionField, WornArea, tractions,
};
use crate::scene::Scene;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};

/// Sections along a line, whose cycles a run computes.
pub(in crate::run) trait Sections: Sized {
    /// State between two computed cycles.
    type State: State;

    /// The unworn sections without load.
    fn unworn(scene: &Scene, plan: &EffectsPlan) -> Result<Self, SolveError>;
    /// For a state of the same sections.
    fn resume(scene: &Scene, plan: &EffectsPlan, state: &Self::State) -> Result<Self, SolveError>;
    /// Applies the load.
    fn load(&mut self) -> Result<Self::State, SolveError>;
    /// Computes the next cycle up to a number of them.
    fn compute_cycle(&mut self, state: &mut Self::State, until: u64) -> Result<(), SolveError>;
    /// Cycles until the run ends by the depth of a section, at the present rates.
    fn cycles_left(&self) -> f64;
    /// Why it cannot be worn on.
    fn ending(&self) -> Option<Ending>;

    /// Worn depths of a section.
    fn profile(&self, section: usize) -> StationProfile;
    /// Contacts of a section at the named positions of the cycle, with the displacement of the slider, mm.
    fn contacts(&self, section: usize) -> impl Iterator<Item = (Position, f64, &ContactState)>;
    /// Fields inside the bodies at the same positions; none where they are not computed.
    ///
    /// # Errors
    /// [`SolveError`] if a present surface would invert an element, or a mesh cannot be factored.
    fn fields(&self, _: &Scene, _: &StationCycle) -> Result<Vec<LineFields>, SolveError> {
        Ok(Vec::new())
    }
    /// The body that carries the tractions.
    fn slave(&self) -> Side;
    /// The section whose profile stands for all.
    fn reference(&self) -> usize;
    /// The friction loop of the cycle.
    fn friction_loop(&self) -> &FrictionLoop;
    /// Worst residuals so far.
    fn residuals(&self) -> Checks;
    /// Degrees of freedom, contact elements of the receptacle, and their size in mm.
    fn size(&self) -> (usize, usize, f64);

    /// The run as that of a checkpoint.
    fn resumable(run: &Run<Self::State, ()>) -> Resumable<'_>;
}

/// State of sections, as a run reads it.
pub(in crate::run) trait State: Clone {
    /// The last computed cycle.
    fn last(&self) -> &StationCycle;
    /// Largest wear of a place of each side per cycle in it, mm.
    fn fastest_rate(&self) -> Sides<f64>;
    /// Computed cycles, and the most increments of one.
    fn computed(&self) -> (u64, usize);
    /// Work of all contact solves.
    fn work(&self) -> Work;
    /// Times that sections were condensed again.
    fn relocations(&self) -> u64;
    /// Estimated relative error of the worn depth by the jumps so far.
    fn mean_jump_error(&self) -> f64;
}

impl<S: Sections> Bodies for S {
    type State = S::State;
    type History = ();
    type Contact<'a>
        = &'a mut S
    where
        S: 'a;

    fn unworn(scene: &Scene, plan: &EffectsPlan, _: &mut dyn Observer) -> Result<Self, SolveError> {
        S::unworn(scene, plan)
    }

    fn resumed(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut S::State,
        _: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        S::resume(scene, plan, state)
    }

    fn contact<'a>(&'a mut self, _: &'a Scene) -> &'a mut S {
        self
    }
}

impl<S: Sections> Contact for &mut S {
    type State = S::State;
    type History = ();
    type Worn = Worn<Vec<StationProfile>>;

    fn load(&mut self) -> Result<S::State, SolveError> {
        S::load(self)
    }

    fn compute_cycle(
        &mut self,
        state: &mut S::State,
        until: u64,
        _: bool,
    ) -> Result<(), SolveError> {
        S::compute_cycle(self, state, until)
    }

    fn cycle(state: &S::State) -> u64 {
        state.last().cycle
    }

    fn max_depth_mm(state: &S::State) -> Sides<f64> {
        state.last().max_depth_mm()
    }

    fn fastest_rate(state: &S::State) -> Sides<f64> {
        state.fastest_rate()
    }

    fn cycles_left(&self, _: &S::State) -> f64 {
        S::cycles_left(self)
    }

    fn is_worn_through(&self, _: &S::State) -> bool {
        matches!(S::ending(self), Some(Ending::WornThrough(_)))
    }

    fn ending(&self) -> Option<Outcome> {
        S::ending(self).map(|ending| match ending {
            Ending::WornThrough(_) => Outcome::WornThrough,
            Ending::DeeperThanRadius(_) => Outcome::DeeperThanRadius,
        })
    }

    /// Nothing conducts: the resistance of sections is not simulated.
    fn touching(&self, _: &Scene, _: &Evaluation<'_>, _: Change<&S::State>, _: Moment) -> Touching {
        Touching::default()
    }

    /// The scars are those over the whole line.
    fn worn(&self, state: &S::State) -> Worn<Vec<StationProfile>> {
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
        _: &'a S::State,
        worn: &'a Worn<Vec<StationProfile>>,
        side: Side,
    ) -> impl Exposed + 'a {
        worn.scars.of(side)
    }

    fn report(
        &self,
        scene: &Scene,
        state: &S::State,
        worn: &Worn<Vec<StationProfile>>,
        _: Option<&ContactResistance>,
    ) -> CycleReport {
        record::line_report(&LineEnd {
            scene,
            cycle: state.last(),
            profiles: &worn.places,
            reference: self.reference(),
        })
    }

    fn snapshot(
        &self,
        scene: &Scene,
        state: &S::State,
        worn: &Worn<Vec<StationProfile>>,
    ) -> Result<Snapshot, SolveError> {
        let line_fields = if scene.output.fields {
            self.fields(scene, state.last())?
        } else {
            Vec::new()
        };
        Ok(Snapshot {
            line_fields,
            ..snapshot(&**self, state.last(), &worn.places)
        })
    }

    fn resolution(&self, run: &Run<S::State, ()>) -> Resolution {
        let state = &run.state;
        let (dofs, contact_elements, contact_element_mm) = self.size();
        let (computed_cycles, most_increments) = state.computed();
        Resolution {
            contact_element_mm,
            contact_elements,
            increments_per_cycle: u32::try_from(most_increments).unwrap_or(u32::MAX),
            computed_cycles,
            work: state.work(),
            dofs,
            relocations: state.relocations(),
            estimated_relative_error: state.mean_jump_error(),
        }
    }

    fn checks(&self, _: &S::State, _: &CycleReport) -> Checks {
        self.residuals()
    }

    fn resumable(run: &Run<S::State, ()>) -> Resumable<'_> {
        S::resumable(run)
    }
}

/// The snapshot of a cycle.
fn snapshot(sections: &impl Sections, cycle: &StationCycle, worn: &[StationProfile]) -> Snapshot {
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
    let reference = &stations[sections.reference()];
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
fn placed(sections: &impl Sections, number: usize, profile: &StationProfile) -> Vec<TractionField> {
    let nodes = profile.x_mm.of(sections.slave());
    let contacts = sections.contacts(number);
    contacts
        .map(|(position, slider_x_mm, contact)| TractionField {
            slider_x_mm,
            ..tractions(position, sections.slave(), nodes, contact)
        })
        .collect()
}
