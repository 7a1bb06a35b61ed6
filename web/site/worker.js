// Loads the module once and answers one request after the other; the page ends the worker to stop one.
importScripts("module.js");
const ready = (async () => {
  const packed = await fetch("voussoir.wasm.gz");
  if (!packed.ok) throw new Error("voussoir.wasm.gz is not beside this page: build it by web/build");
  const bytes = new Uint8Array(await packed.arrayBuffer());
  // Some servers unpack what ends in .gz.
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return WebAssembly.compile(bytes);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
})();
ready.catch(() => {});
onmessage = async ({ data: { kind, request } }) => {
  try {
    // A module whose call failed is not used again: each call has its own.
    const module = await voussoir(await ready);
    postMessage(module[kind](request));
  } catch (error) {
    postMessage({ error: String(error.message ?? error) });
  }
};
