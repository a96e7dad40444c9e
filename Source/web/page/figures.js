// Figures of the guide. Each is `(place, signal)`: an element to fill, and what says that the page is left. Each has something to
// hear and to feel.

import profiles from './pacini/profiles.js'
import { Core } from './core.js'
import { describeFeel, feelsNow, prepareFeel } from './feel.js'
import { valueAt } from './curve.js'
import { guardSlider } from './fields.js'
import { Peaks } from './peaks.js'
import { playPair, wholeSignal } from './sound-player.js'
import { counted, listed, number, t, told } from './text.js'
import { plainWords } from './words.js'

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()
const rate = 44100
const core = new Core()

/** One of the sounds of the guide, at its own rate. */
const soundOf = async (name) => {
  const answer = await fetch(`guide/${name}.flac`).catch(() => undefined)
  if (!answer?.ok) throw new Error(t('The sound of this figure cannot be loaded. Is the network there?'))
  const buffer = await new OfflineAudioContext(1, 1, rate).decodeAudioData(await answer.arrayBuffer())
  return { samples: buffer.getChannelData(0).slice(), sampleRate: rate }
}
/** A low blow: a tone that falls from 110 to 45 Hz and fades. Made here, so that nobody loads it. */
const boom = () => {
  const samples = new Float32Array(rate)
  for (let n = 0, phase = 0; n < samples.length; ++n) {
    const t = n / rate
    phase += 2 * Math.PI * (45 + 65 * Math.exp(-18 * t)) / rate
    samples[n] = 0.95 * Math.min(1, t / 0.004) * Math.exp(-4 * t) * Math.sin(phase) * Math.min(1, (1 - t) / 0.1)
  }
  return { samples, sampleRate: rate }
}
/** A sound over and over, `seconds` long. */
const repeated = ({ samples, sampleRate }, seconds) =>
  ({ samples: Float32Array.from({ length: seconds * sampleRate }, (_, n) => samples[n % samples.length]), sampleRate })

// ---- parts of figures

const made = (place, tag, attributes = {}) => {
  const part = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes))
    if (name === 'text') part.textContent = value
    else part.setAttribute(name, value)
  place.append(part)
  return part
}
const knob = (place, text, { min, max, step, value, shown = String }, changed) => {
  const label = made(place, 'label', { text: `${text} ` })
  const input = made(label, 'input', { type: 'range', min, max, step, value })
  const output = made(label, 'output', { text: shown(value) })
  let timer
  guardSlider(input)
  input.addEventListener('input', () => {
    output.textContent = shown(input.value)
    clearTimeout(timer)
    timer = setTimeout(changed, 100)
  })
  return input
}
/** A picture with what it says in words beneath. */
const picture = (place, label) => {
  const canvas = made(place, 'canvas', { class: 'small', role: 'img', 'aria-label': label })
  const words = made(place, 'p', { role: 'status', class: 'words', text: t('Computing...') })
  let work
  const paint = () => {
    if (!work) return
    const scale = devicePixelRatio || 1
    canvas.width = Math.round(canvas.clientWidth * scale)
    canvas.height = Math.round(canvas.clientHeight * scale)
    const context = canvas.getContext('2d')
    context.setTransform(scale, 0, 0, scale, 0, 0)
    context.font = '12px system-ui, sans-serif'
    work(context, canvas.clientWidth, canvas.clientHeight)
  }
  new ResizeObserver(paint).observe(canvas)
  return {
    /** Says what was computed, which can be heard from then on. */
    say: (text) => {
      words.textContent = text
      for (const button of place.querySelectorAll('.ways button')) button.disabled = false
    },
    draw: (given) => {
      work = given
      paint()
    }
  }
}
/**
 * Buttons beneath a figure: `ways` are `[text, work]`, where work promises samples to be heard, or `{clip, samples}` to be felt
 * together with its sound.
 */
