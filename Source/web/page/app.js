// The page: a sound or clip comes in, is shown, felt, changed and taken along.

import { presets } from './pacini/presets.js'
import profiles from './pacini/profiles.js'
import { Core } from './core.js'
import { startEditing } from './editing.js'
import { withEdit } from './edits.js'
import { connectController, describeFeel, feel, feelsNow, prepareFeel } from './feel.js'
import { guardNumber, guardSlider } from './fields.js'
import { follow } from './film.js'
import { firstPart } from './first-part.js'
import { canAsk, remembered } from './hid.js'
import { History } from './history.js'
import { startCards } from './cards.js'
import { byKind, titleOf } from './kinds.js'
import { plainWords } from './words.js'
import { counted, language, listed, number, startPage, t, told } from './text.js'
import { Lanes } from './lanes.js'
import { Live } from './live.js'
import { microphone } from './microphone.js'
import { Peaks } from './peaks.js'
import { channelCount, playPair, wholeSignal } from './sound-player.js'
import { heldMono, isHeld, monoOf, peaksOf, soundOf, soundOfSamples } from './sounds.js'
import { wallClock } from './vibration.js'
import { claim, keep, kept, keptWorks, newId } from './store.js'
import { zip } from './zip.js'

const element = (id) => document.getElementById(id)
startPage()
const core = new Core() // encodes; ended when it works for nothing
const side = new Core() // everything else
/**
 * Of `{id, name, source, sound, analysis, edits, clip}`: edits by hand are a layer over the analysis of the sound, `clip` is
 * both together. What is opened has an id of its own, under which it is kept.
 */
const history = new History()
const lanes = new Lanes(element('lanes'))
/** What is shown: of the document that history has now, and of what is computed of it. */
const view = { clip: undefined, lane: 'total', selected: 0, sound: undefined, drive: undefined, picture: undefined, soundRate: 1, driveRate: 48000 } // sound and drive: Peaks
let soundShown // of the document
let mono // of that, if it is short enough to be at hand
let drive // {samples, sampleRate} for the chosen actuator
let cursor = 0 // s: where playing begins
const longestRendered = 1200 // s: of longer clips the first part is rendered, shown and played
/** Rate of drive signals, which end below 2 kHz: that of long ones is the lowest that Web Audio plays everywhere. */
const isLong = ({ duration }) => duration > 120 // s: its workers give their memory back when they rest
const driveRateOf = ({ duration }) => duration > 60 ? 8000 : 48000

