//! Report pages in a real browser (Chromium, headless, without a network): nothing on its console,
//! blocks and joints can be picked, the mechanism moves, and all of it without WebGL as well.
//! Skipped, with a word, where there is no Chromium.

mod checking;
mod driver;
mod live;
mod site;

use crate::page::{HOSTILE, hostile, report};
use driver::Browser;
use serde_json::{Value, json};
use std::{fs, path::PathBuf};

fn structure(name: &str) -> String {
    format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

/// A browser and a folder of pages.
struct Desk {
    browser: Browser,
    folder: tempfile::TempDir,
}

impl Desk {
    fn new(more: &[&str]) -> Option<Self> {
        let browser = Browser::start(more);
        if browser.is_none() {
            crate::skipped("chromium and chromedriver are not on the path");
        }
        Some(Self { browser: browser?, folder: tempfile::tempdir().unwrap() })
    }

    /// Makes a page and opens it; waits for the first picture.
    fn open(&self, name: &str, arguments: &[&str]) {
        let file: PathBuf = self.folder.path().join(format!("{name}.html"));
        report(arguments, &file);
        self.browser.open(&file);
        self.browser.until(
            "return document.documentElement.dataset.drawn === 'yes' || data.view === undefined",
        );
    }

    #[track_caller]
    fn quiet(&self, name: &str) {
        let messages = self.browser.messages();
        assert!(messages.is_empty(), "{name}: {messages:#?}");
        assert_eq!(
            self.browser.run("return performance.getEntriesByType('resource').length"),
            0,
            "{name} asked for another file"
        );
    }

    /// Colours of the picture, coarsely, each with its share.
    fn colours(&self) -> Value {
        self.browser.run(
            "const c = document.createElement('canvas'); c.width = 160; c.height = 120; const x = c.getContext('2d');
             x.drawImage(shown, 0, 0, 160, 120); const d = x.getImageData(0, 0, 160, 120).data; let text = '';
             for (let i = 0; i < d.length; i += 4) text += String.fromCharCode(65 + (d[i] >> 5), 65 + (d[i + 1] >> 5), 65 + (d[i + 2] >> 5), 65 + (d[i + 3] >> 5));
             return text;",
        )
    }

    /// Clicks on a block that is in sight; its name as the page shows it, and as the scene says it.
    fn click_a_block(&self) -> (Value, Value) {
        let spot = self.browser.run(
            "const b = shown.getBoundingClientRect(); scrollTo(0, 0);
             for (let y = 0.35; y < 0.75; y += 0.04) for (let x = 0.2; x < 0.8; x += 0.04) {
               const p = hit(x * b.width, y * b.height, b.width, b.height);
               if (p && p.body !== undefined && !bodies.support[p.body]) return [b.left + x * b.width, b.top + y * b.height, bodies.ids[p.body]];
             } return null;",
        );
        assert!(!spot.is_null(), "no block is in sight");
        self.browser.click(spot[0].as_f64().unwrap(), spot[1].as_f64().unwrap());
        (
            self.browser.run("return document.querySelector('#picked h2')?.textContent ?? null"),
            spot[2].clone(),
        )
    }
}

/// A stable arch, one that collapses, a wall, a vault, a heap.
#[test]
fn pages_of_five_scenes_work() {
    let Some(desk) = Desk::new(&[]) else { return };
    let browser = &desk.browser;
    let five: [(&str, &[&str]); 5] = [
        ("stable", &["assess", &structure("semicircular-arch-thick")]),
        ("collapsing", &["assess", &structure("semicircular-arch-thin")]),
        ("wall", &["limit", &structure("running-bond-wall"), "--law", "associative"]),
        ("vault", &["limit", &structure("barrel-vault"), "--law", "associative"]),
        (
            "heap",
            &["repose", &structure("tetrahedral-pile"), "--toward", "1,0", "--law", "associative"],
        ),
    ];
    for (name, arguments) in five {
        desk.open(name, arguments);
        browser.until("return document.documentElement.dataset.drawn === 'yes'");
        assert_eq!(browser.run("return shown.id"), "canvas", "{name} is drawn with WebGL");
        let mut colours: Vec<char> = desk.colours().as_str().unwrap().chars().collect();
        colours.dedup();
        assert!(colours.len() > 500, "{name}: the picture is empty");
        let (shown, clicked) = desk.click_a_block();
        assert_eq!(shown, clicked, "{name}");
        let numbers = browser.run("return el('picked').textContent");
        assert!(
            numbers.as_str().is_some_and(|t| t.contains("mass") && t.contains("centre of mass")),
            "{name}: {numbers}"
        );
        // From the block to one of its joints, and its forces.
        browser.run("document.querySelector('#picked .links button').click()");
        let numbers = browser.run("return el('picked').textContent");
        assert!(
            numbers.as_str().is_some_and(|t| t.contains("law") && t.contains("normal force")),
            "{name}: {numbers}"
        );
        if name != "stable" {
            slider_moves(&desk, name);
        }
        desk.quiet(name);
        for (width, scheme) in [(1440, "light"), (1440, "dark"), (390, "dark"), (390, "light")] {
            let media =
                json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
            browser.command("Emulation.setEmulatedMedia", media);
            let metrics =
                json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
            browser.command("Emulation.setDeviceMetricsOverride", metrics);
            assert_eq!(
                browser.run("return document.documentElement.scrollWidth > innerWidth"),
                false,
                "{name} is wider than {width}"
            );
            browser.until("return !waiting && shown.width === Math.round(shown.clientWidth)");
            browser.picture(&desk.folder.path().join("window.png"));
            if let Some(folder) = option_env!("CARGO_TARGET_TMPDIR") {
                let file = format!("page-{name}-{scheme}-{width}.png");
                fs::copy(desk.folder.path().join("window.png"), PathBuf::from(folder).join(file))
                    .unwrap();
            }
        }
        browser.command("Emulation.clearDeviceMetricsOverride", json!({}));
        desk.quiet(name);
    }
}

/// By keys on the slider: the picture changes, the fastest corner goes as far as the slider says,
/// hinges stay closed.
fn slider_moves(desk: &Desk, name: &str) {
    let browser = &desk.browser;
    // How far the corners of bodies (or the ends of their diameters) have gone, and how far moving
    // hinges gape.
    let far = "let far = 0; for (let i = 0; i < COUNT; i++) for (let k = bodies.cornerStart[i]; k < bodies.cornerStart[i + 1]; k++) {
                 const p = at3(bodies.corners, k); far = Math.max(far, norm(sub(moved(i, p), p))); }
               for (let i = 0; i < COUNT; i++) if (bodies.radius[i] > 0) far = Math.max(far, displaced(i)); return far;";
    let gape = "const m = view.motions[0]; let gape = 0; for (let k = 0; k < m.markJoint.length; k++) if (m.markKind[k] === 'hinge') {
                 const j = m.markJoint[k], p = at3(m.markAt, k); gape = Math.max(gape, norm(sub(moved(joints.a[j], p), moved(joints.b[j], p)))); } return gape;";
    let number = |script: &str| browser.run(script).as_f64().unwrap();
    browser.run("layer('marks'); el('way').focus()");
    browser.keys("\u{e011}");
    browser.until("return !waiting && state.way === 0");
    let (rest, start) = (desk.colours(), number(far));
    assert!(start == 0.0, "{name}: at rest nothing has moved: {start}");
    browser.keys("\u{e010}");
    browser.until("return !waiting && state.way === 1");
    let end = number(far);
    let amplitude = number("return amplitude(view.motions[0])");
    assert!(end > 0.6 * amplitude && end < 1.2 * amplitude, "{name}: {end}");
    assert_ne!(rest, desk.colours(), "{name}: the picture shows the motion");
    let gap = number(gape);
    assert!(gap < 1e-5, "{name}: hinges gape by {gap}");
    browser.run("play(true)");
    let before = number("return state.way");
    browser.until(&format!("return Math.abs(state.way - {before}) > 0.02"));
    browser.run("play(false)");
}

