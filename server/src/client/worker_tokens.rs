//! Tokens of remote workers.

use api::worker::{CreatedWorkerToken, NewWorkerToken, WorkerTokens};
use uuid::Uuid;

use crate::client::{Client, ClientError};

impl Client {
    /// Makes a token. It is sent once: a repeated request would make another one.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn create_worker_token(&self, name: &str) -> Result<CreatedWorkerToken, ClientError> {
        let new = NewWorkerToken {
            name: name.to_owned(),
        };
        self.post("/v1/worker-tokens", &new).await
    }

    /// Lists the tokens.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn worker_tokens(&self) -> Result<WorkerTokens, ClientError> {
        self.get("/v1/worker-tokens", &[]).await
    }

    /// Revokes a token.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn revoke_worker_token(&self, id: Uuid) -> Result<(), ClientError> {
        let request = self
            .http
            .delete(self.url(&format!("/v1/worker-tokens/{id}")));
        self.send(request).await.map(drop)
    }
}
