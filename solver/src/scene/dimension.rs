//! Which dimensions of a contact are simulated.

use crate::sides::Sides;

/// Dimensions of a contact that are simulated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Dimension {
    /// A section in plane strain, alike along its depth.
    #[default]
    PlaneStrain,
    /// A point contact of half-spaces, of which the scene's shapes are the section in the plane of the sliding direction.
    Point(Point),
}

/// What a point contact has beyond its section.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Point {
    /// Normal force F, N.
    pub force_n: f64,
    /// Radius of each body in the plane across the sliding direction, mm; `None` is straight.
    pub radius_across_mm: Sides<Option<f64>>,
}

impl Dimension {
    /// What a point contact has beyond its section, if it is one.
    pub fn point(&self) -> Option<&Point> {
        match self {
            Self::PlaneStrain => None,
            Self::Point(point) => Some(point),
        }
    }
}
