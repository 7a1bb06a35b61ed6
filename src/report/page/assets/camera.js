// The eye: turned about a point, nearer or farther, with the pointer or the keys.
const SLOPE = Math.tan((13 * Math.PI) / 180);
let up, front, right;
function aim() { [up, front, right] = [view.up, view.front, cross(view.up, view.front)]; }
aim();
const RIGHTS = { start: [0.42, 0.26], front: [0, 0], side: [Math.PI / 2, 0], top: [0, Math.PI / 2 - 1e-4] };
// `preset` names where one looks from, until the camera is moved by hand.
const eye = { angle: 0, height: 0, distance: 1, target: [0, 0, 0], preset: null, lens: null };
// Plane scenes, elevations and plans are seen by parallel rays unless somebody says otherwise.
const isParallel = () => (eye.lens ? eye.lens === "parallel" : Boolean(view.plane) || ["front", "side", "top"].includes(eye.preset));

function axes() {
  const level = add(mul(front, Math.cos(eye.angle)), mul(right, Math.sin(eye.angle)));
  const z = add(mul(level, Math.cos(eye.height)), mul(up, Math.sin(eye.height)));
  const x = unit(cross(up, z).some((v) => Math.abs(v) > 1e-9) ? cross(up, z) : right);
  return { x, y: cross(z, x), z };
}

function lens(width, height) {
  const { x, y, z } = axes(), at = add(eye.target, mul(z, eye.distance));
  const near = Math.max(eye.distance - 3, 0.02 * eye.distance), camera = looking(x, y, z, at);
  const flat = isParallel(), seen = flat ? parallel(SLOPE, width / height, eye.distance, eye.distance - 4, eye.distance + 4) : perspective(SLOPE, width / height, near, eye.distance + 3);
  return { camera, x, y, z, at, flat, matrix: product(seen, camera), aspect: width / height };
}

// The corners to be seen, some thousand at most; of supports only what lies in the box of the scene.
function corners() {
  const list = [], half = mul(view.extent, 0.5), every = Math.max(1, Math.floor(COUNT / 2500));
  const inside = (p) => p.map((v, k) => Math.min(Math.max(v, -half[k]), half[k]));
  for (let i = 0; i < COUNT; i += every) {
    const c = at3(bodies.center, i), r = bodies.radius[i];
    const own = r > 0 ? [[r, 0, 0], [-r, 0, 0], [0, r, 0], [0, -r, 0], [0, 0, r], [0, 0, -r]].map((d) => add(c, d)) : Array.from({ length: bodies.cornerStart[i + 1] - bodies.cornerStart[i] }, (_, k) => at3(bodies.corners, bodies.cornerStart[i] + k));
    if (opacity(i)) list.push(...own.map(inside));
  }
  if (view.slope) for (const k of [0, 1]) list.push(at3(view.slope.line, k));
  // Arrows of loads that are shown stand above the scene.
  if (state.layers.has("loads")) loadArrows().forEach((f, k) => f && list.push(sub(at3(loads.at, k), f)));
  if (state.layers.has("members")) for (let k = 0; k < members.points.length / 3; k++) list.push(at3(members.points, k).map((v, n) => Math.min(Math.max(v, -half[n] - 0.4), half[n] + 0.4)));
  return list.length ? list : [[0, 0, 0]];
}

// Stands back until the scene fills the picture.
function look(name) {
  [eye.angle, eye.height] = RIGHTS[name];
  if (name === "start") [eye.angle, eye.height] = view.plane ? [0, 0] : flatScene() ? [0.3, 0.16] : RIGHTS.start;
  [eye.preset, eye.lens] = [name, null];
  const { x, y, z } = axes(), box = el("view"), tall = Math.max(1, box.clientHeight), aspect = Math.max(0.3, box.clientWidth / tall), list = corners(), flat = isParallel();
  // Between the buttons above and the legend below.
  legend();
  const above = 46, below = el("legend").offsetHeight + 20, room = Math.max(0.4, 1 - (above + below) / tall);
  eye.target = [0, 0, 0];
  for (let round = 0; round < 4; round++) {
    let distance = 0.05, low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const p of list) {
      const d = sub(p, eye.target), far = flat ? 0 : dot(d, z);
      distance = Math.max(distance, Math.abs(dot(d, x)) / (0.9 * SLOPE * aspect) + far, Math.abs(dot(d, y)) / (0.97 * room * SLOPE) + far);
    }
    for (const p of list) {
      const d = sub(p, eye.target), w = flat ? 1 : (distance - dot(d, z)) / distance, seen = [dot(d, x) / w, dot(d, y) / w];
      low = low.map((v, k) => Math.min(v, seen[k]));
      high = high.map((v, k) => Math.max(v, seen[k]));
    }
    eye.target = add(eye.target, add(mul(x, (low[0] + high[0]) / 2), mul(y, (low[1] + high[1]) / 2)));
    eye.distance = distance;
  }
  eye.target = add(eye.target, mul(y, -((below - above) / tall) * eye.distance * SLOPE));
  if (el("lens")) el("lens").setAttribute("aria-pressed", String(!flat));
  redraw();
}
function lensTo(kind) {
  eye.lens = kind;
  el("lens").setAttribute("aria-pressed", String(!isParallel()));
  redraw();
}
const flatScene = () => Math.abs(dot(front, view.extent)) < 0.3;

function turnBy(dx, dy) {
  eye.preset = null;
  eye.angle -= dx;
  el("lens").setAttribute("aria-pressed", String(!isParallel()));
  eye.height = Math.min(Math.max(eye.height + dy, -Math.PI / 2 + 1e-3), Math.PI / 2 - 1e-3);
  redraw();
}

function shiftBy(dx, dy) {
  eye.preset = null;
  const { x, y } = axes(), s = 2 * SLOPE * eye.distance;
  eye.target = add(eye.target, add(mul(x, -dx * s), mul(y, dy * s)));
  redraw();
}

function zoomBy(factor) {
  eye.preset = null;
  eye.distance = Math.min(Math.max(eye.distance * factor, 0.02), 60);
  redraw();
}

// Pointers: one turns, one with the right button or two together move, two apart zoom. `picked` hears of a click.
function steer(canvas, picked) {
  const down = new Map();
  let way = 0;
  canvas.addEventListener("pointerdown", (e) => { canvas.focus({ preventScroll: true }); canvas.setPointerCapture(e.pointerId); down.set(e.pointerId, [e.clientX, e.clientY]); way = 0; });
  canvas.addEventListener("pointermove", (e) => {
    const last = down.get(e.pointerId);
    if (!last) return;
    const [dx, dy] = [e.clientX - last[0], e.clientY - last[1]], h = canvas.clientHeight;
    way += Math.hypot(dx, dy);
    if (down.size === 2) {
      const other = [...down].find(([id]) => id !== e.pointerId)[1];
      const before = Math.hypot(last[0] - other[0], last[1] - other[1]), now = Math.hypot(e.clientX - other[0], e.clientY - other[1]);
      zoomBy(Math.max(before, 1) / Math.max(now, 1));
      shiftBy(dx / h / 2, dy / h / 2);
    } else if (e.buttons & 6 || e.shiftKey) shiftBy(dx / h, dy / h);
    else turnBy((3.2 * dx) / h, (3.2 * dy) / h);
    down.set(e.pointerId, [e.clientX, e.clientY]);
  });
  const up = (e) => { if (down.delete(e.pointerId) && way < 4 && e.type === "pointerup") picked(e); };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoomBy(Math.exp(Math.min(Math.max(e.deltaY, -120), 120) * 0.0016)); }, { passive: false });
}
