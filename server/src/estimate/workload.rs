//! Estimated work of a solve: contact increments by the number of nodes that they are solved for, and condensations by
//! the size of the body. [`crate::estimate::machine`] converts it to processor seconds.

use std::collections::BTreeMap;

use solver::effects;
use solver::error_control::{companion_scenes, may_restart};
use solver::extruded::ExtrudedScene;
use solver::forecast::{LineForecast, forecast, line_forecast, point_forecast};
use solver::law::surface::SurfaceWear;
use solver::model::{BodyLayout, Layout};
use solver::scene::Effect;
use solver::scene::Scene;
use solver::sides::{Side, Sides};

use crate::number::real;

/// Estimated work of a solve.
#[derive(Debug, Clone, PartialEq)]
pub struct Workload {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// Largest number of increments in one cycle.
    pub most_increments: u32,
    /// Nodes that a contact increment is solved for, with the number of such increments.
    pub increments: Vec<(f64, f64)>,
    /// Condensations of the slider and of the receptacle.
    pub condensations: [Condensations; 2],
    /// Bodies of prisms that are factored again for their fields, as condensations of the slider and of the receptacle.
    pub interiors: [Condensations; 2],
    /// Iterations of area contacts times the cells of their windows.
    pub cell_iterations: f64,
    /// Cells of the windows and of the surfaces of a point contact at most.
    pub cells: (f64, f64),
    /// Numbers that an implicit jump holds for the contacts at all of its positions at once, at most.
    pub held_numbers: f64,
    /// Sections along a line; 1 of a section.
    pub stations: usize,
    /// Node planes of extruded bodies, which are condensed together; 1 of others.
    pub planes: usize,
    /// Parts that the forecast leaves out.
    pub left_out: LeftOut,
    /// Work of the coarse companions that the run's error is estimated by.
    pub companions: Vec<Workload>,
}

/// Condensations of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condensations {
    /// Number of condensations.
    pub count: f64,
    /// Unknowns of the body.
    pub dofs: f64,
    /// Nodes on its contact surface.
    pub surface_nodes: f64,
}

impl Workload {
    /// Estimates the workload of a scene from its mesh lines.
    pub(crate) fn of(scene: &Scene, layout: Option<&Layout>) -> Self {
        let line = layout.and_then(|layout| line_forecast(scene, layout).zip(Some(layout)));
        match (line, layout) {
            (Some((forecast, layout)), _) => Self::of_line(scene, layout, &forecast),
            (None, Some(layout)) => Self::of_section(scene, layout),
            (None, None) => Self::of_point(scene),
        }
    }

    /// Workload of sections along a line.
    fn of_line(scene: &Scene, layout: &Layout, forecast: &LineForecast) -> Self {
        let mut increments = BTreeMap::new();
        for (nodes, count) in &forecast.solves {
            *increments.entry(*nodes).or_insert(0.0) += count;
        }
        let increments = increments.into_iter();
        let bodies = &layout.bodies;
        Self {
            computed_cycles: forecast.computed_cycles,
            most_increments: u32::try_from(forecast.most_increments).unwrap_or(u32::MAX),
            increments: increments
                .map(|(nodes, count)| (real(nodes), count))
                .collect(),
            condensations: [
                condensations(forecast.condensations.slider, &bodies.slider),
                condensations(forecast.condensations.receptacle, &bodies.receptacle),
            ]
            .map(|body| body.of_planes(forecast.planes)),
            interiors: interiors(scene, layout),
            cell_iterations: 0.0,
            cells: (0.0, 0.0),
            held_numbers: 0.0,
            stations: forecast.stations,
            planes: forecast.planes,
            left_out: left_out(scene, forecast.fast_layer > LONG_EDGE),
            companions: companions(scene),
        }
    }

    /// Workload of a point contact, which condenses nothing.
    fn of_point(scene: &Scene) -> Self {
        let forecast = point_forecast(scene).unwrap_or_default();
        Self {
            computed_cycles: forecast.computed_cycles,
            most_increments: u32::try_from(forecast.most_increments).unwrap_or(u32::MAX),
            increments: vec![(0.0, forecast.increments)],
            condensations: [Condensations::NONE; 2],
            interiors: [Condensations::NONE; 2],
            cell_iterations: forecast.cell_iterations,
            cells: (real(forecast.most_cells), real(forecast.surface_cells)),
            held_numbers: forecast.held_numbers,
            stations: 1,
            planes: 1,
            left_out: left_out(scene, true),
            companions: companions(scene),
        }
    }

