// The modules against the native program: `node web/test.mjs VOUSSOIR [--quick]`, after `web/build`.
//
// Over the scenes of `structures/` every question is asked by both. Verdicts, grades and words are the
// same, numbers agree to 1e-9, and each verifies the results of the other. Then results are forged, one
// number at a time: what the native program refuses the modules refuse, too.
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { runInThisContext } from "node:vm";
import { gunzipSync } from "node:zlib";

const HERE = dirname(fileURLToPath(import.meta.url)), ROOT = dirname(HERE);
const [program, ...options] = process.argv.slice(2), quick = options.includes("--quick");
if (!program) {
  console.error("usage: node web/test.mjs VOUSSOIR [--quick]");
  process.exit(2);
}
runInThisContext(readFileSync(join(ROOT, "src/report/page/assets/module.js"), "utf8"));
const packed = (name) => readFileSync(join(HERE, "site", `${name}.wasm.gz`));
const load = (name) => voussoir(gunzipSync(packed(name)));
const checker = await load("checker"), solver = existsSync(join(HERE, "site/voussoir.wasm.gz")) ? await load("voussoir") : null;
const folder = mkdtempSync(join(tmpdir(), "voussoir-web-"));
process.on("exit", () => rmSync(folder, { recursive: true }));

/// Numbers that differ by this share of the greater one, or of 1, are the same: kernels and mathematical
/// functions differ in last bits.
const SAME = 1e-9;
const same = (a, b) => Math.abs(a - b) <= SAME * Math.max(Math.abs(a), Math.abs(b), 1);

/// Where two answers differ, and by what.
function* differences(a, b, path = "") {
  if (typeof a === "number" && typeof b === "number") {
    if (!same(a, b)) yield [path, a, b];
  } else if (a && b && typeof a === "object" && typeof b === "object") {
    for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) yield* differences(a[key], b[key], `${path}/${key}`);
  } else if (a !== b) yield [path, a, b];
}

/// What `voussoir check` says of results, as JSON.
function checked(text) {
  const file = join(folder, "checked.json");
  writeFileSync(file, text);
  const { stdout, stderr } = spawnSync(program, ["check", file, "--json"], { encoding: "utf8", maxBuffer: 1 << 28 });
  return stdout ? JSON.parse(stdout) : { grade: "error", error: stderr.split("\n").find((l) => l.startsWith("error")) ?? stderr };
}
/// What a module says.
function checkedHere(module, text) {
  try {
    const r = module.check(text);
    return r.verification ?? { grade: "error", error: r.line };
  } catch (e) {
    return { grade: "failed", error: e.message };
  }
}
const grade = (v) => (typeof v.grade === "string" ? v.grade : Object.keys(v.grade)[0]);

let failed = 0;
const fail = (...words) => { failed++; console.log("FAILED:", ...words); };

// What is sent to a browser, in bytes.
for (const [name, most] of [["checker", 2.5e6], ...(solver ? [["voussoir", 5e6]] : [])]) {
  const size = packed(name).length;
  console.log(`${name}: ${size} bytes`);
  if (size > most) fail(name, "is larger than", most, "bytes");
}