const say = (text) => { element('status').textContent = text }
const complain = (error) => {
  if (error?.superseded || error?.name === 'AbortError') return
  const box = element('error')
  box.textContent = error ? plainWords(error) : ''
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
/** Values of sliders with their units, by their data-shown. */
const shownAs = { percent: (value) => `${number(100 * value, 0)} %`, perSecond: (value) => `${value} / s`, times: (value) => `\u00d7 ${number(Number(value))}` }
const showValue = (slider) => {
  slider.parentElement.querySelector('output').value = (shownAs[slider.dataset.shown] ?? String)(slider.value)
}
const on = (id, event, work) => element(id).addEventListener(event, guarded(work))
const later = (work, milliseconds) => {
  let timer
  const cancel = () => clearTimeout(timer)
  return Object.assign(() => {
    cancel()
    timer = setTimeout(guarded(work), milliseconds)
  }, { cancel })
}
/** Work that is done again while it is asked for: once, however often that was meanwhile. `idle()` is when it is done. */
const newestOnly = (work) => {
  let running, isStale = false
  return Object.assign(() => {
    isStale = true
    running ??= (async () => {
      try {
        while (isStale) {
          isStale = false
          await work()
        }
      } finally {
        running = undefined
      }
    })()
    return running
  }, { idle: () => running })
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

const extensionOf = (file) => /\.[^.]+$/.exec(file)?.[0].toLowerCase() ?? ''
const clipExtensions = ['.pacb', '.json', '.ahap', '.haptic', '.haps', '.hjif', '.hmpg', '.vij', '.hasp', '.tact', '.csv']

let opened = 0 // how often something was: the last one counts, however long others take to be read
let opening // which of them is read or analysed
/** Opens what `reading` promises, a Blob of a sound or clip, or bytes. */
const open = async (file, reading) => {
  const own = opening = ++opened
  stopTurn()
  core.cancel()
  complain()
  const name = file.replace(/\.[^.]+$/, '') || 'clip'
  say(t('Reading {0}...', file))
  showProgress()
  try {
    const got = await reading, blob = got instanceof Blob ? got : new Blob([got])
    let document, said
    if (clipExtensions.includes(extensionOf(file))) {
      const { clip, warnings } = await side.call('read', new Uint8Array(await blob.arrayBuffer()), { extension: extensionOf(file) })
        .catch((error) => {
          if (error.superseded) throw error
          const [, what] = /^clip: (.*)$/s.exec(error.message) ?? []
          throw new Error(what ? t('{0} {1}.', file, told(what)) : t('{0} cannot be opened: {1}', file, told(error.message)))
        })
      document = { clip }
      said = warnings.map(told).join(' ')
    } else {
      const sound = await soundOf(blob, file)
      if (sound.frames === 0) throw new Error(t('{0} has no samples.', file))
      if (own !== opened) return
      document = { sound, ...await analysed({ name, source: file, sound }, history.now?.sound ? await knobs.values() : {}) }
      said = [document.said, ...doubts(file, sound)].join(' ')
    }
    if (own !== opened) return
    opening = undefined
    if (document.sound) showFilm() // a clip is put to the film that is shown
    await take(t('Open {0}', file), { id: newId(), name, source: file, sound: document.sound, analysis: document.clip, edits: [], clip: document.clip })
    if (own === opened && !turned) say(said)
    if (innerWidth <= 600) element('clip').scrollIntoView({ block: 'start' }) // which lies below what a phone shows
  } catch (error) {
    if (own === opened) throw error
  } finally {
    if (own === opened) hideProgress()
    if (opening === own) opening = undefined
    knobs.show()
  }
}
/** What the program says of a file, a sentence each. */
const doubts = (file, { frames, promised, warnings }) => [
  ...promised > frames ? [t('{0} is cut off: {1} of {2} frames.', file, frames, promised)] : [],
  ...warnings.filter((warning) => !/^is cut off/.test(warning)).map((warning) => t('{0} {1}.', file, told(warning)))]

let progressShown // timer
/** Shows, if it takes long, how much is done, and that it can be cancelled. */
const showProgress = () => {
  clearTimeout(progressShown)
  element('done').removeAttribute('value')
  progressShown = setTimeout(() => { element('progress').hidden = false }, 400)
}
const hideProgress = () => {
  clearTimeout(progressShown)
  if (document.activeElement === element('cancel')) element('file').focus()
  element('progress').hidden = true
}
core.progress = (share) => { element('done').value = share }
/** Leaves what is read or analysed: what was there stays. */
const cancel = () => {
  ++opened
  opening = undefined
  stopTurn()
  core.cancel()
  hideProgress()
  knobs.show()
  say(t('Cancelled.'))
}

/** The clip of a sound by values of the knobs, and how long it took in words. */
const analysed = async ({ name, source, sound }, values) => {
  core.cancel()
  const started = performance.now()
  say(t('Analysing...'))
  const { clip, peaks } = await core.call('encode', { blob: sound.blob, peaks: true }, { name, source, ...values })
  if (!isHeld(sound)) sound.peaks ??= peaks
  if (isLong(clip)) await core.rest()
  return { clip, said: t('Analysed in {0} s.', number((performance.now() - started) / 1000, 2)) }
}

let turned // values of the knobs that are not analysed yet
const stopTurn = () => {
  again.cancel()
  if (!turned) return
  core.cancel()
  turned = undefined
  say('')
}
/** Puts another analysis under the edits, by the knobs. */
const analyseAgain = async () => {
  const own = turned, burst = `turn ${turns}`, { sound } = history.now
  showProgress()
  try {
    const { clip: analysis, said } = await analysed(history.now, own)
    let now, taken
    do { // until nothing was edited meanwhile
      await editing.released()
      now = history.now
      if (turned !== own || now.sound !== sound) return
      const from = history.before(burst)
      taken = from.edits.length === 0 ? { clip: analysis, edits: [], unfitting: [] }
        : await core.call('reapply', from.analysis, analysis, from.edits)
    } while (now !== history.now)
    if (turned !== own) return
    turned = undefined
    await take(t('Analyse'), { ...now, analysis, clip: taken.clip, edits: taken.edits }, burst)
    if (turned) return
    const waiting = [...new Set(taken.unfitting.map(({ reason }) => told(reason)))]
    say(waiting.length === 0 ? said
      : `${said} ${counted(taken.unfitting.length, '{0} edit does not fit this analysis and is not applied: {1}.', '{0} edits do not fit this analysis and are not applied: {1}.', waiting.join('; '))}`)
  } finally {
    if (turned === own) turned = undefined
    if (!turned) {
      hideProgress()
      knobs.show()
    }
  }
}

// ---- shown

/** The knobs and the preset of the analysis: they stand where the document's analysis has them, unless they are turned. */
const knobs = {
  ids: ['bands', 'breakpoints', 'sensitivity'],
  usual: side.call('defaults'),
  others: {}, // what presets differ in and no knob shows
  async show() {
    const usual = await knobs.usual
    if (turned) return
    const encoder = history.now?.analysis.encoder ?? {}
    for (const id of knobs.ids) knobs.put(id, encoder[id] ?? usual[id])
    const heard = encoder.audible === undefined ? {} : { heard: 'instead' } // of clips that do not say it
    knobs.others = knobs.hidden({ ...presets[0].values, ...heard, ...encoder })
    knobs.showPreset()
  },
  put(id, value) {
    element(id).value = value
    showValue(element(id))
  },
  showPreset() {
    const own = knobs.all()
    const found = presets.find(({ values }) => Object.keys(values).every((name) => own[name] === values[name]))
    element('preset').value = found?.name ?? ''
  },
  choosePreset(name) {
    const { values } = presets.find((preset) => preset.name === name)
    for (const id of knobs.ids) knobs.put(id, values[id])
    knobs.others = knobs.hidden(values)
  },
  hidden: (values) => Object.fromEntries(
    Object.keys(presets[0].values).filter((name) => !knobs.ids.includes(name)).map((name) => [name, values[name]])),
  all: () => ({ ...knobs.others, ...Object.fromEntries(knobs.ids.map((id) => [id, Number(element(id).value)])) }),
  async values() {
    await knobs.usual
    return turned ?? knobs.all()
  }
}

/** A new document, as a step that can be undone. */
const take = async (what, document, burst) => {
  history.push(what, document, burst)
  await show()
}

/** The channels of the sound device, which is asked for when there is something to play. */
const listChannels = () => {
  if (element('channel').length > 0) return
  for (let channel = 1; channel < channelCount(); ++channel) element('channel').add(new Option(channel === 1 ? t('2, right') : String(channel + 1), String(channel)))
}

/** The document that history has now. */
const show = async () => {
  listChannels()
  const document = history.now
  const { sound } = document, sameSound = document.sound !== undefined && sound === soundShown
  soundShown = sound
  if (!sameSound) {
    mono = undefined
    view.sound = undefined
    view.soundRate = sound?.sampleRate ?? 1
    view.picture = undefined
    pictureOf = ''
    if (sound) await showSound(sound) // before anything else: each needs memory
    if (document !== history.now) return // what was opened meanwhile is shown
  }
  if (view.clip?.duration !== document.clip.duration || !sameSound) {
    lanes.showAll(document.clip.duration)
    cursor = 0
    view.selected = 0
  }
  view.clip = document.clip
  globalThis.document.documentElement.classList.remove('returning')
  for (const id of ['welcome', 'examples']) element(id).hidden = true
  for (const id of ['clip', 'export']) element(id).hidden = false
  element('link').parentElement.hidden = true // of what was before
  element('name').value = document.name
  element('lanes').setAttribute('aria-label',
    `${document.name}: ${listed([t('{0} s', number(view.clip.duration, 2)), counted(view.clip.bands.length, '{0} band', '{0} bands'),
      counted(view.clip.transients.length, '{0} event', '{0} events')])}`)
  for (const id of ['play-sound', 'play-both', 'preset', 'bands', 'breakpoints', 'sensitivity', 'spectrogram', 'with-sound']) element(id).disabled = !sound
  for (const [id, what] of [['undo', history.undoes], ['redo', history.redoes]]) {
    element(id).disabled = what === undefined
    element(id).title = what ?? ''
  }
  editing.refresh()
  look()
  await Promise.all([knobs.show(), remember(), renderDrive()])
}

/** Puts the waveform of a sound into the picture when it is read. */
const showSound = guarded(async (sound) => {
  const held = await heldMono(sound)
  const peaks = held ? new Peaks(held) : Peaks.ofLevel(sound.peaks ??= await peaksOf(sound), sound.frames)
  if (sound !== soundShown) return
  mono = held
  view.sound = peaks
  look()
})

/** Renders what is newest: a drag passes over what is between. */
const renderDrive = newestOnly(async () => {
  const { clip } = view
  if (!clip) return
  // A long clip goes to the worker once, as its packed bytes.
  const { files: [{ bytes }] } = await side.call('write', clip, { format: 'packed' })
  if (isLong(clip)) await side.rest()
  if (clip !== view.clip) return // a newer one comes
  const part = isLong(clip) ? { end: Math.min(clip.duration, longestRendered) } : {}
  const rendered = await side.call('render', isLong(clip) ? bytes : clip, { ...part, ...profileOption(), sampleRate: driveRateOf(clip), ...strength() })
  if (isLong(clip)) await side.rest()
  if (clip !== view.clip) return
  drive = { samples: rendered.samples, sampleRate: driveRateOf(clip) }
  view.drive = new Peaks(drive.samples)
  view.driveRate = drive.sampleRate
  look()
  const points = clip.bands.reduce((sum, band) => sum + band.amplitude.length, 0)
  element('figures').textContent = t('{0}.', listed([t('{0} s', number(clip.duration, 2)), t('{0} bytes packed', bytes.length),
    counted(points, '{0} breakpoint', '{0} breakpoints'), counted(clip.bands.length, '{0} band', '{0} bands'), counted(clip.transients.length, '{0} event', '{0} events')])) +
    (rendered.reduction > 0.05 ? ` ${t('The protection of the actuator reduces it by {0} dB.', number(rendered.reduction, 1))}` : '') +
    (clip.duration > longestRendered ? ` ${t('The first {0} minutes are rendered, shown and played; files contain all of the clip.', longestRendered / 60)}` : '')
  await showLosses()
  if (element('comparison').open) await compare()
  if (isLong(clip)) await side.rest()
})

const profileOption = () => element('profile').value ? { profile: element('profile').value } : {}
const strength = () => element('profile').value ? { strength: Number(element('strength').value) } : {}

let pictureWanted = false, pictureOf = ''
/** The spectrogram of what is shown, when it is asked for and not there. */
const drawPicture = guarded(async () => {
  if (!pictureWanted || !soundShown) return
  const { from, to } = lanes.range, dark = !matchMedia('(prefers-color-scheme: light)').matches
  const wanted = `${from} ${to} ${dark} ${soundShown.id}`
  if (wanted === pictureOf) return
  pictureOf = wanted
  const margin = 0.2, { sampleRate, blob } = soundShown
  const first = Math.max(0, Math.floor((from - margin) * sampleRate)), offset = first / sampleRate
  const part = { blob, from: first, count: Math.ceil((to + margin) * sampleRate) - first }
  const columns = Math.min(1600, Math.max(1, element('lanes').clientWidth))
  const { width, height, pixels } = await side.call('spectrogram', part, { from: from - offset, to: to - offset, columns, dark })
  if (wanted !== pictureOf || !pictureWanted) return
  const canvas = new OffscreenCanvas(width, height)
  canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), width, height), 0, 0)
  view.picture = { canvas, from, to }
  look()
})

