//! Results of a job as they are read to be moved.

use api::results::ResultFile;
use sqlx::postgres::PgConnection;
use uuid::Uuid;

use crate::objects::ObjectFile;
use crate::store::StoreError;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::blocks::stored_block;
use crate::store::postgres::events::events_to_move;
use crate::store::results_to_move::{Stored, file_to_move};

impl PostgresStore {
    /// Reads the results of a job; `None` if it was deleted.
    pub(in crate::store) async fn results_to_move(
        &self,
        id: Uuid,
    ) -> Result<Option<Stored>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        let block = stored_block(&mut connection, id).await?;
        let texts = sqlx::query_as("SELECT spec, plan FROM jobs WHERE id = $1")
            .bind(id)
            .fetch_optional(&mut *connection)
            .await?;
        let (Some(block), Some(texts)) = (block, texts) else {
            return Ok(None);
        };
        Ok(Some(Stored {
            block,
            texts,
            events: events_to_move(&mut connection, id).await?,
            files: self.files_to_move(&mut connection, id).await?,
        }))
    }

    /// The files of a job's manifest, with their places.
    async fn files_to_move(
        &self,
        connection: &mut PgConnection,
        id: Uuid,
    ) -> Result<Vec<(ResultFile, ObjectFile)>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files \
             WHERE job_id = $1 AND place IS NOT NULL ORDER BY name COLLATE \"C\"",
        )
        .bind(id)
        .fetch_all(connection)
        .await?;
        let file = |row| file_to_move(&self.local.folder, id, row);
        rows.iter().map(file).collect()
    }
}
