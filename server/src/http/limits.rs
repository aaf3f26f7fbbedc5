//! What a study may cost: refused before it is queued, with the estimate beside the limit.

use api::problem::Fault;

use crate::estimate::Estimate;
use crate::spec::Refused;

/// Unknowns of both bodies.
const DOFS: f64 = 2e6;
/// Memory of its solve, MB.
const MEMORY_MB: f64 = 8_000.0;
/// Everything that is stored, MB.
const OUTPUT_MB: f64 = 4_000.0;

/// Contact increments: some ten hours of one processor.
const INCREMENTS: f64 = 2e8;

/// Refuses a study that would be too large for this service.
///
/// # Errors
/// [`Refused`] with a fault for each limit.
pub(super) fn check(estimate: &Estimate) -> Result<(), Refused> {
    let size = &estimate.footprint;
    let increments = estimate.workload.increments();
    let limits = [
        ("/accuracy", "unknowns", size.dofs, DOFS),
        ("/accuracy", "MB of memory", size.memory_mb, MEMORY_MB),
        ("/accuracy", "increments", increments, INCREMENTS),
        ("/output", "MB of output", size.output_mb, OUTPUT_MB),
    ];
    let faults: Vec<Fault> = limits
        .into_iter()
        .filter(|(_, _, estimate, limit)| estimate > limit)
        .map(|(pointer, what, estimate, limit)| {
            Fault::new(
                pointer,
                format!("an estimated {estimate:.0} {what}; the service takes {limit:.0}"),
            )
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
    async fn what_would_be_too_large_is_refused_with_its_estimate() {
        let service = Service::new().await;
        let cases = [
            (
                r#"{"system":{"kind":"fuzz_button"},"accuracy":{"overrides":{"contact_element_mm":1e-5}}}"#,
                "/accuracy/overrides/contact_element_mm",
                "surface nodes",
            ),
            (
                r#"{"system":{"kind":"dimm"},"interface":{"wear":{"receptacle":{"law":"archard","k_over_h_per_mpa":1e-12}}},"cycles":1000000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#,
                "/output",
                "MB of output; the service takes 4000",
            ),
            (
                r#"{"system":{"kind":"dimm"},"interface":{"wear":{"receptacle":{"law":"archard","k_over_h_per_mpa":1e-12}}},"cycles":3000000,"accuracy":{"overrides":{"cycle_jump":1,"increments_per_cycle":100}}}"#,
                "/accuracy",
                "an estimated 300000000 increments; the service takes 200000000",
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
            let told = faults.iter().any(|fault| {
                fault["pointer"] == pointer
                    && fault["detail"]
                        .as_str()
                        .is_some_and(|detail| detail.contains(words))
            });
            assert!(told, "{problem}");
        }
        assert_eq!(
            service.get("/v1/jobs").await.2["jobs"],
            serde_json::json!([])
        );
    }
}
