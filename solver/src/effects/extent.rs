//! The dimension that a contact of finite width requires.
//!
//! A slider of the width w whose surface recedes by a crown of the radius R_z, or by a tilt, touches all of its width once the wear h is
//! large against the height g = (w/2)^2/(2 R_z) + |tilt| w that recedes: its sections are then alike, and plane strain describes it
//! where g is below a fifth of the tolerance times h.
//!
//! A crown whose contact stays within the width is a point contact of half-spaces: sections along the width have the same wear where it is
//! long (depths within 1.4 % at half-lengths c/a = 8, 3.3 % at 2.8), at thirty times the cost. A contact that grows to the ends of the width,
//! sqrt(c^2 + 2 R_z h) > w/2, which half-spaces do not have, is a line of sections; so is a tilted one.
//!
//! a, c: Hertz' half-lengths along and across the sliding direction.

use crate::closed_form::expected_wear::{expected_cycles, worn_depth_after};
use crate::closed_form::half_lengths_mm;
use crate::closed_form::unworn_contact::hertz_half_width;
use crate::scene::Scene;

/// Largest height that recedes over the worn depth and the tolerance.
const SHARE: f64 = 0.2;

/// Extent of a slider across the sliding direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Width w, mm.
    pub width_mm: f64,
    /// Radius R_z of its crown, mm; none of a straight one.
    pub crown_radius_mm: Option<f64>,
    /// Tilt, mrad.
    pub tilt_mrad: f64,
}

/// The dimension to choose, with its reason.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Choice {
    /// One section: there is neither a crown nor a tilt.
    Straight,
    /// One section: crown and tilt recede by less than the limit.
    Recedes {
        /// Height that recedes over the width, mm.
        by_mm: f64,
        /// The limit, mm.
        limit_mm: f64,
    },
    /// Sections along a line: the tilt recedes by more than the limit.
    Tilt {
        /// Height that recedes over the width, mm.
        by_mm: f64,
        /// The limit, mm.
        limit_mm: f64,
    },
    /// Sections along a line: a crown is tilted.
    TiltedCrown,
    /// Sections along a line: the contact of a crown grows to the ends of the width.
    CrownToEnds {
        /// Expected half-length of the contact across the sliding direction, mm.
        half_length_mm: f64,
        /// Half of the width, mm.
        half_width_mm: f64,
    },
    /// A point contact of half-spaces: the contact of a crown stays within the width.
    Crown {
        /// Length of the unworn contact across the sliding direction over that along it.
        aspect: f64,
        /// Expected half-length of the contact across the sliding direction, mm.
        half_length_mm: f64,
        /// Half of the width, mm.
        half_width_mm: f64,
    },
}

/// The dimension for a scene under its mean line load, which is also given as a point contact if it has a crown.
pub fn choose(plane: &Scene, as_point: Option<&Scene>, extent: Extent) -> Choice {
    let Extent {
        width_mm,
        crown_radius_mm,
        tilt_mrad,
    } = extent;
    let half_width_mm = 0.5 * width_mm;
    let crown =
        crown_radius_mm.map_or(0.0, |radius| half_width_mm * half_width_mm / (2.0 * radius));
    let by_mm = crown + 1e-3 * tilt_mrad.abs() * width_mm;
    if by_mm <= 0.0 {
        return Choice::Straight;
    }
    let depth = |scene: &Scene| {
        let hertz = hertz_half_width(scene);
        let cycles = expected_cycles(scene, hertz);
        let worn = worn_depth_after(scene, hertz, &scene.surface_wear(), cycles);
        worn.slider.max(worn.receptacle)
    };
    let limit_mm = SHARE * plane.accuracy.tolerance * depth(plane);
    if by_mm <= limit_mm {
        return Choice::Recedes { by_mm, limit_mm };
    }
    let round = as_point.and_then(|scene| Some((scene, half_lengths_mm(scene)?)));
    let (Some((scene, (along, across))), Some(radius)) = (round, crown_radius_mm) else {
        return Choice::Tilt { by_mm, limit_mm };
    };
    let half_length_mm = (across * across + 2.0 * radius * depth(scene)).sqrt();
    if tilt_mrad != 0.0 {
        Choice::TiltedCrown
    } else if half_length_mm > half_width_mm {
        Choice::CrownToEnds {
            half_length_mm,
            half_width_mm,
        }
    } else {
        Choice::Crown {
            aspect: across / along,
            half_length_mm,
            half_width_mm,
        }
    }
}
