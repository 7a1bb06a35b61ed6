//! The site: it answers, verifies, is stopped and shared, asks for nothing but its own files and leaves the
//! console empty. Skipped, with a word, where `web/build` has not made the module with the solver.

use super::{Browser, structure};
use serde_json::{Value, json};
use std::{
    fs,
    io::{Read, Write},
    net::TcpListener,
    process::Command,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

/// A static server of `web/site`, for as long as the test runs and until it is told to be silent; its
/// address.
fn served() -> Option<(String, Arc<AtomicBool>)> {
    let folder = format!("{}/web/site", env!("CARGO_MANIFEST_DIR"));
    if !["voussoir.wasm.gz", "module.js", "page.css"]
        .iter()
        .all(|f| fs::exists(format!("{folder}/{f}")).unwrap())
    {
        crate::skipped("web/build has not made web/site/voussoir.wasm.gz");
        return None;
    }
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}", listener.local_addr().unwrap());
    let silent = Arc::new(AtomicBool::new(false));
    let is_silent = silent.clone();
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            if is_silent.load(Ordering::Relaxed) {
                continue;
            }
            let mut request = [0; 8192];
            let read = stream.read(&mut request).unwrap_or(0);
            let text = String::from_utf8_lossy(&request[..read]);
            let name = text.split(' ').nth(1).unwrap_or("/").trim_start_matches('/').to_string();
            let kind = match name.rsplit('.').next() {
                Some("html") => "text/html",
                Some("js") => "text/javascript",
                Some("css") => "text/css",
                _ => "application/octet-stream",
            };
            let (status, body) = match fs::read(format!("{folder}/{name}")) {
                Ok(body) => ("200 OK", body),
                Err(_) => ("404 Not Found", Vec::new()),
            };
            let head = format!(
                "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
                body.len()
            );
            let _ = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&body));
        }
    });
    Some((address, silent))
}

/// What the page says when it is done.
fn status(browser: &Browser) -> String {
    browser.until("return document.getElementById('stop').hidden && document.getElementById('status').textContent !== ''");
    browser.run("return document.getElementById('status').textContent").as_str().unwrap().into()
}

/// The heading of the answer, in its frame.
fn heading(browser: &Browser) -> String {
    browser.frame(Some(0));
    browser.until("return document.querySelector('h1') !== null");
    let text = browser.run("return document.querySelector('h1').textContent");
    browser.frame(None);
    text.as_str().unwrap().into()
}

/// Opens a text as a file that a person chose.
fn choose(browser: &Browser, text: &str) {
    choose_file(browser, "own.json", text);
}

fn choose_file(browser: &Browser, name: &str, text: &str) {
    browser.run(&format!(
        "document.getElementById('status').textContent = ''; const d = new DataTransfer(); d.items.add(new File([{}], {}));
         const i = document.getElementById('file'); i.files = d.files; i.dispatchEvent(new Event('change'));",
        json!(text),
        json!(name)
    ));
}

