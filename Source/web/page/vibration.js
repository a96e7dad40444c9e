// A clip for two motors, and for phones, whose motor is only on or off.

import { valueAt } from './curve.js'

/** Of longer clips so much is felt, s. */
export const longestFelt = 3600

/** Strong and weak motor over time: low bands and high ones, as `{start, duration, strong, weak}` of 16 ms. */
export const rumbleOf = (clip) => {
  const step = 0.016, frames = [], end = Math.min(clip.duration, longestFelt)
  let passed = 0 // events
  for (let time = 0; time < end; time += step) {
    let low = 0, high = 0
    while (clip.transients[passed]?.time < time - step) ++passed
    for (const band of clip.bands) {
      const value = valueAt(band.amplitude, time)
      if (band.centreFrequency < 90) low = Math.hypot(low, value)
      else high = Math.hypot(high, value)
    }
    if (clip.bands.length === 0) low = high = valueAt(clip.envelope, time)
    for (let i = passed; clip.transients[i]?.time < time + step; ++i) {
      const { amplitude, sharpness } = clip.transients[i]
      high = Math.max(high, amplitude)
      low = Math.max(low, amplitude * (1 - sharpness))
    }
    frames.push({ start: time, duration: step, strong: Math.min(1, low), weak: Math.min(1, high) })
  }
  return frames
}

/** When a phone's motor is on: `{start, end}`, s. */
export const touchesOf = (clip) => {
  const touches = []
  for (const { start, duration, strong, weak } of rumbleOf(clip)) {
    if (Math.max(strong, weak) <= 0.15) continue
    const last = touches.at(-1)
    if (last && start - last.end < 1e-6) last.end = start + duration
    else touches.push({ start, end: start + duration })
  }
  return touches
}

// Browsers take no more than 99 parts of at most 10 s. Shorter patterns, each begun by the clock, do not drift.
const mostTouches = 40, longest = 0.8 // s

/** What `navigator.vibrate()` is told at `time` s, on and off by turns in ms, and until when that lasts; nothing at the end. */
export const patternAt = (touches, time) => {
  const first = touches.findIndex(({ end }) => end > time + 0.001)
  if (first < 0) return undefined
  const from = Math.max(time, touches[first].start)
  const pattern = []
  let at = from
  for (const { start, end } of touches.slice(first, first + mostTouches)) {
    if (pattern.length > 0 && start - from > longest) break
    if (pattern.length > 0) pattern.push(Math.round(1000 * (start - at)))
    const last = Math.min(end, Math.max(start, from) + longest)
    pattern.push(Math.round(1000 * (last - Math.max(start, from))))
    at = last
    if (last < end) break
  }
  return { from, until: at, pattern }
}

/** Waits, or until it is stopped. */
export const rest = (milliseconds, signal) => new Promise((resolve) => {
  if (signal.aborted) return resolve()
  const timer = setTimeout(resolve, milliseconds)
  signal.addEventListener('abort', () => { clearTimeout(timer); resolve() }, { once: true })
})

/** Vibrates as the clock `now()`, s, goes, until the end or until `signal` stops it. */
export const vibrateBy = async (now, touches, signal) => {
  while (!signal.aborted) {
    const next = patternAt(touches, now())
    if (!next) return
    await rest(1000 * (next.from - now()), signal)
    if (signal.aborted) break
    // The timer may have been late.
    const right = patternAt(touches, Math.max(now(), next.from)) ?? next
    navigator.vibrate(right.pattern)
    await rest(1000 * (right.until - now()), signal)
  }
  navigator.vibrate(0)
}
