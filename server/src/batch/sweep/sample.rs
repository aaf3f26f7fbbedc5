//! Positions of a large grid that are tried when it is submitted.

use std::collections::BTreeSet;
use std::ops::Range;

use api::sweep::SweepRequest;

/// Positions that are spread evenly. Each takes some 4 ms to be tried.
const SPREAD: u64 = 500;
/// Largest number of values that are tried each beside the first values of the other fields.
const VALUES: u64 = 1_000;

/// Positions whose times are expected for those of all. Each takes some 10 ms.
const TIMED: u64 = 16;

/// Some evenly spread positions of so many.
pub(super) fn timed(jobs: u64) -> impl Iterator<Item = u64> {
    let parts = TIMED.min(jobs);
    (0..parts).map(move |part| share(part, parts, jobs))
}

/// Positions within a range: evenly spread ones, the last one, and each value of each field beside the first values of the others; of
/// more values than can be tried, evenly spread ones.
pub(super) fn positions(request: &SweepRequest, range: Range<u64>) -> BTreeSet<u64> {
    let length = range.end - range.start;
    let even = (0..SPREAD).map(|part| range.start + share(part, SPREAD, length));
    let mut found: BTreeSet<u64> = even.collect();
    found.insert(range.end - 1);
    let axes = axes(request);
    let all: u64 = axes.iter().map(|(values, _)| values).sum();
    for (values, stride) in axes {
        let tried = values.min((values * VALUES / all.max(1)).max(1));
        let indices = (0..tried).map(|part| share(part, tried, values));
        found.extend(indices.chain([values - 1]).map(|index| index * stride));
    }
    found.retain(|position| range.contains(position));
    found
}

/// Number of values of each field, and how many positions further the next value is.
fn axes(request: &SweepRequest) -> Vec<(u64, u64)> {
    let mut stride = 1;
    let mut axes = Vec::new();
    for values in request.grid.iter().flat_map(|grid| grid.values().rev()) {
        let values = u64::try_from(values.len()).unwrap_or(u64::MAX);
        axes.push((values, stride));
        stride *= values;
    }
    axes
}

/// Where a part of so many begins in a length.
fn share(part: u64, parts: u64, length: u64) -> u64 {
    part * length / parts
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_value_of_every_field_is_tried_and_no_more_than_can_be() {
        let numbers: Vec<u32> = (0..100).collect();
        let grid = json!({"base": {}, "grid": {"/a": numbers, "/b": numbers, "/c": numbers}});
        let request: SweepRequest = serde_json::from_value(grid).expect("a sweep");
        let found = positions(&request, 250..1_000_000);
        for index in 1..100 {
            assert!(found.contains(&(index * 10_000)), "value {index} of /a");
        }
        for index in 3..100 {
            assert!(found.contains(&(index * 100)), "value {index} of /b");
        }
        assert!(found.contains(&999_999));
        let long: Vec<u32> = (0..1_000_000).collect();
        let request = serde_json::from_value(json!({"base": {}, "grid": {"/a": long}}));
        let found = positions(&request.expect("a sweep"), 250..1_000_000);
        assert!((500..=1_502).contains(&found.len()), "{}", found.len());
    }
}
