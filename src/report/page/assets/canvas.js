// Drawing without a graphics card: the far pieces first, on a plain canvas.
function plain(canvas) {
  const context = canvas.getContext("2d");
  if (!context) return null;
  return function draw(width, height) {
    const l = lens(width, height), m = l.matrix;
    const seen = (p) => {
      const w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
      if (w < 1e-6) return null;
      const deep = dot(sub(l.at, p), l.z);
      return [(0.5 + (0.5 * (m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12])) / w) * width, (0.5 - (0.5 * (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13])) / w) * height, w, deep];
    };
    const paint = (c, alpha = 1) => `rgba(${c.map((v) => Math.round(255 * Math.min(1, v))).join(",")},${alpha})`;
    const tints = colours(), sun = unit(add(add(mul(l.z, 0.7), mul(l.x, -0.55)), mul(l.y, 0.75))), pieces = [];
    for (let i = 0; i < COUNT; i++) {
      const colour = at3(tints, i), alpha = opacity(i);
      if (!alpha) continue;
      if (bodies.radius[i] > 0) {
        const at = seen(moved(i, at3(bodies.center, i)));
        if (at) pieces.push({ far: at[3], at, alpha, r: ((bodies.radius[i] / at[2]) * height) / (2 * SLOPE), fill: paint(mul(colour, 0.92), alpha) });
        continue;
      }
      const points = [];
      for (let k = bodies.cornerStart[i]; k < bodies.cornerStart[i + 1]; k++) points.push(moved(i, at3(bodies.corners, k)));
      for (let k = bodies.pieceStart[i]; k < bodies.pieceStart[i + 1]; k += bodies.pieces[k] + 1) {
        const loop = Array.from(bodies.pieces.subarray(k + 1, k + 1 + bodies.pieces[k]), (c) => points[c]);
        let normal = [0, 0, 0];
        for (let j = 1; j + 1 < loop.length; j++) normal = add(normal, cross(sub(loop[j], loop[0]), sub(loop[j + 1], loop[0])));
        normal = unit(normal);
        if (dot(normal, l.flat ? l.z : sub(l.at, loop[0])) <= 0) continue;
        const flat = loop.map(seen);
        if (flat.includes(null)) continue;
        const light = 0.5 + 0.22 * (0.5 + 0.5 * dot(normal, up)) + 0.3 * Math.max(0, dot(normal, sun)) + 0.12 * Math.max(0, dot(normal, l.z));
        pieces.push({ far: flat.reduce((s, p) => s + p[3], 0) / flat.length, flat, alpha, fill: paint(mul(colour, light), alpha) });
      }
    }
    pieces.sort((a, b) => b.far - a.far);
    context.clearRect(0, 0, width, height);
    context.lineJoin = context.lineCap = "round";
    const trace = (flat) => { context.beginPath(); flat.forEach((p, k) => (k ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1]))); context.closePath(); };
    const border = state.layers.has("edges") ? paint(rgb("--edge"), 0.6) : null;
    for (const piece of pieces) {
      if (piece.flat) trace(piece.flat);
      else { context.beginPath(); context.arc(piece.at[0], piece.at[1], piece.r, 0, 7); }
      context.fillStyle = piece.fill;
      context.fill();
      context.strokeStyle = piece.alpha < 1 ? paint(rgb("--edge"), 0.35) : border || piece.fill;
      context.lineWidth = border ? Math.max(0.6, height / 900) : 0.5;
      context.stroke();
    }
    for (const [points, inks, alpha] of polygons()) {
      const flat = points.map(seen), c = mul(inks.reduce(add, [0, 0, 0]), 1 / inks.length);
      if (flat.includes(null)) continue;
      trace(flat);
      context.fillStyle = paint(c, alpha);
      context.fill();
    }
    const { rods, arrows, dots } = strokes(), wide = (r, p) => Math.max(1, ((r / p[2]) * height) / SLOPE);
    for (const [k, [a, b, r, c]] of [...rods, ...arrows].entries()) {
      const [p, q] = [seen(a), seen(b)];
      if (!p || !q) continue;
      context.strokeStyle = context.fillStyle = paint(c);
      context.lineWidth = wide(r, p);
      context.beginPath();
      context.moveTo(p[0], p[1]);
      context.lineTo(q[0], q[1]);
      context.stroke();
      const way = Math.hypot(q[0] - p[0], q[1] - p[1]);
      if (k < rods.length || way < 2) continue;
      const head = Math.min(3.2 * context.lineWidth, way * 0.6), [ux, uy] = [(q[0] - p[0]) / way, (q[1] - p[1]) / way];
      trace([q, [q[0] - ux * head - 0.45 * uy * head, q[1] - uy * head + 0.45 * ux * head], [q[0] - ux * head + 0.45 * uy * head, q[1] - uy * head - 0.45 * ux * head]]);
      context.fill();
    }
    for (const [a, r, c] of dots) {
      const p = seen(a);
      if (!p) continue;
      context.fillStyle = paint(c);
      context.beginPath();
      context.arc(p[0], p[1], Math.max(2, ((r / p[2]) * height) / (2 * SLOPE)), 0, 7);
      context.fill();
    }
  };
}
