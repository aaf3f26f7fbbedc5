//! Life: what ends it, and how far wear coefficients scatter.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Kinds of criteria.
    CriterionKind {
        /// A layer of the plating is exposed somewhere.
        FirstExposure = "first_exposure",
        /// The base below the plating is exposed somewhere.
        BaseMetal = "base_metal",
        /// The base, or a layer, is exposed on a part of the scar.
        ExposedFraction = "exposed_fraction",
        /// The deepest wear has reached a depth.
        WornDepth = "worn_depth",
        /// The contact resistance has reached a limit.
        Resistance = "resistance",
    }
}

string_enum! {
    /// One of the two parts.
    Part {
        /// The sprung or vibrating part.
        Slider = "slider",
        /// The fixed part.
        Receptacle = "receptacle",
    }
}

/// Life of the contact.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LifeSettings {
    /// Coefficient of variation of the wear coefficients, which are taken as lognormal, - (default 0.5).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coefficient_of_variation: Option<f64>,
    /// Number of equal, independent contacts, of which the first one ends the life of the connector (default 1).
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::count::optional"
    )]
    pub contacts: Option<u64>,
    /// Cycles that the connector has to last; results then say which part of all contacts and connectors fails before, and whether the shares of
    /// `reliability` last.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::count::optional"
    )]
    pub target_cycles: Option<u64>,
    /// Shares of all contacts, and connectors, that have to last; lives are stated at each (default 0.9 and 0.99).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reliability: Option<Vec<f64>>,
    /// Criteria that end a life; the first exposure of every layer and of the base metal of both parts if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub criteria: Option<Vec<Criterion>>,
}

/// Criterion that ends a life.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Criterion {
    /// The kind.
    #[schema(value_type = CriterionKind)]
    pub kind: EnumValue<CriterionKind>,
    /// The part; both where absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Part>)]
    pub side: Option<EnumValue<Part>>,
    /// `first_exposure`: the layer that is exposed, the outermost one being 1. `exposed_fraction`: the same; the base metal if
    /// absent.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::count::optional"
    )]
    pub layer: Option<u64>,
    /// `exposed_fraction`: the exposed part of the scar, -.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fraction: Option<f64>,
    /// `worn_depth`: the depth, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mm: Option<f64>,
    /// `resistance`: the limit, mOhm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mohm: Option<f64>,
}
