//! How a run that restarts is refined, so that the parts of its error share the tolerance at the least cost.
//!
//! With the cost proportional to prod f_k^a_k and the parts e_k / f_k, the cost of sum e_k / f_k <= T is least where
//! each part takes the share a_k / sum a of T.

use super::companions;
use crate::model::Layout;
use crate::number::real;
use crate::record::{ErrorParts, Errors, Excess, Quantity};
use crate::scene::{Accuracy, Refinement, Scene};

/// Exponents a_k of the cost in mesh, increments and jumps: random scenes (`tolerance_table`) take 2.6 to 5, 1.6 to 1.9 and
/// 1.2 to 1.35 times the time with twice as many.
const COST: [f64; 3] = [1.6, 0.8, 0.4];

/// The same of a point contact, whose cells are as many along either axis. Measured: 1.67 times the cells along each axis, 1.25 the
/// increments and 1.6 the computed cycles took 7.3 times the time of a plated dimple, with 1.6, 0.8 and 0.4 four times.
const COST_OF_POINT: [f64; 3] = [2.6, 1.0, 0.9];

/// Part of the tolerance at which a run aims, so that the estimate that follows is within.
const AIM: f64 = 0.7;

/// Greatest factor on the cost of a run that restarts. With 8 the estimated depth of 4 instead of 9 % of random scenes
/// remained outside, for 1.7 times the time of all (orders of 1.25, meshes of any size).
const MOST_COST: f64 = 4.0;

/// Least change of a setting, as a factor, for which a run restarts.
const LEAST_CHANGE: f64 = 1.1;

/// Unknowns up to which a mesh may be refined in any case, some 400 MB, and the factor up to which a larger one may: the
/// memory of a solve is limited to four times that of the settings of the tolerance, or 1 GB (`server`).
const SMALL_MESH: f64 = 120_000.0;
const MORE_UNKNOWNS: f64 = 2.0;

/// The refinement of a run that restarts because of the errors of one with the settings of the tolerance. Settings that
/// the user has given stay as they are; an error that these alone cause is not refined for.
pub(super) fn finer(scene: &Scene, errors: &Errors) -> Refinement {
    let tolerance = scene.accuracy.tolerance;
    let free = free_settings(scene);
    let powers = cost_powers(scene);
    let all_shares: f64 = powers.iter().sum();
    let mut factors = [1.0_f64; 3];
    for Excess {
        quantity, allowed, ..
    } in errors.outside(tolerance)
    {
        if !is_decisive(quantity) {
            continue;
        }
        let ErrorParts {
            mesh,
            increments,
            jump,
            effects,
            ..
        } = errors.parts(quantity);
        let parts = [mesh, increments, jump];
        let fixed: f64 = (0..3).filter(|k| !free[*k]).map(|k| parts[k]).sum();
        let allowed = allowed - effects;
        if fixed >= allowed {
            continue;
        }
        for k in (0..3).filter(|k| free[*k]) {
            factors[k] = factors[k].max(parts[k] / (powers[k] / all_shares * AIM * allowed));
        }
    }
    let cost: f64 = factors.iter().zip(powers).map(|(f, a)| f.powf(a)).product();
    let reduction = (cost.ln() / MOST_COST.ln()).max(1.0);
    let [mesh, increments, cycles] = factors.map(|factor| factor.powf(1.0 / reduction));
    Refinement {
        mesh: mesh.min(largest_mesh_factor(scene)),
        increments,
        cycles,
    }
}

/// Exponents of the cost of a scene in mesh, increments and jumps.
fn cost_powers(scene: &Scene) -> [f64; 3] {
    match scene.dimension.point() {
        Some(_) => COST_OF_POINT,
        None => COST,
    }
}

/// Checks which of mesh, increments and jumps are chosen by the run.
fn free_settings(scene: &Scene) -> [bool; 3] {
    let Accuracy {
        contact_element_mm: element,
        increments_per_cycle: increments,
        cycle_jump: jump,
        ..
    } = scene.accuracy;
    [element.is_none(), increments.is_none(), jump.is_none()]
}

/// Checks whether a run may restart: errors are estimated, and at least one setting is not given.
pub fn may_restart(scene: &Scene) -> bool {
    scene.accuracy.estimate_errors && free_settings(scene).contains(&true)
}

/// Factor up to which the cells of a point contact may be more along each axis.
const MORE_CELLS: f64 = 2.0;

/// Unknowns are in proportion to the square of the refinement.
fn largest_mesh_factor(scene: &Scene) -> f64 {
    if scene.dimension.point().is_some() {
        return MORE_CELLS;
    }
    let unknowns = Layout::of(scene).map_or(f64::INFINITY, |layout| {
        real(layout.bodies.slider.dofs() + layout.bodies.receptacle.dofs())
    });
    (SMALL_MESH / unknowns).max(MORE_UNKNOWNS).sqrt()
}

