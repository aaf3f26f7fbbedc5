//! Tractions at a position of the slider as documents.

use api::results::{PressurePosition, SlidePosition};
use solver::record::{Position, TractionField};

/// The document of the tractions at a position.
pub fn position(field: &TractionField) -> PressurePosition {
    let phase = match field.position {
        Position::Neutral => SlidePosition::Neutral,
        Position::Rightmost => SlidePosition::Rightmost,
        Position::Leftmost => SlidePosition::Leftmost,
    };
    PressurePosition {
        phase,
        slider_x_mm: field.slider_x_mm,
        x_mm: field.x_mm.clone(),
        pressure_mpa: field.pressure_mpa.clone(),
        shear_mpa: field.shear_mpa.clone(),
    }
}
