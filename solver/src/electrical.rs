//! Resistance of the contact at the neutral position as it is worn: a derived effect, which changes no wear.
//!
//! The contact is divided into patches on which each side shows one metal (`patches`). A patch has the resistance that the whole contact
//! would have if all of it were like this patch (`constriction`, and the films of both metals over the area of all spots), and takes the
//! part of the spots that it has of the length of the contact, or of the area of a point contact, so that
//!   1/R = sum of share_i/R_i.
//! The parts of R are by the power dissipated in them, sum of share_i (R/R_i)^2 R_ik, and add up to R. Limiting case: one patch, the
//! sum of its constrictions and films. The way through the bodies is in series (`condensation::Spreading`), by the resistivity of the
//! bases. A single spot spreads the current along the depth of the section, too, which the bodies' part, even along it, counts again: by a
//! few per cent of it.
//!
//! A computed cycle stands for many, within which a metal is exposed and the resistance jumps. Both are located there: in the first of its
//! contacts (`Touching`, by the part of the cycles) that shows the metal, or has the resistance.

mod constriction;
mod located;
mod patches;
mod unworn;

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::change::Change;
use crate::law::resistance::Film;
use crate::scene::Electrical;
use crate::sides::{Side, Sides};
use constriction::{Constriction, Spreading};
pub(crate) use patches::Surface;
use patches::{Patch, patches, patches_of_cells};
pub(crate) use unworn::largest_mohm as largest_unworn_mohm;
pub use unworn::{Unworn, of as unworn};

/// mOhm in an ohm, um in a mm.
const MILLI: f64 = 1e3;

/// Resistance of an open contact, mOhm: 1 TOhm, beyond what insulation between contacts is measured to.
pub(crate) const OPEN_MOHM: f64 = 1e15;

/// Resistance of the contact and its parts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactResistance {
    /// All of it, mOhm.
    pub total_mohm: f64,
    /// Constriction of the current in each side and its layers, mOhm.
    pub constriction_mohm: Sides<f64>,
    /// Films on exposed metals, mOhm.
    pub film_mohm: f64,
    /// The way of the current from the contact to the far face of each body, mOhm.
    pub bulk_mohm: Sides<f64>,
    /// Part of the contact's length on which a side shows a metal with a film, -.
    pub filmed_fraction: f64,
    /// Radius of a spot of mean area, um.
    pub spot_radius_um: f64,
}

/// The contact at the neutral position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contact<'a> {
    /// Load per depth of the section, N/mm.
    pub(crate) load_n_per_mm: f64,
    /// Ends, mm.
    pub(crate) span: (f64, f64),
    /// Both worn surfaces.
    pub(crate) surfaces: Sides<Surface<'a>>,
    /// Time since the run began, s.
    pub(crate) time_s: f64,
    /// Resistance of each body times the depth of the section over its resistivity, -.
    pub(crate) spreading: Sides<f64>,
}

/// The contact of half-spaces at the neutral position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AreaContact {
    /// Force on it, N.
    pub(crate) force_n: f64,
    /// Worn depths of both sides at each cell in contact, mm.
    pub(crate) depths_mm: Vec<Sides<f64>>,
}

/// A contact as its resistance is computed from it: force, patches and time. An open one by default.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Touching {
    force_n: f64,
    patches: Vec<Patch>,
    time_s: f64,
    spreading: Sides<f64>,
}

impl Touching {
    /// Checks whether a side shows a metal.
    fn shows(&self, side: Side, metal: usize) -> bool {
        let mut patches = self.patches.iter();
        patches.any(|patch| *patch.metal.of(side) == metal)
    }
}

/// State that the next resistance depends on.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct ElectricalState {
    /// The last one; `None` where it is not computed.
    pub(crate) resistance: Option<ContactResistance>,
    /// Load of its contact, N.
    force_n: f64,
    /// Patches of its contact, and what is computed for them.
    patches: Vec<(Patch, Constriction)>,
    /// Time at which a metal of a side was exposed, s; `None` until it is.
    exposed_since_s: Sides<Vec<Option<f64>>>,
    time_s: f64,
}

impl ElectricalState {
    /// The last resistance without that of the bodies, mOhm; 0 where it is not computed.
    pub(crate) fn constriction_mohm(&self) -> f64 {
        self.resistance.map_or(0.0, |found| {
            let Sides { slider, receptacle } = found.bulk_mohm;
            found.total_mohm - slider - receptacle
        })
    }

    /// The last resistance, mOhm.
    pub(crate) fn total_mohm(&self) -> Option<f64> {
        self.resistance.map(|found| found.total_mohm)
    }
}

impl Change<&ElectricalState> {
    /// The resistances before and after, mOhm, if both are computed.
    pub(crate) fn total_mohm(self) -> Option<Change<f64>> {
        let both = self.before.total_mohm().zip(self.after.total_mohm());
        both.map(|(before, after)| Change { before, after })
    }
}

/// Evaluates the resistance of a contact.
pub(crate) struct Evaluation<'a> {
    electrical: &'a Electrical,
    spreading: Spreading,
}

impl<'a> Evaluation<'a> {
    pub(crate) fn new(electrical: &'a Electrical) -> Self {
        Self {
            electrical,
            spreading: Spreading::of(&electrical.spots),
        }
    }

