// Keeps what the page asks for. A server that answers is always right; without one what it said last counts.
const KEPT = "voussoir";
const FILES = ["index.html", "site.js", "worker.js", "frame.html", "module.js", "page.css", "site.css", "voussoir.wasm.gz"];
onfetch = (event) => event.respondWith((async () => {
  const cache = await caches.open(KEPT);
  try {
    const fresh = await fetch(event.request);
    if (fresh.ok && event.request.method === "GET") await cache.put(event.request, fresh.clone());
    return fresh;
  } catch (error) {
    const kept = await cache.match(event.request);
    if (kept) return kept;
    throw error;
  }
})());
onactivate = (event) => event.waitUntil(clients.claim());
oninstall = (event) => event.waitUntil((async () => {
  await (await caches.open(KEPT)).addAll(FILES);
  await skipWaiting();
})());
