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
    /// `archard`: the wear coefficient k, -; together with `hardness_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k: Option<f64>,
    /// `archard`: the hardness H of the wearing surface, MPa; that of the material if `k` is given alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness_mpa: Option<f64>,
    /// `archard`: k/H, 1/MPa; instead of `k` and `hardness_mpa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k_over_h_per_mpa: Option<f64>,
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
