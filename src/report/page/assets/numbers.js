// Picking with a ray, and the numbers of what is picked.
function ray(x, y, width, height) {
  const l = lens(width, height), u = (2 * x) / width - 1, v = 1 - (2 * y) / height;
  if (l.flat) return { from: add(add(add(l.at, mul(l.z, 4)), mul(l.x, u * SLOPE * l.aspect * eye.distance)), mul(l.y, v * SLOPE * eye.distance)), way: mul(l.z, -1) };
  return { from: l.at, way: unit(add(add(mul(l.x, u * SLOPE * l.aspect), mul(l.y, v * SLOPE)), mul(l.z, -1))) };
}

// How far along a ray a convex loop is hit.
function hitLoop(from, way, loop) {
  let normal = [0, 0, 0];
  for (let m = 1; m + 1 < loop.length; m++) normal = add(normal, cross(sub(loop[m], loop[0]), sub(loop[m + 1], loop[0])));
  const slope = dot(normal, way);
  if (!slope) return Infinity;
  const t = dot(normal, sub(loop[0], from)) / slope, p = add(from, mul(way, t));
  if (t <= 0) return Infinity;
  for (let m = 0; m < loop.length; m++) if (dot(normal, cross(sub(loop[(m + 1) % loop.length], loop[m]), sub(p, loop[m]))) < 0) return Infinity;
  return t;
}

function hitBody(i, from, way) {
  const c = moved(i, at3(bodies.center, i)), to = sub(c, from), along = dot(to, way), miss = dot(to, to) - along * along, r = reach[i] * 1.0001;
  if (miss > r * r) return Infinity;
  if (bodies.radius[i] > 0) return along - Math.sqrt(r * r - miss);
  const q = poses.subarray(8 * i, 8 * i + 4), own = at3(bodies.center, i), f = add(back(q, sub(from, c)), own), w = back(q, way);
  let best = Infinity;
  for (let k = bodies.pieceStart[i]; k < bodies.pieceStart[i + 1]; k += bodies.pieces[k] + 1) best = Math.min(best, hitLoop(f, w, Array.from(bodies.pieces.subarray(k + 1, k + 1 + bodies.pieces[k]), (n) => at3(bodies.corners, bodies.cornerStart[i] + n))));
  return best;
}

// The nearest block; where joints are shown, a joint whose polygon or point lies under the pointer.
function hit(x, y, width, height) {
  const { from, way } = ray(x, y, width, height);
  let best = Infinity, found = null;
  if (state.layers.has("joints")) for (let k = 0; k < JOINTS; k++) {
    const points = [];
    for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) points.push(moved(joints.a[k], at3(joints.points, p)));
    let t = points.length > 2 ? hitLoop(from, way, points) : Infinity;
    const to = sub(moved(joints.a[k], at3(joints.center, k)), from), along = dot(to, way);
    if (t === Infinity && along > 0 && Math.sqrt(Math.max(0, dot(to, to) - along * along)) < 0.012 * along * SLOPE) t = along;
    if (t < best) [best, found] = [t, { joint: k }];
  }
  if (found) return found;
  for (let i = 0; i < COUNT; i++) { if (opacity(i) < 1) continue; const t = hitBody(i, from, way); if (t < best) [best, found] = [t, { body: i }]; }
  return found;
}

// Whether nothing stands between a point and the eye.
function isSeen(p) {
  const l = axes(), flat = isParallel(), way = flat ? l.z : unit(sub(add(eye.target, mul(l.z, eye.distance)), p));
  for (let i = 0; i < COUNT; i++) if (opacity(i) === 1 && hitBody(i, p, way) < Infinity) return false;
  return true;
}
// Of more than this, everything that is marked is drawn: to ask for each what hides it would take longer than a frame.
const LOOKED = 6e4;
// Where a mark on a joint is drawn: at it, or at a corner of the joint that one sees; null where all of it is hidden.
function markAt(k, at, many) {
  const body = joints.a[k], own = moved(body, at), middle = at3(joints.center, k), list = [at];
  if (many * COUNT > LOOKED) return own;
  for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) list.push(at3(joints.points, p));
  // A hair off the joint, or its own blocks hide it.
  const off = (p) => { const d = sub(p, middle); return add(p, mul(d, 0.03 + 1e-4 / Math.max(norm(d), 1e-4))); };
  return list.some((p) => isSeen(moved(body, off(p)))) ? own : null;
}

