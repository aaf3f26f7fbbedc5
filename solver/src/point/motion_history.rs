//! State that the cycles of one motion leave for later ones of the same motion: a mission returns to its blocks.
//!
//! The jump goes with the change of the wear per cycle since the last cycle of the same motion, whose dose the history has on the grids that the
//! bodies had then. Tractions belong to the bodies and stay as they are.

use serde::{Deserialize, Serialize};

use super::field::{Axis, Field};
use super::jump::JumpControl;
use super::lattice::Lattice;
use super::point_state::PointState;
use crate::sides::{Side, Sides};

/// Size of a cell over that of an earlier grid from which on pairs of its cells have been merged since: each merging doubles it.
const MERGED: f64 = 1.5;

/// Jump control of a motion, and the wear of its last cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PointHistory {
    control: JumpControl,
    /// Dose per cycle in its last computed one, MPa mm, and the grids of that.
    paces: Option<Sides<Field>>,
    lattice: Option<Lattice>,
}

impl PointState {
    /// Takes out what belongs to the present motion.
    pub(crate) fn take_motion_history(&mut self) -> PointHistory {
        let surfaces = &mut self.sliding.surfaces;
        PointHistory {
            control: std::mem::take(&mut self.control),
            paces: Some(Sides {
                slider: surfaces.slider.take_pace(),
                receptacle: surfaces.receptacle.take_pace(),
            }),
            lattice: Some(self.sliding.lattice),
        }
    }

    /// Continues with what cycles of the next motion have left.
    pub(crate) fn continue_motion(&mut self, history: PointHistory) {
        self.control = history.control;
        let (Some(paces), Some(earlier)) = (history.paces, history.lattice) else {
            return;
        };
        let present = self.sliding.lattice;
        for side in Side::BOTH {
            let pace = on_present_grid(paces.of(side), &earlier, &present, side);
            self.sliding.surfaces.of_mut(side).set_pace(pace);
        }
    }
}

/// A field of an earlier grid of a body on its present one.
fn on_present_grid(field: &Field, earlier: &Lattice, present: &Lattice, side: Side) -> Field {
    let mut field = field.clone();
    let (mut along_mm, mut across_mm) = earlier.size_mm;
    while present.size_mm.0 > MERGED * along_mm {
        field = field.merged(Axis::Along);
        along_mm *= 2.0;
    }
    while present.size_mm.1 > MERGED * across_mm {
        field = field.merged(Axis::Across);
        across_mm *= 2.0;
    }
    field.resized(present.half(side))
}
