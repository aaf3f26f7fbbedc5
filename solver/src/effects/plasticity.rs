//! First yield of the unworn contact, which is simulated as elastic: by Hertz' peak pressure p0 over the hardness H that carries it.
//!
//! Matter below the surface yields from p0 = 1.60 Y of a point and 1.79 Y of a line on (von Mises; Johnson, Contact Mechanics, 1985, section
//! 6.1), at the surface of a contact that slides from mu p0 = Y/sqrt 3 on (section 7.1). An indentation hardness is about three times
//! the yield strength Y (Tabor, The Hardness of Metals, 1951).
//!
//! Above the onset, what yields is enclosed by elastic matter; from p0 = H on the surface sinks. Its permanent depth e is that of elastic
//! half-spaces whose pressure is bounded by H. Computed for p0/H of 1.25 and 2, and a power of p0/H - 1 through both:
//!   line   e = 1.777 (p0/H - 1)^1.345 a^2/(2 R)     0.2753, 1.777
//!   point  e = 0.3995 (p0/H - 1)^1.116 a b/R        0.0851, 0.3995
//!
//! Layers carry a contact of the half-width a that is small against their thickness, and bases one that is large: the hardness of what lies
//! above a depth t counts with the share ln(10 t/a)/ln 10, from 0 at t = a/10 to 1 at t = a. Assumed.

use serde::{Deserialize, Serialize};

use crate::closed_form::unworn_contact;
use crate::closed_form::{PointScene, SlipRegime};
use crate::law::plating::{Layer, bottoms};
use crate::scene::{Scene, Softening};
use crate::sides::{Side, Sides};

/// Yield strength over hardness.
const STRENGTH: f64 = 1.0 / 3.0;
/// Peak pressure over yield strength at which matter below the surface yields.
const ONSET_OF_POINT: f64 = 1.60;
const ONSET_OF_LINE: f64 = 1.79;
/// Depth over the half-width of the contact down to which layers carry nothing.
const THIN: f64 = 0.1;

/// The unworn peak pressure beside the hardnesses of the side that yields first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Yield {
    /// Hertz' peak pressure, MPa.
    pub peak_mpa: f64,
    /// The side.
    pub side: Side,
    /// Hardnesses of the side.
    pub hardness: Hardness,
    /// Permanent depth, mm; 0 up to the hardness.
    pub depth_mm: f64,
}

/// Hardnesses of a side, MPa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Hardness {
    /// Of its outermost layer, or of the bare base.
    pub outermost: f64,
    /// Of its base.
    pub base: f64,
    /// Of what carries the contact.
    pub carrying: f64,
}

/// Sizes of the unworn contact.
struct Size {
    /// Half-width of a line, mean half-length of an ellipse, mm.
    half_width_mm: f64,
    /// a^2/(2 R) of a line, a b/R of a point, mm.
    approach_mm: f64,
    is_point: bool,
}

impl Yield {
    /// Of a scene; `None` where a hardness is not known.
    pub(super) fn of(scene: &Scene) -> Option<Self> {
        let size = Size::of(scene);
        let of = |plating: &[Layer], softening: &Softening| {
            Hardness::of(plating, &softening.hardness_mpa, size.half_width_mm)
        };
        let (slider, receptacle) = (&scene.slider, &scene.receptacle);
        let hardness = Sides {
            slider: of(&slider.plating, &slider.softening)?,
            receptacle: of(&receptacle.plating, &receptacle.softening)?,
        };
        let carrying = hardness.as_ref().map(|side| side.carrying);
        let side = if carrying.slider < carrying.receptacle {
            Side::Slider
        } else {
            Side::Receptacle
        };
        let peak_mpa = unworn_contact::hertz_peak_pressure(scene);
        Some(Self {
            peak_mpa,
            side,
            hardness: *hardness.of(side),
            depth_mm: size.permanent_depth_mm(peak_mpa / carrying.of(side)),
        })
    }

    /// Peak pressure over the hardness that carries the contact, -.
    pub fn ratio(&self) -> f64 {
        self.peak_mpa / self.hardness.carrying
    }
}