const ways = (place, signal, all) => {
  const row = made(place, 'div', { class: 'row ways' }), words = made(place, 'p', { role: 'status', class: 'words' })
  let control
  const stop = () => {
    control?.abort()
    control = undefined
    for (const button of row.children) button.setAttribute('aria-pressed', 'false')
  }
  signal.addEventListener('abort', stop)
  for (const [text, work] of all) {
    const button = made(row, 'button', { type: 'button', 'aria-pressed': 'false', disabled: '', text })
    button.addEventListener('click', async () => {
      const wasOn = button.getAttribute('aria-pressed') === 'true'
      stop()
      words.textContent = ''
      if (wasOn) return
      const own = control = new AbortController()
      button.setAttribute('aria-pressed', 'true')
      try {
        const made = await work(), { clip, samples } = made.clip ? made : { samples: made }
        if (own.signal.aborted) return
        if (clip) words.textContent = describeFeel()
        if (clip && !feelsNow()) return
        const heard = wholeSignal(samples, rate), touch = clip && await prepareFeel(clip, (...parameters) => core.call(...parameters))
        let feeling
        await playPair(heard, heard, { signal: own.signal, started: (clock) => {
          feeling = touch?.(own.signal, clock)
        } })
        await feeling
      } catch (error) {
        words.textContent = plainWords(error)
      } finally {
        if (own === control) stop()
      }
    })
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
/** Points `{x, to, y, label, isOn}` on axes, from `x` to `to`; `line`: joined. A label that would touch the one before is left out. */
const chart = (context, width, height, points, { across, up, line, low = 0, high, logarithmic }) => {
  const left = 44, bottom = height - 36, right = width - 16, top = 28
  const most = Math.max(...points.map(({ x, to = x }) => to)) * 1.1, least = Math.min(...points.map(({ x }) => x)) / 1.2
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
    context.fillText(number(value, 0), 12, yAt(value) + 4)
  }
  context.fillText(across, Math.max(left, right - context.measureText(across).width), height - 4)
  context.fillText(up, 12, 12)
  if (line) {
    context.strokeStyle = colour('accent')
    context.lineWidth = 2
    context.beginPath()
    points.forEach(({ x, y }, i) => i === 0 ? context.moveTo(xAt(x), yAt(y)) : context.lineTo(xAt(x), yAt(y)))
    context.stroke()
    context.lineWidth = 1
  }
  let labelled = -Infinity // where the last label ends
  for (const { x, to, y, label, isOn } of line ? points : points.toSorted((a, b) => a.x - b.x)) {
    context.fillStyle = colour(isOn ? 'event' : 'accent')
    context.beginPath()
    context.arc(xAt(x), yAt(y), isOn ? 7 : 4, 0, 2 * Math.PI)
    context.fill()
    if (to > x) context.fillRect(xAt(x), yAt(y) - 1, xAt(to) - xAt(x), 2)
    const size = context.measureText(label).width, at = Math.min(Math.max(left, xAt(x) - size / 2), right - size)
    if (label === '' || at < labelled + 6) continue
    context.fillStyle = colour('dim')
    context.fillText(label, at, bottom + 16)
    labelled = at + size
  }
}

const likeness = async (sound, samples) => (await core.call('compare', sound, { samples, sampleRate: rate })).hts
const played = (clip, options = {}) => core.call('render', clip, { sampleRate: rate, ...options })
const peakOf = (samples) => samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0)
/** As loud as it may be. */
const loud = (samples) => {
  const peak = peakOf(samples)
  return peak > 0 ? samples.map((sample) => 0.9 * sample / peak) : samples
}

// ---- the figures

