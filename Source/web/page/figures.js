// Figures of the guide. Each is `(place, signal)`: an element to fill, and what says that the page is left.

import { Core } from './core.js'
import { guardSlider } from './fields.js'
import { Peaks } from './peaks.js'

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()
const rate = 44100
const core = new Core()

/** One of the demo sounds, at its own rate. */
const soundOf = async (name) => {
  const answer = await fetch(`guide/${name}.flac`)
  if (!answer.ok) throw new Error(`The sound of this figure is not there (${answer.status}).`)
  const buffer = await new OfflineAudioContext(1, 1, rate).decodeAudioData(await answer.arrayBuffer())
  return { samples: buffer.getChannelData(0).slice(), sampleRate: rate }
}

// ---- parts of figures

const made = (place, tag, attributes = {}) => {
  const part = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes))
    if (name === 'text') part.textContent = value
    else part.setAttribute(name, value)
  place.append(part)
  return part
}
const knob = (place, text, { min, max, step, value }, changed) => {
  const label = made(place, 'label', { text: `${text} ` })
  const input = made(label, 'input', { type: 'range', min, max, step, value })
  const output = made(label, 'output', { text: value })
  let timer
  guardSlider(input)
  input.addEventListener('input', () => {
    output.textContent = input.value
    clearTimeout(timer)
    timer = setTimeout(changed, 100)
  })
  return input
}
/** A picture with what it says in words beneath. */
const picture = (place, label) => {
  const canvas = made(place, 'canvas', { class: 'small', role: 'img', 'aria-label': label })
  const words = made(place, 'p', { role: 'status', text: 'Computing...' })
  return {
    say: (text) => { words.textContent = text },
    draw: (work) => {
      const scale = devicePixelRatio || 1
      canvas.width = Math.round(canvas.clientWidth * scale)
      canvas.height = Math.round(canvas.clientHeight * scale)
      const context = canvas.getContext('2d')
      context.setTransform(scale, 0, 0, scale, 0, 0)
      context.font = '12px system-ui, sans-serif'
      work(context, canvas.clientWidth, canvas.clientHeight)
    }
  }
}
const wave = (context, samples, { x, y, width, height }, fill, full = 1) => {
  const peaks = new Peaks(samples), per = samples.length / width
  context.fillStyle = fill
  for (let i = 0; i < width; ++i) {
    const [low, high] = peaks.between(i * per, (i + 1) * per)
    const top = y + height / 2 * (1 - Math.min(1, high / full)), bottom = y + height / 2 * (1 - Math.max(-1, low / full))
    context.fillRect(x + i, top, 1, Math.max(1, bottom - top))
  }
}
/** Points `{x, y, label}` on axes; `line`: joined. */
const chart = (context, width, height, points, { across, up, line, low = 0, high, logarithmic }) => {
  const left = 44, bottom = height - 36, right = width - 16, top = 28
  const most = Math.max(...points.map(({ x }) => x)) * 1.1, least = Math.min(...points.map(({ x }) => x)) / 1.2
  const xAt = (x) => logarithmic ? left + (right - left) * Math.log(x / least) / Math.log(most / least) : left + (right - left) * x / most
  const yAt = (y) => bottom - (bottom - top) * (y - low) / (high - low)
  context.strokeStyle = colour('line')
  context.fillStyle = colour('dim')
  for (let i = 0; i <= 4; ++i) {
    const value = low + (high - low) * i / 4
    context.beginPath()
    context.moveTo(left, yAt(value))
    context.lineTo(right, yAt(value))
    context.stroke()
    context.fillText(value.toFixed(0), 12, yAt(value) + 4)
  }
  context.fillText(across, Math.max(left, right - context.measureText(across).width), height - 4)
  context.fillText(up, 12, 12)
  if (line) {
    context.strokeStyle = colour('accent')
    context.beginPath()
    points.forEach(({ x, y }, i) => i === 0 ? context.moveTo(xAt(x), yAt(y)) : context.lineTo(xAt(x), yAt(y)))
    context.stroke()
  }
  for (const { x, y, label } of points) {
    context.fillStyle = colour('accent')
    context.beginPath()
    context.arc(xAt(x), yAt(y), 4, 0, 2 * Math.PI)
    context.fill()
    context.fillStyle = colour('dim')
    context.fillText(label, Math.min(xAt(x) - 6, right - context.measureText(label).width), bottom + 16)
  }
}

const likeness = async (sound, samples) => (await core.call('compare', sound, { samples, sampleRate: rate })).hts
const played = (clip, options = {}) => core.call('render', clip, { sampleRate: rate, ...options })

