// `pacini serve` and a phone: it pairs once, feels what is played when it is played, and nobody else is let in.
//
// check_phone.mjs MODULES PACINI SOUND.wav    MODULES: the folder with puppeteer-core and axe-core. Exit 0, 1 on a failed check.
import { execFileSync, spawn } from 'node:child_process'
import { mkdtempSync, readFileSync } from 'node:fs'
import { connect } from 'node:net'
import { tmpdir } from 'node:os'
import { join } from 'node:path'

import { check, failures, launch, noteVibrations, tidyUp, until, wait } from './browser.mjs'

const [modules, program, sound] = process.argv.slice(2)
const { touchesOf } = await import('../../Source/web/page/vibration.js')
const folder = mkdtempSync(join(tmpdir(), 'pacini-phone-'))

execFileSync(program, ['encode', sound, '-o', 'knock.json', '-q', '-y'], { cwd: folder })
const clip = JSON.parse(readFileSync(join(folder, 'knock.json'), 'utf8'))
let said = '', report = ''
const server = spawn(program, ['serve', 'knock.json', '--address', '127.0.0.1', '--json'], { cwd: folder })
server.stderr.on('data', (data) => { said += data })
server.stdout.on('data', (data) => { report += data })
const ended = new Promise((resolve) => server.on('close', resolve))
const browser = await launch(modules, [], { userDataDir: join(folder, 'profile') })
try {
  check('an address is said', await until(() => /http:\S+/.test(said)), said.trim())
  const url = said.match(/http:\S+/)[0], place = new URL(url).origin, port = Number(new URL(url).port)

  // What is not paired, asks for something else, or sends something.
  const status = async (path, options = {}) => (await fetch(place + path, { redirect: 'manual', ...options })).status
  check('without the code nobody is let in', await status('/') === 403 && await status('/phone.js') === 403 && await status('/events') === 403)
  check('nor with a wrong one', await status('/?code=aaaaaaaaaaaaaaaa') === 403 && await status('/?code=') === 403)
  check('which the terminal says', await until(() => said.includes('a phone was refused: this code is not one of this session')), said.trim())
  check('uploads are refused', await status('/', { method: 'POST', body: 'x' }) === 413 && await status('/', { method: 'PUT' }) === 405)
  const raw = (text) => new Promise((resolve) => {
    const socket = connect(port, '127.0.0.1', () => socket.write(text))
    let answer = ''
    socket.on('data', (data) => { answer += data })
    socket.on('error', () => resolve(answer))
    socket.on('close', () => resolve(answer))
  })
  check('paths are refused', (await raw(`GET /../../etc/passwd HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\n\r\n`)).includes(' 403 '))
  check('another name of the machine is refused', (await raw(`GET ${new URL(url).pathname}${new URL(url).search} HTTP/1.1\r\nHost: evil.example\r\n\r\n`)).includes(' 403 '))
  check('what is no request ends', !(await raw('\x16\x03\x01nonsense\r\n\r\n')).includes(' 200 '))
  check('and an endless one', !(await raw(`GET / HTTP/1.1\r\nX: ${'y'.repeat(20000)}\r\n\r\n`)).includes(' 200 '))

  const phone = await browser.newPage()
  await phone.emulate({ viewport: { width: 390, height: 844, hasTouch: true, isMobile: true }, userAgent: await browser.userAgent() })
  const elsewhere = []
  phone.on('request', (request) => { if (!request.url().startsWith(place) && !/^(data|ws):/.test(request.url())) elsewhere.push(request.url()) })
  await noteVibrations(phone)
  await phone.evaluateOnNewDocument(() => {
    const Own = WebSocket
    globalThis.sockets = []
    globalThis.WebSocket = class extends Own {
      constructor(...parameters) {
        super(...parameters)
        globalThis.sockets.push(this)
      }
    }
  })
  // What looks at the address before a person does, as previews of links do, uses nothing up.
  const own = new URL(url).pathname + new URL(url).search
  check('a preview is shown the way in', await status(own) === 200 && await status(own) === 200 && await status(own, { method: 'HEAD' }) === 405)
  check('and is not let in', await status('/') === 403)
  await phone.goto(url)
  check('a phone is asked before it is let in', await phone.$eval('#pair', (button) => button.textContent.length > 0))
  await phone.click('#pair', { count: 2, delay: 30 })
  await phone.waitForSelector('#status')
  const text = (id) => phone.$eval(`#${id}`, (element) => element.textContent)
  check('a phone with the code is let in', await until(async () => (await text('status')).startsWith('Connected')), await text('status'))
  check('and has the clip', await until(async () => (await text('clip')).includes('knock')), await text('clip'))
  check('its code is out of the address', !phone.url().includes('code'))
  const again = await fetch(url, { redirect: 'manual' })
  check('the code worked once', again.status === 403 && (await again.text()).includes('let another phone in') && await status(own, { method: 'POST' }) === 403)
  check('which the terminal says', await until(() => said.includes('a phone was refused: this code let another phone in')))
  await phone.goto(url)
  check('a phone that is known needs no other', await until(async () => (await text('status')).startsWith('Connected')) && !phone.url().includes('code'))
  // On the machine that plays, the page shows the code for the next phone, and the next one when that is used up.
  const shownCode = async () => {
    const image = await phone.$('#code')
    await until(() => image.evaluate(({ complete, naturalWidth }) => complete && naturalWidth > 0))
    await image.screenshot({ path: join(folder, 'code.png') })
    try {
      return execFileSync('zbarimg', ['--quiet', '--raw', join(folder, 'code.png')], { encoding: 'utf8' }).trim()
    } catch { return 'no code' }
  }
  check('its page shows the code for the next phone', await until(() => phone.$eval('#others', ({ hidden }) => !hidden)))
  const first = await shownCode()
  check('which others can scan', first.startsWith(`${place}/?code=`) && first !== url && await status(first.slice(place.length)) === 200, first)
  check('and nobody sees who is not let in', await status('/code.svg') === 403)
  const german = await (await browser.createBrowserContext()).newPage()
  await german.evaluateOnNewDocument(() => Object.defineProperty(navigator, 'languages', { get: () => ['de-CH', 'en'] }))
  await german.goto(first)
  check('the page is in the language of its browser', await german.$eval('#pair', ({ textContent }) => textContent) === 'Dieses Telefon verbinden')
  await german.click('#pair')
  await german.waitForSelector('#status')
  check('also what it says', await until(() => german.$eval('#status', ({ textContent }) => textContent.startsWith('Verbunden.') || textContent.startsWith('Verbunden,'))) &&
    await until(() => german.$eval('#clip', ({ textContent }) => /, \d,\d\d s/.test(textContent))) && await german.$eval('html', ({ lang }) => lang) === 'de',
  await german.$eval('#clip', ({ textContent }) => textContent))
  check('then another code is shown', await until(async () => ![first, 'no code'].includes(await shownCode())) && (await shownCode()).startsWith(place))
  if (process.env.PACINI_WEB_PICTURES) await german.screenshot({ path: join(process.env.PACINI_WEB_PICTURES, 'phone-page-de.png') })
  await german.browserContext().close()
  check('the program knows', await until(() => said.includes('1 phone connected')))
  check('and that its button was not touched', await until(() => said.includes('1 phone connected: 1 computer waits for a touch of its button')), said)
  await phone.click('#ready')
  check('until it is', await until(() => said.includes('1 phone connected: 1 computer feels')))
  await phone.evaluate(() => globalThis.sockets.at(-1).close())
  check('a phone that loses its connection comes back, and feels', await until(async () => (await text('status')).startsWith('Connected again')) &&
    await until(() => /0 phones connected[^]*1 computer feels/.test(said)), await text('status'))
  await wait(800) // the clocks are compared

  // What is played here is felt there, when it is.
  const delays = []
  for (let run = 0; run < 5; ++run) {
    await phone.evaluate(() => { globalThis.vibrations = [] })
    const before = said.length
    server.stdin.write('\n')
    await until(() => said.slice(before).includes('played on 1 phone'))
    await wait(1000 * clip.duration + 300)
    delays.push(await phone.evaluate(() => globalThis.vibrations))
  }

  // Another browser on this machine has no cookie of the phone, and another page may not speak for it.
  const stranger = await browser.createBrowserContext()
  const page = await stranger.newPage()
  const answer = await page.goto(place)
  check('another browser is not let in', answer.status() === 403)
  await stranger.close()
  const cookie = (await phone.cookies()).map(({ name, value }) => `${name}=${value}`).join('; ')
  const upgrade = (origin) => raw(`GET /events HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nCookie: ${cookie}\r\nOrigin: ${origin}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n`)
  check('another page cannot speak for it', (await upgrade('http://evil.example')).includes(' 403 '))
  const messages = await phone.evaluate(async (place) => {
    const tell = (text) => new Promise((resolve) => {
      const socket = new WebSocket(place.replace('http', 'ws') + '/events')
      socket.onopen = () => socket.send(text)
      socket.onclose = () => resolve('closed')
      setTimeout(() => resolve('open'), 1500)
    })
    return Promise.all([tell('{"play": 1}'), tell('x'.repeat(5000)), tell('[[[[[['), tell('{"ping": 1}')])
  }, place)
  check('what is no question ends the connection', messages.join(' ') === 'closed closed closed open', messages.join(' '))

  await phone.addScriptTag({ content: readFileSync(join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8') }).catch(() => {})
  const axe = await phone.evaluate(readFileSync(join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8') + '; axe.run().then(({ violations }) => violations.map(({ id }) => id))')
  check('axe finds nothing', axe.length === 0, axe.join(' '))
  check('no request leaves the place', elsewhere.length === 0, elsewhere.join(' '))
  if (process.env.PACINI_WEB_PICTURES) await phone.screenshot({ path: join(process.env.PACINI_WEB_PICTURES, 'phone-page.png') })

  // A class: phones come one after another, each with the code that is shown then.
  const room = spawn(program, ['serve', 'knock.json', '--address', '127.0.0.1'], { cwd: folder })
  let shown = ''
  for (const stream of [room.stdout, room.stderr]) stream.on('data', (data) => { shown += data })
  const codeNow = () => shown.match(/http:\S+/g)?.at(-1)
  const sockets = []
  let last, connected = 0
  const enter = async () => {
    await until(() => codeNow() !== last)
    last = codeNow()
    const { status, headers } = await fetch(last, { method: 'POST', redirect: 'manual' })
    if (status !== 303) return { status }
    const { host, hostname, port, origin } = new URL(last)
    const socket = connect(Number(port), hostname, () => socket.write(`GET /events HTTP/1.1\r\nHost: ${host}\r\nCookie: ${headers.get('set-cookie').split(';')[0]}\r\nOrigin: ${origin}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n`))
    const one = { status, socket, heard: '' }
    socket.on('data', (data) => { one.heard += data })
    sockets.push(one)
    await until(() => one.heard.includes('"kind":"clip"'))
    return one
  }
  for (let i = 0; i < 30; ++i) if ((await enter()).heard?.includes('"kind":"clip"')) ++connected
  check('a class of thirty pairs', connected === 30 && await until(() => shown.includes('30 phones connected')), `${connected}`)
  while (connected < 64 && (await enter()).heard?.includes('"kind":"clip"')) ++connected
  check('and twice as many', connected === 64, `${connected}`)
  check('one more is told', (await enter()).status === 503 && await until(() => shown.includes('a phone was refused: 64 phones are connected already')))
  sockets[0].socket.destroy()
  await until(() => /64 phones connected[^]*63 phones connected/.test(shown))
  last = undefined
  check('until one has left', (await enter()).heard?.includes('"kind":"clip"'))
  const message = JSON.parse(sockets[0].heard.match(/\{"kind":"clip".*?\]\]\}/s)[0])
  const touches = touchesOf(message.touches)
  check('pushes are long enough to be felt, and so are gaps', touches.every(({ start, end }, i) => end - start > 0.0345 && (i === 0 || start - touches[i - 1].end > 0.0185)), `${touches.length}`)
  for (const { socket } of sockets) socket.destroy()
  room.kill('SIGINT')

  // A browser that cannot.
  const nextUrl = said.match(/http:\S+/g).at(-1)
  server.kill('SIGINT')
  await ended
  check('the page says when the session is over', await until(async () => (await text('status')).includes('ended')), await text('status'))
  const { plays } = JSON.parse(report)
  check('nothing was wrong in the program', !/Sanitizer|terminate called/.test(said), /Sanitizer|terminate called/.test(said) ? said : '')
  check('every play was felt', plays.length === 5 && delays.every((vibrations) => vibrations.filter(({ pattern }) => pattern[0] > 0).length > 0))
  const off = delays.flatMap((vibrations, run) => vibrations.filter(({ pattern }) => pattern[0] > 0).map(({ at, pattern }) => {
    const time = at - plays[run]
    // The touch that it belongs to; a first one may be joined in its midst.
    const touch = touches.find(({ start, end }) => Math.abs(1000 * end - (time + pattern[0])) < 60 || Math.abs(1000 * start - time) < 60)
    return touch ? Math.min(Math.abs(1000 * touch.start - time), Math.abs(1000 * touch.end - time - pattern[0])) : 999
  })).sort((a, b) => a - b)
  const patterns = delays.every((vibrations) => vibrations.filter(({ pattern }) => pattern[0] > 0)
    .every(({ pattern }) => pattern.length % 2 === 1 && pattern.length <= 10 && pattern.every((part) => part > 0)))
  check('patterns are what browsers take', patterns)
  check('each belongs to a touch of the clip', off.at(-1) < 999)
  // A figure, not a bar: how fast a machine is, is no test.
  console.log(`     off by ${off[Math.floor(off.length / 2)].toFixed(1)} ms in the middle, ${off.at(-1).toFixed(1)} at most, of ${off.length}`)
  check('the program says where it was', nextUrl.startsWith(place) && JSON.parse(report).address.startsWith(place))
} finally {
  await tidyUp(folder, browser, server)
}
process.exit(failures() ? 1 : 0)
