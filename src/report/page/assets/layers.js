// What is drawn over the blocks: lines, arrows and dots, and joints as polygons.
const LAYERS = [
  ["line", "Line of thrust", "--line", () => forcesNow() && forcesNow().lineBody.length],
  ["resultants", "Resultants", "--arrow", () => forcesNow()],
  ["contacts", "Contact forces", "--arrow", () => forcesNow()],
  ["loads", "Loads", null, () => [...loads.body.keys()].some(acts)],
  ["members", "Members", "--member", () => members.ids.length],
  ["marks", "Moving joints", "--mark", () => view.motions.length],
  ["slope", "Slope", null, () => view.slope],
  ["pressures", "Pressure", null, () => view.pressures],
  ["joints", "Joints", "--joint", () => JOINTS],
  ["edges", "Edges", null, () => bodies.edges.length],
];
const forcesNow = () => view.states[state.force];
const LONGEST = 0.16, THICK = 0.0036;

// Live loads are there where they count; a page that lives shows them always, for they can be dragged.
const acts = (k) => !loads.live[k] || !forcesNow() || forcesNow().live || Boolean(document.querySelector("main.live"));
// Loads as they are drawn: the greatest live and the greatest dead one are as long as each other.
function loadArrows() {
  const many = Math.max(1, Math.cbrt(JOINTS / 120)), most = [0, 1].map((live) => { let m = 1e-300; for (let k = 0; k < loads.body.length; k++) if (loads.live[k] === live) m = Math.max(m, norm(at3(loads.newton, k))); return m; });
  return Array.from(loads.body, (_, k) => acts(k) && mul(at3(loads.newton, k), (0.9 * LONGEST) / many / most[loads.live[k]]));
}

// Rods and arrows as [from, to, radius, colour], dots as [at, radius, colour].
function strokes() {
  const rods = [], arrows = [], dots = [], on = (name) => state.layers.has(name), forces = forcesNow();
  const many = Math.max(1, Math.cbrt(JOINTS / 120)), r = THICK / Math.max(1, JOINTS / 60) ** 0.3;
  if (forces && on("line")) {
    const ink = rgb("--line");
    let most = 1e-30;
    for (const f of forces.lineForce) most = Math.max(most, f);
    for (let k = 0; k < forces.lineBody.length; k++) {
      const i = forces.lineBody[k], thick = 0.25 + 1.1 * Math.sqrt(forces.lineForce[k] / most);
      const other = forces.lineOther[k], end = other < JOINTS ? at3(forces.at, other) : at3(bodies.center, i);
      rods.push([moved(i, at3(forces.at, forces.lineJoint[k])), moved(i, end), r * thick, ink]);
    }
  }
  const ink = rgb("--arrow");
  if (forces && on("resultants")) for (let k = 0; k < JOINTS; k++) {
    if (Number.isNaN(forces.normal[k])) continue;
    const at = moved(joints.a[k], at3(forces.at, k)), f = mul(at3(forces.force, k), LONGEST / many);
    rods.push([sub(at, mul(f, 0.5)), add(at, mul(f, 0.5)), r, ink]);
  }
  if (forces && on("contacts")) {
    for (let k = 0; k < JOINTS; k++) for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) {
      const f = mul(at3(forces.forces, p), (1.6 * LONGEST) / many);
      if (norm(f) > 2e-4) { const at = moved(joints.b[k], at3(joints.points, p)); arrows.push([at, add(at, f), 0.7 * r, ink]); }
    }
  }
  const thin = loads.body.length > 40 ? 0.55 : 1;
  if (on("loads")) loadArrows().forEach((f, k) => {
    if (!f) return;
    const at = moved(loads.body[k], at3(loads.at, k));
    if (norm(f) > 2e-4) arrows.push([sub(at, f), at, r * thin, rgb(loads.live[k] ? "--live" : "--ink")]);
  });
  if (state.picked && state.picked.body !== undefined) {
    const i = state.picked.body, corner = (k) => moved(i, at3(bodies.corners, bodies.cornerStart[i] + bodies.edges[k]));
    for (let k = bodies.edgeStart[i]; k < bodies.edgeStart[i + 1]; k += 2) rods.push([corner(k), corner(k + 1), 0.0016, rgb("--pick")]);
  }
  if (on("marks") && state.motion >= 0) {
    const motion = view.motions[state.motion];
    for (let k = 0; k < motion.markJoint.length; k++) { const p = markAt(motion.markJoint[k], at3(motion.markAt, k), motion.markJoint.length); if (p) dots.push([p, 2 * r, rgb("--mark")]); }
  }
  if (forces && on("line") && JOINTS < 400) {
    const edge = Array.from(forces.used.keys()).filter((k) => forces.used[k] >= 0.9999);
    for (const k of edge) { const p = markAt(k, at3(forces.at, k), edge.length); if (p) dots.push([p, 1.9 * r, rgb("--line")]); }
  }
  if (on("members")) memberLines().forEach(([k, a, b, push]) => {
    let most = 1e-300;
    for (const f of members.newton) most = Math.max(most, Math.abs(f || 0));
    const ink = rgb("--member"), thick = members.slack[k] || !members.newton[k] ? 0.35 : 0.5 + 0.9 * Math.sqrt(Math.abs(members.newton[k]) / most);
    if (state.picked && state.picked.member === k) rods.push([a, b, 1.6 * r * thick, rgb("--pick")]);
    if (push) arrows.push([a, b, r, ink]);
    else if (norm(sub(a, b)) > 1e-9) rods.push([a, b, r * thick, ink]);
    else dots.push([a, 1.8 * r, ink]);
  });
  if (view.slope && on("slope")) {
    const { surface, line } = view.slope;
    for (let k = 0; 3 * k + 3 < surface.length; k++) rods.push([at3(surface, k), at3(surface, k + 1), 0.7 * THICK, rgb("--ink")]);
    rods.push([at3(line, 0), at3(line, 1), 1.1 * THICK, rgb("--mark")]);
  }
  return { rods, arrows, dots };
}

