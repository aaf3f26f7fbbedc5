//! Effects that a plan decides about.

use serde::{Deserialize, Serialize};

/// Declares the effects with their stable names, their indicators in words and the outputs that they change.
macro_rules! effects {
    ($($(#[doc = $doc:literal])+ $effect:ident = $name:literal, $indicator:literal, [$($output:literal),*];)+) => {
        /// Effects that a plan decides about.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Effect {
            $($(#[doc = $doc])+ $effect,)+
        }

        impl Effect {
            /// All effects, in the order of a plan.
            pub const ALL: &'static [Self] = &[$(Self::$effect),+];

            /// Stable name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$effect => $name,)+ }
            }

            /// Definition of the indicator, in words and symbols.
            pub fn indicator(self) -> &'static str {
                match self { $(Self::$effect => $indicator,)+ }
            }

            /// Outputs that it changes.
            pub fn changes(self) -> &'static [&'static str] {
                match self { $(Self::$effect => &[$($output),*],)+ }
            }
        }
    };
}

effects! {
    /// Elastic deformation of both bodies.
    Elasticity = "elasticity",
        "always: the pressure and the width of the contact follow from it",
        ["peak_pressure_mpa", "contact_half_width_mm", "max_depth_mm", "scar_half_width_mm"];
    /// Action of the shear traction on the contact.
    Friction = "friction",
        "largest of: slip lost by tangential deformation over the amplitude, (A_c/A)/(1 - mu s), with the slope of the scar's \
         edge, s = sqrt(2 h/R), or on a corner; (mu s)^2; (mu times Dundurs' beta)^2; a third of the skew of the pressure \
         by the bending of the slider, (mu/4)(E*/E')H^2 b/w^3; mu where fields are asked for",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "peak_pressure_mpa", "fields"];
    /// Stick, slip and the tangential deformation in the slip.
    StickMemory = "stick_memory",
        "slip lost by tangential deformation over the amplitude, (A_c/A)/(1 - mu s), with the slope of the scar's edge, \
         s = sqrt(2 h/R), or on a corner of the block",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "tangential_force_n_per_mm"];
    /// Wear of the receptacle.
    ReceptacleWear = "receptacle_wear",
        "larger of: its worn depth over the deepest; its wear rate over three times the slider's",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2"];
    /// Wear of the slider.
    SliderWear = "slider_wear",
        "largest of: its worn depth over the deepest; its wear rate over three times the receptacle's; half the width of its \
         flat over the amplitude",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2"];
    /// Layers below the outermost one.
    Plating = "plating",
        "deepest wear over the thickness of the outermost layer, of the worse side",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    /// Change of the hardness with the temperature of the contact.
    ThermalSoftening = "thermal_softening",
        "largest change of a wear rate by the hardness at this temperature, (Tm - T0)/(Tm - T) - 1",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    /// Temperature of the contact by friction.
    FrictionalHeating = "frictional_heating",
        "largest change of a wear rate by the mean temperature of the unworn contact in gross slip, flash and bulk of a line source \
         of mu P v: dT/(Tm - T - dT) of a hardness, and what laws of the temperature add",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    /// Temperature of the contact by the current.
    JouleHeating = "joule_heating",
        "the same by the current through the constriction, sqrt(T^2 + (R I)^2/(4 L)) - T, at first with the most resistive metal of \
         each side, then with the resistance of the contact",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    /// Moving mesh and rebuilt stiffness.
    Relocation = "relocation",
        "0.0125 times the square of the worn part of the height over what is left, (h/H)^2/(1 - h/H), as measured; h/H where fields \
         are asked for",
        ["peak_pressure_mpa", "contact_half_width_mm", "fields"];
    /// Decrease of the spring's load as the bodies wear.
    SpringFading = "spring_fading",
        "mean loss of load over the load, (h_slider + h_receptacle) k/(2 P)",
        ["load_n_per_mm", "max_depth_mm", "worn_area_mm2", "peak_pressure_mpa"];
    /// Finite strains and rotations of the bodies; never simulated: a scene that requires it is refused.
    GeometricNonlinearity = "geometric_nonlinearity",
        "error of small strains in peak pressure and half-width, (p0/2E*)(1 + 0.16 mu^2)",
        ["peak_pressure_mpa", "contact_half_width_mm"];
    /// Resistance of the contact; derived from the wear, which it does not change.
    Resistance = "resistance",
        "always where the force, the resistivities and the hardnesses are known",
        ["contact_resistance_mohm", "life"];
    /// Displacement of an alternating current to the surface; never simulated.
    SkinEffect = "skin_effect",
        "resistance of a round wire as thick as a body over that to direct current, less 1, of the worse body",
        ["contact_resistance_mohm"];
    /// Plastic flow of the contact as a whole; never simulated.
    Plasticity = "plasticity",
        "peak pressure of the unworn contact over the hardness of the softer surface, p0/H",
        ["peak_pressure_mpa", "contact_half_width_mm", "max_depth_mm"];
    /// Growth of oxides; part of the oxidational wear laws alone.
    Oxidation = "oxidation",
        "none: a wear law states it",
        ["max_depth_mm", "worn_area_mm2", "life"];
    /// Loss of the load by stress relaxation of the spring; never simulated.
    Relaxation = "relaxation",
        "none: it depends on the alloy, its temper, temperature and time",
        ["load_n_per_mm", "max_depth_mm", "life"];
    /// Inertia of the parts; part of the motions that follow from an acceleration alone.
    Inertia = "inertia",
        "none: a contact in a run is quasi-static",
        ["loop"];
    /// Distribution of the load across the width of the section; never simulated.
    AcrossWidth = "across_width",
        "1 less the life of a ball of the section's radius over that of the section until the outermost layer of the tip, or else the final depth, is worn: 1.67 sqrt(R h)/w",
        ["peak_pressure_mpa", "max_depth_mm", "life"];
    /// Debris between the surfaces; never simulated.
    ThirdBody = "third_body",
        "none: a wear coefficient contains what debris did in its measurement",
        ["max_depth_mm", "life"];
    /// Transfer of metal from one surface to the other; never simulated.
    MetalTransfer = "metal_transfer",
        "none: wear only removes",
        ["max_depth_mm", "life"];
    /// Fatigue of the surfaces; never simulated.
    Fatigue = "fatigue",
        "none: no crack grows",
        ["life"];
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
