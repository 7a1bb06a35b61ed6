//! Connections: one thread each, and no more than a browser needs.

use super::{
    desk::{Desk, Edits},
    gate::{Gate, Refusal, Route},
    http, knobs,
    thread::thread,
};
use crate::{analysis::Question, report::page};
use serde::Deserialize;
use serde_json::{Value, json};
use std::{
    collections::VecDeque,
    fs::OpenOptions,
    io::{self, Write},
    net::{Ipv4Addr, Shutdown, SocketAddr, TcpListener, TcpStream},
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, AtomicUsize, Ordering},
    },
    time::Duration,
};

/// Connections at a time that have shown the token, and as many that have not yet. Fewer: a few open
/// windows shut each other out. More: threads for nothing.
const MOST: usize = 64;
/// A window that is gone is noticed after this time at the latest.
const HEARTBEAT: Duration = Duration::from_millis(200);
/// Names that are tried for a scene that is saved.
const NAMES: usize = 1000;

/// What a page sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wish {
    question: Question,
    /// The file that the edits are about.
    epoch: u64,
    edits: Edits,
}

/// The server of one page.
pub struct Server {
    listener: TcpListener,
    inside: Arc<Inside>,
}

struct Inside {
    gate: Gate,
    desk: Arc<Desk>,
    scene: PathBuf,
    /// Connections that have shown the token.
    open: AtomicUsize,
    strangers: Strangers,
}

/// Connections that have not shown the token yet, the oldest first. A browser shows it at once: who
/// has been silent longest goes when there are too many, so that they keep nobody out.
#[derive(Default)]
struct Strangers {
    list: Mutex<VecDeque<(u64, TcpStream)>>,
    next: AtomicU64,
}

impl Strangers {
    /// Takes one in, and says its number.
    fn add(&self, stream: &TcpStream) -> io::Result<u64> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let mut list = self.list.lock().unwrap_or_else(PoisonError::into_inner);
        if list.len() >= MOST
            && let Some((_, oldest)) = list.pop_front()
        {
            let _ = oldest.shutdown(Shutdown::Both);
        }
        list.push_back((number, stream.try_clone()?));
        Ok(number)
    }

    /// One is none any more.
    fn remove(&self, number: u64) {
        let mut list = self.list.lock().unwrap_or_else(PoisonError::into_inner);
        list.retain(|(other, _)| *other != number);
    }
}

impl Server {
    /// Listens on the loopback.
    ///
    /// # Errors
    /// The port is taken, or there are no random numbers.
    pub fn bind(port: u16, scene: &Path, desk: Arc<Desk>) -> io::Result<Self> {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))?;
        let gate = Gate::new(listener.local_addr()?)?;
        let (scene, open) = (scene.to_path_buf(), AtomicUsize::new(0));
        let strangers = Strangers::default();
        Ok(Self { listener, inside: Arc::new(Inside { gate, desk, scene, open, strangers }) })
    }

    /// Where it listens.
    ///
    /// # Errors
    /// The system does not say.
    pub fn address(&self) -> io::Result<SocketAddr> {
        self.listener.local_addr()
    }

    /// The token of its gate.
    pub fn token(&self) -> &str {
        self.inside.gate.token()
    }

    /// Answers for good.
    pub fn run(&self) {
        loop {
            // Out of descriptors, or gone already: the next one may do.
            let Ok((stream, _)) = self.listener.accept() else {
                std::thread::sleep(Duration::from_millis(20));
                continue;
            };
            let inside = self.inside.clone();
            let Ok(number) = inside.strangers.add(&stream) else { continue };
            let work = inside.clone();
            if thread("page", move || work.connection(stream, number)).is_err() {
                inside.strangers.remove(number);
            }
        }
    }
}