let copied // a document that another tab has: it is kept when it was changed
const unkept = new Map() // documents by their ids
const keepAll = newestOnly(async () => {
  const documents = [...unkept.values()]
  unkept.clear()
  const felt = { profile: element('profile').value, strength: Number(element('strength').value) }
  try {
    for (const document of documents) await keep({ ...document, felt })
    element('storage').textContent = ''
    try { localStorage.setItem('pacini returns', 'yes') } catch { /* A browser without storage. */ }
    keepLater()
    await listWorks()
  } catch (error) {
    const full = error?.name === 'QuotaExceededError'
    element('storage').textContent = (full ? t('This browser has no room to keep the sound and the clip over a reload. Save the clip.')
      : t('This browser does not keep the clip over a reload ({0}). Save it.', error?.message ?? t('storage is refused')))
  }
})
const keepLater = later(() => keepTheRest(), 3000)
const remember = () => {
  const { now } = history
  if (!now || now === copied) return undefined
  try { sessionStorage.setItem('pacini work', now.id) } catch { /* A browser without storage. */ }
  claim(now.id)
  unkept.set(now.id, now)
  return keepAll()
}

/** What else was worked on, to go on with. */
let listedBeside // which document
const listWorks = async () => {
  if (listedBeside === history.now?.id) return
  listedBeside = history.now?.id
  const others = (await keptWorks()).filter(({ id }) => id !== history.now?.id)
  element('works').replaceChildren(new Option(t('choose...'), ''), ...others.map(({ id, name, changed, clip, soundId }) =>
    new Option(listed([name, t('{0} s', number(clip.duration, 2)), ...(soundId ? [] : [t('no sound')]), new Date(changed).toLocaleString(language)]), id)))
  element('open-work').disabled = true
  element('works').closest('.choice').hidden = others.length === 0
}

