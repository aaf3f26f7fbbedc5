//! One value for each of the two bodies.

use serde::{Deserialize, Serialize};

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Side {
    /// The sprung or vibrating body, above.
    Slider,
    /// The fixed body, below.
    Receptacle,
}

impl Side {
    /// Both sides, the slider first.
    pub const BOTH: [Self; 2] = [Self::Slider, Self::Receptacle];

    /// The other side.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Slider => Self::Receptacle,
            Self::Receptacle => Self::Slider,
        }
    }

    /// Stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Slider => "slider",
            Self::Receptacle => "receptacle",
        }
    }

    /// Direction along y in which the surface recedes as it wears: +1 above the contact, -1 below.
    pub(crate) fn recession(self) -> f64 {
        match self {
            Self::Slider => 1.0,
            Self::Receptacle => -1.0,
        }
    }
}

/// A value for each of the two bodies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sides<T> {
    /// The slider's.
    pub slider: T,
    /// The receptacle's.
    pub receptacle: T,
}

impl<T> Sides<T> {
    /// Computes each side's value from the side.
    pub fn from_fn(mut f: impl FnMut(Side) -> T) -> Self {
        Self {
            slider: f(Side::Slider),
            receptacle: f(Side::Receptacle),
        }
    }

    /// The value of a side.
    pub fn of(&self, side: Side) -> &T {
        match side {
            Side::Slider => &self.slider,
            Side::Receptacle => &self.receptacle,
        }
    }

    /// The value of a side, to be changed.
    pub fn of_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::Slider => &mut self.slider,
            Side::Receptacle => &mut self.receptacle,
        }
    }

    /// References to both values.
    pub fn as_ref(&self) -> Sides<&T> {
        Sides {
            slider: &self.slider,
            receptacle: &self.receptacle,
        }
    }

    /// Applies a function to both values.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Sides<U> {
        Sides {
            slider: f(self.slider),
            receptacle: f(self.receptacle),
        }
    }

    /// Pairs the values of each side.
    pub fn zip<U>(self, other: Sides<U>) -> Sides<(T, U)> {
        Sides {
            slider: (self.slider, other.slider),
            receptacle: (self.receptacle, other.receptacle),
        }
    }
}

impl<T, E> Sides<Result<T, E>> {
    /// Both values, or the first error.
    ///
    /// # Errors
    /// The slider's error, else the receptacle's.
    pub fn transpose(self) -> Result<Sides<T>, E> {
        Ok(Sides {
            slider: self.slider?,
            receptacle: self.receptacle?,
        })
    }
}

impl Sides<Vec<f64>> {
    /// Borrows both as slices.
    pub(crate) fn as_slices(&self) -> Sides<&[f64]> {
        Sides {
            slider: &self.slider,
            receptacle: &self.receptacle,
        }
    }

    /// Largest value of either side, at least 0.
    pub fn largest(&self) -> f64 {
        let values = self.slider.iter().chain(&self.receptacle);
        values.fold(0.0, |m: f64, value| m.max(*value))
    }

    /// Largest value of each side, at least 0.
    pub(crate) fn largest_of_each(&self) -> Sides<f64> {
        self.as_ref()
            .map(|values| values.iter().fold(0.0, |m: f64, value| m.max(*value)))
    }
}
