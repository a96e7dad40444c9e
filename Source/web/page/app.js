// The page: a sound or clip comes in, is shown, felt, changed and taken along.

import { readWav } from './pacini/sound.js'
import profiles from './pacini/profiles.js'
import { Core } from './core.js'
import { describeFeel, feel } from './feel.js'
import { draw } from './lanes.js'
import { keep, kept } from './store.js'

const element = (id) => document.getElementById(id)
const core = new Core() // encodes; ended when it works for nothing
const side = new Core() // everything else
const view = { clip: undefined, sound: undefined, mono: undefined, drive: undefined }
let name = 'clip', source = ''
const moved = new Set() // knobs that are not where the core has them by itself

const say = (text) => { element('status').textContent = text }
const complain = (error) => {
  if (error?.superseded) return
  const box = element('error')
  box.textContent = error ? (error.message ?? String(error)) : ''
  box.hidden = !error
  if (error) say('')
}

// ---- in

const isWav = (bytes) => bytes.length > 12 && String.fromCharCode(...bytes.subarray(0, 4)) === 'RIFF'
const monoOf = ({ samples }) => {
  if (!Array.isArray(samples)) return samples
  const mono = new Float32Array(samples[0].length)
  for (const channel of samples) for (let n = 0; n < mono.length; ++n) mono[n] += channel[n] / samples.length
  return mono
}

const decoded = async (bytes) => {
  // WAV sample for sample as the program reads it; everything else by the browser, at the rate of its own choice.
  if (isWav(bytes)) return readWav(bytes)
  const context = new OfflineAudioContext(1, 1, 48000)
  let buffer
  try {
    buffer = await context.decodeAudioData(bytes.slice().buffer)
  } catch {
    throw new Error('This is no sound that the browser can read, and no clip. WAV, FLAC, MP3 and Ogg work everywhere.')
  }
  return { samples: Array.from({ length: buffer.numberOfChannels }, (_, c) => buffer.getChannelData(c).slice()), sampleRate: buffer.sampleRate }
}

const extensionOf = (file) => /\.[^.]+$/.exec(file)?.[0].toLowerCase() ?? ''

const open = async (bytes, file) => {
  complain()
  name = file.replace(/\.[^.]+$/, '') || 'clip'
  say(`Reading ${file}...`)
  const clipFile = ['.pacb', '.json', '.ahap', '.haptic', '.haps', '.hjif', '.vij', '.tact', '.csv'].includes(extensionOf(file))
  if (clipFile) {
    const { clip, warnings } = await side.call('read', bytes, { extension: extensionOf(file) })
    view.sound = view.mono = undefined
    await shown(clip)
    say(warnings.length > 0 ? warnings.join(' ') : '')
    return
  }
  const sound = await decoded(bytes)
  if (sound.samples.length === 0 || monoOf(sound).length === 0) throw new Error(`${file} has no samples.`)
  view.sound = sound
  view.mono = monoOf(sound)
  await analyse(file)
}

const analyse = async (file) => {
  if (!view.sound) return
  core.cancel()
  const started = performance.now()
  say('Analysing...')
  const clip = await core.call('encode', view.sound, {
    name,
    source: source = file ?? source,
    ...Object.fromEntries(['bands', 'breakpoints', 'sensitivity'].filter((id) => moved.has(id)).map((id) => [id, Number(element(id).value)]))
  })
  await shown(clip)
  say(`Analysed in ${((performance.now() - started) / 1000).toFixed(2)} s.`)
}

const shown = async (clip) => {
  view.clip = clip
  for (const id of ['clip', 'export']) element(id).hidden = false
  element('lanes').setAttribute('aria-label',
    `${name}: ${clip.duration.toFixed(2)} s, ${clip.bands.length} bands, ${clip.transients.length} events`)
  for (const id of ['play-sound', 'play-both']) element(id).disabled = !view.sound
  for (const id of ['bands', 'breakpoints', 'sensitivity']) element(id).disabled = !view.sound
  draw(element('lanes'), view)
  await renderDrive()
  await remember()
}

const renderDrive = async () => {
  if (!view.clip) return
  const drive = await side.call('render', view.clip, {
    ...(element('profile').value ? { profile: element('profile').value } : {}), sampleRate: 48000,
    ...strength()
  })
  view.drive = drive.samples
  draw(element('lanes'), view)
  const { files } = await side.call('write', view.clip, { format: 'packed' })
  view.packed = files[0].bytes
  const points = view.clip.bands.reduce((sum, band) => sum + band.amplitude.length, 0)
  element('figures').textContent = `${view.clip.duration.toFixed(2)} s, ${view.packed.length} bytes packed, ` +
    `${points} breakpoints in ${view.clip.bands.length} bands, ${view.clip.transients.length} events` +
    (drive.reduction > 0.05 ? `; the actuator's protection takes ${drive.reduction.toFixed(1)} dB` : '')
  await showLosses()
}

