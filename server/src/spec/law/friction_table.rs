//! A coefficient of friction by cycle or by dose: a table, as measured.

use std::ops::RangeInclusive;

use api::spec::{FrictionAtCycle, FrictionAtDose, Provenance};
use solver::law::surface::SurfaceWear;
use solver::scene::{Layer, Table, WearLaw};
use solver::sides::{Side, Sides};

use crate::number::real;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::motion::CYCLES;

pub(in crate::spec) const BY_CYCLE: &str = "/interface/friction/by_cycle";
pub(in crate::spec) const BY_DOSE: &str = "/interface/friction/by_dose";

/// Coefficient of friction, -; the highest of clean metals in air stay below 2.
pub(in crate::spec) const COEFFICIENT_RANGE: RangeInclusive<f64> = 0.0..=2.0;
/// Points of a table.
pub(in crate::spec) const MOST_POINTS: usize = 64;
/// Cycles done, up to those of the longest job.
pub(in crate::spec) const CYCLE: RangeInclusive<u64> = 0..=*CYCLES.end();
/// Dose of a place, MPa mm: 1 000 MPa over the largest number of strokes of a metre.
pub(in crate::spec) const DOSE_MPA_MM: RangeInclusive<f64> = 0.0..=1e15;

/// Resolves a table by cycle.
pub(super) fn by_cycle(given: &[FrictionAtCycle], diagnostics: &mut Diagnostics) -> Option<Table> {
    for (index, point) in given.iter().enumerate().take(MOST_POINTS) {
        diagnostics.check_count(&format!("{BY_CYCLE}/{index}/cycle"), point.cycle, &CYCLE);
    }
    let points = given
        .iter()
        .map(|point| (real(point.cycle), point.coefficient));
    let points: Vec<_> = points.collect();
    table(BY_CYCLE, "cycle", &points, diagnostics)
}

/// Resolves a table by dose.
pub(super) fn by_dose(given: &[FrictionAtDose], diagnostics: &mut Diagnostics) -> Option<Table> {
    for (index, point) in given.iter().enumerate().take(MOST_POINTS) {
        let pointer = format!("{BY_DOSE}/{index}/dose_mpa_mm");
        diagnostics.check_range(&pointer, point.dose_mpa_mm, &DOSE_MPA_MM);
    }
    let points = given
        .iter()
        .map(|point| (point.dose_mpa_mm, point.coefficient));
    let points: Vec<_> = points.collect();
    table(BY_DOSE, "dose_mpa_mm", &points, diagnostics)
}

/// The table of points, place and coefficient; `None` for one that has faults in its order.
fn table(
    pointer: &str,
    field: &str,
    points: &[(f64, f64)],
    diagnostics: &mut Diagnostics,
) -> Option<Table> {
    diagnostics.provenance(pointer, Provenance::Given);
    diagnostics.check_length(pointer, points.len(), MOST_POINTS);
    for (index, (_, coefficient)) in points.iter().enumerate().take(MOST_POINTS) {
        let pointer = format!("{pointer}/{index}/coefficient");
        diagnostics.check_range(&pointer, *coefficient, &COEFFICIENT_RANGE);
    }
    if points.len() < 2 {
        let detail =
            "a table has two points or more; write `coefficient` for one that does not change";
        diagnostics.fault(pointer, detail);
        return None;
    }
    let mut ascends = points.len() <= MOST_POINTS;
    for (index, pair) in points.windows(2).enumerate().take(MOST_POINTS) {
        let [(before, _), (here, _)] = [pair[0], pair[1]];
        if here <= before {
            let pointer = format!("{pointer}/{}/{field}", index + 1);
            let detail = format!("{here} is not above the {before} of the point before");
            diagnostics.fault(&pointer, detail);
            ascends = false;
        }
    }
    ascends.then(|| Table::new(points))
}

/// Checks that the doses of a table can be read from worn depths, beside the laws of the bases and the layers over them.
pub(in crate::spec) fn check_doses(
    table: &Table,
    wear: &Sides<Option<WearLaw>>,
    plating: &Sides<Vec<Layer>>,
    diagnostics: &mut Diagnostics,
) {
    let last = table.points().last().map_or(0.0, |point| point.at);
    let mut wears = false;
    for side in Side::BOTH {
        let Some(surface) = SurfaceWear::new(plating.of(side), *wear.of(side)) else {
            continue;
        };
        let Some(rate) = surface.dose_rate() else {
            let detail = format!(
                "the wear of the {} differs from state to state, so that its depth does not tell the dose; write `by_cycle`",
                side.name()
            );
            diagnostics.fault(BY_DOSE, detail);
            wears = true;
            continue;
        };
        wears |= rate > 0.0;
        let most = surface.equivalent(surface.deepest()) / rate;
        if rate > 0.0 && last > most {
            let detail = format!(
                "the base of the {} does not wear, so that no depth tells a dose beyond {most:.4e} MPa mm; the table changes up to \
                 {last:.4e}",
                side.name()
            );
            diagnostics.fault(BY_DOSE, detail);
        }
    }
    if !wears {
        let detail = "neither part wears, and the dose of a place is read from its worn depth; write `by_cycle`";
        diagnostics.fault(BY_DOSE, detail);
    }
}

#[cfg(test)]
mod tests;
