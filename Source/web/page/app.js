// The page: a sound or clip comes in, is shown, felt, changed and taken along.

import { readWav } from './pacini/sound.js'
import profiles from './pacini/profiles.js'
import { Core } from './core.js'
import { startEditing } from './editing.js'
import { connectController, describeFeel, feel, feelsNow } from './feel.js'
import { canAsk, remembered } from './hid.js'
import { History } from './history.js'
import { byKind } from './kinds.js'
import { Lanes } from './lanes.js'
import { Live } from './live.js'
import { Peaks } from './peaks.js'
import { channelCount, playPair } from './sound-player.js'
import { keep, kept } from './store.js'
import { zip } from './zip.js'

const element = (id) => document.getElementById(id)
const core = new Core() // encodes; ended when it works for nothing
const side = new Core() // everything else
const history = new History() // of `{name, source, sound, clip}`
const lanes = new Lanes(element('lanes'))
/** What is shown: of the document that history has now, and of what is computed of it. */
const view = { clip: undefined, lane: 'total', selected: 0, sound: undefined, drive: undefined, picture: undefined, soundRate: 1, driveRate: 48000 }
let soundShown // of the document
let mono // of that
let drive // samples for the chosen actuator
let packed
let cursor = 0 // s: where playing begins
const moved = new Set() // knobs that are not where the core has them by itself

const say = (text) => { element('status').textContent = text }
const complain = (error) => {
  if (error?.superseded) return
  const box = element('error')
  box.textContent = error ? (error.message ?? String(error)) : ''
  box.hidden = !error
  if (error) say('')
}
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
/** Draws with the next picture, once. */
let drawn
const look = () => {
  if (drawn || !view.clip) return
  drawn = requestAnimationFrame(() => {
    drawn = undefined
    lanes.draw(view, playing ? playing.time : cursor > 0 ? cursor : undefined)
    drawPicture()
  })
}

// ---- in

