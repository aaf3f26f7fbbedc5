//! Checks of what all sections along a line have in common: motion, wear, and that all of the contact slips.

use super::error::SectionsError;
use crate::closed_form::unworn_contact;
use crate::number::positive;
use crate::scene::{Motion, Scene};
use crate::sides::Side;

/// Checks a section in each of its motions; returns the largest magnitude of their amplitudes, mm.
///
/// # Errors
/// A value outside of its range, a law or a motion that sections along a line do not have.
pub(crate) fn check_section(section: &Scene) -> Result<f64, SectionsError> {
    let blocks = section.blocks().into_iter();
    let amplitudes = blocks.map(|block| check_motion(&block));
    let largest = amplitudes.reduce(|most, next| Ok(most?.max(next?)));
    let largest = largest.unwrap_or(Err(SectionsError::Motion))?;
    let wear = section.surface_wear_of_all_motions();
    for side in Side::BOTH {
        if wear.of(side).is_some_and(|wear| wear.dose_rate().is_none()) {
            return Err(SectionsError::Law { side: side.name() });
        }
    }
    Ok(largest)
}

/// Checks the motion of a section; returns the magnitude of the amplitude, mm.
fn check_motion(section: &Scene) -> Result<f64, SectionsError> {
    let Motion::Reciprocating { amplitude_mm, .. } = section.motion else {
        return Err(SectionsError::Motion);
    };
    let amplitude = amplitude_mm.abs();
    // A block of a mission may be a rest, which wears nothing.
    if section.cycles_at_a_time.is_none() || amplitude != 0.0 {
        positive(amplitude, SectionsError::AmplitudeRange)?;
    }
    let half_block_mm = 0.5 * section.receptacle.shape.length_mm;
    if amplitude >= half_block_mm {
        return Err(SectionsError::LeavesReceptacle {
            amplitude_mm: amplitude,
            half_block_mm,
        });
    }
    Ok(amplitude)
}

/// Checks that all of a contact slips in each stroke of each of its motions.
///
/// # Errors
/// [`SectionsError::Sticks`].
pub(crate) fn check_slip(section: &Scene) -> Result<(), SectionsError> {
    let half_width = unworn_contact::hertz_half_width(section);
    let blocks = section.blocks().into_iter();
    let mut moving = blocks.filter(|block| block.motion.distance_per_cycle_mm() != 0.0);
    let sticking = moving.find(|block| unworn_contact::sticks(block, half_width));
    match sticking {
        None => Ok(()),
        Some(block) => Err(SectionsError::Sticks {
            amplitude_mm: block.motion.amplitude_mm().abs(),
            least_mm: 2.0 * unworn_contact::gross_slip(section, half_width),
        }),
    }
}
