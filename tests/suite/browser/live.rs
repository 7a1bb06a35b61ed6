//! The page that lives, in a real browser: it fits windows of 1280 and 390, light and dark, its tabs
//! and sliders work, a save shows, and so does a mistake.

use super::{Desk, structure};
use crate::live::Open;
use serde_json::json;
use std::{fs, path::PathBuf};

/// Waits until everything that was asked is answered.
const ANSWERED: &str = "return document.documentElement.dataset.drawn === 'yes' && live.seen >= live.wanted && !live.busy && !document.body.classList.contains('old')";

#[test]
fn the_live_page_fits_and_follows() {
    let Some(desk) = Desk::new(&[]) else { return };
    let browser = &desk.browser;
    let scene = desk.folder.path().join("arch.json");
    fs::copy(structure("semicircular-arch-thick"), &scene).unwrap();
    let open = Open::new(&scene);
    browser.visit(&open.address());
    browser.until(ANSWERED);
    let title = || browser.run("return document.querySelector('h1').textContent");
    assert!(title().as_str().is_some_and(|t| t.contains("Stands")), "{}", title());
    for (width, scheme) in [(1280, "light"), (1280, "dark"), (390, "dark"), (390, "light")] {
        let media = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        browser.command("Emulation.setEmulatedMedia", media);
        let metrics =
            json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
        browser.command("Emulation.setDeviceMetricsOverride", metrics);
        assert_eq!(
            browser.run("return document.documentElement.scrollWidth > innerWidth"),
            false,
            "the live page is wider than {width}"
        );
        browser.until("return !waiting && shown.width === Math.round(shown.clientWidth)");
        // What can be worked is large enough to be touched, and inside the window.
        let small = browser.run(
            "return [...document.querySelectorAll('button, select, input')].map((e) => [e, e.getBoundingClientRect()]).filter(([, b]) => b.width > 0 && b.height > 0).filter(([, b]) => b.left < 0 || b.right > innerWidth + 0.5 || b.height < 12).map(([e]) => e.outerHTML.slice(0, 80))",
        );
        assert_eq!(small, json!([]), "{width}, {scheme}");
        let dark = browser.run(
            "const c = getComputedStyle(document.body).backgroundColor.match(/[0-9.]+/g).map(Number); return c[0] + c[1] + c[2] < 384",
        );
        assert_eq!(dark, scheme == "dark", "{width}, {scheme}");
        browser.picture(&desk.folder.path().join("window.png"));
        if let Some(folder) = option_env!("CARGO_TARGET_TMPDIR") {
            let file = PathBuf::from(folder).join(format!("live-{scheme}-{width}.png"));
            fs::copy(desk.folder.path().join("window.png"), file).unwrap();
        }
    }
    browser.command("Emulation.clearDeviceMetricsOverride", json!({}));
    // A slider: thinner, it falls.
    browser.run(
        "const s = document.querySelector('input[type=range][aria-label*=thickness]'); s.value = 0.1; s.dispatchEvent(new Event('input'));",
    );
    browser.until("return document.querySelector('h1').textContent.includes('Falls')");
    browser.until(ANSWERED);
    // A save puts back what the file says, and another tab asks something else.
    let text = fs::read_to_string(&scene).unwrap();
    fs::write(&scene, text.replace("0.12", "0.13")).unwrap();
    browser.until("return document.querySelector('h1').textContent.includes('Stands')");
    browser.until(ANSWERED);
    browser.run("document.querySelector('#questions [data-question=tilt]').click()");
    browser.until("return document.querySelector('h1').textContent.toLowerCase().includes('tilt')");
    browser.until(ANSWERED);
    // A mistake is shown, and the picture is marked as old.
    fs::write(&scene, text.replace("0.12", "-0.12")).unwrap();
    browser.until("return document.body.classList.contains('old')");
    fs::write(&scene, &text).unwrap();
    browser.until(ANSWERED);
    let messages = browser.messages();
    assert!(messages.is_empty(), "{messages:#?}");
}
