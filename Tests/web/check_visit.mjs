// A first visit: what it loads, whether anything moves while it does, cards that are heard and felt, lists that the keyboard goes
// through, long sounds with their progress and memory, formats of sounds, and the guide without a network.
//
// check_visit.mjs PAGE MODULES PACINI SOUNDS [PICTURES]    PAGE: the built folder; MODULES: the folder with puppeteer-core; SOUNDS: a
// folder with WAV and AIFF files. Exit 0, 1 on a failed check.
import { execFileSync, spawn } from 'node:child_process'
import { closeSync, ftruncateSync, mkdtempSync, openSync, readdirSync, readFileSync, writeFileSync, writeSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'

import { check, failures, launch, serve, tidyUp, until, wait } from './browser.mjs'

const [page, modules, program, sounds, pictures] = process.argv.slice(2)
const folder = mkdtempSync(join(tmpdir(), 'pacini-visit-'))
const port = 20000 + process.pid % 20000
const place = `http://127.0.0.1:${port}/`
const source = join(dirname(fileURLToPath(import.meta.url)), '../../Source/web')
let server = serve(page, port)
const browser = await launch(modules, ['--autoplay-policy=no-user-gesture-required'], { userDataDir: join(folder, 'profile') })
const problems = []

/** A tab of its own, in a browser of its own unless `context` is given. */
const visit = async (address = place, { context, width = 1280, height = 900, prepare = () => {}, ...viewport } = {}) => {
  const own = context ?? await browser.createBrowserContext()
  const tab = await own.newPage()
  tab.on('pageerror', (error) => problems.push(error.message))
  await tab.setViewport({ width, height, ...viewport })
  await tab.evaluateOnNewDocument(prepare)
  await tab.goto(address)
  const text = (id) => tab.$eval(`#${id}`, (element) => element.textContent)
  const choose = async (path) => (await tab.$('#file')).uploadFile(path)
  const shown = (seconds) => until(async () => (await text('figures')).includes('bytes packed'), seconds)
  return { tab, text, choose, shown, context: own }
}
const click = ({ tab }, selector) => tab.$eval(selector, (element) => element.click())
const system = await browser.target().createCDPSession()
const renderers = async () => (await system.send('SystemInfo.getProcessInfo')).processInfo.filter(({ type }) => type === 'renderer').map(({ id }) => id)
/** Memory of their own of processes, MB: that of the largest. */
const largest = (ids) => Math.max(0, ...ids.map((id) => {
  try {
    return Number(readFileSync(`/proc/${id}/status`, 'utf8').match(/RssAnon:\s+(\d+)/)[1]) / 1000
  } catch { return 0 } // it has ended
}))

try {
  await until(async () => (await fetch(place).catch(() => undefined))?.ok)

  // ---- the server counts what it sends: that is all that a visit costs, service worker and headers included
  const sent = () => Number(readFileSync(join(folder, 'sent'), 'utf8'))
  server.kill()
  await wait(200)
  // The same server, with a count of its bytes.
  writeFileSync(join(folder, 'count.py'), [
    'import runpy, socketserver, sys',
    `sys.argv = ['serve.py', ${JSON.stringify(page)}, '${port}']`,
    'total = 0',
    'original = socketserver._SocketWriter.write',
    'def write(self, data):',
    '    global total',
    '    total += len(data)',
    `    open(${JSON.stringify(join(folder, 'sent'))}, 'w').write(str(total))`,
    '    return original(self, data)',
    'socketserver._SocketWriter.write = write',
    `runpy.run_path(${JSON.stringify(join(source, 'serve.py'))}, run_name='__main__')`].join('\n'))
  server = spawn('python3', ['-B', join(folder, 'count.py')])
  await until(async () => (await fetch(`${place}style.css`).catch(() => undefined))?.ok)
  const before = sent()
  const first = await visit(place, { prepare: () => {
    globalThis.shift = 0
    new PerformanceObserver((list) => { for (const { value, hadRecentInput } of list.getEntries()) if (!hadRecentInput) globalThis.shift += value })
      .observe({ type: 'layout-shift', buffered: true })
  } })
  await until(() => first.tab.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.active?.state === 'activated'))
  await wait(1500)
  const cost = sent() - before
  check('a first visit takes at most 500 kB, with all that it keeps', cost > 100000 && cost <= 500000, `${(cost / 1000).toFixed(0)} kB`)
  check('nothing moves while it loads', await first.tab.evaluate(() => globalThis.shift) < 0.01, `${await first.tab.evaluate(() => globalThis.shift)}`)

  for (const code of ['de', 'ja']) {
    const from = sent(), other = await visit(`${place}?language=${code}`, { prepare: () => {
      globalThis.shift = 0
      new PerformanceObserver((list) => { for (const { value } of list.getEntries()) globalThis.shift += value }).observe({ type: 'layout-shift', buffered: true })
    } })
    await until(() => other.tab.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.active?.state === 'activated'))
    await wait(1500)
    check(`and in ${code}`, sent() - from > 100000 && sent() - from <= 500000 && await other.tab.evaluate(() => globalThis.shift) < 0.01,
      `${((sent() - from) / 1000).toFixed(0)} kB, ${await other.tab.evaluate(() => globalThis.shift)}`)
    await other.tab.close()
  }

  const looked = await visit(`${place}?fresh`)
  await looked.tab.evaluate(readFileSync(join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8'))
  for (const scheme of ['dark', 'light']) {
    await looked.tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }])
    const found = await looked.tab.evaluate(async () => (await globalThis.axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 80)).join(' ')}`))
    check(`axe finds nothing on a first visit (${scheme})`, found.length === 0, found.join('\n'))
    for (const width of [320, 360, 768, 1440, 1920]) {
      await looked.tab.setViewport({ width, height: 900 })
      check(`nothing is wider than ${width}, or cut`, await looked.tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth &&
        [...document.querySelectorAll('#source button, #source .button, #source strong')].every((one) => one.scrollWidth <= one.clientWidth + 1)))
      if (pictures) await looked.tab.screenshot({ path: join(pictures, `first-${width}-${scheme}.png`), fullPage: true })
    }
  }
  const listed = await looked.tab.$$eval('link[rel=modulepreload]', (links) => links.map(({ href }) => href).sort())
  const loaded = await looked.tab.evaluate(() => [...new Set(performance.getEntriesByType('resource').map(({ name }) => name))]
    .filter((name) => name.endsWith('.js') && !/(early|app|worker|gallery.list|pacini.index|pacini.sound(-\w+)?)\.js$/.test(name)).sort()) // those of the package are the worker's
  check('the scripts that are loaded at once are those that the page has', listed.join() === loaded.join(), loaded.filter((name) => !listed.includes(name)).join(' '))
  await looked.context.close()
  const slow = await visit('about:blank')
  const throttled = await slow.tab.createCDPSession()
  await throttled.send('Emulation.setCPUThrottlingRate', { rate: 6 })
  await slow.tab.goto(`${place}?fresh`)
  await until(() => slow.tab.evaluate(() => document.documentElement.dataset.ready === 'true'))
  // A figure, not a bar: how fast a machine is, is no test.
  console.log(`     six times slower it is ready after ${(await slow.tab.evaluate(() => performance.getEntriesByName('ready')[0]?.startTime ?? 0)).toFixed(0)} ms`)
  await slow.context.close()

  // ---- the cards
  const cards = await first.tab.$$eval('.card', (all) => all.map((card) => ({
    file: card.dataset.file, name: card.querySelector('strong').textContent, picture: card.querySelector('svg').getBoundingClientRect().height,
    buttons: [...card.querySelectorAll('button')].map(({ textContent }) => textContent.trim()).slice(1).join() })))
  check('a first visit has eight cards with picture, Play and Feel', cards.length === 8 && cards.every(({ picture, buttons, name }) => picture > 50 && buttons === 'Play,Feel' && /^[A-Z]/.test(name)))
  check('as make_cards.py makes them', execFileSync(process.env.PACINI_PYTHON ?? 'python3', ['-B', join(source, 'make_cards.py'), '--check'], { encoding: 'utf8' }) === '')
  check('one drops on all of the window', await first.tab.$eval('#source', (element) => element.getBoundingClientRect().height > innerHeight - 220))
  check('their sources are named', (await first.tab.evaluate(async () => (await fetch('gallery/licences.txt')).text())).includes('CC0-1.0'))
  await click(first, '.card[data-file="ui_click.flac"] .play')
  check('Play plays and ends', await until(() => first.tab.$eval('.card[data-file="ui_click.flac"] .play', (button) => button.getAttribute('aria-pressed') === 'true')) &&
    await until(() => first.tab.$eval('.card[data-file="ui_click.flac"] .play', (button) => button.getAttribute('aria-pressed') === 'false')), await first.text('error'))
  await click(first, '.card[data-file="ui_click.flac"] .feel')
  check('Feel without anything to feel with says so and is heard', await until(async () => (await first.text('examples-status')).includes('you hear the haptics')), await first.text('examples-status'))
  await click(first, '.card[data-file="rain.flac"] .play')
  await click(first, '.card[data-file="footsteps.flac"] .play')
  check('one card plays at a time', await until(() => first.tab.$$eval('.card [aria-pressed=true]', (all) => all.length === 1 && all[0].closest('.card').dataset.file === 'footsteps.flac')))
  await click(first, '.card[data-file="heartbeat.flac"] .open')
  check('a card opens with its sound', await first.shown() && await first.tab.$eval('#play-sound', ({ disabled }) => !disabled) && await first.tab.$eval('#name', ({ value }) => value === 'heartbeat'))

  // ---- felt with its sound, from the playhead
  const felt = await visit(place, { prepare: () => {
    globalThis.rumbles = []
    const pad = { id: 'Test pad', index: 0, connected: true, buttons: [], axes: [], vibrationActuator: {
      playEffect: async (kind, effect) => { globalThis.rumbles.push({ at: performance.now(), ...effect }) }, reset: async () => {} } }
    navigator.getGamepads = () => [pad]
    globalThis.begun = []
    const start = AudioBufferSourceNode.prototype.start
    AudioBufferSourceNode.prototype.start = function (...parameters) {
      globalThis.begun.push({ at: performance.now(), seconds: this.buffer.duration })
      return start.apply(this, parameters)
    }
  } })
  await click(felt, '.card[data-file="knock_wood_bridge.flac"] .feel')
  check('Feel on a card is felt together with its sound', await until(() => felt.tab.evaluate(() => globalThis.rumbles.length > 3 && globalThis.begun.length === 1)))
  await until(() => felt.tab.$eval('.card[data-file="knock_wood_bridge.flac"] .feel', (button) => button.getAttribute('aria-pressed') === 'false'))
  await click(felt, '.card[data-file="knock_wood_bridge.flac"] .open')
  await felt.shown()
  await until(() => felt.tab.$eval('#play-sound', ({ disabled }) => !disabled))
  const middle = await felt.tab.$eval('#lanes', (canvas) => { // between the parts of the picture: a click sets the playhead
    const { left, top, width, height } = canvas.getBoundingClientRect()
    canvas.scrollIntoView()
    return { x: left + width / 2, y: canvas.getBoundingClientRect().top + 0.05 * height, top }
  })
  await felt.tab.mouse.click(middle.x, middle.y)
  await felt.tab.evaluate(() => { globalThis.rumbles = []; globalThis.begun = [] })
  await click(felt, '#feel')
  await wait(900)
  const rest = await felt.tab.evaluate(() => ({ rumbles: globalThis.rumbles, begun: globalThis.begun }))
  check('it is felt from the playhead on, with the rest of the sound', rest.begun.length === 1 && rest.begun[0].seconds < 0.3 && rest.rumbles.length > 3 &&
    rest.rumbles.at(-1).at - rest.rumbles[0].at < 450, JSON.stringify(rest.begun))
  await felt.tab.$eval('#with-sound', (box) => { box.checked = false })
  await felt.tab.evaluate(() => { globalThis.begun = [] })
  await click(felt, '#feel')
  await wait(300)
  check('and without it where that is wished', await felt.tab.evaluate(() => globalThis.begun.length === 0))
  await felt.context.close()

  // ---- lists by the keyboard
  const key = await visit()
  await click(key, '#more')
  check('More examples shows all', await key.tab.evaluate(() => document.activeElement.id === 'gallery'))
  await until(() => key.tab.$eval('#gallery', ({ options }) => options.length > 3))
  for (let i = 0; i < 3; ++i) await key.tab.keyboard.press('ArrowDown')
  await wait(800)
  check('arrows in a list open nothing', await key.tab.$eval('#clip', ({ hidden }) => hidden) && await key.tab.$eval('#gallery', ({ value }) => value !== ''))
  await key.tab.keyboard.press('Tab')
  await key.tab.keyboard.press('Enter')
  check('its button opens what is chosen', await key.shown())
  const card = await visit()
  await card.tab.focus('.card[data-file="ui_click.flac"] .open')
  await card.tab.keyboard.press('Enter')
  check('the keyboard opens a card and is not lost', await card.shown() && await until(() => card.tab.evaluate(() => document.activeElement.id === 'feel')))
  await card.context.close()
  await key.context.close()

  // ---- phones: fingers that do not edit
  const phone = await visit(place, { width: 390, height: 844, hasTouch: true, isMobile: true, prepare: () => { navigator.vibrate = () => true } })
  await click(phone, '.card[data-file="footsteps.flac"] .open')
  await phone.shown()
  const touch = await phone.tab.createCDPSession()
  const box = await phone.tab.$eval('#lanes', (canvas) => { canvas.scrollIntoView({ block: 'center' }); return canvas.getBoundingClientRect().toJSON() })
  const y = box.y + 0.05 * box.height, at = (x) => box.x + x * box.width
  const fingers = async (...steps) => {
    for (const [i, points] of steps.entries())
      await touch.send('Input.dispatchTouchEvent', { type: i === 0 ? 'touchStart' : 'touchMove', touchPoints: points.map((x, id) => ({ x: at(x), y, id })) })
    await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] })
    await wait(200)
  }
  const picture = () => phone.tab.$eval('#lanes', (canvas) => canvas.toDataURL())
  const whole = await picture()
  await fingers([0.45, 0.55], [0.35, 0.65], [0.2, 0.8], [0.1, 0.9])
  const nearer = await picture()
  await fingers([0.7], [0.5], [0.3])
  const farther = await picture()
  check('two fingers zoom and one scrolls', whole !== nearer && nearer !== farther)
  await click(phone, '#all')
  await wait(200)
  check('and nothing is edited', await phone.tab.$eval('#undo', ({ title }) => !/Move|Add|Remove/.test(title)))
  const iphone = await visit(place, { prepare: () => {
    Object.defineProperty(navigator, 'userAgent', { value: 'Mozilla/5.0 (iPhone; CPU iPhone OS 18_0 like Mac OS X)' })
    navigator.vibrate = undefined
  } })
  await click(iphone, '.card[data-file="ui_click.flac"] .feel')
  check('iPhones are told that they cannot', await until(async () => (await iphone.text('examples-status')).includes('iPhones cannot vibrate')))
  await iphone.context.close()
  await phone.context.close()

  // ---- sounds of all kinds: the bytes of the program
  const kinds = await visit()
  for (const file of readdirSync(sounds).sort()) {
    await kinds.tab.$eval('#figures', (line) => { line.textContent = '' })
    await kinds.choose(join(sounds, file))
    const name = file.replace(/\.[^.]+$/, '')
    const opened = await until(() => kinds.tab.$eval('#name', ({ value }, name) => value === name, name)) && await kinds.shown()
    execFileSync(program, ['encode', join(sounds, file), '-o', 'native.pacb', '-q', '-y', '--force'], { cwd: folder })
    const bytes = Number((await kinds.text('figures')).match(/([\d]+) bytes packed/)?.[1])
    check(`${file} is read as by the program`, opened && bytes === readFileSync(join(folder, 'native.pacb')).length, `${bytes} bytes; ${await kinds.text('error')}`)
  }
  const short = readFileSync(join(sounds, readdirSync(sounds).find((name) => name === 'WAV_PCM_16.wav')))
  const cut = Buffer.from(short.subarray(0, 44 + 2 * 478))
  writeFileSync(join(folder, 'broken.wav'), cut)
  await kinds.choose(join(folder, 'broken.wav'))
  const promised = short.readUInt32LE(40) / 2
  check('a cut-off file is told with its numbers', await until(async () => (await kinds.text('status')).includes(`broken.wav is cut off: 478 of ${promised.toLocaleString('en')} frames.`)), await kinds.text('status'))
  const called = readFileSync(join(sounds, 'WAV_FLOAT.wav'))
  called.writeUInt16LE(1, 20)
  writeFileSync(join(folder, 'called.wav'), called)
  await kinds.choose(join(folder, 'called.wav'))
  check('floating-point numbers that a header calls integers are told', await until(async () => (await kinds.text('status')).includes('called.wav states integers of 32 bits, but has floating-point numbers; it is read as these; save it anew.')), await kinds.text('status'))
  writeFileSync(join(folder, 'notes.aiff'), 'these are notes')
  await kinds.choose(join(folder, 'notes.aiff'))
  check('what is no sound is told by its name', await until(async () => await kinds.text('error') === 'notes.aiff cannot be opened. Try WAV, FLAC or MP3.'), await kinds.text('error'))
  writeFileSync(join(folder, 'notes.json'), '{"notes": []}')
  await kinds.choose(join(folder, 'notes.json'))
  check('and JSON that is no clip', await until(async () => await kinds.text('error') === 'notes.json is no clip in a format that is read.'), await kinds.text('error'))
  await kinds.tab.evaluate(() => { navigator.mediaDevices.getUserMedia = async () => { throw new DOMException('Permission denied', 'NotAllowedError') } })
  await click(kinds, '#record')
  check('what a browser refuses is told in plain words', await until(async () => (await kinds.text('error')).includes('Allow the microphone')), await kinds.text('error'))
  await kinds.context.close()

  // ---- thirty minutes: progress, cancel, memory
  const rate = 44100, seconds = 1800, long = join(folder, 'half-hour.wav'), file = openSync(long, 'w')
  const head = Buffer.from(short.subarray(0, 44))
  head.writeUInt32LE(36 + 2 * rate * seconds, 4)
  head.writeUInt32LE(2 * rate * seconds, 40)
  head.writeUInt16LE(1, 22)
  head.writeUInt32LE(rate, 24)
  head.writeUInt32LE(2 * rate, 28)
  head.writeUInt16LE(2, 32)
  writeSync(file, head)
  ftruncateSync(file, 44 + 2 * rate * seconds)
  const knock = short.subarray(44, 44 + 2 * Math.min(rate / 2, (short.length - 44) / 2))
  for (let second = 0; second < seconds; ++second) writeSync(file, knock, 0, knock.length, 44 + 2 * rate * second)
  closeSync(file)
  const waiting = await visit()
  await waiting.choose(long)
  check('a long sound says how far it is', await until(() => waiting.tab.$eval('#progress', ({ hidden }) => !hidden)) &&
    await until(() => waiting.tab.$eval('#done', ({ value }) => value > 0 && value < 1)))
  await click(waiting, '#cancel')
  check('and is cancelled', await until(async () => await waiting.text('status') === 'Cancelled.') && await waiting.tab.$eval('#progress', ({ hidden }) => hidden))
  await wait(500)
  check('for good', await waiting.tab.$eval('#clip', ({ hidden }) => hidden))
  await waiting.context.close()
  const others = new Set(await renderers())
  const half = await visit()
  const own = (await renderers()).filter((id) => !others.has(id))
  const quiet = largest(own)
  let most = 0, isMeasured = true
  const measured = (async () => { while (isMeasured) { most = Math.max(most, largest(own)); await wait(50) } })()
  await half.choose(long)
  const isOpen = await half.shown(120)
  await wait(3000)
  isMeasured = false
  await measured
  check('thirty minutes take less than 300 MB', isOpen && most > 0 && most < 300, `${most.toFixed(0)} MB at most, ${quiet.toFixed(0)} before; ${await half.text('figures')}`)
  await half.tab.$eval('#play-both', (button) => button.click())
  await wait(1000)
  check('and they play', await until(async () => await half.tab.$eval('#error', ({ hidden }) => hidden)), await half.text('error'))
  await click(half, '#stop')
  await half.context.close()

  // ---- the guide: each page is heard and has its neighbours
  const guide = await visit(`${place}guide.html`, { context: first.context, width: 390, height: 844 })
  const names = await guide.tab.evaluate(async () => (await import('./guide/list.js')).default.map(({ name }) => name))
  for (const [i, name] of names.entries()) {
    await guide.tab.goto(`${place}guide.html#${name}`)
    check(`${name} has something to hear`, await until(() => guide.tab.evaluate((name) => document.querySelectorAll(`.figure[data-figure=${name}] .ways button:enabled`).length > 1, name), 120))
    const steps = await guide.tab.$$eval('#steps a', (links) => links.map(({ rel, hash }) => `${rel}${hash}`))
    check('next and back', steps.includes(`next#${names[i + 1]}`) === (i + 1 < names.length) && steps.includes(`prev#${names[i - 1]}`) === i > 0, steps.join(' '))
    check('nothing is wider than a phone', await guide.tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth))
    if (pictures) await guide.tab.screenshot({ path: join(pictures, `guide-phone-${name}.png`), fullPage: true })
  }
  await guide.tab.goto(`${place}guide.html#bands`)
  const said = () => guide.tab.evaluate(() => document.querySelector('.figure[data-figure=bands] .words')?.textContent ?? '')
  await until(async () => (await said()).includes('HTS'))
  await guide.tab.evaluate(() => { globalThis.begun = 0; AudioBufferSourceNode.prototype.start = ((start) => function (...parameters) { ++globalThis.begun; return start.apply(this, parameters) })(AudioBufferSourceNode.prototype.start) })
  await guide.tab.$eval('.ways button', (button) => button.click())
  check('its button plays', await until(() => guide.tab.evaluate(() => globalThis.begun > 0)))

  // ---- without a network
  await until(() => first.tab.evaluate(async () => (await (await caches.open((await caches.keys())[0])).match('gallery/rain.flac')) !== undefined))
  server.kill()
  await wait(300)
  for (const name of names) {
    await guide.tab.goto('about:blank')
    await guide.tab.goto(`${place}guide.html#${name}`)
    check(`${name} without a network`, await until(async () => (await guide.tab.evaluate((name) => document.querySelector(`.figure[data-figure=${name}] .words`)?.textContent ?? '', name)).match(/\d/), 60))
  }
  await first.tab.goto('about:blank')
  await first.tab.goto(`${place}index.html`)
  check('the page is there without a network', await first.shown())
  await first.tab.select('#gallery', 'rain.flac')
  await click(first, '#open-example')
  check('and the sounds of its cards', await until(() => first.tab.$eval('#name', ({ value }) => value === 'rain')), await first.text('error'))
  check('nothing went wrong unseen', problems.length === 0, problems.join('\n'))
} finally {
  await tidyUp(folder, browser, server)
}
process.exit(failures() ? 1 : 0)
