//! Jobs of a large sweep that are queued while others are solved.

use std::ops::Range;

use api::problem::Fault;
use api::sweep::{RefusedChanges, SweepRequest};

use crate::batch::sweep::variations::Variations;
use crate::batch::variation::{Accept, Variation};
use crate::spec::Refused;

/// Returns the jobs at these positions; those that are not valid, or not accepted, are refused with a reason.
pub(in crate::batch) fn jobs(
    request: &SweepRequest,
    positions: Range<u64>,
    accept: &Accept<'_>,
) -> (Vec<(u64, Variation)>, Vec<RefusedChanges>) {
    let variations = Variations::of(request);
    let (mut jobs, mut refused) = (Vec::new(), Vec::new());
    for position in positions {
        let accepted = variations.at(position).map_err(|faults| words(&faults));
        let accepted = accepted.and_then(|variation| {
            accept(&variation.estimate).map_err(|refused| reason(&refused))?;
            Ok(variation)
        });
        match accepted {
            Ok(variation) => jobs.push((position, variation)),
            Err(reason) => refused.push(RefusedChanges {
                position,
                overrides: variations.changes(position),
                reason,
            }),
        }
    }
    (jobs, refused)
}

fn reason(refused: &Refused) -> String {
    match refused {
        Refused::Parse(error) => error.to_string(),
        Refused::Faults(faults) => {
            let faults = faults.iter();
            let faults = faults.map(|Fault { pointer, detail }| (pointer.clone(), detail.clone()));
            words(&faults.collect::<Vec<_>>())
        }
    }
}

fn words(faults: &[(String, String)]) -> String {
    let each = |(pointer, detail): &(String, String)| format!("{pointer}: {detail}");
    faults.iter().map(each).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn combinations_that_make_no_valid_job_are_refused_with_their_changes() {
        let request = json!({
            "base": {"system": {"kind": "dimm"}},
            "grid": {"/cycles": [10, 0], "/load/n": [0.3, 0.4]}
        });
        let request = serde_json::from_value(request).expect("a sweep");
        let (accepted, refused) = jobs(&request, 1..4, &|_| Ok(()));
        let positions: Vec<u64> = accepted.iter().map(|(position, _)| *position).collect();
        assert_eq!(positions, [1]);
        assert_eq!(accepted[0].1.overrides["/load/n"], 0.4);
        let positions: Vec<u64> = refused.iter().map(|refused| refused.position).collect();
        assert_eq!(positions, [2, 3]);
        assert_eq!(refused[1].overrides, Variations::of(&request).changes(3));
        assert!(
            refused[1].reason.starts_with("/grid/~1cycles: "),
            "{refused:?}"
        );
        let (none, refused) = jobs(&request, 0..1, &|_| {
            Err(Refused::Faults(vec![Fault::new("/output", "too many MB")]))
        });
        assert_eq!(
            (none.len(), refused[0].reason.as_str()),
            (0, "/output: too many MB")
        );
    }
}
