//! Axes: title, scale, and how values become places along them.

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub title: String,
    /// How values are spread along it.
    pub scale: Scale,
    /// Which values it covers.
    pub span: Span,
}

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Evenly, growing to the right or upwards.
    Linear,
    /// Evenly, growing downwards: depths.
    Downward,
    /// By decades; values that are not positive are left out.
    Logarithmic,
}

/// Which values an axis covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Span {
    /// What its data need.
    Data,
    /// What its data need, and zero.
    DataAndZero,
    /// From, to.
    Fixed(f64, f64),
}

impl Axis {
    /// An axis that covers what its data need.
    pub fn new(title: impl Into<String>, scale: Scale) -> Self {
        Self {
            title: title.into(),
            scale,
            span: Span::Data,
        }
    }

    /// The same axis with another span.
    #[must_use]
    pub fn spanning(self, span: Span) -> Self {
        Self { span, ..self }
    }
}

impl Scale {
    /// The place of a value along the axis; none if it has no place on it.
    pub(crate) fn place(self, value: f64) -> Option<f64> {
        let place = match self {
            Self::Linear => value,
            Self::Downward => -value,
            Self::Logarithmic => value.log10(),
        };
        place.is_finite().then_some(place)
    }

    /// The value at a place.
    pub(crate) fn value(self, place: f64) -> f64 {
        match self {
            Self::Linear => place,
            Self::Downward => -place,
            Self::Logarithmic => 10.0_f64.powf(place),
        }
    }
}
