// Touch: game controllers, and phones that vibrate.

import { atSpeed } from './film.js'
import { listed, t } from './text.js'
import { choose, chosen, isBluetooth, playReports } from './hid.js'
import { touchesOf, vibrateBy, wallClock } from './vibration.js'

/** Controllers that rumble now. */
export const rumbling = () => [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.vibrationActuator)

const canVibrate = () => typeof navigator.vibrate === 'function' && navigator.maxTouchPoints > 0

/** Whether there is anything to feel with. */
export const feelsNow = () => chosen() !== undefined || rumbling().length > 0 || canVibrate()

/** What is there to feel with, in words. */
export const describeFeel = () => {
  if (chosen()) return chosen().productName ? t('On {0}, with its own reports.', chosen().productName)
    : t('On the controller, with its own reports.')
  const pads = rumbling()
  if (pads.length > 0) return t('On {0}.', listed(pads.map((pad) => pad.id.replace(/\s*\(.*$/, ''))))
  if (canVibrate()) return t('On this phone.')
  if (/iPhone|iPad/.test(navigator.userAgent))
    return t('Browsers on iPhones cannot vibrate. Connect a game controller, or open this page in Chrome on an Android phone; files in AHAP play in apps on iPhones.')
  return t('Connect a game controller and press one of its buttons, or open this page on a phone that vibrates. With an actuator on an audio device, use "Play sound and haptics together".')
}

/** Asks for a controller that understands reports. */
export const connectController = () => choose()

/**
 * Computes what the clip is on what is there, and gives `play(signal, clock)`, which plays it until it ends or `signal` stops it, and
 * tells whether there was anything. `call` calls the core. `clock` is that of a sound or film (see film.js), or begins when it is
 * played.
 */
export const prepareFeel = async (clip, call) => {
  const controller = chosen()
  if (controller) {
    const { vendorId: vendor, productId: product } = controller
    const reports = await call('reports', clip, { vendor, product, bluetooth: isBluetooth(controller) })
    return async (signal, clock) => {
      await playReports(controller, reports, signal, clock)
      return true
    }
  }
  const pads = rumbling()
  if (pads.length === 0) {
    if (typeof navigator.vibrate !== 'function') return async () => false
    const { touches } = await call('touch', clip)
    return async (signal, clock) => {
      const { now, speed } = clock ?? wallClock()
      await vibrateBy(() => now() / speed, atSpeed(touchesOf(touches), speed), signal)
      return true
    }
  }
  const { motors, interval } = await call('rumble', clip)
  return async (signal, clock) => {
    if (signal.aborted) return true
    const { now } = clock ?? wallClock()
    signal.addEventListener('abort', () => pads.forEach((pad) => pad.vibrationActuator.reset?.()), { once: true })
    let last = -1
    await new Promise((resolve) => {
      const tick = () => {
        const index = Math.floor(now() / interval)
        if (signal.aborted || 2 * index >= motors.length) return resolve()
        if (index !== last && index >= 0) {
          last = index
          for (const pad of pads)
            pad.vibrationActuator.playEffect('dual-rumble', {
              startDelay: 0, duration: 60, strongMagnitude: motors[2 * index], weakMagnitude: motors[2 * index + 1]
            })
        }
        requestAnimationFrame(tick)
      }
      tick()
    })
    pads.forEach((pad) => pad.vibrationActuator.reset?.())
    return true
  }
}

/** Both at once. */
export const feel = async (clip, signal, call, clock) => (await prepareFeel(clip, call))(signal, clock)
