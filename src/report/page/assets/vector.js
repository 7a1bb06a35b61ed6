// Vectors of three, quaternions [x, y, z, w], matrices of 4 × 4 by columns.
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const mul = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => mul(a, 1 / (norm(a) || 1));
const at3 = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];

// The rotation by a rotation vector.
function turn(v) {
  const angle = norm(v);
  const s = angle > 1e-12 ? Math.sin(angle / 2) / angle : 0.5;
  return [v[0] * s, v[1] * s, v[2] * s, Math.cos(angle / 2)];
}

// A fourth number of 2 says that the other three are a small rotation vector that acts to first order: hinges stay closed.
const FIRST = 2;
function rotate(q, v) {
  if (q[3] === FIRST) return add(v, cross(q, v));
  const t = mul(cross(q, v), 2);
  return add(add(v, mul(t, q[3])), cross(q, t));
}
// What undoes that.
function back(q, v) {
  if (q[3] === FIRST) return mul(sub(add(v, mul(q, dot(q, v))), cross(q, v)), 1 / (1 + dot(q, q)));
  return rotate([-q[0], -q[1], -q[2], q[3]], v);
}

function product(a, b) {
  const m = new Float32Array(16);
  for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) for (let k = 0; k < 4; k++) m[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return m;
}

// Camera coordinates of a world seen from `eye` along −`z`.
function looking(x, y, z, eye) {
  return new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
}

// Parallel rays, with the same last row at every point: what is divided by it has its size at the target.
function parallel(slope, aspect, distance, near, far) {
  return new Float32Array([1 / (slope * aspect), 0, 0, 0, 0, 1 / slope, 0, 0, 0, 0, (-2 * distance) / (far - near), 0, 0, 0, (-distance * (far + near)) / (far - near), distance]);
}

function perspective(slope, aspect, near, far) {
  return new Float32Array([1 / (slope * aspect), 0, 0, 0, 0, 1 / slope, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0]);
}
