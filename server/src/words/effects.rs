//! Names of effects, definitions of their indicators, and the outputs that they change.

use solver::scene::Effect;

/// Declares the stable name of each effect, the definition of its indicator and the outputs that it changes.
macro_rules! effects {
    ($($effect:ident = $name:literal, $indicator:literal, [$($output:literal),*];)+) => {
        /// Stable name of an effect.
        pub fn name(effect: Effect) -> &'static str {
            match effect { $(Effect::$effect => $name,)+ }
        }

        /// Definition of the indicator of an effect, in words and symbols.
        pub(crate) fn indicator(effect: Effect) -> &'static str {
            match effect { $(Effect::$effect => $indicator,)+ }
        }

        /// Outputs that an effect changes.
        pub(crate) fn changes(effect: Effect) -> &'static [&'static str] {
            match effect { $(Effect::$effect => &[$($output),*],)+ }
        }
    };
}

effects! {
    Elasticity = "elasticity",
        "always: the pressure and the width of the contact follow from it",
        ["peak_pressure_mpa", "contact_half_width_mm", "max_depth_mm", "scar_half_width_mm"];
    Friction = "friction",
        "largest of: slip lost by tangential deformation over the amplitude, (A_c/A)/(1 - mu s), with the slope of the scar's \
         edge, s = sqrt(2 h/R), or on a corner; (mu s)^2; (mu times Dundurs' beta)^2; a third of the skew of the pressure \
         by the bending of the slider, (mu/4)(E*/E')H^2 b/w^3; mu where fields are asked for",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "peak_pressure_mpa", "fields"];
    StickMemory = "stick_memory",
        "slip lost by tangential deformation over the amplitude, (A_c/A)/(1 - mu s), with the slope of the scar's edge, \
         s = sqrt(2 h/R), or on a corner of the block",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "tangential_force_n_per_mm"];
    ReceptacleWear = "receptacle_wear",
        "larger of: its worn depth over the deepest; its wear rate over three times the slider's",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2"];
    SliderWear = "slider_wear",
        "largest of: its worn depth over the deepest; its wear rate over three times the receptacle's; half the width of its \
         flat over the amplitude",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2"];
    Plating = "plating",
        "deepest wear over the thickness of the outermost layer, of the worse side",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    ThermalSoftening = "thermal_softening",
        "largest change of a wear rate by the hardness at this temperature, (Tm - T0)/(Tm - T) - 1",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    FrictionalHeating = "frictional_heating",
        "largest change of a wear rate by the mean temperature of the unworn contact in gross slip, flash and bulk of a line source \
         of mu P v: dT/(Tm - T - dT) of a hardness, and what laws of the temperature add",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    JouleHeating = "joule_heating",
        "the same by the current through the constriction, sqrt(T^2 + (R I)^2/(4 L)) - T, at first with the most resistive metal of \
         each side, then with the resistance of the contact",
        ["max_depth_mm", "scar_half_width_mm", "worn_area_mm2", "life"];
    Relocation = "relocation",
        "0.0125 times the square of the worn part of the height over what is left, (h/H)^2/(1 - h/H), as measured; h/H where fields \
         are asked for",
        ["peak_pressure_mpa", "contact_half_width_mm", "fields"];
    SpringFading = "spring_fading",
        "mean loss of load over the load, (h_slider + h_receptacle) k/(2 P)",
        ["load_n_per_mm", "max_depth_mm", "worn_area_mm2", "peak_pressure_mpa"];
    GeometricNonlinearity = "geometric_nonlinearity",
        "error of small strains in peak pressure and half-width, (p0/2E*)(1 + 0.16 mu^2)",
        ["peak_pressure_mpa", "contact_half_width_mm"];
    Resistance = "resistance",
        "always where the force, the resistivities and the hardnesses are known",
        ["contact_resistance_mohm", "life"];
    SkinEffect = "skin_effect",
        "resistance of a round wire as thick as a body over that to direct current, less 1, of the worse body",
        ["contact_resistance_mohm"];
    Plasticity = "plasticity",
        "peak pressure of the unworn contact over the hardness of the softer surface, p0/H",
        ["peak_pressure_mpa", "contact_half_width_mm", "max_depth_mm"];
    Oxidation = "oxidation",
        "none: a wear law states it",
        ["max_depth_mm", "worn_area_mm2", "life"];
    Relaxation = "relaxation",
        "none: it depends on the alloy, its temper, temperature and time",
        ["load_n_per_mm", "max_depth_mm", "life"];
    Inertia = "inertia",
        "none: a contact in a run is quasi-static",
        ["loop"];
    AcrossWidth = "across_width",
        "1 less the life of a ball of the section's radius over that of the section until the outermost layer of the tip, or else the final depth, is worn: 1.67 sqrt(R h)/w",
        ["peak_pressure_mpa", "max_depth_mm", "life"];
    ThirdBody = "third_body",
        "none: a wear coefficient contains what debris did in its measurement",
        ["max_depth_mm", "life"];
    MetalTransfer = "metal_transfer",
        "none: wear only removes",
        ["max_depth_mm", "life"];
    Fatigue = "fatigue",
        "none: no crack grows",
        ["life"];
}
