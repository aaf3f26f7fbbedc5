//! Places of the sections of a line in space: x along the motion, y up, z across the motion. The ring lies in the plane of x and z around
//! the origin; the middle of a straight line is the origin.
//!
//! Sections of half a line are mirrored at the plane z = 0, which the motion lies in: what points along the line changes its sign.

use solver::along_line::Along;
use solver::fields::Stress;
use solver::scene::LineShape;

use crate::number::real;

/// A ring of so few sections, at 0 and 180 degrees, has all sections alike: the first one is turned around.
const ALIKE: usize = 2;
/// Sections of such a ring, whose straight edges take 0.2 % of its volume.
const ROUND: usize = 64;

/// A section in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    /// Number of the section.
    pub(super) section: usize,
    /// 1, or -1 of a mirrored section.
    along: f64,
    /// Distance of the section's origin from the axis of the ring, mm.
    radius: f64,
    /// Distance from the middle of a straight line, mm.
    z: f64,
    /// Cosine and sine of the angle of a ring.
    direction: [f64; 2],
}

/// All sections in the order in which neighbours are joined, and whether the last is joined with the first.
pub(super) fn planes(shape: LineShape, at: &[Along]) -> (Vec<Plane>, bool) {
    let placed = |section: usize, sign: f64| {
        let along = sign;
        match (shape, at[section]) {
            (LineShape::Ring { radius_mm, .. }, Along::AngleDeg(theta)) => Plane {
                section,
                along,
                radius: radius_mm,
                z: 0.0,
                direction: direction(sign * theta),
            },
            (_, Along::AngleDeg(place) | Along::DistanceMm(place)) => Plane {
                section,
                along,
                radius: 0.0,
                z: sign * place,
                direction: [1.0, 0.0],
            },
        }
    };
    if matches!(shape, LineShape::Ring { .. }) && at.len() == ALIKE {
        let turned = (0..ROUND).map(|number| Plane {
            direction: direction(360.0 * real(number) / real(ROUND)),
            ..placed(0, 1.0)
        });
        return (turned.collect(), true);
    }
    let given = (0..at.len()).map(|section| placed(section, 1.0));
    let last = at.len().saturating_sub(1);
    match shape {
        LineShape::Ring { .. } => {
            let other_half = (1..last).rev().map(|section| placed(section, -1.0));
            (given.chain(other_half).collect(), true)
        }
        LineShape::Straight { tilt_mrad: 0.0, .. } => {
            let other_half = (1..=last).rev().map(|section| placed(section, -1.0));
            (other_half.chain(given).collect(), false)
        }
        LineShape::Straight { .. } => (given.collect(), false),
    }
}

/// Shortest distance between neighbouring sections of a straight line, mm; infinite of a ring, whose sections are far apart.
pub(super) fn shortest_gap(planes: &[Plane]) -> f64 {
    let gaps = planes.windows(2).map(|pair| (pair[1].z - pair[0].z).abs());
    let gaps = gaps.filter(|gap| *gap > 0.0);
    gaps.fold(f64::INFINITY, f64::min)
}

/// Cosine and sine of an angle in degrees; exactly 0 and 1 in quarters, so that both halves meet.
fn direction(degrees: f64) -> [f64; 2] {
    let quarter = degrees.abs() / 90.0;
    let (cosine, sine) = match quarter {
        0.0 => (1.0, 0.0),
        1.0 => (0.0, 1.0),
        2.0 => (-1.0, 0.0),
        _ => (degrees.to_radians().cos(), degrees.abs().to_radians().sin()),
    };
    [cosine, if degrees < 0.0 { -sine } else { sine }]
}

impl Plane {
    /// Place in space of a place across the line and up, mm.
    pub(super) fn place(&self, [across, up]: [f64; 2]) -> [f64; 3] {
        let [cos, sin] = self.direction;
        let rho = self.radius + across;
        [rho * cos, up, self.z + rho * sin]
    }

    /// A vector of the section in space.
    pub(super) fn vector(&self, [across, up, along]: [f64; 3]) -> [f64; 3] {
        let [cos, sin] = self.direction;
        let along = self.along * along;
        [across * cos - along * sin, up, across * sin + along * cos]
    }

    /// A stress of the section in space.
    pub(super) fn stress(&self, s: &Stress) -> Stress {
        let [cos, sin] = self.direction;
        let (xz, yz) = (self.along * s.xz, self.along * s.yz);
        let double = 2.0 * sin * cos * xz;
        Stress {
            xx: s.xx * cos * cos + s.zz * sin * sin - double,
            yy: s.yy,
            zz: s.xx * sin * sin + s.zz * cos * cos + double,
            xy: s.xy * cos - yz * sin,
            xz: (s.xx - s.zz) * sin * cos + xz * (cos * cos - sin * sin),
            yz: s.xy * sin + yz * cos,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use solver::scene::RingMotion;

    #[test]
    fn two_sections_that_are_alike_make_a_round_ring() {
        let ring = LineShape::Ring {
            radius_mm: 0.5,
            motion: RingMotion::InPlane,
        };
        let (planes, closed) = planes(ring, &[0.0, 180.0].map(Along::AngleDeg));
        assert!(closed && planes.len() == ROUND);
        assert!(planes.iter().all(|plane| plane.section == 0));
        let [x, _, z] = planes[ROUND / 4].place([0.1, 0.0]);
        assert!(x.abs() < 1e-15 && (z - 0.6).abs() < 1e-15);
    }

    #[test]
    fn a_stress_is_the_same_in_space() {
        let stress = Stress {
            xx: -3.0,
            yy: -5.0,
            zz: -2.0,
            xy: 1.0,
            xz: 0.5,
            yz: -0.7,
        };
        let ring = LineShape::Ring {
            radius_mm: 0.5,
            motion: RingMotion::InPlane,
        };
        let at = [0.0, 30.0, 90.0, 180.0].map(Along::AngleDeg);
        let (planes, closed) = planes(ring, &at);
        assert!(closed && planes.len() == 6);
        for plane in &planes {
            let turned = plane.stress(&stress);
            assert!((turned.von_mises() - stress.von_mises()).abs() < 1e-12);
            // Traction on the plane whose normal is along the line, to larger angles.
            let normal = plane.vector([0.0, 0.0, plane.along]);
            let found = [
                turned.xx * normal[0] + turned.xz * normal[2],
                turned.xy * normal[0] + turned.yz * normal[2],
                turned.xz * normal[0] + turned.zz * normal[2],
            ];
            // Of a mirrored section both the normal and the shear along the line point the other way.
            let own = [stress.xz, stress.yz, stress.zz].map(|t| plane.along * t);
            let expected = plane.vector(own);
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12, "{plane:?}");
            }
        }
    }
}
