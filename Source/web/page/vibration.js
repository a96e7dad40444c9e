// Phones, whose motor is only on or off.

/** When the motor is on, `{start, end}` in s, of pairs in ms. */
export const touchesOf = (pairs) => pairs.map(([start, end]) => ({ start: start / 1000, end: end / 1000 }))

// The standard has patterns of 10 parts of at most 10 s. Shorter patterns, each begun by the clock, do not drift.
const mostTouches = 5, longest = 0.8 // s

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

/** A clock that begins now with `from`, s: `now()`, s, and its speed. */
export const wallClock = (from = 0) => {
  const started = performance.now() - 1000 * from
  return { now: () => (performance.now() - started) / 1000, speed: 1 }
}

/** Waits, or until it is stopped. */
export const rest = (milliseconds, signal) => new Promise((resolve) => {
  if (signal.aborted) return resolve()
  const stop = () => {
    clearTimeout(timer)
    resolve()
  }
  const timer = setTimeout(() => {
    signal.removeEventListener('abort', stop) // a film has thousands of these
    resolve()
  }, milliseconds)
  signal.addEventListener('abort', stop, { once: true })
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