#[test]
fn a_page_is_worked_by_keys_alone() {
    let Some(desk) = Desk::new(&[]) else { return };
    let browser = &desk.browser;
    desk.open("keys", &["assess", &structure("semicircular-arch-thick")]);
    browser.run("shown.focus()");
    let angle = browser.run("return eye.angle").as_f64().unwrap();
    browser.keys("\u{e012}n");
    assert_eq!(browser.run("return document.querySelector('#picked h2').textContent"), "v00");
    assert_ne!(browser.run("return eye.angle").as_f64().unwrap(), angle);
    browser.keys("nnj");
    assert_eq!(browser.run("return el('kind').value"), "joints");
    browser.keys("\u{e00c}");
    assert_eq!(browser.run("return state.picked"), Value::Null);
    // The list, too: tab by tab everything that acts has a name.
    browser.run("el('kind').value = 'blocks'; el('kind').dispatchEvent(new Event('change')); el('list').focus()");
    browser.keys("\u{e015}\u{e015}");
    assert_eq!(
        browser.run("return document.querySelector('#picked h2').textContent"),
        browser.run("return el('list').selectedOptions[0].textContent")
    );
    let nameless = browser.run(
        "return [...document.querySelectorAll('button,input,select,canvas:not([hidden]),svg[tabindex]')].filter((e) => !e.closest('[hidden]'))
         .filter((e) => !(e.getAttribute('aria-label') || e.textContent.trim() || (e.labels && e.labels.length) || e.placeholder)).map((e) => e.outerHTML)",
    );
    assert_eq!(nameless, json!([]));
    browser.run("dispatchEvent(new Event('beforeprint'))");
    let printed =
        browser.run("return el('printed').src.slice(0, 22) + (el('printed').src.length > 5000)");
    assert_eq!(printed, "data:image/png;base64,true", "printers get an image");
    desk.quiet("keys");
}

