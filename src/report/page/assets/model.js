// The scene in units of its size, and where its blocks are at the moment.
const unpack = (part) => { for (const key in part) if (typeof part[key] === "string" && /^(f32|u16|u32|i16):/.test(part[key]) && !["name", "quantity", "unit", "way"].includes(key)) part[key] = decode(part[key]); return part; };
let view, bodies, joints, loads, members, COUNT, JOINTS, reach, jointsOf, poses;

// Takes a view in the place of the one there was.
function take(fresh) {
  view = fresh;
  [bodies, joints, loads, members] = [view.bodies, view.joints, view.loads, view.members].map(unpack);
  if (view.slope) unpack(view.slope);
  view.states.forEach(unpack);
  view.motions.forEach(unpack);
  if (view.film) { unpack(view.film); view.film.loads.forEach(unpack); }
  if (view.values) unpack(view.values);
  if (view.pressures) unpack(view.pressures);
  [COUNT, JOINTS] = [bodies.ids.length, joints.a.length];
  view.states.forEach(resultants);
  // The farthest corner of each block from its centre of mass.
  reach = bodies.radius.map((r, i) => {
    let far = r;
    for (let k = bodies.cornerStart[i]; k < bodies.cornerStart[i + 1]; k++) far = Math.max(far, norm(sub(at3(bodies.corners, k), at3(bodies.center, i))));
    return far;
  });
  jointsOf = Array.from({ length: COUNT }, () => []);
  for (let k = 0; k < JOINTS; k++) { jointsOf[joints.a[k]].push(k); jointsOf[joints.b[k]].push(k); }
  // Rotation and shift of each block: 8 numbers, the last one unused.
  poses = new Float32Array(8 * COUNT);
}

// Resultants of a system of forces, and what the line of thrust carries.
function resultants(s) {
  for (const [key, size] of [["force", 3], ["normal", 1], ["shear", 1], ["eccentricity", 1]]) s[key] = new Float32Array(size * JOINTS);
  for (let k = 0; k < JOINTS; k++) {
    let f = [0, 0, 0];
    for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) f = add(f, at3(s.forces, p));
    const n = at3(joints.normal, k), fn = dot(f, n), there = !Number.isNaN(s.used[k]);
    s.force.set(f, 3 * k);
    s.normal[k] = there ? fn : NaN;
    s.shear[k] = there ? norm(sub(f, mul(n, fn))) : NaN;
    s.eccentricity[k] = norm(sub(at3(s.at, k), at3(joints.center, k)));
  }
  s.lineForce = Float32Array.from(s.lineJoint, (k, m) => { const f = norm(at3(s.force, k)), o = s.lineOther[m]; return o < JOINTS ? 0.5 * (f + norm(at3(s.force, o))) : f; });
}
take(data.view);
const meters = (v) => withUnit(v * view.length, "m");
const newtons = (v) => withUnit(v * view.force, "N");

// What is chosen. `way` runs from 0 to 1.
const state = { motion: -1, way: 0, magnify: 1, force: 0, colour: "stone", supports: "shown", layers: new Set(), picked: null };
// How much there is to see of a block: supports can be seen through, or be left out.
const GLASS = 0.17;
const opacity = (i) => (!bodies.support[i] || state.supports === "shown" ? 1 : state.supports === "glass" ? GLASS : 0);
// Greatest and least way of the fastest corner in a mechanism, over the size of the scene, when the slider is at its end.
const FAR = 0.16, NEAR = 0.03;
// Where it can be, no joint gapes or slides by more than this share of the smaller of its blocks: one sees what belonged together.
const GAPE = 0.5;
// Where it can be, no block turns by more than this then, radians; those that do not may grow by 1 / cos of it, 5 %.
const WIDEST = 0.3;
const FILM = -2;
// Over the size of the scene.
const AWAY = 1e6;

function posed(i) {
  if (state.motion === FILM) return filmed(i);
  const motion = view.motions[state.motion];
  if (!motion || state.way === 0) return [[0, 0, 0, 1], [0, 0, 0]];
  const far = amplitude(motion), s = state.way * far, v = at3(motion.velocity, i), w = at3(motion.spin, i), spin = norm(w);
  // To first order hinges stay closed, and blocks grow a little; those that turn by more follow the screw of their rates as they are.
  if (spin * far <= 1.001 * WIDEST) return [[...mul(w, s), FIRST], mul(v, s)];
  const axis = mul(w, 1 / spin), arm = mul(cross(axis, v), 1 / spin), q = turn(mul(w, s));
  return [q, add(sub(arm, rotate(q, arm)), mul(axis, dot(axis, v) * s))];
}

function filmed(i) {
  const film = view.film, last = film.times.length - 1, t = state.way * last, k = Math.min(Math.floor(t), last - 1), f = t - k;
  // What is not there stands where nobody looks.
  if (film.hidden.length && film.hidden[Math.round(t) * COUNT + i]) return [[0, 0, 0, 1], [0, 0, AWAY]];
  const mix = (list, scale) => {
    const a = at3(list, k * COUNT + i), b = at3(list, (k + 1) * COUNT + i);
    return mul(add(mul(a, 1 - f), mul(b, f)), (scale / 32767) * state.magnify);
  };
  return [turn(mix(film.turn, film.wide)), mix(film.shift, film.far)];
}

