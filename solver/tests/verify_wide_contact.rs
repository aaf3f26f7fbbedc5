//! Contacts of hundreds of nodes, whose operators are compressed and whose Jacobian is factored with off-diagonal blocks of low rank
//! (Ambikasaran and Darve 2013): the same displacements, the same solutions, and an effort of about n^1.5.

use crate::scenes::mccoll;
use solver::condensation::{Condensed, condense};
use solver::cycle::{CycleState, Integrator};
use solver::model::{self, Model};
use solver::scene::{Friction, Motion, Scene, WearLaw};
use solver::sides::{Side, Sides};

/// Half-width of the unworn contact, mm (`verify_cattaneo_mindlin`).
const HALF_WIDTH: f64 = 0.091_336;
const RATE: f64 = 3e-6;

type Quantity = fn(&CycleState) -> f64;

/// Partial slip or gross slip, by the amplitude, with so many nodes in contact.
fn scene(nodes: u32, amplitude_mm: f64, worn: Sides<f64>) -> Scene {
    let mut scene = mccoll();
    scene.slider.wear = law(worn.slider);
    scene.receptacle.wear = law(worn.receptacle);
    scene.friction = Friction::Coulomb { coefficient: 0.6 };
    scene.load_n_per_mm = 120.0;
    scene.cycles = 10;
    scene.motion = Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    };
    scene.accuracy.contact_element_mm = Some(2.0 * HALF_WIDTH / f64::from(nodes));
    scene.accuracy.increments_per_cycle = Some(20);
    scene.accuracy.cycle_jump = Some(2);
    scene
}

fn law(rate: f64) -> Option<WearLaw> {
    (rate > 0.0).then_some(WearLaw::Archard {
        k_over_h_per_mpa: rate,
    })
}

fn condensed(scene: &Scene) -> (Model, Condensed) {
    let model = model::build(scene, &solver::effects::plan(scene)).expect("it can be meshed");
    let condensed = condense(&model).expect("it can be condensed");
    (model, condensed)
}

/// The state after two computed cycles of two.
fn slide(scene: &Scene) -> CycleState {
    let (model, condensed) = condensed(scene);
    let mut state = CycleState::start(&condensed.operators, model.interface.slave);
    let mut integrator = Integrator::new(scene, &model, &condensed.operators);
    integrator.apply_load(&mut state).expect("it settles");
    integrator.initial_quarter(&mut state).expect("it sets out");
    for _ in 0..2 {
        integrator
            .compute_cycle(&mut state, (2, true))
            .expect("it slides");
    }
    state
}

#[test]
fn compressed_displacements_are_those_of_the_compliance() {
    let (_, condensed) = condensed(&scene(
        320,
        0.0012,
        Sides {
            slider: 0.0,
            receptacle: RATE,
        },
    ));
    for side in Side::BOTH {
        let zone = &condensed.operators.of(side).zones[0];
        let nodes = zone.nodes();
        let third = nodes.len() / 3;
        let (from, of) = (
            nodes.start + third..nodes.end - 2,
            nodes.start + 1..nodes.start + 2 * third,
        );
        // Forces without a regularity that would hide an error.
        let forces: Vec<f64> = (0..2 * u64::try_from(from.len()).expect("it is small"))
            .map(|i| real((i * i) % 17) - 8.0)
            .collect();
        let mut compressed = vec![0.0; 2 * of.len()];
        zone.add_displacements((&from, &forces), (&of, &mut compressed));
        let mut exact = vec![0.0; 2 * of.len()];
        for (j, force) in from.clone().zip(forces.as_chunks::<2>().0) {
            let [per_x, per_y] = zone.to_force_at(j, &of);
            for (i, u) in exact.iter_mut().enumerate() {
                *u += force[0] * per_x[i] + force[1] * per_y[i];
            }
        }
        let largest = exact.iter().fold(0.0, |m: f64, u| m.max(u.abs()));
        let off = exact.iter().zip(&compressed);
        let off = off.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / largest;
        println!("{}: displacements off by {off:.1e}", side.name());
        assert!(off < 1e-12, "{off:e}");
    }
}

/// Whichever body wears, in partial and in gross slip: from 80 nodes, which are solved densely, to 160, and from 320 to 640, which are
/// not, wear, energy and width change as little as a finer mesh makes them; the constraints hold to the same residuals.
#[test]
fn wide_contacts_converge_like_narrow_ones() {
    for (amplitude, worn) in [
        (0.0012, [0.0, RATE]),
        (0.0012, [RATE, 0.0]),
        (0.0012, [RATE, RATE]),
        (0.01, [0.0, 1e-6]),
        (0.01, [1e-6, 1e-6]),
    ] {
        let [slider, receptacle] = worn;
        let worn = Sides { slider, receptacle };
        let states = [80, 160, 320, 640].map(|nodes| slide(&scene(nodes, amplitude, worn)));
        for state in &states {
            let checks = &state.checks;
            assert!(checks.complementarity <= 1e-11, "{checks:?}");
            assert!(checks.friction_cone <= 1e-11, "{checks:?}");
            assert!(checks.force_balance <= 1e-9, "{checks:?}");
            assert!(checks.worn_area <= 1e-11, "{checks:?}");
        }
        // What a mesh changes, and the change between the wide contacts that would be too large.
        let quantities: [(Quantity, f64); 3] = [
            (
                |state| state.worn_area.slider + state.worn_area.receptacle,
                1e-4,
            ),
            (|state| state.energy, 1e-4),
            (|state| state.neutral.half_width, 4e-3),
        ];
        for (quantity, most) in quantities {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| quantity(&states[i]));
            let (narrow, wide) = ((b - a).abs() / d, (d - c).abs() / d);
            println!("+-{amplitude} mm, {worn:?}: changes of {narrow:.1e} and {wide:.1e}");
            assert!(wide <= most.max(0.5 * narrow), "{wide:e}");
        }
        let factorizations = states
            .each_ref()
            .map(|state| real(state.work.factorizations) / real(state.work.increments));
        println!("factorizations an increment: {factorizations:.2?}");
        // Statuses change at more nodes of a finer mesh from one increment to the next.
        assert!(factorizations[3] < 2.5 * factorizations[0]);
    }
}

fn real(count: u64) -> f64 {
    f64::from(u32::try_from(count).expect("it is small"))
}
