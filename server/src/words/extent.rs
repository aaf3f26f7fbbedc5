//! Reasons of the dimension that a contact of finite width requires.

use solver::effects::extent::Choice;

/// The reason of a choice.
pub(crate) fn reason(choice: Choice) -> String {
    match choice {
        Choice::Straight => {
            "neither a crown nor a tilt: all sections across the width are alike".to_owned()
        }
        Choice::Recedes { by_mm, limit_mm } => format!(
            "crown and tilt recede by {by_mm:.2e} mm over the width, below the limit of {limit_mm:.2e} mm for the expected wear: all sections \
             wear alike"
        ),
        Choice::Tilt { by_mm, limit_mm } => format!(
            "the tilt recedes by {by_mm:.2e} mm over the width, above the limit of {limit_mm:.2e} mm for the expected wear: sections wear \
             unlike"
        ),
        Choice::TiltedCrown => {
            "sections across a tilted width touch one after the other".to_owned()
        }
        Choice::CrownToEnds {
            half_length_mm: worn,
            half_width_mm: half,
        } => format!(
            "the contact is expected to grow to {worn:.2e} mm to either side, beyond the ends of the width at {half:.2e} mm, which half-spaces \
             do not have"
        ),
        Choice::Crown {
            aspect,
            half_length_mm: worn,
            half_width_mm: half,
        } => format!(
            "the contact, {aspect:.1} times as long across the sliding direction as along it before any wear, is expected to stay within the width \
             ({worn:.2e} of {half:.2e} mm to either side): it is one of half-spaces"
        ),
    }
}
