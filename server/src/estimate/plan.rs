//! The plan of a resolved specification: effects with reasons, closed-form results for the unworn contact, and the
//! estimated cost of the solve.

use api::plan::{MachineFigures, Plan, PlannedEffect, Warning};
use api::problem::Fault;
use solver::closed_form::unworn_contact;
use solver::closed_form::{PointScene, SlipRegime};
use solver::effects::{self, Indicator};
use solver::scene::Scene;

use crate::estimate::expected_time::ExpectedTime;
use crate::estimate::{Estimate, life, notes};
use crate::export::history;
use crate::spec::Resolved;
use crate::words;

impl Estimate {
    /// The plan of the resolved specification, with processor seconds if the machine is calibrated.
    pub fn plan(&self, resolved: &Resolved, machine: Option<&MachineFigures>) -> Plan {
        let mut estimates = unworn_contact(&resolved.scene);
        estimates.extend(self.footprint.estimates());
        estimates.extend(self.workload.estimates());
        let estimates = estimates.into_iter();
        let seconds = machine.map(|machine| ExpectedTime::of(machine, &self.workload).estimates());
        Plan {
            effects: planned_effects(&resolved.scene),
            estimates: estimates
                .map(|(name, value)| (name.to_owned(), value))
                .chain(seconds.unwrap_or_default())
                .collect(),
            motion: resolved.motion.clone(),
            mission: resolved.blocks.clone(),
            life: life::planned(resolved),
            warnings: resolved.warnings.iter().map(warning).collect(),
            notes: notes::notes(resolved),
        }
    }
}

fn warning(Fault { pointer, detail }: &Fault) -> Warning {
    Warning {
        field: pointer.clone(),
        detail: detail.clone(),
    }
}

fn planned_effects(scene: &Scene) -> Vec<PlannedEffect> {
    let decisions = effects::plan(scene).decisions;
    decisions.into_iter().map(planned).collect()
}

fn planned(decision: effects::Decision) -> PlannedEffect {
    let (effect, indicator) = (decision.effect, decision.indicator());
    PlannedEffect {
        effect: words::effects::name(effect).to_owned(),
        decision: history::decision(decision.verdict),
        indicator: words::effects::indicator(effect).to_owned(),
        // JSON has no infinity.
        value: indicator
            .map(Indicator::value)
            .filter(|value| value.is_finite()),
        threshold: indicator.map(|indicator| indicator.threshold),
        changes: words::effects::changes(effect)
            .iter()
            .map(|&output| output.to_owned())
            .collect(),
        reason: words::decisions::reason(&decision),
    }
}

/// Hertz line contact (K. L. Johnson, *Contact Mechanics*, eq. 4.43 to 4.45): the engine's a,
/// p0 = 2 P / (pi a); and the depth worn by one full pass after Archard's law: (k/H) P per crossed point.
fn unworn_contact(scene: &Scene) -> Vec<(&'static str, f64)> {
    let load = scene.load_n_per_mm;
    let half_width = unworn_contact::hertz_half_width(scene);
    let distance = scene.motion.distance_per_cycle_mm();
    let mut estimates = vec![
        ("line_load_n_per_mm", load),
        ("hertz_half_width_mm", half_width),
        (
            "hertz_peak_pressure_mpa",
            unworn_contact::hertz_peak_pressure(scene),
        ),
        ("sliding_distance_per_cycle_mm", distance),
    ];
    if let Some(contact) = PointScene::of(scene, SlipRegime::Gross) {
        let (_, across) = contact.half_lengths_mm();
        estimates.push(("hertz_half_length_across_mm", across));
        estimates.push(("force_n", contact.force_n));
    }
    if let Some(rate) = scene.slider.outer_rate() {
        let area = rate * load * distance;
        estimates.push(("slider_ideal_area_per_cycle_mm2", area));
    }
    if let Some(rate) = scene.receptacle.outer_rate() {
        let depth = rate * load;
        estimates.push(("receptacle_ideal_area_per_cycle_mm2", depth * distance));
        estimates.push(("receptacle_full_pass_depth_mm", depth));
    }
    estimates
}

#[cfg(test)]
mod tests {
    use super::*;

    const MACHINE: MachineFigures = MachineFigures {
        program: String::new(),
        increment_s: 1e-4,
        increment_power: 1.5,
        condensation_dof_s: 1e-7,
        condensation_surface_s: 1e-9,
    };

    #[test]
    fn seconds_are_a_range_of_a_calibrated_machine() {
        let text = r#"{"system":{"kind":"dimm"},"cycles":200}"#;
        let resolved = crate::spec::read(text.as_bytes()).expect("accepted");
        let estimate = Estimate::of(&resolved);
        let planned = estimate.plan(&resolved, Some(&MACHINE)).estimates;
        let (likely, most) = (planned["cpu_s"], planned["cpu_s_most"]);
        assert!(likely > 0.0 && most > likely && most <= 4.0 * likely);
        let unknown = estimate.plan(&resolved, None).estimates;
        assert!(!unknown.contains_key("cpu_s") && !unknown.contains_key("cpu_s_most"));
    }
}
