//! The two bodies of a contact system.
//!
//! Every slider is an arc that touches y = 0 at x = 0 under a flat top face, every receptacle a block below; systems
//! differ in the modelled part of the arc and in what the block represents. The compliance of a spring is not part of
//! the bodies: it is `spring_n_per_mm` of the load.

use solver::scene::{BlockShape, SliderShape};

use crate::spec::diagnostics::Diagnostics;

/// Highest arc of a crowned top, as a share of the block's height: some of its sides must remain.
const MOST_CROWN_SHARE: f64 = 0.98;

/// The shapes of both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shapes {
    pub(crate) slider: SliderShape,
    pub(crate) block: BlockShape,
}

/// Half a round bar, its top face through the axis.
pub(super) fn half_round(radius_mm: f64) -> SliderShape {
    SliderShape {
        radius_mm,
        half_width_mm: radius_mm,
        height_mm: radius_mm,
    }
}

/// A rounded tip: three quarters of its radius to each side, one radius high.
pub(super) fn tip(radius_mm: f64) -> SliderShape {
    SliderShape {
        radius_mm,
        half_width_mm: 0.75 * radius_mm,
        height_mm: radius_mm,
    }
}

/// A block with a flat top.
pub(super) fn flat(length_mm: Option<f64>, height_mm: Option<f64>) -> BlockShape {
    BlockShape {
        length_mm: length(length_mm),
        height_mm: length(height_mm),
        crown_radius_mm: None,
    }
}

/// A dimension with a default; it is set before shapes are built.
pub(super) fn length(value: Option<f64>) -> f64 {
    value.unwrap_or_default()
}

/// Height of an arc of that radius over half its chord.
pub(super) fn sagitta(radius_mm: f64, half_chord_mm: f64) -> f64 {
    radius_mm - (radius_mm * radius_mm - half_chord_mm * half_chord_mm).sqrt()
}

/// Checks a convex top: it spans the length of the block and leaves some of the block's sides.
pub(super) fn check_crown(pointer: &str, shapes: &Shapes, diagnostics: &mut Diagnostics) {
    let block = &shapes.block;
    let Some(radius) = block.crown_radius_mm else {
        return;
    };
    let half = 0.5 * block.length_mm;
    if radius < half {
        let detail = format!("{radius} is below half the length of {}", block.length_mm);
        diagnostics.fault(pointer, detail);
        return;
    }
    let sagitta = sagitta(radius, half);
    if sagitta > MOST_CROWN_SHARE * block.height_mm {
        let detail = format!(
            "{radius} makes an arc {sagitta} high, above {MOST_CROWN_SHARE} of the height of {}",
            block.height_mm
        );
        diagnostics.fault(pointer, detail);
    }
}
