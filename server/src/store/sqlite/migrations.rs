//! The migrations of the schema, embedded.

use crate::store::migrations::file;

/// All files of the folder; a name is the version and what it is about.
pub(super) const FILES: [(&str, &str); 37] = [
    file!("sqlite/0001_jobs.sql"),
    file!("sqlite/0002_labels.sql"),
    file!("sqlite/0003_events.sql"),
    file!("sqlite/0004_results.sql"),
    file!("sqlite/0005_request_keys.sql"),
    file!("sqlite/0010_checkpoints.sql"),
    file!("sqlite/0011_scheduling.sql"),
    file!("sqlite/0012_probes.sql"),
    file!("sqlite/0020_result_files.sql"),
    file!("sqlite/0021_sweeps.sql"),
    file!("sqlite/0040_studies.sql"),
    file!("sqlite/0050_fruitless_attempts.sql"),
    file!("sqlite/0051_retries.sql"),
    file!("sqlite/0052_disk_reasons.sql"),
    file!("sqlite/0053_damaged_files.sql"),
    file!("sqlite/0054_owner.sql"),
    file!("sqlite/0055_list_indexes.sql"),
    file!("sqlite/0056_result_blocks.sql"),
    file!("sqlite/0057_job_counts.sql"),
    file!("sqlite/0058_clock.sql"),
    file!("sqlite/0059_clock_of_the_boot.sql"),
    file!("sqlite/0060_revisions.sql"),
    file!("sqlite/0061_numbered_requests.sql"),
    file!("sqlite/0062_worker_tokens.sql"),
    file!("sqlite/0063_objects.sql"),
    file!("sqlite/0064_queue_indexes.sql"),
    file!("sqlite/0065_expansions.sql"),
    file!("sqlite/0066_workers.sql"),
    file!("sqlite/0067_checkpoint_objects.sql"),
    file!("sqlite/0070_failing_workers.sql"),
    file!("sqlite/0071_avoided_workers.sql"),
    file!("sqlite/0072_tokens_of_leases.sql"),
    file!("sqlite/0073_service_time.sql"),
    file!("sqlite/0074_list_indexes.sql"),
    file!("sqlite/0075_batch_endings.sql"),
    file!("sqlite/0080_sent_specifications.sql"),
    file!("sqlite/0081_retained_batches.sql"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::migrations::tests::assert_whole;

    #[test]
    fn every_file_of_the_folder_is_embedded_and_has_a_version() {
        assert_whole("sqlite", &FILES);
    }
}
