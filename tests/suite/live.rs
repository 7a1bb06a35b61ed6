//! `voussoir open` over plain TCP: strangers are refused and change nothing, saves are followed,
//! numbers are varied, and a scene that is saved replaces none.

use serde_json::{Value, json};
use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::TcpStream,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

/// Everything comes within this time, however slow the machine and unoptimised the program.
const PATIENCE: Duration = Duration::from_secs(120);

/// A program that serves a scene; it ends with this.
pub struct Open {
    child: Child,
    host: String,
    token: String,
}

impl Drop for Open {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Open {
    /// The address of its page.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.host, self.token)
    }

    pub fn new(scene: &Path) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_voussoir"))
            .args(["open", scene.to_str().unwrap()])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let rest = line.trim().strip_prefix("http://").expect("an address");
        let (host, token) = rest.split_once('/').unwrap();
        let token = token.trim_end_matches('/').to_string();
        assert!(host.starts_with("127.0.0.1:") && token.len() == 32, "{line}");
        Self { child, host: host.into(), token }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream
    }

    /// Sends a request, `T` in the target standing for the token; the whole answer. What is
    /// not taken any more is nobody's.
    fn send(&self, method: &str, target: &str, headers: &str, body: &[u8]) -> String {
        let mut stream = self.connect();
        let target = target.replace('T', &self.token);
        let host = match headers.contains("Host:") {
            true => String::new(),
            false => format!("Host: {}\r\n", self.host),
        };
        let headers = host + headers;
        let _ = stream.write_all(format!("{method} {target} HTTP/1.1\r\n{headers}\r\n").as_bytes());
        let _ = stream.write_all(body);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    fn post(&self, route: &str, body: &Value) -> Value {
        let body = body.to_string();
        let headers = format!(
            "Content-Type: application/json\r\nOrigin: http://{}\r\nContent-Length: {}\r\n",
            self.host,
            body.len()
        );
        let answer = self.send("POST", &format!("/T/{route}"), &headers, body.as_bytes());
        let (head, body) = answer.split_once("\r\n\r\n").expect("an answer");
        assert!(head.starts_with("HTTP/1.1 200"), "{answer}");
        serde_json::from_str(body).unwrap()
    }

    fn ask(&self, question: Value, epoch: u64, edits: Value) -> u64 {
        let wish = json!({ "question": question, "epoch": epoch, "edits": edits });
        self.post("ask", &wish)["revision"].as_u64().unwrap()
    }

    fn listen(&self) -> News {
        let mut stream = self.connect();
        let request = format!("GET /{}/events HTTP/1.1\r\nHost: {}\r\n\r\n", self.token, self.host);
        stream.write_all(request.as_bytes()).unwrap();
        News(BufReader::new(stream))
    }
}

fn status(answer: &str) -> &str {
    answer.split(' ').nth(1).unwrap_or("none")
}

/// What the server says, as it says it.
struct News(BufReader<TcpStream>);

impl News {
    /// The next event for which `wanted` gives something.
    #[track_caller]
    fn until<T>(&mut self, mut wanted: impl FnMut(&str, &Value) -> Option<T>) -> T {
        let (start, mut kind) = (Instant::now(), String::new());
        while start.elapsed() < PATIENCE {
            let mut line = String::new();
            assert!(self.0.read_line(&mut line).unwrap() > 0, "the server hung up");
            if let Some(word) = line.strip_prefix("event: ") {
                kind = word.trim().to_string();
            }
            if let Some(text) = line.strip_prefix("data: ")
                && let Some(found) = wanted(&kind, &serde_json::from_str(text).unwrap())
            {
                return found;
            }
        }
        panic!("nothing of the kind was said");
    }

    /// The last answer to a revision from `from` on: that with dry friction.
    #[track_caller]
    fn dry(&mut self, from: u64) -> Value {
        self.until(|kind, v| {
            let wanted = kind == "answer" && v["revision"].as_u64() >= Some(from);
            assert!(v["error"].is_null() || v["revision"].as_u64() < Some(from), "{}", v["error"]);
            (wanted && v["law"] == "coulomb").then(|| v.clone())
        })
    }
}