// What is drawn over the blocks and lies under the pointer: [words, what a click picks, whether a block goes before].
function overlay(x, y, width, height) {
  const m = lens(width, height).matrix;
  const far = (p) => { const w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15]; return w > 1e-6 ? [(0.5 + (0.5 * (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12])) / w) * width, (0.5 - (0.5 * (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13])) / w) * height] : [-1e9, -1e9]; };
  const beside = (a, b) => { const [p, q] = [far(a), far(b)], d = [q[0] - p[0], q[1] - p[1]], t = Math.min(1, Math.max(0, ((x - p[0]) * d[0] + (y - p[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1] || 1))); return Math.hypot(x - p[0] - t * d[0], y - p[1] - t * d[1]); };
  // Within what is drawn, or a block beside a hinge could not be picked.
  let best = 4.5, found = null;
  for (const [a, b, words, picked, weak] of named()) { const d = beside(a, b); if (d < best) [best, found] = [d, [words, picked, weak]]; }
  return found;
}

const place = (p) => `(${mul(p, view.length).map((v, k) => short(v + view.middle[k])).join(", ")}) m`;
const nameOf = (k) => `${bodies.ids[joints.a[k]]} | ${bodies.ids[joints.b[k]]}`;
const jump = (picked, text) => make("button", { type: "button", onclick: () => pick(picked) }, text);
const tableOf = (rows) => make("table", {}, make("tbody", {}, rows.filter((r) => r[1] !== null).map(([head, value]) => make("tr", {}, make("th", { scope: "row" }, head), make("td", {}, value)))));

function numbers() {
  const box = el("picked"), p = state.picked;
  if (!p) return box.replaceChildren(make("p", { class: "note" }, "Click a block, an arrow, a hinge or a member, or choose one from the list, to see its values. To click a joint, show the joints first."));
  box.replaceChildren(...(p.body !== undefined ? bodyNumbers(p.body) : p.member !== undefined ? memberNumbers(p.member) : jointNumbers(p.joint)));
}

function bodyNumbers(i) {
  const forces = forcesNow(), motion = view.motions[Math.max(0, state.motion)], mine = loads.body.length ? [...loads.body.keys()].filter((k) => loads.body[k] === i) : [];
  const rows = [
    ["", bodies.support[i] ? "support, held in place" : "free block"],
    ["material", bodies.material[i] ? bodies.materials[bodies.material[i] - 1] : null],
    ["mass", withUnit(bodies.mass[i], "kg").replace("kkg", "t").replace("Mkg", "kt").replace("Gkg", "Mt")],
    ["centre of mass", place(at3(bodies.center, i))],
    ["radius", bodies.radius[i] > 0 ? meters(bodies.radius[i]) : null],
    ["utilisation of joints", forces ? percent(forces.bodyUsed[i]) : null],
    ["displacement", motion && motion.real && !bodies.support[i] ? meters(motion.real * norm(at3(motion.velocity, i))) : null],
    ["speed", motion && !motion.real && !bodies.support[i] ? `${percent(speeds(motion)[i])} of the fastest corner` : null],
    ["moved", state.motion === FILM ? `${meters(norm([poses[8 * i + 4], poses[8 * i + 5], poses[8 * i + 6]]) / state.magnify)}, rotated ${short((360 / Math.PI) * Math.acos(Math.min(1, Math.abs(poses[8 * i + 3]))) / state.magnify, 3)}°` : null],
    ...mine.map((k) => [loads.live[k] ? "live load" : "dead load", `${withUnit(norm(at3(loads.newton, k)), "N")} at ${place(at3(loads.at, k))}`]),
    ["touches", make("div", { class: "links" }, jointsOf[i].map((k) => jump({ joint: k }, bodies.ids[joints.a[k] === i ? joints.b[k] : joints.a[k]])))],
  ];
  return [make("h2", {}, bodies.ids[i]), tableOf(rows)];
}

