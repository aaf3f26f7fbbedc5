//! Checks of a point contact before it is simulated.

use super::error::PointError;
use crate::closed_form::PointScene;
use crate::number::positive;
use crate::sides::Side;

/// Checks a point contact.
///
/// # Errors
/// A value outside of its range, a contact that is no point, a law that is none by dose.
pub(super) fn check(scene: &PointScene) -> Result<(), PointError> {
    let (along, across) = scene.curvature();
    let accuracy = &scene.accuracy;
    positive(scene.force_n, PointError::ForceRange)?;
    positive(along, PointError::CurvatureAlongRange)?;
    positive(across, PointError::CurvatureAcrossRange)?;
    positive(scene.modulus(), PointError::ModulusRange)?;
    positive(accuracy.tolerance, PointError::ToleranceRange)?;
    positive(accuracy.cells_per_half_length, PointError::CellsRange)?;
    positive(accuracy.step_over_half_length, PointError::StepRange)?;
    let (amplitude_mm, most_mm) = (scene.amplitude_mm.abs(), scene.largest_amplitude_mm());
    if amplitude_mm.is_nan() || amplitude_mm > most_mm {
        return Err(PointError::Amplitude {
            amplitude_mm,
            most_mm,
        });
    }
    for side in Side::BOTH {
        let wear = scene.bodies.of(side).wear;
        if wear.is_some_and(|wear| wear.dose_rate().is_none()) {
            return Err(PointError::Law { side: side.name() });
        }
    }
    Ok(())
}