#[test]
fn names_of_a_scene_are_shown_and_not_run() {
    let Some(desk) = Desk::new(&[]) else { return };
    let file = desk.folder.path().join("hostile.json");
    fs::write(&file, hostile().to_string()).unwrap();
    desk.open("hostile", &["assess", file.to_str().unwrap()]);
    let browser = &desk.browser;
    browser.run("pick({ body: 1 }); pick({ joint: 0 }); pick({ body: 1 }); state.colour = 'material'; redraw(true)");
    browser.until("return !waiting");
    assert_eq!(browser.run("return document.querySelector('#picked h2').textContent"), HOSTILE);
    assert_eq!(browser.run("return [document.title.includes('onerror'), document.images.length, window.broken ?? 0]"), json!([true, 1, 0]));
    desk.quiet("hostile");
}

#[test]
fn without_webgl_a_plain_canvas_does() {
    let Some(desk) = Desk::new(&["--disable-3d-apis"]) else { return };
    for (name, scene) in [("arch", "semicircular-arch-thin"), ("heap", "sphere-pile")] {
        desk.open(name, &["assess", &structure(scene), "--law", "associative"]);
        assert_eq!(desk.browser.run("return shown.id"), "flat");
        let (shown, clicked) = desk.click_a_block();
        assert_eq!(shown, clicked);
        if name == "arch" {
            slider_moves(&desk, name);
        }
        desk.quiet(name);
    }
}

