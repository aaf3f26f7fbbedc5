//! Grids of both bodies and the window of the contact, as numbers of cells.
//!
//! The slider's grid moves with it, by whole cells, so that nothing is interpolated: the amplitude is n cells long, and the slider's
//! position j = 0 .. 2 n lies (j - n) cells off the neutral one. The middle of the window lies c cells from the receptacle's place at
//! j = 0; over a flat receptacle c = j, over a convex one the contact travels less, c = n + (j - n) R_r/(R_s + R_r) rounded, and
//! moves over the slider for the rest. Amplitudes below half a cell are not resolved (n = 0): both surfaces wear in place, which
//! neglects the travel A against the length of the contact.
//!
//! The motions of a mission have one grid, on which the largest amplitude is n cells long and the others are whole numbers of cells nearly:
//! of the finer grids one is chosen that rounds them by little against the length of their scars.

use serde::{Deserialize, Serialize};

use super::field::Axis;
use crate::closed_form::{PointBody, PointScene};
use crate::contact::area::Cells;
use crate::number::{count_at_least, nearest, real};
use crate::sides::{Side, Sides};

/// Half-length of the window over that of the unworn contact. Arbitrary: windows widen.
const MARGIN: f64 = 1.4;

/// Error of an amplitude that is rounded to whole cells, over half of the length of its scar, up to which a grid is fine enough: the depth of
/// a groove goes with its inverse, and the tolerance is several times that.
const ROUNDING: f64 = 2e-3;
/// Most cells of the largest amplitude over the fewest, for amplitudes that no grid rounds by so little. Arbitrary.
const FINEST: f64 = 1.5;

/// Numbers and sizes of cells.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Lattice {
    /// Length and width of a cell, mm.
    pub(super) size_mm: (f64, f64),
    /// Cells of the largest amplitude, n, and its length, mm.
    pub(super) amplitude: usize,
    amplitude_mm: f64,
    /// Cells of the window on either side of its middle, along and across.
    window: (usize, usize),
    /// Part of the slider's displacement by which the contact travels over the receptacle.
    travel: f64,
}

/// Returns `true` if a contact is the same everywhere: that of a slider which wears alone on a plane.
pub(crate) fn is_steady(scene: &PointScene) -> bool {
    scene.bodies.receptacle.wear.is_none() && scene.travel_over_receptacle() >= 1.0
}

impl Lattice {
    /// The grids of an unworn contact for the amplitudes of all motions in which it slips as a whole, mm.
    pub(super) fn of(scene: &PointScene, amplitudes_mm: &[f64]) -> Self {
        let (along, across) = scene.half_lengths_mm();
        let cells = scene.accuracy.cells_per_half_length;
        let target = along / cells;
        let amplitudes = amplitudes_mm.iter().map(|amplitude| amplitude.abs());
        let amplitude_mm = amplitudes.clone().fold(0.0, f64::max);
        let travel = scene.travel_over_receptacle();
        let amplitude = if is_steady(scene) || amplitude_mm < 0.5 * target {
            0
        } else {
            let scars = amplitudes.map(|own| Scar {
                over_largest: own / amplitude_mm,
                half_length_over_largest: (own + along) / amplitude_mm,
            });
            let scars: Vec<Scar> = scars.collect();
            whole_cells(count_at_least(amplitude_mm / target), &scars)
        };
        let dx_mm = if amplitude == 0 {
            target
        } else {
            amplitude_mm / real(amplitude)
        };
        let dz_mm = across / cells;
        Self {
            size_mm: (dx_mm, dz_mm),
            amplitude,
            amplitude_mm,
            window: (
                count_at_least(MARGIN * along / dx_mm),
                count_at_least(MARGIN * cells),
            ),
            travel,
        }
    }

    /// Cells of the window on either side of its middle.
    pub(super) fn window(&self) -> (usize, usize) {
        self.window
    }

