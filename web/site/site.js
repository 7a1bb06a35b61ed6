// The page: what is open, what is asked of it, the answer in a frame. The work is done in a worker.
const el = (id) => document.getElementById(id);
const QUESTIONS = {
  assess: ["Does it stand?", {}],
  limit: ["How much live load does it carry?", {}],
  tilt: ["At what tilt does it fall?", { all: 4 }],
  thrust: ["What is the thrust on a support?", { range: true }],
};
const EXAMPLES = {
  "Arch of 27 voussoirs": { templates: [{ arch: { radius: 5, thickness: 0.8, depth: 1, voussoirs: 27 } }], loads: { live: [{ block: "v07", force: [0, 0, -1000] }] } },
  "Wall on a tilting table": { templates: [{ wall: { size: [1, 0.5, 0.4], courses: 6, blocks: 5 } }] },
  "Overhanging stack": { templates: [{ stack: { blocks: 4, size: [1, 1, 0.2], shift: 0.3 } }] },
};
const PREFIX = "#s=";
const VERB = { ask: "Solving", check: "Verifying", import: "Reading" };
let worker, clock, running = false, name = "scene.json", saved = null, foreign = null;

function say(text, kind = "") {
  el("status").textContent = text;
  el("status").className = kind;
}
function show(html) {
  const frame = el("answer"), fresh = frame.cloneNode();
  fresh.addEventListener("load", () => fresh.contentWindow.postMessage(html, "*"), { once: true });
  frame.replaceWith(fresh);
}
function stop() {
  worker?.terminate();
  worker = undefined;
}
function busy(is) {
  running = is;
  el("stop").hidden = !is;
}
function asked() {
  return document.querySelector("input[name=question]:checked").value;
}
function choose(question) {
  if (question in QUESTIONS) document.querySelector(`input[name=question][value=${question}]`).checked = true;
}
function work(kind, request, then) {
  // One that is still at work is ended with what it does; else the module that it holds serves again.
  if (running) stop();
  busy(true);
  const since = performance.now();
  clearInterval(clock);
  clock = setInterval(() => say(`${VERB[kind]} … ${((performance.now() - since) / 1000).toFixed(0)} s`), 500);
  const over = () => { clearInterval(clock); busy(false); };
  say(`${VERB[kind]} …`);
  worker ??= new Worker("worker.js");
  worker.onmessage = ({ data }) => { over(); then(data, (performance.now() - since) / 1000); };
  worker.onerror = (event) => { over(); say(event.message || "the worker could not be started", "bad"); };
  el("stop").onclick = () => { stop(); over(); say("Stopped: there is no answer."); };
  worker.postMessage({ kind, request });
}
function words(text) {
  el("words").textContent = text ?? "";
  el("words").hidden = !text;
}
function ask(keep = false) {
  const question = { [asked()]: QUESTIONS[asked()][1] };
  if (!keep) words();
  el("save").hidden = true;
  work("ask", { name, scene: el("scene").value, question }, (reply, seconds) => {
    if (reply.error) {
      show("");
      say(reply.error, "bad");
      if (waiting) soon();
      return;
    }
    saved = reply.result;
    el("save").hidden = false;
    say(`Answered in ${seconds.toFixed(seconds < 10 ? 2 : 0)} s in this browser.`);
    show(reply.html);
    if (waiting) soon();
  });
}
function verify(text) {
  el("save").hidden = true;
  show("");
  work("check", text, (reply) => {
    if (reply.error) return say(reply.error, "bad");
    say(reply.line, { proved: "good", refuted: "bad", error: "bad" }[reply.outcome]);
    words([reply.answer, reply.text].filter(Boolean).join("\n\n"));
  });
}
function opened(text, from) {
  name = from;
  foreign = null;
  el("reading").hidden = true;
  let value;
  try { value = JSON.parse(text); } catch { /* The module says where the mistake is. */ }
  const result = String(value?.format).startsWith("voussoir-result/");
  if (result) value = value.scene?.input ?? value.scene;
  el("scene").value = result ? JSON.stringify(value, null, 1) : text;
  sliders(value);
  if (result) return verify(text);
  ask();
}
async function open(file) {
  if (!file) return;
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (/\.json$/i.test(file.name)) {
    const text = new TextDecoder().decode(bytes);
    // Of COMPAS there are JSON files, too.
    let format = "voussoir";
    try { format = String(JSON.parse(text)?.format); } catch { /* As above. */ }
    if (format.startsWith("voussoir")) return opened(text, file.name);
  }
  foreign = { name: file.name, data: btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join("")) };
  read();
}

