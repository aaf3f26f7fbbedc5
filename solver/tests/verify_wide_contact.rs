//! Contacts of hundreds of nodes, whose operators are compressed and whose Jacobian is factored with off-diagonal blocks of low rank
//! (Ambikasaran and Darve 2013): the same displacements and the same solutions.

use crate::verification::scenes::mccoll;
use crate::verification::verify_plating::layer;
use solver::condensation::{Condensed, condense};
use solver::cycle::{CycleState, Integrator};
use solver::model::{self, Model};
use solver::scene::{Effect, Switches};
use solver::scene::{Friction, Motion, Rhee, Scene, WearLaw};
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
    let condensed = condense(&model, 1).expect("it can be condensed");
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
            .compute_cycle(&mut state, 2, true)
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
        zone.add_displacements(&from, &forces, &of, &mut compressed);
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
fn converge_like_narrow_ones(cases: &[(f64, [f64; 2])]) {
    for &(amplitude, worn) in cases {
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
        // Refining a wide contact changes each at most half as much as refining a narrow one, or hardly. A half-width is read within
        // an element, 0.6 % of it with 320 nodes.
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

#[test]
fn wide_contacts_converge_like_narrow_ones() {
    converge_like_narrow_ones(&[(0.0012, [RATE, 0.0]), (0.01, [1e-6, 1e-6])]);
}

mod long {
    use super::{RATE, converge_like_narrow_ones};

    #[test]
    #[ignore = "long: takes 40 s"]
    fn wide_contacts_converge_whichever_body_wears() {
        converge_like_narrow_ones(&[
            (0.0012, [0.0, RATE]),
            (0.0012, [RATE, RATE]),
            (0.01, [0.0, 1e-6]),
        ]);
    }
}

type Change = fn(&mut Scene);

/// Everything that the Jacobian of a wide contact is written for in another way than that of a narrow one: layers that are worn through,
/// laws of which a power of the depth adds, a spring, slip as imposed, no friction; both bodies worn, either carrying the constraints.
#[test]
fn wide_contacts_of_other_laws_and_plans_wear_like_narrow_ones() {
    let cases: [(&str, f64, Change); 6] = [
        ("layers worn through, gross slip", 0.01, |scene| {
            scene.receptacle.plating = vec![layer(3e-5, 1e-6)];
            scene.slider.plating = vec![layer(2e-5, 5e-7)];
        }),
        ("layers worn through, partial slip", 0.0012, |scene| {
            scene.receptacle.plating = vec![layer(2e-6, 1e-6)];
        }),
        ("power of the depth", 0.01, |scene| {
            let law = Rhee {
                factor: 1e-7,
                pressure_exponent: 1.0,
                speed_exponent: 1.0,
                time_exponent: 0.8,
            };
            scene.receptacle.wear = Some(WearLaw::Power(law.power_law()));
        }),
        ("spring", 0.01, |scene| scene.spring_n_per_mm2 = 1e5),
        ("slip as imposed", 0.01, |scene| {
            scene.effects = Switches::default().with(Effect::StickMemory, false);
        }),
        ("no friction", 0.01, |scene| {
            scene.effects = Switches::default().with(Effect::Friction, false);
        }),
    ];
    for (name, amplitude, change) in cases {
        let rates = Sides {
            slider: 1e-6,
            receptacle: 3e-6,
        };
        let [narrow, wide] = [160, 330].map(|nodes| {
            let mut scene = scene(nodes, amplitude, rates);
            change(&mut scene);
            slide(&scene)
        });
        assert!(
            wide.checks.complementarity <= 1e-11,
            "{name}: {:?}",
            wide.checks
        );
        assert!(wide.checks.worn_area <= 1e-11, "{name}: {:?}", wide.checks);
        let deepest = |state: &CycleState, side| {
            let depths = state.depth.of(side).iter();
            depths.fold(0.0, |most: f64, depth| most.max(*depth))
        };
        for side in Side::BOTH {
            // The tolerance of the scene; depths at the edge of a stick zone differ by 1 % between these meshes.
            for (what, narrow, wide) in [
                ("area", *narrow.worn_area.of(side), *wide.worn_area.of(side)),
                ("deepest", deepest(&narrow, side), deepest(&wide, side)),
            ] {
                println!("{name}, {}: {what} {narrow:.4e}, {wide:.4e}", side.name());
                assert!((wide / narrow - 1.0).abs() < 0.02, "{name}");
            }
        }
        let per_increment =
            |state: &CycleState| real(state.work.factorizations) / real(state.work.increments);
        let factorizations = [per_increment(&narrow), per_increment(&wide)];
        println!("{name}: factorizations an increment {factorizations:.2?}");
        assert!(factorizations[1] < 2.5 * factorizations[0], "{name}");
    }
}

fn real(count: u64) -> f64 {
    f64::from(u32::try_from(count).expect("it is small"))
}
