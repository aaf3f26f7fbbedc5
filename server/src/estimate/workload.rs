//! How much there is to do in a solve, counted before anything is solved: contact increments by the nodes that each
//! watches, and condensations by the size of the body. What a machine takes for it is `machine`'s to tell.

use std::collections::BTreeMap;

use solver::cycle::forecast::forecast;
use solver::model::{BodyLayout, Layout};
use solver::scene::Scene;

/// What a solve has to do.
#[derive(Debug, Clone, PartialEq)]
pub struct Workload {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// The most increments in one cycle.
    pub most_increments: u32,
    /// Contact increments by the number of nodes that they watch, each with its count.
    pub increments: Vec<(f64, f64)>,
    /// Condensations of the slider and of the receptacle.
    pub condensations: [Condensations; 2],
}

/// Condensations of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condensations {
    /// How many.
    pub count: f64,
    /// Unknowns of the body.
    pub dofs: f64,
    /// Nodes on its contact surface.
    pub surface_nodes: f64,
}

impl Workload {
    /// Of a scene on the layout of its meshes.
    pub(crate) fn of(scene: &Scene, layout: &Layout) -> Self {
        let foreseen = forecast(scene, layout);
        let mut increments = BTreeMap::new();
        for part in &foreseen.segments {
            *increments.entry(part.watched).or_insert(0.0) += part.increments;
        }
        let increments = increments.into_iter();
        let steps = foreseen.segments.iter().map(|part| part.steps).max();
        let [slider, receptacle] = foreseen.condensations;
        Self {
            computed_cycles: foreseen.computed_cycles,
            most_increments: u32::try_from(steps.unwrap_or(1)).unwrap_or(u32::MAX),
            increments: increments
                .map(|(nodes, many)| (count(nodes), many))
                .collect(),
            condensations: [
                condensations(slider, &layout.slider),
                condensations(receptacle, &layout.receptacle),
            ],
        }
    }

    /// Contact increments of the whole run.
    pub fn increments(&self) -> f64 {
        self.increments.iter().map(|(_, many)| many).sum()
    }

    /// As figures of a plan.
    pub(crate) fn figures(&self) -> BTreeMap<String, f64> {
        let condensations = self.condensations.iter().map(|body| body.count);
        BTreeMap::from([
            ("computed_cycles".to_owned(), self.computed_cycles.round()),
            ("condensations".to_owned(), condensations.sum()),
            ("increments".to_owned(), self.increments().round()),
        ])
    }
}

fn condensations(count_of: u32, body: &BodyLayout) -> Condensations {
    Condensations {
        count: f64::from(count_of),
        dofs: count(body.dofs()),
        surface_nodes: count(body.contact_x().len()),
    }
}

/// Meshes stay far below 2^32 nodes.
pub(crate) fn count(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use crate::spec;

    #[test]
    fn a_tighter_tolerance_is_more_work_and_a_stop_condition_less() {
        let work = |rest: &str| {
            let text = format!(r#"{{"system":{{"kind":"sd_card"}}{rest}}}"#);
            spec::read(text.as_bytes()).expect("accepted").workload
        };
        let standard = work("");
        let fine = work(r#","accuracy":{"preset":"fine"}"#);
        assert!(fine.increments() > 4.0 * standard.increments());
        assert!(fine.condensations[1].dofs > 2.0 * standard.condensations[1].dofs);
        let stopped = work(r#","stop":[{"worn_depth_mm":0.0002}]"#);
        assert!(
            stopped.increments() < 0.7 * standard.increments(),
            "{stopped:?}"
        );
    }

    #[test]
    fn fixed_settings_are_counted_as_they_are_given() {
        let text = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":600,"output":{"snapshots_at_cycles":[600]},
            "accuracy":{"overrides":{"increments_per_cycle":40,"cycle_jump":100}}}"#;
        let work = spec::read(text.as_bytes()).expect("accepted").workload;
        assert!((work.computed_cycles - 6.0).abs() < 1e-12);
        assert!((work.increments() - 240.0).abs() < 1e-9);
    }

    #[test]
    fn a_run_that_is_too_long_to_follow_is_counted_all_the_same() {
        let text = r#"{"system":{"kind":"dimm"},"cycles":1000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#;
        let work = spec::read(text.as_bytes()).expect("accepted").workload;
        assert!(
            (work.computed_cycles - 1e6).abs() < 1.0,
            "{}",
            work.computed_cycles
        );
    }
}