// Pieces of members as [member, from, to, whether it pushes]: between the blocks where they go.
function memberLines() {
  const list = [];
  for (let k = 0; k < members.ids.length; k++) {
    const at = (n) => (members.bodies[n] < COUNT ? moved(members.bodies[n], at3(members.points, n)) : at3(members.points, n)), from = members.start[k], to = members.start[k + 1], way = at3(members.direction, k);
    for (let n = from; n + 1 < to; n++) list.push([k, at(n), at(n + 1), false]);
    if (to - from === 1) list.push([k, Number.isNaN(way[0]) ? at(from) : sub(at(from), mul(way, 0.09)), at(from), !Number.isNaN(way[0])]);
  }
  return list;
}

// What is drawn over the blocks, as [from, to, words, what a click picks, whether a block under the pointer goes before].
function named() {
  const list = [], on = (name) => state.layers.has(name), motion = view.motions[state.motion];
  if (on("members")) for (const [k, a, b] of memberLines()) list.push([a, b, `${members.kinds[k]} ${members.ids[k]}${members.slack[k] ? ", slack" : members.newton[k] === null ? "" : `: ${withUnit(members.newton[k], "N")}`}`, { member: k }]);
  if (on("loads")) loadArrows().forEach((f, k) => { if (f && norm(f) > 2e-4) { const at = moved(loads.body[k], at3(loads.at, k)); list.push([sub(at, f), at, `${loads.live[k] ? "live load (× λ)" : "dead load"} ${withUnit(norm(at3(loads.newton, k)), "N")} on ${bodies.ids[loads.body[k]]}`, { body: loads.body[k] }, true]); } });
  if (motion && on("marks")) for (let k = 0; k < motion.markJoint.length; k++) { const joint = motion.markJoint[k], p = markAt(joint, at3(motion.markAt, k), motion.markJoint.length); if (p) list.push([p, p, `${motion.markKind[k]}: ${nameOf(joint)}`, { joint }]); }
  if (view.slope && on("slope")) list.push([at3(view.slope.line, 0), at3(view.slope.line, 1), `straight line through the highest grains, ${short(view.slope.angle, 3)}°`, null]);
  return list;
}

