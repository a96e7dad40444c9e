// Touch: game controllers, and phones that vibrate.

import { valueAt } from './edits.js'
import { choose, chosen, isBluetooth, playReports } from './hid.js'

/** Controllers that rumble now. */
export const rumbling = () => [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.vibrationActuator)

const canVibrate = () => typeof navigator.vibrate === 'function' && navigator.maxTouchPoints > 0

/** Whether there is anything to feel with. */
export const feelsNow = () => chosen() !== undefined || rumbling().length > 0 || canVibrate()

/** What is there to feel with, in words. */
export const describeFeel = () => {
  if (chosen()) return `On ${chosen().productName || 'the controller'}, with its own reports.`
  const pads = rumbling()
  if (pads.length > 0) return `On ${pads.map((pad) => pad.id.replace(/\s*\(.*$/, '')).join(', ')}.`
  if (canVibrate()) return 'On this phone.'
  return 'Connect a game controller and press one of its buttons, or open this page on a phone that vibrates. ' +
    'An actuator on a sound interface plays "Sound left, touch right".'
}

/** Asks for a controller that understands reports. */
export const connectController = () => choose()

/** Strong and weak motor over time: low bands and high ones, as `{start, duration, strong, weak}` of 16 ms. */
export const rumbleOf = (clip) => {
  const step = 0.016, frames = []
  for (let time = 0; time < clip.duration; time += step) {
    let low = 0, high = 0
    for (const band of clip.bands) {
      const value = valueAt(band.amplitude, time)
      if (band.centreFrequency < 90) low = Math.hypot(low, value)
      else high = Math.hypot(high, value)
    }
    if (clip.bands.length === 0) low = high = valueAt(clip.envelope, time)
    for (const event of clip.transients)
      if (event.time >= time - step && event.time < time + step)
        high = Math.max(high, event.amplitude), low = Math.max(low, event.amplitude * (1 - event.sharpness))
    frames.push({ start: time, duration: step, strong: Math.min(1, low), weak: Math.min(1, high) })
  }
  return frames
}

const isLoud = ({ strong, weak }) => Math.max(strong, weak) > 0.15

/** Where the first touch of a phone begins, s, and how long it is on, off, on... in ms from there; a phone is only that. */
export const vibrationOf = (clip) => {
  const frames = rumbleOf(clip)
  const first = frames.findIndex(isLoud)
  if (first < 0) return { start: 0, pattern: [] }
  const pattern = [0]
  let on = true
  for (const frame of frames.slice(first)) {
    if (isLoud(frame) !== on) {
      on = !on
      pattern.push(0)
    }
    pattern[pattern.length - 1] += 16
  }
  return { start: frames[first].start, pattern: on ? pattern : pattern.slice(0, -1) }
}

/** Waits, or until it is stopped. */
const rest = (milliseconds, signal) => new Promise((resolve) => {
  const timer = setTimeout(resolve, milliseconds)
  signal.addEventListener('abort', () => { clearTimeout(timer); resolve() }, { once: true })
})

/** Plays on what is there until it ends or `signal` stops it; whether there was anything. `call` calls the core. */
export const feel = async (clip, signal, call) => {
  const controller = chosen()
  if (controller) {
    const { vendorId: vendor, productId: product } = controller
    await playReports(controller, await call('reports', clip, { vendor, product, bluetooth: isBluetooth(controller) }), signal)
    return true
  }
  const pads = rumbling()
  if (pads.length === 0) {
    if (typeof navigator.vibrate !== 'function') return false
    const { start, pattern } = vibrationOf(clip)
    if (pattern.length === 0) return false
    await rest(1000 * start, signal)
    if (signal.aborted) return true
    navigator.vibrate(pattern)
    await rest(pattern.reduce((sum, part) => sum + part, 0), signal)
    if (signal.aborted) navigator.vibrate(0)
    return true
  }
  const frames = rumbleOf(clip)
  const started = performance.now()
  signal.addEventListener('abort', () => pads.forEach((pad) => pad.vibrationActuator.reset?.()), { once: true })
  let last = -1
  await new Promise((resolve) => {
    const tick = () => {
      const index = Math.floor((performance.now() - started) / 16)
      if (signal.aborted || index >= frames.length) return resolve()
      if (index !== last) {
        last = index
        for (const pad of pads)
          pad.vibrationActuator.playEffect('dual-rumble', {
            startDelay: 0, duration: 60, strongMagnitude: frames[index].strong, weakMagnitude: frames[index].weak
          })
      }
      requestAnimationFrame(tick)
    }
    tick()
  })
  pads.forEach((pad) => pad.vibrationActuator.reset?.())
  return true
}
