//! Times left in each stage of a solve.

use super::*;

/// A life of the gold of the SD card, which ends long before the last cycle.
const LIFE: &str =
    r#"{"system":{"kind":"sd_card"},"cycles":10000000,"stop":[{"kind":"base_metal"}]}"#;

fn of(text: &str) -> RemainingTime {
    RemainingTime::new(Foreseen::of(text), 0)
}

fn left(time: &RemainingTime, at_s: f64) -> ExpectedTime {
    time.remaining(at_s).expect("it is known")
}

fn is_near(value: f64, expected: f64) -> bool {
    (value / expected - 1.0).abs() < 1e-12
}

#[test]
fn a_life_is_foreseen_to_its_end_and_not_to_the_last_cycle() {
    let foreseen = Foreseen::of(LIFE);
    let end = foreseen.end();
    assert!(foreseen.stops && end < 1_000_000, "{end}");
    let mut time = of(LIFE);
    assert_eq!(time.remaining(1.0), None);
    // Most cycles are passed by a few long jumps at the end.
    let early = end / 50;
    let done = foreseen.share(early);
    assert!((0.1..0.8).contains(&done), "{done}");
    time.computed(early, 10.0);
    let ExpectedTime { likely_s, most_s } = left(&time, 10.0);
    let whole = 10.0 / done;
    assert!(is_near(
        most_s,
        MOST_OF_RUN * ((1.0 - done) + COMPANIONS) * whole + RESTART * whole
    ));
    assert!(is_near(
        likely_s,
        ((1.0 - done + COMPANIONS) * whole).max(most_s / WIDEST)
    ));
}

#[test]
fn a_life_that_is_longer_than_foreseen_still_takes_time() {
    let mut time = of(LIFE);
    time.computed(Foreseen::of(LIFE).end() * 3, 10.0);
    assert!(left(&time, 10.0).likely_s > 2.0);
}

#[test]
fn a_run_to_its_last_cycle_takes_no_time_there() {
    let mut time =
        of(r#"{"system":{"kind":"dimm"},"cycles":200,"accuracy":{"estimate_errors":false}}"#);
    time.computed(100, 10.0);
    assert!(left(&time, 10.0).likely_s > 0.1);
    time.computed(200, 12.0);
    let ExpectedTime { likely_s, most_s } = left(&time, 12.0);
    assert!(likely_s.abs() < 1e-12 && most_s.abs() < 1e-12);
}

#[test]
fn companions_may_be_followed_by_a_finer_run_which_goes_as_the_first_one_went() {
    let mut time = of(LIFE);
    for (cycle, at_s) in [(10, 4.0), (100, 8.0), (1_000, 16.0)] {
        time.computed(cycle, at_s);
    }
    time.companions(16.0);
    let at_once = left(&time, 16.0);
    assert!(is_near(
        at_once.most_s,
        16.0 * (MOST_OF_RUN * COMPANIONS + RESTART)
    ));
    assert!(is_near(at_once.likely_s, at_once.most_s / WIDEST));
    assert!(left(&time, 18.0).most_s < at_once.most_s);
    time.again(20.0);
    assert_eq!(time.remaining(21.0), None);
    time.computed(10, 40.0);
    // Companions have no cycles.
    time.companions(40.0);
    let ExpectedTime { likely_s, most_s } = left(&time, 40.0);
    assert!(
        is_near(likely_s, 60.0) && is_near(most_s, MOST_OF_RUN * 60.0),
        "{likely_s}"
    );
}

#[test]
fn a_run_that_begins_again_before_its_first_cycle_is_the_first_one() {
    let mut time = RemainingTime::new(Foreseen::of(LIFE), 5_000);
    time.again(3.0);
    time.computed(1_000, 13.0);
    let mut first = of(LIFE);
    first.computed(1_000, 10.0);
    assert_eq!(time.remaining(13.0), first.remaining(10.0));
}

#[test]
fn a_resumed_run_counts_from_where_it_was() {
    let end = Foreseen::of(LIFE).end();
    let mut time = RemainingTime::new(Foreseen::of(LIFE), end / 50);
    time.computed(end / 20, 10.0);
    let mut whole = of(LIFE);
    whole.computed(end / 20, 10.0);
    assert!(left(&time, 10.0).likely_s > 1.2 * left(&whole, 10.0).likely_s);
}

#[test]
fn nothing_is_foreseen_of_what_cannot_be_read() {
    let mut time = of("no document");
    time.computed(5, 1.0);
    assert_eq!(time.remaining(1.0), None);
}
