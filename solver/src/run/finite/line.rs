//! The run of a contact along a line: what its reports and snapshots are made of. Profiles and tractions are those of the section
//! that touches first, and of each station besides.

use super::Contact;
use crate::SolveError;
use crate::checkpoint::{LineRun, Misfit, Resumable};
use crate::effects::EffectsPlan;
use crate::electrical::{AreaContact, ContactResistance};
use crate::record::{
    self, Checks, CycleReport, DepthProfile, LineEnd, Outcome, Resolution, Snapshot,
    StationSnapshot, TractionField, WornArea, tractions,
};
use crate::scene::Scene;
use crate::sides::{Side, Sides};
use crate::station::{
    Ending, LineIntegrator, LineState, StationError, StationProfile, StationScene,
};

impl Contact for LineIntegrator {
    type State = LineState;
    type Worn = Vec<StationProfile>;
    type Scar = WornArea;

    fn start(scene: &Scene, plan: &EffectsPlan) -> Result<(Self, LineState), SolveError> {
        Ok(Self::start(&line_of(scene)?, plan)?)
    }

    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut LineState,
    ) -> Result<Self, SolveError> {
        let line = line_of(scene)?;
        let (found, stations) = (state.last().stations.len(), line.stations);
        if found != stations {
            return Err(Misfit::Stations { found, stations }.into());
        }
        Ok(Self::resume(&line, plan, state)?)
    }

    fn compute_cycle(&mut self, state: &mut LineState, until: u64) -> Result<(), SolveError> {
        Ok(self.compute_cycle(state, until)?)
    }

    fn cycle(state: &LineState) -> u64 {
        state.cycle()
    }

    fn max_depth_mm(state: &LineState) -> Sides<f64> {
        state.last().max_depth_mm()
    }

    fn fastest_rate(state: &LineState) -> Sides<f64> {
        state.fastest_rate()
    }

    fn cycles_left(&self) -> (f64, bool) {
        let worn_through = matches!(self.ending(), Some(Ending::WornThrough(_)));
        (self.cycles_left(), worn_through)
    }

    fn ending(&self) -> Option<Outcome> {
        self.ending().map(|ending| match ending {
            Ending::WornThrough(_) => Outcome::WornThrough,
            Ending::DeeperThanRadius(_) => Outcome::DeeperThanRadius,
        })
    }

    fn area(_: &LineState, _: f64) -> Option<AreaContact> {
        None
    }

    fn worn(&self, state: &LineState) -> Vec<StationProfile> {
        let stations = 0..state.last().stations.len();
        stations.map(|station| self.profile(station)).collect()
    }

    /// The scar over the whole line.
    fn scars(worn: &Vec<StationProfile>) -> Sides<WornArea> {
        Sides::from_fn(|side| {
            let cells = worn.iter().flat_map(|station| station.cells(side));
            WornArea::of_cells(cells)
        })
    }

    fn report(
        &self,
        scene: &Scene,
        state: &LineState,
        worn: &Vec<StationProfile>,
        _: Option<&ContactResistance>,
    ) -> CycleReport {
        record::line_report(&LineEnd {
            scene,
            cycle: state.last(),
            profiles: worn,
            reference: self.reference(),
        })
    }

    fn snapshot(&self, _: &Scene, state: &LineState, worn: Vec<StationProfile>) -> Snapshot {
        let reports = state.last().stations.iter();
        let stations: Vec<StationSnapshot> = reports
            .zip(worn)
            .enumerate()
            .map(|(number, (report, profile))| StationSnapshot {
                report: *report,
                receptacle: depths(&profile, Side::Receptacle),
                slider: depths(&profile, Side::Slider),
                positions: placed(self, (number, &profile)),
            })
            .collect();
        let reference = &stations[self.reference()];
        Snapshot {
            cycle: state.cycle(),
            receptacle: reference.receptacle.clone(),
            slider: reference.slider.clone(),
            positions: reference.positions.clone(),
            friction_loop: self.friction_loop().clone(),
            fields: Vec::new(),
            area: None,
            stations,
        }
    }

    fn resolution(&self, state: &LineState) -> Resolution {
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

    fn checks(&self, _: &LineState) -> Checks {
        self.residuals()
    }

    fn resumable(run: &LineRun) -> Resumable<'_> {
        Resumable::Line(run)
    }
}

fn line_of(scene: &Scene) -> Result<StationScene, StationError> {
    StationScene::of(scene).ok_or(StationError::Motion)
}

fn depths(profile: &StationProfile, side: Side) -> DepthProfile {
    DepthProfile {
        x_mm: profile.x_mm.of(side).clone(),
        depth_mm: profile.depth_mm.of(side).clone(),
    }
}

/// Tractions of a station at the named positions of the last computed cycle.
fn placed(
    line: &LineIntegrator,
    (number, profile): (usize, &StationProfile),
) -> Vec<TractionField> {
    let nodes = profile.x_mm.of(line.slave());
    let contacts = line.contacts(number);
    contacts
        .map(|(position, slider_x_mm, contact)| TractionField {
            slider_x_mm,
            ..tractions(position, line.slave(), nodes, contact)
        })
        .collect()
}