const isWav = (bytes) => bytes.length > 12 && String.fromCharCode(...bytes.subarray(0, 4)) === 'RIFF'
const monoOf = ({ samples }) => {
  if (!Array.isArray(samples)) return samples
  const mean = new Float32Array(samples[0].length)
  for (const channel of samples) for (let n = 0; n < mean.length; ++n) mean[n] += channel[n] / samples.length
  return mean
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
const clipExtensions = ['.pacb', '.json', '.ahap', '.haptic', '.haps', '.hjif', '.vij', '.hasp', '.tact', '.csv']

const open = async (bytes, file) => {
  complain()
  const name = file.replace(/\.[^.]+$/, '') || 'clip'
  say(`Reading ${file}...`)
  if (clipExtensions.includes(extensionOf(file))) {
    const { clip, warnings } = await side.call('read', bytes, { extension: extensionOf(file) })
    await take(`Open ${file}`, { name, source: file, sound: undefined, clip })
    say(warnings.length > 0 ? warnings.join(' ') : '')
    return
  }
  const sound = await decoded(bytes)
  if (sound.samples.length === 0 || monoOf(sound).length === 0) throw new Error(`${file} has no samples.`)
  await analyse(`Open ${file}`, { name, source: file, sound })
}

/** A clip of the sound of a document, by the knobs. */
const analyse = async (what, { name, source, sound }, burst) => {
  core.cancel()
  const started = performance.now()
  say('Analysing...')
  const clip = await core.call('encode', sound, {
    name, source, ...Object.fromEntries(['bands', 'breakpoints', 'sensitivity'].filter((id) => moved.has(id)).map((id) => [id, Number(element(id).value)]))
  })
  await take(what, { name, source, sound, clip }, burst)
  say(`Analysed in ${((performance.now() - started) / 1000).toFixed(2)} s.`)
}

// ---- shown

/** A new document, as a step that can be undone. */
const take = async (what, document, burst) => {
  history.push(what, document, burst)
  await show()
}

/** The document that history has now. */
const show = async () => {
  const document = history.now
  const sameSound = mono !== undefined && document.sound === soundShown
  soundShown = document.sound
  if (!sameSound) {
    mono = document.sound ? monoOf(document.sound) : undefined
    view.sound = mono ? new Peaks(mono) : undefined
    view.soundRate = document.sound?.sampleRate ?? 1
    view.picture = undefined
  }
  if (view.clip?.duration !== document.clip.duration || !sameSound) {
    lanes.showAll(document.clip.duration)
    cursor = 0
    view.selected = 0
  }
  view.clip = document.clip
  for (const id of ['clip', 'export']) element(id).hidden = false
  element('lanes').setAttribute('aria-label',
    `${document.name}: ${view.clip.duration.toFixed(2)} s, ${view.clip.bands.length} bands, ${view.clip.transients.length} events`)
  for (const id of ['play-sound', 'play-both', 'bands', 'breakpoints', 'sensitivity', 'spectrogram']) element(id).disabled = !mono
  for (const [id, what] of [['undo', history.undoes], ['redo', history.redoes]]) {
    element(id).disabled = what === undefined
    element(id).title = what ?? ''
  }
  editing.refresh()
  look()
  await renderDrive()
  await remember()
}

// While a point is dragged, what is not yet rendered is passed over for what is newer.
let rendering, staleDrive = false
const renderDrive = async () => {
  staleDrive = true
  rendering ??= (async () => {
    try {
      while (staleDrive) {
        staleDrive = false
        await renderNow()
      }
    } finally {
      rendering = undefined
    }
  })()
  return rendering
}

const renderNow = async () => {
  const { clip } = view
  if (!clip) return
  const rendered = await side.call('render', clip, { ...profileOption(), sampleRate: view.driveRate, ...strength() })
  if (clip !== view.clip) return // a newer one comes
  drive = rendered.samples
  view.drive = new Peaks(drive)
  look()
  const { files } = await side.call('write', clip, { format: 'packed' })
  packed = files[0].bytes
  const points = clip.bands.reduce((sum, band) => sum + band.amplitude.length, 0)
  element('figures').textContent = `${clip.duration.toFixed(2)} s, ${packed.length} bytes packed, ` +
    `${points} breakpoints in ${clip.bands.length} bands, ${clip.transients.length} events` +
    (rendered.reduction > 0.05 ? `; the actuator's protection takes ${rendered.reduction.toFixed(1)} dB` : '')
  await showLosses()
  if (element('comparison').open) await compare()
}

const profileOption = () => element('profile').value ? { profile: element('profile').value } : {}
const strength = () => moved.has('strength') ? { strength: Number(element('strength').value) } : {}

let pictureWanted = false, pictureOf = ''
/** The spectrogram of what is shown, when it is asked for and not there. */
const drawPicture = guarded(async () => {
  if (!pictureWanted || !mono) return
  const { from, to } = lanes.range, dark = !matchMedia('(prefers-color-scheme: light)').matches
  const wanted = `${from} ${to} ${dark} ${history.now.source}`
  if (wanted === pictureOf) return
  pictureOf = wanted
  const margin = 0.2, { sampleRate } = history.now.sound
  const first = Math.max(0, Math.floor((from - margin) * sampleRate)), offset = first / sampleRate
  const part = mono.slice(first, Math.ceil((to + margin) * sampleRate))
  const columns = Math.min(1600, Math.max(1, element('lanes').clientWidth))
  const { width, height, pixels } = await side.call('spectrogram', { samples: part, sampleRate }, { from: from - offset, to: to - offset, columns, dark })
  if (wanted !== pictureOf || !pictureWanted) return
  const canvas = new OffscreenCanvas(width, height)
  canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), width, height), 0, 0)
  view.picture = { canvas, from, to }
  look()
})

