//! Friction and wear between both parts.

use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;

use super::{Film, Spots, count};
use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Friction laws.
    FrictionLaw {
        /// |q| <= mu p.
        Coulomb = "coulomb",
        /// No shear traction.
        Frictionless = "frictionless",
    }
}

string_enum! {
    /// Wear laws.
    WearLawName {
        /// Worn depth = (k/H) p |slip|.
        Archard = "archard",
        /// Worn depth = (k/H) sqrt(1 + 3 mu^2) p |slip|, Archard's with the junctions that shear enlarges.
        Sarkar = "sarkar",
        /// Worn depth = (k/H) (mu/mu0) p |slip|, with k as measured at the coefficient of friction mu0.
        Saracibar = "saracibar",
        /// Worn depth = alpha mu p |slip|, with the worn volume per dissipated energy alpha.
        DissipatedEnergy = "dissipated_energy",
        /// A rate that falls, stays or grows with the dose D = int p |ds| of a place, from k/H on.
        Barwell = "barwell",
        /// Quinn's mild oxidational wear: an oxide that grows on touching asperities breaks off at a critical thickness.
        Quinn = "quinn",
        /// Mild oxidational wear at moderate speeds, after Lim and Ashby.
        MildOxidation = "mild_oxidation",
        /// Severe oxidational wear at high speeds, after Lim and Ashby: friction melts an oxide film.
        SevereOxidation = "severe_oxidation",
        /// The mechanism of the speed: `archard`, from a transition on `mild_oxidation`, and `severe_oxidation` where friction melts the
        /// oxide.
        Oxidation = "oxidation",
        /// Worn depth = K p^a v^b t^c under a constant pressure p and speed v: Rhee's, of friction materials.
        Rhee = "rhee",
        /// Worn depth = t0 C1 p^C2 N^C3 after N repetitions of a constant pressure p; also where the contact sticks.
        LoadRepetition = "load_repetition",
        /// Worn depth = t0 e with a wear strain that grows by de/dt = C1 p^C2 e^C3 exp(-C4/T); also where the contact sticks.
        StrainHardening = "strain_hardening",
    }
}

string_enum! {
    /// How the rate of `barwell` changes with the dose D.
    WearCourse {
        /// Worn depth = (k/H) D0 (1 - exp(-D/D0)).
        Decelerating = "decelerating",
        /// Worn depth = (k/H) D.
        Steady = "steady",
        /// Worn depth = (k/H) D0 (exp(D/D0) - 1).
        Accelerating = "accelerating",
    }
}

/// Friction and wear.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Interface {
    /// Friction between both parts.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// Wear of each part.
    #[serde(default)]
    pub wear: Sides,
    /// Spots of real contact, for the contact resistance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spots: Option<Spots>,
    /// Films on exposed metals, for the contact resistance.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub films: Vec<Film>,
}

/// A coefficient of friction after a number of cycles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FrictionAtCycle {
    /// Cycles done.
    #[serde(deserialize_with = "count::required")]
    pub cycle: u64,
    /// Coefficient of friction, -.
    pub coefficient: f64,
}

/// A coefficient of friction at a dose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct FrictionAtDose {
    /// Dose of a place, the integral of pressure times slip, MPa mm.
    pub dose_mpa_mm: f64,
    /// Coefficient of friction of a surface there, -.
    pub coefficient: f64,
}

/// Friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Friction {
    /// The law.
    #[schema(value_type = FrictionLaw)]
    pub law: EnumValue<FrictionLaw>,
    /// `coulomb`: the coefficient of friction, -; or `by_cycle`, or `by_dose`. With layers that have a `friction_coefficient` it is
    /// that of the bases, and of layers without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficient: Option<f64>,
    /// `coulomb`: coefficients over the cycles done, in ascending order; linear between them, constant beyond.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_cycle: Option<Vec<FrictionAtCycle>>,
    /// `coulomb`: coefficients over the dose that a place of a surface has received, in ascending order; linear between them,
    /// constant beyond. Where both parts wear, the contact has the mean of both surfaces' there; a part that does not wear does not
    /// count.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by_dose: Option<Vec<FrictionAtDose>>,
}

/// Wear of each part: the preset's if absent, none if `null`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Sides {
    /// The sprung or vibrating part.
    #[serde(
        default,
        deserialize_with = "present",
        skip_serializing_if = "Option::is_none"
    )]
    #[schema(value_type = Option<WearLaw>)]
    pub slider: Option<Option<WearLaw>>,
    /// The fixed part.
    #[serde(
        default,
        deserialize_with = "present",
        skip_serializing_if = "Option::is_none"
    )]
    #[schema(value_type = Option<WearLaw>)]
    pub receptacle: Option<Option<WearLaw>>,
}

