//! Resolution: from a specification as users write it to the scene that the engine solves.
//!
//! A specification is refused with *all* its faults, each with its JSON pointer; an accepted one comes back with every
//! default filled in and the provenance of each value. Mesh lines are placed, which shows whether a scene can be
//! meshed; nothing is meshed or estimated.

mod accuracy;
mod blocks;
mod cause;
mod changing_friction;
pub(crate) mod coefficients;
mod conductors;
mod criterion;
mod diagnostics;
mod effects;
mod environment;
mod filled;
mod films;
pub mod law;
mod law_range;
mod life;
mod load;
mod materials;
mod mission;
mod model;
mod motion;
mod movement;
mod names;
mod output;
mod plating;
mod plating_choice;
mod rated_life;
mod repair;
mod resistance_range;
pub(crate) mod scatter;
pub(crate) mod schema;
mod sourced;
mod spots;
mod stages;
mod stop;
mod suggestion;
mod system;
mod unit;

use api::problem::Fault;
use api::results::BlockExtent;
use api::spec::{DerivedMotion, ParseError, Spec, SystemKind};
use solver::model::Layout;
use solver::scene::Scene;

use diagnostics::Diagnostics;
pub(crate) use diagnostics::NAME_LIMIT;
use filled::{Filled, scene_of};
pub(crate) use materials::name as material_name;
pub(crate) use motion::CYCLES;
pub(crate) use names::{LABEL_LIMIT, LABEL_TEXT_LIMIT};
pub(crate) use rated_life::RatedMatings;
use stages::{Bodies, Loading, Numerics};
pub(crate) use suggestion::did_you_mean;
pub(crate) use system::definition as system_definition;

/// Mark at the beginning of a file that editors of Windows write; parsers of JSON may ignore it (RFC 8259, 8.1).
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// A specification with every default filled in, and its scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// The complete specification, with the provenance of each value.
    pub spec: Spec,
    /// The dimension that was chosen for it, with the reason; nothing where it is given.
    pub chosen: Option<String>,
    /// The kind of its system.
    pub kind: SystemKind,
    /// The scene.
    pub scene: Scene,
    /// Mesh lines, which show that it can be meshed; none of a point contact.
    pub layout: Option<Layout>,
    /// How its motion was derived from a vibration, a thermal cycle or an insertion.
    pub motion: Option<DerivedMotion>,
    /// The blocks of its mission.
    pub blocks: Vec<BlockExtent>,
    /// Data missing for a criterion of the contact resistance, in words; empty if the resistance is modelled.
    pub resistance_lacks: Vec<String>,
    /// Values that were probably written in another unit.
    pub warnings: Vec<Fault>,
}

/// Reason for which a submitted document is refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refused {
    /// The document cannot be parsed.
    #[error(transparent)]
    Parse(#[from] ParseError),
    /// The specification has these faults.
    #[error("the specification has {} fault(s)", .0.len())]
    Faults(Vec<Fault>),
}

/// Parses and resolves a submitted document.
///
/// # Errors
/// [`Refused`] with the pointer of every fault.
pub fn read(bytes: &[u8]) -> Result<Resolved, Refused> {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let (spec, mut unknown) = match Spec::read(bytes) {
        Ok(read) => read,
        Err(error) => {
            let faults = |spec: &Spec| resolve(spec).err().unwrap_or_default();
            return Err(Refused::Parse(repair::with_others(error, bytes, faults)));
        }
    };
    suggestion::suggest_fields(&mut unknown);
    match resolve(&spec) {
        Ok(resolved) if unknown.is_empty() => Ok(resolved),
        Ok(_) => Err(Refused::Faults(unknown)),
        Err(faults) => Err(Refused::Faults(unknown.into_iter().chain(faults).collect())),
    }
}

/// The text of a submitted document.
pub fn text(bytes: &[u8]) -> String {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    String::from_utf8_lossy(bytes).into_owned()
}

