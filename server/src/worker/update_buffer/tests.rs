//! Updates and events of a run.

use solver::record::SideReport;
use solver::sides::Sides;

use super::*;
use crate::solve::checkpoint::EncodedCheckpoint;

fn row(cycle: u64) -> ChildMessage {
    ChildMessage::Cycle(Box::new(CycleReport {
        cycle,
        jump: 1,
        jump_error: 0.0,
        sliding_distance_mm: 0.0,
        receptacle: SideReport::default(),
        slider: SideReport::default(),
        station_depth_mm: Vec::new(),
        exposed_length_mm: Sides::default(),
        resistance: None,
        temperature: None,
        extent: None,
        stations: Vec::new(),
        load_n_per_mm: 0.0,
        peak_pressure_mpa: 0.0,
        contact_half_width_mm: 0.0,
        dissipated_energy_mj_per_mm: 0.0,
        friction_coefficient: 0.0,
    }))
}

#[test]
fn every_row_is_stored_but_few_become_events() {
    let mut buffer = UpdateBuffer::new(2000, 0, Foreseen::default());
    let (mut rows, mut events) = (0, 0);
    for cycle in 0..=2000 {
        buffer.push(row(cycle), 100);
        let update = buffer.take();
        rows += update.rows.len();
        events += update.events.len();
    }
    assert_eq!(rows, 2001);
    assert!(events < 900, "{events}");
    assert!(!buffer.is_dirty());
}

#[test]
fn an_update_that_was_not_recorded_is_repeated_as_it_is() {
    let mut buffer = UpdateBuffer::new(10, 0, Foreseen::default());
    buffer.push(row(1), 100);
    let failed = buffer.take();
    assert_eq!((failed.number, failed.events.len()), (1, 2));
    buffer.push(row(2), 100);
    buffer.put_back(failed.clone());
    assert!(buffer.is_dirty());
    assert_eq!(buffer.take(), failed);
    buffer.put_back(failed.clone());
    let [repeated, last] = &buffer.take_all()[..] else {
        panic!("two updates")
    };
    assert_eq!(repeated, &failed);
    assert_eq!((last.number, last.rows[0].cycle), (2, 2));
    let names: Vec<_> = last.events.iter().map(|event| event.0).collect();
    assert_eq!(names, [EventName::Progress, EventName::Cycle]);
    assert!(!buffer.is_dirty());
    assert_eq!(buffer.restart("because".to_owned()), 3);
    buffer.push(row(1), 100);
    assert_eq!(buffer.take().number, 4);
}

#[test]
fn the_last_update_has_the_last_cycle() {
    let mut buffer = UpdateBuffer::new(
        10,
        0,
        Foreseen::of(r#"{"system":{"kind":"dimm"},"cycles":10}"#),
    );
    buffer.push(row(1), 100);
    buffer.take();
    buffer.push(row(10), 100);
    let [update] = &buffer.take_all()[..] else {
        panic!("one update")
    };
    assert_eq!(
        (update.progress.eta_s, update.progress.eta_most_s),
        (None, None)
    );
    assert!((update.progress.fraction - 1.0).abs() < 1e-15);
    assert_eq!(
        update
            .events
            .iter()
            .map(|event| event.0)
            .collect::<Vec<_>>(),
        [EventName::Progress, EventName::Cycle]
    );
}

#[test]
fn the_newest_checkpoint_is_stored_with_the_rows_before_it() {
    let checkpoint = |cycle| {
        ChildMessage::Checkpoint(EncodedCheckpoint {
            cycle,
            state: Vec::new(),
        })
    };
    let mut buffer = UpdateBuffer::new(10, 3, Foreseen::default());
    assert!((buffer.take().progress.fraction - 0.3).abs() < 1e-15);
    buffer.push(row(4), 100);
    buffer.push(checkpoint(4), 100);
    buffer.push(row(5), 100);
    let update = buffer.take();
    assert_eq!(
        (update.rows.len(), update.checkpoint.map(|c| c.cycle)),
        (2, Some(4))
    );
    buffer.push(checkpoint(5), 100);
    buffer.push(checkpoint(6), 100);
    assert_eq!(buffer.take().checkpoint.map(|c| c.cycle), Some(6));
}

#[test]
fn the_phase_of_the_companions_is_announced() {
    let foreseen = Foreseen::of(r#"{"system":{"kind":"dimm"},"cycles":10}"#);
    let mut buffer = UpdateBuffer::new(10, 0, foreseen);
    buffer.push(row(5), 100);
    let Progress {
        eta_s, eta_most_s, ..
    } = buffer.take().progress;
    assert!(eta_s.is_some() && eta_most_s > eta_s);
    buffer.push(ChildMessage::Phase(Phase::Companions), 10);
    let update = buffer.take();
    assert!(update.progress.eta_most_s > Some(0.0));
    assert_eq!(update.events.len(), 1);
    buffer.push(ChildMessage::Phase(Phase::Companions), 10);
    assert!(buffer.take().events.is_empty());
}

#[test]
fn long_lines_fill_the_buffer_before_many_rows_do() {
    let mut buffer = UpdateBuffer::new(10, 0, Foreseen::default());
    buffer.push(row(1), BYTE_LIMIT - 1);
    assert!(!buffer.is_full());
    buffer.push(row(2), 1);
    assert!(buffer.is_full());
    let failed = buffer.take();
    assert!(!buffer.is_full());
    buffer.put_back(failed);
    assert!(buffer.is_full());
}

#[test]
fn a_finer_run_is_a_stage_of_its_own_with_the_errors_of_the_first_one() {
    let mut buffer = UpdateBuffer::new(100, 0, Foreseen::default());
    let mut stages = Vec::new();
    let mut push = |buffer: &mut UpdateBuffer, line: ChildMessage| {
        buffer.push(line, 100);
        let progress = buffer.take().progress;
        stages.extend(progress.stage.filter(|stage| stages.last() != Some(stage)));
        progress
    };
    for phase in [Phase::Mesh, Phase::Condense, Phase::Cycles] {
        assert_eq!(push(&mut buffer, ChildMessage::Phase(phase)).reason, None);
    }
    push(&mut buffer, row(37));
    push(&mut buffer, ChildMessage::Phase(Phase::Condense));
    push(&mut buffer, ChildMessage::Phase(Phase::Companions));
    buffer.restart("the error is 8 %".to_owned());
    let errors = "the error is 8 %, 2 % are allowed";
    push(&mut buffer, ChildMessage::Refined(errors.to_owned()));
    push(&mut buffer, ChildMessage::Phase(Phase::Mesh));
    let refined = push(&mut buffer, row(1));
    assert_eq!(refined.reason.as_deref(), Some(errors));
    assert_eq!((refined.cycle, refined.fraction), (1, 0.01));
    let expected = [
        Stage::Meshing,
        Stage::Solving,
        Stage::Companions,
        Stage::Refined,
    ];
    assert_eq!(stages, expected);
}

#[test]
fn a_run_that_begins_again_says_why_and_announces_it_at_once() {
    let mut buffer = UpdateBuffer::new(100, 0, Foreseen::default());
    buffer.push(row(50), 100);
    assert_eq!(buffer.take().events.len(), 2);
    buffer.restart("the finer run has no solution".to_owned());
    buffer.push(ChildMessage::Phase(Phase::Mesh), 100);
    let update = buffer.take();
    let reason = update.progress.reason.as_deref();
    assert_eq!(reason, Some("the finer run has no solution"));
    let (name, data) = &update.events[0];
    assert_eq!(*name, EventName::Progress);
    assert!(data.contains("no solution"), "{data}");
}
