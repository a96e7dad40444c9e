// Game controllers by WebHID, with the bytes of the core: HD rumble of a Switch controller, DualSense, DualShock 4 and others.

import { wallClock } from './vibration.js'

// Vendors whose controllers the core knows: Nintendo, Sony, Valve. Those of Microsoft are no HID devices on a cable, and
// browsers rumble them by themselves.
const filters = [0x057e, 0x054c, 0x28de].map((vendorId) => ({ vendorId }))

export const canAsk = () => 'hid' in navigator

let device

/** The controller that was chosen and is still there. */
export const chosen = () => device

/** Asks which one; nothing if none was chosen. */
export const choose = async () => {
  const [picked] = await navigator.hid.requestDevice({ filters })
  if (picked) device = picked
  return device
}

/** One that this page was allowed before. */
export const remembered = async () => {
  if (!canAsk()) return undefined
  device ??= (await navigator.hid.getDevices())[0]
  navigator.hid.addEventListener('disconnect', (event) => { if (event.device === device) device = undefined })
  return device
}

const numbersOf = ({ collections }) =>
  new Set(collections.flatMap(({ outputReports }) => (outputReports ?? []).map(({ reportId }) => reportId)))

/** How it is connected: its reports tell. */
export const isBluetooth = (controller) => {
  const numbers = numbersOf(controller)
  // Sony's have a long report on Bluetooth alone (31 of a DualSense, 11 of a DualShock 4); Nintendo's have one for the
  // cable (80).
  if (controller.vendorId === 0x054c) return numbers.has(0x31) || numbers.has(0x11)
  return controller.vendorId === 0x057e && !numbers.has(0x80)
}

const send = (controller, { bytes, feature }) => {
  const content = bytes.subarray(1)
  return feature ? controller.sendFeatureReport(bytes[0], content) : controller.sendReport(bytes[0], content)
}

/** Whether a report of Nintendo's controllers prepares them: it is sent whenever playing begins. */
const prepares = ({ vendorId }, { bytes }) => vendorId === 0x057e && bytes[0] !== 0x10

/** Sends `reports` at their times, until `signal` stops it; silences the controller whatever happens. */
export const playReports = async (controller, { reports, stops }, signal, clock) => {
  if (!controller.opened) await controller.open()
  const { now, speed } = clock ?? wallClock()
  let counter = 0, done = false
  try {
    for (const report of clock ? reports.filter((report) => report.time >= now() - 0.03 || prepares(controller, report)) : reports) {
      const wait = 1000 * (report.time - now()) / speed
      if (wait > 1)
        await new Promise((resolve) => {
          const timer = setTimeout(resolve, wait)
          signal.addEventListener('abort', () => { clearTimeout(timer); resolve() }, { once: true })
        })
      if (signal.aborted) break
      await send(controller, report)
      ++counter
    }
    done = !signal.aborted
  } finally {
    // What is played to its end is silent by itself.
    if (!done) {
      const perCount = stops.length / 16
      for (let i = 0; i < perCount; ++i) await send(controller, stops[(counter % 16) * perCount + i]).catch(() => {})
    }
  }
}