const bands = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const count = knob(place, t('Bands'), { min: 1, max: 24, step: 1, value: 12 }, () => update())
  const view = picture(place, t('The sound, and what is played of a clip with so many bands'))
  let clip, drive
  ways(place, signal, [[t('Play the sound'), () => sound.samples], [t('Listen to the haptics'), () => drive],
    [t('Feel it'), () => ({ clip, samples: sound.samples })]])
  const update = async () => {
    clip = await core.call('encode', sound, { bands: Number(count.value) })
    drive = (await played(clip)).samples
    const hts = await likeness(sound, drive)
    if (signal.aborted) return
    const shown = clip, heard = drive
    view.draw((context, width, height) => {
      const loudest = Math.max(1e-3, ...shown.bands.flatMap(({ amplitude }) => amplitude.map((point) => point.amplitude)))
      wave(context, sound.samples, { x: 0, y: 0, width, height: height * 0.36 }, colour('sound'))
      const part = height * 0.26 / shown.bands.length
      shown.bands.forEach(({ amplitude }, i) => {
        context.fillStyle = colour('accent')
        for (let x = 0; x < width; x += 2) {
          const level = 1 + 20 * Math.log10(Math.max(1e-9, valueAt(amplitude, x / width * shown.duration)) / loudest) / 48
          context.globalAlpha = Math.min(1, Math.max(0, level)) ** 1.5
          context.fillRect(x, height * 0.64 - (i + 1) * part, 2, Math.max(1, part - 1))
        }
      })
      context.globalAlpha = 1
      wave(context, heard, { x: 0, y: height * 0.66, width, height: height * 0.34 }, colour('drive'))
    })
    const points = clip.bands.reduce((sum, { amplitude }) => sum + amplitude.length, 0)
    view.say(counted(Number(count.value), '{0} band, {1} points: likeness (HTS) {2} of 100.', '{0} bands, {1} points: likeness (HTS) {2} of 100.', points, number(hts, 1)))
  }
  await update()
}

const breakpoints = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const counts = [1, 2, 4, 6, 10, 15, 20, 30, 45, 60]
  const chosen = knob(place, t('Breakpoints per second to hear'), { min: 0, max: counts.length - 1, step: 1, value: 6, shown: (i) => counts[i] }, () => draw())
  const view = picture(place, t('Likeness over the number of breakpoints per second'))
  const points = []
  const one = () => points[Math.min(Number(chosen.value), points.length - 1)]
  ways(place, signal, [[t('Play the sound'), () => sound.samples], [t('Listen to the haptics'), () => one().drive],
    [t('Feel it'), () => ({ clip: one().packed, samples: sound.samples })]])
  const draw = () => view.draw((context, width, height) => chart(context, width, height, points.map((point) => ({ ...point, isOn: point === one() })),
    { across: t('breakpoints per second and band'), up: t('likeness (HTS)'), line: true, high: 100, logarithmic: true }))
  for (const count of counts) {
    const packed = await core.call('encode', sound, { breakpoints: count, format: 'packed' })
    const drive = (await played(packed)).samples
    const hts = await likeness(sound, drive)
    if (signal.aborted) return
    points.push({ x: count, y: hts, label: String(count), bytes: packed.length, packed, drive })
    draw()
  }
  view.say(points.map(({ x, y, bytes }) => t('{0}: {1} ({2} bytes)', x, number(y, 1), bytes)).join('; '))
}

const actuators = async (place, signal) => {
  const sound = await soundOf('knock_wood_bridge')
  const clip = await core.call('encode', sound)
  const names = ['l5-wristband', 'dualsense-voice-coil', 'joycon-hd-rumble', 'lra-175', 'erm-coin']
  const titleOf = (profile) => told(profiles[profile].name ?? profile)
  const strength = knob(place, t('Strength'), { min: 0, max: 1, step: 0.1, value: 0.4, shown: (value) => `${number(100 * value, 0)} %` }, () => update())
  const label = made(place, 'label', { text: `${t('Actuator to listen to')} ` }), chosen = made(label, 'select')
  for (const name of names) chosen.add(new Option(titleOf(name), name))
  const view = picture(place, t('How close what is felt is to the sound, for five actuators'))
  const felt = (profile) => core.call('felt', clip, { profile, strength: Number(strength.value), sampleRate: rate })
  ways(place, signal, [[t('Play the sound'), () => sound.samples],
    [t('Listen to what is felt'), async () => loud((await felt(chosen.value)).samples)],
    [t('Feel it'), () => ({ clip, samples: sound.samples })]])
  let newest = 0
  const update = async () => {
    const own = ++newest, results = []
    for (const profile of names) {
      const { samples } = await felt(profile)
      results.push({ profile, hts: await likeness(sound, samples) })
      if (signal.aborted || own !== newest) return
    }
    view.draw((context, width, height) => {
      const row = height / names.length, right = width - 44
      results.forEach(({ profile, hts }, i) => {
        context.fillStyle = colour('text')
        context.fillText(titleOf(profile), 0, i * row + 14)
        context.fillText(number(hts, 1), 6 + right * Math.max(0, hts) / 100, i * row + row / 2 + 12)
        context.fillStyle = colour('accent')
        context.fillRect(0, i * row + 20, right * Math.max(0, hts) / 100, row - 28)
      })
    })
    view.say(listed(results.map(({ profile, hts }) => t('{0}: likeness (HTS) {1}', titleOf(profile), number(hts, 1)))))
  }
  await update()
}

