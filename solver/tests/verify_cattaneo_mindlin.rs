//! Partial slip of a cylinder on a flat (Cattaneo 1938, Mindlin 1949; Johnson 1985, sections 7.2 and 7.3).
//!
//! ```text
//!        |P = 120 N/mm       R = 6 mm, E = 200 GPa, nu = 0.3, mu = 0.6
//!      .-v-. -> Q            a = 0.091336 mm, p0 = 836.41 MPa
//!     (     )                loading to Q = mu P / 2:    c/a = sqrt(1 - Q/(mu P)) = 0.70711
//!   ___`-.-'___              unloading back to Q = 0:   c'/a = sqrt(1 - Q/(2 mu P)) = 0.86603
//! ```
//! On unloading, slip in the new direction has come in from the edge to c' although Q is zero: the tangential
//! history matters.

use crate::scenes::mccoll;
use solver::condensation::{Condensed, condense};
use solver::contact::{ContactState, Move, Pair, Solver, Status, Surfaces};
use solver::model::{Interface, Model};
use solver::scene::Friction;

const LOAD: f64 = 120.0;
const FRICTION: f64 = 0.6;
const HALF_WIDTH: f64 = 0.091_336;
/// Contact elements across the half-width.
const ELEMENTS: f64 = 50.0;

struct Bench {
    model: Model,
    condensed: Condensed,
    zero: [Vec<f64>; 2],
    solver: Solver,
}

impl Bench {
    fn new(elements: f64) -> Self {
        let mut scene = mccoll();
        scene.load_n_per_mm = LOAD;
        scene.friction = Friction::Coulomb {
            coefficient: FRICTION,
        };
        scene.slider.wear = None;
        scene.receptacle.wear = None;
        scene.accuracy.tolerance = 0.003;
        scene.accuracy.contact_element_mm = Some(HALF_WIDTH / elements);
        let model = solver::model::build(&scene).expect("the scene can be meshed");
        let condensed = condense(&model, None).expect("the scene can be condensed");
        let operators = &condensed.operators;
        let zero = [
            vec![0.0; operators.receptacle.x.len()],
            vec![0.0; operators.slider.x.len()],
        ];
        Self {
            model,
            condensed,
            zero,
            solver: Solver::default(),
        }
    }

    fn advance(&mut self, last: &ContactState, slider_x: f64) -> ContactState {
        let interface: Interface = self.model.interface;
        let pair = Pair {
            operators: &self.condensed.operators,
            interface,
        };
        let surfaces = Surfaces {
            receptacle_depth: &self.zero[0],
            slider_depth: &self.zero[1],
            slope: &self.zero[0],
        };
        let mut next = last.clone();
        let place = Move {
            slider_x,
            run: 0.0,
            cycles: 0.0,
        };
        self.solver
            .advance(&pair, &surfaces, last, place, &mut next)
            .expect("partial slip is in equilibrium");
        next
    }

    /// Moves in small steps until the tangential force has reached `target`, and ends on it.
    fn drive(&mut self, from: &ContactState, target: f64, step: f64) -> ContactState {
        let mut last = from.clone();
        loop {
            let next = self.advance(&last, last.slider_x + step);
            let (before, after) = (last.tangential_force(), next.tangential_force());
            if (after - target) * step >= 0.0 {
                let part = (target - before) / (after - before);
                return self.advance(&last, last.slider_x + part * step);
            }
            last = next;
        }
    }

    /// Half-width of the sticking zone, mm: the width of the nodes that stick.
    fn stick_half_width(&self, state: &ContactState) -> f64 {
        let nodes = state
            .status
            .iter()
            .zip(&self.condensed.operators.receptacle.widths);
        let sticking = nodes.filter(|(status, _)| **status == Status::Stick);
        0.5 * sticking.map(|(_, width)| width).sum::<f64>()
    }
}

#[test]
fn stick_zones_of_loading_and_unloading_are_those_of_cattaneo_and_mindlin() {
    let mut bench = Bench::new(ELEMENTS);
    let settled = bench.advance(&ContactState::untouched(&bench.condensed.operators), 0.0);
    let half_width = settled.half_width(&bench.condensed.operators.receptacle.x);
    let peak = settled.peak_pressure();
    println!("a = {half_width:.6} mm (0.091336), p0 = {peak:.2} MPa (836.41)");
    assert!((half_width / HALF_WIDTH - 1.0).abs() < 0.005 && (peak / 836.41 - 1.0).abs() < 0.005);

    let loaded = bench.drive(&settled, 0.5 * FRICTION * LOAD, 2e-5);
    assert!((loaded.tangential_force() - 36.0).abs() < 0.05);
    let stick = bench.stick_half_width(&loaded) / half_width;
    println!("loading: c/a = {stick:.4} (0.7071)");

    let unloaded = bench.drive(&loaded, 0.0, -2e-5);
    assert!(unloaded.tangential_force().abs() < 0.05);
    let back = bench.stick_half_width(&unloaded) / half_width;
    println!("unloading: c'/a = {back:.4} (0.8660)");
    // One element either side of the zone, 1/50 of a.
    assert!((stick - 0.5_f64.sqrt()).abs() < 1.0 / ELEMENTS, "{stick}");
    assert!((back - 0.75_f64.sqrt()).abs() < 1.0 / ELEMENTS, "{back}");
}

#[test]
fn gross_slip_carries_mu_p_everywhere() {
    let mut bench = Bench::new(ELEMENTS);
    let settled = bench.advance(&ContactState::untouched(&bench.condensed.operators), 0.0);
    let slipping = bench.advance(&settled, 0.02);
    assert!((slipping.tangential_force() / (FRICTION * LOAD) - 1.0).abs() < 1e-12);
    for (p, q) in slipping.pressure.iter().zip(&slipping.shear) {
        assert!((q - FRICTION * p).abs() <= 1e-12 * 836.0);
    }
}
