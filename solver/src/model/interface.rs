//! The interface: laws and load between the bodies.

use crate::effects::EffectsPlan;
use crate::law::elastic::{contact_modulus, plane_strain_compliance};
use crate::law::surface::SurfaceWear;
use crate::resolution::Sizes;
use crate::scene::{Effect, Scene};
use crate::sides::{Side, Sides};

/// How the shear traction and the slip of a contact are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tangential {
    /// Every node slips as the slider is displaced, and the contact is solved without shear: |q| = mu p, known afterwards,
    /// deforms nothing.
    Omitted,
    /// Every node slips as the slider is displaced, and q = mu p acts on both bodies.
    ImposedSlip,
    /// Each node sticks or slips, and the tangential deformation of both bodies is part of the slip.
    StickSlip,
}

impl Tangential {
    /// The form that a plan's simulated effects need.
    pub(crate) fn of(plan: &EffectsPlan) -> Self {
        let on = |effect| plan.simulates(effect);
        match (on(Effect::Friction), on(Effect::StickMemory)) {
            (true, true) => Self::StickSlip,
            (true, false) => Self::ImposedSlip,
            (false, _) => Self::Omitted,
        }
    }
}

/// Laws and load between the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interface {
    /// Coefficient of friction, -; the largest where places differ in it. That of the unworn contact until a run changes it.
    pub friction: f64,
    /// How the shear traction and the slip are found.
    pub tangential: Tangential,
    /// The body whose nodes carry the contact constraints, pressure and shear.
    pub slave: Side,
    /// True if part of the contact may stick through the whole stroke.
    pub sticks: bool,
    /// Weights of both surfaces' slopes in that of the interface, which the contact's normals belong to, -.
    pub slope_weights: Sides<f64>,
    /// Wear of both surfaces; none where nothing wears.
    pub wear: Sides<Option<SurfaceWear>>,
    /// Normal load on the unworn contact, N/mm.
    pub load: f64,
    /// Stiffness of the spring that applies the load: the load decreases by this as the slider sinks, N/mm per mm.
    pub spring: f64,
    /// Contact modulus E* of both bodies, MPa.
    pub modulus: f64,
    /// Heat sources of the contact that are simulated.
    pub heated_by: HeatSources,
}

/// Heat sources of the contact that are simulated.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct HeatSources {
    /// Friction.
    pub friction: bool,
    /// The current.
    pub current: bool,
}

impl Interface {
    /// The interface of a scene with the laws of simulated effects only.
    pub(super) fn of(scene: &Scene, plan: &EffectsPlan, sizes: &Sizes) -> Self {
        let surface = plan.surface_effects();
        let on = |effect| plan.simulates(effect);
        let tangential = Tangential::of(plan);
        let sticks = sizes.sticks && tangential == Tangential::StickSlip;
        Self {
            slave: sizes.slave,
            sticks,
            slope_weights: slope_weights(scene, sticks),
            friction: scene.friction.unworn(),
            tangential,
            wear: Sides {
                slider: (scene.slider.surface_wear(surface, None))
                    .filter(|_| on(Effect::SliderWear)),
                receptacle: (scene.receptacle.surface_wear(surface, None))
                    .filter(|_| on(Effect::ReceptacleWear)),
            },
            load: scene.load_n_per_mm,
            spring: if on(Effect::SpringFading) {
                scene.spring_n_per_mm2
            } else {
                0.0
            },
            modulus: contact_modulus(scene.slider.elastic, scene.receptacle.elastic),
            heated_by: HeatSources {
                friction: on(Effect::FrictionalHeating),
                current: on(Effect::JouleHeating),
            },
        }
    }
}

/// Weights of both surfaces' slopes in that of the interface. Two elastic bodies press the surfaces together, the more
/// compliant one deforms more: in the middle of Hertz' contact the interface has the curvature of each body in proportion to
/// the stiffness E/(1 - nu^2) of that body (Johnson 1985, section 4.2). So the answer does not depend on which of the bodies is
/// called the slider. In gross sliding the slider rests on the leading-edge step, whose slope belongs to the wear law and not to
/// the scar: only the receptacle's count.
pub(super) fn slope_weights(scene: &Scene, sticks: bool) -> Sides<f64> {
    if !sticks {
        return Sides {
            slider: 0.0,
            receptacle: 1.0,
        };
    }
    let bodies = Sides {
        slider: scene.slider.elastic,
        receptacle: scene.receptacle.elastic,
    };
    let both = contact_modulus(bodies.slider, bodies.receptacle);
    bodies.map(|body| 1.0 - both * plane_strain_compliance(body))
}
