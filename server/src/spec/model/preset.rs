//! Named models, and the dimension that they or the specification give.

use api::spec::{Dimension, Model, ModelPreset, SystemKind};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::{assumed, source};

/// The dimension of a model.
pub(super) fn dimension(
    given: &Model,
    kind: SystemKind,
    diagnostics: &mut Diagnostics,
) -> Dimension {
    const POINTER: &str = "/model/dimension";
    let named = given.preset.as_ref();
    let preset = named.and_then(|preset| diagnostics.enum_member("/model/preset", preset));
    if preset.is_some() && kind != SystemKind::FuzzButton {
        diagnostics.fault("/model/preset", "only a `fuzz_button` has named models");
    }
    let named = given.dimension.as_ref();
    let own = named.and_then(|dimension| diagnostics.enum_member(POINTER, dimension));
    let default = match preset {
        None => assumed(Dimension::PlaneStrain),
        Some(ModelPreset::SourceExtruded) => source(Dimension::Extruded),
        Some(ModelPreset::SourceRing) => source(Dimension::Ring),
    };
    if let (Some(preset), Some(own)) = (preset, own)
        && own != default.value
    {
        let detail = format!(
            "`{}` is `{}`, not `{}`",
            preset.as_str(),
            default.value.as_str(),
            own.as_str()
        );
        diagnostics.fault(POINTER, detail);
    }
    diagnostics.or_default(POINTER, own, default)
}
