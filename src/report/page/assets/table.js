// Tables to sort and to search; long ones show a part and more on demand.
const PART = 200;

function table(source) {
  const words = source.columns.map((_, c) => source.rows.some((r) => typeof r[c] === "string"));
  let by = -1, down = false, wanted = "", shown = PART;
  const body = make("tbody"), count = make("span", { class: "note", role: "status" }), more = make("button", { type: "button", onclick: () => { shown += 5 * PART; draw(); } }, "Show more");
  const heads = source.columns.map((name, c) => make("th", { scope: "col", class: words[c] ? "word" : false }, make("button", { type: "button", onclick: () => { [by, down] = [c, by === c && !down]; draw(); } }, name)));
  const compare = (a, b) => {
    const [x, y] = [a[by], b[by]];
    if (x === null || y === null) return (x === null) - (y === null);
    const order = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y), undefined, { numeric: true });
    return down ? -order : order;
  };
  function draw() {
    let rows = wanted ? source.rows.filter((r) => r.some((v) => v !== null && String(v).toLowerCase().includes(wanted))) : source.rows;
    if (by >= 0) rows = [...rows].sort(compare);
    body.replaceChildren(...rows.slice(0, shown).map((r) => make("tr", {}, r.map((v, c) => make("td", { class: words[c] ? "word" : false, title: typeof v === "number" ? String(v) : false }, v === null ? "–" : typeof v === "number" ? short(v, 6) : v)))));
    heads.forEach((th, c) => (c === by ? th.setAttribute("aria-sort", down ? "descending" : "ascending") : th.removeAttribute("aria-sort")));
    heads.forEach((th, c) => { th.firstChild.textContent = source.columns[c] + (c === by ? (down ? " ▾" : " ▴") : ""); });
    count.textContent = `${Math.min(shown, rows.length)} of ${rows.length}`;
    more.hidden = rows.length <= shown;
  }
  const find = make("input", { type: "search", placeholder: "Find", "aria-label": `Find in ${source.title}`, oninput: (e) => { wanted = e.target.value.toLowerCase(); shown = PART; draw(); } });
  draw();
  return make("section", { class: "table" }, make("div", { class: "bar" }, make("h2", {}, source.title), find, count), make("div", { class: "scroll", tabindex: "0" }, make("table", {}, make("thead", {}, make("tr", {}, heads)), body)), more, source.note ? make("p", { class: "note" }, source.note) : null);
}

el("tables").append(...data.tables.map(table));
