// The page loses no work: edits by hand outlive knobs, undo, reloads, links, other tabs and slow files; a microphone that is
// switched off is off; a swipe edits nothing; a link cannot occupy the page; and nothing runs that is not the page's own.
//
// check_work.mjs PAGE MODULES PACINI SOUND.wav OTHER.wav [PICTURES]    PAGE: the built folder; MODULES: the folder with
// puppeteer-core; two sounds of different lengths. Exit 0, 1 on a failed check.
import { execFileSync } from 'node:child_process'
import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'

import { check, failures, launch, serve, tidyUp, until, wait } from './browser.mjs'

const [page, modules, program, sound, otherSound, pictures] = process.argv.slice(2)
const folder = mkdtempSync(join(tmpdir(), 'pacini-work-'))
const port = 20000 + process.pid % 20000
const place = `http://127.0.0.1:${port}/?fresh`
const server = serve(page, port)
const browser = await launch(modules, ['--autoplay-policy=no-user-gesture-required', '--use-fake-device-for-media-stream',
  '--use-fake-ui-for-media-stream'], { userDataDir: join(folder, 'profile') })
const problems = []

/** A tab of its own, in a browser of its own unless `context` is given, with what the checks ask of it. */
const open = async (context, address = place, prepare = () => {}) => {
  context ??= await browser.createBrowserContext()
  const tab = await context.newPage()
  tab.on('pageerror', (error) => problems.push(error.message))
  await tab.setViewport({ width: 1280, height: 900 })
  await tab.evaluateOnNewDocument(() => {
    globalThis.copied = ''
    Object.defineProperty(navigator, 'clipboard', { value: { writeText: async (text) => { globalThis.copied = text } } })
    // Microphones that take a moment to be had, and which of them hear.
    globalThis.streams = []
    const ask = navigator.mediaDevices?.getUserMedia.bind(navigator.mediaDevices)
    if (ask) navigator.mediaDevices.getUserMedia = async (wanted) => {
      await new Promise((resolve) => setTimeout(resolve, 300))
      const stream = await ask(wanted)
      globalThis.streams.push(stream)
      return stream
    }
    globalThis.hearing = () => globalThis.streams.flatMap((stream) => stream.getTracks()).filter(({ readyState }) => readyState === 'live').length
    // What is saved.
    globalThis.saved = []
    URL.createObjectURL = ((make) => (blob) => { globalThis.saved.push(blob); return make.call(URL, blob) })(URL.createObjectURL)
    HTMLAnchorElement.prototype.click = () => {}
  })
  await tab.evaluateOnNewDocument(prepare)
  await tab.goto(address)
  await tab.waitForFunction(() => document.querySelectorAll('#format option').length > 10)
  const text = (id) => tab.$eval(`#${id}`, (element) => element.textContent)
  const number = (id) => tab.$eval(`#${id}`, (element) => Number(element.value))
  const settled = () => until(async () => /^Analysed/.test(await text('status')) && (await text('figures')).includes('bytes packed'))
  const drop = (file, name, after = 0) => tab.evaluate((base64, name, after) => {
    const one = new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name), data = new DataTransfer()
    data.items.add(one)
    // A disk that takes its time.
    const read = File.prototype.arrayBuffer
    if (after > 0) globalThis.slow = { ...globalThis.slow, [name]: after }
    File.prototype.arrayBuffer = async function () {
      await new Promise((resolve) => setTimeout(resolve, globalThis.slow?.[this.name] ?? 0))
      return read.call(this)
    }
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }))
    setTimeout(() => { File.prototype.arrayBuffer = read }, 0)
  }, readFileSync(file).toString('base64'), name, after)
  const clip = async () => { // as it is saved
    await tab.select('#format', 'json')
    const had = await tab.evaluate(() => globalThis.saved.length)
    await tab.$eval('#save', (button) => button.click())
    await until(() => tab.evaluate((had) => globalThis.saved.length > had, had))
    return JSON.parse(await tab.evaluate(() => globalThis.saved.at(-1).text()))
  }
  const turn = async (id, value) => {
    await tab.$eval('#status', (status) => { status.textContent = '' })
    await tab.$eval(`#${id}`, (input, value) => {
      input.dispatchEvent(new PointerEvent('pointerdown'))
      input.value = value
      input.dispatchEvent(new Event('input', { bubbles: true }))
    }, String(value))
    return settled()
  }
  const put = (id, value) => tab.$eval(`#${id}`, (input, value) => { input.value = value; input.dispatchEvent(new Event('change', { bubbles: true })) }, String(value))
  const addEvent = async (time) => {
    await tab.$eval('#edit', (details) => { details.open = true })
    await tab.select('#lane', 'events')
    await tab.$eval('#add', (button) => button.click())
    await put('time', time)
    await put('amplitude', 0.77)
    await put('sharpness', 0.33)
  }
  const shown = () => until(async () => (await text('figures')).includes('bytes packed'))
  const reload = async () => {
    await wait(500) // what is asked of the disk is done
    await tab.goto('about:blank')
    await tab.goto(address)
    return shown()
  }
  const name = () => tab.$eval('#lanes', (canvas) => canvas.getAttribute('aria-label')?.split(':')[0])
  const hasSound = () => tab.$eval('#play-sound', (button) => !button.disabled)
  return { tab, context, text, number, settled, drop, clip, turn, put, addEvent, shown, reload, name, hasSound }
}
const isAdded = ({ amplitude, sharpness }) => Math.abs(amplitude - 0.77) < 1e-6 && Math.abs(sharpness - 0.33) < 1e-6
const press = async ({ tab }, key, ...held) => {
  for (const one of held) await tab.keyboard.down(one)
  await tab.keyboard.press(key)
  for (const one of held.reverse()) await tab.keyboard.up(one)
}

