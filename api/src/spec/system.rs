//! The contact system and its dimensions.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// The kinds of contact system.
    SystemKind {
        /// A wire's lower half on a circuit board's block.
        FuzzButton = "fuzz_button",
        /// A rounded spring contact on a card's flat pad.
        SdCard = "sd_card",
        /// A semicircular socket contact on a memory module's pad.
        Dimm = "dimm",
        /// A sprung socket contact on the pin of an integrated circuit.
        Zif = "zif",
        /// A cylinder on a block, the bench geometry of the literature.
        CylinderOnFlat = "cylinder_on_flat",
    }
}

/// The contact system. Which dimensions belong to it depends on its kind.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct System {
    /// Kind.
    #[schema(value_type = SystemKind)]
    pub kind: EnumValue<SystemKind>,
    /// `fuzz_button`: diameter of the wire, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wire_diameter_mm: Option<f64>,
    /// `fuzz_button`: length of the circuit board's block along the sliding direction, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pcb_length_mm: Option<f64>,
    /// `fuzz_button`: height of the circuit board's block, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pcb_height_mm: Option<f64>,
    /// `cylinder_on_flat`: radius of the cylinder, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_mm: Option<f64>,
    /// `cylinder_on_flat`: length of the block, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flat_length_mm: Option<f64>,
    /// `cylinder_on_flat`: height of the block, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flat_height_mm: Option<f64>,
    /// `cylinder_on_flat`: half the width of the modelled part of the cylinder, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slider_half_width_mm: Option<f64>,
    /// `cylinder_on_flat`: height of the modelled part, from the contact point to the top face, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slider_height_mm: Option<f64>,
    /// `cylinder_on_flat`: radius of a convex top of the block, mm; the top is flat if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crown_radius_mm: Option<f64>,
    /// `sd_card`, `dimm`, `zif`: radius of the sprung contact, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact_radius_mm: Option<f64>,
    /// `sd_card`, `dimm`: length of the pad, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pad_length_mm: Option<f64>,
    /// `sd_card`, `dimm`: height of the pad and its substrate, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pad_height_mm: Option<f64>,
    /// `zif`: length of the modelled part of the pin, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_length_mm: Option<f64>,
    /// `zif`: thickness of the pin, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_thickness_mm: Option<f64>,
    /// `zif`: radius of a round pin, mm; the pin is flat if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pin_radius_mm: Option<f64>,
}

impl System {
    /// A system of that kind, with all dimensions from its preset.
    pub fn of_kind(kind: SystemKind) -> Self {
        Self {
            kind: kind.into(),
            ..Self::default()
        }
    }
}
