//! Films on exposed metals. No value of one is assumed: those of films on contacts differ by orders of magnitude.

use std::ops::RangeInclusive;

use api::spec::{Film, Part, PlatingLayer};
use solver::law::resistance;
use solver::law::resistance::Growth;
use solver::scene::Motion;
use solver::sides::{Side, Sides};

use crate::spec::diagnostics::Diagnostics;

/// ohm mm^2; from tunnelling through a single layer of atoms (1e-6) far downward to thick oxides.
pub(in crate::spec) const SPECIFIC_RESISTANCE_OHM_MM2: RangeInclusive<f64> = 1e-12..=1e6;
/// Cubic laws have 1/3, parabolic ones 1/2, linear ones 1.
pub(in crate::spec) const GROWTH_EXPONENT: RangeInclusive<f64> = 0.01..=2.0;
/// From a second to a century, h.
pub(in crate::spec) const GROWTH_TIME_H: RangeInclusive<f64> = 1e-4..=1e6;
/// Most films of a job: one a metal.
pub(in crate::spec) const FILM_LIMIT: usize = 18;

const SECONDS_PER_HOUR: f64 = 3_600.0;

/// Films of the metals of a side, from the surface down.
pub(super) type OfMetals = Vec<Option<resistance::Film>>;

/// Resolves films on the layers and bases of both sides.
pub(super) fn resolve(
    given: &[Film],
    layers: Sides<&[PlatingLayer]>,
    motion: Motion,
    diagnostics: &mut Diagnostics,
) -> Sides<OfMetals> {
    let mut films = layers.map(|layers| vec![None; layers.len() + 1]);
    diagnostics.check_length("/interface/films", given.len(), FILM_LIMIT);
    for (index, given) in given.iter().take(FILM_LIMIT).enumerate() {
        let pointer = format!("/interface/films/{index}");
        let film = film(&pointer, given, motion, diagnostics);
        for side in sides(&pointer, given, &films, diagnostics) {
            let metals = films.of_mut(side);
            let metal = given.layer.map_or(metals.len() - 1, |layer| {
                usize::try_from(layer).unwrap_or(usize::MAX) - 1
            });
            if metals[metal].is_some() {
                let detail = format!("this metal of the {} has a film already", side.name());
                diagnostics.fault(&pointer, detail);
            }
            metals[metal] = Some(film);
        }
    }
    films
}

fn film(
    pointer: &str,
    given: &Film,
    motion: Motion,
    diagnostics: &mut Diagnostics,
) -> resistance::Film {
    let at = |field: &str| format!("{pointer}/{field}");
    let specific = diagnostics.required(
        &at("specific_resistance_ohm_mm2"),
        given.specific_resistance_ohm_mm2,
        &SPECIFIC_RESISTANCE_OHM_MM2,
        "the resistance of the film times the area of real contact",
    );
    let exponent = diagnostics.optional(
        &at("growth_exponent"),
        given.growth_exponent,
        &GROWTH_EXPONENT,
    );
    let time_h = diagnostics.optional(&at("growth_time_h"), given.growth_time_h, &GROWTH_TIME_H);
    match (exponent, time_h) {
        (Some(_), None) => diagnostics.missing(
            &at("growth_time_h"),
            "the time after which the film has its specific resistance",
        ),
        (None, Some(_)) => diagnostics.missing(
            &at("growth_exponent"),
            "the power of the time by which the film grows",
        ),
        (Some(_), Some(_)) if matches!(motion, Motion::Continuous { .. }) => diagnostics.fault(
            &at("growth_exponent"),
            "a film that grows needs the time, which a continuous motion has not yet",
        ),
        _ => {}
    }
    let growth = exponent.zip(time_h).map(|(exponent, time_h)| Growth {
        exponent,
        time_s: SECONDS_PER_HOUR * time_h,
    });
    resistance::Film {
        specific_resistance_ohm_mm2: specific,
        growth,
    }
}

/// The sides that have the metal of a film; adds a fault where there is none.
fn sides(
    pointer: &str,
    given: &Film,
    films: &Sides<OfMetals>,
    diagnostics: &mut Diagnostics,
) -> Vec<Side> {
    let of_part = given.side.as_ref();
    let part = of_part.and_then(|side| diagnostics.enum_member(&format!("{pointer}/side"), side));
    let candidates = match (of_part, part) {
        (None, _) => Side::BOTH.to_vec(),
        (Some(_), Some(Part::Slider)) => vec![Side::Slider],
        (Some(_), Some(Part::Receptacle)) => vec![Side::Receptacle],
        (Some(_), None) => return Vec::new(),
    };
    let Some(layer) = given.layer else {
        return candidates;
    };
    let has = |side: &Side| {
        let layers = u64::try_from(films.of(*side).len() - 1).unwrap_or(u64::MAX);
        (1..=layers).contains(&layer)
    };
    let found: Vec<Side> = candidates.into_iter().filter(has).collect();
    if found.is_empty() {
        let detail = format!("there is no layer {layer}; leave `layer` out for the base metal");
        diagnostics.fault(&format!("{pointer}/layer"), detail);
    }
    found
}