#[test]
fn a_simulation_plays_and_a_sweep_shows_values() {
    let Some(desk) = Desk::new(&[]) else { return };
    let browser = &desk.browser;
    desk.open("film", &["simulate", &structure("semicircular-arch-thin"), "--fast"]);
    assert!(browser.run("return view.film.times.length").as_u64().unwrap() > 20);
    let moved = "setWay(1); state.magnify = 1; pose(); let far = 0; for (let i = 0; i < COUNT; i++) far = Math.max(far, norm([poses[8*i+4], poses[8*i+5], poses[8*i+6]])); return far * view.length;";
    let moved = browser.run(moved).as_f64().unwrap();
    // A block has fallen when it moved by 5 % of its thickness of 0.1 m.
    assert!(moved > 1e-3 && moved < 6e-3, "{moved}");
    desk.quiet("film");
    let plan = format!("{}/structures/sweeps/buttress-width.json", env!("CARGO_MANIFEST_DIR"));
    let rows = desk.folder.path().join("rows.jsonl");
    desk.open("sweep", &["sweep", &plan, "-o", rows.to_str().unwrap()]);
    let spot = browser
        .run("const b = document.querySelector('figure svg').getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 3]");
    browser.run("document.querySelector('figure svg').focus()");
    browser.keys("\u{e014}");
    let hint = browser.run("return document.querySelector('figure .hint').textContent");
    assert!(hint.as_str().is_some_and(|t| t.contains("0.01451")), "the first value: {hint}");
    assert!(spot[1].as_f64().unwrap() > 0.0);
    let first = "return document.querySelector('tbody td').textContent";
    assert_eq!(browser.run(first), "0");
    browser.run("const b = [...document.querySelectorAll('th button')].find((b) => b.textContent === 'row'); b.click(); b.click()");
    assert_eq!(browser.run(first), "24");
    desk.quiet("sweep");
}

/// Plane scenes lie in the plane of the screen; members, supports and what is hidden; names under the
/// pointer.
#[test]
fn the_view_shows_what_there_is() {
    let Some(desk) = Desk::new(&[]) else { return };
    let browser = &desk.browser;
    desk.open("tie", &["limit", &structure("tied-arch"), "--law", "associative"]);
    // By parallel rays along the normal of the plane: both ends of a block's depth are seen at one
    // place, and what is drawn is inside the canvas, between the buttons and the legend.
    let spots = "const b = shown.getBoundingClientRect(), m = lens(b.width, b.height).matrix;
        const at = (p) => { const w = m[3]*p[0]+m[7]*p[1]+m[11]*p[2]+m[15]; return [(0.5+0.5*(m[0]*p[0]+m[4]*p[1]+m[8]*p[2]+m[12])/w)*b.width, (0.5-0.5*(m[1]*p[0]+m[5]*p[1]+m[9]*p[2]+m[13])/w)*b.height]; };";
    let apart = browser.run(&format!("{spots} const [p, q] = [at([0.1, -0.2, 0.1]), at([0.1, 0.2, 0.1])]; return Math.hypot(p[0]-q[0], p[1]-q[1])"));
    assert!(apart.as_f64().is_some_and(|d| d < 1e-3), "{apart}");
    let inside = "loadArrows().every((f, k) => { const p = at(sub(at3(loads.at, k), f)); return p[0] > 0 && p[0] < b.width && p[1] > 30 && p[1] < b.height - el('legend').offsetHeight; })";
    assert_eq!(browser.run(&format!("{spots} return loadArrows().length > 0 && {inside}")), true);
    // The tie is named, picked and listed.
    let name = format!(
        "{spots} const [, p, q] = memberLines()[0], s = at(mul(add(p, q), 0.5)), over = overlay(...s, b.width, b.height); pick(over[1]); return [over[0], el('picked').textContent, el('list').selectedOptions[0].textContent]"
    );
    let said = browser.run(&name);
    assert!(
        said[0].as_str().is_some_and(|t| t.starts_with("tie tie: ") && t.ends_with("N")),
        "{said}"
    );
    assert!(said[1].as_str().is_some_and(|t| t.contains("force")), "{said}");
    assert_eq!(said[2], "tie (tie)");
    // The key O changes the rays, and a named side takes them back.
    browser.run("shown.focus()");
    browser.keys("o");
    assert_eq!(
        browser.run("return [isParallel(), el('lens').getAttribute('aria-pressed')]"),
        json!([false, "true"])
    );
    browser.keys("f");
    assert_eq!(
        browser.run("return [isParallel(), el('lens').getAttribute('aria-pressed')]"),
        json!([true, "false"])
    );
    // Without supports, the support is neither drawn nor picked.
    let ground = browser.run("return bodies.support.findIndex((s) => s)");
    let seen = format!(
        "{spots} const s = at(at3(bodies.center, {ground})); return hit(...s, b.width, b.height)?.body ?? null"
    );
    assert_eq!(browser.run(&seen), ground);
    browser
        .run("el('supports').value = 'hidden'; el('supports').dispatchEvent(new Event('change'))");
    assert_eq!(browser.run(&seen), Value::Null);
    desk.quiet("tie");
    desk.open("hidden", &["assess", &structure("tied-arch"), "--hide", "supports"]);
    assert_eq!(browser.run("return state.supports"), "hidden");
    // Grains in a box: glass. So few have no angle of repose, and no line says that they had.
    let heap = ["repose", "drain", "grains=300", "--question", "repose", "--skip-margin"];
    desk.open("heap", &heap);
    let shown = browser.run("return [state.supports, isParallel(), el('legend').textContent]");
    assert_eq!(shown[0], json!("glass"));
    let line = "return [!view.slope, named().some((n) => n[2].includes('straight line'))]";
    assert_eq!(browser.run(line), json!([true, false]));
    desk.quiet("heap");
}