fn arch(thickness: f64) -> String {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/semicircular-arch-thick.json");
    let mut scene: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    *scene.pointer_mut("/templates/0/arch/thickness").unwrap() = thickness.into();
    serde_json::to_string_pretty(&scene).unwrap()
}

/// A folder with the scene of an arch that stands.
fn desk() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("arch.json");
    fs::write(&file, arch(0.12)).unwrap();
    (folder, file)
}

/// Another origin, no token, a path outside, 100 MB, and what is no request at all: a thousand of
/// them, and browsers that are killed while they listen.
#[test]
fn strangers_are_refused_a_thousand_times() {
    let (_folder, file) = desk();
    let open = Open::new(&file);
    let mut news = open.listen();
    news.dry(0);
    let huge = "Content-Type: application/json\r\nContent-Length: 104857600\r\n";
    let some = vec![b'x'; 1 << 16];
    let kinds: [(&str, &str, &str, &[u8], &str); 10] = [
        ("GET", "/T/", "Origin: http://evil.example\r\n", b"", "403"),
        ("GET", "/T/", "Host: evil.example\r\n", b"", "403"),
        ("GET", "/T/events", "Sec-Fetch-Site: cross-site\r\n", b"", "403"),
        ("GET", "/", "", b"", "404"),
        ("GET", "/00000000000000000000000000000000/", "", b"", "404"),
        ("GET", "/T/../../../etc/passwd", "", b"", "404"),
        ("GET", "/T/%2e%2e/arch.json", "", b"", "404"),
        ("POST", "/T/ask", huge, &some, "413"),
        ("POST", "/T/ask", "Content-Type: text/plain\r\nContent-Length: 2\r\n", b"{}", "415"),
        ("nonsense\0", "\0", "", b"", "400"),
    ];
    for round in 0..100 {
        for (method, target, headers, body, wanted) in kinds {
            let answer = open.send(method, target, headers, body);
            assert_eq!(status(&answer), wanted, "round {round}: {method} {target} {headers}");
            assert!(!answer.contains("voussoir-scene") && !answer.contains(&open.token));
        }
    }
    for _ in 0..100 {
        // Gone in the middle of what it hears.
        drop(open.listen());
    }
    let page = open.send("GET", "/T/", "", b"");
    assert!(status(&page) == "200" && page.contains("connect-src 'self'"), "{page:.300}");
    assert!(!page.contains("Access-Control-Allow-Origin"));
    // Nothing of all that was asked.
    let revision = open.ask(json!({ "assess": {} }), 0, json!({}));
    assert_eq!(revision, 2, "one file, one question");
    assert!(open.listen().dry(revision)["title"].as_str().unwrap().contains("stands"));
}

#[test]
fn a_request_that_never_ends_holds_up_nobody() {
    let (_folder, file) = desk();
    let open = Open::new(&file);
    let mut slow: Vec<TcpStream> = (0..20).map(|_| open.connect()).collect();
    for stream in &mut slow {
        stream.write_all(b"GET / HTTP/1.1\r\nHost: ").unwrap();
    }
    assert_eq!(status(&open.send("GET", "/T/", "", b"")), "200");
    let mut answer = String::new();
    slow[0].read_to_string(&mut answer).unwrap();
    assert_eq!(status(&answer), "408");
    let long = format!("X: {}\r\n", "x".repeat(20_000));
    assert_eq!(status(&open.send("GET", "/T/", &long, b"")), "431");
}

