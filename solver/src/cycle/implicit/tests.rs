use super::contacts::{Bodies, Contacts};
use super::jump::{ImplicitJump, JumpSystem};
use super::*;
use crate::condensation::{Condensed, condense};
use crate::contact::DoseUnknowns;
use crate::effects;
use crate::linear::BorderedBand;
use crate::model::tests::fuzz_button;
use crate::model::{self, Model};
use crate::number::real;
use crate::scene::{Accuracy, BlockShape, Friction, Layer, Scene, SliderShape, WearLaw};

/// Wear of both bodies, gold over a base of 20 times its rate.
const GOLD: f64 = 1e-8;
const BASE: f64 = 2e-7;

/// A tip on a flat pad, both plated, 60 increments a cycle.
fn scene() -> Scene {
    let mut scene = fuzz_button();
    scene.slider.shape = SliderShape {
        radius_mm: 0.4,
        half_width_mm: 0.3,
        height_mm: 0.4,
    };
    scene.receptacle.shape = BlockShape {
        length_mm: 2.0,
        height_mm: 0.3,
        crown_radius_mm: None,
    };
    let base = Some(WearLaw::Archard {
        k_over_h_per_mpa: BASE,
    });
    let gold = vec![Layer {
        thickness_mm: 1e-4,
        rate_per_mpa: GOLD,
    }];
    (scene.slider.wear, scene.receptacle.wear) = (base, base);
    (scene.slider.plating, scene.receptacle.plating) = (gold.clone(), gold);
    scene.friction = Friction::Coulomb { coefficient: 0.3 };
    scene.load_n_per_mm = 0.625;
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.02,
        period_s: 1.0,
    };
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.accuracy.increments_per_cycle = Some(60);
    scene.accuracy.tuning.implicit_jumps = true;
    scene.stop.clear();
    scene.life.clear();
    scene
}

/// A condensed scene.
struct Bench {
    scene: Scene,
    model: Model,
    condensed: Condensed,
}

impl Bench {
    fn new(scene: Scene) -> Self {
        let plan = effects::plan(&scene);
        let model = model::build(&scene, &plan).expect("it can be meshed");
        let condensed = condense(&model, 1).expect("it can be condensed");
        Self {
            scene,
            model,
            condensed,
        }
    }

    /// An integrator, and the state where cycles begin.
    fn begin(&self) -> (Integrator<'_>, CycleState) {
        let operators = &self.condensed.operators;
        let mut integrator = Integrator::new(&self.scene, &self.model, operators);
        let mut state = CycleState::start(operators, self.model.interface.slave);
        integrator.apply_load(&mut state).expect("it can be loaded");
        integrator.initial_quarter(&mut state).expect("it slides");
        (integrator, state)
    }
}

/// Doses of one cycle on the shapes of a state, with a position at the end of each increment.
fn doses_of_increments(integrator: &mut Integrator<'_>, state: &CycleState) -> Sides<Vec<f64>> {
    let steps = integrator.steps(integrator.scene.motion, state);
    let mut from = state.contact.slider_x;
    let mut positions = Vec::new();
    for step in &steps {
        let path = (step.slider_x - from).abs();
        let at = crate::contact::PassPosition {
            slider_x: step.slider_x,
            direction: (step.slider_x - from).signum(),
            reference_height: state.contact.reference_height.unwrap_or_default(),
        };
        positions.push(CyclePosition { at, path });
        from = step.slider_x;
    }
    integrator.update_surfaces(state, 1.0);
    let starts = integrator
        .starts(state, &positions)
        .expect("they are solved");
    let bodies = Bodies::of(
        &integrator.pair,
        &integrator.slope,
        &state.depth,
        state.contact.indentation,
    );
    let contacts = &mut integrator.implicit.contacts;
    let doses = contacts.doses_on(bodies, &positions, &state.depth, &starts);
    doses.expect("they are solved")
}

fn is_close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * b.abs()
}

