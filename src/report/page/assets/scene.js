// The picture and its controls put together.
const canvas = el("canvas"), flatCanvas = el("flat");
let draw = null, shown = canvas;
try { draw = webgl(canvas); } catch (error) { console.warn("WebGL is not used:", error.message); }
if (!draw) {
  canvas.hidden = true;
  flatCanvas.hidden = false;
  for (const key of ["tabindex", "role", "aria-roledescription", "aria-describedby"]) flatCanvas.setAttribute(key, canvas.getAttribute(key));
  shown = flatCanvas;
  draw = plain(flatCanvas) || (() => {});
}

let waiting = false, stale = true;
function redraw(changed) {
  stale = stale || Boolean(changed);
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    const scale = Math.min(window.devicePixelRatio || 1, 2), w = Math.max(1, Math.round(shown.clientWidth * scale)), h = Math.max(1, Math.round(shown.clientHeight * scale));
    if (shown.width !== w || shown.height !== h) [shown.width, shown.height] = [w, h];
    if (stale) pose();
    draw(w, h, stale);
    if (stale) legend();
    stale = false;
    document.documentElement.dataset.drawn = "yes";
  });
}

function pick(picked) {
  state.picked = picked;
  numbers();
  const kind = picked && picked.joint !== undefined ? "joints" : picked && picked.member !== undefined ? "members" : "blocks", index = picked ? picked[{ blocks: "body", joints: "joint", members: "member" }[kind]] : -1;
  if (picked) {
    if (el("kind").value !== kind) { el("kind").value = kind; el("find").value = ""; fillList(); }
    if (![...el("list").options].some((o) => Number(o.value) === index) && el("find").value) { el("find").value = ""; fillList(); }
  }
  const list = el("list");
  list.value = String(index);
  if (picked && list.options.length) list.scrollTop = (list.selectedIndex / list.options.length) * list.scrollHeight - list.clientHeight / 2;
  redraw(true);
}

// The list of blocks or joints, as far as it is asked for.
const MOST = 4000;
function fillList() {
  const kind = el("kind").value, wanted = el("find").value.toLowerCase(), count = { blocks: COUNT, joints: JOINTS, members: members.ids.length }[kind], options = [];
  let left = 0;
  for (let k = 0; k < count; k++) {
    const name = kind === "blocks" ? bodies.ids[k] : kind === "members" ? `${members.ids[k]} (${members.kinds[k]})` : nameOf(k);
    if (wanted && !name.toLowerCase().includes(wanted)) continue;
    if (options.length < MOST) options.push(make("option", { value: k }, kind === "blocks" && bodies.support[k] ? `${name} (support)` : name));
    else left++;
  }
  el("list").replaceChildren(...options);
  el("list").setAttribute("aria-label", { blocks: "Blocks", joints: "Joints", members: "Members" }[kind]);
  el("find").placeholder = `Find a ${kind.slice(0, -1)}`;
  el("listNote").textContent = left ? `${left} more: type part of the name` : "";
}
el("kind").addEventListener("change", () => { el("find").value = ""; fillList(); });
el("find").addEventListener("input", fillList);
el("list").addEventListener("change", () => pick({ [{ blocks: "body", joints: "joint", members: "member" }[el("kind").value]]: Number(el("list").value) }));

function next(kind, step) {
  const key = kind === "blocks" ? "body" : "joint", count = kind === "blocks" ? COUNT : JOINTS, now = state.picked && state.picked[key];
  if (count) pick({ [key]: now === undefined || now === null ? (step > 0 ? 0 : count - 1) : (now + step + count) % count });
}

