//! The largest difference of two runs' outputs.

use solver::record::{CycleReport, Summary};

use crate::hard::run::Run;

/// Tolerance of pressures and of the contact's width over that of depth, width and area, as in error control.
const PRESSURE: f64 = 3.0;
/// Part of the cycles, at the end, over which pressures and widths of the contact are averaged: where a plating stands at the edge of the
/// contact they change from one cycle to the next, and a rate that differs by a part of the tolerance moves such an event by a cycle.
const LAST: f64 = 0.1;

/// The largest relative difference of an output over what the tolerance allows it, and its name: depths of both sides over
/// the deepest, areas over their sum.
pub(super) fn largest(run: &Run, reference: &Run) -> (f64, &'static str) {
    let (run_reports, reports) = (&run.reports, &reference.reports);
    let (run, reference) = (run.summary(), reference.summary());
    let (a, b) = (&run.last, &reference.last);
    let late = |of: fn(&CycleReport) -> f64| {
        relative(late_mean(run_reports, of), late_mean(reports, of)) / PRESSURE
    };
    let sides = |of: fn(&Summary) -> [f64; 2]| (of(run), of(reference));
    let (depth, depth_reference) =
        sides(|s| [s.last.slider.max_depth_mm, s.last.receptacle.max_depth_mm]);
    let (area, area_reference) =
        sides(|s| [s.last.slider.worn_area_mm2, s.last.receptacle.worn_area_mm2]);
    let (width, width_reference) = sides(|s| {
        [
            s.last.slider.scar_half_width_mm,
            s.last.receptacle.scar_half_width_mm,
        ]
    });
    // A width is read between nodes.
    let half_element = 0.5 * reference.resolution.contact_element_mm;
    let between_nodes = |difference: f64| (difference.abs() - half_element).max(0.0);
    let deepest = depth_reference[0].max(depth_reference[1]);
    let widest = width_reference[0].max(width_reference[1]);
    let whole = area_reference[0] + area_reference[1];
    [
        ("depth", over(apart(depth, depth_reference), deepest)),
        // The width of the wider scar: that of a scar without depth says nothing.
        (
            "width",
            over(between_nodes(width[0].max(width[1]) - widest), widest),
        ),
        ("area", over(apart(area, area_reference), whole)),
        ("peak pressure", late(|report| report.peak_pressure_mpa)),
        ("half-width", late(|report| report.contact_half_width_mm)),
        (
            "unworn peak pressure",
            relative(
                run.initial.peak_pressure_mpa,
                reference.initial.peak_pressure_mpa,
            ) / PRESSURE,
        ),
        (
            "energy",
            relative(a.dissipated_energy_mj_per_mm, b.dissipated_energy_mj_per_mm),
        ),
    ]
    .into_iter()
    .fold((0.0, "none"), |most, (name, difference)| {
        if difference > most.0 {
            (difference, name)
        } else {
            most
        }
    })
}

/// Mean over the last cycles of a run.
fn late_mean(reports: &[CycleReport], of: fn(&CycleReport) -> f64) -> f64 {
    let count = |cycles: u64| f64::from(u32::try_from(cycles).expect("few cycles"));
    let end = reports.last().map_or(0.0, |report| count(report.cycle));
    let is_late = |report: &&CycleReport| count(report.cycle) > (1.0 - LAST) * end;
    let (mut sum, mut cycles) = (0.0, 0.0);
    for report in reports.iter().filter(is_late) {
        sum += count(report.jump) * of(report);
        cycles += count(report.jump);
    }
    sum / cycles
}

/// The larger difference of either side.
fn apart(values: [f64; 2], reference: [f64; 2]) -> f64 {
    let apart = values.iter().zip(reference).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max)
}

/// A difference over a scale; none of nothing is none.
fn over(difference: f64, scale: f64) -> f64 {
    assert!(difference.is_finite(), "an output is not finite");
    if difference > 0.0 {
        difference / scale
    } else {
        0.0
    }
}

fn relative(value: f64, reference: f64) -> f64 {
    over((value - reference).abs(), reference)
}
