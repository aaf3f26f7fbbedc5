//! The plating of each part: the layers of the specification, those of its preset, or none.
//!
//! A part has its preset's plating unless the specification gives its plating; an empty list is a bare part. A material and a wear law
//! of a part are those of the base below the plating. A wear law of `null` without a given plating says that the part does not
//! wear at all: it has no layers. With a continuous motion the slider is bare, because a surface that runs past cannot wear yet.

use api::problem::Fault;
use api::spec::{MotionKind, PlatingLayer, Platings, Spec, WearLaw};
use solver::sides::{Side, Sides};

use crate::spec::materials;
use crate::spec::sourced::assumed;
use crate::spec::system::{LayerPreset, Preset};

/// Plating of a part, with its origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PlatingChoice<'a> {
    /// Layers of the specification.
    Given(&'a [PlatingLayer]),
    /// Layers of the preset.
    Preset(&'static [LayerPreset]),
    /// None, because the list of the specification is empty.
    Removed,
    /// None.
    Bare,
}

impl PlatingChoice<'_> {
    /// Returns `true` if there are layers.
    pub(super) fn is_plated(&self) -> bool {
        matches!(self, Self::Given(_) | Self::Preset(_))
    }
}

/// The layers that a specification gives.
pub(super) fn given(platings: &Platings) -> Sides<Option<&[PlatingLayer]>> {
    Sides {
        slider: platings.slider.as_deref(),
        receptacle: platings.receptacle.as_deref(),
    }
}

/// Resolves the platings of both parts.
pub(super) fn resolve<'a>(spec: &'a Spec, preset: &Preset) -> Sides<PlatingChoice<'a>> {
    let given = given(&spec.plating);
    Sides::from_fn(|side| match (*given.of(side), *preset.plating.of(side)) {
        (Some([]), _) => PlatingChoice::Removed,
        (Some(layers), _) => PlatingChoice::Given(layers),
        (None, []) => PlatingChoice::Bare,
        (None, _) if is_unworn(spec, side) => PlatingChoice::Bare,
        (None, layers) => PlatingChoice::Preset(layers),
    })
}

/// Checks whether the specification gives no wear to a side, with `null`.
fn is_unworn(spec: &Spec, side: Side) -> bool {
    matches!(wear_of(spec, side), Some(None))
}

/// The wear law that a specification gives a side.
pub(super) fn wear_of(spec: &Spec, side: Side) -> Option<&Option<WearLaw>> {
    let wear = &spec.interface.wear;
    match side {
        Side::Slider => wear.slider.as_ref(),
        Side::Receptacle => wear.receptacle.as_ref(),
    }
}

/// The preset of a kind for the motion of a specification.
pub(super) fn preset_for_motion(spec: &Spec, preset: Preset) -> Preset {
    let kind = spec.motion.as_ref().map(|motion| &motion.kind);
    if kind != Some(&MotionKind::Continuous.into()) {
        return preset;
    }
    let mut preset = preset;
    *preset.plating.of_mut(Side::Slider) = &[];
    *preset.wear.of_mut(Side::Slider) = assumed(None);
    preset
}

/// Warnings where a specification gives the material or the wear law of a part without its plating: that of the preset stays, or is
/// left out with a part that does not wear.
pub(super) fn warnings(spec: &Spec, preset: &Preset) -> Vec<Fault> {
    let materials = materials::by_side(&spec.materials);
    let plating_choices = resolve(spec, preset);
    let warnings = Side::BOTH.into_iter().filter_map(|side| {
        let name = side.name();
        let wear = format!("/interface/wear/{name}");
        match *plating_choices.of(side) {
            PlatingChoice::Preset(_) => {
                let pointer = match (materials.of(side), wear_of(spec, side)) {
                    (Some(_), _) => format!("/materials/{name}"),
                    (None, Some(_)) => wear,
                    (None, None) => return None,
                };
                let detail = format!(
                    "it is that of the base: plating of the preset kept; write \"plating\": {{\"{name}\": []}} for a bare part"
                );
                Some(Fault::new(&pointer, detail))
            }
            PlatingChoice::Bare if !preset.plating.of(side).is_empty() && is_unworn(spec, side) => {
                let detail = format!(
                    "null without a given plating: the {name} does not wear at all, and the plating of the preset is left out"
                );
                Some(Fault::new(&wear, detail))
            }
            _ => None,
        }
    });
    warnings.collect()
}

#[cfg(test)]
mod tests;
