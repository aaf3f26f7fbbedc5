//! Resistance of the contact in a summary.

use api::results::{ContactResistance, ResistanceParts};
use solver::record::Summary;

/// Resistance of the unworn contact and at the end of a run, mOhm; `None` where it was not computed.
pub(crate) fn of(summary: &Summary) -> Option<ContactResistance> {
    let initial = summary.initial.contact_resistance_mohm?;
    let last = summary.last.resistance?;
    Some(ContactResistance {
        initial,
        r#final: last.contact_resistance_mohm,
        parts: ResistanceParts {
            slider_constriction: last.slider_constriction_mohm,
            receptacle_constriction: last.receptacle_constriction_mohm,
            film: last.film_resistance_mohm,
            slider_bulk: last.slider_bulk_mohm,
            receptacle_bulk: last.receptacle_bulk_mohm,
            filmed_fraction: last.filmed_fraction,
            spot_radius_um: last.spot_radius_um,
        },
    })
}
