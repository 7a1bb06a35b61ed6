// The page that lives: it hears what is answered, shows it where the camera is, and asks again.
const TABS = [["assess", "Stands?"], ["limit", "Load factor"], ["tilt", "Tilt"], ["thrust", "Thrust"], ["settle", "Settle"], ["kinematic", "Earthquake"]];
const live = { question: "assess", epoch: 0, edits: {}, scene: { knobs: [], loads: [], supports: [] }, revision: 0, seen: 0, wanted: 0, kind: "", layout: "", busy: false, again: false, timer: 0, sliders: new Map(), support: "", way: null };
const badge = make("div", { class: "badge", id: "badge", hidden: true });
el("view").append(badge);

// What is asked, with its options.
function wish() {
  if (live.question === "settle") return { settle: { moves: [{ support: live.support, way: live.way }] } };
  if (live.question === "thrust") return { thrust: live.support ? { range: true, support: live.support } : { range: true } };
  return { [live.question]: {} };
}

// One request at a time: the next one goes as soon as there is a first answer, or after a while.
async function send() {
  live.again = true;
  if (live.busy) return;
  [live.busy, live.again] = [true, false];
  const body = JSON.stringify({ question: wish(), epoch: live.epoch, edits: live.edits });
  try {
    const reply = await fetch("ask", { method: "POST", headers: { "Content-Type": "application/json" }, body });
    if (!reply.ok) throw new Error(`the program answered ${reply.status}`);
    live.wanted = (await reply.json()).revision;
    live.timer = setTimeout(free, 250);
    if (live.seen >= live.wanted) free();
  } catch (error) {
    live.busy = false;
    old(`Not updated: ${error.message}`);
  }
}
function free() {
  clearTimeout(live.timer);
  live.busy = false;
  if (live.again) send();
}

// Picture, heading and numbers are not those of the scene as it is.
function old(words) {
  document.body.classList.toggle("old", Boolean(words));
  el("view").classList.toggle("old", Boolean(words));
  badge.hidden = !words;
  badge.textContent = words || "";
}

const LAWS = { associative: "Joints that slide open as well (associative): an upper bound. Computing with dry friction …", coulomb: "With dry friction.", "": "" };
function answered(a) {
  const before = COUNT ? { length: view.length, middle: view.middle } : null, picked = state.picked;
  const name = picked && (picked.body !== undefined ? bodies.ids[picked.body] : nameOf(picked.joint));
  document.title = a.title;
  // Escaped by the program that wrote it.
  document.querySelector("header").innerHTML = a.head;
  document.querySelector("header").append(make("p", { class: "law" }, a.edited ? `${LAWS[a.law]} Parameters differ from the file.` : LAWS[a.law]));
  el("words").innerHTML = a.facts;
  take(a.view);
  aim();
  const kind = [a.question, document.querySelector("h1")?.className, Boolean(view.film), view.motions.length > 0].join(), same = kind === live.kind;
  state.picked = null;
  if (same) keep(); else begin();
  drawCharts(a.charts);
  [live.kind, live.revision, live.question] = [kind, a.revision, a.question];
  if (picked) {
    const index = picked.body !== undefined ? bodies.ids.indexOf(name) : [...joints.a.keys()].findIndex((k) => nameOf(k) === name);
    if (index >= 0) pick({ [picked.body !== undefined ? "body" : "joint"]: index });
  }
  if (before && view.length < 4 * before.length && before.length < 4 * view.length) stay(before); else look("start");
  el("problem").hidden = true;
  old("");
  tabs();
  redraw(true);
}

// What was chosen stays chosen.
function keep() {
  const layout = JSON.stringify([view.states.map((s) => s.name), view.motions.map((m) => m.name), bodies.materials, Boolean(view.film), LAYERS.map((l) => Boolean(l[3]()))]);
  if (layout !== live.layout) {
    const { motion, colour: shade, magnify } = state, force = view.states[state.force] ? state.force : 0, on = [...state.layers];
    choices();
    state.layers.clear();
    on.forEach(layer);
    Object.assign(state, { force, magnify });
    if (view.film) el("magnify").value = magnify;
    el("state").value = force;
    const known = [...el("motion").options].some((o) => Number(o.value) === motion);
    state.motion = known ? motion : view.motions.length ? 0 : -1;
    el("motion").value = state.motion;
    state.colour = "stone";
    colour(shade);
    supports(state.supports);
  }
  live.layout = layout;
  motionNow(state.motion);
  fillList();
  numbers();
}

