//! The unworn contact, before anything is solved.

use std::f64::consts::PI;

use super::constriction::Spreading;
use super::patches::Patch;
use crate::number::real;
use crate::scene::{Electrical, Metal};
use crate::sides::{Side, Sides};

/// mOhm in an ohm.
const MILLI: f64 = 1e3;

/// All of the contact with the outermost metals of both sides.
const UNWORN: Patch = Patch {
    metal: Sides {
        slider: 0,
        receptacle: 0,
    },
    depth: Sides {
        slider: 0.0,
        receptacle: 0.0,
    },
    share: 1.0,
};

/// The unworn contact as a conductor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unworn {
    /// Constriction and its films, without the way through the bodies, mOhm.
    pub mohm: f64,
    /// Radius of a spot, mm.
    pub spot_radius_mm: f64,
}

/// The unworn contact under a load in N/mm; an open one has an infinite resistance.
pub fn of(electrical: &Electrical, load_n_per_mm: f64) -> Unworn {
    let force = electrical.width_mm * load_n_per_mm;
    let found = Spreading::of(&electrical.spots).of_patch(electrical, force, &UNWORN);
    let area = real(electrical.spots.count) * PI * found.radius_mm.powi(2);
    let films = Side::BOTH.map(|side| {
        let outermost = electrical.metals.of(side).first();
        let film = outermost.and_then(|metal| metal.film);
        film.map_or(0.0, |film| MILLI * film.at_age(0.0) / area)
    });
    Unworn {
        mohm: found.mohm.slider + found.mohm.receptacle + films[0] + films[1],
        spot_radius_mm: found.radius_mm,
    }
}

/// Resistance of the unworn contact under a load in N/mm with each side all of its most resistive metal, without films, mOhm: an upper
/// limit that costs no layers.
pub(crate) fn largest_mohm(electrical: &Electrical, load_n_per_mm: f64) -> f64 {
    let metals = electrical.metals.as_ref().map(|metals| {
        let resistivities = metals.iter().map(|metal| metal.resistivity_ohm_m);
        let largest = resistivities.fold(0.0, f64::max);
        let outer = metals.iter().take(1);
        let alone = outer.map(|metal| Metal {
            bottom_mm: f64::INFINITY,
            resistivity_ohm_m: largest,
            film: None,
            ..*metal
        });
        alone.collect::<Vec<_>>()
    });
    let alike = Electrical {
        metals,
        ..electrical.clone()
    };
    of(&alike, load_n_per_mm).mohm
}