const remember = async () => {
  try {
    await keep(history.now)
    element('storage').textContent = ''
  } catch (error) {
    const full = error?.name === 'QuotaExceededError'
    element('storage').textContent = (full ? 'This browser has no room to keep the sound and the clip over a reload. Save the clip.'
      : `This browser does not keep the clip over a reload (${error?.message ?? 'storage is refused'}). Save it.`)
  }
}

// What the measures of a comparison say, best first.
const measures = [
  ['hts', 'HTS: likeness of envelope, bands, spectrum and events', (x) => `${x.toFixed(1)} of 100`],
  ['ceiling', 'HTS of the sound below 1 kHz with itself: what can be reached', (x) => `${x.toFixed(1)} of 100`],
  ['match', 'Match: what people would say of it, predicted', (x) => `${x.toFixed(1)} of 100`],
  ['lsd', 'Distance of the spectra', (x) => `${x.toFixed(2)} dB`],
  ['centroidError', 'Error of the centre of the spectrum', (x) => `${x.toFixed(2)} semitones`],
  ['outOfBand', 'Energy outside of what is felt', (x) => `${x.toFixed(1)} dB`]
]
const compare = async () => {
  const status = element('comparison-status'), table = element('measures')
  if (!mono) {
    table.hidden = true
    status.textContent = 'A clip without its sound cannot be compared.'
    return
  }
  status.textContent = 'Comparing...'
  const { clip } = view, { sampleRate } = history.now.sound
  const plain = await side.call('render', clip, { sampleRate })
  const figures = await side.call('compare', { samples: mono, sampleRate }, { samples: plain.samples, sampleRate })
  if (clip !== view.clip) return
  table.tBodies[0].replaceChildren(...measures.map(([key, what, text]) => {
    const row = document.createElement('tr'), head = document.createElement('th')
    head.scope = 'row'
    head.textContent = what
    row.append(head)
    row.insertCell().textContent = figures[key] === null || figures[key] === undefined ? 'says nothing here' : text(figures[key])
    return row
  }))
  table.hidden = false
  status.textContent = ''
}

// ---- out

let formatList = []
const formatNamed = (wanted) => formatList.find((format) => format.name === wanted)
const exportOptions = (format) => ({ format: format.name, name: history.now.name, ...strength(), ...profileOption() })
const lostText = (losses) => `Lost here: ${losses.slice(0, 3).map((loss) => loss.message).join('; ')}${losses.length > 3 ? `; and ${losses.length - 3} more` : ''}.`
const showLosses = async () => {
  const format = formatNamed(element('format').value)
  if (!format || !view.clip) return
  const { losses } = await side.call('write', view.clip, exportOptions(format))
  element('losses').textContent = losses.length === 0 ? format.keeps : `${format.keeps} ${lostText(losses)}`
}

const download = (parts, file) => {
  const link = document.createElement('a')
  link.href = URL.createObjectURL(new Blob(parts))
  link.download = file
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 10000)
}
const save = async () => {
  const format = formatNamed(element('format').value)
  const { files } = await side.call('write', view.clip, exportOptions(format))
  for (const { suffix, bytes } of files) download([bytes], `${history.now.name}${suffix}${format.extension}`)
}
const saveAll = async () => {
  const { name } = history.now, all = [], refused = []
  for (const format of formatList) {
    try {
      const { files } = await side.call('write', view.clip, exportOptions(format))
      for (const { suffix, bytes } of files) all.push({ name: `${name}/${format.name}/${name}${suffix}${format.extension}`, bytes })
    } catch (error) {
      refused.push(`${format.title} (${error.message})`)
    }
  }
  download(zip(all), `${name}.zip`)
  element('losses').textContent = `${all.length} files in ${name}.zip.${refused.length > 0 ? ` Not in it: ${refused.join('; ')}.` : ''}`
}

const base64 = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')
const bytesOf = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0))
const share = async () => {
  if (packed.length > 20000) throw new Error('The clip is too long for a link; save it as a file.')
  const url = new URL(location.href)
  url.hash = `c=${base64(packed)}`
  window.history.replaceState(null, '', url)
  await navigator.clipboard.writeText(url.href)
  element('losses').textContent = `A link of ${url.href.length} characters is in the clipboard; it holds the whole clip.`
}

