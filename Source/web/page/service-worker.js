// The page without a network, after the first visit: what was fetched from its own place is kept and renewed.

const cacheName = 'pacini-8'
const language = new URL(location.href).searchParams.get('language') // besides English
// What a visit keeps at once: the page and the guide in one language, which open and analyse without a network.
const first = ['./', 'style.css', 'app.js', 'cards.js', 'core.js', 'curve.js', 'early.js', 'editing.js', 'edits.js', 'feel.js', 'fields.js', 'film.js', 'first-part.js', 'hid.js',
  'figures.js', 'guide.html', 'guide.js', 'guide/list.js', 'history.js', 'kinds.js', 'lanes.js', 'live.js',
  'microphone.js', 'peaks.js', 'sound-player.js', 'sounds.js', 'store.js', 'text.js', 'vibration.js', 'words.js', 'worker.js', 'zip.js', 'visit.wasm',
  'gallery/list.js', 'pacini/index.js', 'pacini/module.js', 'pacini/sound.js', 'pacini/sound-file.js', 'pacini/sound-header.js', 'pacini/sound-markers.js', 'pacini/sound-words.js', 'pacini/presets.js', 'pacini/profiles.js', 'pacini/translator.js',
  ...['bands', 'breakpoints', 'actuators', 'scenes', 'protection', 'time'].map((name) => `guide/${language ? `${language}/` : ''}${name}.html`),
  ...(language ? [`texts/${language}.js`] : []),
  ...['knock_wood_bridge', 'ui_click'].map((name) => `guide/${name}.flac`)]
// What it keeps once something was opened: formats of other programs, live translation, the sounds of the cards.
const rest = ['pacini/formats.wasm', 'pacini/translator.wasm', 'pacini/translator-worklet.js', 'gallery/licences.txt',
  ...['heartbeat', 'knock_wood_bridge', 'footsteps', 'drums_tabla_pattern', 'engine_loop', 'explosion', 'rain', 'ui_click'].map((name) => `gallery/${name}.flac`)]

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(cacheName).then((cache) => cache.addAll(first)).then(() => self.skipWaiting()))
})
self.addEventListener('activate', (event) => {
  event.waitUntil(caches.keys()
    .then((names) => Promise.all(names.filter((name) => name !== cacheName).map((name) => caches.delete(name))))
    .then(() => self.clients.claim()))
})
self.addEventListener('message', (event) => {
  if (event.data !== 'keep the rest') return
  event.waitUntil((async () => {
    const cache = await caches.open(cacheName)
    for (const name of rest) if (!await cache.match(name)) await cache.add(name).catch(() => {})
  })())
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
      const there = await cache.match(request, { ignoreSearch: true }) ??
        (/\/index\.html$/.test(new URL(request.url).pathname) ? await cache.match('./') : undefined)
      if (there) return there
      throw error
    }
  })())
})