// Choices of forces, motions, colours, layers.
const options = (list) => list.map(([value, text]) => make("option", { value }, text));
function motionNow(value) {
  state.motion = value;
  const film = value === FILM, motion = view.motions[value];
  el("play").hidden = !film && !motion;
  el("wayLabel").textContent = film ? view.film.quantity : "Motion";
  el("magnifyBox").hidden = !film || view.film.words.length > 0;
  setWay(state.way);
}
// Between the frames of a film: where it is, and when it is there.
function timeAt(way) {
  const { times } = view.film, last = times.length - 1, t = way * last, k = Math.min(Math.floor(t), last - 1);
  return times[k] + (t - k) * (times[k + 1] - times[k]);
}
function filmTo(time) {
  const { times } = view.film, last = times.length - 1;
  let k = 0;
  while (k < last - 1 && times[k + 1] < time) k++;
  const step = times[k + 1] - times[k];
  play(false);
  if (state.motion !== FILM) { el("motion").value = FILM; motionNow(FILM); }
  setWay(Math.min(Math.max((k + (step > 0 ? (time - times[k]) / step : 0)) / last, 0), 1));
}
function setWay(way) {
  state.way = way;
  el("way").value = Math.round(1000 * way);
  const film = state.motion === FILM;
  const frame = film ? Math.round(way * (view.film.times.length - 1)) : 0;
  loads = film && view.film.loads.length ? view.film.loads[frame] : view.loads;
  const label = film && view.film.labels[frame] ? `, ${view.film.labels[frame]}` : "";
  const text = state.motion === -1 ? "" : film && view.film.words.length ? view.film.words[Math.round(way * (view.film.words.length - 1))] : film ? `${short(view.film.times[frame], 3)} ${view.film.unit}`.trim() + label : !way ? "at rest" : displacement() ? `${meters(displacement())} at the farthest corner × ${short((way * amplitude(view.motions[state.motion])) / displacement(), 2)}` : `${meters(way * amplitude(view.motions[state.motion]))} at the fastest corner`;
  el("wayText").textContent = text;
  el("way").setAttribute("aria-valuetext", text);
  if (film && state.picked) numbers();
  if (film) cursors.forEach((move) => move(timeAt(way)));
  redraw(true);
}
let playing = 0;
function play(on) {
  playing = on ? performance.now() : 0;
  el("run").textContent = on ? "❚❚" : "▶";
  el("run").setAttribute("aria-label", on ? "Stop" : "Play");
  if (!on) return;
  const film = state.motion === FILM, seconds = film ? Math.min(Math.max(view.film.times[view.film.times.length - 1], 4), 12) : 3.2;
  const begin = performance.now() - (film ? (state.way < 1 ? state.way : 0) * seconds * 1000 : (Math.acos(1 - 2 * state.way) / Math.PI) * seconds * 1000), mine = playing;
  const step = (now) => {
    if (playing !== mine) return;
    const t = Math.max(0, now - begin) / 1000 / seconds;
    setWay(film ? t % 1.15 > 1 ? 1 : t % 1.15 : 0.5 - 0.5 * Math.cos(Math.PI * t));
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
el("run").addEventListener("click", () => play(!playing));
el("way").addEventListener("input", () => { play(false); setWay(el("way").value / 1000); });

function choices() {
  el("state").replaceChildren(...options(view.states.map((s, k) => [k, s.name])));
  el("stateBox").hidden = !view.states.length;
  const motions = view.motions.map((m, k) => [k, m.name]);
  if (view.film) motions.unshift([FILM, view.film.name]);
  el("motion").replaceChildren(...options(motions));
  el("motionBox").hidden = !motions.length;
  el("kind").replaceChildren(...options([["blocks", "Blocks"], ["joints", "Joints"], members.ids.length && ["members", "Members"]].filter(Boolean)));
  const kinds = [["stone", "stone"], bodies.materials.length > 1 && ["material", "material"], view.states.length && ["share", "utilisation of joints"], view.states.length && ["force", "greatest force"], view.motions.length && ["speed", displacement() ? "displacement" : "speed in the mechanism"], view.film && view.film.way && ["moved", view.film.way], view.values && ["value", view.values.name.toLowerCase()]].filter(Boolean);
  el("colour").replaceChildren(...options(kinds));
  if (view.film) {
    // The greatest round number that keeps the motion within a tenth of the picture.
    const far = Math.max(view.film.far, view.film.wide * 0.05), all = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 10000, 100000];
    el("magnify").replaceChildren(...options(all.map((m) => [m, `${m} ×`])));
    state.magnify = all.filter((m) => m * far < 0.12).pop() || 1;
    if (far < 1e-9) state.magnify = 1;
    el("magnify").value = state.magnify;
  }
  el("layers").replaceChildren(el("layers").firstElementChild);
  for (const [name, title, , there] of LAYERS) if (there()) el("layers").append(make("label", {}, make("input", { type: "checkbox", value: name, id: `layer-${name}`, onchange: (e) => { e.target.checked ? state.layers.add(name) : state.layers.delete(name); redraw(true); } }), title));
}
el("supports").addEventListener("change", () => { state.supports = el("supports").value; redraw(true); });
function supports(how) {
  el("supportsBox").hidden = !bodies.support.some((s) => s);
  [state.supports, el("supports").value] = [how, how];
}
const layer = (name) => { const box = el(`layer-${name}`); if (box) { box.checked = true; state.layers.add(name); } };
const colour = (name) => { if ([...el("colour").options].some((o) => o.value === name)) { el("colour").value = name; state.colour = name; } };
el("state").addEventListener("change", () => { state.force = Number(el("state").value); numbers(); redraw(true); });
el("motion").addEventListener("change", () => { play(false); state.way = Math.max(state.way, 0.5); motionNow(Number(el("motion").value)); numbers(); });
el("colour").addEventListener("change", () => { state.colour = el("colour").value; redraw(true); });
el("magnify").addEventListener("change", () => { state.magnify = Number(el("magnify").value); redraw(true); });
document.querySelectorAll("[data-look]").forEach((b) => b.addEventListener("click", () => look(b.dataset.look)));

steer(shown, (e) => {
  const box = shown.getBoundingClientRect(), at = [e.clientX - box.left, e.clientY - box.top, box.width, box.height], over = overlay(...at);
  // Arrows lie over blocks that they do not load: a block under the pointer is what is meant.
  const block = hit(...at);
  pick(over && over[1] && !(over[2] && block) ? over[1] : block);
});
// What lies under the pointer says its name.
let asked = null;
const unnamed = () => { asked = null; el("hint").hidden = true; };
shown.addEventListener("pointermove", (e) => {
  if (e.buttons || e.pointerType === "touch") return unnamed();
  const idle = !asked;
  asked = e;
  if (idle) requestAnimationFrame(() => {
    if (!asked) return;
    const box = shown.getBoundingClientRect(), [x, y] = [asked.clientX - box.left, asked.clientY - box.top], over = overlay(x, y, box.width, box.height), found = over ? null : hit(x, y, box.width, box.height);
    asked = null;
    const words = over ? over[0] : !found ? "" : found.joint !== undefined ? `joint ${nameOf(found.joint)}` : `${bodies.ids[found.body]}${bodies.support[found.body] ? " (support)" : ""}`;
    el("hint").hidden = !words;
    el("hint").textContent = words;
    const left = Math.max(4, Math.min(x + 14, box.width - el("hint").offsetWidth - 6));
    el("hint").style.transform = `translate(${left}px,${y > 40 ? y - 34 : y + 18}px)`;
  });
});
shown.addEventListener("pointerleave", unnamed);
el("lens").addEventListener("click", () => lensTo(isParallel() ? "perspective" : "parallel"));
shown.addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
  const acts = { "+": () => zoomBy(0.88), "=": () => zoomBy(0.88), "-": () => zoomBy(1.14), Home: () => look("start"), f: () => look("front"), s: () => look("side"), t: () => look("top"), o: () => lensTo(isParallel() ? "perspective" : "parallel"), n: () => next("blocks", 1), p: () => next("blocks", -1), j: () => next("joints", 1), J: () => next("joints", -1), Escape: () => pick(null), " ": () => el("play").hidden || play(!playing) };
  const act = turns ? () => (e.shiftKey ? shiftBy(-0.05 * turns[0], 0.05 * turns[1]) : turnBy(-0.09 * turns[0], 0.09 * turns[1])) : acts[e.key];
  if (act) { e.preventDefault(); act(); }
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => redraw(true));
let before = [shown.clientWidth, shown.clientHeight].join();
new ResizeObserver(() => {
  const now = [shown.clientWidth, shown.clientHeight].join();
  if (now === before) return;
  before = now;
  if (eye.preset) look(eye.preset);
  else redraw();
}).observe(shown);
canvas.addEventListener("webglcontextlost", (e) => e.preventDefault());
// Printers get an image: a canvas may come out empty.
addEventListener("beforeprint", () => { el("printed").src = shown.toDataURL("image/png"); el("printed").alt = shown.getAttribute("aria-label"); });

