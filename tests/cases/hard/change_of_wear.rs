//! Requirement: a wear coefficient that changes a hundredfold from one cycle to the next (a plating that is worn
//! through) preserves balance and worn area.
//! Source: plated contacts; two runs joined, the second one continuing from the state of the first.
//! Naive: a jump chosen for the slow wear is a hundred times too large for the fast one.

use serde_json::json;
use solver::condensation::condense;
use solver::cycle::{CycleState, Integrator};
use solver::law::surface::SurfaceWear;
use solver::law::wear::WearLaw;

use super::run::scene;
use super::specs::cylinder;

#[test]
fn wear_coefficient_can_change_a_hundredfold_between_two_cycles() {
    let scene = scene(&cylinder(json!({
        "interface": {"wear": {"receptacle": {"k_over_h_per_mpa": 1e-6}}},
        "cycles": 2000,
    })));
    let mut model = solver::model::build(&scene, &solver::effects::plan(&scene))
        .expect("the scene can be meshed");
    let condensed = condense(&model, 1).expect("it can be condensed");
    let operators = &condensed.operators;
    let widths = model.bodies.receptacle.contact_widths();
    let mut state = CycleState::start(operators, model.interface.slave);
    let mut energy = 0.0;
    let mut expected = 0.0;
    for (round, k) in [1e-8, 1e-6, 1e-8].into_iter().enumerate() {
        model.interface.wear.receptacle = Some(SurfaceWear::Law(WearLaw::Archard {
            k_over_h_per_mpa: k,
        }));
        let mut integrator = Integrator::new(&scene, &model, operators);
        if round == 0 {
            integrator.apply_load(&mut state).expect("it settles");
            integrator.initial_quarter(&mut state).expect("it sets out");
        }
        let until = state.cycle + 300;
        while state.cycle < until {
            integrator
                .compute_cycle(&mut state, until, true)
                .expect("the cycle goes through");
        }
        // In gross slip the dissipated energy is mu times the integral of p |slip|.
        expected += k * (state.energy - energy) / model.interface.friction;
        energy = state.energy;
    }
    let worn: f64 = widths
        .iter()
        .zip(&state.depth.receptacle)
        .map(|(w, d)| w * d)
        .sum();
    assert!((worn / expected - 1.0).abs() < 1e-9, "{worn} {expected}");
    assert!(state.checks.force_balance < 1e-9 && state.checks.complementarity < 1e-9);
    assert!(
        state
            .contact
            .pressure
            .iter()
            .all(|p| p.is_finite() && *p >= -1e-9)
    );
}