/** A kept work for this tab: another tab's as a copy. Nothing where it is not there. */
const resumed = async (id, wait) => {
  const work = await kept(id)
  if (!work) return undefined
  const { changed, felt, ...document } = { analysis: work.clip, edits: [], ...work } // once there were no layers
  if (document.sound?.samples) document.sound = await soundOfSamples(document.sound)
  if (felt) {
    element('profile').value = felt.profile
    element('strength').value = felt.strength
    showValue(element('strength'))
  }
  return await claim(id, wait) ? document : copied = { ...document, id: newId() }
}

// What the measures of a comparison say, best first.
const measures = [
  ['hts', t('Likeness of envelope, bands, spectrum and events (HTS)'), (x, { ceiling }) => t('{0} (sound itself {1})', number(x, 1), number(ceiling, 1))],
  ['match', t('Predicted match, as people would rate it (nothing felt: 35)'), (x, { matchOfSound }) => t('{0} (sound itself {1})', number(x, 1), number(matchOfSound, 1))],
  ['lsd', t('Distance of the spectra'), (x) => `${number(x, 2)} dB`],
  ['centroidError', t('Error of the centroid'), (x) => t('{0} semitones', number(x, 2))],
  ['outOfBand', t('Energy outside the range of touch'), (x) => `${number(x, 1)} dB`]
]
const compare = async () => {
  const status = element('comparison-status'), table = element('measures')
  if (!soundShown) {
    table.hidden = true
    status.textContent = t('A clip without its sound cannot be compared.')
    return
  }
  status.textContent = t('Comparing...')
  const { clip } = view, { sampleRate, blob } = soundShown
  const plain = await side.call('render', firstPart(clip, longestRendered), { sampleRate })
  const figures = await side.call('compare', { blob, ...(clip.duration > longestRendered ? { from: 0, count: plain.samples.length } : {}) }, { samples: plain.samples, sampleRate })
  if (clip !== view.clip) return
  table.tBodies[0].replaceChildren(...measures.map(([key, what, text]) => {
    const row = document.createElement('tr'), head = document.createElement('th')
    head.scope = 'row'
    head.textContent = what
    row.append(head)
    row.insertCell().textContent = figures[key] === null || figures[key] === undefined ? t('does not apply') : text(figures[key], figures)
    return row
  }))
  table.hidden = false
  status.textContent = ''
}

