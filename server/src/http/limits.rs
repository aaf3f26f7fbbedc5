//! Limits on the estimated cost of a job, checked before it is queued.

use api::problem::Fault;

use crate::estimate::Estimate;
use crate::spec::Refused;

/// Maximum degrees of freedom of both bodies.
const MAX_DOFS: f64 = 2e6;
/// Maximum memory of the solve, MB.
const MAX_MEMORY_MB: f64 = 8_000.0;
/// Maximum size of everything that is stored, MB.
const MAX_OUTPUT_MB: f64 = 4_000.0;
/// Maximum contact increments: some ten hours of one processor.
const MAX_INCREMENTS: f64 = 2e8;

/// Checks whether the estimates of a job are within the limits.
///
/// # Errors
/// [`Refused`] with a fault for each limit that is exceeded.
pub(crate) fn check(estimate: &Estimate) -> Result<(), Refused> {
    let size = &estimate.footprint;
    let increments = estimate.workload.increments();
    let limits = [
        ("/accuracy", "unknowns", size.dofs, MAX_DOFS),
        ("/accuracy", "MB of memory", size.memory_mb, MAX_MEMORY_MB),
        ("/accuracy", "increments", increments, MAX_INCREMENTS),
        ("/output", "MB of output", size.output_mb, MAX_OUTPUT_MB),
    ];
    let faults: Vec<Fault> = limits
        .into_iter()
        .filter(|(_, _, estimate, limit)| estimate > limit)
        .map(|(pointer, unit, estimate, limit)| {
            let detail = format!("an estimated {estimate:.0} {unit}; the limit is {limit:.0}");
            Fault::new(pointer, detail)
        })
        .collect();
    if faults.is_empty() {
        Ok(())
    } else {
        Err(Refused::Faults(faults))
    }
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_job_over_a_limit_is_rejected_with_its_estimate() {
        let service = Service::new().await;
        let cases = [
            (
                r#"{"system":{"kind":"fuzz_button"},"plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"slider":null,"receptacle":{"law":"archard","k":0.011,"hardness_mpa":427}}},"accuracy":{"overrides":{"contact_element_mm":1e-5}}}"#,
                "/accuracy/overrides/contact_element_mm",
                "surface nodes",
            ),
            (
                r#"{"system":{"kind":"dimm"},"plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"slider":null,"receptacle":{"law":"archard","k_over_h_per_mpa":1e-12}}},"cycles":1000000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#,
                "/output",
                "MB of output; the limit is 4000",
            ),
            (
                r#"{"system":{"kind":"dimm"},"plating":{"slider":[],"receptacle":[]},"interface":{"wear":{"slider":null,"receptacle":{"law":"archard","k_over_h_per_mpa":1e-12}}},"cycles":3000000,"accuracy":{"overrides":{"cycle_jump":1,"increments_per_cycle":100}}}"#,
                "/accuracy",
                "an estimated 300000000 increments; the limit is 200000000",
            ),
            (
                r#"{"system":{"kind":"fuzz_button"},"cycles":1000,"output":{"fields":true,"snapshots_at_cycles":[SNAPSHOTS]}}"#,
                "/output",
                "MB of output",
            ),
        ];
        let snapshots: Vec<String> = (1..=1000).map(|cycle| cycle.to_string()).collect();
        let cases = cases.map(|(spec, pointer, words)| {
            (
                spec.replace("SNAPSHOTS", &snapshots.join(",")),
                pointer,
                words,
            )
        });
        for (spec, pointer, words) in cases {
            let (status, _, problem) = service.post("/v1/jobs", &spec).await;
            assert_eq!(status, 422, "{problem}");
            let faults = problem["faults"].as_array().expect("faults");
            let found = faults.iter().any(|fault| {
                fault["pointer"] == pointer
                    && fault["detail"]
                        .as_str()
                        .is_some_and(|detail| detail.contains(words))
            });
            assert!(found, "{problem}");
        }
        assert_eq!(
            service.get("/v1/jobs").await.2["jobs"],
            serde_json::json!([])
        );
    }
}
