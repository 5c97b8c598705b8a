// Made by the build: keeps the page's files so that it works without a network after the first visit.
const NAME = "__NAME__";
const FILES = __FILES__;

self.addEventListener("install", (event) => {
  event.waitUntil(
    caches
      .open(NAME)
      .then((cache) => cache.addAll(FILES))
      .then(() => self.skipWaiting()),
  );
});

self.addEventListener("activate", (event) => {
  event.waitUntil(
    caches
      .keys()
      .then((names) => Promise.all(names.filter((name) => name.startsWith("carom-lab-") && name !== NAME).map((name) => caches.delete(name))))
      .then(() => self.clients.claim()),
  );
});

// Files with a hash in their name never change; the others are asked for first, so that a new version is seen at once.
self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== location.origin) return;
  const kept = () => caches.match(event.request, { ignoreSearch: true }).then((found) => found ?? caches.match("./", { ignoreSearch: true }));
  if (url.pathname.includes("/assets/")) {
    event.respondWith(caches.match(event.request).then((found) => found ?? fetch(event.request)));
  } else {
    event.respondWith(fetch(event.request).catch(kept));
  }
});