/// Of joints that yield: pressures by colour over each joint, with their scale; displacements magnified
/// by what the slider says.
#[test]
fn pressures_and_displacements_are_shown() {
    for (name, more, shown) in
        [("bed", &[][..], "canvas"), ("bed-flat", &["--disable-3d-apis"][..], "flat")]
    {
        let Some(desk) = Desk::new(more) else { return };
        let browser = &desk.browser;
        desk.open(name, &["state", &structure("block-on-bed")]);
        assert_eq!(browser.run("return shown.id"), shown);
        let seen = browser.run("return [polygons().length, polygons()[0][1].length, el('legend').textContent, el('wayText').textContent, state.way]");
        assert_eq!((&seen[0], &seen[1], &seen[4]), (&json!(1), &json!(4), &json!(0.5)), "{seen}");
        let said = |k: usize, words: &str| seen[k].as_str().is_some_and(|t| t.contains(words));
        assert!(said(2, "Pressure in joints") && said(2, "39.24 kPa"), "{seen}");
        assert!(said(3, "3.924e−5 m at the farthest corner × "), "{seen}");
        browser.run("pick({ joint: 0 })");
        let numbers = browser.run("return el('picked').textContent");
        assert!(
            numbers.as_str().is_some_and(|t| t.contains("greatest pressure39.24 kPa")),
            "{numbers}"
        );
        browser.run("el('layer-pressures').click()");
        browser.until("return !el('legend').textContent.includes('Pressure')");
        desk.quiet(name);
    }
}

/// On paper: the record with its drawing, no picture that needs a graphics card, nothing to click,
/// nothing wider than the sheet.
#[test]
fn a_record_is_printed() {
    let Some(desk) = Desk::new(&[]) else { return };
    let browser = &desk.browser;
    desk.open("record", &["limit", &structure("arch-with-point-load"), "--law", "associative"]);
    browser.command("Emulation.setEmulatedMedia", json!({ "media": "print" }));
    let metrics = json!({ "width": 690, "height": 1000, "deviceScaleFactor": 1, "mobile": false });
    browser.command("Emulation.setDeviceMetricsOverride", metrics);
    let seen = "const seen = (q) => [...document.querySelectorAll(q)].filter((e) => e.getClientRects().length > 0);
        return [seen('canvas, button, select, input, summary').length, seen('.cover .sheet .pin').length > 0, seen('.record table').length,
            document.documentElement.scrollWidth <= innerWidth, seen('.typed, .internals').length]";
    let found = browser.run(seen);
    assert_eq!(
        (&found[0], &found[1], &found[3], &found[4]),
        (&json!(0), &json!(true), &json!(true), &json!(0)),
        "{found}"
    );
    assert!(found[2].as_u64().is_some_and(|n| n >= 4), "{found}");
    desk.quiet("record");
}
