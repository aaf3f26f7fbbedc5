//! A wear coefficient over a hardness, k/H, of the laws that contain it: given as `k` with `hardness_mpa`, or as
//! `k_over_h_per_mpa`.

use std::ops::RangeInclusive;

use api::spec::Provenance;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition::{Absent, FieldGroup, Number, Scaling, number};
use crate::spec::law::values::Values;
use crate::spec::materials;
use crate::spec::unit;

/// Wear coefficient k, -: from a perfect film (1e-12) to certain removal.
pub(super) const K: RangeInclusive<f64> = 0.0..=1.0;
/// k/H, 1/MPa.
const K_OVER_H_PER_MPA: RangeInclusive<f64> = 0.0..=1.0;

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

/// The hardness of a wearing surface: given, or the material's.
pub(super) const HARDNESS: FieldGroup = FieldGroup {
    numbers: &[HARDNESS_MPA],
    resolve: |_, values, diagnostics| hardness(values, diagnostics),
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
            hardness(values, diagnostics);
        }
    }
}

fn hardness(values: &mut Values<'_>, diagnostics: &mut Diagnostics) {
    let pointer = values.side.field("hardness_mpa");
    match (values.given.hardness_mpa, values.side.hardness_mpa()) {
        (given @ Some(_), _) => {
            diagnostics.check_unit(&pointer, given, &unit::HARDNESS_MPA);
            HARDNESS_MPA.resolve(values, diagnostics);
        }
        (None, of_material @ Some(_)) => {
            diagnostics.provenance(&pointer, Provenance::Typical);
            values.law.hardness_mpa = of_material;
        }
        (None, None) => {
            let detail = "neither the law nor the material states a hardness";
            diagnostics.missing(&pointer, detail);
        }
    }
}