#[test]
fn the_site_answers_verifies_and_is_shared() {
    let Some((address, silent)) = served() else { return };
    let Some(browser) = Browser::start(&["--window-size=390,844"]) else {
        return crate::skipped("chromium and chromedriver are not on the path");
    };
    browser.visit(&format!("{address}/index.html"));
    assert!(status(&browser).starts_with("Answered in"));
    assert_eq!(heading(&browser), "Stands");
    let wide = "return document.documentElement.scrollWidth - innerWidth";
    assert_eq!(browser.run(wide), 0, "it fits on a narrow screen");

    // Another question, and a link to it.
    browser.run("document.getElementById('status').textContent = ''; document.querySelector('input[value=limit]').click();");
    assert!(status(&browser).starts_with("Answered in"));
    let limit = heading(&browser);
    assert!(limit.starts_with("Carries"), "{limit}");
    browser.run("document.getElementById('share').click()");
    browser.until("return location.hash.startsWith('#s=')");
    let link = browser.run("return location.href");
    browser.visit("about:blank");
    browser.visit(link.as_str().unwrap());
    assert!(status(&browser).starts_with("Answered in"));
    assert_eq!(heading(&browser), limit);
    let cut: String = link.as_str().unwrap().chars().take(100).collect();
    browser.visit("about:blank");
    browser.visit(&cut);
    assert!(status(&browser).contains("holds no scene"));

    // A scene with a mistake, a result, a forged one.
    choose(&browser, r#"{ "format": "voussoir-scene/1", "blocks": 3 }"#);
    assert!(status(&browser).contains("blocks"));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("result.json");
    let asked = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .args(["assess", &structure("semicircular-arch-thin"), "--quiet", "--save"])
        .arg(&file)
        .output()
        .unwrap();
    assert_eq!(asked.status.code(), Some(1));
    let result = fs::read_to_string(file).unwrap();
    choose(&browser, &result);
    assert!(status(&browser).contains("proved"));
    let mut forged: Value = serde_json::from_str(&result).unwrap();
    forged["answer"]["verdict"] = json!("stable");
    choose(&browser, &forged.to_string());
    assert!(status(&browser).contains("refuted"));

    // A long answer is stopped, and the next one comes.
    let wall = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } },
        "templates": [ { "wall": { "size": [1, 0.5, 0.4], "courses": 40, "blocks": 40 } } ],
        "loads": { "live": [ { "weight": [1, 0, 0] } ] } }"#;
    choose(&browser, wall);
    browser.until("return !document.getElementById('stop').hidden");
    browser.run("document.getElementById('stop').click()");
    assert!(status(&browser).starts_with("Stopped"));
    choose(&browser, &fs::read_to_string(structure("block-in-groove")).unwrap());
    assert!(status(&browser).starts_with("Answered in"));

    // A slider: the arch with other numbers of voussoirs, the last of which counts.
    browser.run("document.getElementById('status').textContent = ''; document.querySelector('input[value=assess]').click(); const e = document.getElementById('example'); e.selectedIndex = 0; e.dispatchEvent(new Event('change'));");
    assert!(status(&browser).starts_with("Answered in"));
    browser.run("document.getElementById('status').textContent = ''; const s = [...document.querySelectorAll('#sliders label')].find((l) => l.textContent.includes('voussoirs')).querySelector('input'); for (const v of [28, 31, 33]) { s.value = v; s.dispatchEvent(new Event('input')); }");
    browser.until("return document.getElementById('stop').hidden && document.getElementById('status').textContent.startsWith('Answered')");
    let moved = browser.run("return document.getElementById('scene').value");
    assert!(moved.as_str().unwrap().contains("\"voussoirs\": 33"), "{moved}");
    browser.frame(Some(0));
    browser.until("return document.body.textContent.includes('35 blocks')");
    browser.frame(None);

    // A drawing: nothing is held until a layer is said to be.
    let drawing =
        fs::read_to_string(format!("{}/tests/formats/arch-2018-m.dxf", env!("CARGO_MANIFEST_DIR")))
            .unwrap();
    choose_file(&browser, "arch.dxf", &drawing);
    assert!(status(&browser).starts_with("No block is held"));
    browser.run("document.getElementById('status').textContent = ''; const l = document.getElementById('layers'); l.value = 'GROUND=support'; l.dispatchEvent(new Event('change'));");
    assert!(status(&browser).starts_with("Answered in"));
    assert!(heading(&browser).starts_with("Stands"));
    let said = browser.run("return document.getElementById('words').textContent");
    assert!(said.as_str().unwrap().contains("\"GROUND\" 2 outlines"), "{said}");
    assert_eq!(browser.run(wide), 0, "it still fits");

    // Without its server.
    browser.until("return navigator.serviceWorker.controller !== null");
    silent.store(true, Ordering::Relaxed);
    browser.visit("about:blank");
    browser.visit(&format!("{address}/index.html"));
    assert!(status(&browser).starts_with("Answered in"));

    let strangers = browser.run(
        "return performance.getEntriesByType('resource').map((e) => e.name).filter((n) => !n.startsWith(location.origin))",
    );
    assert_eq!(strangers, json!([]));
    assert!(browser.messages().is_empty(), "{:#?}", browser.messages());
}
