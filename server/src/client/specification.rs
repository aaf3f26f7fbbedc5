//! Specifications as they were sent.

use uuid::Uuid;

use super::repeated;
use crate::client::{Client, ClientError};

/// The header that says whether a specification is as it was sent.
const SPECIFICATION_FORM: &str = "fretwear-specification";

/// The specification of a job.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SentSpec {
    /// JSON.
    pub json: String,
    /// False of a job that was queued before specifications were stored as they were sent: this one is resolved.
    pub is_as_sent: bool,
}

impl Client {
    /// Returns the specification of a job as it was sent.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn sent_spec(&self, id: Uuid) -> Result<SentSpec, ClientError> {
        let url = self.url(&format!("/v1/jobs/{id}/spec"));
        repeated(async || {
            let response = self.send(self.http.get(&url)).await?;
            let is_as_sent = response
                .headers()
                .get(SPECIFICATION_FORM)
                .is_none_or(|form| form != "resolved");
            let json = response.text().await;
            let json = json.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
            Ok(SentSpec { json, is_as_sent })
        })
        .await
    }
}
