//! Friction and wear between both parts.

use serde::{Deserialize, Deserializer, Serialize};
use utoipa::ToSchema;

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
}

/// Friction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Friction {
    /// The law.
    #[schema(value_type = FrictionLaw)]
    pub law: EnumValue<FrictionLaw>,
    /// `coulomb`: the coefficient of friction, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficient: Option<f64>,
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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct WearLaw {
    /// The law.
    #[schema(value_type = WearLawName)]
    pub law: EnumValue<WearLawName>,
    /// `archard`, `sarkar`, `saracibar`: the wear coefficient k, -; together with `hardness_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k: Option<f64>,
    /// Beside `k`: the hardness H of the wearing surface, MPa; that of the material if `k` is given alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness_mpa: Option<f64>,
    /// k/H, 1/MPa; instead of `k` and `hardness_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k_over_h_per_mpa: Option<f64>,
    /// `saracibar`: the coefficient of friction mu0 at which k was measured, -. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference_friction: Option<f64>,
    /// `dissipated_energy`: the worn volume per dissipated energy alpha, mm^3/J. Required there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy_coefficient_mm3_per_j: Option<f64>,
}

impl WearLaw {
    /// A law without its values.
    pub fn of(law: WearLawName) -> Self {
        Self {
            law: law.into(),
            k: None,
            hardness_mpa: None,
            k_over_h_per_mpa: None,
            reference_friction: None,
            energy_coefficient_mm3_per_j: None,
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
