// The page in headless Chromium: a sound is dropped, changed, felt by a controller that records, exported and shared; a
// reload keeps it, also without a network; nothing leaves the page's own place; axe finds nothing.
//
// check_page.mjs PAGE MODULES PACINI LIVE SOUND.wav [PICTURES]    PAGE: the built folder; MODULES: the folder with
// puppeteer-core and axe-core; LIVE: pacini_live_reference; PICTURES: a folder for pictures in three sizes. Exit 0, 1 on a
// failed check.
import { execFileSync } from 'node:child_process'
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'

import { check, failures, launch, serve, tidyUp, until, wait } from './browser.mjs'

const [page, modules, program, live, sound, pictures] = process.argv.slice(2)
const folder = mkdtempSync(join(tmpdir(), 'pacini-page-'))
const port = 20000 + process.pid % 20000
const place = `http://127.0.0.1:${port}/`
let server = serve(page, port)
const axe = readFileSync(join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8') // a tag of it is against the page's policy

const browser = await launch(modules, ['--autoplay-policy=no-user-gesture-required', '--use-fake-device-for-media-stream',
  '--use-fake-ui-for-media-stream'], { userDataDir: join(folder, 'profile') })
try {
  await until(async () => (await fetch(place).catch(() => undefined))?.ok)
  const tab = await browser.newPage()
  const elsewhere = [], problems = []
  tab.on('request', (request) => { if (!request.url().startsWith(place) && !/^(data|blob):/.test(request.url())) elsewhere.push(request.url()) })
  tab.on('pageerror', (error) => problems.push(error.message))
  tab.on('console', (message) => { if (message.type() === 'error') problems.push(message.text()) })
  // A controller that writes down what it is told.
  await tab.evaluateOnNewDocument(() => {
    globalThis.rumbles = []
    const pad = {
      id: 'Test pad (Vendor: 0000)', index: 0, connected: true, buttons: [], axes: [],
      vibrationActuator: {
        playEffect: async (kind, effect) => { globalThis.rumbles.push({ kind, ...effect }); return 'complete' },
        reset: async () => { globalThis.rumbles.push({ kind: 'reset' }); return 'complete' }
      }
    }
    navigator.getGamepads = () => [pad]
    // A DualSense on a cable, which is there once it is chosen.
    globalThis.reports = []
    const dualSense = {
      vendorId: 0x054c, productId: 0x0ce6, productName: 'Test DualSense', opened: false,
      collections: [{ outputReports: [{ reportId: 2 }] }],
      open: async () => { dualSense.opened = true },
      sendReport: async (id, data) => { globalThis.reports.push({ at: performance.now(), id, bytes: [...data] }) },
      sendFeatureReport: async () => {}
    }
    Object.defineProperty(navigator, 'hid', { value: {
      requestDevice: async ({ filters }) => filters.some(({ vendorId }) => vendorId === 0x054c) ? [dualSense] : [],
      getDevices: async () => [], addEventListener: () => {}
    } })
    globalThis.copied = ''
    Object.defineProperty(navigator, 'clipboard', { value: { writeText: async (text) => { globalThis.copied = text } } })
  })
  const downloads = join(folder, 'saved')
  mkdirSync(downloads)
  const session = await tab.createCDPSession()
  await session.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: downloads })
  const text = (id) => tab.$eval(`#${id}`, (element) => element.textContent)
  const drop = async (bytes, name) => tab.evaluate((base64, name) => {
    const data = new DataTransfer()
    data.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name))
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }))
  }, Buffer.from(bytes).toString('base64'), name)
  const analysed = () => until(async () => (await text('status')).startsWith('Analysed') && (await text('figures')).includes('bytes packed'))

  await tab.setViewport({ width: 1280, height: 900 })
  await tab.goto(place)
  check('the page is there', await until(() => tab.evaluate(() => document.querySelectorAll('#format option').length > 10)))
  const interactive = await tab.evaluate(() => performance.getEntriesByType('navigation')[0].domInteractive)
  console.log(`     interactive after ${interactive.toFixed(0)} ms`) // a busy machine has its own

  const bytes = readFileSync(sound)
  await drop(bytes, 'knock.wav')
  check('a dropped sound is analysed', await analysed(), await text('figures'))
  if (failures()) console.log(problems, await text('error'), await text('status'))

  // Export: the bytes of the program.
  const save = async (format, extension, name = 'knock') => {
    await tab.select('#format', format)
    await wait(300)
    for (const file of readdirSync(downloads)) rmSync(join(downloads, file))
    await tab.click('#save')
    const path = join(downloads, `${name}${extension}`)
    return await until(() => existsSync(path) && readdirSync(downloads).every((file) => !file.endsWith('.crdownload'))) ? readFileSync(path) : undefined
  }
  // The page's knobs say what the program does by itself.
  execFileSync(program, ['encode', sound, '-o', 'knock.pacb', '-q', '-y'], { cwd: folder })
  writeFileSync(join(folder, 'knock.wav'), bytes)
  execFileSync(program, ['encode', 'knock.wav', '-o', 'knock.pacb', '-q', '-y'], { cwd: folder })
  execFileSync(program, ['convert', 'knock.pacb', '-o', 'knock.ahap', '--profile', 'l5-wristband', '-q', '-y'], { cwd: folder })
  const packed = await save('packed', '.pacb')
  check('the saved clip is that of the program', packed && Buffer.compare(packed, readFileSync(join(folder, 'knock.pacb'))) === 0, `${packed?.length} bytes`)
  const ahap = await save('ahap', '.ahap')
  check('and so is an AHAP', ahap && Buffer.compare(ahap, readFileSync(join(folder, 'knock.ahap'))) === 0)

  // Feel.
  await tab.click('#feel')
  check('a controller feels it', await until(() => tab.evaluate(() => globalThis.rumbles.some(({ kind }) => kind === 'reset'))))
  const rumbles = await tab.evaluate(() => globalThis.rumbles.filter(({ kind }) => kind === 'dual-rumble'))
  check('with both motors', rumbles.some(({ strongMagnitude }) => strongMagnitude > 0.1) && rumbles.some(({ weakMagnitude }) => weakMagnitude > 0.1) &&
    rumbles.every(({ strongMagnitude, weakMagnitude }) => strongMagnitude <= 1 && weakMagnitude <= 1), `${rumbles.length} commands`)

  // A controller by its own reports: those that the program lists, at their times; alone, as the clock of a sound begins later.
  await tab.click('#with-sound')
  await tab.click('#controller')
  check('a controller is chosen', await until(async () => (await text('feel-status')).includes('Test DualSense')))
  await tab.click('#feel')
  const listed = JSON.parse(execFileSync(program, ['play', 'knock.pacb', '--dry-run', '--like', 'dualsense', '--json'], { cwd: folder, encoding: 'utf8' })).packets
  await until(() => tab.evaluate((count) => globalThis.reports.length >= count, listed.length))
  const sent = await tab.evaluate(() => globalThis.reports)
  const hex = ({ id, bytes }) => Buffer.from([id, ...bytes]).toString('hex')
  check('its reports are those of the program', sent.length === listed.length && sent.every((report, i) => hex(report) === listed[i].bytes.replaceAll(' ', '').toLowerCase()),
    `${sent.length} and ${listed.length}`)
  // Counted from the earliest that the clip can have begun: on a busy machine the first report may be late itself.
  const begins = sent.map(({ at }, i) => at - 1000 * listed[i].time)
  const late = begins.map((begin) => begin - Math.min(...begins))
  const takes = sent.at(-1).at - sent[0].at
  check('in their order and time', sent.every(({ at }, i) => i === 0 || at >= sent[i - 1].at) && takes > 250 * (listed.at(-1).time - listed[0].time),
    `${takes.toFixed(0)} ms, at most ${Math.max(...late).toFixed(1)} ms late`)
  await tab.evaluate(() => { globalThis.reports = [] })
  await tab.click('#feel')
  // By the page itself: on a busy machine a click from here comes when all of the clip is over.
  await tab.evaluate(() => new Promise((resolve) => {
    const look = () => {
      if (globalThis.reports.length <= 5) return setTimeout(look, 5)
      document.getElementById('stop').click()
      resolve()
    }
    look()
  }))
  await wait(300)
  const stopped = await tab.evaluate(() => globalThis.reports)
  const silent = listed.at(-2).bytes.replaceAll(' ', '').toLowerCase()
  check('stopped, it is silent', stopped.length < listed.length && hex(stopped.at(-1)) === silent, `${stopped.length} reports`)

  // Editing: by the keyboard, by the pointer, by the numbers, and back.
  const number = (id) => tab.$eval(`#${id}`, (element) => Number(element.value))
  await tab.$eval('#edit', (element) => { element.open = true })
  await tab.select('#lane', 'total')
  await tab.focus('#lanes')
  for (let i = 0; i < 3; ++i) await tab.keyboard.press('ArrowRight')
  check('a point is chosen by the keyboard', (await text('selected')).startsWith('Point 4 of'), await text('selected'))
  const was = await number('amplitude'), wasTime = await number('time')
  await tab.keyboard.press('ArrowUp')
  await tab.keyboard.press('ArrowUp')
  check('and moved', Math.abs(await number('amplitude') - was - 0.04) < 0.002, `${was} to ${await number('amplitude')}`)
  await tab.keyboard.down('Control')
  await tab.keyboard.press('z')
  await tab.keyboard.up('Control')
  check('one step is undone', await until(async () => Math.abs(await number('amplitude') - was) < 1e-9), `${await number('amplitude')}`)
  const box = await (await tab.$('#lanes')).boundingBox()
  const spot = await tab.$eval('#lanes', (canvas, time, amplitude, duration) => [8 + time / duration * (canvas.clientWidth - 16),
    canvas.clientHeight * (0.205 + (1 - amplitude) * 0.245)], wasTime, was, parseFloat(await text('figures')))
  await tab.mouse.move(box.x + spot[0], box.y + spot[1])
  await tab.mouse.down()
  await tab.mouse.move(box.x + spot[0] + 1, box.y + spot[1] + 20, { steps: 4 })
  await tab.mouse.up()
  const dragged = await number('amplitude')
  check('a point is dragged', dragged < was - 0.05 && (await text('selected')).startsWith('Point 4'), `${was} to ${dragged}`)
  await tab.select('#lane', 'events')
  const events = (await text('selected')).match(/of (\d+)/)?.[1]
  await tab.$eval('#time', (input) => { input.value = '0.1'; input.dispatchEvent(new Event('change', { bubbles: true })) })
  await tab.click('#add')
  check('an event is added', await until(async () => (await text('figures')).includes(`${Number(events) + 1} events`)), await text('figures'))
  const edited = await save('json', '.json')
  const clip = JSON.parse(edited)
  check('an edited clip is saved as it is', clip.transients.length === Number(events) + 1 && Math.abs(clip.envelope[3].amplitude - dragged) < 0.001, `${clip.transients.length} events, ${clip.envelope[3].amplitude}`)
  writeFileSync(join(folder, 'edited.json'), edited)
  execFileSync(program, ['convert', 'edited.json', '-o', 'edited.pacb', '-q', '-y'], { cwd: folder })
  const editedPacked = await save('packed', '.pacb')
  check('packed as the program packs it', editedPacked && Buffer.compare(editedPacked, readFileSync(join(folder, 'edited.pacb'))) === 0, `${editedPacked?.length} bytes`)
  check('and the program reads it', execFileSync(program, ['info', 'edited.json', '--strict', '-q'], { cwd: folder, encoding: 'utf8' }).length > 0)
  for (let i = 0; i < 8; ++i) await tab.$eval('#undo', (button) => button.click()).then(() => wait(150))
  check('all is undone', Buffer.compare(await save('packed', '.pacb') ?? Buffer.alloc(0), packed) === 0)

  // All formats as one archive, which another program unpacks.
  for (const file of readdirSync(downloads)) rmSync(join(downloads, file))
  await tab.click('#save-all')
  await until(() => existsSync(join(downloads, 'knock.zip')), 60)
  await wait(300)
  execFileSync('python3', ['-c', 'import zipfile; z = zipfile.ZipFile("saved/knock.zip"); assert z.testzip() is None; z.extractall("unzipped")'], { cwd: folder })
  check('a ZIP holds all formats', readdirSync(join(folder, 'unzipped/knock')).length > 15 &&
    Buffer.compare(readFileSync(join(folder, 'unzipped/knock/ahap/knock.ahap')), readFileSync(join(folder, 'knock.ahap'))) === 0,
  `${readdirSync(join(folder, 'unzipped/knock')).length} formats; ${await text('losses')}`)

  // A spectrogram, and how close the clip is.
  const colours = () => tab.$eval('#lanes', (canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, Math.round(canvas.height * 0.16))
    return new Set(Array.from({ length: data.length / 4 }, (_, i) => data[4 * i] << 16 | data[4 * i + 1] << 8 | data[4 * i + 2])).size
  })
  const plain = await colours()
  await tab.click('#spectrogram')
  check('a spectrogram is shown', await until(async () => (await colours()) > plain + 50), `${plain} and ${await colours()} colours`)
  await tab.$eval('#comparison', (details) => { details.open = true })
  await until(() => tab.$eval('#measures', (table) => !table.hidden))
  execFileSync(program, ['render', 'knock.pacb', '-o', 'flat.wav', '-q', '-y'], { cwd: folder })
  const measured = JSON.parse(execFileSync(program, ['compare', 'knock.wav', 'flat.wav', '--json'], { cwd: folder, encoding: 'utf8' }))
  const told = await tab.$eval('#measures td', (cell) => parseFloat(cell.textContent))
  const own = JSON.stringify(measured).match(/"hts":\s*([\d.]+)/)?.[1]
  check('measures are those of the program', Math.abs(told - Number(own)) < 0.5, `HTS ${told}, ${own}`)
  await tab.$eval('#comparison', (details) => { details.open = false })
  await tab.click('#spectrogram')

  // Knobs.
  const before = await text('figures')
  await tab.$eval('#breakpoints', (input) => { input.value = '4'; input.dispatchEvent(new Event('input', { bubbles: true })) })
  check('a knob analyses again', await until(async () => (await text('figures')) !== before && (await text('status')).startsWith('Analysed')), await text('figures'))
  await tab.select('#profile', 'erm-coin')
  await wait(500)

  // The clip's name, which its files have; a step as any other.
  const named = async (name) => {
    await tab.$eval('#name', (input, value) => { input.value = value; input.dispatchEvent(new Event('change')) }, name)
    return until(() => tab.$eval('#undo', ({ title }) => title === 'Rename'))
  }
  check('a clip is renamed', await named('my knock') && JSON.parse(await save('json', '.json', 'my knock')).name === 'my knock')
  await tab.click('#undo')
  check('and that is undone', await until(() => tab.$eval('#name', ({ value }) => value === 'knock')))

  // A link that holds the clip.
  await tab.click('#share')
  await until(() => tab.evaluate(() => globalThis.copied !== ''))
  const link = await tab.evaluate(() => globalThis.copied)
  check('a link holds the clip', link.startsWith(`${place}#c=`) && link.length < 2000, `${link.length} characters`)
  const figures = await text('figures')
  const other = await browser.newPage()
  await other.goto(link)
  check('and opens it', await until(() => other.$eval('#figures', (element) => element.textContent.includes('bytes packed'))))
  check('as it was', (await other.$eval('#figures', (element) => element.textContent)).split(' ')[0] === figures.split(' ')[0])
  await other.goto(`${place}?fresh#c=!!!`)
  check('a damaged link is told', await until(() => other.$eval('#error', (element) => element.textContent.includes('damaged'))))
  await other.close()

  // What cannot be read is told, and what was there stays.
  const kept = await text('figures')
  await drop(Buffer.from('this is no sound at all'), 'notes.mp3')
  check('garbage is told', await until(async () => (await text('error')).includes('cannot be opened')), await text('error'))
  await drop(Buffer.from('{"a": 1}'), 'x.json')
  check('and a clip that is none', await until(async () => (await text('error')).length > 0 && !(await text('error')).includes('no sound')), await text('error'))
  check('what was there stays', (await text('figures')) === kept)

  // A reload, also without a network.
  await tab.goto(place)
  check('a reload keeps the clip', await until(async () => (await text('figures')).includes('bytes packed')))
  await until(() => tab.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.active?.state === 'activated'))
  await tab.reload()
  await until(() => tab.evaluate(() => navigator.serviceWorker.controller !== null))
  await wait(500)
  server.kill()
  await wait(300)
  const quiet = problems.length
  await tab.reload()
  check('the page opens without a network', await until(async () => (await text('figures')).includes('bytes packed')))
  await drop(bytes, 'again.wav')
  check('and analyses', await analysed())
  problems.length = quiet
  server = serve(page, port)
  await until(async () => (await fetch(place).catch(() => undefined))?.ok)

  // The live translator in an audio worklet: sample for sample what the same class gives outside of browsers.
  const profileText = readFileSync(join(dirname(fileURLToPath(import.meta.url)), '../../profiles/lra-175.json'))
  writeFileSync(join(folder, 'lra.json'), profileText)
  const heard = Float32Array.from({ length: 48000 }, (_, n) => 0.6 * Math.exp(-(n % 12000) / 3000) * Math.sin(2 * Math.PI * (60 + n / 200) * n / 48000))
  writeFileSync(join(folder, 'heard.f32'), Buffer.from(heard.buffer))
  for (const parameters of [{}, { intensity: -6, speech: 0.2, texture: 3 }]) {
    writeFileSync(join(folder, 'live.json'), JSON.stringify({ format: 'pacini.settings', version: 1, live: parameters }))
    const expected = execFileSync('sh', ['-c', '"$0" 48000 lra.json live.json < heard.f32', live], { cwd: folder, maxBuffer: 1e8 })
    const translated = await tab.evaluate(async (base64, parameters) => {
      const samples = new Float32Array(Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)).buffer)
      const { createTranslator } = await import('./pacini/translator.js')
      const context = new OfflineAudioContext(1, samples.length, 48000)
      const buffer = new AudioBuffer({ length: samples.length, sampleRate: 48000 })
      buffer.copyToChannel(samples, 0)
      const node = await createTranslator(context, { profile: 'lra-175', ...parameters })
      const source = new AudioBufferSourceNode(context, { buffer })
      source.connect(node).connect(context.destination)
      source.start()
      return { latency: node.latency, samples: [...(await context.startRendering()).getChannelData(0)] }
    }, Buffer.from(heard.buffer).toString('base64'), parameters)
    const reference = new Float32Array(expected.buffer.slice(expected.byteOffset, expected.byteOffset + expected.length))
    let largest = 0, loudest = 0
    for (let n = 0; n < reference.length; ++n) {
      largest = Math.max(largest, Math.abs(reference[n] - translated.samples[n]))
      loudest = Math.max(loudest, Math.abs(reference[n]))
    }
    check(`the live translator gives the samples of the program ${JSON.stringify(parameters)}`, largest === 0 && loudest > 0.05, `largest difference ${largest}, loudest ${loudest.toFixed(2)}, ${translated.latency} frames late`)
  }
  const levels = await tab.evaluate(async () => {
    const { createTranslator } = await import('./pacini/translator.js')
    const context = new OfflineAudioContext(1, 96000, 48000), node = await createTranslator(context, { profile: 'lra-175' })
    const source = new OscillatorNode(context, { frequency: 170 })
    source.connect(node).connect(context.destination)
    source.start()
    context.suspend(1).then(async () => {
      await node.set({ intensity: -60 })
      await new Promise((resolve) => { setTimeout(resolve, 100) }) // until the worklet has it
      context.resume()
    })
    const drive = (await context.startRendering()).getChannelData(0), peak = (from, to) => drive.subarray(from, to).reduce((most, value) => Math.max(most, Math.abs(value)), 0)
    return [peak(24000, 48000), peak(72000, 96000), await node.set({ bands: 3 }).catch(({ where }) => where)]
  })
  check('and its parameters change while it runs', levels[0] > 0.1 && levels[1] < levels[0] / 500 && levels[2] === 'bands', levels.join(' '))
  const refused = await tab.evaluate(() => import('./pacini/translator.js').then(({ createTranslator }) => createTranslator(new OfflineAudioContext(1, 1, 48000), { profile: '{}' })).catch(({ name, where }) => `${name} ${where}`))
  check('a profile that is none is refused', refused === 'PaciniError profile', refused)
  await tab.click('#live')
  check('and runs on the microphone', await until(async () => (await text('feel-status')).includes('microphone')), await text('error'))
  await tab.click('#live')
  await tab.click('#record')
  check('a recording shows its level and time', await until(async () => /^Recording: [\d.]+ s$/.test(await text('status')) &&
    await tab.$eval('#record-level', ({ hidden, value }) => !hidden && value > -60)), await text('status'))
  await wait(1500)
  await tab.click('#record')
  check('a recording is analysed', await until(() => tab.$eval('#lanes', (canvas) => canvas.getAttribute('aria-label').startsWith('recording'))) && await analysed(), await text('figures'))

  // Scrolling a minute: every picture within 1/60 s of work.
  const minute = Buffer.concat([bytes.subarray(0, 44), ...Array.from({ length: Math.ceil(60 / ((bytes.length - 44) / 88200)) }, () => bytes.subarray(44))])
  minute.writeUInt32LE(minute.length - 8, 4)
  minute.writeUInt32LE(minute.length - 44, 40)
  await tab.setViewport({ width: 1440, height: 900 })
  await tab.goto(place)
  await until(async () => (await text('figures')).includes('bytes packed'))
  await drop(minute, 'minute.wav')
  check('a minute is analysed', await until(async () => (await text('status')).startsWith('Analysed') && (await text('figures')).startsWith('60.') && (await text('figures')).includes('bytes packed'), 60), await text('figures'))
  await wait(1000)
  const pictureTimes = await tab.evaluate(async () => {
    const canvas = document.getElementById('lanes'), { left, top, width } = canvas.getBoundingClientRect()
    const turn = (init) => canvas.dispatchEvent(new WheelEvent('wheel', { clientX: left + width / 2, clientY: top + 50, cancelable: true, bubbles: true, ...init }))
    turn({ deltaY: -500, ctrlKey: true })
    // What the page does for one picture, from its beginning to its end, while it scrolls.
    const times = []
    const native = globalThis.requestAnimationFrame
    globalThis.requestAnimationFrame = (work) => native((now) => {
      const started = performance.now()
      work(now)
      times.push(performance.now() - started)
    })
    for (let i = 0; i < 120; ++i) {
      turn({ deltaX: 24 })
      await new Promise((resolve) => native(() => setTimeout(resolve, 0)))
    }
    globalThis.requestAnimationFrame = native
    return times.sort((a, b) => a - b)
  })
  const at = (share) => pictureTimes[Math.floor(share * (pictureTimes.length - 1))]
  // A figure, not a bar: how fast a machine is, is no test.
  check('a minute is scrolled', pictureTimes.length >= 100, `${pictureTimes.length} pictures, median ${at(0.5)?.toFixed(1)}, 95 % ${at(0.95)?.toFixed(1)}, worst ${at(1)?.toFixed(1)} ms of 16.7`)

  // What the page needs without a network is what it has.
  const keptFiles = await tab.evaluate(async () => (await (await fetch('service-worker.js')).text()).match(/'[^']+\.(js|html|css|wasm)'/g).map((name) => name.slice(1, -1)))
  const missing = readdirSync(page).filter((name) => /\.(js|html|css)$/.test(name) && !['service-worker.js', 'index.html'].includes(name) && !keptFiles.includes(name)) // index.html is './'
  check('the worker of the page keeps all of its files', missing.length === 0, missing.join(' '))
  const grouped = await tab.$$eval('#gallery optgroup option', (options) => options.map(({ value }) => value).sort())
  const gallery = await tab.evaluate(async () => [...(await import('./gallery/list.js')).default].sort())
  check('the examples step aside for a clip', await tab.$$eval('#welcome, #examples', (all) => all.length === 2 && all.every(({ hidden }) => hidden)))
  check('the gallery has all sounds by kind', gallery.length > 10 && grouped.join() === gallery.join() && !(await tab.$$eval('#gallery optgroup', (groups) => groups.map(({ label }) => label))).includes('Others'))

  // What a visit needs: without a worker that keeps all for later.
  const visit = await browser.newPage()
  const loaded = new Set()
  visit.on('request', (request) => { if (request.url().endsWith('.wasm')) loaded.add(request.url().split('/').at(-1)) })
  const visited = await visit.createCDPSession()
  await visited.send('Network.setCacheDisabled', { cacheDisabled: true })
  await visited.send('Network.setBypassServiceWorker', { bypass: true })
  await visit.goto(`${place}?fresh`)
  await until(() => visit.evaluate(() => document.querySelectorAll('#format option').length > 10 && !document.getElementById('clip').hidden))
  const resources = () => visit.evaluate(() => document.getElementById('figures').textContent)
  await until(async () => (await resources()).includes('bytes packed'))
  for (const worker of visit.workers())
    for (const name of await worker.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => name)))
      if (name.endsWith('.wasm')) loaded.add(name.split('/').at(-1))
  check('a visit loads what it needs', [...loaded].join() === 'visit.wasm', [...loaded].join(' '))
  await visit.close()

  // A browser without room.
  const full = await browser.newPage()
  await full.evaluateOnNewDocument(() => {
    IDBObjectStore.prototype.put = () => { throw new DOMException('no room', 'QuotaExceededError') }
  })
  await full.goto(place)
  await full.select('#gallery', await full.evaluate(async () => (await import('./gallery/list.js')).default[0]))
  await full.$eval('#open-example', (button) => button.click())
  check('a full storage is told', await until(() => full.$eval('#storage', (element) => element.textContent.includes('no room'))))
  check('and the clip is there', await until(() => full.$eval('#figures', (element) => element.textContent.includes('bytes packed'))))
  await full.close()

  // The guide: every figure is computed.
  const guide = await browser.newPage()
  guide.on('pageerror', (error) => problems.push(error.message))
  guide.on('request', (request) => { if (!request.url().startsWith(place) && !/^(data|blob):/.test(request.url())) elsewhere.push(request.url()) })
  await guide.setViewport({ width: 1000, height: 900 })
  await guide.goto(`${place}guide.html`)
  await until(() => guide.evaluate(() => document.querySelectorAll('#pages a').length === 6))
  for (const name of ['bands', 'breakpoints', 'actuators', 'scenes', 'protection', 'time']) {
    await guide.goto(`${place}guide.html#${name}`)
    const figureSays = () => guide.evaluate((name) => document.querySelector(`.figure[data-figure=${name}] [role=status]`)?.textContent ?? '', name)
    const enough = { breakpoints: /60: /, time: /32 bands/, scenes: /times as fast/ }[name] ?? /\d/
    check(`the figure of ${name}`, await until(async () => enough.test(await figureSays()), 60), await figureSays())
    if (pictures) await guide.screenshot({ path: join(pictures, `guide-${name}.png`), fullPage: true })
  }
  await guide.evaluate(axe)
  const found = await guide.evaluate(async () => (await globalThis.axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 80)).join(' ')}`))
  check('axe finds nothing in the guide', found.length === 0, found.join('\n'))
  await guide.close()

  // Keyboard, and what screen readers are told.
  await tab.goto(place)
  await until(async () => (await text('figures')).includes('bytes packed'))
  await tab.$$eval('details', (all) => all.forEach((one) => { one.open = true }))
  const reached = new Set()
  for (let i = 0; i < 70; ++i) {
    await tab.keyboard.press('Tab')
    reached.add(await tab.evaluate(() => document.activeElement?.id))
  }
  const wanted = await tab.$$eval('main button:not([disabled]), main select, main input:not([disabled]), canvas', (all) => all.filter((one) => one.checkVisibility()).map(({ id }) => id))
  check('everything is reached by Tab', wanted.every((id) => reached.has(id)), wanted.filter((id) => !reached.has(id)).join(' '))
  await tab.evaluate(axe)
  for (const scheme of ['dark', 'light']) {
    await tab.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }])
    const found = await tab.evaluate(async () => (await globalThis.axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 80)).join(' ')}`))
    check(`axe finds nothing (${scheme})`, found.length === 0, found.join('\n'))
    if (pictures)
      for (const [name, width, height] of [['phone', 390, 844], ['tablet', 820, 1180], ['desktop', 1440, 900]]) {
        await tab.setViewport({ width, height })
        await wait(300)
        await tab.screenshot({ path: join(pictures, `${name}-${scheme}.png`), fullPage: true })
      }
  }
  await tab.setViewport({ width: 390, height: 844 })
  await tab.evaluate(() => document.getElementById('lanes').scrollIntoView())
  check('on a phone what plays stays in view', await tab.$$eval('.player button', (all) => all.length === 6 && all.every((one) => {
    const { top, bottom } = one.getBoundingClientRect()
    return top >= 0 && bottom <= innerHeight
  })))
  check('nothing is wider than a phone', await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth))
  check('no request leaves the page\'s place', elsewhere.length === 0, elsewhere.join(' '))
  check('and nothing went wrong unseen', problems.length === 0, problems.join('\n'))
} finally {
  await tidyUp(folder, browser, server)
}
process.exit(failures() ? 1 : 0)
