//! What is recorded, and what ends a run.

use api::spec::{Output, Provenance, Stop};
use solver::scene;

use crate::spec::diagnostics::{Diagnostics, Range};
use crate::spec::geometry::Shapes;
use crate::spec::motion::Imposed;

/// Most stations and most snapshots of a job: each is a column, or three documents.
const STATION_LIMIT: usize = 1000;
const SNAPSHOT_LIMIT: usize = 1000;
const STOP_LIMIT: usize = 16;
/// mm.
const WORN_DEPTH_MM: Range = Range {
    from: 1e-9,
    to: 1e4,
};

/// Fills in what is recorded.
pub(crate) fn resolve(
    given: &Output,
    imposed: &Imposed,
    shapes: &Shapes,
    cycles: u64,
    diagnostics: &mut Diagnostics,
) -> (Output, scene::Output) {
    let fields = diagnostics.take("/output/fields", given.fields, false, Provenance::Assumed);
    let half = 0.5 * shapes.block.length_mm;
    stations(given, half, diagnostics);
    let stations_mm = diagnostics.take(
        "/output/stations_mm",
        given.stations_mm.clone(),
        default_stations(imposed.motion.amplitude_mm.unwrap_or_default(), half),
        Provenance::Assumed,
    );
    let mut filled = Output {
        stations_mm: Some(stations_mm.clone()),
        snapshots_at_cycles: None,
        snapshots_at_distance_mm: None,
        fields: Some(fields),
    };
    let mut ascending = match imposed.distance_mm() {
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
    ascending.sort_unstable();
    ascending.dedup();
    let recorded = scene::Output {
        stations_mm,
        snapshots_at_cycles: ascending,
        fields,
    };
    (filled, recorded)
}

/// Checks the stations that were stated; defaults made from a faulty value are no faults of their own.
fn stations(given: &Output, half: f64, diagnostics: &mut Diagnostics) {
    let stations = given.stations_mm.as_deref().unwrap_or_default();
    limited(
        "/output/stations_mm",
        stations.len(),
        STATION_LIMIT,
        diagnostics,
    );
    for (index, station) in stations.iter().enumerate().take(STATION_LIMIT) {
        let range = Range {
            from: -half,
            to: half,
        };
        diagnostics.check(&format!("/output/stations_mm/{index}"), *station, range);
    }
}

/// Snapshots of a reciprocating motion, at cycles.
fn at_cycles(given: &Output, cycles: u64, diagnostics: &mut Diagnostics) -> Vec<u64> {
    const POINTER: &str = "/output/snapshots_at_cycles";
    let misplaced = given.snapshots_at_distance_mm.is_some();
    diagnostics.misplaced(
        "/output",
        &[("snapshots_at_distance_mm", misplaced)],
        "reciprocating",
    );
    let snapshots = given.snapshots_at_cycles.as_deref().unwrap_or_default();
    limited(POINTER, snapshots.len(), SNAPSHOT_LIMIT, diagnostics);
    for (index, cycle) in snapshots.iter().enumerate().take(SNAPSHOT_LIMIT) {
        if *cycle > cycles {
            let detail = format!("{cycle} exceeds the number of cycles, {cycles}");
            diagnostics.fault(&format!("{POINTER}/{index}"), detail);
        }
    }
    let default = default_snapshots(cycles);
    diagnostics.take(
        POINTER,
        given.snapshots_at_cycles.clone(),
        default,
        Provenance::Assumed,
    )
}

/// Snapshots of a continuous motion, at distances, mm.
fn at_distances(given: &Output, distance: f64, diagnostics: &mut Diagnostics) -> Vec<f64> {
    const POINTER: &str = "/output/snapshots_at_distance_mm";
    let misplaced = given.snapshots_at_cycles.is_some();
    diagnostics.misplaced(
        "/output",
        &[("snapshots_at_cycles", misplaced)],
        "continuous",
    );
    let snapshots = given
        .snapshots_at_distance_mm
        .as_deref()
        .unwrap_or_default();
    limited(POINTER, snapshots.len(), SNAPSHOT_LIMIT, diagnostics);
    for (index, at) in snapshots.iter().enumerate().take(SNAPSHOT_LIMIT) {
        let range = Range {
            from: 0.0,
            to: distance,
        };
        diagnostics.check(&format!("{POINTER}/{index}"), *at, range);
    }
    let default = [0.25, 0.5, 0.75, 1.0]
        .map(|share| share * distance)
        .to_vec();
    diagnostics.take(
        POINTER,
        given.snapshots_at_distance_mm.clone(),
        default,
        Provenance::Assumed,
    )
}

/// The part of the distance that lies nearest to a share of it; the first one at least.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share of a hundred thousand parts, clamped"
)]
fn part(share: f64, parts: u64) -> u64 {
    ((share * parts as f64).round().max(1.0) as u64).min(parts)
}

/// The neutral position and half the amplitude to each side, where the block is.
fn default_stations(amplitude_mm: f64, half: f64) -> Vec<f64> {
    [-0.5, 0.0, 0.5]
        .map(|share: f64| (share * amplitude_mm).max(-half).min(half))
        .to_vec()
}

/// The first cycle, the end and the quarters between.
fn default_snapshots(cycles: u64) -> Vec<u64> {
    let mut snapshots = vec![1, cycles / 4, cycles / 2, cycles / 4 * 3, cycles];
    snapshots.retain(|cycle| *cycle > 0);
    snapshots.sort_unstable();
    snapshots.dedup();
    snapshots
}

fn limited(pointer: &str, length: usize, limit: usize, diagnostics: &mut Diagnostics) {
    if length > limit {
        diagnostics.fault(
            pointer,
            format!("{length} entries, at most {limit} are kept"),
        );
    }
}

/// Checks the stop conditions.
pub(crate) fn stop(given: &[Stop], diagnostics: &mut Diagnostics) -> Vec<scene::StopCondition> {
    limited("/stop", given.len(), STOP_LIMIT, diagnostics);
    let mut conditions = Vec::new();
    for (index, condition) in given.iter().enumerate().take(STOP_LIMIT) {
        let pointer = format!("/stop/{index}");
        match condition.worn_depth_mm {
            Some(depth) => {
                diagnostics.check(&format!("{pointer}/worn_depth_mm"), depth, WORN_DEPTH_MM);
                conditions.push(scene::StopCondition::WornDepth(depth));
            }
            None => diagnostics.missing(&pointer, "a condition such as `worn_depth_mm`"),
        }
    }
    conditions
}