// The eye where it was, in metres; one that looks from a named side stays there.
function stay(before) {
  const scale = before.length / view.length;
  eye.target = eye.target.map((v, k) => v * scale + (before.middle[k] - view.middle[k]) / view.length);
  eye.distance *= scale;
}

function said(s) {
  const words = s.asking === "coulomb" ? "Computing with dry friction …" : s.asking !== undefined ? "Computing …" : s.error ? "The scene has a mistake." : `Answered in ${short(s.seconds, 2)} s.`;
  el("status").textContent = words;
  if (s.asking !== undefined && s.revision !== live.revision && COUNT) old("Picture of the previous scene; computing …");
  if (s.error) problem(s.error);
  if (s.error || s.seconds !== undefined) { live.seen = Math.max(live.seen, s.revision); if (live.busy && live.seen >= live.wanted) free(); }
}

function problem(error) {
  const lines = [make("p", {}, make("strong", {}, error.path ? `${error.path}: ` : ""), error.text)], at = error.excerpt;
  if (at) lines.push(make("pre", {}, `${at.text}\n${" ".repeat(at.at)}^`), make("p", { class: "note" }, `line ${at.line}, column ${at.column}`));
  if (error.hint) lines.push(make("p", { class: "note" }, error.hint));
  el("problem").replaceChildren(...lines);
  el("problem").hidden = false;
  if (COUNT) old("The picture is out of date: the scene has a mistake");
}

// Tabs, and what belongs to them.
function tabs() {
  // Made once: what has the focus keeps it.
  if (!el("questions").children.length) el("questions").append(...TABS.map(([key, text]) => make("button", { type: "button", "data-question": key, onclick: () => choose(key) }, text)));
  for (const b of el("questions").children) b.setAttribute("aria-pressed", String(b.dataset.question === live.question));
  const focus = document.activeElement && document.activeElement.id;
  const shape = `${live.question}:${live.scene.supports.join()}`;
  if (el("options").dataset.shape === shape) return;
  el("options").dataset.shape = shape;
  const support = make("select", { id: "support", onchange: (e) => { live.support = e.target.value; send(); } }, options(live.scene.supports.map((s) => [s, s])));
  support.value = live.support;
  const parts = [];
  if (["settle", "thrust"].includes(live.question) && live.scene.supports.length) parts.push(make("label", {}, "Support ", support));
  if (live.question === "settle" && live.way) ["x", "y", "z"].forEach((axis, k) => parts.push(...knob({ label: `movement along ${axis}, m`, value: live.way[k], low: -0.2 * span(), high: 0.2 * span(), whole: false }, (v) => { live.way[k] = v; })));
  el("options").replaceChildren(...parts);
  el("options").hidden = !parts.length;
  if (focus && el(focus)) el(focus).focus();
}
const span = () => Number((view.length || 1).toPrecision(2));
function choose(key) {
  live.question = key;
  if (!live.scene.supports.includes(live.support)) live.support = live.scene.supports[live.scene.supports.length - 1] || "";
  if (!live.way) live.way = [Number((0.1 * span()).toPrecision(2)), 0, 0];
  tabs();
  send();
}

// A number as a slider and as something to type.
function knob({ pointer, label, value, low, high, whole }, change) {
  const slider = make("input", { type: "range", min: low, max: high, step: whole ? 1 : (high - low) / 400, "aria-label": label }), box = make("input", { type: "number", step: "any", "aria-label": `${label}, value` });
  const set = (v, from) => {
    if (!Number.isFinite(v)) return;
    if (from !== slider) slider.value = v;
    if (from !== box) box.value = Number(v.toPrecision(6));
    if (from) { change(v); send(); }
  };
  slider.addEventListener("input", () => set(Number(Number(slider.value).toPrecision(6)), slider));
  box.addEventListener("input", () => box.value !== "" && set(whole ? Math.round(Number(box.value)) : Number(box.value), box));
  set(value);
  if (pointer) live.sliders.set(pointer, set);
  return [make("label", { class: "knob" }, make("span", {}, label), slider, box)];
}
const FIRST_KNOBS = 10;
function heard(scene) {
  if (scene.epoch === live.epoch) return;
  const open = el("more-knobs") && el("more-knobs").open;
  [live.scene, live.epoch, live.edits] = [scene, scene.epoch, {}];
  live.sliders.clear();
  if (!scene.supports.includes(live.support)) live.support = scene.supports[scene.supports.length - 1] || "";
  const rows = scene.knobs.map((k) => knob(k, (v) => { live.edits[k.pointer] = v; })[0]);
  const more = rows.splice(FIRST_KNOBS), list = [make("h2", {}, "Parameters of the scene"), ...rows];
  if (!scene.knobs.length) list.push(make("p", { class: "note" }, "Numbers of templates, joints, loads and materials appear here as sliders. This scene has none."));
  if (more.length) list.push(make("details", { id: "more-knobs", open: Boolean(open) }, make("summary", {}, `${more.length} more`), more));
  if (scene.loads.length) list.push(make("p", { class: "note" }, "Load arrows can be dragged along the top of the blocks."));
  list.push(make("p", { class: "saving" }, make("button", { type: "button", onclick: save }, "Save this scene as a new file"), " ", make("button", { type: "button", onclick: undo }, "Reset to the file"), make("span", { id: "saved", role: "status" })));
  el("knobs").replaceChildren(...list);
  tabs();
}
function undo() {
  const scene = live.scene;
  live.epoch = -1;
  heard(scene);
  send();
}
async function save() {
  try {
    const reply = await (await fetch("save", { method: "POST", headers: { "Content-Type": "application/json" }, body: "{}" })).json();
    el("saved").textContent = reply.file ? ` Saved: ${reply.file}` : ` Not saved: ${reply.error}`;
  } catch (error) {
    el("saved").textContent = ` Not saved: ${error.message}`;
  }
}

