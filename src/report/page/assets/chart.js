// Charts: drawings with values where one points, or where the arrow keys go.

// What moves the cursors of charts of a film.
const cursors = [];

function drawChart(chart) {
  const svg = document.importNode(new DOMParser().parseFromString(chart.svg, "image/svg+xml").documentElement, true);
  svg.setAttribute("tabindex", "0");
  const H = svg.viewBox.baseVal.height || 340, W = svg.viewBox.baseVal.width || 560, spots = chart.spots;
  const place = (e) => { const box = svg.getBoundingClientRect(); return [((e.clientX - box.left) * W) / box.width, ((e.clientY - box.top) * H) / box.height]; };
  if (chart.film) {
    const [left, right, from, to] = chart.film;
    const cursor = make("line", { class: "axis", "stroke-width": 1.6, y1: 10, y2: H - 46, x1: left, x2: left });
    svg.append(cursor);
    cursors.push((x) => { for (const end of ["x1", "x2"]) cursor.setAttribute(end, (left + (right - left) * Math.min(Math.max((x - from) / (to - from), 0), 1)).toFixed(1)); });
    const seek = (e) => filmTo(from + ((place(e)[0] - left) / (right - left)) * (to - from));
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
    const [x, y] = place(e);
    let best = -1, near = chart.wide ? Infinity : 900;
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
  const ink = (k) => (k.class ? `var(--${k.class})` : `rgb(${k.rgb})`);
  const keys = chart.keys.length ? make("div", { class: "keysrow" }, chart.keys.map((k) => make("span", {}, make("i", { style: `background:${ink(k)}` }), k.name))) : null;
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