function memberNumbers(k) {
  const force = members.newton[k], strength = members.strength[k];
  const rows = [
    ["", members.kinds[k]],
    ["force", force === null ? null : members.slack[k] ? "slack" : withUnit(force, "N")],
    ["strength", strength === null ? "no limit" : withUnit(strength, "N")],
    ["utilisation", force === null || !strength ? null : percent(Math.abs(force) / strength)],
    ...Array.from({ length: members.start[k + 1] - members.start[k] }, (_, p) => { const n = members.start[k] + p, b = members.bodies[n]; return [p ? "to" : "at", make("span", {}, `${place(at3(members.points, n))} `, b < COUNT ? jump({ body: b }, bodies.ids[b]) : "on the ground")]; }),
  ];
  return [make("h2", {}, members.ids[k]), tableOf(rows)];
}

function jointNumbers(k) {
  const forces = forcesNow(), there = forces && !Number.isNaN(forces.normal[k]), from = joints.pointStart[k], to = joints.pointStart[k + 1];
  const motion = view.motions[Math.max(0, state.motion)], mark = motion ? [...motion.markJoint].indexOf(k) : -1;
  const pressed = [];
  if (view.pressures) view.pressures.joint.forEach((j, n) => { if (j === k) pressed.push(...view.pressures.share.subarray(view.pressures.start[n], view.pressures.start[n + 1])); });
  const rows = [
    ["", ["face on face", "edge", "point", "given in the scene"][joints.kind[k]]],
    ["area", joints.area[k] > 0 ? `${short(joints.area[k] * view.length ** 2)} m²` : null],
    ["law", joints.laws[joints.law[k]]],
    ["normal force", there ? newtons(forces.normal[k]) : forces ? "no force" : null],
    ["shear force", there ? newtons(forces.shear[k]) : null],
    ["friction used", there && !Number.isNaN(forces.mobilised[k]) ? percent(forces.mobilised[k]) : null],
    ["mean pressure", there && joints.area[k] > 0 ? withUnit((forces.normal[k] * view.force) / (joints.area[k] * view.length ** 2), "Pa") : null],
    ["greatest pressure", pressed.length ? withUnit(view.pressures.greatest * Math.max(...pressed), "Pa") : null],
    ["eccentricity", there && joints.area[k] > 0 ? `${meters(forces.eccentricity[k])}, ${percent(forces.used[k])} of the distance to the edge${forces.kern[k] ? ", in the kern" : ""}` : null],
    ["centre of pressure", there ? place(at3(forces.at, k)) : place(at3(joints.center, k))],
    ["mechanism", mark >= 0 ? motion.markKind[mark] : motion && !motion.real ? "at rest" : null],
    ["blocks", make("div", { class: "links" }, [joints.a[k], joints.b[k]].map((i) => jump({ body: i }, bodies.ids[i])))],
  ];
  const n = at3(joints.normal, k), points = [];
  if (there) for (let p = from; p < to; p++) { const f = at3(forces.forces, p), fn = dot(f, n); points.push(make("tr", {}, make("td", {}, place(at3(joints.points, p))), make("td", {}, newtons(fn)), make("td", {}, newtons(norm(sub(f, mul(n, fn))))))); }
  const list = points.length ? [make("div", { class: "scroll", tabindex: "0" }, make("table", { class: "grid" }, make("thead", {}, make("tr", {}, ["contact point", "normal", "shear"].map((h) => make("th", { scope: "col" }, h)))), make("tbody", {}, points)))] : [];
  return [make("h2", {}, nameOf(k)), tableOf(rows), ...list];
}
