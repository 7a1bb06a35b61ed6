// The bridge to the module: text in, reply out. `wasm` is what WebAssembly.instantiate takes: bytes, or a
// compiled module.
async function voussoir(wasm) {
  let why = "";
  const text = (from, length) => new TextDecoder().decode(new Uint8Array(memory.buffer, from, length));
  const page = { seconds: () => performance.now() / 1000, failed: (from, length) => { why = text(from, length); } };
  const made = await WebAssembly.instantiate(wasm, { page });
  const { memory, place, give_back, check_result, ask_question, import_file } = (made.instance ?? made).exports;
  const reply = (to, request) => {
    const bytes = new TextEncoder().encode(request), at = place(bytes.length);
    if (!at && bytes.length) throw new Error("there is not enough memory for this text");
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    let packed;
    // What failed is of no use any more: its memory may be in any state.
    try { packed = BigInt.asUintN(64, to(at, bytes.length)); } catch (error) { throw new Error(why || error.message, { cause: error }); }
    const from = Number(packed & 0xffffffffn), length = Number(packed >> 32n);
    const answer = text(from, length);
    give_back(at, bytes.length);
    give_back(from, length);
    return JSON.parse(answer);
  };
  const asked = (to) => to && ((request) => reply(to, JSON.stringify(request)));
  return { check: (result) => reply(check_result, result), ask: asked(ask_question), import: asked(import_file) };
}
