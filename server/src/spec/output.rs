//! Recorded output.

use std::ops::RangeInclusive;

use api::spec::Output;
use solver::scene;

use crate::number::real;
use crate::spec::diagnostics::Diagnostics;
use crate::spec::movement::Movement;
use crate::spec::sourced::assumed;
use crate::spec::system::Shapes;

/// Most stations and most snapshots of a job: each is a column, or three documents.
pub(in crate::spec) const STATION_LIMIT: usize = 1000;
pub(in crate::spec) const SNAPSHOT_LIMIT: usize = 1000;

const AT_CYCLES: &str = "snapshots_at_cycles";
const AT_DISTANCES: &str = "snapshots_at_distance_mm";

/// Resolves the output.
pub(crate) fn resolve(
    given: &Output,
    movement: &Movement,
    shapes: &Shapes,
    diagnostics: &mut Diagnostics,
) -> (Output, scene::Output) {
    let fields = diagnostics.or_default("/output/fields", given.fields, assumed(false));
    let half = 0.5 * shapes.block.length_mm;
    let cycles = movement.total_cycles;
    let stations_mm = stations(given, movement, half, diagnostics);
    let mut filled = Output {
        stations_mm: Some(stations_mm.clone()),
        fields: Some(fields),
        ..Output::default()
    };
    let mut snapshots = match movement.distance_mm {
        None => {
            let at = at_cycles(given, cycles, diagnostics);
            filled.snapshots_at_cycles = Some(at.clone());
            at
        }
        Some(distance) => {
            let at = at_distances(given, distance, diagnostics);
            let parts = at.iter().map(|at| part(at / distance, cycles)).collect();
            filled.snapshots_at_distance_mm = Some(at);
            parts
        }
    };
    snapshots.sort_unstable();
    snapshots.dedup();
    let recorded = scene::Output {
        stations_mm,
        snapshots_at_cycles: snapshots,
        fields,
    };
    (filled, recorded)
}

/// Stations; defaults derived from a faulty value are no faults of their own.
fn stations(
    given: &Output,
    movement: &Movement,
    half: f64,
    diagnostics: &mut Diagnostics,
) -> Vec<f64> {
    const POINTER: &str = "/output/stations_mm";
    let stations = given.stations_mm.as_deref().unwrap_or_default();
    check_list(
        POINTER,
        stations,
        STATION_LIMIT,
        &(-half..=half),
        diagnostics,
    );
    let default = assumed(default_stations(movement.amplitude_mm, half));
    diagnostics.or_default(POINTER, given.stations_mm.clone(), default)
}

/// Snapshots of a reciprocating motion, at cycles.
fn at_cycles(given: &Output, cycles: u64, diagnostics: &mut Diagnostics) -> Vec<u64> {
    let pointer = format!("/output/{AT_CYCLES}");
    if given.snapshots_at_distance_mm.is_some() {
        diagnostics.foreign_field("/output", AT_DISTANCES, "reciprocating");
    }
    let snapshots = given.snapshots_at_cycles.as_deref().unwrap_or_default();
    diagnostics.check_length(&pointer, snapshots.len(), SNAPSHOT_LIMIT);
    for (index, cycle) in snapshots.iter().enumerate().take(SNAPSHOT_LIMIT) {
        if *cycle > cycles {
            let detail = format!("{cycle} exceeds the number of cycles, {cycles}");
            diagnostics.fault(&format!("{pointer}/{index}"), detail);
        }
    }
    let default = assumed(default_snapshots(cycles));
    diagnostics.or_default(&pointer, given.snapshots_at_cycles.clone(), default)
}

/// Snapshots of a continuous motion, at distances, mm.
fn at_distances(given: &Output, distance: f64, diagnostics: &mut Diagnostics) -> Vec<f64> {
    let pointer = format!("/output/{AT_DISTANCES}");
    if given.snapshots_at_cycles.is_some() {
        diagnostics.foreign_field("/output", AT_CYCLES, "continuous");
    }
    let given = &given.snapshots_at_distance_mm;
    let snapshots = given.as_deref().unwrap_or_default();
    check_list(
        &pointer,
        snapshots,
        SNAPSHOT_LIMIT,
        &(0.0..=distance),
        diagnostics,
    );
    let default = [0.25, 0.5, 0.75, 1.0].map(|share| share * distance);
    diagnostics.or_default(&pointer, given.clone(), assumed(default.to_vec()))
}

/// Checks the length of a list and the entries up to the limit.
fn check_list(
    pointer: &str,
    entries: &[f64],
    limit: usize,
    range: &RangeInclusive<f64>,
    diagnostics: &mut Diagnostics,
) {
    diagnostics.check_length(pointer, entries.len(), limit);
    for (index, entry) in entries.iter().enumerate().take(limit) {
        diagnostics.check_range(&format!("{pointer}/{index}"), *entry, range);
    }
}

/// The part of the distance that is nearest to a share of it; at least the first one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share of a hundred thousand parts, clamped"
)]
fn part(share: f64, parts: u64) -> u64 {
    ((share * real(parts)).round().max(1.0) as u64).min(parts)
}

/// The neutral position and half the amplitude to each side, within the block.
fn default_stations(amplitude_mm: f64, half: f64) -> Vec<f64> {
    [-0.5, 0.0, 0.5]
        .map(|share: f64| (share * amplitude_mm).max(-half).min(half))
        .to_vec()
}

/// The first cycle, the last one and the quarters between.
fn default_snapshots(cycles: u64) -> Vec<u64> {
    let mut snapshots = vec![1, cycles / 4, cycles / 2, cycles / 4 * 3, cycles];
    snapshots.retain(|cycle| *cycle > 0);
    snapshots.sort_unstable();
    snapshots.dedup();
    snapshots
}
