// The page without a network, after the first visit: what was fetched from its own place is kept and renewed.

const cacheName = 'pacini-5'
const first = ['./', 'index.html', 'style.css', 'app.js', 'core.js', 'curve.js', 'editing.js', 'edits.js', 'feel.js', 'fields.js', 'film.js', 'first-part.js', 'hid.js',
  'figures.js', 'guide.html', 'guide.js', 'guide/list.js', 'history.js', 'kinds.js', 'lanes.js', 'live.js',
  'microphone.js', 'peaks.js', 'sound-player.js', 'store.js', 'vibration.js', 'worker.js', 'zip.js',
  'gallery/list.js', 'pacini/index.js', 'pacini/module.js', 'pacini/sound.js', 'pacini/presets.js', 'pacini/profiles.js', 'pacini/encode.wasm', 'pacini/render.wasm', 'pacini/formats.wasm',
  'pacini/research.wasm', 'pacini/devices.wasm', 'pacini/translator.wasm', 'pacini/translator.js', 'pacini/translator-worklet.js']

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(cacheName).then((cache) => cache.addAll(first)).then(() => self.skipWaiting()))
})
self.addEventListener('activate', (event) => {
  event.waitUntil(caches.keys()
    .then((names) => Promise.all(names.filter((name) => name !== cacheName).map((name) => caches.delete(name))))
    .then(() => self.clients.claim()))
})
self.addEventListener('fetch', (event) => {
  const { request } = event
  if (request.method !== 'GET' || new URL(request.url).origin !== self.location.origin) return
  event.respondWith((async () => {
    const cache = await caches.open(cacheName)
    try {
      const answer = await fetch(request)
      if (answer.ok) cache.put(request, answer.clone())
      return answer
    } catch (error) {
      const there = await cache.match(request, { ignoreSearch: true })
      if (there) return there
      throw error
    }
  })())
})