impl Hardness {
    /// Of a side with these hardnesses of its layers from the surface down and of its base, MPa.
    fn of(plating: &[Layer], known_mpa: &[Option<f64>], half_width_mm: f64) -> Option<Self> {
        let known: Option<Vec<f64>> = known_mpa.iter().copied().collect();
        let known = known.filter(|known| known.len() == plating.len() + 1)?;
        let (mut carrying, mut above) = (0.0, 0.0);
        for (bottom, hardness) in bottoms(plating).chain([f64::INFINITY]).zip(&known) {
            let share = share_above(bottom, half_width_mm);
            carrying += hardness * (share - above);
            above = share;
        }
        Some(Self {
            outermost: known[0],
            base: known[known.len() - 1],
            carrying,
        })
    }
}

/// Share in carrying the contact of what lies above a depth.
fn share_above(depth_mm: f64, half_width_mm: f64) -> f64 {
    let share = (depth_mm / (THIN * half_width_mm)).ln() / THIN.recip().ln();
    share.clamp(0.0, 1.0)
}

impl Size {
    fn of(scene: &Scene) -> Self {
        if let Some(contact) = PointScene::of(scene, SlipRegime::Gross) {
            let (along, across) = contact.half_lengths_mm();
            let (radius_along, radius_across) = contact.radii_mm();
            return Self {
                half_width_mm: (along * across).sqrt(),
                approach_mm: along * across / (radius_along * radius_across).sqrt(),
                is_point: true,
            };
        }
        let half_width_mm = unworn_contact::largest_half_width(scene);
        Self {
            half_width_mm,
            approach_mm: 0.5 * half_width_mm * half_width_mm / unworn_contact::radius(scene),
            is_point: false,
        }
    }

    fn permanent_depth_mm(&self, ratio: f64) -> f64 {
        let beyond = (ratio - 1.0).max(0.0);
        let depth = if self.is_point {
            0.3995 * beyond.powf(1.116)
        } else {
            1.777 * beyond.powf(1.345)
        };
        depth * self.approach_mm
    }
}

/// Peak pressure over hardness at which a scene begins to yield, with the largest coefficient of friction of its run, -.
pub(super) fn onset(scene: &Scene, friction: f64) -> f64 {
    let below = if scene.dimension.point().is_some() {
        ONSET_OF_POINT
    } else {
        ONSET_OF_LINE
    };
    let at_surface = 1.0 / (3.0_f64.sqrt() * friction);
    STRENGTH * below.min(at_surface)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(thickness_mm: f64) -> Layer {
        Layer {
            thickness_mm,
            rate_per_mpa: 1e-8,
        }
    }

    #[test]
    fn a_thin_layer_is_carried_by_its_base_and_a_thick_one_carries() {
        let carrying = |plating: &[Layer], known: &[f64]| {
            let known: Vec<_> = known.iter().copied().map(Some).collect();
            let found = Hardness::of(plating, &known, 1e-2).expect("they are known");
            found.carrying
        };
        let is = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-12;
        assert!(is(carrying(&[], &[427.0]), 427.0));
        assert!(is(carrying(&[layer(0.76e-3)], &[1_700.0, 427.0]), 427.0));
        assert!(is(carrying(&[layer(1e-2)], &[1_700.0, 427.0]), 1_700.0));
        let middle = carrying(&[layer(1e-2 / 10.0_f64.sqrt())], &[1_700.0, 427.0]);
        assert!(is(middle, 0.5 * (1_700.0 + 427.0)));
        // Layers of one hardness are one layer.
        let halves = [layer(1.5e-3), layer(1.5e-3)];
        let one = carrying(&[layer(3e-3)], &[1_700.0, 427.0]);
        assert!(is(carrying(&halves, &[1_700.0, 1_700.0, 427.0]), one));
        assert_eq!(Hardness::of(&[], &[None], 1e-2), None);
        assert_eq!(Hardness::of(&[], &[], 1e-2), None);
    }

    /// Computed values; see above.
    #[test]
    fn the_permanent_depth_is_that_of_a_bounded_pressure() {
        let depth = |is_point, ratio| {
            let size = Size {
                half_width_mm: 1.0,
                approach_mm: 1.0,
                is_point,
            };
            size.permanent_depth_mm(ratio)
        };
        let values = [
            (false, 1.25, 0.2753),
            (false, 2.0, 1.777),
            (true, 1.25, 0.0851),
            (true, 2.0, 0.3995),
        ];
        for (is_point, ratio, expected) in values {
            // To the digits of the exponents.
            assert!((depth(is_point, ratio) / expected - 1.0).abs() < 2e-3);
            assert!(depth(is_point, 1.0) <= 0.0);
        }
    }
}