const strength = () => moved.has('strength') ? { strength: Number(element('strength').value) } : {}

const remember = async () => {
  try {
    await keep({ name, source, sound: view.sound, clip: view.clip })
  } catch (error) {
    say(`This browser does not keep the clip over a reload (${error?.message ?? 'storage is refused'}). Save it.`)
  }
}

// ---- out

const formatNamed = (wanted) => formatList.find((format) => format.name === wanted)
let formatList = []
const exportOptions = (format) => ({
  format: format.name, name, ...strength(),
  ...(element('profile').value ? { profile: element('profile').value } : {})
})
const showLosses = async () => {
  const format = formatNamed(element('format').value)
  if (!format || !view.clip) return
  const { losses } = await side.call('write', view.clip, exportOptions(format))
  element('losses').textContent = losses.length === 0 ? format.keeps :
    `${format.keeps} Lost here: ${losses.slice(0, 3).map((loss) => loss.message).join('; ')}${losses.length > 3 ? `; and ${losses.length - 3} more` : ''}.`
}

const save = async () => {
  const format = formatNamed(element('format').value)
  const { files } = await side.call('write', view.clip, exportOptions(format))
  for (const { suffix, bytes } of files) {
    const link = document.createElement('a')
    link.href = URL.createObjectURL(new Blob([bytes]))
    link.download = `${name}${suffix}${format.extension}`
    link.click()
    setTimeout(() => URL.revokeObjectURL(link.href), 10000)
  }
}

const base64 = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')
const bytesOf = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0))
const share = async () => {
  if (view.packed.length > 20000) throw new Error('The clip is too long for a link; save it as a file.')
  const url = new URL(location.href)
  url.hash = `c=${base64(view.packed)}`
  history.replaceState(null, '', url)
  await navigator.clipboard.writeText(url.href)
  element('losses').textContent = `A link of ${url.href.length} characters is in the clipboard; it holds the whole clip.`
}

// ---- play

let context, playing
const stop = () => {
  playing?.abort()
  playing = undefined
  draw(element('lanes'), view)
}
const play = async (left, leftRate, right, rightRate) => {
  stop()
  const current = playing = new AbortController()
  context ??= new AudioContext()
  await context.resume()
  const merger = new ChannelMergerNode(context, { numberOfInputs: 2 })
  merger.connect(context.destination)
  const sources = [[left, leftRate], [right, rightRate]].map(([samples, rate], channel) => {
    const buffer = new AudioBuffer({ length: samples.length, sampleRate: rate })
    buffer.copyToChannel(samples, 0)
    const source = new AudioBufferSourceNode(context, { buffer })
    source.connect(merger, 0, channel)
    return source
  })
  const start = context.currentTime + 0.05
  sources.forEach((source) => source.start(start))
  current.signal.addEventListener('abort', () => sources.forEach((source) => source.stop()), { once: true })
  const tick = () => {
    if (current.signal.aborted) return
    const time = context.currentTime - start
    if (time > Math.max(...sources.map(({ buffer }) => buffer.duration))) return stop()
    draw(element('lanes'), view, Math.max(0, time))
    requestAnimationFrame(tick)
  }
  tick()
}

const feelIt = async () => {
  stop()
  const current = playing = new AbortController()
  const started = performance.now()
  const tick = () => {
    const time = (performance.now() - started) / 1000
    if (current.signal.aborted || time > view.clip.duration) return
    draw(element('lanes'), view, time)
    requestAnimationFrame(tick)
  }
  tick()
  const felt = await feel(view.clip, current.signal)
  element('feel-status').textContent = felt ? '' : describeFeel()
}

// ---- record

let recorder
const record = async () => {
  if (recorder) return recorder.stop()
  const stream = await navigator.mediaDevices.getUserMedia({ audio: true })
  const parts = []
  recorder = new MediaRecorder(stream)
  recorder.ondataavailable = ({ data }) => parts.push(data)
  recorder.onstop = async () => {
    recorder = undefined
    element('record').setAttribute('aria-pressed', 'false')
    element('record').textContent = 'Record'
    stream.getTracks().forEach((track) => track.stop())
    guarded(async () => open(new Uint8Array(await new Blob(parts).arrayBuffer()), 'recording.webm'))()
  }
  recorder.start()
  element('record').setAttribute('aria-pressed', 'true')
  element('record').textContent = 'Stop recording'
}

// ---- the page