/// A wear law.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WearLaw {
    /// The law.
    #[schema(value_type = WearLawName)]
    pub law: EnumValue<WearLawName>,
    /// `archard`, `sarkar`, `saracibar`, `oxidation` (at low speeds), `barwell` (the initial one): the wear coefficient k, -; together with `hardness_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k: Option<f64>,
    /// Beside `k`, and of the oxidational laws: the hardness H of the wearing surface, MPa; that of the material
    /// if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness_mpa: Option<f64>,
    /// k/H, 1/MPa; instead of `k` and `hardness_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k_over_h_per_mpa: Option<f64>,
    /// Frequency at which the constants of the law were measured, Hz. A motion of another one is warned of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_at_hz: Option<f64>,
    /// `saracibar`: the coefficient of friction mu0 at which k was measured, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_friction: Option<f64>,
    /// `dissipated_energy`: the worn volume per dissipated energy alpha, mm^3/J. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy_coefficient_mm3_per_j: Option<f64>,
    /// `barwell`: how the rate changes with the dose. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<WearCourse>)]
    pub course: Option<EnumValue<WearCourse>>,
    /// `barwell`: the characteristic dose D0, MPa mm, after which the rate has fallen or grown by a factor of e. Required there, but
    /// for a steady course.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub characteristic_dose_mpa_mm: Option<f64>,
    /// `quinn`, `mild_oxidation`: temperature of the touching asperities, with that of flashes by friction; `severe_oxidation`: of the
    /// bulk; `strain_hardening`: of the contact, °C. If absent, that of the surroundings and what friction and current heat the contact
    /// by, which leaves out flashes of single asperities.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_temperature_c: Option<f64>,
    /// `quinn`, `mild_oxidation`, `oxidation`: activation energy of the oxidation, J/mol. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub activation_energy_j_mol: Option<f64>,
    /// `quinn`, `mild_oxidation`, `oxidation`: thickness at which the oxide breaks off, um. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_film_um: Option<f64>,
    /// `quinn`: diameter of a touching asperity, um. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asperity_diameter_um: Option<f64>,
    /// `quinn`: Arrhenius constant of the parabolic oxidation by mass, kg^2/(m^4 s). Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arrhenius_constant_kg2_m4s: Option<f64>,
    /// `quinn`: density of the oxide, kg/m^3. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oxide_density_kg_m3: Option<f64>,
    /// `quinn`: mass fraction of oxygen in the oxide, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oxygen_fraction: Option<f64>,
    /// `mild_oxidation`, `oxidation`: Arrhenius constant of the oxidation, m^2/s. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arrhenius_constant_m2_s: Option<f64>,
    /// `mild_oxidation`, `oxidation`: the constant C of the law, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oxidation_constant: Option<f64>,
    /// `oxidation`: speed of the transition from `archard` to `mild_oxidation`, mm/s; 100 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transition_speed_mm_s: Option<f64>,
    /// `severe_oxidation`, `oxidation`: fraction of the molten oxide that is removed, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub molten_fraction: Option<f64>,
    /// `severe_oxidation`, `oxidation`: latent heat of the oxide, J/m^3. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latent_heat_j_m3: Option<f64>,
    /// `severe_oxidation`, `oxidation`: share of the frictional heat that enters the body, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub heat_share: Option<f64>,
    /// `severe_oxidation`, `oxidation`: thermal conductivity of the oxide, W/(m K). Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oxide_conductivity_w_mk: Option<f64>,
    /// `severe_oxidation`, `oxidation`: melting temperature of the oxide, °C. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oxide_melting_temperature_c: Option<f64>,
    /// `rhee`: the factor K, mm/(MPa^a (mm/s)^b s^c); `load_repetition`: C1, 1/MPa^C2; `strain_hardening`: C1, 1/(MPa^C2 s). Required
    /// there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear_factor: Option<f64>,
    /// `rhee`: the exponent a, `load_repetition`, `strain_hardening`: C2, of the pressure, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_exponent: Option<f64>,
    /// `rhee`: the exponent b of the speed, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_exponent: Option<f64>,
    /// `rhee`: the exponent c of the time, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_exponent: Option<f64>,
    /// `load_repetition`: the exponent C3 of the repetitions, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repetition_exponent: Option<f64>,
    /// `strain_hardening`: the exponent C3 of the strain, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_exponent: Option<f64>,
    /// `strain_hardening`: C4, K. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub activation_temperature_k: Option<f64>,
    /// `load_repetition`, `strain_hardening`: the length t0 over which the strain is worn, mm: a length of the material, which no mesh
    /// determines. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_length_mm: Option<f64>,
    /// `severe_oxidation`, `oxidation`: distance over which the heat of a flash diffuses, um. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diffusion_distance_um: Option<f64>,
}

impl WearLaw {
    /// A law without its values.
    pub fn of(law: WearLawName) -> Self {
        Self {
            law: law.into(),
            ..Self::default()
        }
    }
}

#[expect(
    clippy::option_option,
    reason = "absent, null and a law have different meanings"
)]
fn present<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Option<WearLaw>>, D::Error> {
    Option::<WearLaw>::deserialize(deserializer).map(Some)
}