// ---- out

let formatList = []
const formatNamed = (wanted) => formatList.find((format) => format.name === wanted)
let exportable
/** Options for a format, without those that change nothing in it. */
const exportOptions = async (format, name = history.now.name) => {
  // Pacini's own formats take none: a visit does not load what those of other programs need.
  if (['json', 'packed'].includes(format.name)) return { format: format.name, name }
  exportable ??= await side.call('exportParameters')
  const has = (option) => exportable.some((one) => one.name === option && one.formats.includes(format.name))
  const chosen = Object.entries({ ...strength(), ...profileOption() }).filter(([option]) => has(option))
  return { format: format.name, name, ...Object.fromEntries(chosen) }
}
const lostText = (losses) => t('Lost here: {0}.', losses.slice(0, 3).map(({ message }) => told(message)).concat(losses.length > 3 ? [t('and {0} more', losses.length - 3)] : []).join('; '))
const showLosses = async () => {
  const format = formatNamed(element('format').value)
  if (!format || !view.clip) return
  const isOwn = ['json', 'packed'].includes(format.name) // which keeps everything
  const { losses } = isOwn && isLong(view.clip) ? { losses: [] }
    : await side.call('write', firstPart(view.clip, longestRendered), await exportOptions(format))
  element('losses').textContent = losses.length === 0 ? told(format.keeps) : `${told(format.keeps)} ${lostText(losses)}`
}

const download = (parts, file) => {
  const link = document.createElement('a')
  link.href = URL.createObjectURL(new Blob(parts))
  link.download = file
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 10000)
}
const save = async () => {
  const format = formatNamed(element('format').value), { name } = history.now
  const { files } = await side.call('write', view.clip, await exportOptions(format))
  for (const { suffix, bytes } of files) download([bytes], `${name}${suffix}${format.extension}`)
}
const saveAll = async () => {
  const { name, clip } = history.now, all = [], refused = []
  for (const format of formatList) {
    try {
      const { files } = await side.call('write', clip, await exportOptions(format, name))
      for (const { suffix, bytes } of files) all.push({ name: `${name}/${format.name}/${name}${suffix}${format.extension}`, bytes })
    } catch (error) {
      refused.push(`${told(format.title)} (${plainWords(error)})`)
    }
  }
  download(zip(all), `${name}.zip`)
  element('losses').textContent = t('{0} files in {1}.', all.length, `${name}.zip`) + (refused.length > 0 ? ` ${t('Not in it: {0}.', refused.join('; '))}` : '')
}

