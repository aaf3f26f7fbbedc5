//! Unworn contact of a crowned or tilted line, for the choice of its sections and for estimates.
//!
//! In plane strain the line load of a section grows about in proportion to its approach, P' = c E* delta, with the logarithm of the height of
//! the bodies in c = 0.6 (that of Hertz' ellipse with half-lengths in the ratio 8 is 0.63). Where the gap is z^2/(2 R_c) about the lowest
//! place,
//!   P' = c E* l^2/(2 R_c),  F = (4/3) l P'  ->  l = (3 F R_c/(2 c E*))^(1/3),  P' = 3 F/(4 l);
//! where one end of a tilt t is lowest, P' = c E* t l, F = P' l/2 -> l = sqrt(2 F/(c E* t)), P' = 2 F/l. A crown whose lowest place lies
//! beyond an end has the slope there as tilt.
//!
//! l: length of the contact from the lowest place on, mm. Limiting case: l at least the width, P' = F/w.

use crate::law::elastic::contact_modulus;
use crate::scene::{Line, LineShape, Scene};

/// c, -.
const LOAD_PER_APPROACH: f64 = 0.6;

/// The unworn contact of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The place that touches first, mm from the middle.
    pub at_mm: f64,
    /// How far the contact reaches from there, mm.
    pub length_mm: f64,
    /// Largest line load, N/mm.
    pub line_load: f64,
}

/// The contact of a line of a scene.
pub(crate) fn touch_of(scene: &Scene, line: &Line) -> Touch {
    let modulus = contact_modulus(scene.slider.elastic, scene.receptacle.elastic);
    touch(line.shape, line.force_n, modulus)
}

/// Largest line load of the unworn contact of a scene, N/mm: its own of a section.
pub(super) fn largest_line_load(scene: &Scene) -> f64 {
    let line = scene.dimension.line();
    line.map_or(scene.load_n_per_mm, |line| touch_of(scene, line).line_load)
}

/// The contact of a line under a force in N, of bodies with a contact modulus in MPa.
pub fn touch(shape: LineShape, force: f64, modulus: f64) -> Touch {
    let length = shape.length_mm();
    let even = Touch {
        at_mm: 0.0,
        length_mm: length,
        line_load: force / length,
    };
    let LineShape::Straight {
        width_mm,
        crown_radius_mm,
        tilt_mrad,
    } = shape
    else {
        return even;
    };
    let (half, tilt) = (0.5 * width_mm, 1e-3 * tilt_mrad);
    let stiffness = LOAD_PER_APPROACH * modulus;
    let lowest = crown_radius_mm.map(|radius| -tilt * radius);
    let inside = lowest.filter(|lowest| lowest.abs() < half);
    let found = if let (Some(at_mm), Some(radius)) = (inside, crown_radius_mm) {
        let length_mm = (1.5 * force * radius / stiffness).cbrt();
        Touch {
            at_mm,
            length_mm,
            line_load: 0.75 * force / length_mm,
        }
    } else {
        let slope = tilt.abs() - crown_radius_mm.map_or(0.0, |radius| half / radius);
        if slope <= 0.0 {
            return even;
        }
        let length_mm = (2.0 * force / (stiffness * slope)).sqrt();
        Touch {
            at_mm: -half * tilt.signum(),
            length_mm,
            line_load: 2.0 * force / length_mm,
        }
    };
    if found.line_load > even.line_load {
        found
    } else {
        Touch {
            at_mm: found.at_mm,
            ..even
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Touch;
    use crate::scene::LineShape;
    fn touch(crown_radius_mm: Option<f64>, tilt_mrad: f64) -> Touch {
        let shape = LineShape::Straight {
            width_mm: 0.8,
            crown_radius_mm,
            tilt_mrad,
        };
        super::touch(shape, 0.5, 68_939.0)
    }

    /// Hertz' ellipse of 0.4 and 10 mm under 0.5 N on copper: half-lengths of 7.0 and 55.6 um, 6.74 N/mm in the middle.
    #[test]
    fn a_crown_has_about_the_contact_of_its_ellipse() {
        let found = touch(Some(10.0), 0.0);
        assert!((found.length_mm / 0.0556 - 1.0).abs() < 0.03, "{found:?}");
        assert!((found.line_load / 6.74 - 1.0).abs() < 0.03, "{found:?}");
    }

    #[test]
    fn a_tilt_touches_at_its_lower_end_or_on_the_crown() {
        let end = touch(None, 1.0);
        assert!((end.at_mm + 0.4).abs() < 1e-15 && end.line_load > 0.625);
        assert!((end.line_load * end.length_mm - 1.0).abs() < 1e-12);
        let crown = touch(Some(10.0), 10.0);
        assert!((crown.at_mm + 0.1).abs() < 1e-15);
        let beyond = touch(Some(10.0), -100.0);
        assert!((beyond.at_mm - 0.4).abs() < 1e-15);
        let even = touch(None, 0.0);
        assert!((even.line_load - 0.625).abs() < 1e-15);
    }
}