    /// A contact of a section.
    pub(crate) fn section(&self, contact: &Contact<'_>) -> Touching {
        let Electrical {
            width_mm, metals, ..
        } = self.electrical;
        Touching {
            force_n: width_mm * contact.load_n_per_mm,
            patches: patches(contact.span, contact.surfaces, metals),
            time_s: contact.time_s,
            spreading: contact.spreading,
        }
    }

    /// A contact of half-spaces after a time since the run began, s: the current spreads in them from the spots on.
    pub(crate) fn area(&self, contact: &AreaContact, time_s: f64) -> Touching {
        Touching {
            force_n: contact.force_n,
            patches: patches_of_cells(&contact.depths_mm, &self.electrical.metals),
            time_s,
            spreading: Sides::default(),
        }
    }

    /// Takes the contact after the next computed cycle into the state; `during` has those after a part of it.
    pub(crate) fn update(&self, state: &mut ElectricalState, during: impl Fn(f64) -> Touching) {
        let now = during(1.0);
        self.note_exposure(state, &now, during);
        self.take(state, now);
    }

    /// Takes a contact whose metals have been noted into the state. Constrictions are computed where load or layers have changed.
    fn take(&self, state: &mut ElectricalState, contact: Touching) {
        let Touching {
            force_n,
            patches: found,
            time_s,
            spreading,
        } = contact;
        state.time_s = time_s;
        if force_n <= 0.0 {
            *state = ElectricalState {
                resistance: Some(open()),
                force_n,
                patches: Vec::new(),
                ..std::mem::take(state)
            };
            return;
        }
        let is_same = |(patch, (known, _)): (&Patch, &(Patch, _))| patch == known;
        let unchanged = force_n.to_bits() == state.force_n.to_bits()
            && found.len() == state.patches.len()
            && found.iter().zip(&state.patches).all(is_same);
        if !unchanged {
            let constrictions = found.into_iter().map(|patch| {
                let constriction = self.spreading.of_patch(self.electrical, force_n, &patch);
                (patch, constriction)
            });
            (state.patches, state.force_n) = (constrictions.collect(), force_n);
        }
        state.resistance = Some(self.with_bulk(self.parallel(state), spreading));
    }

    /// The contact with the way of the current through both bodies.
    fn with_bulk(&self, contact: ContactResistance, spreading: Sides<f64>) -> ContactResistance {
        let bulk_mohm = Sides::from_fn(|side| {
            let base = self.electrical.metals.of(side).last();
            let resistivity = base.map_or(0.0, |base| base.resistivity_ohm_m);
            // ohm m over mm is 1e3 ohm.
            MILLI * MILLI * resistivity / self.electrical.width_mm * spreading.of(side)
        });
        let total = contact.total_mohm + bulk_mohm.slider + bulk_mohm.receptacle;
        ContactResistance {
            total_mohm: total.min(OPEN_MOHM),
            bulk_mohm,
            ..contact
        }
    }

    /// All patches in parallel.
    fn parallel(&self, state: &ElectricalState) -> ContactResistance {
        let count = crate::number::real(self.electrical.spots.count);
        let films = |patch: &Patch, constriction: &Constriction| {
            let area = count * PI * constriction.radius_mm.powi(2);
            let specific = Side::BOTH.map(|side| self.film(state, side, *patch.metal.of(side)));
            MILLI * (specific[0] + specific[1]) / area
        };
        let branches = state.patches.iter().map(|(patch, constriction)| {
            let film = films(patch, constriction);
            let Sides { slider, receptacle } = constriction.mohm;
            (patch, constriction, film, slider + receptacle + film)
        });
        let conductance: f64 = branches
            .clone()
            .map(|(patch, .., whole)| patch.share / whole)
            .sum();
        let total = (1.0 / conductance).min(OPEN_MOHM);
        let mut sum = ContactResistance {
            total_mohm: total,
            ..ContactResistance::default()
        };
        let mut area = 0.0;
        for (patch, constriction, film, whole) in branches {
            let power = patch.share * (total / whole).powi(2);
            for side in Side::BOTH {
                *sum.constriction_mohm.of_mut(side) += power * constriction.mohm.of(side);
            }
            sum.film_mohm += power * film;
            if film > 0.0 {
                sum.filmed_fraction += patch.share;
            }
            area += patch.share * constriction.radius_mm.powi(2);
        }
        sum.spot_radius_um = MILLI * area.sqrt();
        sum
    }

    /// Specific resistance of the film on a metal of a side, ohm mm^2.
    fn film(&self, state: &ElectricalState, side: Side, metal: usize) -> f64 {
        let film: Option<Film> = self.electrical.metals.of(side)[metal].film;
        film.map_or(0.0, |film| {
            let since = state.exposed_since_s.of(side)[metal];
            film.at_age(state.time_s - since.unwrap_or(state.time_s))
        })
    }
}

/// An open contact: its resistance is that of the gap.
fn open() -> ContactResistance {
    ContactResistance {
        total_mohm: OPEN_MOHM,
        film_mohm: OPEN_MOHM,
        ..ContactResistance::default()
    }
}

#[cfg(test)]
mod tests;
