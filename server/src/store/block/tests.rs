//! Blocks of small results: what is written is read again, and damage is noticed.

use api::results::{Loop, Profile};

use super::*;

fn snapshot(cycle: u64) -> Snapshot {
    Snapshot {
        profile: Profile {
            cycle,
            ..Profile::default()
        },
        pressure: api::results::Pressure {
            cycle,
            positions: Vec::new(),
        },
        friction_loop: Loop {
            cycle,
            displacement_mm: vec![0.1, 1.0 / 3.0],
            tangential_force_n_per_mm: vec![f64::MIN_POSITIVE, -1e300],
            tangential_force_n: Vec::new(),
        },
    }
}

fn row(cycle: u64) -> CycleReport {
    CycleReport {
        cycle,
        sliding_distance_mm: 1.0 / 7.0,
        ..CycleReport::default()
    }
}

/// A block with history, snapshots and two documents.
fn block() -> Block {
    let mut block = Block::default();
    let rows: Vec<_> = (0..50).map(row).collect();
    let pushed = block.push_history(&rows, &[10, 20, 40].map(snapshot));
    assert!(pushed.expect("JSON"));
    for (name, bytes) in [("a.csv", b"x_mm\n1\n".as_slice()), ("b.svg", b"<svg/>")] {
        let file = manifest_entry(name, Some(3), "text/plain", bytes);
        assert!(block.push_document(&file, bytes));
    }
    block
}

fn decoded(encoded: &EncodedBlock) -> Block {
    Block::decode(&encoded.entries, &encoded.content).expect("entries")
}

#[test]
fn every_result_comes_back_as_it_was() {
    let encoded = block().encode().expect("JSON");
    assert!(encoded.has_history);
    assert!(
        10 * encoded.content.len() < block().content.len(),
        "{}",
        encoded.content.len()
    );
    let found = decoded(&encoded);
    assert_eq!(found, block());
    let rows: Vec<_> = (0..50).map(row).collect();
    assert_eq!(found.history().expect("whole"), Some(rows));
    let snapshots = [10, 20, 40].map(snapshot).to_vec();
    assert_eq!(found.snapshots().expect("whole"), Some(snapshots));
    let (entry, bytes) = found.document("b.svg").expect("a document");
    assert_eq!((entry.cycle, bytes.as_slice()), (Some(3), &b"<svg/>"[..]));
    assert_eq!(found.document("history"), None);
    let names: Vec<_> = Block::listed(&encoded.entries).expect("entries");
    let names: Vec<_> = names.iter().map(|file| file.name.as_str()).collect();
    assert_eq!(names, ["a.csv", "b.svg"]);
}

#[test]
fn the_nearest_snapshot_is_found_and_the_earlier_of_two() {
    let block = block();
    for (cycle, nearest) in [(0, 10), (15, 10), (16, 20), (30, 20), (u64::MAX, 40)] {
        for part in [
            SnapshotPart::Profile,
            SnapshotPart::Pressure,
            SnapshotPart::Loop,
        ] {
            let found = block.snapshot(part, cycle).expect("whole").expect("one");
            let OfCycle { cycle: found } = serde_json::from_str(&found).expect("JSON");
            assert_eq!(found, nearest, "{cycle}");
        }
    }
    assert_eq!(
        Block::default()
            .snapshot(SnapshotPart::Loop, 1)
            .expect("whole"),
        None
    );
}

#[test]
fn damage_is_found_wherever_it_is() {
    let encoded = block().encode().expect("JSON");
    for at in 0..encoded.content.len() {
        let mut content = encoded.content.clone();
        content[at] ^= 0x10;
        let found = Block::decode(&encoded.entries, &content).expect("entries");
        let sound =
            |(entry, bytes): (&ResultFile, &[u8])| checksum::check_bytes(entry, bytes).is_ok();
        let is_sound = found.all().all(sound);
        // Some bits of the format do not change what is decompressed.
        assert_eq!(
            is_sound,
            found.content[..block().content.len().min(found.content.len())] == block().content,
            "{at}"
        );
    }
    let short = Block::decode(&encoded.entries, &encoded.content[..40]).expect("entries");
    assert!(matches!(short.snapshots(), Err(BlockError::Damaged { .. })));
    assert!(Block::decode(&encoded.entries[1..], &encoded.content).is_err());
}

#[test]
fn what_does_not_fit_is_refused() {
    let mut block = Block::default();
    let bytes = vec![b' '; LIMIT];
    let file = manifest_entry("long", None, JSON, &bytes);
    assert!(block.push_document(&file, &bytes));
    assert!(!block.push_document(&file, b" "));
    assert!(!block.push_history(&[], &[]).expect("JSON"));
    let encoded = block.encode().expect("JSON");
    assert!(!encoded.has_history);
    assert_eq!(decoded(&encoded).history().expect("whole"), None);
}

#[test]
fn a_mark_of_damage_is_stored_and_taken_back() {
    let mut block = block();
    let marked = block.mark("a.csv", Some("gone")).expect("JSON");
    let listed = Block::listed(&marked.expect("a change")).expect("entries");
    assert_eq!(listed[0].damaged.as_deref(), Some("gone"));
    assert_eq!(block.mark("a.csv", Some("gone")).expect("JSON"), None);
    assert!(block.mark("a.csv", None).expect("JSON").is_some());
    assert_eq!(block.mark("c.csv", None).expect("JSON"), None);
}
