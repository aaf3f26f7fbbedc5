//! Error of small-strain elasticity.

use crate::model::resolution;
use crate::scene::Scene;

/// Largest accepted error of small-strain elasticity, relative to peak pressure and half-width.
pub const LIMIT: f64 = 0.01;

/// Relative error of small-strain elasticity in peak pressure and half-width of the unworn contact:
///   1/2 (p0/E*) (1 + 0.16 mu^2),  p0 = E* a/(2 R).
/// Measured, not derived: the surface of a block under Hertz' pressure and sliding friction with and without geometric
/// non-linearity (CalculiX 2.20, p0/E* from 0.3 to 3 %, mu from 0 to 1.21) changes its curvature by twice this, and
/// the peak goes with the square root of the curvature; two bodies in contact without friction changed their peak by
/// 0.17 % at p0/E* = 0.3 % and by 0.55 % at 1 %. Wear only ever widens the contact and lowers this.
pub fn cost(scene: &Scene) -> f64 {
    let strain = 0.5 * resolution::choose(scene).hertz_half_width / resolution::radius(scene);
    let friction = scene.largest_friction();
    0.5 * strain * (1.0 + 0.16 * friction * friction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;

    /// The fuzz button: p0/E* = a/(2 R) = 0.51 um / 50.8 um = 1 % and mu = 1.21.
    #[test]
    fn small_strains_cost_half_the_strain_and_something_for_friction() {
        let mut scene = fuzz_button();
        assert!((cost(&scene) - 0.0062).abs() < 2e-4);
        scene.load_n_per_mm *= 4.0;
        assert!((cost(&scene) - 0.0124).abs() < 4e-4);
    }
}
