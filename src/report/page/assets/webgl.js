// Drawing with WebGL 2: blocks from one buffer, posed by a texture, then lines and arrows over them.
function webgl(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true, powerPreference: "high-performance" });
  if (!gl || gl.isContextLost()) return null;
  const programs = {};
  for (const [name, sources] of Object.entries(SHADERS)) {
    const program = gl.createProgram();
    sources.forEach((source, k) => {
      const shader = gl.createShader(k ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    });
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const place = (key) => gl.getUniformLocation(program, key);
    programs[name] = { program, at: Object.fromEntries(["matrix", "blocks", "upward", "sun", "eye", "ball", "tint", "shrink", "glass"].map((k) => [k, place(k)])) };
  }
  const send = (list) => { const b = gl.createBuffer(); gl.bindBuffer(gl.ARRAY_BUFFER, b); gl.bufferData(gl.ARRAY_BUFFER, list, gl.STATIC_DRAW); return b; };
  const attribute = (at, size, buffer, stride = 0, offset = 0, each = 0) => { gl.bindBuffer(gl.ARRAY_BUFFER, buffer); gl.enableVertexAttribArray(at); gl.vertexAttribPointer(at, size, gl.FLOAT, false, stride, offset); gl.vertexAttribDivisor(at, each); };
  const whole = (at, buffer, each = 0) => { gl.bindBuffer(gl.ARRAY_BUFFER, buffer); gl.enableVertexAttribArray(at); gl.vertexAttribIPointer(at, 1, gl.UNSIGNED_INT, 0, 0); gl.vertexAttribDivisor(at, each); };
  const vertices = (fill) => { const v = gl.createVertexArray(); gl.bindVertexArray(v); fill(); gl.bindVertexArray(null); return v; };

  const stream = gl.createBuffer();
  const profiles = { rods: profile([[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]]), arrows: profile([[0, 0, 0], [0, 0, 1], [1, -6, 1], [1, -6, 2.7], [1, 0, 0]]), dots: profile(Array.from({ length: 9 }, (_, k) => [0, -Math.cos((Math.PI * k) / 8), Math.sin((Math.PI * k) / 8)])) };
  for (const kind of Object.values(profiles)) kind.array = vertices(() => {
    const b = send(new Float32Array(kind.list));
    attribute(0, 3, b, 28, 0); attribute(1, 2, b, 28, 12); attribute(2, 2, b, 28, 20);
    attribute(3, 3, stream, 40, 0, 1); attribute(4, 3, stream, 40, 12, 1); attribute(5, 1, stream, 40, 24, 1); attribute(6, 3, stream, 40, 28, 1);
  });
  const faceStream = gl.createBuffer(), faces = vertices(() => { attribute(0, 3, faceStream, 28, 0); attribute(1, 4, faceStream, 28, 12); });

  // What is drawn of the scene that there is; what was made for the one before is given back.
  let made = [], scene = null;
  const own = (thing, kind) => { made.push([thing, kind]); return thing; };
  function build() {
    for (const [thing, kind] of made) gl[`delete${kind}`](thing);
    made = [];
    const upload = (list) => own(send(list), "Buffer"), array = (fill) => own(vertices(fill), "VertexArray");
    // Plane pieces as fans, edges as lines; corners about the centre of mass.
    const p = [], n = [], of = [], ep = [], eof = [];
    for (let i = 0; i < COUNT; i++) {
      const c = at3(bodies.center, i), corner = (k) => sub(at3(bodies.corners, bodies.cornerStart[i] + k), c);
      for (let k = bodies.pieceStart[i]; k < bodies.pieceStart[i + 1]; k += bodies.pieces[k] + 1) {
        const loop = Array.from(bodies.pieces.subarray(k + 1, k + 1 + bodies.pieces[k]), corner);
        let normal = [0, 0, 0];
        for (let m = 1; m + 1 < loop.length; m++) normal = add(normal, cross(sub(loop[m], loop[0]), sub(loop[m + 1], loop[0])));
        normal = unit(normal);
        for (let m = 1; m + 1 < loop.length; m++) for (const v of [loop[0], loop[m], loop[m + 1]]) { p.push(...v); n.push(...normal); of.push(i); }
      }
      for (let k = bodies.edgeStart[i]; k < bodies.edgeStart[i + 1]; k++) { ep.push(...corner(bodies.edges[k])); eof.push(i); }
    }
    const solids = array(() => { attribute(0, 3, upload(new Float32Array(p))); attribute(1, 3, upload(new Float32Array(n))); whole(2, upload(new Uint32Array(of))); });
    const edges = array(() => { attribute(0, 3, upload(new Float32Array(ep))); whole(2, upload(new Uint32Array(eof))); });
    const spheres = Array.from(bodies.radius.keys()).filter((i) => bodies.radius[i] > 0), globe = ball(spheres.length > 3000 ? 1 : spheres.length > 300 ? 2 : 3);
    const balls = array(() => { const b = upload(new Float32Array(globe)); attribute(0, 3, b); attribute(1, 3, b); whole(2, upload(new Uint32Array(spheres)), 1); });
    const wide = Math.min(COUNT, 512), high = Math.max(1, Math.ceil(COUNT / Math.max(1, wide))), texels = new Float32Array(Math.max(1, 3 * wide) * high * 4);
    const texture = own(gl.createTexture(), "Texture");
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, key, gl.NEAREST);
    return { solids, edges, balls, spheres, globe, texture, texels, wide, high, corners: of.length, ends: eof.length };
  }

  return function draw(width, height, changed) {
    if (gl.isContextLost()) return;
    if (!scene || scene.of !== view) scene = Object.assign(build(), { of: view });
    const { solids, edges, balls, spheres, globe, texture, texels, wide, high } = scene;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    if (changed) {
      const tints = colours();
      for (let i = 0; i < COUNT; i++) {
        const o = 12 * i, c = at3(bodies.center, i);
        texels.set(poses.subarray(8 * i, 8 * i + 4), o);
        texels.set([c[0] + poses[8 * i + 4], c[1] + poses[8 * i + 5], c[2] + poses[8 * i + 6], bodies.radius[i] || 1], o + 4);
        texels.set([tints[3 * i], tints[3 * i + 1], tints[3 * i + 2], opacity(i)], o + 8);
      }
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, Math.max(1, 3 * wide), high, 0, gl.RGBA, gl.FLOAT, texels);
    }
    const l = lens(width, height), sun = unit(add(add(mul(l.z, 0.7), mul(l.x, -0.55)), mul(l.y, 0.75)));
    const use = (name) => {
      const { program, at } = programs[name];
      gl.useProgram(program);
      gl.uniformMatrix4fv(at.matrix, false, l.matrix);
      gl.uniform3fv(at.upward, up); gl.uniform3fv(at.sun, sun); gl.uniform3fv(at.eye, l.z);
      return at;
    };
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    gl.disable(gl.BLEND);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1.5);
    let at;
    const solid = (glass) => {
      at = use("solid");
      gl.uniform1f(at.glass, glass);
      gl.uniform1f(at.ball, 0);
      gl.bindVertexArray(solids);
      gl.drawArrays(gl.TRIANGLES, 0, scene.corners);
      if (!spheres.length) return;
      gl.uniform1f(at.ball, 1);
      gl.bindVertexArray(balls);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, globe.length / 3, spheres.length);
    };
    solid(0);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (state.supports === "glass") {
      gl.depthMask(false);
      solid(1);
      gl.depthMask(true);
    }
    gl.disable(gl.CULL_FACE);
    if (state.layers.has("edges")) {
      at = use("edge");
      const alpha = COUNT > 1500 ? 0.35 : 0.6, ink = rgb("--edge");
      gl.uniform4f(at.tint, ink[0] * alpha, ink[1] * alpha, ink[2] * alpha, alpha);
      gl.bindVertexArray(edges);
      gl.drawArrays(gl.LINES, 0, scene.ends);
    }
    gl.clear(gl.DEPTH_BUFFER_BIT);
    const triangles = [];
    for (const [points, inks, alpha] of polygons()) {
      // Points and lines have no area to fill.
      for (let m = 1; m + 1 < points.length; m++) for (const c of [0, m, m + 1]) triangles.push(...points[c], ...inks[c], alpha);
    }
    if (triangles.length) {
      use("face");
      gl.bindVertexArray(faces);
      gl.bindBuffer(gl.ARRAY_BUFFER, faceStream);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(triangles), gl.STREAM_DRAW);
      gl.drawArrays(gl.TRIANGLES, 0, triangles.length / 7);
      gl.clear(gl.DEPTH_BUFFER_BIT);
    }
    const drawn = strokes();
    at = use("rod");
    for (const [name, kind] of Object.entries(profiles)) {
      const list = new Float32Array(10 * drawn[name].length);
      drawn[name].forEach((s, k) => list.set(name === "dots" ? [...s[0], s[0][0], s[0][1], s[0][2] + 1e-3, s[1], ...s[2]] : [...s[0], ...s[1], s[2], ...s[3]], 10 * k));
      if (!list.length) continue;
      gl.uniform1f(at.shrink, name === "arrows" ? 0.14 : 0);
      gl.bindVertexArray(kind.array);
      gl.bindBuffer(gl.ARRAY_BUFFER, stream);
      gl.bufferData(gl.ARRAY_BUFFER, list, gl.STREAM_DRAW);
      gl.drawArraysInstanced(gl.TRIANGLES, 0, kind.list.length / 7, drawn[name].length);
    }
    gl.bindVertexArray(null);
  };
}

