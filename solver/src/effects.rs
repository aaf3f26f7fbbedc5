//! Effects plan: only the effects that a scene calls for are simulated.

use crate::law::elastic::contact_modulus;
use crate::law::friction;
use crate::model::resolution;
use crate::scene::{Friction, Scene};

/// Decisions about all effects.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectsPlan {
    /// One decision per effect, always in the same order.
    pub decisions: Vec<Decision>,
}

impl EffectsPlan {
    /// Whether an effect is simulated.
    pub fn simulates(&self, effect: Effect) -> bool {
        let mut decisions = self.decisions.iter();
        decisions.any(|decision| decision.effect == effect && decision.simulated)
    }
}

/// Decision about one effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Decision {
    /// The effect.
    pub effect: Effect,
    /// Whether it is simulated.
    pub simulated: bool,
    /// Reason, with the numbers that decided.
    pub reason: String,
}

/// Effects that can be simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// Elastic deformation of both bodies.
    Elasticity,
    /// Shear traction at the contact.
    Friction,
    /// Wear of the receptacle.
    ReceptacleWear,
    /// Wear of the slider.
    SliderWear,
    /// Moving mesh and rebuilt stiffness.
    Relocation,
    /// Finite strains and rotations of the bodies; never simulated: a scene that calls for it is refused.
    GeometricNonlinearity,
}

/// Largest accepted error of small-strain elasticity, relative to peak pressure and half-width.
pub const SMALL_STRAIN_LIMIT: f64 = 0.01;

impl Effect {
    /// Stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Elasticity => "elasticity",
            Self::Friction => "friction",
            Self::ReceptacleWear => "receptacle_wear",
            Self::SliderWear => "slider_wear",
            Self::Relocation => "relocation",
            Self::GeometricNonlinearity => "geometric_nonlinearity",
        }
    }
}

/// Decides which effects a scene calls for. Where relocation is planned, each computed cycle checks whether the
/// geometry has drifted enough for it.
pub fn plan(scene: &Scene) -> EffectsPlan {
    let sizes = resolution::choose(scene);
    let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
    let elasticity = Decision {
        effect: Effect::Elasticity,
        simulated: true,
        reason: format!(
            "contact modulus {modulus:.0} MPa, unworn Hertz half-width {:.3e} mm",
            sizes.hertz_half_width
        ),
    };
    let friction = match scene.friction {
        Friction::Coulomb { coefficient } if coefficient > 0.0 => {
            (true, format!("Coulomb friction {coefficient}"))
        }
        _ => (
            false,
            "no friction in the scene: the shear unknowns are left out".to_owned(),
        ),
    };
    let rates = resolution::wear_rates(scene, sizes.hertz_half_width);
    let wear = |effect, k: f64, side: &str| {
        let (simulated, reason) = if k <= 0.0 {
            (false, format!("the {side} has no wear law"))
        } else if scene.motion.distance_per_cycle_mm() <= 0.0 {
            (false, "nothing slides: the amplitude is 0".to_owned())
        } else {
            (true, format!("Archard, k/H = {k:.4e} per MPa"))
        };
        Decision {
            effect,
            simulated,
            reason,
        }
    };
    let receptacle = wear(Effect::ReceptacleWear, rates.receptacle, "receptacle");
    let slider = wear(Effect::SliderWear, rates.slider, "slider");
    let wears = receptacle.simulated || slider.simulated;
    let relocation = Decision {
        effect: Effect::Relocation,
        simulated: wears,
        reason: if wears {
            "the mesh follows the worn surface once it has drifted".to_owned()
        } else {
            "nothing wears, so nothing moves the mesh".to_owned()
        },
    };
    let friction = Decision {
        effect: Effect::Friction,
        simulated: friction.0,
        reason: friction.1,
    };
    let cost = small_strain_cost(scene);
    let finite = Decision {
        effect: Effect::GeometricNonlinearity,
        simulated: false,
        reason: format!(
            "strains and rotations are taken as small, which costs {:.2} % of the peak pressure (limit {:.0} %)",
            100.0 * cost,
            100.0 * SMALL_STRAIN_LIMIT
        ),
    };
    EffectsPlan {
        decisions: vec![elasticity, friction, receptacle, slider, relocation, finite],
    }
}

/// Relative error of small-strain elasticity in peak pressure and half-width of the unworn contact:
///   1/2 (p0/E*) (1 + 0.16 mu^2),  p0 = E* a/(2 R).
/// Measured, not derived: the surface of a block under Hertz' pressure and sliding friction with and without geometric
/// non-linearity (CalculiX 2.20, p0/E* from 0.3 to 3 %, mu from 0 to 1.21) changes its curvature by twice this, and
/// the peak goes with the square root of the curvature; two bodies in contact without friction changed their peak by
/// 0.17 % at p0/E* = 0.3 % and by 0.55 % at 1 %. Wear only ever widens the contact and lowers this.
pub fn small_strain_cost(scene: &Scene) -> f64 {
    let strain = 0.5 * resolution::choose(scene).hertz_half_width / resolution::radius(scene);
    let friction = friction::coefficient(scene.friction);
    0.5 * strain * (1.0 + 0.16 * friction * friction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::scene::Motion;

    fn simulated(scene: &Scene) -> Vec<&'static str> {
        let plan = plan(scene);
        plan.decisions
            .iter()
            .filter(|d| d.simulated)
            .map(|d| d.effect.name())
            .collect()
    }

    #[test]
    fn only_what_the_scene_calls_for_is_simulated() {
        let mut scene = fuzz_button();
        assert_eq!(
            simulated(&scene),
            ["elasticity", "friction", "receptacle_wear", "relocation"]
        );
        scene.friction = Friction::Frictionless;
        scene.receptacle.wear = None;
        assert_eq!(simulated(&scene), ["elasticity"]);
    }

    /// The fuzz button: p0/E* = a/(2 R) = 0.51 um / 50.8 um = 1 % and mu = 1.21.
    #[test]
    fn small_strains_cost_half_the_strain_and_something_for_friction() {
        let mut scene = fuzz_button();
        assert!((small_strain_cost(&scene) - 0.0062).abs() < 2e-4);
        scene.load_n_per_mm *= 4.0;
        assert!((small_strain_cost(&scene) - 0.0124).abs() < 4e-4);
    }

    #[test]
    fn nothing_wears_where_nothing_slides() {
        let mut scene = fuzz_button();
        scene.motion = Motion::Reciprocating {
            amplitude_mm: 0.0,
            period_s: 1.0,
        };
        assert_eq!(simulated(&scene), ["elasticity", "friction"]);
    }
}
