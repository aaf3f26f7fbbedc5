//! Partial slip of a cylinder on a flat (Cattaneo 1938, Mindlin 1949; Johnson 1985, sections 7.2 and 7.3).
//!
//! ```text
//!        |P = 120 N/mm       R = 6 mm, E = 200 GPa, nu = 0.3, mu = 0.6
//!      .-v-. -> Q            a = 0.091336 mm, p0 = 836.41 MPa
//!     (     )                loading to Q = mu P / 2:    c/a = sqrt(1 - Q/(mu P)) = 0.70711
//!   ___`-.-'___              unloading back to Q = 0:   c'/a = sqrt(1 - Q/(2 mu P)) = 0.86603
//! ```
//! On unloading, reverse slip has spread from the edge to c' although Q is zero: the solution depends on the
//! tangential history.

use crate::verification::scenes::mccoll;
use solver::condensation::{BodyOperators, Condensed, condense};
use solver::contact::{ContactState, Displacement, Pair, Solver, Status, Surfaces, slopes};
use solver::fields;
use solver::model::{Interface, Model};
use solver::scene::Friction;
use solver::sides::{Side, Sides};

const LOAD: f64 = 120.0;
const FRICTION: f64 = 0.6;
const HALF_WIDTH: f64 = 0.091_336;
/// Contact elements across the half-width: those of a narrow contact and of one whose operators are compressed.
const ELEMENTS: [f64; 2] = [50.0, 300.0];

struct Bench {
    model: Model,
    condensed: Condensed,
    zero: [Vec<f64>; 2],
    slider_slope: Vec<f64>,
    solver: Solver,
}

impl Bench {
    fn new(elements: f64, slave: Side) -> Self {
        let mut scene = mccoll();
        scene.load_n_per_mm = LOAD;
        scene.friction = Friction::Coulomb {
            coefficient: FRICTION,
        };
        scene.slider.wear = None;
        scene.receptacle.wear = None;
        scene.accuracy.tolerance = 0.003;
        scene.accuracy.contact_element_mm = Some(HALF_WIDTH / elements);
        let mut model = solver::model::build(&scene, &solver::effects::plan(&scene))
            .expect("the scene can be meshed");
        model.interface.slave = slave;
        let condensed = condense(&model, 1).expect("the scene can be condensed");
        let operators = &condensed.operators;
        let zero = [
            vec![0.0; operators.receptacle.x.len()],
            vec![0.0; operators.slider.x.len()],
        ];
        let slider_slope = slopes(&condensed.operators.slider, &zero[1], Side::Slider);
        Self {
            model,
            condensed,
            zero,
            slider_slope,
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
            depth: Sides {
                slider: &self.zero[1],
                receptacle: &self.zero[0],
            },
            slope: Sides {
                slider: &self.slider_slope,
                receptacle: &self.zero[0],
            },
            friction: Sides::default(),
        };
        let mut next = last.clone();
        let place = Displacement {
            slider_x,
            surface_slip: 0.0,
            along: 0.0,
            height: None,
            repeated: false,
            cycles: 0.0,
            lemke: true,
            start: None,
        };
        self.solver
            .advance(&pair, &surfaces, last, place, &mut next)
            .expect("partial slip is in equilibrium");
        next
    }

    fn slave(&self) -> &BodyOperators {
        self.condensed.operators.of(self.model.interface.slave)
    }

    fn settled(&mut self) -> ContactState {
        let operators = &self.condensed.operators;
        let untouched = ContactState::untouched(operators, self.model.interface.slave);
        self.advance(&untouched, 0.0)
    }

    fn tangential_force(&self, contact: &ContactState) -> f64 {
        contact.tangential_force(&self.model.interface, &self.slave().widths)
    }

    /// Moves in small steps until the tangential force has reached `target`, and ends at it.
    fn drive(&mut self, from: &ContactState, target: f64, step: f64) -> ContactState {
        let mut last = from.clone();
        loop {
            let next = self.advance(&last, last.slider_x + step);
            let (before, after) = (self.tangential_force(&last), self.tangential_force(&next));
            if (after - target) * step >= 0.0 {
                let part = (target - before) / (after - before);
                return self.advance(&last, last.slider_x + part * step);
            }
            last = next;
        }
    }

