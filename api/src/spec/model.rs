//! Which dimensions of the contact are simulated.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::count;
use crate::enum_value::{EnumValue, string_enum};

string_enum! {
    /// Dimensions of a model.
    Dimension {
        /// A section, alike along its depth.
        PlaneStrain = "plane_strain",
        /// A contact that is small in both directions: a ball, a dimple or a crowned spring on a pad.
        Point = "point",
        /// A contact along a straight line across the motion, with a crown or a tilt.
        Line = "line",
        /// A wire bent to a ring that vibrates in the plane of the ring.
        Ring = "ring",
        /// Bodies of a width whose ends are free or held, in layers of solid elements.
        Extruded = "extruded",
        /// `plane_strain`, `line` or `point`, whichever a slider of a width with a crown or a tilt requires; `point` for a radius across without
        /// a width.
        Auto = "auto",
    }
}

string_enum! {
    /// Support of the sections of a slider along a line.
    Top {
        /// A rigid body that does not rotate: the same height everywhere.
        Rigid = "rigid",
        /// The same line load everywhere.
        Even = "even",
        /// `ring`: an even pressure on the wire, whose stiffness holds back what would sink farther than its neighbours.
        Pressure = "pressure",
    }
}

string_enum! {
    /// How a ring moves on another one.
    RingMotion {
        /// Along a diameter.
        InPlane = "in_plane",
        /// About its axis; the amplitude is the length of the arc of its centre line.
        Torsion = "torsion",
    }
}

string_enum! {
    /// Support of the ends of extruded bodies.
    Ends {
        /// Nothing.
        Free = "free",
        /// Walls that they slide along: plane strain.
        Held = "held",
    }
}

string_enum! {
    /// Named models of a `fuzz_button`.
    ModelPreset {
        /// The source's extruded half of a wire: 0.01058 mm wide, in two layers.
        SourceExtruded = "source_extruded",
        /// The source's ring of wire, which it gives no dimensions.
        SourceRing = "source_ring",
    }
}

/// Which dimensions of the contact are simulated. Which fields belong to it depends on its dimension.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Model {
    /// `fuzz_button`: a named model; other fields may differ from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<ModelPreset>)]
    pub preset: Option<EnumValue<ModelPreset>>,
    /// Dimension; that of the preset if absent, else `plane_strain`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Dimension>)]
    pub dimension: Option<EnumValue<Dimension>>,
    /// `point`: radius of the slider in the plane across the sliding direction, mm; that of the section if absent, as of a ball. `auto`: the
    /// same, instead of a width.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_z_mm: Option<f64>,
    /// `ring`: outer diameter of the ring of wire, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outer_diameter_mm: Option<f64>,
    /// `line`, `auto`: its length across the motion; `extruded`: the width of both bodies, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_mm: Option<f64>,
    /// `line`, `auto`: radius by which the slider's surface recedes from the middle of the line to its ends, mm; straight if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crown_radius_mm: Option<f64>,
    /// `line`, `auto`: tilt of the slider about the direction of motion, mrad; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tilt_mrad: Option<f64>,
    /// `line`, `ring`, `auto`: what carries the sections of the slider; a rigid body if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Top>)]
    pub top: Option<EnumValue<Top>>,
    /// `ring`: how it moves on the other one; along a diameter if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<RingMotion>)]
    pub motion: Option<EnumValue<RingMotion>>,
    /// `extruded`: layers of elements over the width, an even number; 2 if absent.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "count::optional"
    )]
    pub layers: Option<u32>,
    /// `extruded`: length of a layer over that of its neighbour toward the end; 1 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer_growth: Option<f64>,
    /// `extruded`: what holds the ends; nothing if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Ends>)]
    pub ends: Option<EnumValue<Ends>>,
    /// `auto`: the dimension that was chosen; written by the service.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Option<Dimension>)]
    pub chosen: Option<EnumValue<Dimension>>,
}

impl Model {
    /// Returns `true` if it has an extent of its own across the sliding direction, so that a force needs no width.
    pub fn has_width(&self) -> bool {
        match self.dimension {
            None => self.preset.is_some(),
            Some(EnumValue::Known(dimension)) => dimension != Dimension::PlaneStrain,
            Some(_) => true,
        }
    }
}
