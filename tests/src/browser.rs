//! A headless browser that a test drives through WebDriver, ended when it goes out of scope.

use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use fantoccini::wd::Capabilities;
use fantoccini::{Client, ClientBuilder, Locator};
use hyper_util::client::legacy::connect::HttpConnector;
use nix::sys::signal::{Signal, killpg};
use nix::unistd::Pid;
use serde_json::{Value, json};

/// Timeout of every wait; no measure of speed.
const PATIENCE_MS: u64 = 300_000;
const PATIENCE: Duration = Duration::from_millis(PATIENCE_MS);
/// Time between two looks at a page that changes by itself.
const POLL: Duration = Duration::from_millis(50);

/// A browser with one page.
#[derive(Debug)]
pub struct Browser {
    driver: Child,
    endpoint: String,
    session: String,
    base: String,
    /// The page.
    pub client: Client,
    requests: reqwest::Client,
}

impl Browser {
    /// Starts a browser for the pages of a service, with its own files in a folder.
    ///
    /// # Panics
    /// If the driver or the browser does not start.
    pub async fn start(base: &str, folder: &Path) -> Self {
        let mut driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .process_group(0)
            .spawn()
            .expect("chromedriver starts");
        let output = driver.stdout.take().expect("it is piped");
        let mut lines = BufReader::new(output).lines();
        let port = lines.find_map(|line| {
            let line = line.ok()?;
            let port = line.split("successfully on port ").nth(1)?;
            Some(port.trim_end_matches('.').to_owned())
        });
        std::thread::spawn(move || lines.for_each(drop));
        let endpoint = format!("http://127.0.0.1:{}", port.expect("it names its port"));
        let profile = format!("--user-data-dir={}", folder.join("browser").display());
        let options = json!({
            "goog:chromeOptions": {"args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--lang=en-US", "--window-size=1400,1000", profile]},
            "goog:loggingPrefs": {"browser": "ALL"},
            "timeouts": {"script": PATIENCE_MS},
        });
        let capabilities: Capabilities = serde_json::from_value(options).expect("an object");
        let client = ClientBuilder::new(HttpConnector::new())
            .capabilities(capabilities)
            .connect(&endpoint)
            .await
            .expect("chromium starts");
        let session = client.session_id().await;
        let session = session.expect("it answers").expect("a session");
        Self {
            driver,
            endpoint,
            session,
            base: base.to_owned(),
            client,
            requests: reqwest::Client::new(),
        }
    }

    /// Opens a page of the service.
    ///
    /// # Panics
    /// If the browser does not answer.
    pub async fn open(&self, path: &str) {
        let url = format!("{}{path}", self.base);
        self.client.goto(&url).await.expect("the page opens");
    }

    /// Waits for an expression of the page to be true, and returns its value.
    ///
    /// # Panics
    /// If it does not become so.
    pub async fn wait_for(&self, expression: &str) -> Value {
        let script = format!("try {{ return {expression}; }} catch (error) {{ return null; }}");
        let found = tokio::time::timeout(PATIENCE, async {
            loop {
                let value = self.client.execute(&script, Vec::new()).await;
                match value.expect("the page answers") {
                    Value::Null | Value::Bool(false) => tokio::time::sleep(POLL).await,
                    value => break value,
                }
            }
        });
        if let Ok(value) = found.await {
            return value;
        }
        panic!(
            "{expression} stays false; the page has:\n{}",
            self.text().await
        )
    }

    /// Waits for a text to be shown within the first element of a selector.
    ///
    /// # Panics
    /// If it is not.
    pub async fn shows(&self, selector: &str, text: &str) {
        let (selector, text) = (json!(selector), json!(text));
        let expression = format!("document.querySelector({selector}).innerText.includes({text})");
        self.wait_for(&expression).await;
    }

    /// Runs a script on the page.
    ///
    /// # Panics
    /// If it fails.
    pub async fn run(&self, script: &str) {
        let done = self.client.execute(script, Vec::new()).await;
        done.unwrap_or_else(|error| panic!("{script}: {error}"));
    }

    /// Clicks on an element.
    ///
    /// # Panics
    /// If it does not appear.
    pub async fn click(&self, selector: &str) {
        loop {
            let wait = self.client.wait().at_most(PATIENCE);
            let element = wait.for_element(Locator::Css(selector)).await;
            let element = element.unwrap_or_else(|error| panic!("{selector}: {error}"));
            match element.click().await {
                // The page has drawn this part again in between.
                Err(error) if error.is_stale_element_reference() => {}
                clicked => return clicked.expect("it can be clicked"),
            }
        }
    }

    /// Brings an element into view: what is out of view is drawn again only when it comes into view.
    ///
    /// # Panics
    /// If there is none.
    pub async fn scroll_to(&self, selector: &str) {
        let script = format!(
            "document.querySelector({}).scrollIntoView()",
            json!(selector)
        );
        let scrolled = self.client.execute(&script, Vec::new()).await;
        scrolled.unwrap_or_else(|error| panic!("{selector}: {error}"));
    }

    /// The text of the page.
    ///
    /// # Panics
    /// If the browser does not answer.
    pub async fn text(&self) -> String {
        let text = self
            .client
            .execute("return document.body.innerText", Vec::new())
            .await;
        text.expect("the page answers")
            .as_str()
            .unwrap_or_default()
            .to_owned()
    }

    /// Emulates a screen of a width in pixels, and a reader's choice of colours, `light` or `dark`.
    ///
    /// # Panics
    /// If the browser refuses.
    pub async fn emulate(&self, width: u32, colours: &str) {
        let size =
            json!({"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600});
        self.command("Emulation.setDeviceMetricsOverride", size)
            .await;
        let media = json!({"features": [{"name": "prefers-color-scheme", "value": colours}]});
        self.command("Emulation.setEmulatedMedia", media).await;
    }

    /// Lets new requests of the page fail as without a network, or succeed again.
    ///
    /// # Panics
    /// If the browser refuses.
    pub async fn cut_off(&self, is_cut_off: bool) {
        self.network(is_cut_off, 0).await;
    }

    /// Delays the answers to the requests of the page by a number of milliseconds.
    ///
    /// # Panics
    /// If the browser refuses.
    pub async fn delay_answers(&self, latency_ms: u32) {
        self.network(false, latency_ms).await;
    }

    async fn network(&self, offline: bool, latency_ms: u32) {
        // Bytes a second, beyond those of a network on this machine.
        let throughput = if offline { 0 } else { 1_000_000_000 };
        let conditions = json!({"offline": offline, "latency": latency_ms, "download_throughput": throughput, "upload_throughput": throughput});
        let body = json!({"network_conditions": conditions});
        let answer = self.post("chromium/network_conditions", &body).await;
        assert!(answer["value"].is_null(), "{answer}");
    }

    /// Bytes of objects in the page's memory after those without a use are removed.
    ///
    /// # Panics
    /// If the browser does not answer.
    pub async fn heap_bytes(&self) -> f64 {
        self.command("HeapProfiler.collectGarbage", json!({})).await;
        let usage = self.command("Runtime.getHeapUsage", json!({})).await;
        usage["usedSize"].as_f64().expect("a number")
    }

    async fn command(&self, name: &str, parameters: Value) -> Value {
        let body = json!({"cmd": name, "params": parameters});
        let answer = self.post("goog/cdp/execute", &body).await;
        assert!(answer["value"].get("error").is_none(), "{name}: {answer}");
        answer["value"].clone()
    }

    /// Messages of the console since the last call: failures of scripts and requests, and what the content policy has blocked.
    ///
    /// # Panics
    /// If the browser does not answer.
    pub async fn complaints(&self) -> Vec<String> {
        let answer = self.post("se/log", &json!({"type": "browser"})).await;
        let entries = answer["value"].as_array().cloned().unwrap_or_default();
        let messages = entries.iter().map(|entry| entry["message"].to_string());
        messages.collect()
    }

    /// Hosts that the page has loaded from, besides its own.
    ///
    /// # Panics
    /// If the browser does not answer.
    pub async fn other_hosts(&self) -> Vec<String> {
        let script = "return performance.getEntriesByType('resource').map((entry) => entry.name)";
        let loaded = self.client.execute(script, Vec::new()).await;
        let loaded = loaded.expect("the page answers");
        let names = loaded.as_array().cloned().unwrap_or_default();
        let names = names.iter().filter_map(Value::as_str);
        let other = names.filter(|name| {
            !name.starts_with(&self.base)
                && !name.starts_with("data:")
                && !name.starts_with("blob:")
        });
        other.map(str::to_owned).collect()
    }

    /// Saves a picture of the page for people to look at, in `target/screenshots`, if `FRETWEAR_TEST_PICTURES` is set.
    ///
    /// # Panics
    /// If it cannot be taken or written.
    pub async fn picture(&self, name: &str) {
        if std::env::var_os("FRETWEAR_TEST_PICTURES").is_none() {
            return;
        }
        let bytes = self.client.screenshot().await.expect("a picture");
        Self::keep(&format!("{name}.png"), &bytes);
    }

    /// Writes a picture into `target/screenshots`.
    ///
    /// # Panics
    /// If it cannot be written.
    pub fn keep(file: &str, bytes: &[u8]) {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../target/screenshots");
        std::fs::create_dir_all(&folder).expect("a folder can be made");
        std::fs::write(folder.join(file), bytes).expect("a file can be written");
    }

    /// Ends the browser.
    ///
    /// # Panics
    /// If it does not answer.
    pub async fn close(self) {
        self.client.clone().close().await.expect("it ends");
    }

    async fn post(&self, command: &str, body: &Value) -> Value {
        let url = format!("{}/session/{}/{command}", self.endpoint, self.session);
        let request = self.requests.post(url).json(body).send().await;
        let answer = request.expect("the driver answers").json().await;
        answer.expect("JSON")
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // The driver leads a group, which the browser is part of.
        let group = Pid::from_raw(i32::try_from(self.driver.id()).expect("a process id"));
        let _ = killpg(group, Signal::SIGKILL);
        let _ = self.driver.wait();
    }
}