// ---- the figures

const bands = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const count = knob(place, 'Bands', { min: 1, max: 24, step: 1, value: 12 }, () => update())
  const view = picture(place, 'The sound, and what is played of a clip with so many bands')
  const update = async () => {
    const clip = await core.call('encode', sound, { bands: Number(count.value) })
    const drive = await played(clip)
    const hts = await likeness(sound, drive.samples)
    if (signal.aborted) return
    view.draw((context, width, height) => {
      wave(context, sound.samples, { x: 0, y: 0, width, height: height * 0.38 }, colour('sound'))
      const part = height * 0.24 / clip.bands.length
      clip.bands.forEach(({ amplitude }, i) => {
        context.fillStyle = colour('accent')
        for (let x = 0; x < width; x += 2) {
          const time = x / width * clip.duration
          const next = amplitude.findIndex((point) => point.time > time)
          const value = amplitude[next < 0 ? amplitude.length - 1 : Math.max(0, next - 1)]?.amplitude ?? 0
          context.globalAlpha = Math.min(1, Math.sqrt(value) * 2)
          context.fillRect(x, height * 0.64 - (i + 1) * part, 2, part * 0.9)
        }
      })
      context.globalAlpha = 1
      wave(context, drive.samples, { x: 0, y: height * 0.66, width, height: height * 0.34 }, colour('drive'))
    })
    const points = clip.bands.reduce((sum, { amplitude }) => sum + amplitude.length, 0)
    view.say(`${count.value} bands, ${points} points: HTS ${hts.toFixed(1)} of 100.`)
  }
  await update()
}

const breakpoints = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const view = picture(place, 'Likeness over the number of breakpoints a second')
  const points = []
  for (const count of [1, 2, 4, 6, 10, 15, 20, 30, 45, 60]) {
    const packed = await core.call('encode', sound, { breakpoints: count, format: 'packed' })
    const drive = await played(packed)
    const hts = await likeness(sound, drive.samples)
    if (signal.aborted) return
    points.push({ x: count, y: hts, label: String(count), bytes: packed.length })
    view.draw((context, width, height) =>
      chart(context, width, height, points, { across: 'breakpoints per second and band', up: 'HTS', line: true, high: 100 }))
    view.say(points.map(({ x, y, bytes }) => `${x}: ${y.toFixed(1)} (${bytes} bytes)`).join(', '))
  }
}

const actuators = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const clip = await core.call('encode', sound)
  const strength = knob(place, 'Strength', { min: 0, max: 1, step: 0.1, value: 0.4 }, () => update())
  const view = picture(place, 'How close what is felt is to the sound, for five actuators')
  const names = ['l5-wristband', 'dualsense-voice-coil', 'joycon-hd-rumble', 'lra-175', 'erm-coin']
  let newest = 0
  const update = async () => {
    const own = ++newest, results = []
    for (const profile of names) {
      const { samples } = await core.call('felt', clip, { profile, strength: Number(strength.value), sampleRate: rate })
      results.push({ profile, hts: await likeness(sound, samples) })
      if (signal.aborted || own !== newest) return
    }
    view.draw((context, width, height) => {
      const row = height / names.length
      results.forEach(({ profile, hts }, i) => {
        context.fillStyle = colour('accent')
        context.fillRect(150, i * row + 6, (width - 220) * Math.max(0, hts) / 100, row - 12)
        context.fillStyle = colour('text')
        context.fillText(profile, 6, i * row + row / 2 + 4)
        context.fillText(hts.toFixed(1), 158 + (width - 220) * Math.max(0, hts) / 100, i * row + row / 2 + 4)
      })
    })
    view.say(results.map(({ profile, hts }) => `${profile}: HTS ${hts.toFixed(1)}`).join(', '))
  }
  await update()
}

