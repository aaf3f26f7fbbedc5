//! Waiting for jobs and batches of a service.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::Server;
use crate::server::PATIENCE;

impl Server {
    /// Submits a specification and returns its job when it has ended.
    ///
    /// # Panics
    /// If it is refused, or has not ended in four minutes.
    pub async fn ended(&self, spec: &Value) -> Value {
        let (status, job) = self.submit(spec.to_string()).await;
        assert_eq!(status, 202, "{job}");
        let id = job["id"].as_str().expect("a job has an id");
        self.job_when(id, |job| job["finished_at"].is_string())
            .await
    }

    /// Polls a job until it meets a condition.
    ///
    /// # Panics
    /// If it does not in four minutes.
    pub async fn job_when(&self, id: &str, condition: impl Fn(&Value) -> bool) -> Value {
        let path = format!("/v1/jobs/{id}");
        let start = Instant::now();
        loop {
            let (_, job) = self.get(&path).await;
            if condition(&job) {
                return job;
            }
            assert!(start.elapsed() < PATIENCE, "the job gets there: {job}");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Waits until all jobs of a sweep or a study at a path have ended; returns its document.
    ///
    /// # Panics
    /// If one has not in four minutes.
    pub async fn batch_ended(&self, path: &str) -> Value {
        let (_, batch) = self.get(path).await;
        for job in batch["jobs"].as_array().expect("jobs") {
            let id = job["id"].as_str().expect("a job has an id");
            self.job_when(id, |job| job["finished_at"].is_string())
                .await;
        }
        self.get(path).await.1
    }
}
