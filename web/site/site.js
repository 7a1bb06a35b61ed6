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
let worker, clock, running = false, name = "scene.json", saved = null;

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
  el("ask").disabled = is;
  el("stop").hidden = !is;
}
function work(kind, request, then) {
  // One that is still at work is ended with what it does; else the module that it holds serves again.
  if (running) stop();
  busy(true);
  const since = performance.now();
  clearInterval(clock);
  clock = setInterval(() => say(`${kind === "check" ? "Verifying" : "Solving"} … ${((performance.now() - since) / 1000).toFixed(0)} s`), 500);
  const over = () => { clearInterval(clock); busy(false); };
  say(kind === "check" ? "Verifying …" : "Solving …");
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
function ask() {
  const question = { [el("question").value]: QUESTIONS[el("question").value][1] };
  words();
  el("save").hidden = true;
  work("ask", { name, scene: el("scene").value, question }, (reply, seconds) => {
    if (reply.error) { el("desk").querySelector("details").open = true; return say(reply.error, "bad"); }
    saved = reply.result;
    el("save").hidden = false;
    say(`Answered in ${seconds.toFixed(seconds < 10 ? 2 : 0)} s in this browser.`);
    show(reply.html);
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
  let value;
  try { value = JSON.parse(text); } catch { /* The module says where the mistake is. */ }
  if (String(value?.format).startsWith("voussoir-result/")) {
    el("scene").value = JSON.stringify(value.scene?.input ?? value.scene, null, 1);
    return verify(text);
  }
  el("scene").value = text;
  ask();
}
async function open(file) {
  if (file) opened(await file.text(), file.name);
}

// A link holds scene and question, packed, behind the #: it is sent to no server.
async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
async function share() {
  const text = JSON.stringify({ name, question: el("question").value, scene: el("scene").value });
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
    if (held.question in QUESTIONS) el("question").value = held.question;
    opened(String(held.scene), String(held.name));
    return true;
  } catch { say("This link holds no scene: it was cut short or changed.", "bad"); return true; }
}
function example() {
  const own = EXAMPLES[el("example").value];
  const scene = { format: "voussoir-scene/1", name: el("example").value, joints: { default: { friction: 0.7 } }, ...own };
  opened(JSON.stringify(scene, null, 1), "example.json");
}

for (const [word, [text]] of Object.entries(QUESTIONS)) el("question").add(new Option(text, word));
for (const title of Object.keys(EXAMPLES)) el("example").add(new Option(title, title));
el("desk").addEventListener("submit", (event) => { event.preventDefault(); ask(); });
el("question").addEventListener("change", ask);
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
if (!(await shared())) example();
