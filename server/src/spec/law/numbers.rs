//! Fields of wear laws whose values are in a range.

use std::ops::RangeInclusive;

use super::{barwell, dissipated_energy, oxidation, power, saracibar, wear_coefficient};
use crate::spec::materials::HARDNESS_MPA;

/// The fields with their ranges.
pub(in crate::spec) fn numbers() -> Vec<(&'static str, RangeInclusive<f64>)> {
    vec![
        ("k", wear_coefficient::K),
        ("k_over_h_per_mpa", wear_coefficient::K_OVER_H_PER_MPA),
        ("hardness_mpa", HARDNESS_MPA),
        ("measured_at_hz", super::MEASURED_AT_HZ),
        ("reference_friction", saracibar::REFERENCE_FRICTION),
        (
            "energy_coefficient_mm3_per_j",
            dissipated_energy::ENERGY_COEFFICIENT_MM3_PER_J,
        ),
        (
            "characteristic_dose_mpa_mm",
            barwell::CHARACTERISTIC_DOSE_MPA_MM,
        ),
        ("contact_temperature_c", oxidation::CONTACT_TEMPERATURE_C),
        (
            "activation_energy_j_mol",
            oxidation::ACTIVATION_ENERGY_J_MOL,
        ),
        ("critical_film_um", oxidation::LENGTH_UM),
        ("asperity_diameter_um", oxidation::LENGTH_UM),
        ("arrhenius_constant_kg2_m4s", oxidation::ARRHENIUS_CONSTANT),
        ("oxide_density_kg_m3", oxidation::OXIDE_DENSITY_KG_M3),
        ("oxygen_fraction", oxidation::FRACTION),
        ("arrhenius_constant_m2_s", oxidation::ARRHENIUS_CONSTANT),
        ("oxidation_constant", oxidation::CONSTANT),
        ("transition_speed_mm_s", oxidation::TRANSITION_SPEED_MM_S),
        ("molten_fraction", oxidation::FRACTION),
        ("latent_heat_j_m3", oxidation::LATENT_HEAT_J_M3),
        ("heat_share", oxidation::FRACTION),
        ("oxide_conductivity_w_mk", oxidation::CONDUCTIVITY_W_MK),
        (
            "oxide_melting_temperature_c",
            oxidation::CONTACT_TEMPERATURE_C,
        ),
        ("diffusion_distance_um", oxidation::LENGTH_UM),
        ("wear_factor", power::FACTOR),
        ("pressure_exponent", power::PRESSURE_EXPONENT),
        ("speed_exponent", power::SPEED_EXPONENT),
        ("time_exponent", power::COURSE_EXPONENT),
        ("repetition_exponent", power::COURSE_EXPONENT),
        ("strain_exponent", power::STRAIN_EXPONENT),
        ("activation_temperature_k", power::ACTIVATION_TEMPERATURE_K),
        ("reference_length_mm", power::REFERENCE_LENGTH_MM),
    ]
}
