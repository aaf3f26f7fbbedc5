//! Where a station lies on the line, and how its section moves.

use std::f64::consts::PI;

use super::spacing;
use crate::along_line::Along;
use crate::closed_form::line_contact::Touch;
use crate::number::real;
use crate::scene::{LineShape, RingMotion};

/// Places are multiples of its inverse, mm: far below any spacing.
const PER_MM: f64 = 1e12;

/// A station on its line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub(super) at: Along,
    /// Length of the line that it stands for, mm.
    pub(super) weight_mm: f64,
    /// Height of the slider's unworn surface over that of the lowest station, mm.
    pub(super) raised_mm: f64,
    /// Cosine and sine of the direction of motion against the section.
    direction: [f64; 2],
    /// Radius of a ring that moves in its plane, mm.
    radius_mm: Option<f64>,
}

/// Imposed displacement of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Displaced {
    /// Position of the slider's section, mm.
    pub(super) slider_x: f64,
    /// Slip across the line beyond its displacement, mm.
    pub(super) surface_slip: f64,
    /// Slip along the line, mm.
    pub(super) along: f64,
}

/// Evenly spaced places: a half ring, which stands for both, or a straight line, of which a half stands for both without a tilt.
/// The sections of a straight line are evenly spaced in the unworn contact, which reaches from the place that touches first as far as `touch` says
/// and has so many intervals, and farther apart beyond.
pub(super) fn places(line: LineShape, stations: usize, touch: Touch, within: usize) -> Vec<Place> {
    let spacings = real(stations - 1);
    let share = |j: usize| {
        if j == 0 || j == stations - 1 {
            0.5
        } else {
            1.0
        }
    };
    match line {
        LineShape::Ring { radius_mm, motion } => (0..stations)
            .map(|j| {
                let theta = PI * real(j) / spacings;
                let (direction, radius_mm) = match motion {
                    RingMotion::InPlane => ([theta.cos(), theta.sin()], Some(radius_mm)),
                    RingMotion::Torsion => ([0.0, 1.0], None),
                };
                Place {
                    at: Along::AngleDeg(180.0 * real(j) / spacings),
                    weight_mm: share(j) * line.length_mm() / spacings,
                    raised_mm: 0.0,
                    direction,
                    radius_mm,
                }
            })
            .collect(),
        LineShape::Straight {
            crown_radius_mm,
            tilt_mrad,
            ..
        } => {
            let (left, right) = spacing::sides(line, touch.at_mm);
            let count = spacing::divided(stations - 1, left, right);
            let from = |length, count| spacing::places(length, touch.length_mm, within, count);
            let before = from(left, count.0).into_iter().skip(1).rev();
            let after = from(right, count.1);
            let at: Vec<f64> = before
                .filter(|_| left > 0.0)
                .map(|distance| touch.at_mm - distance)
                .chain(after.into_iter().map(|distance| touch.at_mm + distance))
                .map(rounded)
                .collect();
            // Half of a symmetric line stands for both halves; a tilted one that touches first at an end has all of its sections to one side.
            let both = if tilt_mrad == 0.0 { 2.0 } else { 1.0 };
            let z = |j: usize| at[j];
            let weight = |j: usize| {
                let last = stations - 1;
                0.5 * both * (at[(j + 1).min(last)] - at[j.saturating_sub(1)])
            };
            let height = |z: f64| {
                let crown = crown_radius_mm.map_or(0.0, |radius| z * z / (2.0 * radius));
                crown + 1e-3 * tilt_mrad * z
            };
            let heights = (0..stations).map(|j| height(z(j)));
            let lowest = heights.fold(f64::INFINITY, f64::min);
            (0..stations)
                .map(|j| Place {
                    at: Along::DistanceMm(z(j)),
                    weight_mm: weight(j),
                    raised_mm: height(z(j)) - lowest,
                    direction: [1.0, 0.0],
                    radius_mm: None,
                })
                .collect()
        }
    }
}

/// A place without the round-off in its last digits, mm.
fn rounded(mm: f64) -> f64 {
    (mm * PER_MM).round() / PER_MM
}

impl Place {
    /// Distance along the line, mm.
    pub(super) fn along_mm(&self) -> f64 {
        match self.at {
            Along::AngleDeg(degrees) => self.radius_mm.unwrap_or_default() * degrees.to_radians(),
            Along::DistanceMm(z) => z,
        }
    }

    /// Position of the slider's section as the slider is displaced by u, mm.
    pub(super) fn position(&self, u: f64) -> f64 {
        let [cos, sin] = self.direction;
        let recedes = self.radius_mm.map_or(0.0, |radius| {
            let half_chord = u * sin;
            // sqrt(R^2 - c^2) - R without cancellation.
            half_chord * half_chord
                / (radius + (radius * radius - half_chord * half_chord).max(0.0).sqrt())
        });
        u * cos - recedes
    }

    /// Displacement of the section as that of the slider changes, mm.
    pub(super) fn displaced(&self, from: f64, to: f64) -> Displaced {
        let [cos, sin] = self.direction;
        let slider_x = self.position(to);
        Displaced {
            slider_x,
            surface_slip: (to - from) * cos - (slider_x - self.position(from)),
            along: (to - from) * sin,
        }
    }

    /// Cosine and sine of the direction of motion against the section.
    pub(super) fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// Amplitude of the section's motion across the line for that of the slider, mm.
    pub(super) fn amplitude_mm(&self, amplitude: f64) -> f64 {
        let (right, left) = (self.position(amplitude), self.position(-amplitude));
        0.5 * (right.max(left).max(0.0) - right.min(left).min(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_form::line_contact::touch;

    fn placed(line: LineShape, stations: usize) -> Vec<Place> {
        places(line, stations, touch(line, 0.1, 1e5), 4)
    }

    #[test]
    fn a_ring_crosses_the_radial_sections_where_two_circles_meet() {
        let (radius_mm, u) = (0.4826, 0.033_868);
        for place in placed(
            LineShape::Ring {
                radius_mm,
                motion: RingMotion::InPlane,
            },
            9,
        ) {
            // A point of the displaced circle at this distance from the centre of the resting one.
            let distance = radius_mm + place.position(u);
            let [cos, sin] = place.direction;
            let (x, y) = (distance * cos - u, distance * sin);
            assert!(((x * x + y * y).sqrt() - radius_mm).abs() < 1e-15);
        }
    }

    #[test]
    fn slip_has_the_length_of_the_displacement() {
        for place in placed(
            LineShape::Ring {
                radius_mm: 0.5,
                motion: RingMotion::InPlane,
            },
            7,
        ) {
            let moved = place.displaced(-0.01, 0.02);
            let across = moved.slider_x - place.position(-0.01) + moved.surface_slip;
            assert!((across.hypot(moved.along) - 0.03).abs() < 1e-15);
        }
    }

    #[test]
    fn weights_add_up_to_the_length() {
        let line = LineShape::Straight {
            width_mm: 2.0,
            crown_radius_mm: Some(10.0),
            tilt_mrad: 1.0,
        };
        let straight = LineShape::Straight {
            width_mm: 2.0,
            crown_radius_mm: None,
            tilt_mrad: 0.0,
        };
        for line in [
            line,
            straight,
            LineShape::Ring {
                radius_mm: 0.5,
                motion: RingMotion::InPlane,
            },
        ] {
            let places = placed(line, 9);
            let sum: f64 = places.iter().map(|place| place.weight_mm).sum();
            assert!((sum - line.length_mm()).abs() < 1e-11);
            assert!(places.iter().all(|place| place.raised_mm >= 0.0));
        }
    }
}