    /// The window.
    pub(super) fn cells(&self) -> Cells {
        Cells {
            along_x: 2 * self.window.0,
            along_z: 2 * self.window.1,
            dx_mm: self.size_mm.0,
            dz_mm: self.size_mm.1,
        }
    }

    /// Cells of a body's grid on either side of its middle.
    pub(super) fn half(&self, side: Side) -> (usize, usize) {
        let (along, across) = self.window;
        match side {
            Side::Slider => (along + self.slack(), across),
            Side::Receptacle => (along + self.amplitude, across),
        }
    }

    /// Position of the slider nearest to a displacement in mm of a motion in which all of the contact slips.
    pub(super) fn position(&self, displacement_mm: f64) -> usize {
        if self.amplitude == 0 {
            return 0;
        }
        let n = real(self.amplitude);
        nearest(n + n * (displacement_mm / self.amplitude_mm))
    }

    /// Returns `true` if an amplitude in mm is not resolved.
    pub(super) fn is_in_place(&self, amplitude_mm: f64) -> bool {
        self.position(amplitude_mm.abs()) == self.amplitude
    }

    /// Centres of the cells of a body's grid along the sliding direction, mm.
    pub(super) fn x_mm(&self, side: Side) -> impl Iterator<Item = f64> {
        let (half, length) = (self.half(side).0, self.size_mm.0);
        (0..2 * half).map(move |row| length * (real(row) - real(half) + 0.5))
    }

    /// Cells that the window may move over the slider to either side.
    fn slack(&self) -> usize {
        if self.travel < 1.0 { self.amplitude } else { 0 }
    }

    /// Position of the middle of the window on the receptacle for one of the slider.
    fn middle(&self, position: usize) -> usize {
        let n = real(self.amplitude);
        nearest(n + (real(position) - n) * self.travel)
    }

    /// First row of the window on a body's grid for a position of the slider.
    pub(super) fn first_row(&self, side: Side, position: usize) -> usize {
        let middle = self.middle(position);
        match side {
            Side::Slider => self.slack() + middle - position,
            Side::Receptacle => middle,
        }
    }

    /// Offset of the middle of the window from that of a body, mm.
    pub(super) fn offset_mm(&self, side: Side, position: usize) -> f64 {
        let middle = match side {
            Side::Slider => self.slack(),
            Side::Receptacle => self.amplitude,
        };
        self.size_mm.0 * (real(self.first_row(side, position)) - real(middle))
    }

    /// Gap of the unworn shapes at the cells of the window for a position of the slider, mm.
    pub(super) fn unworn_gap_mm(&self, scene: &PointScene, position: usize) -> Vec<f64> {
        let curvatures = scene.bodies.as_ref().map(PointBody::curvature);
        let offsets = Sides::from_fn(|side| self.offset_mm(side, position));
        self.cells().map(|x, z| {
            let height = |side| {
                let (along, across) = *curvatures.of(side);
                let x = x + offsets.of(side);
                0.5 * (along * x * x + across * z * z)
            };
            height(Side::Slider) + height(Side::Receptacle)
        })
    }

    /// Wider grids along the axes where the contact reaches the edge of the window.
    #[must_use]
    pub(super) fn widened(self, along: bool, across: bool) -> Self {
        let wider = |half: usize, is_wider: bool| {
            if is_wider {
                half + half.div_ceil(3)
            } else {
                half
            }
        };
        Self {
            window: (wider(self.window.0, along), wider(self.window.1, across)),
            ..self
        }
    }

    /// Grids of cells of twice the size along an axis, if the amplitude allows it.
    pub(super) fn coarsened(self, axis: Axis) -> Option<Self> {
        let (along, across) = self.window;
        match axis {
            Axis::Along if self.amplitude > 1 && !self.amplitude.is_multiple_of(2) => None,
            Axis::Along => Some(Self {
                size_mm: (2.0 * self.size_mm.0, self.size_mm.1),
                amplitude: self.amplitude / 2,
                window: ((along + 1).div_ceil(2), across),
                ..self
            }),
            Axis::Across => Some(Self {
                size_mm: (self.size_mm.0, 2.0 * self.size_mm.1),
                window: (along, across.div_ceil(2)),
                ..self
            }),
        }
    }
}

