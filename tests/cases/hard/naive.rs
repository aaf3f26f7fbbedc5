//! The naive variant: forward Euler, wear applied after each increment from the pressure at its end.

use solver::condensation::condense;
use solver::contact::{ContactError, ContactState, Displacement, Pair, Solver, Surfaces, slopes};
use solver::law::surface::SurfaceWear;
use solver::record::{Position, TractionField};
use solver::scene::Scene;
use solver::sides::{Side, Sides};

/// Pressures at the end of some explicit cycles of a scene, each standing for `jump` physical ones.
pub(crate) fn explicit_wear(
    scene: &Scene,
    cycles: usize,
    jump: f64,
    steps_per_quarter: u32,
) -> Result<TractionField, ContactError> {
    let model = solver::model::build(scene, &solver::effects::plan(scene))
        .expect("the scene can be meshed");
    let operators = condense(&model, 1).expect("it can be condensed").operators;
    let pair = Pair {
        operators: &operators,
        interface: model.interface,
    };
    let wear = jump
        * model
            .interface
            .wear
            .receptacle
            .and_then(SurfaceWear::uniform)
            .expect("the receptacle wears by Archard's law");
    let mut solver = Solver::default();
    let mut depth = vec![0.0; operators.receptacle.x.len()];
    let slider_depth = vec![0.0; operators.slider.x.len()];
    let slider_slope = slopes(&operators.slider, &slider_depth, Side::Slider);
    let (mut last, mut next) = (
        ContactState::untouched(&operators, Side::Receptacle),
        ContactState::untouched(&operators, Side::Receptacle),
    );
    let quarter: Vec<f64> = (0..=steps_per_quarter)
        .map(|i| f64::from(i) / f64::from(steps_per_quarter) * scene.motion.amplitude_mm())
        .collect();
    let there_and_back = || {
        let right = quarter.iter().copied();
        let back = quarter.iter().rev().copied();
        right
            .chain(back.clone())
            .chain(quarter.iter().map(|x| -x))
            .chain(back.map(|x| -x))
    };
    for _ in 0..cycles {
        let slope = slopes(&operators.receptacle, &depth, Side::Receptacle);
        for slider_x in there_and_back() {
            let surfaces = Surfaces {
                depth: Sides {
                    slider: &slider_depth,
                    receptacle: &depth,
                },
                slope: Sides {
                    slider: &slider_slope,
                    receptacle: &slope,
                },
                friction: Sides::default(),
            };
            // No cycles: the solve itself is without wear.
            let to = Displacement {
                slider_x,
                surface_slip: 0.0,
                along: 0.0,
                height: None,
                repeated: false,
                cycles: 0.0,
                lemke: true,
                start: None,
            };
            let done = solver.advance(&pair, &surfaces, &last, to, &mut next)?;
            for (depth, path) in depth[done.first.receptacle..].iter_mut().zip(done.path) {
                *depth += wear * path;
            }
            std::mem::swap(&mut last, &mut next);
        }
    }
    Ok(TractionField {
        position: Position::Neutral,
        slider_x_mm: last.slider_x,
        x_mm: operators.receptacle.x.clone(),
        pressure_mpa: last.pressure,
        shear_mpa: last.shear,
    })
}
