//! A wear coefficient over a hardness, k/H, of the laws that contain it: given as `k` with `hardness_mpa`, or as
//! `k_over_h_per_mpa`.

use std::ops::RangeInclusive;

use api::spec::{Provenance, WearLaw};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition::{Absent, FieldGroup, Number, Scaling, number};
use crate::spec::law::values::Values;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::materials;
use crate::spec::unit;

/// Wear coefficient k, -: from a perfect film (1e-12) to certain removal.
pub(super) const K: RangeInclusive<f64> = 0.0..=1.0;
/// k/H, 1/MPa.
pub(super) const K_OVER_H_PER_MPA: RangeInclusive<f64> = 0.0..=1.0;

const COEFFICIENT: Number = number!(
    k,
    "k",
    K,
    Absent::Other("required, or `k_over_h_per_mpa` instead")
)
.scaled(Scaling::Proportional);
const HARDNESS_MPA: Number = number!(
    hardness_mpa,
    "H",
    materials::HARDNESS_MPA,
    Absent::Other("that of the material")
);
const RATIO: Number = number!(
    k_over_h_per_mpa,
    "k/H",
    K_OVER_H_PER_MPA,
    Absent::Other("`k` over `hardness_mpa`")
)
.scaled(Scaling::Proportional);

/// k/H in one of both forms.
pub(super) const K_OVER_H: FieldGroup = FieldGroup {
    numbers: &[COEFFICIENT, HARDNESS_MPA, RATIO],
    resolve: |_, values, diagnostics| k_over_h(values, diagnostics),
};

fn k_over_h(values: &mut Values<'_>, diagnostics: &mut Diagnostics) {
    let side = values.side;
    let ratio_pointer = side.field("k_over_h_per_mpa");
    match (values.given.k, values.given.k_over_h_per_mpa) {
        (Some(_), Some(_)) => diagnostics.exclusive_fields(&ratio_pointer, "k"),
        (None, None) => {
            let detail = "write `k` and `hardness_mpa`, or `k_over_h_per_mpa`";
            diagnostics.missing(&side.field("k"), detail);
        }
        (None, ratio) => {
            if values.given.hardness_mpa.is_some() {
                diagnostics.foreign_field(&side.pointer, "hardness_mpa", "k_over_h_per_mpa");
            }
            diagnostics.check_unit(&ratio_pointer, ratio, &unit::K_OVER_H_PER_MPA);
            RATIO.resolve(values, diagnostics);
        }
        (Some(_), None) => {
            COEFFICIENT.resolve(values, diagnostics);
            values.law.hardness_mpa = hardness(side, values.given, diagnostics);
        }
    }
}

/// Resolves k and the hardness of a law that takes no ratio of them; returns the law with its hardness filled in.
pub(super) fn with_hardness(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> WearLaw {
    let needs = "write `k`, beside the hardness of the law or of the material";
    diagnostics.required(&side.field("k"), given.k, &K, needs);
    WearLaw {
        hardness_mpa: hardness(side, given, diagnostics),
        ..given.clone()
    }
}

/// The hardness of a wearing surface: given, or the material's.
pub(super) fn hardness(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> Option<f64> {
    let pointer = side.field("hardness_mpa");
    match (given.hardness_mpa, side.hardness_mpa()) {
        (Some(hardness), _) => {
            diagnostics.provenance(&pointer, Provenance::Given);
            diagnostics.check_unit(&pointer, Some(hardness), &unit::HARDNESS_MPA);
            Some(diagnostics.check_range(&pointer, hardness, &materials::HARDNESS_MPA))
        }
        (None, Some(hardness)) => {
            diagnostics.provenance(&pointer, Provenance::Typical);
            Some(hardness)
        }
        (None, None) => {
            let detail = "neither the law nor the material states a hardness";
            diagnostics.missing(&pointer, detail);
            None
        }
    }
}
