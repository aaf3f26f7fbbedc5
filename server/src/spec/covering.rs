//! What covers each part: the layers of the specification, those of its preset, or none.
//!
//! A part has its preset's plating unless the specification gives its plating, the law of its wear or its material: who replaces the
//! surface or what is below it describes a part of their own. An empty list is a bare part. With a continuous motion the slider
//! is bare, because a surface that runs past cannot wear yet.

use api::spec::{MotionKind, PlatingLayer, Platings, Spec};
use solver::sides::{Side, Sides};

use crate::spec::materials;
use crate::spec::sourced::assumed;
use crate::spec::system::{LayerPreset, Preset};

/// What covers a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Covering<'a> {
    /// Layers of the specification.
    Given(&'a [PlatingLayer]),
    /// Layers of the preset.
    Preset(&'static [LayerPreset]),
    /// None, because the list of the specification is empty.
    Removed,
    /// None.
    Bare,
}

impl Covering<'_> {
    /// Whether there are layers.
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

/// What covers both parts.
pub(super) fn resolve<'a>(spec: &'a Spec, preset: &Preset) -> Sides<Covering<'a>> {
    let wear = &spec.interface.wear;
    let given_wear = Sides {
        slider: wear.slider.is_some(),
        receptacle: wear.receptacle.is_some(),
    };
    let materials = materials::by_side(&spec.materials);
    let given = given(&spec.plating);
    Sides::from_fn(|side| {
        let is_replaced = *given_wear.of(side) || materials.of(side).is_some();
        match (*given.of(side), *preset.plating.of(side)) {
            (Some([]), _) => Covering::Removed,
            (Some(layers), _) => Covering::Given(layers),
            (None, []) => Covering::Bare,
            (None, _) if is_replaced => Covering::Bare,
            (None, layers) => Covering::Preset(layers),
        }
    })
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

#[cfg(test)]
mod tests;
