//! The readiness of a service.

use std::time::Duration;

use api::service::SERVICE;
use serde::Deserialize;

use super::{Client, ClientError};

/// Answer of a service that is ready.
#[derive(Deserialize)]
struct Ready {
    service: String,
}

impl Client {
    /// Checks that the service is ready; asks once.
    ///
    /// # Errors
    /// [`ClientError`], also if it is not ready, or another program answers.
    pub async fn check_ready(&self, timeout: Duration) -> Result<(), ClientError> {
        let request = self.http.get(self.url("/readyz")).timeout(timeout);
        let answer = self.send(request).await?.bytes().await;
        let answer = answer.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
        let ready = serde_json::from_slice::<Ready>(&answer);
        if ready.is_ok_and(|ready| ready.service == SERVICE) {
            Ok(())
        } else {
            Err(ClientError::OtherService(self.base.clone()))
        }
    }
}
