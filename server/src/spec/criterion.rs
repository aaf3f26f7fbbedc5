//! Criteria of stops and lives.

use std::ops::RangeInclusive;

use api::spec::{Criterion, CriterionKind, EnumValue, Part, Stop};
use solver::law::plating::bottoms;
use solver::scene::{self, Layer};
use solver::sides::{Side, Sides};

use crate::spec::diagnostics::Diagnostics;

/// mm.
pub(in crate::spec) const WORN_DEPTH_MM: RangeInclusive<f64> = 1e-9..=1e4;
/// Part of a scar, -; its ends have no depth.
pub(in crate::spec) const FRACTION: RangeInclusive<f64> = 1e-3..=0.99;
/// mOhm.
pub(in crate::spec) const RESISTANCE_MOHM: RangeInclusive<f64> = 1e-6..=1e12;

/// The platings of a scene, the sides that wear at all, and the data missing for the resistance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surfaces<'a> {
    pub(super) plating: &'a Sides<Vec<Layer>>,
    pub(super) wears: Sides<bool>,
    pub(super) resistance_lacks: &'a [String],
}

/// Criterion as the engine compares it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Modelled {
    /// A depth of a part of a scar.
    Depth(scene::Criterion),
    /// A resistance of the contact, mOhm.
    Resistance(f64),
}

impl Modelled {
    /// Criteria of depths, and the limits of criteria of resistance.
    pub(super) fn apart(all: impl IntoIterator<Item = Self>) -> (Vec<scene::Criterion>, Vec<f64>) {
        let (mut depths, mut limits) = (Vec::new(), Vec::new());
        for modelled in all {
            match modelled {
                Self::Depth(criterion) => depths.push(criterion),
                Self::Resistance(mohm) => limits.push(mohm),
            }
        }
        (depths, limits)
    }
}

impl Surfaces<'_> {
    /// The sides that a criterion of a kind is about.
    fn sides(&self, kind: CriterionKind) -> Vec<Side> {
        let is_about = |side: &Side| match kind {
            CriterionKind::FirstExposure
            | CriterionKind::BaseMetal
            | CriterionKind::ExposedFraction => !self.plating.of(*side).is_empty(),
            CriterionKind::WornDepth => *self.wears.of(*side),
            CriterionKind::Resistance => true,
        };
        Side::BOTH.into_iter().filter(is_about).collect()
    }
}

/// The name of a side in a specification.
pub(super) fn part(side: Side) -> Part {
    match side {
        Side::Slider => Part::Slider,
        Side::Receptacle => Part::Receptacle,
    }
}

/// A criterion of a kind without its values, for a side.
pub(super) fn of(kind: CriterionKind, side: Option<Side>) -> Criterion {
    Criterion {
        kind: kind.into(),
        side: side.map(|side| part(side).into()),
        layer: None,
        fraction: None,
        mm: None,
        mohm: None,
    }
}

/// A stop as a criterion; `None` where it has no kind.
pub(super) fn of_stop(stop: &Stop) -> Option<Criterion> {
    let Stop {
        kind,
        side,
        layer,
        fraction,
        mm,
        mohm,
        ..
    } = stop.clone();
    kind.map(|kind| Criterion {
        kind,
        side,
        layer,
        fraction,
        mm,
        mohm,
    })
}