impl Inside {
    /// One request. What cannot be sent is nobody's any more.
    fn connection(&self, mut stream: TcpStream, number: u64) {
        let _ = stream.set_nodelay(true);
        let asked = http::head(&mut stream)
            .and_then(|(head, begun)| self.gate.check(&head).map(|wanted| (wanted, begun)));
        let refused = match asked {
            Err(refusal) => Err(refusal),
            Ok(_) if self.open.fetch_add(1, Ordering::Relaxed) >= MOST => {
                self.open.fetch_sub(1, Ordering::Relaxed);
                Err((503, "Service Unavailable"))
            }
            Ok((wanted, begun)) => {
                self.strangers.remove(number);
                let done = self.request(&mut stream, begun, wanted);
                self.open.fetch_sub(1, Ordering::Relaxed);
                done
            }
        };
        if let Err(refusal) = refused {
            http::refuse(&mut stream, refusal);
        }
        self.strangers.remove(number);
    }

    fn request(
        &self,
        stream: &mut TcpStream,
        begun: Vec<u8>,
        (route, length): (Route, usize),
    ) -> Result<(), Refusal> {
        let body = http::body(stream, begun, length)?;
        let gone = |_: io::Error| ();
        let json = "application/json";
        let _ = match route {
            Route::Page => {
                let name = self.scene.display().to_string();
                let page = page::live(&name).map_err(|_| (500, "Internal Server Error"))?;
                http::answer(stream, (200, "OK"), "text/html; charset=utf-8", &page).map_err(gone)
            }
            Route::Events => self.events(stream).map_err(gone),
            Route::Ask => {
                let wish: Wish = serde_json::from_slice(&body).map_err(|_| (400, "Bad Request"))?;
                if !is_offered(&wish.question) {
                    return Err((400, "Bad Request"));
                }
                let revision = self.desk.ask(wish.question, wish.epoch, wish.edits);
                let said = json!({ "revision": revision }).to_string();
                http::answer(stream, (200, "OK"), json, &said).map_err(gone)
            }
            Route::Save => {
                let said = match self.save() {
                    Ok(path) => json!({ "file": path.display().to_string() }),
                    Err(why) => json!({ "error": why }),
                };
                http::answer(stream, (200, "OK"), json, &said.to_string()).map_err(gone)
            }
        };
        Ok(())
    }

    /// Everything that is said, as it is said.
    fn events(&self, stream: &mut TcpStream) -> io::Result<()> {
        http::begin(stream, "text/event-stream")?;
        let mut seen = 0;
        loop {
            let news = self.desk.news(seen, HEARTBEAT);
            if news.is_empty() && http::is_gone(stream)? {
                return Ok(());
            }
            for (number, kind, text) in news {
                let event = format!("event: {}\ndata: {text}\n\n", kind.word());
                stream.write_all(event.as_bytes())?;
                seen = number;
            }
        }
    }

    /// Writes the scene as it is changed beside its file, under a name that nothing has.
    fn save(&self) -> Result<PathBuf, String> {
        let job = self.desk.wanted();
        let bytes = job.file.as_ref().as_ref().map_err(ToString::to_string)?;
        let mut scene: Value = serde_json::from_slice(bytes).map_err(|e| e.to_string())?;
        knobs::change(&mut scene, &job.edits).map_err(|e| e.to_string())?;
        let text = serde_json::to_string_pretty(&scene).map_err(|e| e.to_string())? + "\n";
        let stem = self.scene.file_stem().map_or("scene".into(), |s| s.to_string_lossy());
        for k in 1..=NAMES {
            let path = self.scene.with_file_name(format!("{stem}-{k}.json"));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(mut file) => {
                    let done = file.write_all(text.as_bytes()).and_then(|()| file.sync_all());
                    return done.map(|()| path.clone()).map_err(|e| {
                        // Half a scene is none.
                        let _ = std::fs::remove_file(&path);
                        format!("{}: {e}", path.display())
                    });
                }
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                Err(e) => return Err(format!("{}: {e}", path.display())),
            }
        }
        Err(format!("{stem}-1.json to {stem}-{NAMES}.json already exist; remove some of them"))
    }
}

/// The questions of the tabs.
fn is_offered(question: &Question) -> bool {
    matches!(
        question,
        Question::Assess(_)
            | Question::Limit(_)
            | Question::Tilt(_)
            | Question::Thrust(_)
            | Question::Settle(_)
            | Question::Kinematic(_)
    )
}