const scenes = async (place, signal) => {
  const knock = await core.call('encode', await soundOf('knock_wood_bridge'))
  const button = await core.call('encode', await soundOf('ui_click'))
  const count = knob(place, t('Parts'), { min: 10, max: 200, step: 10, value: 100 }, () => update())
  const view = picture(place, t('The parts of a scene; those left out are pale'))
  let all, few
  ways(place, signal, [[t('Listen to all parts'), () => loud(all.samples)], [t('Listen without those left out'), () => loud(few.samples)]])
  const update = async () => {
    const parts = Number(count.value), duration = 6
    // One in ten is near by; the others are far away, in a fixed disorder.
    const plays = Array.from({ length: parts }, (_, i) => ({
      clip: i % 2, start: (i * 2.399) % (duration - 0.6), gain: i % 10 === 0 ? -2 * (i % 7) : -88 - 25 * ((i * 7) % parts) / parts, name: `part ${i + 1}`
    }))
    const scene = { format: 'pacini.scene', version: 1, duration, clips: [{ file: '0' }, { file: '1' }], plays }
    const options = { clips: [knock, button], profile: 'l5-wristband', sampleRate: 8000 }
    const timed = async (leaveOut) => { // the best of three
      let best
      for (let run = 0; run < 3; ++run) {
        const result = await core.call('render', scene, { ...options, leaveOut }), milliseconds = core.took
        if (!best || milliseconds < best.milliseconds) best = { ...result, milliseconds }
      }
      return best
    }
    await timed(true) // once to be warm
    const whole = await timed(false), part = await timed(true)
    if (signal.aborted) return
    all = await core.call('render', scene, { ...options, sampleRate: rate, leaveOut: false })
    few = await core.call('render', scene, { ...options, sampleRate: rate })
    if (signal.aborted) return
    const out = new Set(part.leftOut.flatMap(({ where }) => /^plays\[(\d+)\]$/.exec(where)?.[1] ?? []).map(Number))
    view.draw((context, width, height) => {
      const row = height / parts
      plays.forEach(({ start, clip }, i) => {
        context.fillStyle = colour(out.has(i) ? 'line' : 'accent')
        context.fillRect(start / duration * width, i * row, (clip === 0 ? knock : button).duration / duration * width, Math.max(1, row - 1))
      })
    })
    let difference = 0, energy = 0
    for (let n = 0; n < whole.samples.length; ++n) {
      difference += (whole.samples[n] - part.samples[n]) ** 2
      energy += whole.samples[n] ** 2
    }
    view.say(t('{0} of {1} parts are left out: {2} times as fast ({3} ms instead of {4} ms). The missing parts are {5} dB below the scene; {6} dB was predicted.',
      out.size, parts, number(whole.milliseconds / part.milliseconds, 1), number(part.milliseconds, 0), number(whole.milliseconds, 0),
      number(-10 * Math.log10(difference / energy), 0), number(-part.predictedError, 0)))
  }
  await update()
}

