//! Files of an attempt, sent to the service.

use std::path::Path;

use api::results::ResultFile;
use reqwest::Body;
use reqwest::header::CONTENT_LENGTH;
use serde::de::DeserializeOwned;
use tokio_util::io::ReaderStream;

use crate::client::{Client, ClientError};

impl Client {
    /// Sends a file once, with its entry in the manifest; the service compares the checksum.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn put_file<T: DeserializeOwned>(
        &self,
        path: &str,
        file: &Path,
        entry: &ResultFile,
    ) -> Result<T, ClientError> {
        let failed = |cause| ClientError::File {
            path: file.to_owned(),
            cause,
        };
        let content = tokio::fs::File::open(file).await.map_err(failed)?;
        let request = self
            .http
            .put(self.url(path))
            .query(&[("sha256", &entry.sha256)])
            .header(CONTENT_LENGTH, entry.bytes)
            .body(Body::wrap_stream(ReaderStream::new(content)));
        self.document(path, request).await
    }
}