const base64 = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')
const bytesOf = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0))
const share = async () => {
  const { files: [{ bytes }] } = await side.call('write', view.clip, { format: 'packed' })
  if (bytes.length > 20000) throw new Error(t('The clip is too long for a link; save it as a file.'))
  // In the clipboard alone: in one's own address it would be opened again by every reload.
  const url = new URL(location.href)
  url.hash = `c=${base64(bytes)}`
  element('link').value = url.href
  element('link').parentElement.hidden = false
  const isCopied = await navigator.clipboard?.writeText(url.href).then(() => true, () => false)
  element('losses').textContent = isCopied ? t('A link of {0} characters is in the clipboard; it contains the whole clip.', url.href.length)
    : t('Copy this link of {0} characters; it contains the whole clip.', url.href.length)
}

// ---- play

let playing // {time, control}
const stop = () => {
  playing?.control.abort()
  playing = undefined
  look()
}
const isLooped = () => element('loop').getAttribute('aria-pressed') === 'true'
/** Plays from the playhead until `work` ends; again and again while Loop is on. */
const playThat = async (work) => {
  stop()
  const own = playing = { time: cursor, control: new AbortController() }
  const { signal } = own.control
  try {
    do {
      const played = await work({
        from: cursor, signal,
        moved: (time) => {
          own.time = time
          look()
        }
      })
      if (played === false) return
    } while (isLooped() && !signal.aborted)
  } finally {
    if (playing === own) stop()
  }
}
const soundPart = () => {
  const sound = soundShown, held = mono
  return { sampleRate: sound.sampleRate, frames: sound.frames, read: (from, count) => held ? held.subarray(from, from + count) : monoOf(sound, from, count) }
}
const drivePart = async () => {
  await renderDrive.idle()
  return wholeSignal(drive.samples, drive.sampleRate)
}
const feelIt = () => playThat(async (how) => {
  if (!feelsNow()) {
    element('feel-status').textContent = describeFeel()
    return false
  }
  const clip = firstPart(view.clip, longestRendered)
  const play = await prepareFeel(clip, (...parameters) => side.call(...parameters))
  if (how.signal.aborted) return
  if (soundShown && element('with-sound').checked) {
    // By the clock of the sound, as it is heard.
    const part = soundPart()
    let feeling
    await playPair(part, part, { ...how, started: (clock) => { feeling = play(how.signal, clock) } })
    await feeling
  } else {
    const clock = wallClock(how.from)
    const tick = () => {
      if (how.signal.aborted) return
      how.moved(Math.min(clock.now(), clip.duration))
      requestAnimationFrame(tick)
    }
    tick()
    await play(how.signal, clock)
  }
  element('feel-status').textContent = describeFeel()
})

// ---- film

/** Shows a film, by whose clock the clip is felt whenever it plays; without one hides what was shown. */
const showFilm = (file) => {
  const film = element('film')
  if (film.src) URL.revokeObjectURL(film.src)
  film.hidden = !file
  if (file) film.src = URL.createObjectURL(file)
  else film.removeAttribute('src')
}
follow(element('film'), (clock, signal) => {
  if (!view.clip || !feelsNow()) return
  stop()
  feel(view.clip, signal, (...parameters) => side.call(...parameters), clock).catch(complain)
})
/** A file, or a copy of one that is not large: the disk may be slow, or take it away. */
const bytesOfFile = (file) => file.size > 32e6 ? file : file.arrayBuffer()
/** What a person chose or dropped. */
const openFile = async (file) => {
  await open(file.name, bytesOfFile(file))
  if (file.type.startsWith('video/')) showFilm(file)
}

const live = new Live(() => {
  element('live').setAttribute('aria-pressed', String(live.isOn))
  element('feel-status').textContent = !live.isOn ? describeFeel() : live.latency === 0 ? t('Waiting for the microphone...')
    : t('The microphone is translated and played on the audio device, {0} ms late.', number(1000 * live.latency, 0))
})
const switchLive = () => live.isOn ? live.stop() : live.start(profileOption().profile)

// ---- record