    fn of_section(scene: &Scene, layout: &Layout) -> Self {
        let forecast = forecast(scene, layout);
        let mut increments = BTreeMap::new();
        for segment in &forecast.segments {
            *increments.entry(segment.solved).or_insert(0.0) += segment.increments;
        }
        let increments = increments.into_iter();
        let steps = forecast.segments.iter().map(|segment| segment.steps).max();
        let Sides { slider, receptacle } = forecast.condensations;
        Self {
            computed_cycles: forecast.computed_cycles,
            most_increments: u32::try_from(steps.unwrap_or(1)).unwrap_or(u32::MAX),
            increments: increments
                .map(|(nodes, increments)| (real(nodes), increments))
                .collect(),
            condensations: [
                condensations(f64::from(slider), &layout.bodies.slider),
                condensations(f64::from(receptacle), &layout.bodies.receptacle),
            ],
            interiors: [Condensations::NONE; 2],
            cell_iterations: 0.0,
            cells: (0.0, 0.0),
            held_numbers: forecast.held_numbers,
            stations: 1,
            planes: 1,
            left_out: left_out(scene, forecast.fast_layer > LONG_EDGE),
            companions: companions(scene),
        }
    }

    /// Contact increments of the whole run.
    pub fn increments(&self) -> f64 {
        self.increments.iter().map(|(_, count)| count).sum()
    }

    /// Estimates of a plan, by name.
    pub(super) fn estimates(&self) -> [(&'static str, f64); 3] {
        let condensations = self.condensations.iter().map(|body| body.count);
        [
            ("computed_cycles", self.computed_cycles.round()),
            ("condensations", condensations.sum()),
            ("increments", self.increments().round()),
        ]
    }
}

/// Parts that a forecast leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeftOut {
    /// Little.
    Little,
    /// A restart on finer settings, which few runs need.
    Restart,
    /// Details of the wear of layers, and a restart, which few of these runs need.
    Layers,
    /// The same of a run that wears most of a layer, of which some restart for their increments.
    WornLayers,
    /// Details of the wear of layers, and a restart, which most of these runs need.
    LayersAndRestart,
}

/// Parts that the forecast of a scene leaves out, if runs with layers mostly restart or not.
fn left_out(scene: &Scene, restarts_with_layers: bool) -> LeftOut {
    match (is_layered(scene), may_restart(scene)) {
        (false, false) => LeftOut::Little,
        (false, true) => LeftOut::Restart,
        (true, true) if restarts_with_layers => LeftOut::LayersAndRestart,
        (true, true) if effects::plan(scene).simulates(Effect::Plating) => LeftOut::WornLayers,
        (true, _) => LeftOut::Layers,
    }
}

/// Least `Forecast::fast_layer` with which runs of computed cycles count as ones that restart. Of solved sections those with 1.28 and more restarted, none
/// with 0.97 and less. Some forecasts reach the layer too early, so that five of 30 runs counted that did not restart.
const LONG_EDGE: f64 = 1.15;

/// Checks whether the wear rate of a side depends on the depth.
fn is_layered(scene: &Scene) -> bool {
    let wear = scene.surface_wear();
    let sides = Side::BOTH.map(|side| *wear.of(side));
    sides
        .into_iter()
        .flatten()
        .any(SurfaceWear::depends_on_depth)
}

/// Part of the time of a condensation that the fields of a snapshot take. Measured: 0.63, 0.55 and 0.42 with 2, 3 and 5 planes.
const INTERIOR_SHARE: f64 = 0.5;