// ---- play

let playing // {time, control}
const stop = () => {
  playing?.control.abort()
  playing = undefined
  look()
}
const playThat = async (work) => {
  stop()
  const own = playing = { time: cursor, control: new AbortController() }
  try {
    return await work({
      from: cursor, signal: own.control.signal,
      moved: (time) => {
        own.time = time
        look()
      }
    })
  } finally {
    if (playing === own) stop()
  }
}
const soundPart = () => ({ samples: mono, sampleRate: history.now.sound.sampleRate })
const drivePart = () => ({ samples: drive, sampleRate: view.driveRate })
const feelIt = () => playThat(async (how) => {
  if (!feelsNow()) {
    element('feel-status').textContent = describeFeel()
    return
  }
  const started = performance.now()
  const tick = () => {
    if (how.signal.aborted) return
    how.moved(Math.min((performance.now() - started) / 1000, view.clip.duration))
    requestAnimationFrame(tick)
  }
  tick()
  await feel(view.clip, how.signal, (...parameters) => side.call(...parameters))
  element('feel-status').textContent = describeFeel()
})

const live = new Live()
const switchLive = async () => {
  const button = element('live')
  if (live.isOn) await live.stop()
  else await live.start(profileOption().profile)
  button.setAttribute('aria-pressed', String(live.isOn))
  element('feel-status').textContent = live.isOn
    ? `What the microphone hears is played as touch on the sound output, ${(1000 * live.latency).toFixed(0)} ms late by itself.` : describeFeel()
}

// ---- record

let recorder
const record = async () => {
  if (recorder) return recorder.stop()
  const stream = await navigator.mediaDevices.getUserMedia({ audio: true })
  const recorded = []
  recorder = new MediaRecorder(stream)
  recorder.ondataavailable = ({ data }) => recorded.push(data)
  recorder.onstop = async () => {
    recorder = undefined
    element('record').setAttribute('aria-pressed', 'false')
    element('record').textContent = 'Record'
    stream.getTracks().forEach((track) => track.stop())
    guarded(async () => open(new Uint8Array(await new Blob(recorded).arrayBuffer()), 'recording.webm'))()
  }
  recorder.start()
  element('record').setAttribute('aria-pressed', 'true')
  element('record').textContent = 'Stop recording'
}

// ---- the page

const editing = startEditing({
  canvas: element('lanes'), lanes, state: view, element, look, say: (text) => { element('selected').textContent = text },
  change: guarded((what, clip, burst) => take(what, { ...history.now, clip }, burst)),
  playhead: (time) => {
    if (time !== undefined) {
      cursor = time
      look()
    }
    return cursor
  }
})
const travel = async (way) => {
  const before = history.now
  history[way]()
  if (history.now !== before) await show()
}

