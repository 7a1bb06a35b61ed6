// Charts as SVG with values where one points, or where the arrow keys go.
const inkOf = (k) => `var(--c${k % 10})`;
const SCALE = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

function viridis(share) {
  const place = Math.min(Math.max(share, 0), 1) * (SCALE.length - 1), k = Math.min(Math.floor(place), SCALE.length - 2);
  return `rgb(${SCALE[k].map((v, c) => Math.round(v + (place - k) * (SCALE[k + 1][c] - v))).join(",")})`;
}

// Round values inside a range.
function ticks(low, high, log) {
  if (log) {
    const from = Math.ceil(Math.log10(low) - 1e-9), to = Math.floor(Math.log10(high) + 1e-9), step = Math.max(1, Math.ceil((to - from) / 6));
    const list = [];
    for (let k = from; k <= to; k += step) list.push(10 ** k);
    if (list.length > 1) return list;
    const inside = [];
    for (let k = from - 1; k <= to + 1; k++) for (const m of [1, 2, 5]) if (m * 10 ** k >= low && m * 10 ** k <= high) inside.push(m * 10 ** k);
    return inside.length ? inside : [low, high];
  }
  const raw = (high - low) / 5, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].find((m) => m * power >= raw) * power;
  const list = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) list.push(Math.abs(v) < 1e-9 * step ? 0 : v);
  return list;
}

function range(values, log) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (Number.isFinite(v) && (!log || v > 0)) { low = Math.min(low, v); high = Math.max(high, v); }
  if (low > high) return log ? [0.1, 1] : [0, 1];
  if (log) return low === high ? [low / 3, high * 3] : [low / 1.3, high * 1.3];
  const pad = high > low ? 0.03 * (high - low) : 0.05 * Math.abs(high) || 1;
  return [low - pad, high + pad];
}

// What moves the cursors of charts of a film.
const cursors = [];

