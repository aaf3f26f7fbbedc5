//! The run of a contact along a line: its sections are stations, the reference is the one that touches first.

use super::sections::ReportedSections;
use crate::SolveError;
use crate::along_line::{SectionsError, StationCycle};
use crate::checkpoint::{CheckpointMismatch, LineRun, Resumable};
use crate::contact::Work;
use crate::effects::EffectsPlan;
use crate::fields::{self, LineFields, SectionState};
use crate::scene::Scene;
use crate::sides::Sides;
use crate::station::{
    LineContact, LineHistory, LineIntegrator, LineState, StationError, StationScene,
};

impl ReportedSections for LineContact {
    type History = LineHistory;

    fn unworn(scene: &Scene, plan: &EffectsPlan) -> Result<LineIntegrator, SolveError> {
        Ok(LineIntegrator::unloaded(&line_of(scene)?, plan)?)
    }

    fn resume(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &LineState,
    ) -> Result<LineIntegrator, SolveError> {
        let line = line_of(scene)?;
        let (found, stations) = (state.last().stations.len(), line.stations);
        if found != stations {
            return Err(CheckpointMismatch::Stations { found, stations }.into());
        }
        Ok(LineIntegrator::resume(&line, plan, state)?)
    }

    fn fields(
        integrator: &LineIntegrator,
        scene: &Scene,
        last: &StationCycle,
    ) -> Result<Vec<LineFields>, SolveError> {
        let Some(line) = scene.dimension.line() else {
            return Ok(Vec::new());
        };
        let numbers = last.stations.iter().enumerate();
        let sections: Vec<SectionState<'_>> = numbers
            .map(|(number, report)| {
                let (model, condensed, depth) = integrator.section(number);
                SectionState {
                    at: report.at,
                    model,
                    condensed,
                    depth,
                    contacts: integrator.contacts(number).collect(),
                }
            })
            .collect();
        Ok(integrator.within(|| fields::along_line(line.shape, &sections, last.cycle > 0))?)
    }

    fn reference(integrator: &LineIntegrator) -> usize {
        integrator.reference()
    }

    fn size(integrator: &LineIntegrator) -> (usize, usize, f64) {
        integrator.size()
    }

    fn take_history(state: &mut LineState) -> LineHistory {
        state.take_motion_history()
    }

    fn continue_motion(state: &mut LineState, history: LineHistory) {
        state.continue_motion(history);
    }

    fn fastest_rate(state: &LineState) -> Sides<f64> {
        state.fastest_rate()
    }

    fn work(state: &LineState) -> Work {
        state.work()
    }

    fn mean_jump_error(state: &LineState, histories: &[&LineHistory]) -> f64 {
        state.mean_jump_error(histories)
    }

    fn resumable(run: &LineRun) -> Resumable<'_> {
        Resumable::Line(run)
    }
}

fn line_of(scene: &Scene) -> Result<StationScene, StationError> {
    StationScene::of(scene).ok_or(StationError::Sections(SectionsError::Motion))
}