// Triangles of a ball of radius 1, an octahedron divided again and again.
function ball(times) {
  const list = [], split = (a, b, c, n) => {
    if (!n) { list.push(...a, ...b, ...c); return; }
    const [d, e, f] = [unit(add(a, b)), unit(add(b, c)), unit(add(c, a))];
    split(a, d, f, n - 1); split(d, b, e, n - 1); split(f, e, c, n - 1); split(d, e, f, n - 1);
  };
  for (const x of [1, -1]) for (const y of [1, -1]) for (const z of [1, -1]) { const t = [[x, 0, 0], [0, y, 0], [0, 0, z]]; if (x * y * z < 0) t.reverse(); split(...t, times); }
  return list;
}

// Triangles of a profile turned about the first axis; normals per piece of the profile.
function profile(points) {
  const list = [], sides = JOINTS > 2000 ? 5 : 10;
  for (let k = 0; k + 1 < points.length; k++) {
    const [a, b] = [points[k], points[k + 1]], along = b[0] - a[0] + 0.2 * (b[1] - a[1]), across = b[2] - a[2], size = Math.hypot(along, across) || 1;
    for (let s = 0; s < sides; s++) {
      const [f, g] = [s, s + 1].map((v) => [Math.cos((2 * Math.PI * v) / sides), Math.sin((2 * Math.PI * v) / sides)]);
      for (const [q, w] of [[a, f], [b, f], [b, g], [a, f], [b, g], [a, g]]) list.push(...q, ...w, -across / size, along / size);
    }
  }
  return { list };
}