function pose() {
  for (let i = 0; i < COUNT; i++) {
    const [q, t] = posed(i);
    poses.set(q, 8 * i);
    poses.set(t, 8 * i + 4);
  }
}

// Where a point of a block is now.
function moved(i, p) {
  const c = at3(bodies.center, i), q = poses.subarray(8 * i, 8 * i + 4);
  return add(add(c, [poses[8 * i + 4], poses[8 * i + 5], poses[8 * i + 6]]), rotate(q, sub(p, c)));
}

// How far the centre and the corners of a block went, at most.
function displaced(i) {
  const w = poses[8 * i + 3], angle = w === FIRST ? norm(at3(poses.subarray(8 * i), 0)) : 2 * Math.acos(Math.min(1, Math.abs(w)));
  return Math.hypot(poses[8 * i + 4], poses[8 * i + 5], poses[8 * i + 6]) + angle * reach[i];
}

function amplitude(motion) {
  if (!motion.far) {
    let most = 1e-9;
    for (let i = 0; i < COUNT; i++) most = Math.max(most, norm(at3(motion.spin, i)));
    let far = Math.min(FAR, WIDEST / most);
    for (const k of motion.markJoint) {
      const speed = (i, p) => add(at3(motion.velocity, i), cross(at3(motion.spin, i), sub(p, at3(bodies.center, i)))), size = 2 * Math.min(reach[joints.a[k]], reach[joints.b[k]]);
      for (let p = joints.pointStart[k]; p < joints.pointStart[k + 1]; p++) { const at = at3(joints.points, p), apart = norm(sub(speed(joints.a[k], at), speed(joints.b[k], at))); if (apart * far > GAPE * size) far = (GAPE * size) / apart; }
    }
    motion.far = Math.max(NEAR, far);
  }
  return motion.far;
}

// The speed of the fastest corner of each block over that of all.
function speeds(motion) {
  motion.speeds = motion.speeds || bodies.radius.map((r, i) => {
    const v = at3(motion.velocity, i), w = at3(motion.spin, i);
    let most = r > 0 ? norm(v) + r * norm(w) : 0;
    for (let k = bodies.cornerStart[i]; k < bodies.cornerStart[i + 1]; k++) most = Math.max(most, norm(add(v, cross(w, sub(at3(bodies.corners, k), at3(bodies.center, i))))));
    return Math.min(1, most);
  });
  return motion.speeds;
}

// The colour of a block on the scale from 0 to 1; null for plain stone.
function shade(i) {
  const forces = view.states[state.force];
  if (bodies.support[i] && state.colour !== "material") return null;
  switch (state.colour) {
    case "share": return forces ? forces.bodyUsed[i] : null;
    case "force": {
      let most = NaN;
      if (forces) for (const k of jointsOf[i]) { const f = Math.hypot(forces.normal[k], forces.shear[k]); if (!(most >= f) && !Number.isNaN(f)) most = f; }
      return most;
    }
    case "speed": {
      const motion = view.motions[Math.max(state.motion, 0)];
      if (!motion) return null;
      return speeds(motion)[i];
    }
    case "value": return view.values.of[i];
    case "moved": return farthest > 0 ? displaced(i) / farthest : 0;
    default: return null;
  }
}
let farthest = 0;

const mix = (a, b, t) => a.map((v, k) => v + (b[k] - v) * t);
// Colours from the least to the greatest.
function scale() {
  const [low, middle, high] = ["--low", "--middle", "--high"].map(rgb);
  return (share) => { const t = Math.min(Math.max(share, 0), 1); return t < 0.5 ? mix(low, middle, 2 * t) : mix(middle, high, 2 * t - 1); };
}

// What fills a picture of the scene: the colour of every block.
const PALETTE = [[0.82, 0.76, 0.66], [0.62, 0.71, 0.78], [0.76, 0.62, 0.56], [0.66, 0.74, 0.6], [0.75, 0.68, 0.78], [0.56, 0.6, 0.66]];
function colours() {
  const [stone, support, pick] = ["--stone", "--support", "--pick"].map(rgb), scaled = scale();
  if (state.colour === "moved") { farthest = 0; for (let i = 0; i < COUNT; i++) farthest = Math.max(farthest, displaced(i)); }
  const list = new Float32Array(3 * COUNT);
  for (let i = 0; i < COUNT; i++) {
    const share = shade(i);
    let colour = bodies.support[i] ? support : stone;
    if (state.colour === "material" && bodies.material[i]) colour = PALETTE[(bodies.material[i] - 1) % PALETTE.length];
    else if (share !== null && !Number.isNaN(share)) colour = scaled(share);
    if (state.picked && state.picked.body === i) colour = mix(colour, pick, 0.75);
    list.set(colour, 3 * i);
  }
  return list;
}
