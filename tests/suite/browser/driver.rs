//! A browser driven through chromedriver by the WebDriver protocol (W3C): JSON over HTTP on
//! loopback.

use serde_json::{Value, json};
use std::{
    io::{Read, Write},
    net::{TcpListener, TcpStream},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

/// A running browser; ends when dropped.
pub struct Browser {
    driver: Child,
    port: u16,
    session: String,
    _profile: tempfile::TempDir,
}

/// A program on the path.
fn program(name: &str) -> Option<PathBuf> {
    std::env::split_paths(&std::env::var_os("PATH")?)
        .map(|folder| folder.join(name))
        .find(|p| p.is_file())
}

impl Browser {
    /// Starts one; `None` where there is none on this machine.
    pub fn start(more: &[&str]) -> Option<Self> {
        let (driver, browser) =
            (program("chromedriver")?, program("chromium").or_else(|| program("google-chrome"))?);
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let driver = Command::new(driver)
            .arg(format!("--port={port}"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("chromedriver starts");
        let profile = tempfile::tempdir().unwrap();
        let mut this = Self { driver, port, session: String::new(), _profile: profile };
        let begin = Instant::now();
        while TcpStream::connect(("127.0.0.1", port)).is_err() {
            assert!(begin.elapsed() < Duration::from_secs(60), "chromedriver does not answer");
            std::thread::sleep(Duration::from_millis(50));
        }
        let mut arguments: Vec<String> = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--use-gl=angle",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--disable-dev-shm-usage",
            "--hide-scrollbars",
        ]
        .map(String::from)
        .to_vec();
        arguments.push(format!("--user-data-dir={}", this._profile.path().display()));
        arguments.extend(more.iter().map(|s| s.to_string()));
        let wanted = json!({ "capabilities": { "alwaysMatch": {
            "goog:chromeOptions": { "binary": browser, "args": arguments },
            "goog:loggingPrefs": { "browser": "ALL" },
        } } });
        let answer = this.ask("POST", "/session", &wanted);
        this.session = answer["sessionId"]
            .as_str()
            .unwrap_or_else(|| panic!("no session: {answer}"))
            .to_string();
        Some(this)
    }

    fn ask(&self, method: &str, path: &str, body: &Value) -> Value {
        let body = if method == "POST" { body.to_string() } else { String::new() };
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
        let head = format!(
            "{method} {path} HTTP/1.1\r\nHost: localhost:{}\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
            self.port,
            body.len()
        );
        stream.write_all((head + &body).as_bytes()).unwrap();
        let mut answer = Vec::new();
        let mut part = [0; 65536];
        // The length tells the end: not every driver closes the connection.
        loop {
            let read = match stream.read(&mut part) {
                // A signal, such as the end of another test's process.
                Err(e) if e.kind() == std::io::ErrorKind::Interrupted => continue,
                read => read.unwrap(),
            };
            answer.extend_from_slice(&part[..read]);
            let text = String::from_utf8_lossy(&answer);
            if let Some((head, rest)) = text.split_once("\r\n\r\n") {
                let length = head.lines().find_map(|l| {
                    l.to_ascii_lowercase()
                        .strip_prefix("content-length:")?
                        .trim()
                        .parse::<usize>()
                        .ok()
                });
                if length.is_some_and(|n| rest.len() >= n) || read == 0 {
                    let value: Value = serde_json::from_str(rest)
                        .unwrap_or_else(|e| panic!("{path}: {e}: {rest}"));
                    let value = value["value"].clone();
                    assert!(value.get("error").is_none(), "{path}: {}", value["message"]);
                    return value;
                }
            }
            assert!(read > 0, "{path}: the driver hung up");
        }
    }

    fn post(&self, path: &str, body: Value) -> Value {
        self.ask("POST", &format!("/session/{}{path}", self.session), &body)
    }

    /// Opens a file.
    pub fn open(&self, page: &Path) {
        self.visit(&format!("file://{}", page.display()));
    }

    /// Opens an address.
    pub fn visit(&self, url: &str) {
        self.post("/url", json!({ "url": url }));
    }

    /// Turns to a frame of the page by its place, or back to the whole.
    pub fn frame(&self, place: Option<u32>) {
        self.post("/frame", json!({ "id": place }));
    }

    /// Runs a script; what it returns.
    pub fn run(&self, script: &str) -> Value {
        self.post("/execute/sync", json!({ "script": script, "args": [] }))
    }

    /// Waits until a script returns true.
    #[track_caller]
    pub fn until(&self, script: &str) {
        let begin = Instant::now();
        while self.run(script) != Value::Bool(true) {
            assert!(
                begin.elapsed() < Duration::from_secs(60),
                "waiting for: {script}\n{:?}",
                self.messages()
            );
            std::thread::sleep(Duration::from_millis(30));
        }
    }

    /// Clicks at a place of the window.
    pub fn click(&self, x: f64, y: f64) {
        let step = |kind: &str| json!({ "type": kind, "button": 0 });
        let to = json!({ "type": "pointerMove", "duration": 0, "x": x.round() as i64, "y": y.round() as i64, "origin": "viewport" });
        let pointer = json!({ "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" }, "actions": [to, step("pointerDown"), step("pointerUp")] });
        self.post("/actions", json!({ "actions": [pointer] }));
    }

    /// Presses keys, one after the other.
    pub fn keys(&self, keys: &str) {
        let each = keys.chars().flat_map(|c| {
            ["keyDown", "keyUp"].map(|t| json!({ "type": t, "value": c.to_string() }))
        });
        let list: Vec<Value> = each.collect();
        self.post(
            "/actions",
            json!({ "actions": [{ "type": "key", "id": "keyboard", "actions": list }] }),
        );
    }

    /// A command of the browser's own protocol.
    pub fn command(&self, name: &str, parameters: Value) -> Value {
        self.post("/goog/cdp/execute", json!({ "cmd": name, "params": parameters }))
    }

    /// What the console holds beyond notes, and empties it.
    pub fn messages(&self) -> Vec<String> {
        let list = self.post("/se/log", json!({ "type": "browser" }));
        let bad = |m: &&Value| matches!(m["level"].as_str(), Some("SEVERE" | "WARNING"));
        // Chromium complains of its own software drawing.
        let own = |m: &&Value| {
            !m["message"].as_str().is_some_and(|t| {
                t.contains("GPU stall") || t.contains("swiftshader") || t.contains("SwiftShader")
            })
        };
        list.as_array()
            .into_iter()
            .flatten()
            .filter(bad)
            .filter(own)
            .map(|m| m["message"].to_string())
            .collect()
    }

    /// What the window shows, as a PNG file.
    pub fn picture(&self, file: &Path) {
        let answer =
            self.ask("GET", &format!("/session/{}/screenshot", self.session), &Value::Null);
        let bytes = data_encoding::BASE64.decode(answer.as_str().unwrap().as_bytes()).unwrap();
        std::fs::write(file, bytes).unwrap();
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !self.session.is_empty() && !std::thread::panicking() {
            self.ask("DELETE", &format!("/session/{}", self.session), &Value::Null);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
