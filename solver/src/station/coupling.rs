//! Coupling of sections in plane strain by their line loads: one that varies along the line, P = sum_n P_n cos(n pi s/l), lifts the
//! section at s, against one alone, by
//!   e(s) = sum_n delta_n P_n cos(n pi s/l),  delta_n = C_n - C_0,
//! C_n the compliance of both bodies under the wave (`condensation::harmonic`), C_0 that of an even load with both far faces held. n = 0
//! changes nothing. l is the length of the line that the stations lie on: a half ring, half of a straight line, or all of one with a
//! tilt; at its ends the waves are level, as of a line that continues beyond them in mirror image.
//!
//! `e_j = sum_k D_jk P_k`: between stations line loads are linear, along a ring, where stations are evenly spaced, the sum of waves.
//! Limiting case: 2 (1 - nu^2)/(pi E) ln(1/k) of each body for waves between the lengths of contact and body, so that Hertz' ellipses have
//! their line load whatever the height of the bodies.

use std::f64::consts::PI;

use super::place::Place;
use super::scene::StationScene;
use crate::along_line::SectionsError;
use crate::closed_form::unworn_contact;
use crate::condensation::harmonic::{FarFace, harmonic_compliances};
use crate::effects::EffectsPlan;
use crate::element::harmonic::Waves;
use crate::linear::SquareMatrix;
use crate::model;
use crate::number::{count_at_least, real};
use crate::scene::{Accuracy, LineShape, Scene, Top};
use crate::sides::Side;

/// Tolerance that the sections are meshed for.
const TOLERANCE: f64 = 0.1;
/// Waves whose compliance is computed one by one; beyond them each is so many times as short as the last.
const SINGLE_WAVES: usize = 8;
const RATIO: f64 = std::f64::consts::SQRT_2;
/// Shortest wave over the smallest spacing of stations. Arbitrary: linear functions between stations have a hundredth of their amplitude there.
const SHORTEST: f64 = 0.25;
/// Largest k b, b the half-width of the contact, beyond which line loads lift a section as there: such waves say how pressures are distributed
/// across it, which is not known of a line load.
const SHORTEST_OVER_WIDTH: f64 = 1.0;
/// Waves up to which a ring is a rigid body where its top is free to lift.
const RIGID_WAVES: usize = 1;

/// D, mm per N/mm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Coupling(SquareMatrix);

impl Coupling {
    /// Coupling of the places of a scene with its plane section; `None` where sections are solved alone.
    ///
    /// # Errors
    /// A section that cannot be meshed or condensed.
    pub(super) fn of(
        scene: &StationScene,
        plane: &Scene,
        plan: &EffectsPlan,
        places: &[Place],
    ) -> Result<Option<Self>, SectionsError> {
        if !scene.is_coupled() || places.len() < 3 {
            return Ok(None);
        }
        let along: Vec<f64> = places.iter().map(Place::along_mm).collect();
        let (first, length) = (along[0], along[along.len() - 1] - along[0]);
        let spacings = along.windows(2).map(|pair| pair[1] - pair[0]);
        let smallest = spacings.fold(f64::INFINITY, f64::min);
        let radius_mm = match scene.line {
            LineShape::Ring { radius_mm, .. } => Some(radius_mm),
            LineShape::Straight { .. } => None,
        };
        let evenly_spaced = radius_mm.is_some();
        let most = if evenly_spaced {
            places.len() - 1
        } else {
            count_at_least(length / (SHORTEST * smallest))
        };
        let line_load = scene.touch().line_load;
        let per_load = lifts(scene.top, radius_mm, plane, plan, line_load, length, most)?;
        let phase = |j: usize, n: usize| PI * real(n) * (along[j] - first) / length;
        let whole: f64 = places.iter().map(|place| place.weight_mm).sum();
        let mut matrix = SquareMatrix::zeros(places.len());
        for (n, lift) in (1..).zip(&per_load) {
            let wave = PI * real(n) / length;
            for (k, place) in places.iter().enumerate() {
                let part = if evenly_spaced {
                    // The last wave has nodes between all stations, and its square the mean 1 on them instead of 1/2.
                    let share = if n == most { 0.5 } else { 1.0 };
                    share * place.weight_mm * length / whole * phase(k, n).cos()
                } else {
                    under_hat(&along, k, |j| phase(j, n).cos()) / (wave * wave)
                };
                let part = 2.0 / length * lift * part;
                for j in 0..places.len() {
                    *matrix.at(j, k) += part * phase(j, n).cos();
                }
            }
        }
        Ok(Some(Self(matrix)))
    }

