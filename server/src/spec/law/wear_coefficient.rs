//! A wear coefficient over a hardness, k/H, of the laws that contain it: given as `k` with `hardness_mpa`, or as
//! `k_over_h_per_mpa`.

use std::ops::RangeInclusive;

use api::spec::{Provenance, WearLaw};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wearing_side::WearingSide;
use crate::spec::materials::HARDNESS_MPA;
use crate::spec::unit;

/// Wear coefficient k, -: from a perfect film (1e-12) to certain removal.
pub(in crate::spec) const K: RangeInclusive<f64> = 0.0..=1.0;
/// k/H, 1/MPa.
pub(in crate::spec) const K_OVER_H_PER_MPA: RangeInclusive<f64> = 0.0..=1.0;

/// Resolves k/H of a law, 1/MPa; returns the law with its hardness filled in.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<f64>) {
    let mut filled = given.clone();
    let k_over_h = match (given.k, given.k_over_h_per_mpa) {
        (Some(_), Some(_)) => {
            diagnostics.exclusive_fields(&side.field("k_over_h_per_mpa"), "k");
            None
        }
        (None, None) => {
            let detail = "write `k` and `hardness_mpa`, or `k_over_h_per_mpa`";
            diagnostics.missing(&side.field("k"), detail);
            None
        }
        (None, Some(ratio)) => {
            if given.hardness_mpa.is_some() {
                diagnostics.foreign_field(&side.pointer, "hardness_mpa", "k_over_h_per_mpa");
            }
            let pointer = side.field("k_over_h_per_mpa");
            diagnostics.provenance(&pointer, Provenance::Given);
            diagnostics.check_unit(&pointer, Some(ratio), &unit::K_OVER_H_PER_MPA);
            Some(diagnostics.check_range(&pointer, ratio, &K_OVER_H_PER_MPA))
        }
        (Some(k), None) => {
            diagnostics.provenance(side.field("k"), Provenance::Given);
            diagnostics.check_range(&side.field("k"), k, &K);
            filled.hardness_mpa = hardness(side, given, diagnostics);
            filled.hardness_mpa.map(|hardness| k / hardness)
        }
    };
    (filled, k_over_h)
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
            Some(diagnostics.check_range(&pointer, hardness, &HARDNESS_MPA))
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
