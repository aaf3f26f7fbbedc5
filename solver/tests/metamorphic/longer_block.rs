//! A block whose ends are farther away.
//!
//! The bottom of the block is held, so what the contact does to it decays along its length as in a clamped layer, by exp(-2)
//! and more per height (Saint-Venant). With six heights between contact and end, and with nine, the answers differ by the
//! meshes of the ends only. Flat blocks: a longer crowned one has another shape. Allowed: half the tolerance of one run; as
//! much for the peak pressure.

use solver::SolveError;
use solver::scene::Scene;

use super::comparison::{Allowed, Deviation, compare};
use super::{ALL, TOLERANCE, holds};
use crate::verification::random_scenes::Drawn;
use crate::verification::recorder::solve;

fn longer(scene: &Scene, heights: f64) -> Scene {
    let mut scene = scene.clone();
    let block = &mut scene.receptacle.shape;
    block.length_mm += 2.0 * heights * block.height_mm;
    scene
}

fn the_same_on_a_longer_block(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    if drawn.scene.receptacle.shape.crown_radius_mm.is_some() {
        return Ok(None);
    }
    let [near, far] = [6.0, 9.0].map(|heights| longer(&drawn.scene, heights));
    let (near, far) = (solve(&near)?.0, solve(&far)?.0);
    let allowed = Allowed {
        peak: 0.5 * TOLERANCE,
        ..Allowed::within(0.5 * TOLERANCE)
    };
    Ok(Some(compare(&near, &far, allowed)))
}

#[test]
fn a_longer_block_changes_nothing() {
    holds("longer block", &ALL, the_same_on_a_longer_block);
}
