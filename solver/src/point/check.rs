//! Checks of a point contact before it is simulated.

use super::error::PointError;
use crate::closed_form::PointScene;
use crate::sides::Side;

/// Checks a point contact.
///
/// # Errors
/// A value outside of its range, a contact that is no point, a law that is none by dose.
pub(super) fn check(scene: &PointScene) -> Result<(), PointError> {
    let (along, across) = scene.curvature();
    let positive = [
        ("normal force in N", scene.force_n),
        ("curvature along the sliding direction in 1/mm", along),
        ("curvature across the sliding direction in 1/mm", across),
        ("contact modulus in MPa", scene.modulus()),
        ("tolerance", scene.accuracy.tolerance),
        (
            "cells along a half-length",
            scene.accuracy.cells_per_half_length,
        ),
        (
            "step over half-length",
            scene.accuracy.step_over_half_length,
        ),
    ];
    for (name, value) in positive {
        if !(value > 0.0 && value.is_finite()) {
            return Err(PointError::Value { name, value });
        }
    }
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