// A file of another program becomes a scene; what is said of it stands above the answer.
function read() {
  el("reading").hidden = false;
  const number = (id) => el(id).value === "" ? undefined : Number(el(id).value);
  const rules = el("layers").value.trim().split(/\s+/).filter((r) => r.includes("="));
  const layers = Object.fromEntries(rules.map((r) => [r.slice(0, r.indexOf("=")), r.slice(r.indexOf("=") + 1)]));
  const request = { ...foreign, friction: number("friction"), depth: number("depth"), scale: number("scale"), gap: number("gap"), support_below: number("below"), layers };
  el("save").hidden = true;
  words();
  work("import", request, (reply) => {
    if (reply.error) { show(""); return say(reply.error, "bad"); }
    const { scene } = reply;
    name = foreign.name.replace(/(\.[^.]*)?$/, ".json");
    el("scene").value = JSON.stringify(scene, null, 1);
    sliders(scene);
    words(reply.said.join("\n"));
    // Blocks that nothing holds are no question yet.
    if (scene.blocks?.some((b) => b.support)) return ask(true);
    show("");
    say("No block is held: give layers or a height below which blocks are.", "bad");
  });
}

// A slider for each number of the first template, and for the friction.
function sliders(scene) {
  const found = [];
  const look = (value, path) => {
    if (typeof value === "number" && value > 0) found.push([path, value]);
    else if (value && typeof value === "object") for (const [key, inner] of Object.entries(value)) look(inner, [...path, key]);
  };
  if (scene?.templates?.[0]) look(scene.templates[0], ["templates", 0]);
  if (typeof scene?.joints?.default?.friction === "number") found.push([["joints", "default", "friction"], scene.joints.default.friction]);
  el("sliders").hidden = !found.length;
  el("sliders").replaceChildren(el("sliders").firstElementChild, ...found.slice(0, 12).map(([path, value]) => {
    const label = document.createElement("label"), input = document.createElement("input"), output = document.createElement("output");
    const whole = Number.isInteger(value) && path.at(-1) !== "friction" && value > 2;
    const step = whole ? 1 : Number((value / 50).toPrecision(1));
    Object.assign(input, { type: "range", min: whole ? Math.ceil(value / 3) : step, max: whole ? value * 3 : step * Math.ceil(2 * value / step), step, value });
    output.value = value;
    input.addEventListener("input", () => {
      output.value = Number(input.value);
      let own;
      try { own = JSON.parse(el("scene").value); } catch { return; }
      const last = path.slice(0, -1).reduce((inner, key) => inner?.[key], own);
      if (!last) return;
      last[path.at(-1)] = Number(input.value);
      el("scene").value = JSON.stringify(own, null, 1);
      soon();
    });
    label.append(path.slice(2).filter((key) => key !== "default").join(" ").replaceAll("_", " ") + " ", output, input);
    return label;
  }));
}
// What moves is asked as fast as answers come, the last one in any case.
let waiting = false;
function soon() {
  if (running) { waiting = true; return; }
  waiting = false;
  ask(true);
}

// A link holds scene and question, packed, behind the #: it is sent to no server.
async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
async function share() {
  const text = JSON.stringify({ name, question: asked(), scene: el("scene").value });
  const packed = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  const letters = Array.from(packed, (b) => String.fromCharCode(b)).join("");
  history.replaceState(null, "", PREFIX + btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, ""));
  try {
    await navigator.clipboard.writeText(location.href);
    say("The link is copied: it holds the scene and the question.");
  } catch { say("The link is in the address bar: it holds the scene and the question."); }
}
async function shared() {
  if (!location.hash.startsWith(PREFIX)) return false;
  try {
    const letters = atob(location.hash.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = await through(Uint8Array.from(letters, (c) => c.charCodeAt(0)), new DecompressionStream("deflate-raw"));
    const held = JSON.parse(new TextDecoder().decode(bytes));
    choose(held.question);
    opened(String(held.scene), String(held.name));
    return true;
  } catch { say("This link holds no scene: it was cut short or changed.", "bad"); return true; }
}
function example() {
  const own = EXAMPLES[el("example").value];
  const scene = { format: "voussoir-scene/1", name: el("example").value, joints: { default: { friction: 0.7 } }, ...own };
  opened(JSON.stringify(scene, null, 1), "example.json");
}

for (const [word, [text]] of Object.entries(QUESTIONS)) {
  const label = document.createElement("label"), input = document.createElement("input");
  Object.assign(input, { type: "radio", name: "question", value: word, checked: word === "assess" });
  input.addEventListener("change", () => ask());
  label.append(input, text);
  el("questions").append(label);
}
for (const title of Object.keys(EXAMPLES)) el("example").add(new Option(title, title));
el("desk").addEventListener("submit", (event) => { event.preventDefault(); ask(); });
for (const input of el("reading").querySelectorAll("input")) input.addEventListener("change", () => foreign && read());
el("example").addEventListener("change", example);
el("file").addEventListener("change", (event) => open(event.target.files[0]));
el("share").addEventListener("click", share);
el("save").addEventListener("click", () => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([JSON.stringify(saved)], { type: "application/json" }));
  link.download = name.replace(/(\.[^.]*)?$/, ".result.json");
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
});
addEventListener("dragover", (event) => { event.preventDefault(); el("desk").classList.add("over"); });
addEventListener("dragleave", () => el("desk").classList.remove("over"));
addEventListener("drop", (event) => { event.preventDefault(); el("desk").classList.remove("over"); open(event.dataTransfer.files[0]); });
addEventListener("hashchange", shared);
// Once it was here, the site is here without a network.
navigator.serviceWorker?.register("offline.js").catch(() => {});
if (!(await shared())) example();