    /// Number of stations.
    pub(super) fn order(&self) -> usize {
        self.0.order()
    }

    /// `D_jk`, mm per N/mm.
    pub(super) fn per_load(&self, j: usize, k: usize) -> f64 {
        self.0.get(j, k)
    }

    /// Lift of a station under line loads in N/mm, mm.
    pub(super) fn lift(&self, j: usize, loads: impl Iterator<Item = f64>) -> f64 {
        let parts = loads
            .enumerate()
            .map(|(k, load)| self.per_load(j, k) * load);
        parts.sum()
    }
}

/// Integral of cos(k s) over the linear function that is 1 at a station and 0 at its neighbours, times k^2. cos is level at both ends.
fn under_hat(along: &[f64], k: usize, cos: impl Fn(usize) -> f64) -> f64 {
    let slope = |j: usize| (cos(j + 1) - cos(j)) / (along[j + 1] - along[j]);
    let before = k.checked_sub(1).map_or(0.0, &slope);
    let after = if k + 1 < along.len() { slope(k) } else { 0.0 };
    before - after
}

/// `delta_n` of the waves 1 to `most` along a length, mm per N/mm: computed of some, and linear in ln n between them.
fn lifts(
    top: Top,
    radius_mm: Option<f64>,
    plane: &Scene,
    plan: &EffectsPlan,
    line_load: f64,
    length: f64,
    most: usize,
) -> Result<Vec<f64>, SectionsError> {
    let mut computed = vec![0];
    while let Some(last) = computed.last().copied().filter(|last| *last < most) {
        computed.push(if last < SINGLE_WAVES {
            last + 1
        } else {
            count_at_least(real(last) * RATIO)
        });
    }
    let tolerance = plane.accuracy.tolerance.max(TOLERANCE);
    let coarse = Scene {
        load_n_per_mm: line_load,
        accuracy: Accuracy::from_tolerance(tolerance),
        ..plane.clone()
    };
    let model = model::build(&coarse, plan)?;
    let half_width = unworn_contact::hertz_half_width(&coarse);
    let shortest = SHORTEST_OVER_WIDTH / half_width;
    let waves = |n: usize, side: Side| {
        let lifts = top == Top::Pressure && side == Side::Slider && n > RIGID_WAVES;
        let far = if lifts {
            FarFace::HeldInPlane
        } else {
            FarFace::Held
        };
        let waves = Waves {
            per_mm: (PI * real(n) / length).min(shortest),
            radius_mm: radius_mm.filter(|_| n > 0),
        };
        (waves, far)
    };
    let mut sums = vec![0.0; computed.len()];
    for side in Side::BOTH {
        let waves: Vec<_> = computed.iter().map(|&n| waves(n, side)).collect();
        let body = model.bodies.of(side);
        let compliances = harmonic_compliances(body, side, half_width, &waves)?;
        for (sum, compliance) in sums.iter_mut().zip(&compliances) {
            *sum += compliance - compliances[0];
        }
    }
    let between = |n: usize| {
        let upper = computed.partition_point(|&m| m < n);
        let (low, high) = (computed[upper - 1], computed[upper]);
        if high == n {
            return sums[upper];
        }
        let share = (real(n) / real(low)).ln() / (real(high) / real(low)).ln();
        sums[upper - 1] + share * (sums[upper] - sums[upper - 1])
    };
    Ok((1..=most).map(between).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;

    /// Why a ring under a rigid top is not coupled: lifts of a load that varies by its mean, over the 16 um that the thesis' ring is worn by in 1 000
    /// cycles under 0.275 N/mm.
    #[test]
    fn a_ring_under_a_rigid_top_needs_no_coupling() {
        const WORN_MM: f64 = 0.016;
        let plane = Scene {
            load_n_per_mm: 0.275,
            ..fuzz_button()
        };
        let plan = crate::effects::plan(&plane);
        let (radius_mm, waves) = (0.4826, 16);
        let found = lifts(
            Top::Rigid,
            Some(radius_mm),
            &plane,
            &plan,
            plane.load_n_per_mm,
            PI * radius_mm,
            waves,
        );
        let found = found.expect("the sections can be condensed");
        let largest = found
            .iter()
            .fold(0.0, |most: f64, lift| most.max(lift.abs()));
        let part = plane.load_n_per_mm * largest / WORN_MM;
        assert!(part < 3e-5, "{part}");
    }
}
