//! Symmetry: mirrored motion gives mirrored tractions, and exchanging the roles of two bodies gives the same scars.
//!
//! ```text
//!   ( R1 )  <->            turned upside down:      ( R2 )  <->
//!   .-----.                                         .-----.
//!  /  R2   \   block, crowned                      /  R1   \
//! ```

use crate::verification::recorder::solve;
use crate::verification::scenes::mccoll;
use solver::condensation::condense;
use solver::contact::{ContactState, Displacement, Pair, Solver, Surfaces, slopes};
use solver::scene::{BlockShape, Friction, Scene, SliderShape};
use solver::sides::{Side, Sides};

/// The same displacements to the other side give the mirrored pressure and the mirrored, opposite shear: stick, partial slip,
/// reversal and gross slip.
#[test]
fn mirrored_motion_gives_mirrored_tractions() {
    let model = solver::model::build(&mccoll(), &solver::effects::plan(&mccoll()))
        .expect("the scene can be meshed");
    let condensed = condense(&model, 1).expect("the scene can be condensed");
    let operators = &condensed.operators;
    let pair = Pair {
        operators,
        interface: model.interface,
    };
    let zero = [
        vec![0.0; operators.receptacle.x.len()],
        vec![0.0; operators.slider.x.len()],
    ];
    let slider_slope = slopes(&operators.slider, &zero[1], Side::Slider);
    let surfaces = Surfaces {
        depth: Sides {
            slider: &zero[1],
            receptacle: &zero[0],
        },
        slope: Sides {
            slider: &slider_slope,
            receptacle: &zero[0],
        },
        friction: Sides::default(),
    };
    let run = |side: f64| {
        let mut solver = Solver::default();
        let mut states = vec![ContactState::untouched(operators, model.interface.slave)];
        for place in [0.0, 5e-4, 1e-3, 6e-4, -2e-3, -0.02, 0.01, 0.013] {
            let mut next = states[states.len() - 1].clone();
            let to = Displacement {
                slider_x: side * place,
                surface_slip: 0.0,
                along: 0.0,
                height: None,
                repeated: false,
                cycles: 0.0,
                lemke: true,
                start: None,
            };
            solver
                .advance(&pair, &surfaces, &states[states.len() - 1], to, &mut next)
                .expect("every position is in equilibrium");
            states.push(next);
        }
        states.remove(0);
        states
    };
    let mut worst = 0.0_f64;
    for (right, left) in run(1.0).iter().zip(&run(-1.0)) {
        let peak = right.peak_pressure();
        for (p, q) in right.pressure.iter().zip(left.pressure.iter().rev()) {
            worst = worst.max((p - q).abs() / peak);
        }
        for (q, r) in right.shear.iter().zip(left.shear.iter().rev()) {
            worst = worst.max((q + r).abs() / peak);
        }
    }
    println!("mirrored motion: tractions differ by {worst:.1e} of the peak");
    // Sums run in another order; the compliance's condition (1e4) times round-off is the bound.
    assert!(worst < 1e-9, "{worst}");
}

fn pair(upper: f64, lower: f64) -> Scene {
    let mut scene = Scene {
        cycles: 2_000,
        friction: Friction::Coulomb { coefficient: 0.6 },
        ..mccoll()
    };
    scene.slider.shape = SliderShape {
        radius_mm: upper,
        half_width_mm: 3.0,
        height_mm: 4.0,
    };
    scene.receptacle.shape = BlockShape {
        length_mm: 6.0,
        height_mm: 4.0,
        crown_radius_mm: Some(lower),
    };
    scene
}

/// Both bodies have the same outline upside down, so only the roles change: which surface carries the multipliers
/// and which one is meshed for the motion. Depths and widths must agree within the tolerance of both runs.
#[test]
fn swapped_bodies_wear_to_the_same_scars() {
    let here = pair(6.0, 9.0);
    let mut there = pair(9.0, 6.0);
    (there.slider.wear, there.receptacle.wear) = (here.receptacle.wear, here.slider.wear);
    let run = |scene: &Scene| solve(scene).expect("the scene can be solved").0;
    let (here, there) = (run(&here), run(&there));
    let ratio = |a: f64, b: f64| (a / b - 1.0).abs();
    let peak = ratio(
        here.initial.peak_pressure_mpa,
        there.initial.peak_pressure_mpa,
    );
    let (upper, lower) = (
        ratio(
            here.last.slider.max_depth_mm,
            there.last.receptacle.max_depth_mm,
        ),
        ratio(
            here.last.receptacle.max_depth_mm,
            there.last.slider.max_depth_mm,
        ),
    );
    let area = ratio(
        here.last.receptacle.worn_area_mm2,
        there.last.slider.worn_area_mm2,
    );
    println!(
        "swapped bodies: peak {peak:.1e}, depths {upper:.1e} and {lower:.1e}, area {area:.1e}"
    );
    assert!(peak < 0.01 && upper < 0.02 && lower < 0.02 && area < 0.005);
}