// Of more arrows than these nothing is seen but arrows.
const FEW = 400;
// Of more lines than these nothing is seen but lines.
const CROWD = 4000;
// At a limit nearly every joint is used up: then the forces say more.
function telling() {
  const used = forcesNow() ? [...forcesNow().bodyUsed].filter((u) => !Number.isNaN(u)) : [];
  return used.filter((u) => u > 0.97).length > 0.4 * used.length ? "force" : "share";
}

// What is shown at first: how it fails where it falls, else how it carries.
function begin() {
  shown.setAttribute("aria-label", `${view.name || "The scene"}: ${COUNT} blocks, ${JOINTS} joints`);
  state.layers.clear();
  Object.assign(state, { motion: -1, way: 0, force: 0, colour: "stone" });
  choices();
  supports(view.supports);
  for (const name of ["members", "slope"]) layer(name);
  if (loads.body.length <= FEW) layer("loads");
  const falls = Boolean(document.querySelector("h1.bad"));
  layer("edges");
  layer("pressures");
  // Where joints yield, how far: displaced by half of what the slider has.
  if (displacement()) state.way = 0.5;
  if (view.film) { state.way = view.film.opens; colour("moved"); if (view.values) colour("value"); motionNow(FILM); } else if (view.values) { colour("value"); motionNow(-1); } else if (falls && view.motions.length) { state.way = 0.8; colour("speed"); layer("marks"); motionNow(0); } else { if (!view.slope && (!forcesNow() || forcesNow().lineBody.length <= CROWD)) layer("line"); if (!view.pressures) colour(telling()); layer("marks"); motionNow(view.motions.length ? 0 : -1); }
  el("motion").value = state.motion;
  fillList();
  numbers();
}
begin();
look("start");