// Loads whose place is given are dragged along the upper side of the free blocks.
let held = null;
const local = (e) => { const b = shown.getBoundingClientRect(); return [e.clientX - b.left, e.clientY - b.top, b.width, b.height]; };
const placeOf = (load) => (live.edits[`${load.pointer}/at`] || load.at).map((v, k) => ((live.edits[`${load.pointer}/at/${k}`] ?? v) - view.middle[k]) / view.length);
function onScreen(p, width, height) {
  const m = lens(width, height).matrix, w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
  return [(0.5 + (0.5 * (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12])) / w) * width, (0.5 - (0.5 * (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13])) / w) * height];
}
function loadAt(e) {
  if (!state.layers.has("loads")) return null;
  const [x, y, w, h] = local(e);
  const near = live.scene.loads.map((load) => [Math.hypot(...[0, 1].map((k) => onScreen(placeOf(load), w, h)[k] - [x, y][k])), load]).sort((a, b) => a[0] - b[0])[0];
  return near && near[0] < 16 ? near[1] : null;
}
shown.addEventListener("pointerdown", (e) => {
  held = e.button === 0 ? loadAt(e) : null;
  if (!held) return;
  e.stopImmediatePropagation();
  shown.setPointerCapture(e.pointerId);
  play(false);
  if (state.motion !== -1) setWay(0);
}, true);
shown.addEventListener("pointermove", (e) => {
  if (!held) { shown.style.cursor = live.scene.loads.length && !e.buttons && loadAt(e) ? "move" : ""; return; }
  e.stopImmediatePropagation();
  const { from, way } = ray(...local(e)), at = placeOf(held), look = axes().z, z = [front, right, up].sort((a, b) => Math.abs(dot(b, look)) - Math.abs(dot(a, look)))[0], q = add(from, mul(way, dot(sub(at, from), z) / dot(way, z))), top = add(q, mul(up, 4));
  let best = Infinity, body = -1;
  for (let i = 0; i < COUNT; i++) if (!bodies.support[i]) { const t = hitBody(i, top, mul(up, -1)); if (t < best) [best, body] = [t, i]; }
  if (body < 0) return;
  // A hair inside: single precision must not put it off the block.
  const p = sub(top, mul(up, best + 2e-6));
  const metres = p.map((v, k) => Number((v * view.length + view.middle[k]).toPrecision(9)));
  live.edits[`${held.pointer}/at`] = metres;
  metres.forEach((v, k) => { delete live.edits[`${held.pointer}/at/${k}`]; live.sliders.get(`${held.pointer}/at/${k}`)?.(v); });
  live.edits[`${held.pointer}/block`] = bodies.ids[body];
  send();
}, true);
for (const end of ["pointerup", "pointercancel"]) shown.addEventListener(end, (e) => { if (held) { e.stopImmediatePropagation(); held = null; } }, true);

tabs();
const events = new EventSource("events");
const hear = (kind, act) => events.addEventListener(kind, (e) => act(JSON.parse(e.data)));
hear("scene", heard);
hear("answer", (a) => { answered(a); live.seen = Math.max(live.seen, a.revision); if (live.busy && live.seen >= live.wanted) free(); });
hear("status", said);
events.addEventListener("error", () => { el("status").textContent = "The program does not respond: it has ended or is stopped."; old("Not updated: the program does not respond"); });
events.addEventListener("open", () => { if (live.revision) old(""); });
