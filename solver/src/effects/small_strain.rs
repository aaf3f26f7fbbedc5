//! Error of small-strain elasticity.

use crate::closed_form::unworn_contact;
use crate::law::elastic::contact_modulus;
use crate::scene::{Dimension, Scene};

/// Largest accepted error of small-strain elasticity, relative to peak pressure and half-width.
const LIMIT: f64 = 0.01;
/// The same of a point contact: its pressure falls far faster as it wears, and the depth of its cap or groove follows from the volume alone.
/// The ball of a memory card's spring (R = 0.4 mm, 0.5 N on copper) has 1.03 %. Arbitrary.
const LIMIT_OF_POINT: f64 = 0.02;

/// Largest accepted error in a scene.
pub fn limit(scene: &Scene) -> f64 {
    match scene.dimension {
        Dimension::PlaneStrain | Dimension::Line(_) | Dimension::Extruded(_) => LIMIT,
        Dimension::Point(_) => LIMIT_OF_POINT,
    }
}

/// Relative error of small-strain elasticity in peak pressure and half-width of the unworn contact:
///   1/2 (p0/E*) (1 + 0.16 mu^2),  p0 = E* a/(2 R).
/// Measured, not derived: the surface of a block under Hertz' pressure and sliding friction with and without geometric
/// non-linearity (CalculiX 2.20, p0/E* from 0.3 to 3 %, mu from 0 to 1.21) changes its curvature by twice this, and
/// the peak goes with the square root of the curvature; two bodies in contact without friction changed their peak by
/// 0.17 % at p0/E* = 0.3 % and by 0.55 % at 1 %. Wear only ever widens the contact and lowers this.
pub fn cost(scene: &Scene) -> f64 {
    let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
    let strain = unworn_contact::hertz_peak_pressure(scene) / modulus;
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
