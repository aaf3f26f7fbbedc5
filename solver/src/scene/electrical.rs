//! The contact as an electrical conductor.

use crate::law::plating::MOST_LAYERS;
use crate::law::resistance::{Deformation, Film};
use crate::scene::MissingProperty;
use crate::sides::Sides;

/// Most metals of a side: its layers and its base.
pub(crate) const MOST_METALS: usize = MOST_LAYERS + 1;

/// Electrical properties of the contact in a scene, as far as they are known.
#[derive(Debug, Clone, PartialEq)]
pub enum Conduction {
    /// All properties that the resistance follows from.
    Known(Box<Electrical>),
    /// Something is missing.
    Unknown {
        /// The missing property.
        missing: MissingProperty,
        /// True if the resistance is requested.
        is_requested: bool,
    },
}

impl Default for Conduction {
    fn default() -> Self {
        Self::Unknown {
            missing: MissingProperty::All,
            is_requested: false,
        }
    }
}

impl Conduction {
    /// The electrical properties, if all of them are known.
    pub fn known(&self) -> Option<&Electrical> {
        match self {
            Self::Known(electrical) => Some(electrical),
            Self::Unknown { .. } => None,
        }
    }
}

/// Electrical properties of the contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Electrical {
    /// Depth of the section that carries the load, mm.
    pub width_mm: f64,
    /// Metals of each side from the surface down, the layers and the base: at most [`MOST_LAYERS`] + 1.
    pub metals: Sides<Vec<Metal>>,
    /// Spots of real contact.
    pub spots: Spots,
    /// Frequency of the current, Hz; `None` of a direct one.
    pub frequency_hz: Option<f64>,
    /// The current, A, if it is known.
    pub current_a: Option<f64>,
    /// Limits of the resistance that end the run, mOhm.
    pub stop_mohm: Vec<f64>,
    /// Limits whose life is recorded, mOhm.
    pub life_mohm: Vec<f64>,
}

/// A layer, or the base, of a side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Metal {
    /// Depth of its lower end below the unworn surface, mm; of a base without bound.
    pub bottom_mm: f64,
    /// Resistivity, ohm m.
    pub resistivity_ohm_m: f64,
    /// Hardness at the temperature of the contact, MPa.
    pub hardness_mpa: f64,
    /// Film on it where it is exposed.
    pub film: Option<Film>,
}

/// Spots of real contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spots {
    /// Their number.
    pub count: usize,
    /// Diameter of the circle that they fill evenly, mm; of one spot without meaning.
    pub cluster_diameter_mm: f64,
    /// How they carry the load.
    pub deformation: Deformation,
}