for (const input of document.querySelectorAll('input[type=range]')) {
  const output = input.parentElement.querySelector('output')
  const showValue = () => { output.value = input.value }
  input.addEventListener('input', () => moved.add(input.id))
  input.addEventListener('input', showValue)
  showValue()
}
for (const [key, profile] of Object.entries(profiles)) element('profile').add(new Option(profile.name ?? key, key))
element('profile').add(new Option('none: plain drive', ''))
element('profile').value = 'l5-wristband'
for (let channel = 1; channel < channelCount(); ++channel) element('channel').add(new Option(channel === 1 ? '2, right' : String(channel + 1), String(channel)))
let turns = 0 // of knobs: what one turn changes is one step
const again = later(() => analyse('Analyse', history.now, `turn ${turns}`), 150)
for (const id of ['bands', 'breakpoints', 'sensitivity']) {
  element(id).addEventListener('input', again)
  element(id).addEventListener('pointerdown', () => ++turns)
  element(id).addEventListener('focus', () => ++turns)
}
element('strength').addEventListener('input', later(renderDrive, 100))
on('profile', 'change', renderDrive)
on('format', 'change', showLosses)
on('save', 'click', save)
on('save-all', 'click', saveAll)
on('share', 'click', share)
on('stop', 'click', stop)
on('feel', 'click', feelIt)
on('record', 'click', record)
on('live', 'click', switchLive)
on('undo', 'click', () => travel('undo'))
on('redo', 'click', () => travel('redo'))
on('play-sound', 'click', () => playThat((how) => playPair(soundPart(), soundPart(), how)))
on('play-drive', 'click', () => playThat((how) => playPair(drivePart(), drivePart(), how)))
on('play-both', 'click', () => playThat((how) => playPair(soundPart(), drivePart(), { ...how, channel: Number(element('channel').value) })))
on('comparison', 'toggle', () => element('comparison').open ? compare() : undefined)
on('spectrogram', 'click', () => {
  pictureWanted = !pictureWanted
  pictureOf = ''
  element('spectrogram').setAttribute('aria-pressed', String(pictureWanted))
  if (!pictureWanted) view.picture = undefined
  look()
})
on('controller', 'click', async () => {
  await connectController()
  element('feel-status').textContent = describeFeel()
})
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
  const typing = event.target instanceof HTMLInputElement && event.target.type === 'number'
  if ((event.ctrlKey || event.metaKey) && !typing && view.clip) {
    const way = event.key.toLowerCase() === 'y' || (event.key.toLowerCase() === 'z' && event.shiftKey) ? 'redo'
      : event.key.toLowerCase() === 'z' ? 'undo' : undefined
    if (way) {
      event.preventDefault()
      guarded(travel)(way)
    }
  }
  if (event.key === ' ' && event.target === element('lanes') && view.clip) {
    event.preventDefault()
    if (playing) stop()
    else element(mono ? 'play-both' : 'play-drive').click()
  }
})
addEventListener('resize', look)
matchMedia('(prefers-color-scheme: light)').addEventListener('change', look)
for (const event of ['gamepadconnected', 'gamepaddisconnected'])
  addEventListener(event, () => { element('feel-status').textContent = describeFeel() })
element('controller').hidden = !canAsk()
guarded(async () => {
  await remembered()
  element('feel-status').textContent = describeFeel()
})()

guarded(async () => {
  const { default: gallery } = await import('./gallery/list.js')
  for (const [kind, files] of byKind(gallery)) {
    const group = document.createElement('optgroup')
    group.label = kind
    group.append(...files.map((file) => new Option(file.replace(/\.pacb$/, '').replaceAll('_', ' '), file)))
    element('gallery').append(group)
  }
})()
guarded(async () => {
  formatList = (await side.call('formats')).filter((format) => format.writes)
  for (const format of formatList) element('format').add(new Option(`${format.title} (${format.extension})`, format.name))
  if (view.clip) await showLosses()
})()
guarded(async () => {
  for (const [id, value] of Object.entries(await side.call('defaults'))) {
    const input = element(id)
    if (moved.has(id)) continue
    input.value = value
    input.parentElement.querySelector('output').value = input.value
  }
})()
guarded(async () => {
  const shared = new URLSearchParams(location.hash.slice(1)).get('c')
  if (shared) {
    let bytes
    try {
      bytes = bytesOf(shared)
    } catch {
      throw new Error('The link is damaged: it holds no clip.')
    }
    // What was here before can be had again by Undo.
    const before = await kept().catch(() => undefined)
    if (before?.clip) history.push('Open', before)
    await open(bytes, 'shared.pacb')
    return
  }
  const before = await kept().catch(() => undefined)
  if (before?.clip) await take('Open', before)
})()
if ('serviceWorker' in navigator && !new URLSearchParams(location.search).has('fresh'))
  navigator.serviceWorker.register('service-worker.js').catch(() => {})
document.documentElement.dataset.ready = 'true'