/** Shows level and time of a recording until `signal` ends it. */
const watchLevel = (stream, signal) => {
  const context = new AudioContext(), meter = element('record-level')
  const analyser = new AnalyserNode(context, { fftSize: 2048 })
  const samples = new Float32Array(analyser.fftSize), started = performance.now()
  context.createMediaStreamSource(stream).connect(analyser)
  meter.hidden = false
  element('status').ariaLive = 'off' // its seconds are not read aloud
  const tick = () => {
    if (signal.aborted) {
      meter.hidden = true
      element('status').ariaLive = 'polite'
      context.close()
      return
    }
    analyser.getFloatTimeDomainData(samples)
    meter.value = 20 * Math.log10(Math.max(1e-3, samples.reduce((most, x) => Math.max(most, Math.abs(x)), 0)))
    say(t('Recording: {0} s', number((performance.now() - started) / 1000, 1)))
    requestAnimationFrame(tick)
  }
  tick()
}

let recording // AbortController
const record = async () => {
  if (recording) return recording.abort()
  const { signal } = recording = new AbortController()
  const showWhether = (on) => {
    element('record').setAttribute('aria-pressed', String(on))
    element('record').textContent = on ? t('Stop recording') : t('Record')
  }
  showWhether(true)
  const recorded = []
  try {
    const stream = await microphone(true, signal)
    watchLevel(stream, signal)
    const recorder = new MediaRecorder(stream)
    recorder.ondataavailable = ({ data }) => recorded.push(data)
    recorder.start()
    await new Promise((resolve) => { recorder.onstop = resolve }) // with its microphone
  } finally {
    recording.abort()
    recording = undefined
    showWhether(false)
  }
  await open('recording.webm', new Blob(recorded).arrayBuffer())
}
/** Ends all that sounds, is felt, or listens. */
const stopAll = () => {
  stop()
  live.stop()
  recording?.abort()
}

// ---- the page

const editing = startEditing({
  canvas: element('lanes'), lanes, state: view, element, look, say: (text) => { element('selected').textContent = text },
  change: guarded((what, { clip, edit }, burst) =>
    take(what, { ...history.now, clip, edits: withEdit(history.now.edits, edit) }, burst)),
  withdraw: guarded(async (burst) => {
    history.withdraw(burst)
    await show()
  }),
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
  stopTurn()
  history[way]()
  if (history.now !== before) await show()
  else await knobs.show()
}

for (const input of document.querySelectorAll('input[type=range]')) {
  guardSlider(input)
  input.addEventListener('input', () => showValue(input))
  showValue(input)
}
for (const input of document.querySelectorAll('input[type=number]')) guardNumber(input)
for (const [key, profile] of Object.entries(profiles)) element('profile').add(new Option(told(profile.shortName ?? profile.name ?? key), key))
element('profile').add(new Option(t('No actuator'), ''))
element('profile').value = 'l5-wristband'
for (const { name, purpose } of presets) {
  const option = new Option(told(`${name[0].toUpperCase()}${name.slice(1).replaceAll('-', ' ')}`), name)
  option.title = told(purpose)
  element('preset').add(option)
}
let turns = 0 // of knobs: what one turn changes is one step
const again = later(analyseAgain, 150)
for (const id of knobs.ids) {
  element(id).addEventListener('input', () => {
    if (opening === opened) return // what comes has its own
    turned = knobs.all()
    knobs.showPreset()
    again()
  })
  element(id).addEventListener('pointerdown', () => ++turns)
  element(id).addEventListener('focus', () => ++turns)
}
element('preset').addEventListener('change', () => {
  if (opening === opened || element('preset').value === '') return knobs.showPreset()
  ++turns
  knobs.choosePreset(element('preset').value)
  turned = knobs.all()
  again()
})
const feelOtherwise = () => Promise.all([remember(), renderDrive()])
element('strength').addEventListener('input', later(feelOtherwise, 100))
on('profile', 'change', feelOtherwise)
on('format', 'change', showLosses)
on('save', 'click', save)
on('save-all', 'click', saveAll)
on('share', 'click', share)
on('stop', 'click', stopAll)
on('cancel', 'click', cancel)
on('feel', 'click', feelIt)
on('record', 'click', record)
on('live', 'click', switchLive)
on('undo', 'click', () => travel('undo'))
on('redo', 'click', () => travel('redo'))
on('play-sound', 'click', () => playThat((how) => {
  const part = soundPart()
  return playPair(part, part, how)
}))
on('play-drive', 'click', () => playThat(async (how) => {
  const part = await drivePart()
  await playPair(part, part, how)
}))
on('play-both', 'click', () => playThat(async (how) =>
  playPair(soundPart(), await drivePart(), { ...how, channel: Number(element('channel').value) })))
on('loop', 'click', () => element('loop').setAttribute('aria-pressed', String(!isLooped())))
on('name', 'change', async ({ target }) => {
  const name = target.value.trim() || history.now.name, { now } = history
  target.value = name
  if (name !== now.name) await take(t('Rename'), { ...now, name, analysis: { ...now.analysis, name }, clip: { ...now.clip, name } })
})
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
  const files = [...target.files]
  target.value = ''
  await openAll(files)
})
/** Opens one file after the other: the last one stays, and the others wait below "continue with". */
const openAll = async (files) => {
  for (const [i, file] of files.entries()) {
    const own = opened + 1
    await openFile(file).catch(complain)
    if (own !== opened) return // something else was opened meanwhile
    if (files.length > 1) say(t('{0} of {1} opened. The others are below "Continue with".', i + 1, files.length))
  }
}
const exampleBytes = async (file) => {
  const answer = await fetch(`gallery/${file}`).catch(() => undefined)
  if (!answer?.ok) throw new Error(t('{0} cannot be loaded. Is the network there?', titleOf(file)))
  return answer.arrayBuffer()
}
const openExample = (file) => open(file, exampleBytes(file))
startCards({
  cards: document.querySelectorAll('.card'), say: (text) => { element('examples-status').textContent = text },
  open: guarded(async (file) => {
    await openExample(file)
    element('feel').focus({ preventScroll: true }) // the card is not there any more
  }), bytesOf: exampleBytes, complain, stop, playThat,
  call: (...parameters) => side.call(...parameters), drive: () => ({ ...profileOption(), ...strength() })
})
// What is chosen is opened by its button: with the arrows of the keyboard, one goes through a list and opens nothing.
for (const [list, button] of [['gallery', 'open-example'], ['works', 'open-work']])
  element(list).addEventListener('change', ({ target }) => { element(button).disabled = !target.value })