// The answers of both.
const saved = [], table = [];
const scenes = readdirSync(join(ROOT, "structures")).filter((f) => f.endsWith(".json") && f !== "expected.json");
const QUESTIONS = [["assess"], ["limit"], ["tilt", "--toward", "1,0,0"]];
/// Milliseconds for a native answer.
const PATIENCE = 60000;
let asked = 0, natively = 0, here = 0;
for (const scene of scenes.filter((_, k) => !quick || k % 6 === 0)) {
  for (const [verb, ...more] of QUESTIONS) {
    const file = join(folder, "result.json"), name = `${verb} ${scene}`, start = performance.now();
    rmSync(file, { force: true });
    const { error } = spawnSync(program, [verb, join(ROOT, "structures", scene), ...more, "--quiet", "--save", file], { encoding: "utf8", timeout: PATIENCE });
    if (error) console.log(`left out: ${name}: no answer natively within ${PATIENCE / 1000} s`);
    const took = performance.now() - start;
    // Questions that have no meaning for a scene: no live load, no free block.
    if (!existsSync(file) || !readFileSync(file, "utf8")) continue;
    const text = readFileSync(file, "utf8"), result = JSON.parse(text);
    saved.push([name, text]);
    asked++;
    const own = checked(text);
    const small = checkedHere(checker, text);
    if (["refuted", "error", "failed"].includes(grade(small))) fail(name, "the checker refuses it:", JSON.stringify(small.parts ?? small.error).slice(0, 400));
    if (!solver) continue;
    const large = checkedHere(solver, text);
    const words = (v) => v.parts?.map((p) => [p.title, p.fails.length]);
    if (grade(large) !== grade(own) || JSON.stringify(words(large)) !== JSON.stringify(words(own))) fail(name, "natively", JSON.stringify(own.grade), "here", JSON.stringify(large.grade), large.error ?? "");
    const begin = performance.now();
    let answer;
    try { answer = solver.ask({ name: scene, scene: JSON.stringify(result.scene), question: result.question }); } catch (e) { answer = { error: String(e) }; }
    const seconds = performance.now() - begin;
    natively += took; here += seconds;
    if (process.env.TIMES) console.log(`${name}: ${took.toFixed(0)} ms natively, ${seconds.toFixed(0)} ms here`);
    if (answer.error) { fail(name, answer.error); continue; }
    const back = checked(JSON.stringify(answer.result));
    if (grade(back) !== grade(own)) fail(name, "asked here, the native program says", JSON.stringify(back.grade), "instead of", JSON.stringify(own.grade));
    for (const [path, a, b] of differences(result.answer, answer.result.answer)) table.push([name, path, a, b]);
  }
}
console.log(`${asked} answers about ${scenes.length} scenes; natively ${(natively / 1000).toFixed(1)} s with starting the program, here ${(here / 1000).toFixed(1)} s`);

// What differs: numbers of one of many possible mechanisms or force systems may, answers may not.
const ANSWER = /^\/(verdict|status|law|grade|load_factor|tilt_deg|equilibrium_error)(\/|$)/;
for (const [name, path, a, b] of table.filter(([, path]) => ANSWER.test(path) || options.includes("--all"))) console.log(`differs: ${name}: ${path}: ${JSON.stringify(a)?.slice(0, 60)} natively, ${JSON.stringify(b)?.slice(0, 60)} here`);
console.log(`${table.length} values differ, in ${new Set(table.map(([name]) => name)).size} answers`);

// Forged results: a number of evidence or answer is another one.
const FORGED = quick ? 200 : 1200;
let seed = 1;
const draw = (n) => { seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0; return Math.floor((seed / 2 ** 32) * n); };
function* numbers(value, place = []) {
  if (typeof value === "number") yield place;
  else if (value && typeof value === "object") for (const key of Object.keys(value)) yield* numbers(value[key], [...place, key]);
}
const CHANGES = [(v) => v * 1.001, (v) => v * 0.9, (v) => -v, (v) => v + 1, (v) => v * 1e3, () => 0];
const light = saved.filter(([, text]) => text.length < 60000);
const count = { refused: 0, holds: 0 };
for (let k = 0; k < FORGED; k++) {
  const [name, text] = light[k % light.length], result = JSON.parse(text), half = draw(2) ? "evidence" : "answer";
  const places = [...numbers(result[half], [half])];
  if (!places.length) continue;
  const place = places[draw(places.length)], last = place.pop(), owner = place.reduce((v, key) => v[key], result);
  owner[last] = CHANGES[draw(CHANGES.length)](owner[last]);
  const forged = JSON.stringify(result), what = `forgery ${k} of ${name} at ${[...place, last].join("/")}`;
  const own = checked(forged), small = checkedHere(checker, forged), refused = (v) => ["refuted", "error"].includes(grade(v));
  count[refused(own) ? "refused" : "holds"]++;
  // What only a solver can compute again is unchecked by the checker, never proved.
  if (refused(own) !== refused(small) && !(refused(own) && grade(small) === "unchecked")) fail(what, "natively", JSON.stringify(own.grade), "checker", JSON.stringify(small.grade));
  if (solver) {
    const large = checkedHere(solver, forged);
    if (grade(large) !== grade(own)) fail(what, "natively", JSON.stringify(own.grade), "here", JSON.stringify(large.grade));
  }
}
console.log(`${count.refused + count.holds} forged results: ${count.refused} refused natively and here, ${count.holds} changed nothing that an answer rests on`);
console.log(failed ? `${failed} failed` : "all agree");
process.exit(failed ? 1 : 0);
