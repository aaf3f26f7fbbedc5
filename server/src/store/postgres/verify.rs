//! Verification of all results that a database names. The database itself is checked by the server's own tools (`pg_amcheck`,
//! checksums of pages).

use std::path::Path;

use sqlx::PgConnection;

use crate::objects::Objects;
use crate::store::folder::Folder;
use crate::store::integrity::check::Verification;
use crate::store::postgres::objects::identity;
use crate::store::postgres::open::open_to_verify;
use crate::store::{BackupError, CopySummary, StoreError};

/// Verifies the database at `url`, whose large results may be in the folder `files`.results.
pub(in crate::store) async fn verify(
    url: &str,
    files: &Path,
    objects: Option<&Objects>,
) -> Result<CopySummary, BackupError> {
    let database = open_to_verify(url).await?;
    let folder = Folder::beside(files);
    let verification = Verification::of(&database, &folder, objects).await?;
    let report = verification.run().await;
    database.close().await;
    report
}

/// Returns `true` if the objects of a database are those of its original.
pub(super) async fn is_copy(connection: &mut PgConnection) -> Result<bool, StoreError> {
    let noted = sqlx::query_as("SELECT removes, owner FROM object_store");
    let noted: Option<(bool, Option<String>)> = noted.fetch_optional(&mut *connection).await?;
    let Some((removes, owner)) = noted else {
        return Ok(false);
    };
    let own = identity(connection).await?;
    Ok(!removes || owner.is_some_and(|owner| is_another(&owner, &own)))
}

/// Returns `true` if two identities are of two databases. A role that may not read that of the server has only the number of the database.
fn is_another(noted: &str, own: &str) -> bool {
    match (noted.split_once('/'), own.split_once('/')) {
        (Some(noted), Some(own)) => noted != own,
        (noted_parts, own_parts) => {
            let number = |parts: Option<(_, _)>, whole| parts.map_or(whole, |(_, number)| number);
            number(noted_parts, noted) != number(own_parts, own)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_role_that_may_not_read_the_server_sees_no_copy() {
        assert!(is_another("7/16384", "8/16384") && is_another("7/16384", "7/16385"));
        assert!(is_another("16384", "7/16385") && is_another("16384", "16385"));
        assert!(!is_another("7/16384", "7/16384") && !is_another("7/16384", "16384"));
        assert!(!is_another("16384", "7/16384"));
    }
}