#[test]
fn connections_that_say_nothing_keep_out_nobody() {
    let (_folder, file) = desk();
    let open = Open::new(&file);
    let silent: Vec<TcpStream> = (0..600).map(|_| open.connect()).collect();
    let begun = Instant::now();
    for _ in 0..5 {
        assert_eq!(status(&open.send("GET", "/T/", "", b"")), "200");
        drop(open.listen().dry(0));
    }
    let taken = begun.elapsed();
    assert_eq!(silent.len(), 600);
    // A request that waited for them would have waited for all of their five seconds each time.
    assert!(taken < Duration::from_secs(20), "{taken:?}");
}

#[cfg(unix)]
#[test]
fn a_link_in_the_place_of_the_scene_shows_nothing_of_where_it_leads() {
    let (folder, file) = desk();
    let open = Open::new(&file);
    let mut news = open.listen();
    news.dry(0);
    let secret = folder.path().join("secret");
    fs::write(&secret, "{ \"format\": \"voussoir-scene/1\", \"password\": \"sesame\" }").unwrap();
    let link = folder.path().join("link");
    std::os::unix::fs::symlink(&secret, &link).unwrap();
    fs::rename(&link, &file).unwrap();
    let error = news
        .until(|kind, v| (kind == "status" && !v["error"].is_null()).then(|| v["error"].clone()));
    let text = error.to_string();
    assert!(
        text.contains("link") && !text.contains("sesame") && !text.contains("password"),
        "{text}"
    );
    // Opened through a link, the file where it led then is followed.
    let (folder, file) = desk();
    let link = folder.path().join("link.json");
    std::os::unix::fs::symlink(&file, &link).unwrap();
    let answer = Open::new(&link).listen().dry(0);
    assert!(answer["title"].as_str().unwrap().contains("stands"));
}

#[test]
fn saves_are_followed_and_mistakes_have_their_place() {
    let (folder, file) = desk();
    let open = Open::new(&file);
    let mut news = open.listen();
    let first = news.dry(0);
    assert!(first["title"].as_str().unwrap().contains("stands"), "{}", first["title"]);
    assert!(first["view"]["bodies"].is_object() && first["head"].as_str().unwrap().contains("<h1"));
    let next = |v: &Value| v["revision"].as_u64().unwrap() + 1;
    // Half a file, then the rest: only the whole is asked.
    let (thin, cut) = (arch(0.1), 200);
    fs::write(&file, &thin[..cut]).unwrap();
    sleep(Duration::from_millis(30));
    fs::write(&file, &thin).unwrap();
    let falls = news.dry(next(&first));
    assert!(falls["title"].as_str().unwrap().contains("falls"), "{}", falls["title"]);
    // Replaced by another file, as editors do, of the same length.
    let other = folder.path().join("arch.json.swp");
    fs::write(&other, arch(0.2)).unwrap();
    fs::rename(&other, &file).unwrap();
    let stands = news.dry(next(&falls));
    assert!(stands["title"].as_str().unwrap().contains("stands"), "{}", stands["title"]);
    // A mistake that stays is said, with line, column and the line itself.
    fs::write(&file, arch(0.2).replace("0.2", "\"wide\"")).unwrap();
    let error = news
        .until(|kind, v| (kind == "status" && !v["error"].is_null()).then(|| v["error"].clone()));
    let (line, at) = (&error["excerpt"]["text"], error["excerpt"]["at"].as_u64().unwrap());
    assert!(
        line.as_str().unwrap()[usize::try_from(at).unwrap()..].starts_with("\"wide\""),
        "{error}"
    );
    assert!(error["path"].as_str().unwrap().contains("thickness"), "{error}");
    // And a file that is gone.
    fs::remove_file(&file).unwrap();
    news.until(|kind, v| {
        let text = v["error"]["text"].as_str().unwrap_or_default();
        (kind == "status" && text.contains("cannot be read")).then_some(())
    });
    fs::write(&file, arch(0.1)).unwrap();
    assert!(news.dry(next(&stands))["title"].as_str().unwrap().contains("falls"));
}

