// Touch in time with a film, on clocks that are not there: a media element whose clock drifts, and timers that are late.
//
// film.mjs    Exit 0, 1 on a failed check. Needs node alone.
import { atSpeed, follow } from '../../Source/web/page/film.js'
import { vibrateBy } from '../../Source/web/page/vibration.js'

let failures = 0
const check = (what, holds, why = '') => {
  if (holds) return
  ++failures
  console.error(`film: ${what}: ${why}`)
}

// Time that only passes when everything waits for it, ms.
let now = 0, timers = [], number = 0
let random = 1
const lateness = () => (random = random * 48271 % 2147483647) % 4 // ms
globalThis.setTimeout = (work, delay) => {
  timers.push({ at: now + Math.max(0, delay) + lateness(), work, id: ++number })
  return number
}
globalThis.clearTimeout = (id) => { timers = timers.filter((timer) => timer.id !== id) }
const settle = () => new Promise((resolve) => setImmediate(resolve))
const pass = async (until) => {
  await settle()
  for (;;) {
    const next = timers.reduce((first, timer) => !first || timer.at < first.at ? timer : first, undefined)
    if (!next || next.at > until) break
    timers.splice(timers.indexOf(next), 1)
    now = Math.max(now, next.at)
    next.work()
    await settle()
  }
  now = until
}

/** A film whose clock goes wrong by `drift`. */
class Film extends EventTarget {
  constructor (drift) { super(); Object.assign(this, { drift, paused: true, seeking: false, ended: false, readyState: 4, rate: 1, at: 0, since: 0 }) }
  get currentTime () { return this.at + (this.paused || this.seeking ? 0 : (now - this.since) / 1000 * this.rate * (1 + this.drift)) }
  get playbackRate () { return this.rate }
  tell (type) { this.dispatchEvent(new Event(type)) }
  hold () { this.at = this.currentTime; this.since = now }
  play () { this.hold(); this.paused = false; this.tell('play'); this.tell('playing') }
  pause () { this.hold(); this.paused = true; this.tell('pause') }
  async seek (time) {
    this.seeking = true
    this.at = time
    this.tell('seeking')
    await pass(now + 50)
    this.since = now
    this.seeking = false
    this.tell('seeked')
    if (!this.paused) this.tell('playing')
  }
  speed (rate) { this.hold(); this.rate = rate; this.tell('ratechange') }
}

// When the motor is on, in s of the film, by what the film's clock says then.
let film, felt = [], last
Object.defineProperty(globalThis, 'navigator', { configurable: true, value: { vibrate: (pattern) => {
  if (last) for (const piece of last) if (piece.from < now) felt.push({ start: piece.start, end: piece.start + (Math.min(piece.to, now) - piece.from) / 1000 * piece.pace })
  last = undefined
  const parts = [pattern].flat(), pace = film.rate * (1 + film.drift)
  if (parts.length === 1 && parts[0] === 0) return
  last = []
  for (let i = 0, at = now; i < parts.length; at += parts[i++])
    if (i % 2 === 0) last.push({ from: at, to: at + parts[i], start: film.currentTime + (at - now) / 1000 * pace, pace })
} } })
const felted = () => { navigator.vibrate(0); return felt.splice(0) }

const touches = Array.from({ length: 9000 }, (_, i) => ({ start: 0.4 * i + 0.05, end: 0.4 * i + 0.05 + [0.02, 0.1, 0.3][i % 3] }))
const worst = (pieces, among) => {
  // Every piece begins at a touch, or goes on with it, and every touch has a piece.
  let off = 0
  for (const { start, end } of pieces) {
    const index = Math.min(touches.length - 1, Math.max(0, Math.floor((start + 0.01) / 0.4)))
    const own = touches[index]
    off = Math.max(off, start > own.start && start < own.end ? 0 : Math.abs(start - own.start), end - own.end)
  }
  for (const touch of among) {
    const first = pieces.find(({ start, end }) => end > touch.start && start < touch.end)
    off = Math.max(off, first ? Math.abs(first.start - touch.start) : 1)
  }
  return off
}
const within = (from, to) => touches.filter(({ start, end }) => start >= from && end <= to)
const start = (drift) => {
  film = new Film(drift)
  felt = []
  return follow(film, ({ now: clock, speed }, signal) => { vibrateBy(() => clock() / speed, atSpeed(touches, speed), signal) })
}

// An hour, with a film that gains or loses a fifth of a second.
for (const drift of [60e-6, -60e-6]) {
  const end = start(drift)
  film.play()
  await pass(now + 3600_000)
  film.pause()
  const pieces = felted(), tail = within(3500, 3599), off = worst(pieces, tail)
  check('after an hour touch and film are as one', off < 0.01, `${(1000 * off).toFixed(1)} ms apart, drift ${drift}`)
  check('and nothing is left out', pieces.length >= 8990, pieces.length)
  end()
}

const end = start(0)
film.play()
await pass(now + 10_000)
await film.seek(100)
await pass(now + 10_000)
felted()
await pass(now + 5000)
let off = worst(felted(), within(111.5, 113.5))
check('after a seek it goes on there', off < 0.01, off)
film.speed(2)
felted()
await pass(now + 5000)
off = worst(felted(), within(118, 123))
check('at twice the speed too', off < 0.01, off)
film.speed(0.5)
felted()
await pass(now + 5000)
off = worst(felted(), within(126, 126.9))
check('and at half of it', off < 0.01, off)
film.pause()
felted()
await pass(now + 5000)
check('a pause is one', felted().length === 0)
film.speed(1)
await film.seek(200)
await pass(now + 3000)
check('also when it is sought in', felted().length === 0)
film.play()
await pass(now + 3000)
check('until it plays', felted().length > 4)
film.hold()
film.paused = true // its clock stands
film.tell('waiting')
felted()
await pass(now + 3000)
check('nothing is felt while it waits', felted().length === 0)
film.since = now
film.paused = false
film.tell('playing')
await pass(now + 2000)
check('and it goes on after that', felted().length > 2)
end()
felted()
await pass(now + 2000)
check('the end is one', felted().length === 0)
if (failures === 0) console.log('film: in time')
process.exitCode = failures === 0 ? 0 : 1
