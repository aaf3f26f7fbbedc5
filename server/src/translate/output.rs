//! What is recorded, and what ends a run.

use api::spec::{Motion, Output, Provenance, Stop};
use solver::scene;

use super::dimensions::Shapes;
use super::ledger::{Ledger, Range};

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
pub(super) fn resolve(
    given: &Output,
    motion: &Motion,
    shapes: &Shapes,
    cycles: u64,
    ledger: &mut Ledger,
) -> (Output, scene::Output) {
    if given.fields == Some(true) {
        ledger.fault(
            "/output/fields",
            "fields in the bodies are not available yet",
        );
    }
    if given.snapshots_at_distance_mm.is_some() {
        ledger.fault(
            "/output/snapshots_at_distance_mm",
            "belongs to a continuous motion, which is not available yet; write `snapshots_at_cycles`",
        );
    }
    let half = 0.5 * shapes.block.length_mm;
    places(given, half, cycles, ledger);
    let stations = ledger.take(
        "/output/stations_mm",
        given.stations_mm.clone(),
        default_stations(motion.amplitude_mm.unwrap_or_default(), half),
        Provenance::Assumed,
    );
    let snapshots = ledger.take(
        "/output/snapshots_at_cycles",
        given.snapshots_at_cycles.clone(),
        default_snapshots(cycles),
        Provenance::Assumed,
    );
    let mut ascending = snapshots.clone();
    ascending.sort_unstable();
    ascending.dedup();
    let filled = Output {
        stations_mm: Some(stations.clone()),
        snapshots_at_cycles: Some(snapshots),
        snapshots_at_distance_mm: None,
        fields: Some(false),
    };
    (
        filled,
        scene::Output {
            stations_mm: stations,
            snapshots_at_cycles: ascending,
        },
    )
}

/// Checks what was stated; defaults made from a faulty value are no faults of their own.
fn places(given: &Output, half: f64, cycles: u64, ledger: &mut Ledger) {
    let stations = given.stations_mm.as_deref().unwrap_or_default();
    limited("/output/stations_mm", stations.len(), STATION_LIMIT, ledger);
    for (index, station) in stations.iter().enumerate().take(STATION_LIMIT) {
        ledger.check(
            &format!("/output/stations_mm/{index}"),
            *station,
            Range {
                from: -half,
                to: half,
            },
        );
    }
    let snapshots = given.snapshots_at_cycles.as_deref().unwrap_or_default();
    limited(
        "/output/snapshots_at_cycles",
        snapshots.len(),
        SNAPSHOT_LIMIT,
        ledger,
    );
    for (index, cycle) in snapshots.iter().enumerate().take(SNAPSHOT_LIMIT) {
        if *cycle > cycles {
            let pointer = format!("/output/snapshots_at_cycles/{index}");
            ledger.fault(
                &pointer,
                format!("{cycle} exceeds the number of cycles, {cycles}"),
            );
        }
    }
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

fn limited(pointer: &str, length: usize, limit: usize, ledger: &mut Ledger) {
    if length > limit {
        ledger.fault(
            pointer,
            format!("{length} entries, at most {limit} are kept"),
        );
    }
}

/// Checks the stop conditions.
pub(super) fn stop(given: &[Stop], ledger: &mut Ledger) -> Vec<scene::StopCondition> {
    limited("/stop", given.len(), STOP_LIMIT, ledger);
    let mut conditions = Vec::new();
    for (index, condition) in given.iter().enumerate().take(STOP_LIMIT) {
        let pointer = format!("/stop/{index}");
        match condition.worn_depth_mm {
            Some(depth) => {
                ledger.check(&format!("{pointer}/worn_depth_mm"), depth, WORN_DEPTH_MM);
                conditions.push(scene::StopCondition::WornDepth(depth));
            }
            None => ledger.missing(&pointer, "a condition such as `worn_depth_mm`"),
        }
    }
    conditions
}