/// Returns `true` if a run with these errors would be changed by a restart, on a mesh within the limits.
pub(super) fn is_worth_a_restart(scene: &Scene, errors: &Errors) -> bool {
    let refinement = finer(scene, errors);
    let Refinement {
        mesh,
        increments,
        cycles,
    } = refinement;
    let changes = mesh.max(increments).max(cycles) > LEAST_CHANGE;
    let has_mesh = || Layout::of(&companions::refined(scene, refinement)).is_ok();
    changes && (scene.dimension.point().is_some() || has_mesh())
}

/// Returns `true` if the error of a quantity decides about the refinement. The width of a scar is read between nodes, so that
/// coarse meshes differ in it by more than their error, and pressures have singular corners, which no refinement
/// resolves; both state their error.
pub(super) fn is_decisive(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::WornDepth | Quantity::WornArea)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::scene::{Dimension, Point};
    use crate::sides::Sides;

    fn errors(mesh: f64, increments: f64, jump: f64) -> Errors {
        Errors {
            worn_depth: ErrorParts {
                relative: mesh + increments + jump,
                mesh,
                increments,
                jump,
                effects: 0.0,
            },
            ..Errors::default()
        }
    }

    /// A scene of few unknowns.
    fn loose() -> Scene {
        let mut scene = fuzz_button();
        scene.accuracy.tolerance = 0.1;
        scene
    }

    #[test]
    fn an_error_of_given_settings_alone_is_not_refined_for() {
        let mut scene = loose();
        scene.accuracy.contact_element_mm = Some(1e-4);
        assert_eq!(finer(&scene, &errors(0.2, 0.08, 0.0)), Refinement::NONE);
        let refined = finer(&scene, &errors(0.02, 0.12, 0.0));
        assert!((refined.mesh - 1.0).abs() < 1e-12 && refined.increments > 3.0);
    }

    #[test]
    fn meshes_with_many_unknowns_are_refined_less() {
        let mut scene = fuzz_button();
        scene.accuracy.tolerance = 0.003;
        let refined = finer(&scene, &errors(1.0, 0.0, 0.0));
        assert!((refined.mesh - MORE_UNKNOWNS.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn only_parts_that_exceed_their_share_are_refined_and_given_settings_never() {
        let mut scene = loose();
        let within = errors(0.05, 0.025, 0.02);
        assert_eq!(finer(&scene, &within), Refinement::NONE);
        assert!(!is_worth_a_restart(&scene, &within));
        let coarse_mesh = errors(0.064, 0.02, 0.02);
        let Refinement {
            mesh,
            increments,
            cycles,
        } = finer(&scene, &coarse_mesh);
        // Of 0.7 times 10 % the mesh may have 16/28 = 0.04, increments 0.02, jumps 0.01.
        assert!((mesh - 1.6).abs() < 1e-12, "{mesh}");
        assert!((cycles - 2.0).abs() < 1e-12, "{cycles}");
        assert!(increments < 1.001, "{increments}");
        assert!(is_worth_a_restart(&scene, &coarse_mesh));
        scene.accuracy.contact_element_mm = Some(1e-4);
        let given = finer(&scene, &coarse_mesh);
        assert!((given.mesh - 1.0).abs() < 1e-12 && given.cycles > 1.9);
    }

    /// A ball with the tolerance of the loose scene.
    fn point() -> Scene {
        let mut scene = loose();
        scene.dimension = Dimension::Point(Point {
            force_n: 0.5,
            radius_across_mm: Sides {
                slider: Some(scene.slider.shape.radius_mm),
                receptacle: None,
            },
        });
        scene
    }

    #[test]
    fn the_cost_of_a_second_run_is_bounded_in_every_dimension() {
        for scene in [loose(), point()] {
            let Refinement {
                mesh,
                increments,
                cycles,
            } = finer(&scene, &errors(1.0, 0.5, 0.1));
            let powers = cost_powers(&scene);
            let factors = [mesh, increments, cycles].into_iter().zip(powers);
            let cost: f64 = factors.map(|(factor, power)| factor.powf(power)).product();
            assert!((cost - MOST_COST).abs() < 1e-9, "{cost}");
        }
        // The cells of a point contact cost more than the elements of a section.
        let (section, of_point) = (loose(), point());
        let mesh = |scene| finer(scene, &errors(1.0, 0.5, 0.1)).mesh;
        assert!(mesh(&of_point) < mesh(&section));
    }
}