#[test]
fn a_cycle_on_fixed_shapes_is_a_computed_one_that_wears_little() {
    let mut scene = scene();
    // So little that no increment changes the pressure of the next.
    let rate = 1e-16;
    let law = Some(WearLaw::Archard {
        k_over_h_per_mpa: rate,
    });
    (scene.slider.wear, scene.receptacle.wear) = (law, law);
    (scene.slider.plating, scene.receptacle.plating) = (Vec::new(), Vec::new());
    scene.accuracy.cycle_jump = Some(1);
    let bench = Bench::new(scene);
    let (mut integrator, mut state) = bench.begin();
    let doses = doses_of_increments(&mut integrator, &state);
    let computed = integrator.compute_cycle(&mut state, 1, true);
    computed.expect("the cycle is computed");
    let work = bench.scene.load_n_per_mm * 4.0 * 0.02;
    for side in Side::BOTH {
        let widths = &bench.condensed.operators.of(side).widths;
        let most = doses.of(side).iter().fold(0.0, |m: f64, dose| m.max(*dose));
        let (mut area, mut sum) = (0.0, 0.0);
        for ((dose, depth), width) in doses.of(side).iter().zip(state.depth.of(side)).zip(widths) {
            assert!(
                (dose - depth / rate).abs() < 1e-6 * most,
                "{side:?}: {dose} {depth}"
            );
            area += width * depth / rate;
            sum += width * dose;
        }
        assert!(is_close(sum, work, 1e-12), "{side:?}: {sum} {work}");
        assert!(is_close(area, work, 1e-6), "{side:?}: {area} {work}");
    }
}

/// Contacts of a state at the positions of its next cycle.
fn settled(integrator: &mut Integrator<'_>, state: &CycleState) -> Contacts {
    integrator.update_surfaces(state, 1.0);
    let positions = integrator.cycle_positions(state);
    let starts = integrator
        .starts(state, &positions)
        .expect("they are solved");
    let bodies = Bodies::of(
        &integrator.pair,
        &integrator.slope,
        &state.depth,
        state.contact.indentation,
    );
    let mut contacts = Contacts::default();
    let placed = contacts.place(bodies, positions, &state.depth, &starts);
    placed.expect("they are placed");
    contacts
        .settle(bodies, &state.depth)
        .expect("they are solved");
    contacts
}

/// The bodies of a state.
fn bodies<'a>(integrator: &'a Integrator<'_>, state: &'a CycleState) -> Bodies<'a> {
    Bodies::of(
        &integrator.pair,
        &integrator.slope,
        &state.depth,
        state.contact.indentation,
    )
}

/// Unknown doses where both sides wear.
fn unknowns_of_both(contacts: &Contacts, bodies: Bodies<'_>) -> DoseUnknowns {
    let mut unknowns = DoseUnknowns::default();
    let both = Sides {
        slider: true,
        receptacle: true,
    };
    contacts.unknowns(bodies, both, &mut unknowns);
    unknowns
}

#[test]
fn the_change_of_doses_with_depths_is_that_of_differences() {
    let bench = Bench::new(scene());
    let (mut integrator, state) = bench.begin();
    let mut contacts = settled(&mut integrator, &state);
    let bodies = bodies(&integrator, &state);
    let unknowns = unknowns_of_both(&contacts, bodies);
    let mut matrix = BorderedBand::default();
    matrix.reset(0, 0, unknowns.nodes.len());
    contacts.add_sensitivity(bodies, &unknowns, 1.0, &mut matrix);
    let before = contacts.doses(bodies);
    let change = 1e-3 * contacts.indentation();
    for (number, (side, node)) in unknowns.nodes.iter().enumerate().step_by(3) {
        let mut depth = state.depth.clone();
        depth.of_mut(*side)[*node] += change;
        contacts.solve(bodies, &depth).expect("they are solved");
        let after = contacts.doses(bodies);
        let column = matrix.dense().column(number);
        let largest = column.iter().fold(0.0, |m: f64, entry| m.max(entry.abs()));
        for (entry, (side, node)) in column.iter().zip(&unknowns.nodes) {
            let found = (after.of(*side)[*node] - before.of(*side)[*node]) / change;
            assert!((entry - found).abs() < 1e-7 * largest, "{entry} {found}");
        }
    }
}

