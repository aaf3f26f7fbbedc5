//! The contact as an electrical conductor: force, resistivities, hardnesses, spots and films.

use api::spec::{CriterionKind, EnumValue, Model, Spec, Spots, Switch};
use solver::law::elastic::contact_modulus;
use solver::law::plating::bottoms;
use solver::law::softening::REFERENCE_C;
use solver::scene::{Conduction, Electrical, Metal, MissingProperty};
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::stages::Numerics;
use crate::spec::{environment, films, materials, plating, spots};

/// Conductors of the contact, and the data missing for their resistance.
pub(super) struct Conductors {
    /// Electrical model, without the limits of criteria so far.
    pub(super) conduction: Conduction,
    /// Spots as the resolved specification has them: filled in where the resistance is computed.
    pub(super) spots: Option<Spots>,
    /// Data missing for a criterion of the resistance, in words.
    pub(super) lacks: Vec<String>,
}

/// Resolves the conductors of bodies under a load.
pub(super) fn resolve(numerics: &Numerics<'_>, diagnostics: &mut Diagnostics) -> Conductors {
    let (spec, loading) = (&numerics.spec, numerics.loading);
    let bodies = loading.bodies;
    let is_requested = is_requested(spec);
    let platings = plating::by_side(&spec.plating);
    let motion = loading.movement.scene;
    let films = films::resolve(&spec.interface.films, platings, motion, diagnostics);
    let temperature = spec.environment.temperature_c.unwrap_or(REFERENCE_C);
    let (mut lacks, mut unknown) = (Vec::new(), None);
    // The model gives a contact of finite width its width.
    let has_width = spec.model.as_ref().is_some_and(Model::has_width);
    let force = spec.load.as_ref().and_then(|load| {
        let width = if has_width { Some(1.0) } else { load.width_mm };
        load.n.zip(width)
    });
    if force.is_none() {
        lacks.push("a load of the kind `force` with its `width_mm`".to_owned());
        unknown = Some(MissingProperty::Force);
    }
    let metals = Sides::from_fn(|side| {
        let of_side = (*platings.of(side), bodies.layers.of(side));
        let base = *materials::by_side(&spec.materials).of(side);
        let law = *environment::laws(spec).of(side);
        let pointers = of_side.0.iter().enumerate().map(|(number, layer)| {
            let name = format!("plating.{}[{number}].material", side.name());
            (name, layer.material.as_ref(), layer.wear.as_ref())
        });
        let base = (format!("materials.{}", side.name()), base, law);
        let bottoms = bottoms(of_side.1).chain([f64::INFINITY]);
        let metals = pointers.chain([base]).zip(bottoms).enumerate();
        let metals = metals.map(|(number, ((name, material, law), bottom_mm))| {
            // The hardness matters for the resistance, even of a metal that does not wear.
            let hardness = environment::hardness_mpa(temperature, material, law);
            let resistivity = environment::properties(material).and_then(|of| of.resistivity_ohm_m);
            if resistivity.is_none() {
                lacks.push(format!("`{name}.resistivity_ohm_m`"));
                unknown.get_or_insert(MissingProperty::Resistivity);
            }
            if hardness.is_none() {
                lacks.push(format!("`{name}.hardness_mpa`"));
                unknown.get_or_insert(MissingProperty::Hardness);
            }
            Metal {
                bottom_mm,
                resistivity_ohm_m: resistivity.unwrap_or_default(),
                hardness_mpa: hardness.unwrap_or_default(),
                film: films.of(side).get(number).copied().flatten(),
            }
        });
        metals.collect::<Vec<_>>()
    });
    let modulus = contact_modulus(bodies.elastic.slider, bodies.elastic.receptacle);
    let given = spec.interface.spots.as_ref();
    let mut spots = given.cloned();
    let conduction = match (unknown, force) {
        (None, Some((_, width_mm))) => {
            let (filled, found) = spots::resolve(given, modulus, diagnostics);
            spots = Some(filled);
            Conduction::Known(Box::new(Electrical {
                width_mm,
                metals,
                spots: found,
                frequency_hz: spec.environment.frequency_hz,
                current_a: spec.environment.current_a,
                stop_mohm: Vec::new(),
                life_mohm: Vec::new(),
            }))
        }
        (missing, _) => {
            if given.is_some() {
                spots::resolve(given, modulus, diagnostics);
            }
            Conduction::Unknown {
                missing: missing.unwrap_or(MissingProperty::Force),
                is_requested,
            }
        }
    };
    if spec.interface.films.is_empty() {
        lacks.push("the films on exposed metals (`interface.films`)".to_owned());
    }
    if spec.effects.get("resistance").and_then(EnumValue::known) == Some(Switch::Off) {
        lacks.push("`effects.resistance`, which is `off`".to_owned());
    }
    Conductors {
        conduction,
        spots,
        lacks,
    }
}

/// Returns `true` if something of the specification is about the resistance alone.
fn is_requested(filled: &Spec) -> bool {
    let is_resistance = |kind: &EnumValue<CriterionKind>| {
        matches!(kind, EnumValue::Known(CriterionKind::Resistance))
    };
    let mut criteria = filled.life.criteria.iter().flatten();
    let mut stops = filled.stop.iter().filter_map(|stop| stop.kind.as_ref());
    filled.environment.current_a.is_some()
        || filled.interface.spots.is_some()
        || !filled.interface.films.is_empty()
        || criteria.any(|criterion| is_resistance(&criterion.kind))
        || stops.any(is_resistance)
}

#[cfg(test)]
mod tests;