function drawChart(chart) {
  const W = 560, H = 340, left = 66, right = chart.cells ? 62 : 14, top = 10, bottom = 46;
  const cells = Boolean(chart.cells), xs = [], ys = [];
  for (const s of chart.series) s.points.forEach(([x, y], i) => {
    const b = y === null ? null : s.band && s.band[i];
    if (cells) { xs.push(x - b[0], x + b[0]); ys.push(y - b[1], y + b[1]); } else { xs.push(x); if (y !== null) ys.push(y); if (b) ys.push(b[0], b[1]); }
  });
  const tight = (list) => [Math.min(...list), Math.max(...list)];
  const [x0, x1] = cells ? tight(xs) : range(xs, chart.x.log), [y0, y1] = cells ? tight(ys) : range(ys, chart.y.log);
  const to = (v, a, b, log) => (log ? (Math.log(v) - Math.log(a)) / (Math.log(b) - Math.log(a)) : (v - a) / (b - a));
  const px = (v) => left + (W - left - right) * to(v, x0, x1, chart.x.log), py = (v) => H - bottom - (H - top - bottom) * to(v, y0, y1, chart.y.log);
  const svg = make("svg", { viewBox: `0 0 ${W} ${H}`, role: "img", tabindex: "0", "aria-label": `${chart.title}: ${chart.y.label} against ${chart.x.label}` });
  // Words stand where they are counted; all else at round values.
  const places = (axis, low, high) => (axis.words ? axis.words.map((_, k) => k).filter((k) => k >= low - 1e-9 && k <= high + 1e-9) : ticks(low, high, axis.log));
  const word = (axis, v) => (axis.words ? axis.words[v] : short(v, 3));
  for (const v of places(chart.x, x0, x1)) svg.append(make("line", { class: "grid", x1: px(v), x2: px(v), y1: top, y2: H - bottom }), make("text", { class: "soft", x: px(v), y: H - bottom + 17, "text-anchor": "middle" }, word(chart.x, v)));
  for (const v of places(chart.y, y0, y1)) svg.append(make("line", { class: "grid", x1: left, x2: W - right, y1: py(v), y2: py(v) }), make("text", { class: "soft", x: left - 7, y: py(v) + 4, "text-anchor": "end" }, word(chart.y, v)));
  svg.append(make("text", { x: (left + W - right) / 2, y: H - 8, "text-anchor": "middle" }, chart.x.label));
  svg.append(make("text", { x: 13, y: (top + H - bottom) / 2, "text-anchor": "middle", transform: `rotate(-90 13 ${(top + H - bottom) / 2})` }, chart.y.label));
  const spots = [];
  chart.series.forEach((s, k) => {
    const ink = s.colour || inkOf(k);
    if (cells) {
      const values = s.values || [], [low, high] = tight(values);
      s.points.forEach(([x, y], i) => {
        const [dx, dy] = s.band[i];
        svg.append(make("rect", { x: px(x - dx), y: py(y + dy), width: px(x + dx) - px(x - dx) + 0.6, height: py(y - dy) - py(y + dy) + 0.6, fill: s.colour || viridis((values[i] - low) / (high - low || 1)) }));
        spots.push([px(x), py(y), s.hints[i]]);
      });
      if (s.colour || !values.length) return;
      for (let i = 0; i < 40; i++) svg.append(make("rect", { x: W - right + 12, y: H - bottom - (i + 1) * (H - top - bottom) / 40, width: 12, height: (H - top - bottom) / 40 + 0.5, fill: viridis(i / 39) }));
      svg.append(make("text", { class: "soft", x: W - right + 28, y: top + 10 }, short(high, 3)), make("text", { class: "soft", x: W - right + 28, y: H - bottom }, short(low, 3)));
      return;
    }
    const path = (list) => list.map(([x, y], i) => `${i ? "L" : "M"}${px(x).toFixed(1)} ${py(y).toFixed(1)}`).join("");
    // A point without a value cuts the line.
    const runs = [[]];
    s.points.forEach(([, y], i) => (y === null ? runs.push([]) : runs[runs.length - 1].push(i)));
    for (const run of runs.filter((r) => r.length)) {
      if (s.band) {
        const up = run.map((i) => [s.points[i][0], s.band[i][1]]), down = run.map((i) => [s.points[i][0], s.band[i][0]]).reverse();
        svg.append(make("path", { d: `${path([...up, ...down])}Z`, style: `fill:${ink}`, opacity: 0.16 }));
      }
      if (s.line) svg.append(make("path", { d: path(run.map((i) => s.points[i])), fill: "none", style: `stroke:${ink}`, "stroke-width": 2, "stroke-linejoin": "round" }));
    }
    const r = s.colour ? 4.5 : s.line ? (s.points.length > 45 ? 0 : 3.2) : s.points.length > 500 ? 1.7 : 2.6;
    s.points.forEach(([x, y], i) => {
      if (y === null) return;
      if (r > 0) svg.append(make("circle", { cx: px(x).toFixed(1), cy: py(y).toFixed(1), r, style: `fill:${ink}`, opacity: s.line ? 1 : 0.55 }));
      spots.push([px(x), py(y), s.hints[i]]);
    });
  });
  svg.append(make("path", { class: "axis", fill: "none", d: `M${left} ${top}V${H - bottom}H${W - right}` }));
  if (chart.film) {
    const cursor = make("line", { class: "axis", "stroke-width": 1.6, y1: top, y2: H - bottom, x1: px(x0), x2: px(x0) });
    svg.append(cursor);
    cursors.push((x) => { for (const end of ["x1", "x2"]) cursor.setAttribute(end, px(Math.min(Math.max(x, x0), x1)).toFixed(1)); });
    const seek = (e) => {
      const box = svg.getBoundingClientRect(), x = ((e.clientX - box.left) * W) / box.width;
      filmTo(x0 + ((x - left) / (W - left - right)) * (x1 - x0));
    };
    svg.addEventListener("pointerdown", seek);
    svg.addEventListener("pointermove", (e) => e.buttons && seek(e));
  }
  const ring = make("circle", { r: 6, fill: "none", stroke: "currentColor", "stroke-width": 1.6, visibility: "hidden" });
  svg.append(ring);
  const idle = chart.note || "", hint = make("p", { class: "hint", "aria-live": "polite" }, idle);
  let at = -1;
  const show = (k) => {
    at = k;
    ring.setAttribute("visibility", k < 0 ? "hidden" : "visible");
    if (k >= 0) { ring.setAttribute("cx", spots[k][0]); ring.setAttribute("cy", spots[k][1]); }
    hint.textContent = k < 0 ? idle : spots[k][2];
  };
  svg.addEventListener("pointermove", (e) => {
    const box = svg.getBoundingClientRect(), x = ((e.clientX - box.left) * W) / box.width, y = ((e.clientY - box.top) * H) / box.height;
    let best = -1, near = cells ? Infinity : 900;
    spots.forEach(([sx, sy], k) => { const d = (sx - x) ** 2 + (sy - y) ** 2; if (d < near) [near, best] = [d, k]; });
    show(best);
  });
  svg.addEventListener("pointerleave", () => show(-1));
  const order = spots.map((_, k) => k).sort((a, b) => spots[a][0] - spots[b][0]);
  svg.addEventListener("keydown", (e) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[e.key];
    if (!step || !spots.length) return;
    e.preventDefault();
    show(order[(order.indexOf(at) + step + (at < 0 && step < 0 ? 1 : 0) + order.length) % order.length]);
  });
  const named = chart.series.map((s, k) => [s.name, s.colour || inkOf(k), s]).filter(([, , s]) => !cells || s.colour);
  const keys = named.length && (cells || named.length > 1 || chart.series[0].band) ? make("div", { class: "keysrow" }, named.map(([name, ink]) => make("span", {}, make("i", { style: `background:${ink}` }), name))) : null;
  return make("figure", {}, make("figcaption", {}, chart.title), keys, svg, hint);
}

function drawCharts(charts) {
  cursors.length = 0;
  // How the solver came to it is folded away with its other numbers.
  const inner = document.querySelector(".internals"), own = (c) => inner && c.title === "Error against time";
  document.querySelector(".internals .charts")?.remove();
  (el("charts") || el("trace")).replaceChildren(...charts.filter((c) => !own(c)).map(drawChart));
  if (charts.some(own)) inner.append(make("div", { class: "charts" }, charts.filter(own).map(drawChart)));
}
drawCharts(data.charts);