#[test]
fn numbers_vary_and_a_saved_scene_replaces_none() {
    let (folder, file) = desk();
    let before = fs::read(&file).unwrap();
    let open = Open::new(&file);
    let mut news = open.listen();
    let scene = news.until(|kind, v| (kind == "scene").then(|| v.clone()));
    let epoch = scene["epoch"].as_u64().unwrap();
    let knobs = scene["knobs"].as_array().unwrap();
    let pointer = "/templates/0/arch/thickness";
    let knob = knobs.iter().find(|k| k["pointer"] == pointer).unwrap();
    assert!(knob["low"].as_f64() < knob["value"].as_f64() && knob["whole"] == false);
    // Least thickness of this arch (Ochsendorf, Milankovitch): 0.10672 of its radius.
    for (thickness, verdict, laws) in [(0.1067, "falls", 2), (0.1068, "stands", 2)] {
        let edits = json!({ pointer: thickness });
        let revision = open.ask(json!({ "assess": {} }), epoch, edits.clone());
        let mut said = Vec::new();
        let answer = news.until(|kind, v| {
            let mine = kind == "answer" && v["revision"] == revision;
            if mine {
                said.push(v["law"].as_str().unwrap().to_string());
            }
            (mine && v["law"] == "coulomb").then(|| v.clone())
        });
        // The coarse one may have been overtaken; the other order never happens.
        assert!(said.len() <= laws && said.last().unwrap() == "coulomb", "{said:?}");
        assert!(answer["title"].as_str().unwrap().contains(verdict), "{}", answer["title"]);
        assert_eq!(answer["edited"], true);
        assert!(!answer["facts"].as_str().unwrap().contains("voussoir assess"), "no wrong command");
    }
    // All questions of the tabs but those about a load that is not there, which say so.
    let support = scene["supports"][1].as_str().unwrap();
    let settle = json!({ "settle": { "moves": [{ "support": support, "way": [0.02, 0, 0] }] } });
    for (question, word) in [
        (json!({ "tilt": { "toward": [[1, 0, 0]] } }), "tilt"),
        (json!({ "thrust": { "range": true } }), "thrust"),
        (settle, "settle"),
        (json!({ "kinematic": { "toward": [[1, 0, 0]] } }), "kinematic"),
    ] {
        let revision = open.ask(question, epoch, json!({}));
        news.until(|kind, v| {
            assert!(v["revision"] != revision || v["error"].is_null(), "{word}: {}", v["error"]);
            (kind == "answer" && v["revision"] == revision && v["question"] == word).then_some(())
        });
    }
    let revision = open.ask(json!({ "limit": {} }), epoch, json!({}));
    let hint = news.until(|_, v| {
        (v["revision"] == revision).then(|| v["error"]["hint"].as_str().map(String::from)).flatten()
    });
    assert!(hint.contains("live"), "{hint}");
    // What leads nowhere, or to something else, is refused.
    for edits in [json!({ "/templates/7/x": 1 }), json!({ pointer: "word" })] {
        let revision = open.ask(json!({ "assess": {} }), epoch, edits);
        news.until(|_, v| (v["revision"] == revision && !v["error"].is_null()).then_some(()));
    }
    open.ask(json!({ "assess": {} }), epoch, json!({ pointer: 0.25 }));
    let names: Vec<_> = (0..2).map(|_| open.post("save", &json!({}))["file"].clone()).collect();
    assert_ne!(names[0], names[1]);
    for name in names {
        let path = PathBuf::from(name.as_str().unwrap());
        assert_eq!(path.parent().unwrap(), folder.path());
        let saved: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
        assert_eq!(saved.pointer(pointer), Some(&json!(0.25)));
    }
    assert_eq!(fs::read(&file).unwrap(), before, "the file itself is as it was");
}

#[test]
fn what_cannot_be_followed_is_said_at_once() {
    let folder = tempfile::tempdir().unwrap();
    for (scene, words) in
        [("-", "needs a file to follow"), ("no.json", "cannot be read"), (".", "not a file")]
    {
        let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
            .args(["open", scene])
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(words), "{scene}: {said}");
    }
}