/// Condensations for the fields of extruded bodies: at each snapshot, and in the unworn state. Other bodies are factored already.
fn interiors(scene: &Scene, layout: &Layout) -> [Condensations; 2] {
    let extruded = ExtrudedScene::of(scene).filter(|bodies| bodies.section.output.fields);
    let Some(extruded) = extruded else {
        return [Condensations::NONE; 2];
    };
    let snapshots = real(scene.output.snapshots_at_cycles.len()) + 1.0;
    let bodies = [&layout.bodies.slider, &layout.bodies.receptacle];
    bodies.map(|body| {
        let once = Condensations {
            count: INTERIOR_SHARE * snapshots,
            ..condensations(1.0, body)
        };
        once.of_planes(extruded.node_planes())
    })
}

/// Those beside which the errors of a run are estimated.
fn companions(scene: &Scene) -> Vec<Workload> {
    solvable(companion_scenes(scene))
}

/// The workloads of scenes; those that cannot be meshed are not solved.
fn solvable(scenes: Vec<Scene>) -> Vec<Workload> {
    let scenes = scenes.into_iter();
    scenes
        .filter_map(|scene| {
            if scene.dimension.point().is_some() {
                return Some(Workload::of(&scene, None));
            }
            let layout = Layout::of(&scene).ok()?;
            Some(Workload::of(&scene, Some(&layout)))
        })
        .collect()
}

/// Prisms between n planes of a mesh take as long to factor as a plane mesh of n to this power times its unknowns, since the factor fills.
/// Fitted: the draft mesh of the thesis' fuzz button with 2, 3 and 5 planes takes 1.1, 3.5 and 11 s, by itself 0.1 s.
const FILL_POWER: f64 = 2.5;

impl Condensations {
    /// Condensations of prisms between so many planes.
    fn of_planes(self, planes: usize) -> Self {
        if planes == 1 {
            return self;
        }
        Self {
            dofs: self.dofs * real(planes).powf(FILL_POWER),
            surface_nodes: self.surface_nodes * real(planes),
            ..self
        }
    }

    /// None at all.
    const NONE: Self = Self {
        count: 0.0,
        dofs: 0.0,
        surface_nodes: 0.0,
    };
}

fn condensations(times: f64, body: &BodyLayout) -> Condensations {
    Condensations {
        count: times * real(body.zones.len()),
        dofs: real(body.dofs()),
        surface_nodes: real(body.largest_zone()),
    }
}

#[cfg(test)]
mod tests {
    use super::Workload;
    use crate::estimate::Estimate;
    use crate::spec;

    fn workload(text: &str) -> Workload {
        Estimate::of(&spec::read(text.as_bytes()).expect("accepted")).workload
    }

    #[test]
    fn a_tighter_tolerance_is_more_work_and_a_stop_condition_less() {
        let system = |rest: &str| {
            let law = r#"{"law":"archard","k":0.004,"hardness_mpa":1700}"#;
            workload(&format!(
                r#"{{"system":{{"kind":"sd_card"}},"plating":{{"slider":[],"receptacle":[]}},"interface":{{"wear":{{"slider":null,"receptacle":{law}}}}}{rest}}}"#
            ))
        };
        let standard = system("");
        let fine = system(r#","accuracy":{"preset":"fine"}"#);
        assert!(fine.increments() > 4.0 * standard.increments());
        assert!(fine.condensations[1].dofs > 2.0 * standard.condensations[1].dofs);
        let stopped = system(r#","stop":[{"worn_depth_mm":0.0002}]"#);
        assert!(
            stopped.increments() < 0.7 * standard.increments(),
            "{stopped:?}"
        );
    }

    #[test]
    fn fixed_settings_determine_the_workload() {
        let text = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":600,"output":{"snapshots_at_cycles":[600]},
            "accuracy":{"overrides":{"increments_per_cycle":40,"cycle_jump":100}}}"#;
        let run = workload(text);
        assert!((run.computed_cycles - 6.0).abs() < 1e-12);
        // Two more for the contact at the neutral position, and one to each turning point in the last cycle.
        assert!((run.increments() - 254.0).abs() < 1e-9);
    }

    #[test]
    fn runs_beyond_the_simulated_length_are_extrapolated() {
        let text = r#"{"system":{"kind":"dimm"},"cycles":1000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#;
        let run = workload(text);
        assert!(
            (run.computed_cycles - 1e6).abs() < 1.0,
            "{}",
            run.computed_cycles
        );
    }
}