/// Numbered along the receptacle, the doses form a band and a border.
#[test]
fn a_banded_system_of_doses_has_the_solution_of_the_dense_one() {
    let bench = Bench::new(scene());
    let (mut integrator, state) = bench.begin();
    let mut contacts = settled(&mut integrator, &state);
    let bodies = bodies(&integrator, &state);
    let mut unknowns = unknowns_of_both(&contacts, bodies);
    unknowns.number_first(Side::Receptacle);
    let (order, core) = (unknowns.nodes.len(), unknowns.count(Side::Receptacle));
    let reach = contacts.reach(bodies, Side::Receptacle);
    assert!(reach < core, "{reach} {core}");
    let mut solve = |core: usize| {
        let mut system = BorderedBand::default();
        system.reset(core, reach, order - core);
        // A thousand cycles at a rate of 1e-9/MPa.
        contacts.add_sensitivity(bodies, &unknowns, -1e-6, &mut system);
        let mut solution: Vec<f64> = (0..order).map(|i| real(i % 7)).collect();
        for number in 0..order {
            system.column_mut(number).add(number, 1.0);
        }
        system.solve(&mut solution);
        solution
    };
    let (dense, banded) = (solve(0), solve(core));
    for (dense, banded) in dense.iter().zip(&banded) {
        assert!((dense - banded).abs() < 1e-9, "{dense} {banded}");
    }
}

#[test]
fn a_jump_ends_where_its_doses_are_those_of_its_last_shapes() {
    let bench = Bench::new(scene());
    let (mut integrator, state) = bench.begin();
    let laws = DoseLaws::of(&integrator.wear).expect("both wear by dose");
    let mut contacts = settled(&mut integrator, &state);
    let bodies = bodies(&integrator, &state);
    // Through the gold in the middle of the tip.
    let cycles = 4_000.0;
    let unworn = laws.doses(&state.depth);
    let of_cycle = contacts.doses(bodies);
    let formulas = Formulas::new(&JumpFrom {
        laws: &laws,
        dose: &unworn,
        of_cycle: &of_cycle,
        sizes: integrator
            .pair
            .operators
            .as_ref()
            .map(|body| &body.widths[..]),
        depth: &state.depth,
        cycles,
        last: None,
    });
    let jump = ImplicitJump {
        bodies,
        laws: &laws,
        formulas: &formulas,
        before: &state.depth,
    };
    let predictor = contacts
        .doses(bodies)
        .map(|nodes| nodes.iter().map(|dose| cycles * dose).collect::<Vec<f64>>());
    let end = jump.solve(&mut contacts, &mut JumpSystem::default(), predictor);
    let end = end.expect("it converges");
    let deepest = end.depth.largest_of_each();
    assert!(deepest.slider > 1e-4, "{deepest:?}");
    assert!(
        end.depth
            .slider
            .iter()
            .any(|depth| *depth > 0.0 && *depth < 1e-4)
    );
    contacts
        .settle(bodies, &end.depth)
        .expect("they are solved");
    let of_cycle = contacts.doses(bodies);
    for side in Side::BOTH {
        let most = end
            .dose
            .of(side)
            .iter()
            .fold(0.0, |m: f64, dose| m.max(*dose));
        let nodes = end.dose.of(side).iter().zip(of_cycle.of(side));
        for ((dose, of_cycle), depth) in nodes.zip(end.depth.of(side)) {
            assert!(
                (dose - cycles * of_cycle).abs() < 1e-7 * most,
                "{dose} {of_cycle}"
            );
            assert!((laws.depth(side, *dose) - depth).abs() < 1e-12);
        }
    }
}