const scenes = async (place, signal) => {
  const knock = await core.call('encode', await soundOf('knock_wood_bridge'))
  const drums = await core.call('encode', await soundOf('drums_tabla_pattern'))
  const count = knob(place, 'Parts', { min: 2, max: 60, step: 1, value: 24 }, () => update())
  const view = picture(place, 'The parts of a scene, those that are left out pale')
  const update = async () => {
    const parts = Number(count.value), duration = 6
    // Each farther away than the one before, in a fixed disorder.
    const plays = Array.from({ length: parts }, (_, i) => ({
      clip: i % 2, start: (i * 2.399) % (duration - 3.5), gain: i === 0 ? 0 : -90 * ((i * 7) % parts) / parts, name: `part ${i + 1}`
    }))
    const scene = { format: 'pacini.scene', version: 1, duration, clips: [{ file: '0' }, { file: '1' }], plays }
    const options = { clips: [knock, drums], profile: 'l5-wristband', sampleRate: rate }
    const timed = async (leaveOut) => {
      const started = performance.now()
      const result = await core.call('render', scene, { ...options, leaveOut })
      return { ...result, milliseconds: performance.now() - started }
    }
    await timed(true) // once to be warm
    const all = await timed(false), few = await timed(true)
    if (signal.aborted) return
    const out = new Set(few.leftOut.flatMap(({ where }) => /^plays\[(\d+)\]$/.exec(where)?.[1] ?? []).map(Number))
    view.draw((context, width, height) => {
      const row = height / parts
      plays.forEach(({ start, gain, clip }, i) => {
        context.fillStyle = colour(out.has(i) ? 'line' : 'accent')
        context.globalAlpha = out.has(i) ? 1 : 1 + gain / 120
        context.fillRect(start / duration * width, i * row, (clip === 0 ? 0.52 : 3.4) / duration * width, Math.max(1, row - 1))
      })
      context.globalAlpha = 1
    })
    let difference = 0, whole = 0
    for (let n = 0; n < all.samples.length; ++n) {
      difference += (all.samples[n] - few.samples[n]) ** 2
      whole += all.samples[n] ** 2
    }
    view.say(`${out.size} of ${parts} parts, and ${few.leftOut.length - out.size} bands of others, are left out: ` +
      `${few.milliseconds.toFixed(0)} ms instead of ${all.milliseconds.toFixed(0)}. What is missing lies ` +
      `${(-10 * Math.log10(difference / whole)).toFixed(0)} dB below the scene; promised were ${(-few.predictedError).toFixed(0)}.`)
  }
  await update()
}

const protection = async (place, signal) => {
  const clip = await core.call('encode', await soundOf('impact_boom'))
  const gain = knob(place, 'Gain, dB', { min: -12, max: 24, step: 1, value: 12 }, () => update())
  const view = picture(place, 'The drive signal without and with protection')
  const update = async () => {
    const options = { profile: 'l5-wristband', gain: Number(gain.value) }
    const free = await played(clip, { ...options, protect: false }), safe = await played(clip, options)
    if (signal.aborted) return
    const peakOf = (samples) => samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0)
    const full = Math.max(1, peakOf(free.samples))
    view.draw((context, width, height) => {
      wave(context, free.samples, { x: 0, y: 0, width, height: height / 2 }, colour('bad'), full)
      wave(context, safe.samples, { x: 0, y: height / 2, width, height: height / 2 }, colour('drive'), full)
      context.fillStyle = colour('dim')
      context.fillText('without protection', 6, 14)
      context.fillText('with protection', 6, height / 2 + 14)
    })
    view.say(`Without protection the largest sample is ${peakOf(free.samples).toFixed(2)}, with it ${peakOf(safe.samples).toFixed(2)}; ` +
      `at most ${safe.reduction.toFixed(1)} dB were taken back.`)
  }
  await update()
}

const time = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const view = picture(place, 'Likeness over the time that encoding took')
  const settings = [{ bands: 2, breakpoints: 5 }, { bands: 4, breakpoints: 10 }, { bands: 8, breakpoints: 15 }, { bands: 12, breakpoints: 20 },
    { bands: 16, breakpoints: 30 }, { bands: 24, breakpoints: 45 }, { bands: 32, breakpoints: 60 }]
  const points = []
  await core.call('encode', sound, settings.at(-1)) // once to be warm
  for (const setting of settings) {
    let best = Infinity, clip
    for (let run = 0; run < 5; ++run) {
      const started = performance.now()
      clip = await core.call('encode', sound, { ...setting, format: 'packed' })
      best = Math.min(best, performance.now() - started)
    }
    const hts = await likeness(sound, (await played(clip)).samples)
    if (signal.aborted) return
    points.push({ x: best, y: hts, label: setting.bands === 2 || setting.bands === 32 ? best.toFixed(1) : '', setting })
    view.draw((context, width, height) =>
      chart(context, width, height, points, { across: 'ms for half a second of sound', up: 'HTS', line: false, high: 100, logarithmic: true }))
    view.say(points.map(({ x, y, setting: { bands: b, breakpoints: p } }) => `${b} bands, ${p} points: ${x.toFixed(1)} ms, HTS ${y.toFixed(1)}`).join('; '))
  }
}

export const figures = { bands, breakpoints, actuators, scenes, protection, time }
