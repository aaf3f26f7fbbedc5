//! Effects that a plan decides about.

use serde::{Deserialize, Serialize};

/// Declares the effects, and all of them in the order of a plan.
macro_rules! effects {
    ($($(#[doc = $doc:literal])+ $effect:ident,)+) => {
        /// Effects that a plan decides about.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Effect {
            $($(#[doc = $doc])+ $effect,)+
        }

        impl Effect {
            /// All effects, in the order of a plan.
            pub const ALL: &'static [Self] = &[$(Self::$effect),+];
        }
    };
}

effects! {
    /// Elastic deformation of both bodies.
    Elasticity,
    /// Action of the shear traction on the contact.
    Friction,
    /// Stick, slip and the tangential deformation in the slip.
    StickMemory,
    /// Wear of the receptacle.
    ReceptacleWear,
    /// Wear of the slider.
    SliderWear,
    /// Layers below the outermost one.
    Plating,
    /// Change of the hardness with the temperature of the contact.
    ThermalSoftening,
    /// Temperature of the contact by friction.
    FrictionalHeating,
    /// Temperature of the contact by the current.
    JouleHeating,
    /// Moving mesh and rebuilt stiffness.
    Relocation,
    /// Decrease of the spring's load as the bodies wear.
    SpringFading,
    /// Finite strains and rotations of the bodies; never simulated: a scene that requires it is refused.
    GeometricNonlinearity,
    /// Resistance of the contact; derived from the wear, which it does not change.
    Resistance,
    /// Displacement of an alternating current to the surface; never simulated.
    SkinEffect,
    /// Plastic flow of the contact as a whole; never simulated.
    Plasticity,
    /// Growth of oxides; part of the oxidational wear laws alone.
    Oxidation,
    /// Loss of the load by stress relaxation of the spring; never simulated.
    Relaxation,
    /// Inertia of the parts; part of the motions that follow from an acceleration alone.
    Inertia,
    /// Distribution of the load across the width of the section; never simulated.
    AcrossWidth,
    /// Debris between the surfaces; never simulated.
    ThirdBody,
    /// Transfer of metal from one surface to the other; never simulated.
    MetalTransfer,
    /// Fatigue of the surfaces; never simulated.
    Fatigue,
}

impl Effect {
    /// Returns `true` if it can be simulated.
    pub fn is_available(self) -> bool {
        !matches!(
            self,
            Self::GeometricNonlinearity
                | Self::SkinEffect
                | Self::Plasticity
                | Self::Oxidation
                | Self::Relaxation
                | Self::Inertia
                | Self::AcrossWidth
                | Self::ThirdBody
                | Self::MetalTransfer
                | Self::Fatigue
        )
    }

    /// Returns `true` if its indicator, if it is skipped, counts as an error of what the tolerance bounds. Effects that are never
    /// simulated have limits of their own; layers that the wear does not reach change nothing.
    pub(crate) fn is_counted(self) -> bool {
        self.is_available() && self != Self::Plating && !self.is_derived()
    }

    /// Returns `true` if it follows from the wear and changes none of it.
    pub fn is_derived(self) -> bool {
        matches!(self, Self::Resistance | Self::SkinEffect)
    }
}
