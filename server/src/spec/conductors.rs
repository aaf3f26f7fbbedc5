//! The contact as an electrical conductor: force, resistivities, hardnesses, spots and films.

use api::spec::{CriterionKind, EnumValue, Material, Model, Spec, Switch};
use solver::law::elastic::contact_modulus;
use solver::law::plating::bottoms;
use solver::law::softening::REFERENCE_C;
use solver::scene::{Conduction, Elastic, Electrical, Layer, Metal, MissingProperty, Motion};
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::{environment, films, materials, plating, spots};

/// Conductors of the contact, and the data missing for their resistance.
pub(super) struct Conductors {
    /// Electrical model, without the limits of criteria so far.
    pub(super) conduction: Conduction,
    /// Data missing for a criterion of the resistance, in words.
    pub(super) lacks: Vec<String>,
}

/// Parts of the scene that the metals depend on.
#[derive(Clone, Copy)]
pub(super) struct Bodies<'a> {
    pub(super) layers: &'a Sides<Vec<Layer>>,
    pub(super) elastic: &'a Sides<Elastic>,
    pub(super) motion: Motion,
}

/// Resolves the conductors of a specification whose materials, laws and load are resolved; fills in its spots where the resistance
/// is computed.
pub(super) fn resolve(
    filled: &mut Spec,
    bodies: Bodies<'_>,
    diagnostics: &mut Diagnostics,
) -> Conductors {
    let is_requested = is_requested(filled);
    let platings = plating::by_side(&filled.plating);
    let films = films::resolve(
        &filled.interface.films,
        platings,
        bodies.motion,
        diagnostics,
    );
    let temperature = filled.environment.temperature_c.unwrap_or(REFERENCE_C);
    let (mut lacks, mut unknown) = (Vec::new(), None);
    // The model gives a contact of finite width its width.
    let has_width = filled.model.as_ref().is_some_and(Model::has_width);
    let force = filled.load.as_ref().and_then(|load| {
        let width = if has_width { Some(1.0) } else { load.width_mm };
        load.n.zip(width)
    });
    if force.is_none() {
        lacks.push("a load of the kind `force` with its `width_mm`".to_owned());
        unknown = Some(MissingProperty::Force);
    }
    let metals = Sides::from_fn(|side| {
        let of_side = (*platings.of(side), bodies.layers.of(side));
        let base = *materials::by_side(&filled.materials).of(side);
        let law = *environment::laws(filled).of(side);
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
            let resistivity = resistivity(material);
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
    let conduction = match (unknown, force) {
        (None, Some((_, width_mm))) => {
            let given = filled.interface.spots.as_ref();
            let (spots, found) = spots::resolve(given, modulus, diagnostics);
            filled.interface.spots = Some(spots);
            Conduction::Known(Box::new(Electrical {
                width_mm,
                metals,
                spots: found,
                frequency_hz: filled.environment.frequency_hz,
                current_a: filled.environment.current_a,
                stop_mohm: Vec::new(),
                life_mohm: Vec::new(),
            }))
        }
        (missing, _) => {
            if filled.interface.spots.is_some() {
                spots::resolve(filled.interface.spots.as_ref(), modulus, diagnostics);
            }
            Conduction::Unknown {
                missing: missing.unwrap_or(MissingProperty::Force),
                is_requested,
            }
        }
    };
    if filled.interface.films.is_empty() {
        lacks.push("the films on exposed metals (`interface.films`)".to_owned());
    }
    if filled.effects.get("resistance").and_then(EnumValue::known) == Some(Switch::Off) {
        lacks.push("`effects.resistance`, which is `off`".to_owned());
    }
    Conductors { conduction, lacks }
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

fn resistivity(material: Option<&Material>) -> Option<f64> {
    match material {
        Some(Material::Given(properties)) => properties.resistivity_ohm_m,
        _ => None,
    }
}

#[cfg(test)]
mod tests;
