//! Temperature of a surface in a wear law.

/// A temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Temperature {
    /// One that is given for the contact, K: heat of friction and current is part of it.
    OfContact(f64),
    /// Temperature of the surroundings, K, over which friction and current heat the contact.
    OfSurroundings(f64),
}

impl Temperature {
    /// The temperature without further heat, K.
    pub fn kelvin(self) -> f64 {
        match self {
            Self::OfContact(kelvin) | Self::OfSurroundings(kelvin) => kelvin,
        }
    }

    /// The temperature of a contact that is warmer than its surroundings by a rise in K.
    #[must_use]
    pub(crate) fn raised(self, rise_k: f64) -> Self {
        match self {
            Self::OfContact(_) => self,
            Self::OfSurroundings(kelvin) => Self::OfSurroundings(kelvin + rise_k),
        }
    }
}
