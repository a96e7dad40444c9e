// The page in headless Chromium: a sound is dropped, changed, felt by a controller that records, exported and shared; a
// reload keeps it, also without a network; nothing leaves the page's own place; axe finds nothing.
//
// check_page.mjs PAGE MODULES PACINI SOUND.wav [PICTURES]    PAGE: the built folder; MODULES: the folder with
// puppeteer-core and axe-core; PICTURES: a folder for pictures in three sizes. Exit 0, 1 on a failed check.
import { execFileSync, spawn } from 'node:child_process'
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { tmpdir } from 'node:os'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'

const [page, modules, program, sound, pictures] = process.argv.slice(2)
const require = createRequire(join(modules, 'package.json'))
const { default: puppeteer } = await import(join(modules, 'node_modules/puppeteer-core/lib/puppeteer/puppeteer-core.js')).catch(() =>
  import(require.resolve('puppeteer-core')))
const folder = mkdtempSync(join(tmpdir(), 'pacini-page-'))
const port = 20000 + process.pid % 20000
const place = `http://127.0.0.1:${port}/`
const serve = () => spawn('python3', ['-B', join(dirname(fileURLToPath(import.meta.url)), '../../Source/web/serve.py'), page, String(port)])
let server = serve()
let failures = 0
const check = (what, holds, detail = '') => {
  console.log(`${holds ? 'ok  ' : 'FAIL'} ${what} ${detail ?? ''}`)
  if (!holds) ++failures
}
const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds))
const until = async (condition, seconds = 20) => {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await wait(50)) if (await condition()) return true
  return false
}

const browser = await puppeteer.launch({
  executablePath: ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync),
  args: ['--no-sandbox', '--headless=new', '--disable-gpu', '--autoplay-policy=no-user-gesture-required'],
  userDataDir: join(folder, 'profile')
})
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
  check('interactive within a second', interactive < 1000, `${interactive.toFixed(0)} ms`)

  const bytes = readFileSync(sound)
  await drop(bytes, 'knock.wav')
  check('a dropped sound is analysed', await analysed(), await text('figures'))
  if (failures) console.log(problems, await text('error'), await text('status'))

  // Export: the bytes of the program.
  const save = async (format, extension) => {
    await tab.select('#format', format)
    await wait(300)
    for (const file of readdirSync(downloads)) rmSync(join(downloads, file))
    await tab.click('#save')
    const path = join(downloads, `knock${extension}`)
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

  // Knobs.
  const before = await text('figures')
  await tab.$eval('#breakpoints', (input) => { input.value = '4'; input.dispatchEvent(new Event('input', { bubbles: true })) })
  check('a knob analyses again', await until(async () => (await text('figures')) !== before && (await text('status')).startsWith('Analysed')), await text('figures'))
  await tab.select('#profile', 'erm-coin')
  await wait(500)

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
  check('garbage is told', await until(async () => (await text('error')).includes('no sound')), await text('error'))
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
  server = serve()
  await until(async () => (await fetch(place).catch(() => undefined))?.ok)

  // Keyboard, and what screen readers are told.
  await tab.goto(place)
  await until(async () => (await text('figures')).includes('bytes packed'))
  const reached = new Set()
  for (let i = 0; i < 40; ++i) {
    await tab.keyboard.press('Tab')
    reached.add(await tab.evaluate(() => document.activeElement?.id))
  }
  const wanted = await tab.$$eval('main button:not([disabled]), main select, main input:not([disabled]), canvas', (all) => all.map(({ id }) => id))
  check('everything is reached by Tab', wanted.every((id) => reached.has(id)), wanted.filter((id) => !reached.has(id)).join(' '))
  await tab.addScriptTag({ path: join(modules, 'node_modules/axe-core/axe.min.js') })
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
  check('nothing is wider than a phone', await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth))
  check('no request leaves the page\'s place', elsewhere.length === 0, elsewhere.join(' '))
  check('and nothing went wrong unseen', problems.length === 0, problems.join('\n'))
} finally {
  await browser.close()
  server.kill()
  rmSync(folder, { recursive: true, force: true })
}
process.exit(failures ? 1 : 0)
