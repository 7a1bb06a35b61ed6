// What is drawn over the blocks: lines, arrows and dots, and joints as polygons.
const LAYERS = [
  ["line", "Line of thrust", "--line", () => forcesNow() && forcesNow().lineBody.length],
  ["resultants", "Resultants", "--arrow", () => forcesNow()],
  ["contacts", "Contact forces", "--arrow", () => forcesNow()],
  ["loads", "Loads", "--live", () => loads.body.length],
  ["marks", "Moving joints", "--mark", () => view.motions.length],
  ["joints", "Joints", "--joint", () => JOINTS],
  ["edges", "Edges", null, () => bodies.edges.length],
];
const forcesNow = () => view.states[state.force];
const LONGEST = 0.16, THICK = 0.0036;

// Loads as they are drawn: the greatest live and the greatest dead one are as long as each other.
function loadArrows() {
  const many = Math.max(1, Math.cbrt(JOINTS / 120)), most = [0, 1].map((live) => { let m = 1e-300; for (let k = 0; k < loads.body.length; k++) if (loads.live[k] === live) m = Math.max(m, norm(at3(loads.newton, k))); return m; });
  return Array.from(loads.body, (_, k) => mul(at3(loads.newton, k), (0.9 * LONGEST) / many / most[loads.live[k]]));
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
  if (on("loads")) loadArrows().forEach((f, k) => {
    const at = moved(loads.body[k], at3(loads.at, k));
    if (norm(f) > 2e-4) arrows.push([sub(at, f), at, r, rgb(loads.live[k] ? "--live" : "--ink")]);
  });
  if (state.picked && state.picked.body !== undefined) {
    const i = state.picked.body, corner = (k) => moved(i, at3(bodies.corners, bodies.cornerStart[i] + bodies.edges[k]));
    for (let k = bodies.edgeStart[i]; k < bodies.edgeStart[i + 1]; k += 2) rods.push([corner(k), corner(k + 1), 0.0016, rgb("--pick")]);
  }
  if (on("marks") && state.motion >= 0) {
    const motion = view.motions[state.motion];
    for (let k = 0; k < motion.markJoint.length; k++) dots.push([moved(joints.a[motion.markJoint[k]], at3(motion.markAt, k)), 2 * r, rgb("--mark")]);
  }
  if (forces && on("line") && JOINTS < 400) for (let k = 0; k < JOINTS; k++) if (forces.used[k] >= 0.9999) dots.push([moved(joints.a[k], at3(forces.at, k)), 1.9 * r, rgb("--line")]);
  return { rods, arrows, dots };
}

// Polygons of joints: [points, colour, opacity].
function polygons() {
  const list = [], one = (k, ink, alpha) => {
    const points = [];
    for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) points.push(moved(joints.a[k], at3(joints.points, p)));
    list.push([points, ink, alpha]);
  };
  if (state.layers.has("joints")) { const ink = rgb("--joint"); for (let k = 0; k < JOINTS; k++) one(k, ink, 0.55); }
  if (state.picked && state.picked.joint !== undefined) one(state.picked.joint, rgb("--pick"), 0.95);
  return list;
}

// The colours of the moment in words.
function legend() {
  const scale = { value: view.values && [view.values.name, ...view.values.ends], share: ["Share of a joint that is used", "0", "all"], force: ["Greatest force on a joint", "0", newtons(1)], speed: ["Speed in the mechanism", "0", "fastest"], moved: ["Way so far", "0", farthest > 0 ? meters(farthest / (state.motion === FILM ? state.magnify : 1)) : "0"] }[state.colour];
  const keys = LAYERS.filter(([name, , ink, there]) => ink && state.layers.has(name) && there()).map(([name, title, ink]) => make("span", {}, make("i", { class: name === "marks" ? "dot" : false, style: `border-color:var(${ink});${name === "marks" ? `background:var(${ink})` : ""}` }), title));
  if (state.colour === "material") bodies.materials.forEach((name, k) => keys.push(make("span", {}, make("i", { class: "dot", style: `background:rgb(${PALETTE[k % PALETTE.length].map((v) => Math.round(255 * v)).join(",")})` }), name)));
  if (view.caption) keys.push(make("span", {}, view.caption));
  const parts = [make("div", { class: "keys" }, keys)];
  if (scale) parts.push(scale[0], make("div", { class: "bar", style: "background:linear-gradient(90deg,var(--low),var(--middle),var(--high))" }), make("div", { class: "ends" }, make("span", {}, scale[1]), make("span", {}, scale[2])));
  el("legend").replaceChildren(...parts);
}