// Polygons of joints: [points, the colour of each, opacity].
function polygons() {
  const list = [], one = (k, ink, alpha) => {
    const points = [];
    for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) points.push(moved(joints.a[k], at3(joints.points, p)));
    list.push([points, points.map(() => ink), alpha]);
  };
  if (view.pressures && state.layers.has("pressures")) {
    const { joint, start, points, share } = view.pressures, ink = scale();
    joint.forEach((k, n) => {
      const corners = Array.from({ length: start[n + 1] - start[n] }, (_, c) => start[n] + c);
      list.push([corners.map((c) => moved(joints.a[k], at3(points, c))), corners.map((c) => ink(share[c])), 0.9]);
    });
  }
  if (state.layers.has("joints")) { const ink = rgb("--joint"); for (let k = 0; k < JOINTS; k++) one(k, ink, 0.55); }
  if (state.picked && state.picked.joint !== undefined) one(state.picked.joint, rgb("--pick"), 0.95);
  return list;
}

// The greatest displacement of a corner as it is, where the motion is one; nothing of mechanisms.
const displacement = () => (view.motions[Math.max(state.motion, 0)] || {}).real;

// The colours of the moment in words.
function legend() {
  const scale = { value: view.values && [view.values.name, ...view.values.ends], share: ["Utilisation of joints", "0", "100 %"], force: ["Greatest force on a joint", "0", newtons(1)], speed: displacement() ? ["Displacement", "0", meters(displacement())] : ["Speed in the mechanism", "0", "fastest"], moved: ["Displacement", "0", farthest > 0 ? meters(farthest / (state.motion === FILM ? state.magnify : 1)) : "0"] }[state.colour];
  const keys = LAYERS.filter(([name, , ink, there]) => ink && state.layers.has(name) && there()).map(([name, title, ink]) => make("span", {}, make("i", { class: name === "marks" ? "dot" : false, style: `border-color:var(${ink});${name === "marks" ? `background:var(${ink})` : ""}` }), title));
  if (state.colour === "material") bodies.materials.forEach((name, k) => keys.push(make("span", {}, make("i", { class: "dot", style: `background:rgb(${PALETTE[k % PALETTE.length].map((v) => Math.round(255 * v)).join(",")})` }), name)));
  const key = (ink, words) => make("span", {}, make("i", { style: `border-color:var(${ink})` }), words);
  if (state.layers.has("loads")) for (const [live, ink, words] of [[0, "--ink", "dead loads"], [1, "--live", "live loads (× λ)"]]) if ([...loads.body.keys()].some((k) => loads.live[k] === live && acts(k))) keys.push(key(ink, words));
  if (view.slope && state.layers.has("slope")) keys.push(key("--ink", "highest grains, mean of all paths"), key("--mark", `straight line through them, ${short(view.slope.angle, 3)}°`));
  if (view.caption) keys.push(make("span", {}, view.caption));
  const parts = [make("div", { class: "keys" }, keys)];
  const scales = [scale, view.pressures && state.layers.has("pressures") && ["Pressure in joints", "0", withUnit(view.pressures.greatest, "Pa")]];
  for (const [name, ...ends] of scales.filter(Boolean)) parts.push(name, make("div", { class: "bar", style: "background:linear-gradient(90deg,var(--low),var(--middle),var(--high))" }), make("div", { class: "ends" }, ends.map((end) => make("span", {}, end))));
  el("legend").replaceChildren(...parts);
}