/// Resolves a specification.
///
/// # Errors
/// All faults, each with its JSON pointer.
pub fn resolve(spec: &Spec) -> Result<Resolved, Vec<Fault>> {
    let mut diagnostics = Diagnostics::default();
    names::check(spec, &mut diagnostics);
    let Some(kind) = diagnostics.enum_member("/system/kind", &spec.system.kind) else {
        return Err(diagnostics.into_faults());
    };
    let bodies = Bodies::resolve(kind, spec, &mut diagnostics);
    let loading = Loading::resolve(&bodies, spec, &mut diagnostics);
    let numerics = Numerics::resolve(&loading, spec, &mut diagnostics);
    let mut filled = filled::resolve(&numerics, &mut diagnostics);
    if !diagnostics.is_clean() {
        return Err(diagnostics.into_faults());
    }
    let layout = layout(spec, &numerics, &filled.scene, &mut diagnostics);
    if !diagnostics.is_clean() {
        return Err(diagnostics.into_faults());
    }
    let of_values = diagnostics.warnings().iter().cloned();
    let warnings = of_values.chain(warnings(spec, &loading, &filled));
    let warnings = warnings.collect();
    let scattered = scatter::scenes(&filled.spec, &filled.scene, |spec| scene_of(spec, kind));
    filled.scene.scattered = scattered;
    let blocks = blocks::extents(&filled.spec, &loading.movement);
    filled.spec.provenance = diagnostics.finish()?;
    Ok(Resolved {
        spec: filled.spec,
        chosen: filled.chosen,
        kind,
        scene: filled.scene,
        layout,
        motion: loading.movement.derived,
        blocks,
        resistance_lacks: filled.resistance_lacks,
        warnings,
    })
}

/// Checks the scene of a specification against its switches, and places its mesh lines; none of a point contact.
fn layout(
    given: &Spec,
    numerics: &Numerics<'_>,
    scene: &Scene,
    diagnostics: &mut Diagnostics,
) -> Option<Layout> {
    let strains_cause = || {
        let is_possible = |scene: &Scene| effects::has_small_strains(&given.effects, scene);
        cause::of_fault(given, numerics, "/load", is_possible)
    };
    effects::check(&given.effects, scene, strains_cause, diagnostics);
    if scene.dimension.point().is_some() {
        return None;
    }
    match Layout::of(scene) {
        Ok(layout) => {
            model::check_size(scene, &layout, diagnostics);
            Some(layout)
        }
        Err(error) => {
            let is_possible = |scene: &Scene| Layout::of(scene).is_ok();
            let pointer = cause::of_fault(given, numerics, "/system", is_possible);
            diagnostics.fault(&pointer, error.to_string());
            None
        }
    }
}

/// Warnings of a scene without faults.
fn warnings(given: &Spec, loading: &Loading<'_>, filled: &Filled) -> Vec<Fault> {
    let Filled { spec, scene, .. } = filled;
    let bodies = loading.bodies;
    let mut warnings = plating_choice::warnings(given, &bodies.preset);
    warnings.extend(law_range::warnings(spec, scene));
    warnings.extend(resistance_range::warnings(given, scene));
    warnings.extend(model::warnings(scene));
    warnings.extend(effects::warnings(scene));
    warnings.extend(rated_life::warnings(
        bodies.kind,
        spec.motion.as_ref(),
        scene,
    ));
    warnings.extend(life::warnings(&spec.life, scene));
    let derived = || loading.movement.all_derived();
    let of_slip = changing_friction::warnings_of_derived_slip(derived(), scene);
    warnings.extend(of_slip);
    let sticks = derived().filter(|(_, motion)| motion.sticks);
    warnings.extend(sticks.map(|(pointer, motion)| Fault::new(&pointer, motion.reason.clone())));
    warnings
}

/// Cycles in the histories of a resolved specification.
pub fn cycles(spec: &Spec) -> u64 {
    if is_continuous(spec) {
        return motion::CONTINUOUS_PARTS;
    }
    let blocks = spec.mission.iter().filter_map(|block| block.cycles);
    let mission = blocks.fold(0, u64::saturating_add);
    spec.cycles
        .unwrap_or_else(|| mission.saturating_mul(spec.repeat.unwrap_or(1)))
}

/// Returns `true` if the motion of a resolved specification is continuous.
pub(crate) fn is_continuous(spec: &Spec) -> bool {
    let motion = spec.motion.as_ref();
    motion.is_some_and(|motion| motion.distance_mm.is_some())
}

#[cfg(test)]
mod tests;
