//! Drawn scenes with a plating on every side that wears.
//!
//! Two layers of three tenths of the depth that the bare body wears, so that both are worn through and the base is worn as
//! well. The rates are those of the bare body times 0.6, 3 and 1.2, which wears about as deep; a hard layer lies on a soft one
//! and the other way round.

use solver::SolveError;
use solver::scene::{Body, Layer, WearLaw};

use crate::verification::random_scenes::Drawn;
use crate::verification::recorder::solve;

/// Thickness of each layer over the depth of the bare body's wear.
const THICKNESS: f64 = 0.3;
/// Rates of both layers and of the base over that of the bare body.
const RATES: [f64; 3] = [0.6, 3.0, 1.2];

/// The scene with platings.
pub(super) fn plated(drawn: &Drawn) -> Result<Drawn, SolveError> {
    let last = solve(&drawn.scene)?.0.last;
    let mut plated = drawn.clone();
    plate(&mut plated.scene.slider, last.slider.max_depth_mm);
    plate(&mut plated.scene.receptacle, last.receptacle.max_depth_mm);
    Ok(plated)
}

fn plate<S>(body: &mut Body<S>, depth_mm: f64) {
    let Some(rate) = body.wear.and_then(WearLaw::uniform) else {
        return;
    };
    let layer = |factor| Layer {
        thickness_mm: THICKNESS * depth_mm,
        rate_per_mpa: factor * rate,
    };
    body.plating = vec![layer(RATES[0]), layer(RATES[1])];
    body.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: RATES[2] * rate,
    });
}
