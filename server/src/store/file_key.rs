//! Keys of the files of jobs in a store of objects.

use uuid::Uuid;

/// Prefix of all keys.
const PREFIX: &str = "files/";

/// Returns `true` if a key is that of a file of a job.
pub(in crate::store) fn is_of_job(key: &str, job: Uuid) -> bool {
    let name = key.strip_prefix(PREFIX);
    let name = name.and_then(|name| name.strip_prefix(&job.to_string()));
    name.is_some_and(|name| name.starts_with('/'))
}

/// A new key for a file of a job, of an attempt's number.
pub(in crate::store) fn new(job: Uuid, number: i64) -> String {
    format!("{PREFIX}{job}/{number}/{}", Uuid::now_v7())
}
