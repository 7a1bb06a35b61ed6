
// The page verifies its own answer, by the checker that it holds, from the scene and the evidence in it.
const bare = (text, name) => (name && text.startsWith(`${name}: `) ? text.slice(name.length + 2) : text);
async function checkerOf(text) {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return voussoir(await new Response(stream).arrayBuffer());
}
function judged(found) {
  const { outcome, line, answer, verification } = found;
  if (outcome === "error") return ["bad", "Refuted in this browser just now", [line]];
  const parts = verification.parts.flatMap((p) => p.fails.map((f) => `${p.title}: ${f}`));
  if (outcome === "refuted") return ["bad", "Refuted in this browser just now", parts];
  const says = bare(answer, verification.name), how = bare(line, verification.name);
  if (!document.title.endsWith(says) || document.querySelector("header h1").textContent.trim().toLowerCase() !== says.toLowerCase()) return ["bad", "The heading of this page is not what its evidence proves", [`It proves: ${says}`]];
  if (outcome === "proved") return ["good", `Verified in this browser just now: ${says}; ${how}`, []];
  const open = verification.parts.flatMap((p) => (p.open ?? []).map((o) => `${p.title}: ${o}`));
  return ["unsure", `Verified in this browser just now, as far as it is proved: ${says}; ${how}`, open];
}
async function verifyHere() {
  const box = el("verified"), button = box.querySelector("button"), set = (kind, text, reasons, whole) => {
    box.className = `card verified ${kind}`;
    box.querySelector("strong").textContent = text;
    box.querySelector("ul").replaceChildren(...reasons.map((r) => make("li", {}, r)));
    box.querySelector("pre").textContent = whole ?? "";
    box.querySelector("details").hidden = !whole;
  };
  button.disabled = true;
  set("", "Verifying in this browser …", []);
  try {
    const checker = await checkerOf(el("checker").textContent);
    const found = checker.check(el("result").textContent);
    set(...judged(found), found.text);
  } catch (error) {
    set("bad", "Not verified: the checker in this page does not run", [String(error.message ?? error)]);
  }
  button.disabled = false;
}
if (!("DecompressionStream" in window)) el("verified").querySelector("strong").textContent = "Not verified: this browser is too old for it (it needs DecompressionStream, of 2023)";
else {
  el("verified").querySelector("button").addEventListener("click", verifyHere);
  verifyHere();
}
