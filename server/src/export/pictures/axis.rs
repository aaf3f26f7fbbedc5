//! Axes: title, scale, range, and the map from values to coordinates along them.

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub title: String,
    /// Scale.
    pub scale: Scale,
    /// Range.
    pub range: AxisRange,
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear, values increase to the right or upwards.
    Linear,
    /// Linear, values increase downwards, for depths.
    Downward,
    /// Logarithmic; values that are not positive are omitted.
    Logarithmic,
}

/// Range of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AxisRange {
    /// Fitted to the data.
    Data,
    /// Fitted to the data, zero included.
    DataAndZero,
    /// From one value to another.
    Fixed(f64, f64),
}

impl Axis {
    /// An axis fitted to the data.
    pub fn new(title: impl Into<String>, scale: Scale) -> Self {
        Self {
            title: title.into(),
            scale,
            range: AxisRange::Data,
        }
    }

    /// The same axis with another range.
    #[must_use]
    pub fn with_range(self, range: AxisRange) -> Self {
        Self { range, ..self }
    }
}

impl Scale {
    /// The coordinate of a value along the axis; `None` if it has none.
    pub(crate) fn coordinate(self, value: f64) -> Option<f64> {
        let coordinate = match self {
            Self::Linear => value,
            Self::Downward => -value,
            Self::Logarithmic => value.log10(),
        };
        coordinate.is_finite().then_some(coordinate)
    }

    /// The value at a coordinate.
    pub(crate) fn value(self, coordinate: f64) -> f64 {
        match self {
            Self::Linear => coordinate,
            Self::Downward => -coordinate,
            Self::Logarithmic => 10.0_f64.powf(coordinate),
        }
    }
}