    /// sigma_xx at the receptacle's surface nodes: places, mm, and MPa.
    fn surface_stress(&self, state: &ContactState) -> Vec<(f64, f64)> {
        let force: Vec<f64> = state.force.receptacle.iter().map(|f| -f).collect();
        let fields = fields::recover(
            &self.model,
            &self.condensed,
            Side::Receptacle,
            0,
            &force,
            0.0,
        )
        .expect("the factor is stored");
        let mesh = &self.model.bodies.receptacle.zones[0].mesh;
        let surface = (0..mesh.spines()).map(|i| mesh.surface_node(i));
        surface
            .map(|node| (fields.nodes[node][0], fields.stress[node].xx))
            .collect()
    }

    /// Half-width of the sticking zone, mm: the width of the nodes that stick.
    fn stick_half_width(&self, state: &ContactState) -> f64 {
        let nodes = state.status.iter().zip(&self.slave().widths);
        let sticking = nodes.filter(|(status, _)| **status == Status::Stick);
        0.5 * sticking.map(|(_, width)| width).sum::<f64>()
    }
}

#[test]
fn stick_zones_of_loading_and_unloading_are_those_of_cattaneo_and_mindlin() {
    for elements in ELEMENTS {
        for slave in Side::BOTH {
            assert_stick_zones(elements, slave);
        }
    }
}

fn assert_stick_zones(elements: f64, slave: Side) {
    let mut bench = Bench::new(elements, slave);
    let settled = bench.settled();
    let half_width = settled.half_width(&bench.slave().x);
    let peak = settled.peak_pressure();
    println!("a = {half_width:.6} mm (0.091336), p0 = {peak:.2} MPa (836.41)");
    assert!((half_width / HALF_WIDTH - 1.0).abs() < 0.005 && (peak / 836.41 - 1.0).abs() < 0.005);

    let loaded = bench.drive(&settled, 0.5 * FRICTION * LOAD, 2e-5);
    assert!((bench.tangential_force(&loaded) - 36.0).abs() < 0.05);
    let stick = bench.stick_half_width(&loaded) / half_width;
    println!("loading: c/a = {stick:.4} (0.7071)");

    let unloaded = bench.drive(&loaded, 0.0, -2e-5);
    assert!(bench.tangential_force(&unloaded).abs() < 0.05);
    let back = bench.stick_half_width(&unloaded) / half_width;
    println!("unloading: c'/a = {back:.4} (0.8660)");
    // One element either side of the zone.
    assert!((stick - 0.5_f64.sqrt()).abs() < 1.0 / elements, "{stick}");
    assert!((back - 0.75_f64.sqrt()).abs() < 1.0 / elements, "{back}");
}

/// Along the surface, with Q on the receptacle toward +x: sigma_xx = -p where it sticks, and in the trailing slip zone
/// -a < x < -c  sigma_xx = -p + 2 mu p0 (c/a) sqrt(x^2/c^2 - 1), which rises to 2 mu p0 sqrt(Q/(mu P)) = 709.7 MPa at
/// the edge: a kink with an infinite slope beyond, which a mesh of h cuts off by some 2 mu p0 sqrt(h/a)/2.
#[test]
fn surface_stress_in_the_slip_zone_follows_the_closed_solution() {
    let elements = 100.0;
    let mut bench = Bench::new(elements, Side::Receptacle);
    let settled = bench.settled();
    let loaded = bench.drive(&settled, 0.5 * FRICTION * LOAD, 1e-4);
    let (peak, edge) = (836.41, 709.7);
    let stick = 0.5_f64.sqrt() * HALF_WIDTH;
    let stress = bench.surface_stress(&loaded);
    let mut worst = 0.0_f64;
    for (x, found) in stress
        .iter()
        .filter(|(x, _)| (-0.96..-0.74).contains(&(x / HALF_WIDTH)))
    {
        let pressure = peak * (1.0 - (x / HALF_WIDTH).powi(2)).sqrt();
        let rise = ((x / stick).powi(2) - 1.0).sqrt();
        let expected = -pressure + 2.0 * FRICTION * peak * stick / HALF_WIDTH * rise;
        worst = worst.max((found - expected).abs() / edge);
    }
    let highest = stress.iter().fold(0.0, |m: f64, (_, s)| m.max(*s));
    println!(
        "slip zone: sigma_xx off by {worst:.3} of 709.7 MPa; at the edge {highest:.0} MPa with a/100"
    );
    // 1.5 % is the bending of the finite block, measured under the normal load alone; the rest is an edge that lies
    // 0.2 % of a further in (a = 0.09117 mm against 0.091336 mm), where the closed solution is steepest.
    assert!(worst < 0.07, "{worst}");
    // The kink: 2 mu p0 sqrt(h/a)/2 = 50 MPa for a node on it, twice that for one beside it.
    assert!(highest < edge && highest > edge - 100.0, "{highest}");
}