/// The scar of a motion, over the largest amplitude.
struct Scar {
    /// Amplitude of the motion.
    over_largest: f64,
    /// Half of the length of the scar.
    half_length_over_largest: f64,
}

/// Cells of the largest amplitude, at least so many, of which the amplitudes of all scars are nearly whole numbers.
fn whole_cells(least: usize, scars: &[Scar]) -> usize {
    let error = |cells: usize| {
        let rounded = scars.iter().map(|scar| {
            let own = real(cells) * scar.over_largest;
            (own - own.round()).abs() / (real(cells) * scar.half_length_over_largest)
        });
        rounded.fold(0.0, f64::max)
    };
    let first = often_even(least);
    let finest = nearest(FINEST * real(first));
    let mut cells = first;
    let mut best = first;
    while error(best) > ROUNDING && cells < finest {
        cells = often_even(cells + 1);
        if cells <= finest && error(cells) < error(best) {
            best = cells;
        }
    }
    best
}

/// The smallest number from this one on that can be halved until it is below 8, or a power of two below 8.
fn often_even(least: usize) -> usize {
    if least < 8 {
        return least.next_power_of_two();
    }
    let mut factor = 1;
    while least.div_ceil(factor) >= 8 {
        factor *= 2;
    }
    least.next_multiple_of(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_amplitudes_can_be_halved_often() {
        assert_eq!([1, 3, 7, 8, 9, 100].map(often_even), [1, 4, 8, 8, 10, 112]);
    }

    #[test]
    fn all_amplitudes_are_nearly_whole_numbers_of_cells() {
        let cells = |least, parts: &[f64]| {
            let scars = parts.iter().map(|part| Scar {
                over_largest: *part,
                half_length_over_largest: part + 0.1,
            });
            whole_cells(least, &scars.collect::<Vec<_>>())
        };
        assert_eq!(cells(100, &[1.0]), 112);
        assert_eq!(cells(9, &[1.0, 0.5]), 10);
        // 7.33 of 22 cells, 8 of 24.
        assert_eq!(cells(21, &[1.0, 1.0 / 3.0]), 24);
    }

    #[test]
    fn the_window_follows_the_contact_over_both_bodies() {
        let flat = Lattice {
            size_mm: (0.5, 1.0),
            amplitude: 8,
            amplitude_mm: 4.0,
            window: (4, 3),
            travel: 1.0,
        };
        for position in [0, 5, 16] {
            assert_eq!(flat.first_row(Side::Slider, position), 0);
            assert_eq!(flat.first_row(Side::Receptacle, position), position);
        }
        let convex = Lattice {
            travel: 0.25,
            ..flat
        };
        // 8 cells to the right: 2 on the receptacle, 6 to the left on the slider.
        assert!((convex.offset_mm(Side::Receptacle, 16) - 1.0).abs() < 1e-14);
        assert!((convex.offset_mm(Side::Slider, 16) + 3.0).abs() < 1e-14);
        let rows = convex.first_row(Side::Slider, 0) + 2 * convex.window.0;
        assert!(rows <= 2 * convex.half(Side::Slider).0);
    }

    #[test]
    fn coarser_grids_hold_what_finer_ones_held() {
        let mut lattice = Lattice {
            size_mm: (0.5, 1.0),
            amplitude: 8,
            amplitude_mm: 4.0,
            window: (5, 3),
            travel: 1.0,
        };
        let length = |lattice: &Lattice| lattice.size_mm.0 * real(lattice.half(Side::Receptacle).0);
        for _ in 0..5 {
            let before = length(&lattice);
            lattice = lattice.coarsened(Axis::Along).expect("8 is often even");
            assert!(length(&lattice) >= before);
        }
        assert_eq!(lattice.amplitude, 0);
    }
}
