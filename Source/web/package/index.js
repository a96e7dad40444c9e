// Pacini for JavaScript: sounds to haptic clips, clips to what actuators play, and to every format.

import { compile, Instance, PaciniError } from './module.js'
import profileTable from './profiles.js'
import { monoOf, soundOf } from './sound.js'

export { loadFrom, PaciniError } from './module.js'
export { readWav } from './sound.js'
export { openSound, readSound } from './sound-file.js'

/** Instances by the names of their modules. */
const instances = new Map()

const ready = async (name, signal) => {
  signal?.throwIfAborted()
  const module = await compile(name)
  if (!instances.has(name)) instances.set(name, new Instance(module))
  signal?.throwIfAborted()
  return instances.get(name)
}

const floats = (bytes) => new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4)
const bytesOf = (clip) => {
  if (clip instanceof Uint8Array) return clip
  if (clip instanceof ArrayBuffer) return new Uint8Array(clip)
  if (typeof clip === 'string') return new TextEncoder().encode(clip)
  if (clip && typeof clip === 'object') return new TextEncoder().encode(JSON.stringify(clip))
  throw new PaciniError({ code: 'invalidArgument', where: 'clip', message: 'must be bytes, a text, or an object of a clip' })
}
const profileBytes = (profile) => {
  if (typeof profile === 'string' && !profile.trimStart().startsWith('{')) {
    if (!Object.hasOwn(profileTable, profile))
      throw new PaciniError({
        code: 'invalidArgument', where: 'profile', message: `'${profile}' is not one of ${Object.keys(profileTable).join(', ')}`
      })
    return bytesOf(profileTable[profile])
  }
  return bytesOf(profile)
}