try {
  await until(async () => (await fetch(place).catch(() => undefined))?.ok)

  // ---- layers
  const main = await open()
  const { tab } = main
  await main.drop(sound, 'knock.wav')
  await main.settled()
  const fresh = await main.clip()
  await main.addEvent(0.123)
  await tab.select('#lane', 'total')
  await tab.focus('#lanes')
  for (let i = 0; i < 3; ++i) await press(main, 'ArrowRight')
  await main.put('amplitude', 0.9)
  const at = await main.number('time')
  check('an event and a point are set by hand', (await main.clip()).transients.some(isAdded))
  await main.turn('bands', 8)
  const turned = await main.clip()
  check('a knob keeps an event that was added by hand', turned.encoder.bands === 8 && turned.bands.length <= 8 && turned.transients.some(isAdded) && turned.transients.length === fresh.transients.length + 1,
    `${turned.transients.length} events, ${fresh.transients.length} by the analysis`)
  check('and a point', turned.envelope.some(({ time, amplitude }) => Math.abs(time - at) < 0.01 && Math.abs(amplitude - 0.9) < 1e-3))
  await main.turn('bands', 5)
  await main.turn('sensitivity', 4)
  check('also the next ones', (await main.clip()).transients.filter(isAdded).length === 1)
  // A band that is not there any more: its edit waits for one that is.
  await main.turn('bands', 12)
  await tab.select('#lane', '9')
  await tab.focus('#lanes')
  await press(main, 'ArrowRight')
  const { length: points } = (await main.clip()).bands[9].amplitude
  check('a band has points to edit', points > 2, `${points}`)
  await main.put('amplitude', 0.91)
  const hasPoint = ({ bands }) => bands.some(({ amplitude }) => amplitude.some((point) => Math.abs(point.amplitude - 0.91) < 1e-6))
  check('a point of a band is set', hasPoint(await main.clip()))
  await main.turn('breakpoints', 30)
  check('and outlives a knob', hasPoint(await main.clip()))

  // ---- undo and knobs
  const before = await main.number('breakpoints')
  await tab.$eval('#undo', (button) => button.click())
  check('after Undo a knob stands where the clip has it', before === 30 && await until(async () => await main.number('breakpoints') === 20), `${await main.number('breakpoints')}`)
  await main.turn('bands', 6)
  const next = await main.clip()
  check('and the next turn takes that', next.encoder.bands === 6 && next.encoder.breakpoints === 20, JSON.stringify(next.encoder))
  // A preset is what the encoder has under that name; knobs go on from there.
  const preset = async (page) => page.tab.$eval('#preset', ({ value }) => value)
  await tab.$eval('#status', (status) => { status.textContent = '' })
  await tab.select('#preset', 'low-rumble')
  await main.settled()
  const { encoder: rumble } = await main.clip()
  check('a preset sets knobs and what no knob shows', rumble.bands === 8 && rumble.low === 20 && rumble.high === 300 && rumble.audible === 0 &&
    await main.number('bands') === 8 && await preset(main) === 'low-rumble', JSON.stringify(rumble))
  await main.turn('bands', 9)
  const { encoder: turnedOn } = await main.clip()
  check('a knob keeps the rest of a preset', turnedOn.bands === 9 && turnedOn.low === 20 && turnedOn.audible === 0 && await preset(main) === '',
    JSON.stringify(turnedOn))
  await tab.$eval('#undo', (button) => button.click())
  await until(async () => await preset(main) === 'low-rumble')
  await tab.$eval('#undo', (button) => button.click())
  check('Undo takes both back', await until(async () => await main.number('bands') === 6 && await preset(main) === ''), await preset(main))
  await tab.select('#profile', 'lra-175')
  await tab.$eval('#strength', (input) => { input.value = 0.8; input.dispatchEvent(new Event('input', { bubbles: true })) })
  await wait(500)
  await main.reload()
  check('after a reload too', await until(async () => await main.number('bands') === 6 && await main.number('sensitivity') === 4) &&
    await main.number('strength') === 0.8 && await tab.$eval('#profile', ({ value }) => value) === 'lra-175',
  `${await main.number('bands')}, ${await main.number('sensitivity')}, ${await main.number('strength')}`)
  check('the edits are there', (await main.clip()).transients.some(isAdded))
  await main.turn('bands', 7)
  const resumed = await main.clip()
  check('and outlive the next turn', resumed.encoder.bands === 7 && resumed.encoder.sensitivity === 4 && resumed.transients.some(isAdded))
  // Undo while an analysis runs: it is what Undo gives.
  await tab.$eval('#bands', (input) => { input.value = 20; input.dispatchEvent(new Event('input', { bubbles: true })) })
  await tab.$eval('#undo', (button) => button.click())
  await wait(1500)
  check('an analysis that was undone does not come', (await main.clip()).encoder.bands === 6 && await main.number('bands') === 6, `${await main.number('bands')}`)
  // An edit while an analysis runs is kept.
  await tab.$eval('#bands', (input) => { input.value = 9; input.dispatchEvent(new Event('input', { bubbles: true })) })
  await main.addEvent(0.31)
  await until(async () => (await main.clip()).encoder.bands === 9)
  check('an edit while an analysis runs is kept', (await main.clip()).transients.filter(isAdded).length === 2)

  // ---- links
  const address = tab.url()
  await tab.$eval('#share', (button) => button.click())
  await until(() => tab.evaluate(() => globalThis.copied !== ''))
  const link = await tab.evaluate(() => globalThis.copied)
  check('a link is copied and one\'s own address stays', link.includes('#c=') && tab.url() === address, tab.url())
  await main.addEvent(0.4)
  await main.reload()
  const after = await main.clip()
  check('an edit after that is there after a reload', after.transients.filter(isAdded).length === 3 && await main.hasSound())
  // Somebody's link, opened where there is work.
  const linkOf = async (json) => {
    writeFileSync(join(folder, 'link.json'), JSON.stringify(json))
    execFileSync(program, ['convert', 'link.json', '-o', 'link.pacb', '-q', '-y'], { cwd: folder })
    return `http://127.0.0.1:${port}/?fresh#c=${readFileSync(join(folder, 'link.pacb')).toString('base64url')}`
  }
  // The sound of the work comes later than the clip of the link.
  const hasty = await open(main.context, await linkOf(fresh), () => {
    const post = Worker.prototype.postMessage
    Worker.prototype.postMessage = function (...what) {
      setTimeout(() => post.apply(this, what), what[0].name === 'mono' ? 1500 : 0)
    }
  })
  await wait(4000)
  check('a link is what is shown, also when the sound of the work comes late', await hasty.name() === 'shared', await hasty.name())
  await hasty.tab.close()
  const theirs = await open(main.context, await linkOf({ ...fresh, name: 'theirs' }))
  await theirs.shown()
  check('a link is opened', await until(async () => await theirs.name() === 'shared' && !theirs.tab.url().includes('#c=')), theirs.tab.url())
  await theirs.addEvent(0.2)
  await wait(500)
  for (let i = 0; i < 3; ++i) {
    await theirs.tab.reload()
    await theirs.shown()
  }
  check('an edit of what it held is there after reloads', await theirs.name() === 'shared' && (await theirs.clip()).transients.some(isAdded))
  const works = () => theirs.tab.$$eval('#works option', (options) => options.map(({ text, value }) => ({ text, value })))
  const own = (await works()).find(({ text }) => text.startsWith('knock'))
  check('and one\'s own work can be gone on with', own !== undefined, (await works()).map(({ text }) => text).join('; '))
  if (own) {
    await theirs.tab.select('#works', own.value)
    await theirs.tab.$eval('#open-work', (button) => button.click())
    check('with its edits and its sound', await until(async () => await theirs.name() === 'knock') && (await theirs.clip()).transients.filter(isAdded).length === 3 && await theirs.hasSound())
  }

  // ---- two tabs
  const second = await open(main.context)
  await second.shown()
  await second.drop(otherSound, 'other.wav')
  await second.settled()
  await second.addEvent(0.05)
  await main.addEvent(0.45)
  await second.addEvent(0.06)
  await main.reload()
  await second.reload()
  const clips = [await main.clip(), await second.clip()]
  check('each tab has its own clip after a reload', await main.name() === 'knock' && await second.name() === 'other' &&
    clips[0].transients.filter(isAdded).length === 4 && clips[1].transients.filter(isAdded).length === 2)
  // With its own sound: what the knobs analyse is as long as it was.
  await main.turn('bands', 4)
  await second.turn('bands', 4)
  check('and its own sound', (await main.clip()).duration === clips[0].duration && (await second.clip()).duration === clips[1].duration && clips[0].duration !== clips[1].duration)
  const copy = await open(main.context)
  await copy.shown()
  const [had] = [await copy.name()]
  await copy.addEvent(0.07)
  await wait(500)
  await second.reload()
  check('a copy of what another tab has leaves that alone', had === 'other' && (await second.clip()).transients.filter(isAdded).length === 2)
  for (const { tab } of [theirs, second, copy]) await tab.close()

  // ---- what is dropped last counts
  await main.drop(otherSound, 'slow.wav', 1500)
  await main.drop(sound, 'quick.wav')
  await until(async () => await main.name() === 'quick')
  await wait(2500)
  check('a file dropped first and read last does not win', await main.name() === 'quick', await main.name())
  await main.drop(otherSound, 'first.wav')
  writeFileSync(join(folder, 'clip.json'), JSON.stringify(fresh))
  await main.drop(join(folder, 'clip.json'), 'last.json')
  await until(async () => await main.name() === 'last')
  await wait(1500)
  check('nor a sound that is still analysed', await main.name() === 'last', await main.name())
  check('nothing waits', !(await main.text('status')).includes('...'), await main.text('status'))
  const early = await open(main.context, place, () => {
    // A disk that is slow to say what was kept.
    const get = IDBFactory.prototype.open
    IDBFactory.prototype.open = function (...parameters) {
      const request = get.apply(this, parameters)
      let handler
      Object.defineProperty(request, 'onsuccess', { set: (given) => { handler = given } })
      request.addEventListener('success', (event) => setTimeout(() => handler?.call(request, event), 1500))
      return request
    }
  })
  await early.drop(sound, 'early.wav')
  await until(async () => await early.name() === 'early')
  await wait(2500)
  check('nor what was kept before', await early.name() === 'early', await early.name())
  await early.tab.close()

  // ---- what an older page has kept
  const old = await browser.createBrowserContext()
  const blank = await old.newPage()
  await blank.goto(`http://127.0.0.1:${port}/style.css`)
  await blank.evaluate((clip) => new Promise((resolve, reject) => {
    const request = indexedDB.open('pacini', 1)
    request.onupgradeneeded = () => {
      const documents = request.result.createObjectStore('documents')
      documents.put({ name: 'kept', source: 'kept.wav', clip }, 'current')
      documents.put({ samples: new Float32Array(20000).map((_, n) => Math.sin(n / 30) * Math.exp(-n / 3000)), sampleRate: 44100 }, 'sound')
    }
    request.onsuccess = () => { request.result.close(); resolve() }
    request.onerror = () => reject(request.error)
  }), fresh)
  await blank.close()
  const older = await open(old)
  check('what an older page has kept is there', await until(async () => await older.name() === 'kept') && await older.hasSound())
  await older.reload()
  check('and stays', await older.name() === 'kept' && await older.hasSound())
  await older.tab.close()

  // ---- the microphone
  const heard = () => tab.evaluate(() => globalThis.hearing())
  const pressed = (id) => tab.$eval(`#${id}`, (button) => button.getAttribute('aria-pressed'))
  for (const id of ['live', 'record']) {
    await tab.$eval(`#${id}`, (button) => { button.click(); button.click() })
    await wait(1000)
    check(`a double click on ${id} leaves no microphone on`, await heard() === 0 && await pressed(id) === 'false', `${await heard()} on, pressed: ${await pressed(id)}`)
  }
  for (const [what, end] of [['Stop', () => tab.$eval('#stop', (button) => button.click())], ['Escape', () => tab.keyboard.press('Escape')]]) {
    await tab.$eval('#live', (button) => button.click())
    check(`live hears (${what})`, await until(async () => (await main.text('feel-status')).includes('ms late')) && await heard() === 1)
    await end()
    check(`${what} ends it`, await heard() === 0 && await pressed('live') === 'false')
    await tab.$eval('#live', (button) => button.click())
    await end()
    await wait(800)
    check(`${what} ends it before it begins`, await heard() === 0 && await pressed('live') === 'false')
    await tab.$eval('#record', (button) => button.click())
    await until(async () => await heard() === 1)
    await wait(1200)
    await end()
    check(`${what} ends a recording, which is kept`, await until(async () => await main.name() === 'recording') && await heard() === 0 && await pressed('record') === 'false')
    await main.drop(sound, 'knock.wav')
    await until(async () => await main.name() === 'knock')
  }

  // ---- a phone that scrolls
  const phone = await open(main.context)
  await phone.tab.emulate({ viewport: { width: 390, height: 844, hasTouch: true, isMobile: true }, userAgent: await browser.userAgent() })
  await phone.tab.goto(place)
  await phone.shown()
  await phone.drop(sound, 'swiped.wav')
  await phone.settled()
  await phone.tab.select('#lane', 'total')
  await wait(300)
  const before4 = JSON.stringify(await phone.clip())
  const touch = await phone.tab.createCDPSession()
  const swipe = async (x, y, dx, dy, steps = 12) => {
    const at = (i) => [{ x: x + dx * i / steps, y: y + dy * i / steps }]
    await touch.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: at(0) })
    for (let i = 1; i <= steps; ++i) await touch.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: at(i) })
    await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] })
    await wait(200)
  }
  /** Where points of the total are, in the middle of the window. */
  const spots = async () => {
    await phone.tab.$eval('#lanes', (canvas) => canvas.scrollIntoView({ block: 'center' }))
    const { envelope, duration } = await phone.clip()
    const { x, y, width, height } = await phone.tab.$eval('#lanes', (canvas) => canvas.getBoundingClientRect().toJSON())
    return envelope.map(({ time, amplitude }) => ({ x: x + 8 + time / duration * (width - 16), y: y + height * (0.205 + (1 - amplitude) * 0.245) }))
  }
  const all = await spots()
  let scrolled = 0
  for (const { x, y } of [all[0], ...all.filter((_, i) => i % 5 === 2)]) {
    for (const [dx, dy] of [[0, -150], [4, 150], [-60, -10], [60, 6]]) {
      await spots()
      const from = await phone.tab.evaluate(() => scrollY)
      await swipe(x, y, dx, dy)
      if (await phone.tab.evaluate(() => scrollY) !== from) ++scrolled
    }
  }
  check('a swipe over the curve edits nothing', JSON.stringify(await phone.clip()) === before4)
  check('and scrolls', scrolled > 5, `${scrolled}`)
  const middle = (await spots())[Math.floor(all.length / 2)]
  await swipe(middle.x, middle.y, 0, 0, 1)
  const chosen = await phone.text('selected')
  check('a tap selects a point', /^Point \d+ of/.test(chosen), chosen)
  const was = await phone.number('amplitude')
  const here = await spots(), index = Number(chosen.match(/\d+/)[0]) - 1
  await swipe(here[index].x, here[index].y, 0, 40)
  check('which a finger then moves', await phone.number('amplitude') < was - 0.1, `${was} to ${await phone.number('amplitude')}`)
  const knobs = JSON.stringify(await phone.tab.$$eval('input[type=range]', (inputs) => inputs.map(({ value }) => value)))
  for (const id of ['strength', 'bands', 'breakpoints', 'sensitivity']) {
    const box = await phone.tab.$eval(`#${id}`, (input) => { input.scrollIntoView({ block: 'center' }); return input.getBoundingClientRect().toJSON() })
    await swipe(box.x + 0.8 * box.width, box.y + box.height / 2, 3, -160)
    await phone.tab.$eval(`#${id}`, (input) => input.scrollIntoView({ block: 'center' }))
    await swipe(box.x + 0.2 * box.width, box.y + box.height / 2, -3, 160)
  }
  check('a swipe over the knobs turns none', JSON.stringify(await phone.tab.$$eval('input[type=range]', (inputs) => inputs.map(({ value }) => value))) === knobs, knobs)
  await phone.tab.close()
  await tab.$eval('#edit', (details) => { details.open = true })
  await tab.select('#lane', 'total')
  const clipBefore = JSON.stringify(await main.clip())
  for (const id of ['time', 'amplitude']) {
    await tab.focus(`#${id}`)
    const box = await tab.$eval(`#${id}`, (input) => { input.scrollIntoView({ block: 'center' }); return input.getBoundingClientRect().toJSON() })
    await tab.mouse.move(box.x + 20, box.y + 10)
    for (let i = 0; i < 3; ++i) await tab.mouse.wheel({ deltaY: 100 })
    await wait(200)
    await tab.keyboard.press('Tab')
  }
  check('a wheel over a number that has the focus edits nothing', JSON.stringify(await main.clip()) === clipBefore)

  // ---- a link that states a day
  const flat = (value) => [{ time: 0, amplitude: value }, { time: 86400, amplitude: value }]
  const day = await linkOf({
    ...fresh, name: 'day', duration: 86400, envelope: flat(0.5), transients: [], centroid: undefined, noise: undefined, encoder: undefined, markers: undefined,
    bands: fresh.bands.slice(0, 2).map((band) => ({ ...band, pitch: undefined, amplitude: flat(0.5) }))
  })
  const started = Date.now()
  const long = await open(undefined, day)
  const told = await until(async () => (await long.text('figures')).includes('86,400.00 s'), 60)
  const took = (Date.now() - started) / 1000
  check('a link that states a day is told to be long', told && (await long.text('figures')).includes('first 20 minutes'), `${day.length} characters; ${await long.text('figures')}`)
  // A figure, not a bar, but for what would be a minute of a fast machine.
  check('and is open soon', took < 30, `${took.toFixed(1)} s`)
  const kept = await long.clip()
  check('files hold all of it', kept.duration === 86400)
  await long.tab.evaluate(() => { navigator.getGamepads = () => [{ id: 'pad', vibrationActuator: { playEffect: async () => {}, reset: async () => {} } }] })
  const asked = Date.now()
  await long.tab.$eval('#feel', (button) => button.click())
  await long.tab.evaluate(() => new Promise((resolve) => setTimeout(resolve, 0)))
  check('feeling it begins at once', Date.now() - asked < 5000, `${Date.now() - asked} ms`)
  await long.tab.$eval('#stop', (button) => button.click())
  const slow = []
  for (const format of await long.tab.$$eval('#format option', (options) => options.map(({ value }) => value))) {
    const begun = Date.now()
    await long.tab.$eval('#losses', (line) => { line.textContent = '' })
    await long.tab.select('#format', format)
    if (!await until(async () => (await long.text('losses')) !== '', 10)) slow.push(format)
    if (Date.now() - begun > 2000) console.log(`     ${format}: ${((Date.now() - begun) / 1000).toFixed(1)} s, ${await long.text('error')}`)
  }
  check('every format says what it would lose of it', slow.length === 0, slow.join(' '))
  await long.tab.close()

  // ---- nothing that is not the page's own
  for (const file of ['', 'guide.html']) {
    const guarded = await browser.newPage()
    await guarded.goto(`http://127.0.0.1:${port}/${file}?fresh`)
    const ran = await guarded.evaluate(async () => {
      const script = document.createElement('script')
      script.textContent = 'globalThis.injected = true'
      document.body.append(script)
      const picture = document.createElement('div')
      picture.innerHTML = '<img src="none" onerror="globalThis.injected = true">'
      document.body.append(picture)
      const elsewhere = await fetch('http://127.0.0.2:9/', { mode: 'no-cors' }).then(() => true, (error) => error.message)
      const violated = []
      addEventListener('securitypolicyviolation', ({ effectiveDirective }) => violated.push(effectiveDirective))
      await fetch('http://127.0.0.2:9/', { mode: 'no-cors' }).catch(() => {})
      setTimeout('globalThis.injected = true', 0)
      await new Promise((resolve) => setTimeout(resolve, 500))
      return { injected: globalThis.injected === true, violated, elsewhere }
    })
    check(`the policy of /${file} lets nothing in`, !ran.injected && ran.violated.includes('connect-src'), JSON.stringify(ran))
    await guarded.close()
  }

  if (pictures) {
    await tab.$$eval('details', (all) => all.forEach((one) => { one.open = true }))
    await tab.$eval('#share', (button) => button.click())
    for (const width of [360, 768, 1440]) {
      await tab.setViewport({ width, height: 900 })
      await wait(500)
      await tab.screenshot({ path: join(pictures, `work-${width}.png`), fullPage: true })
      check(`nothing is wider than ${width}`, await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth))
    }
  }
  check('nothing went wrong unseen', problems.length === 0, problems.join('\n'))
} finally {
  await tidyUp(folder, browser, server)
}
process.exit(failures() ? 1 : 0)