const guarded = (work) => async (...parameters) => {
  try {
    await work(...parameters)
  } catch (error) {
    complain(error)
  }
}
const on = (id, event, work) => element(id).addEventListener(event, guarded(work))
const later = (work, milliseconds) => {
  let timer
  return () => {
    clearTimeout(timer)
    timer = setTimeout(guarded(work), milliseconds)
  }
}

for (const input of document.querySelectorAll('input[type=range]')) {
  const output = input.parentElement.querySelector('output')
  const show = () => { output.value = input.value }
  input.addEventListener('input', () => moved.add(input.id))
  input.addEventListener('input', show)
  show()
}
for (const [key, profile] of Object.entries(profiles)) element('profile').add(new Option(profile.name ?? key, key))
element('profile').add(new Option('none: plain drive', ''))
element('profile').value = 'l5-wristband'
const again = later(() => analyse(), 150)
for (const id of ['bands', 'breakpoints', 'sensitivity']) element(id).addEventListener('input', again)
element('strength').addEventListener('input', later(renderDrive, 100))
on('profile', 'change', renderDrive)
on('format', 'change', showLosses)
on('save', 'click', save)
on('share', 'click', share)
on('stop', 'click', stop)
on('feel', 'click', feelIt)
on('record', 'click', record)
on('play-sound', 'click', () => play(view.mono, view.sound.sampleRate, view.mono, view.sound.sampleRate))
on('play-drive', 'click', () => play(view.drive, 48000, view.drive, 48000))
on('play-both', 'click', () => play(view.mono, view.sound.sampleRate, view.drive, 48000))
on('file', 'change', async ({ target }) => {
  const [file] = target.files
  if (file) await open(new Uint8Array(await file.arrayBuffer()), file.name)
  target.value = ''
})
on('gallery', 'change', async ({ target }) => {
  if (!target.value) return
  const answer = await fetch(`gallery/${target.value}`)
  if (!answer.ok) throw new Error('This clip is not there.')
  await open(new Uint8Array(await answer.arrayBuffer()), target.value)
})
for (const event of ['dragenter', 'dragover'])
  document.addEventListener(event, (dragged) => {
    dragged.preventDefault()
    document.body.classList.add('dropping')
  })
document.addEventListener('dragleave', ({ relatedTarget }) => { if (!relatedTarget) document.body.classList.remove('dropping') })
document.addEventListener('drop', guarded(async (dropped) => {
  dropped.preventDefault()
  document.body.classList.remove('dropping')
  const [file] = dropped.dataTransfer.files
  if (file) await open(new Uint8Array(await file.arrayBuffer()), file.name)
}))
document.addEventListener('keydown', (event) => {
  if (event.key === 'Escape') stop()
  if (event.key === ' ' && event.target === element('lanes') && view.clip) {
    event.preventDefault()
    element(view.sound ? 'play-both' : 'play-drive').click()
  }
})
addEventListener('resize', () => { if (view.clip) draw(element('lanes'), view) })
matchMedia('(prefers-color-scheme: light)').addEventListener('change', () => { if (view.clip) draw(element('lanes'), view) })
for (const event of ['gamepadconnected', 'gamepaddisconnected'])
  addEventListener(event, () => { element('feel-status').textContent = describeFeel() })
element('feel-status').textContent = describeFeel()

guarded(async () => {
  const { default: gallery } = await import('./gallery/list.js')
  for (const file of gallery) element('gallery').add(new Option(file.replace(/\.pacb$/, '').replaceAll('_', ' '), file))
})()
guarded(async () => {
  for (const [id, value] of Object.entries(await side.call('defaults'))) {
    const input = element(id)
    input.value = value
    input.parentElement.querySelector('output').value = input.value
  }
  formatList = (await side.call('formats')).filter((format) => format.writes)
  for (const format of formatList) element('format').add(new Option(`${format.title} (${format.extension})`, format.name))
  const shared = new URLSearchParams(location.hash.slice(1)).get('c')
  if (shared) {
    let bytes
    try {
      bytes = bytesOf(shared)
    } catch {
      throw new Error('The link is damaged: it holds no clip.')
    }
    await open(bytes, 'shared.pacb')
    return
  }
  const before = await kept().catch(() => undefined)
  if (before?.clip) {
    name = before.name
    source = before.source
    view.sound = before.sound
    view.mono = before.sound ? monoOf(before.sound) : undefined
    await shown(before.clip)
  }
})()
if ('serviceWorker' in navigator && !new URLSearchParams(location.search).has('fresh'))
  navigator.serviceWorker.register('service-worker.js').catch(() => {})
document.documentElement.dataset.ready = 'true'