/** Whether bytes are a clip of Pacini's own formats, packed or JSON; all others have a module of their own. */
const isOwn = (bytes) => {
  const start = new TextDecoder().decode(bytes.subarray(0, 1024))
  return start.startsWith('PACB') || (/^[\s\uFEFF]*[{/]/.test(start) && start.includes('pacini.clip'))
}
const ownBytes = async (clip, signal) => {
  const bytes = bytesOf(clip)
  if (isOwn(bytes)) return bytes
  return (await ready('formats', signal)).call('read', {}, [bytes]).outputs[0]
}
/** Names of the actuators that come with Pacini. */
export const profileNames = () => Object.keys(profileTable)

/** One of them, or what a profile (an object or a text) says of its actuator. */
export const profileInfo = async (profile, { signal } = {}) =>
  (await ready('render', signal)).call('profile', {}, [profileBytes(profile)]).value

/**
 * A sound as a clip: an object as it stands in a `.json` file, the text of that file (`format: 'text'`), or the bytes of
 * a `.pacb` file (`format: 'packed'`); a Float32Array by methods that make a drive signal.
 */
export const encode = async (sound, options = {}) => {
  const { signal, progress, ...settings } = options
  const { sampleRate, channels, frames, reader, markers, lowFrequency } = soundOf(sound)
  const own = (options.method ?? options.settings?.encode?.method ?? 'a2vt') === 'a2vt'
  const name = own ? 'encode' : 'research'
  const module = await ready(name, signal)
  const read = reader()
  let done = 0
  settings.format = options.format === 'packed' ? 'packed' : 'json'
  try {
    const { value, outputs } = module.call(own ? 'encode' : 'translate', { ...settings, sampleRate, channels, frames, markers, lowFrequency }, [], {
      channels,
      read: (into) => {
        signal?.throwIfAborted()
        const count = read(into)
        done += count / channels
        if (progress && frames > 0) progress(done / frames)
        return count
      }
    })
    if (value.signal) return floats(outputs[0])
    if (options.format === 'packed') return outputs[0]
    const text = new TextDecoder().decode(outputs[0])
    return options.format === 'text' ? text : JSON.parse(text)
  } catch (error) {
    // What a call was in the midst of when it was left is not undone.
    if (!(error instanceof PaciniError)) instances.delete(name)
    throw error
  }
}

/**
 * Edits that were made by hand over the clip `before`, applied to `after`, another analysis of its sound: times follow the
 * events, bands are found by their frequencies. Gives the edited clip, the edits in its time, and those that do not fit,
 * which wait among them. Edits are those of a project file.
 */
export const reapply = async (before, after, edits, { signal } = {}) => {
  const inputs = [await ownBytes(before, signal), await ownBytes(after, signal), bytesOf({ edits })]
  const { value, outputs } = (await ready('encode', signal)).call('reapply', {}, inputs)
  const [clip, rest] = outputs.map((bytes) => JSON.parse(new TextDecoder().decode(bytes)))
  return { clip, ...rest, ...value }
}
/** What can be set of encode(), as it is described everywhere: names, units, ranges, defaults, and the methods that have it. */
export const parameters = async ({ signal } = {}) => (await ready('encode', signal)).call('parameters').value.parameters

export { presets } from './presets.js'

/** What can be set of write() and lint(), beside the format, and the formats that each changes anything in. */
export const exportParameters = async ({ signal } = {}) => (await ready('formats', signal)).call('exportParameters').value.parameters

/** What encode() and render() do unless they are told otherwise: bands, breakpoints, sensitivity, strength. */
export const defaults = async ({ signal } = {}) => (await ready('render', signal)).call('defaults').value

/** A clip of any format as the object of a `.json` clip, with what was let pass. */
export const read = async (bytes, { extension = '', strict = false, signal } = {}) => {
  const given = bytesOf(bytes)
  const module = await ready(isOwn(given) ? 'render' : 'formats', signal)
  const { value, outputs } = module.call('read', { extension, strict }, [given])
  return { clip: JSON.parse(new TextDecoder().decode(outputs[0])), ...value }
}

const exported = async (name, clip, { signal, profile, ...options }) => {
  const inputs = [bytesOf(clip)]
  if (profile !== undefined) inputs.push(profileBytes(profile))
  const own = ['json', 'packed'].includes(options.format ?? 'json') && isOwn(inputs[0])
  return (await ready(own ? 'render' : 'formats', signal)).call(name, options, inputs)
}

/** The files that a clip becomes in a format, and what is lost on the way. */
export const write = async (clip, options = {}) => {
  const { value, outputs } = await exported('write', clip, options)
  return { files: outputs.map((bytes, i) => ({ suffix: value.suffixes[i], bytes })), losses: value.losses }
}

/** What a format would lose of a clip. */
export const lint = async (clip, options = {}) => (await exported('lint', clip, options)).value.losses

/** All formats, Pacini's own first. */
export const formats = async ({ signal } = {}) => (await ready('render', signal)).call('formats').value.formats

const rendered = async (what, { signal, profile, clips, ...options }, more) => {
  const inputs = [clips !== undefined ? bytesOf(what) : await ownBytes(what, signal)]
  if (profile !== undefined) inputs.push(profileBytes(profile))
  for (const clip of clips ?? []) inputs.push(await ownBytes(clip, signal))
  const { value, outputs } = (await ready('render', signal)).call('render',
    { ...options, ...more, scene: clips !== undefined, withProfile: profile !== undefined }, inputs)
  const channels = outputs.map(floats)
  return { samples: channels.length === 1 ? channels[0] : channels, sampleRate: options.sampleRate ?? 48000, ...value }
}

/**
 * The drive signal of a clip for the actuator of a profile, or for none. With `clips` it is a scene, whose text names
 * them "0", "1" and so on.
 */
export const render = (clip, options = {}) => rendered(clip, options, {})

/** The acceleration that is felt of it: m/s2 over `fullScale` (100). */
export const felt = (clip, options = {}) => rendered(clip, options, { felt: true })

/** How close a haptic signal is to its sound, by all measures. With `allowNan` what is no number counts as silence. */
export const compare = async (sound, candidate, { allowNan = false, signal } = {}) => {
  const module = await ready('research', signal)
  return module.call('compare',
    { sampleRate: soundOf(sound).sampleRate, candidateRate: soundOf(candidate).sampleRate, allowNan },
    [monoOf(sound), monoOf(candidate)]).value
}

/**
 * The picture of a stretch of a sound, `from` to `to` s, in the colours of the editor: `pixels` of four bytes, `width` and
 * `height` of them, the highest frequency first.
 */
export const spectrogram = async (sound, { from = 0, to, columns = 800, high, dark = true, signal } = {}) => {
  const { sampleRate, frames } = soundOf(sound)
  const { value, outputs } = (await ready('research', signal)).call('spectrogram',
    { sampleRate, from, to: to ?? frames / sampleRate, columns, dark, ...(high === undefined ? {} : { high }) }, [monoOf(sound)])
  return { ...value, pixels: outputs[0] }
}

/**
 * The HID reports that play a clip on a game controller: bytes with their times, s, and those that silence it at any
 * moment. The first byte of each is the report's number.
 */
export const reports = async (clip, { vendor, product, bluetooth = false, gain = 0, signal } = {}) => {
  const bytes = await ownBytes(clip, signal)
  const { value, outputs } = (await ready('devices', signal)).call('reports', { vendor, product, bluetooth, gain }, [bytes])
  const cut = (index, from) => index.map(({ time, at, length, feature }) => ({ time, feature, bytes: from.subarray(at, at + length) }))
  return { reports: cut(value.reports, outputs[0]), stops: cut(value.stops, outputs[1]) }
}

/**
 * What the two motors of a controller play of a clip: `motors`, the numbers of the strong and the weak one by turns, 0 to
 * 1, every `interval` s, as `playEffect('dual-rumble')` takes them. Of more than an hour, the first is felt.
 */
export const rumble = async (clip, { signal } = {}) => {
  const bytes = await ownBytes(clip, signal)
  const { value, outputs } = (await ready('devices', signal)).call('rumble', {}, [bytes])
  return { ...value, motors: floats(outputs[0]) }
}

/**
 * When a motor that is only on or off, such as a phone's, is on while a clip plays: `touches`, pairs of ms. Of its
 * `events`, `leftOut` come too soon after another for that. Of more than an hour, the first is felt.
 */
export const touch = async (clip, { signal } = {}) => {
  const bytes = await ownBytes(clip, signal)
  return (await ready('devices', signal)).call('touch', {}, [bytes]).value
}

/** What the modules take of memory, bytes. */
export const memoryInUse = () => [...instances.values()].reduce((sum, { memoryBytes }) => sum + memoryBytes, 0)