const protection = async (place, signal) => {
  const sound = boom()
  const clip = await core.call('encode', sound)
  const gain = knob(place, t('Gain'), { min: -12, max: 24, step: 1, value: 12, shown: (value) => `${number(Number(value))} dB` }, () => update())
  const view = picture(place, t('The drive signal without and with protection'))
  let free, safe, full
  const scaled = (samples) => samples.map((sample) => sample / full)
  ways(place, signal, [[t('Listen without protection'), () => scaled(free.samples)], [t('Listen with protection'), () => scaled(safe.samples)],
    [t('Feel it'), () => ({ clip, samples: sound.samples })]])
  const update = async () => {
    const options = { profile: 'l5-wristband', gain: Number(gain.value) }
    free = await played(clip, { ...options, protect: false })
    safe = await played(clip, options)
    if (signal.aborted) return
    full = Math.max(1, peakOf(free.samples))
    const [loudest, limited, most] = [free.samples, safe.samples, full]
    view.draw((context, width, height) => {
      wave(context, loudest, { x: 0, y: 18, width, height: height / 2 - 20 }, colour('bad'), most)
      wave(context, limited, { x: 0, y: height / 2 + 18, width, height: height / 2 - 20 }, colour('drive'), most)
      context.fillStyle = colour('dim')
      context.fillText(t('without protection'), 0, 12)
      context.fillText(t('with protection'), 0, height / 2 + 12)
    })
    view.say(t('The largest sample is {0} without protection and {1} with it, which reduces the signal by up to {2} dB.',
      number(peakOf(free.samples), 2), number(peakOf(safe.samples), 2), number(safe.reduction, 1)))
  }
  await update()
}

const time = async (place, signal) => {
  // Long enough that the clock of a browser tells settings apart, and in turns, so that whatever else runs meets all of them.
  const length = 30, short = await soundOf('knock_wood_bridge'), sound = repeated(short, length)
  const view = picture(place, t('Likeness over the time that encoding took, from the best run to the middle one'))
  const settings = [{ bands: 1, breakpoints: 2 }, { bands: 2, breakpoints: 5 }, { bands: 4, breakpoints: 10 }, { bands: 8, breakpoints: 15 },
    { bands: 12, breakpoints: 20 }, { bands: 24, breakpoints: 45 }, { bands: 32, breakpoints: 60 }]
  const points = []
  for (const setting of settings) {
    const clip = await core.call('encode', short, { ...setting, format: 'packed' }), drive = (await played(clip)).samples
    points.push({ y: await likeness(short, drive), setting, clip, drive, runs: [] })
    if (signal.aborted) return
  }
  ways(place, signal, [[t('Play the sound'), () => short.samples],
    [t('Listen to the fastest'), () => points[0].drive], [t('Listen to the default'), () => points[4].drive],
    [t('Feel the default'), () => ({ clip: points[4].clip, samples: short.samples })]])
  await core.call('encode', sound, settings.at(-1)) // once to be warm
  for (let run = 0; run < 7; ++run) {
    for (const point of points) {
      await core.call('encode', sound, { ...point.setting, format: 'packed' })
      point.runs = [...point.runs, core.took].sort((a, b) => a - b)
      if (signal.aborted) return
      point.x = point.runs[0]
      point.to = point.runs[Math.floor(point.runs.length / 2)]
      point.label = number(point.x, 0)
    }
    view.draw((context, width, height) =>
      chart(context, width, height, points, { across: t('ms for {0} s of sound', length), up: t('likeness (HTS)'), line: false, high: 100, logarithmic: true }))
  }
  const { x } = points[4]
  view.say(`${t('The default takes {0} ms, {1} times faster than the sound plays.', number(x, 0), number(1000 * length / x, 0))} ` +
    points.map(({ x: ms, y, setting: { bands: b, breakpoints: p } }) =>
      counted(b, '{0} band, {1} points: {2} ms, {3}', '{0} bands, {1} points: {2} ms, {3}', p, number(ms, 0), number(y, 1))).join('; ') + '.')
}

export const figures = { bands, breakpoints, actuators, scenes, protection, time }
