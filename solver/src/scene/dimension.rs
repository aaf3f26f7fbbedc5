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
    /// A contact along a line of plane sections, of which the scene's shapes are one.
    Line(Line),
    /// Bodies of a width, of which the scene's shapes are the section; its line load is the mean over the width.
    Extruded(Extruded),
}

/// Parameters of a point contact beyond its section.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Point {
    /// Normal force F, N.
    pub force_n: f64,
    /// Radius of each body in the plane across the sliding direction, mm; `None` is straight.
    pub radius_across_mm: Sides<Option<f64>>,
}

/// Parameters of a contact along a line beyond its section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Shape of the line.
    pub shape: LineShape,
    /// Support of the sections of the slider.
    pub top: Top,
    /// Normal force F on the whole line, N.
    pub force_n: f64,
    /// Number of sections along the half ring, the half of a straight line or all of one with a tilt, with both ends; chosen from the
    /// tolerance if absent.
    pub stations: Option<usize>,
}

/// Parameters of extruded bodies beyond their section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extruded {
    /// Width w of both bodies, mm.
    pub width_mm: f64,
    /// Layers of elements over the width; even, because the middle is a node plane.
    pub layers: usize,
    /// Length of a layer over that of its neighbour toward the end; 1 for even layers.
    pub layer_growth: f64,
    /// Boundary condition on the ends.
    pub ends: Ends,
}

/// Boundary condition on the ends of extruded bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// `u_z` of every node is zero: plane strain.
    Held,
    /// Nothing.
    Free,
}

/// Line of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LineShape {
    /// A circle.
    Ring {
        /// Radius of its centre line, mm.
        radius_mm: f64,
        /// How the slider moves on it.
        motion: RingMotion,
    },
    /// A straight line across the motion.
    Straight {
        /// Length, mm.
        width_mm: f64,
        /// Radius by which the slider's surface recedes from the middle of the line to its ends, mm; straight if absent.
        crown_radius_mm: Option<f64>,
        /// Tilt of the slider about the direction of motion, mrad.
        tilt_mrad: f64,
    },
}

/// How a ring moves on another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RingMotion {
    /// Along a diameter.
    InPlane,
    /// About its axis: displacements are those of its centre line.
    Torsion,
}

/// Support of the sections of the slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Top {
    /// The same line load everywhere.
    Even,
    /// A rigid body that does not rotate: the same height everywhere.
    Rigid,
    /// An even pressure on a body of finite stiffness, which does not tilt and whose top keeps its places in the plane of the motion.
    Pressure,
}

impl Dimension {
    /// Parameters of a point contact, if the scene has one.
    pub fn point(&self) -> Option<&Point> {
        match self {
            Self::Point(point) => Some(point),
            Self::PlaneStrain | Self::Line(_) | Self::Extruded(_) => None,
        }
    }

    /// Parameters of a contact along a line, if the scene has one.
    pub fn line(&self) -> Option<&Line> {
        match self {
            Self::Line(line) => Some(line),
            Self::PlaneStrain | Self::Point(_) | Self::Extruded(_) => None,
        }
    }

    /// Parameters of extruded bodies, if the scene has them.
    pub fn extruded(&self) -> Option<&Extruded> {
        match self {
            Self::Extruded(extruded) => Some(extruded),
            Self::PlaneStrain | Self::Point(_) | Self::Line(_) => None,
        }
    }

    /// Returns `true` if it consists of sections along a line, all of which slip as imposed.
    pub(crate) fn has_sections(&self) -> bool {
        matches!(self, Self::Line(_) | Self::Extruded(_))
    }

    /// Returns `true` if it has a finite width.
    pub fn is_finite(&self) -> bool {
        *self != Self::PlaneStrain
    }
}

impl LineShape {
    /// Length L of the line, mm.
    pub fn length_mm(self) -> f64 {
        match self {
            Self::Ring { radius_mm, .. } => 2.0 * std::f64::consts::PI * radius_mm,
            Self::Straight { width_mm, .. } => width_mm,
        }
    }

    /// Returns `true` if all sections move alike and touch at once.
    pub(crate) fn is_even(self) -> bool {
        match self {
            Self::Ring { motion, .. } => motion == RingMotion::Torsion,
            Self::Straight {
                crown_radius_mm,
                tilt_mrad,
                ..
            } => crown_radius_mm.is_none() && tilt_mrad == 0.0,
        }
    }
}
