//! A server of the S3 interface (moto, a Python package) on a free loopback port, killed when it goes out of scope.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};

/// Name of its bucket.
const BUCKET: &str = "results";
/// Name of the object that marks a store.
const MARK: &str = "fretwear-objects";

/// A server of the S3 interface with an empty bucket.
#[derive(Debug)]
pub struct S3 {
    child: Child,
    port: u16,
    endpoint: String,
}

impl S3 {
    /// Starts one.
    ///
    /// # Panics
    /// If it does not start.
    pub async fn start() -> Self {
        Self::start_at(0).await
    }

    /// Ends it and starts another, empty one at the same address.
    ///
    /// # Panics
    /// If it does not start.
    pub async fn restart(mut self) -> Self {
        self.end();
        Self::start_at(self.port).await
    }

    /// Ends it: its address refuses connections.
    ///
    /// # Panics
    /// If it cannot be ended.
    pub fn end(&mut self) {
        // The process may have ended before.
        let _ = self.child.kill();
        self.child.wait().expect("a process that was started");
    }

    async fn start_at(port: u16) -> Self {
        let mut child = Command::new(env!("FRETWEAR_PYTHON"))
            .args(["-u", "-m", "moto.server", "-p", &port.to_string()])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("moto can be started");
        let mut lines = BufReader::new(child.stderr.take().expect("its output is read")).lines();
        let address = lines.by_ref().map_while(Result::ok).find_map(|line| {
            let (_, address) = line.split_once("Running on http://127.0.0.1:")?;
            address.trim().parse().ok()
        });
        let port: u16 = address.expect("it names its address");
        // Further output is read and discarded, so that the process never blocks on a full pipe.
        std::thread::spawn(move || lines.for_each(drop));
        let endpoint = format!("http://127.0.0.1:{port}");
        let bucket = format!("{endpoint}/{BUCKET}");
        let made = reqwest::Client::new().put(bucket).send().await;
        assert!(made.expect("an answer").status().is_success());
        Self {
            child,
            port,
            endpoint,
        }
    }

    /// Address of a store of objects in its bucket.
    pub fn address(&self) -> String {
        format!("s3://{BUCKET}/fretwear")
    }

    /// Variables of the environment that name it and its keys.
    pub fn environment(&self) -> [(&'static str, &Path); 5] {
        [
            ("AWS_ENDPOINT_URL", Path::new(&self.endpoint)),
            ("AWS_ALLOW_HTTP", Path::new("true")),
            ("AWS_REGION", Path::new("us-east-1")),
            ("AWS_ACCESS_KEY_ID", Path::new("testing")),
            ("AWS_SECRET_ACCESS_KEY", Path::new("testing")),
        ]
    }

    /// Marks its bucket as the store of objects of a database.
    ///
    /// # Panics
    /// If it does not answer.
    pub async fn mark(&self) {
        let mark = format!("{}/{BUCKET}/fretwear/{MARK}", self.endpoint);
        let put = reqwest::Client::new().put(mark).send().await;
        assert!(put.expect("an answer").status().is_success());
    }

    /// Number of objects in its bucket, beside the mark.
    ///
    /// # Panics
    /// If it does not answer.
    pub async fn objects(&self) -> usize {
        let list = format!("{}/{BUCKET}?list-type=2", self.endpoint);
        let listed = reqwest::get(list).await.expect("an answer");
        let text = listed.text().await.expect("a list");
        text.matches("<Key>").count() - text.matches(MARK).count()
    }
}

impl Drop for S3 {
    fn drop(&mut self) {
        self.end();
    }
}
