//! The migrations of the schema, embedded.

use crate::store::migrations::file;

/// All files of the folder; a name is the version and what it is about.
pub(super) const FILES: [(&str, &str); 13] = [
    file!("postgres/0064_schema.sql"),
    file!("postgres/0065_expansions.sql"),
    file!("postgres/0066_workers.sql"),
    file!("postgres/0067_checkpoint_objects.sql"),
    file!("postgres/0068_file_objects.sql"),
    file!("postgres/0070_failing_workers.sql"),
    file!("postgres/0071_avoided_workers.sql"),
    file!("postgres/0072_tokens_of_leases.sql"),
    file!("postgres/0073_service_time.sql"),
    file!("postgres/0074_list_indexes.sql"),
    file!("postgres/0075_batch_endings.sql"),
    file!("postgres/0080_sent_specifications.sql"),
    file!("postgres/0081_retained_batches.sql"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::migrations::tests::assert_whole;

    #[test]
    fn every_file_of_the_folder_is_embedded_and_has_a_version() {
        assert_whole("postgres", &FILES);
    }
}