/// Resolves a criterion into one for each side that it is about. One whose quantity is not modelled has none.
pub(super) fn resolve(
    pointer: &str,
    given: &Criterion,
    surfaces: Surfaces<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<(Criterion, Option<Modelled>)> {
    let Some(kind) = diagnostics.enum_member(&format!("{pointer}/kind"), &given.kind) else {
        return Vec::new();
    };
    check_fields(pointer, given, kind, diagnostics);
    let side = given.side.as_ref();
    let sides = sides(pointer, side, given.layer, kind, surfaces, diagnostics);
    if kind == CriterionKind::Resistance {
        let limit = required(
            &format!("{pointer}/mohm"),
            given.mohm,
            &RESISTANCE_MOHM,
            diagnostics,
        );
        // The resistance is that of the whole contact, whichever side is named.
        let named = Criterion {
            side: None,
            ..given.clone()
        };
        let modelled = limit.filter(|_| surfaces.resistance_lacks.is_empty());
        let resolved = limit.map(|_| (named, modelled.map(Modelled::Resistance)));
        return resolved.into_iter().collect();
    }
    let of_side = |side: Side| {
        let layers = surfaces.plating.of(side);
        let criterion = match kind {
            CriterionKind::WornDepth => {
                let mm = required(
                    &format!("{pointer}/mm"),
                    given.mm,
                    &WORN_DEPTH_MM,
                    diagnostics,
                )?;
                scene::Criterion::deepest(side, mm)
            }
            CriterionKind::ExposedFraction => {
                let pointer_of = |field| format!("{pointer}/{field}");
                let fraction = required(
                    &pointer_of("fraction"),
                    given.fraction,
                    &FRACTION,
                    diagnostics,
                )?;
                let above = above(&pointer_of("layer"), given.layer, layers, diagnostics)?;
                scene::Criterion {
                    part: fraction,
                    ..through(side, layers, above)?
                }
            }
            CriterionKind::FirstExposure => {
                let pointer = format!("{pointer}/layer");
                if given.layer.is_none() {
                    diagnostics.missing(
                        &pointer,
                        "the layer that is exposed; the outermost one is 1",
                    );
                    return None;
                }
                let above = above(&pointer, given.layer, layers, diagnostics)?;
                through(side, layers, above)?
            }
            CriterionKind::BaseMetal => through(side, layers, layers.len().checked_sub(1)?)?,
            CriterionKind::Resistance => return None,
        };
        let named = Criterion {
            side: Some(part(side).into()),
            ..given.clone()
        };
        Some((named, Some(Modelled::Depth(criterion))))
    };
    sides.into_iter().filter_map(of_side).collect()
}

/// Through a layer and all layers above it, somewhere.
fn through(side: Side, layers: &[Layer], layer: usize) -> Option<scene::Criterion> {
    let depth_mm = bottoms(layers).nth(layer)?;
    Some(scene::Criterion::deepest(side, depth_mm))
}

/// Number, from 0, of the layer above one whose number counts from 1; the last one above the base if absent.
fn above(
    pointer: &str,
    layer: Option<u64>,
    layers: &[Layer],
    diagnostics: &mut Diagnostics,
) -> Option<usize> {
    let count = layers.len();
    let Some(layer) = layer else {
        return count.checked_sub(1);
    };
    let above = usize::try_from(layer).ok()?.checked_sub(2);
    let above = above.filter(|above| above + 1 < count);
    if above.is_none() {
        let detail = if count < 2 {
            format!(
                "{layer} is not below another layer: there is one layer; below it is the `base_metal`"
            )
        } else {
            format!(
                "{layer} is outside 2 to {count}: 1 is the outermost layer, below the last one is the `base_metal`"
            )
        };
        diagnostics.fault(pointer, detail);
    }
    above
}

/// The sides of a criterion; adds a fault where there is none.
fn sides(
    pointer: &str,
    given: Option<&EnumValue<Part>>,
    layer: Option<u64>,
    kind: CriterionKind,
    surfaces: Surfaces<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<Side> {
    let mut possible = surfaces.sides(kind);
    let (lacks, neither) = if kind == CriterionKind::WornDepth {
        ("does not wear", "neither side wears")
    } else {
        ("is not plated", "neither side is plated")
    };
    let Some(given) = given else {
        if possible.is_empty() {
            diagnostics.fault(pointer, neither);
        }
        // A layer that only one side has is that of this side.
        let has = |side: &Side| {
            let layers = u64::try_from(surfaces.plating.of(*side).len());
            layer.is_none_or(|layer| layers.is_ok_and(|layers| layer <= layers))
        };
        if possible.iter().any(has) {
            possible.retain(has);
        }
        return possible;
    };
    let pointer = format!("{pointer}/side");
    let side = match diagnostics.enum_member(&pointer, given) {
        Some(Part::Slider) => Side::Slider,
        Some(Part::Receptacle) => Side::Receptacle,
        None => return Vec::new(),
    };
    if !possible.contains(&side) {
        diagnostics.fault(&pointer, format!("the {} {lacks}", side.name()));
        return Vec::new();
    }
    vec![side]
}

fn check_fields(
    pointer: &str,
    given: &Criterion,
    kind: CriterionKind,
    diagnostics: &mut Diagnostics,
) {
    let (name, fields): (_, &[&str]) = match kind {
        CriterionKind::FirstExposure => ("first_exposure", &["kind", "side", "layer"]),
        CriterionKind::BaseMetal => ("base_metal", &["kind", "side"]),
        CriterionKind::ExposedFraction => {
            ("exposed_fraction", &["kind", "side", "layer", "fraction"])
        }
        CriterionKind::WornDepth => ("worn_depth", &["kind", "side", "mm"]),
        CriterionKind::Resistance => ("resistance", &["kind", "side", "mohm"]),
    };
    diagnostics.check_fields(pointer, given, fields, name);
}

fn required(
    pointer: &str,
    given: Option<f64>,
    range: &RangeInclusive<f64>,
    diagnostics: &mut Diagnostics,
) -> Option<f64> {
    if given.is_none() {
        diagnostics.missing(pointer, "a criterion of this kind needs it");
    }
    given.map(|value| diagnostics.check_range(pointer, value, range))
}

#[cfg(test)]
mod tests;