on('more', 'click', () => {
  document.querySelector('.choice.examples').classList.add('shown')
  element('gallery').focus()
})
on('open-example', 'click', () => openExample(element('gallery').value))
on('open-work', 'click', async () => {
  const { value: id, selectedOptions: [{ text }] } = element('works')
  const own = ++opened
  stopTurn()
  const work = await resumed(id)
  if (own === opened && work) await take(t('Open {0}', text), work)
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
  await openAll([...dropped.dataTransfer.files])
}))
document.addEventListener('keydown', (event) => {
  if (event.key === 'Escape') stopAll()
  const typing = event.target instanceof HTMLInputElement && ['number', 'text'].includes(event.target.type)
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
    else element(soundShown ? 'play-both' : 'play-drive').click()
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
    group.label = t(kind)
    group.append(...files.map((file) => new Option(titleOf(file), file)))
    element('gallery').append(group)
  }
})()
guarded(async () => {
  formatList = (await side.call('formats')).filter((format) => format.writes)
  for (const format of formatList) element('format').add(new Option(`${told(format.title)} (${format.extension})`, format.name))
  if (view.clip) await showLosses()
})()
guarded(async () => {
  const { strength: usual } = await knobs.usual
  if (!history.now && element('strength').value === element('strength').defaultValue) knobs.put('strength', usual)
  await knobs.show()
})()

/** The clip that the address holds, which goes out of it: from then on it is kept as other work is. */
const openLink = async () => {
  const shared = new URLSearchParams(location.hash.slice(1)).get('c')
  if (!shared) return
  let bytes
  try {
    bytes = bytesOf(shared)
  } catch {
    throw new Error(t('The link is damaged: it contains no clip.'))
  }
  await open('shared.pacb', bytes)
  window.history.replaceState(null, '', location.pathname + location.search)
}
addEventListener('hashchange', guarded(openLink))
guarded(async () => {
  const own = opened
  try {
    // What this tab had, or what was worked on last.
    const id = sessionStorage.getItem('pacini work')
    const before = (id && await resumed(id, 1000)) || await keptWorks().then(([last]) => last && resumed(last.id))
    if (before && own === opened) guarded(take)(t('Open'), before) // Undo has it when a link is opened
    else listWorks()
    if (!before) document.documentElement.classList.remove('returning')
  } catch { // A browser without storage.
    document.documentElement.classList.remove('returning')
  }
  if (own === opened) await openLink()
})()
/** Has the worker keep what works without a network, once somebody works here; not where data costs. */
const keepTheRest = () => {
  if (navigator.connection?.saveData) return
  navigator.serviceWorker?.ready.then(({ active }) => active.postMessage('keep the rest'))
}
if ('serviceWorker' in navigator && !new URLSearchParams(location.search).has('fresh'))
  navigator.serviceWorker.register(`service-worker.js${language === 'en' ? '' : `?language=${language}`}`).catch(() => {})
document.documentElement.dataset.ready = 'true'
performance.mark('ready')
