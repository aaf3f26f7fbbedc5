//! How a run that begins anew is refined, so that the parts of its error share the tolerance at the least cost.
//!
//! With the cost proportional to prod f_k^a_k and the parts e_k / f_k, the cost of sum e_k / f_k <= T is least where
//! each part takes the share a_k / sum a of T.

use crate::record::{Errors, Quantity};
use crate::scene::{Accuracy, Refinement, Scene};

/// Exponents a_k of the cost in mesh, increments and jumps: random scenes (`tolerance_table`) take 2.6 to 5, 1.6 to 1.9 and
/// 1.2 to 1.35 times the time with twice as many.
const COST: [f64; 3] = [1.6, 0.8, 0.4];

/// Part of the tolerance at which a run aims, so that the estimate that follows is within.
const AIM: f64 = 0.7;

/// Greatest factor on the cost of a run that begins anew. With 8 one random scene in 20 instead of 12 is left outside,
/// for 1.8 times the time of all.
const MOST_COST: f64 = 4.0;

/// Least change of a setting, as a factor, for which a run begins anew.
const LEAST_CHANGE: f64 = 1.1;

/// The refinement of a run that begins anew because of the errors of one with the settings of the tolerance.
pub(super) fn finer(scene: &Scene, errors: &Errors) -> Refinement {
    let tolerance = scene.accuracy.tolerance;
    let all_shares: f64 = COST.iter().sum();
    let mut factors = [1.0_f64; 3];
    for quantity in errors.outside(tolerance).filter(|q| is_decisive(*q)) {
        let parts = errors.parts(quantity);
        let aim = AIM * quantity.allowed(tolerance);
        for (k, part) in [parts.mesh, parts.increments, parts.jump]
            .into_iter()
            .enumerate()
        {
            factors[k] = factors[k].max(part / (COST[k] / all_shares * aim));
        }
    }
    let cost: f64 = factors.iter().zip(COST).map(|(f, a)| f.powf(a)).product();
    let reduction = (cost.ln() / MOST_COST.ln()).max(1.0);
    free(
        &scene.accuracy,
        factors.map(|factor| factor.powf(1.0 / reduction)),
    )
}

/// Leaves the settings as they are that the user has given.
fn free(accuracy: &Accuracy, factors: [f64; 3]) -> Refinement {
    let of = |given: bool, factor: f64| if given { 1.0 } else { factor };
    Refinement {
        mesh: of(accuracy.contact_element_mm.is_some(), factors[0]),
        increments: of(accuracy.increments_per_cycle.is_some(), factors[1]),
        cycles: of(accuracy.cycle_jump.is_some(), factors[2]),
    }
}

/// Whether a run with these errors would be changed by beginning anew.
pub(super) fn is_worth_a_restart(scene: &Scene, errors: &Errors) -> bool {
    let Refinement {
        mesh,
        increments,
        cycles,
    } = finer(scene, errors);
    mesh.max(increments).max(cycles) > LEAST_CHANGE
}

/// Whether the error of a quantity decides about the refinement. The width of a scar is read between nodes, so that
/// coarse meshes differ in it by more than their error, and pressures have singular corners, which no refinement
/// resolves; both state their error.
pub(super) fn is_decisive(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::WornDepth | Quantity::WornArea)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::record::ErrorParts;

    fn errors(mesh: f64, increments: f64, jump: f64) -> Errors {
        Errors {
            worn_depth: ErrorParts {
                relative: mesh + increments + jump,
                mesh,
                increments,
                jump,
            },
            ..Errors::default()
        }
    }

    #[test]
    fn only_parts_that_exceed_their_share_are_refined_and_given_settings_never() {
        let mut scene = fuzz_button();
        scene.accuracy.tolerance = 0.02;
        let within = errors(0.01, 0.005, 0.004);
        assert_eq!(finer(&scene, &within), Refinement::NONE);
        assert!(!is_worth_a_restart(&scene, &within));
        let coarse_mesh = errors(0.016, 0.004, 0.001);
        let Refinement {
            mesh,
            increments,
            cycles,
        } = finer(&scene, &coarse_mesh);
        // 0.016 over 16/28 of 0.7 times 2 %; increments have 8/28 = 0.004.
        assert!((mesh - 2.0).abs() < 1e-12, "{mesh}");
        assert!(
            increments < 1.001 && cycles < 1.001,
            "{increments} {cycles}"
        );
        assert!(is_worth_a_restart(&scene, &coarse_mesh));
        scene.accuracy.contact_element_mm = Some(1e-4);
        assert!(!is_worth_a_restart(&scene, &coarse_mesh));
    }

    #[test]
    fn the_cost_of_a_second_run_is_bounded() {
        let Refinement {
            mesh,
            increments,
            cycles,
        } = finer(&fuzz_button(), &errors(1.0, 0.5, 0.1));
        let cost = mesh.powf(COST[0]) * increments.powf(COST[1]) * cycles.powf(COST[2]);
        assert!((cost - MOST_COST).abs() < 1e-9, "{cost}");
    }
}
