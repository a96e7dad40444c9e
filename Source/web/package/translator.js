// The live translator, as a node of Web Audio and block by block.

import { compile, Instance, PaciniError } from './module.js'
import profileTable from './profiles.js'

const wrong = (where, message) => new PaciniError({ code: 'invalidArgument', where, message })

const profileBytes = (profile) => {
  if (profile === undefined) return new Uint8Array()
  const known = typeof profile === 'string' && Object.hasOwn(profileTable, profile) ? profileTable[profile] : profile
  return new TextEncoder().encode(typeof known === 'string' ? known : JSON.stringify(known))
}

/** Settings come as an object, or as the text of a file. */
const settingsOf = (settings) => {
  if (typeof settings !== 'string') return settings
  try {
    return JSON.parse(settings.replace(/^\uFEFF/, ''))
  } catch (error) {
    throw new PaciniError({ code: 'invalidData', where: 'settings', message: `are no JSON: ${error.message}` })
  }
}

let reader // what reads options, once it is needed
/** `{setup, values}` by options: bands, boost and strength, and the values of all parameters. */
const liveOf = async ({ settings, ...options }) => {
  reader ??= new Instance(await compile('encode'))
  return reader.call('live', { ...options, settings: settingsOf(settings) }).value
}
/** The same; without options nothing needs to be read. */
const beginning = async (options) => Object.values(options).every((value) => value === undefined) ? {} : liveOf(options)

/** Descriptions of all parameters: name, unit, range, default and so on. */
export const translatorParameters = async () => {
  reader ??= new Instance(await compile('encode'))
  return reader.call('liveParameters').value.parameters
}

const usualSetup = [NaN, NaN, NaN]
const fixed = ['bands', 'maxBoost', 'strength', 'settings', 'profile', 'sampleRate']
/** Options with changes of parameters. */
const changed = (options, changes) => {
  for (const name of fixed)
    if (changes[name] !== undefined) throw wrong(name, 'is fixed while a translator runs; create another one')
  return { ...options, ...changes }
}

/**
 * The live translator, block by block: `Translator.create({ sampleRate, profile, settings, bands, maxBoost, strength })` with
 * parameters by their names, which override those of the settings. The drive comes `latency` frames after the sound.
 */
export class Translator {
  #exports
  #handle
  #options

  /** `sampleRate`: 48000 Hz; `profile`: a name, or the object or text of a profile; none: a plain drive. */
  static async create({ sampleRate = 48000, profile, ...options } = {}) {
    const { setup = usualSetup, values } = await beginning(options)
    return new Translator(await compile('translator'), sampleRate, profileBytes(profile), setup, values, options)
  }

  /** As create() does. */
  constructor(module, sampleRate, profile, setup, values, options) {
    const { exports } = new Instance(module)
    const address = exports.allocate(profile.length)
    new Uint8Array(exports.memory.buffer, address, profile.length).set(profile)
    this.#handle = exports.translatorCreate(sampleRate, address, profile.length, ...setup)
    exports.release(address)
    if (this.#handle === 0) throw wrong('profile', `this profile, or sound at ${sampleRate} Hz, cannot be played`)
    this.#exports = exports
    this.#options = options
    if (values) this.#put(values)
    this.reset()
  }

  #put(values) {
    new Float64Array(this.#exports.memory.buffer, this.#exports.translatorValues(this.#handle), values.length).set(values)
    this.#exports.translatorSet(this.#handle)
  }

  /** Delay of the drive against the sound, frames. */
  get latency() { return this.#exports.translatorLatency(this.#handle) }

  /** The drive of the next block of mono sound: as many frames. */
  process(block) {
    if (!(block instanceof Float32Array)) throw wrong('block', 'must be a Float32Array')
    const drive = new Float32Array(block.length), exports = this.#exports, handle = this.#handle
    for (let done = 0; done < block.length; done += 1024) {
      const part = block.subarray(done, done + 1024)
      new Float32Array(exports.memory.buffer, exports.translatorIn(handle), 1024).set(part)
      exports.translatorProcess(handle, part.length)
      drive.set(new Float32Array(exports.memory.buffer, exports.translatorOut(handle), part.length), done)
    }
    return drive
  }

  /** Changes parameters smoothly; right after reset() at once. */
  async set(parameters) {
    const options = changed(this.#options, parameters), { values } = await liveOf(options)
    this.#options = options
    this.#put(values)
  }

  /** As if nothing was heard yet. */
  reset() { this.#exports.translatorReset(this.#handle) }
}

/**
 * A node that turns the sound that is led to it into the drive signal of an actuator, one channel, `latency` frames late. Options
 * are those of Translator.create() but the rate, which is that of the context; `set(parameters)` changes parameters smoothly.
 */
export const createTranslator = async (context, { profile, ...options } = {}) => {
  const { setup = usualSetup, values } = await beginning(options)
  const module = await compile('translator')
  const bytes = profileBytes(profile)
  // Offline contexts begin nothing before they render, so this is asked here, not in the worklet.
  const { latency } = new Translator(module, context.sampleRate, bytes, setup, values, options)
  await context.audioWorklet.addModule(new URL('./translator-worklet.js', import.meta.url))
  const node = new AudioWorkletNode(context, 'pacini-translator', {
    numberOfInputs: 1, numberOfOutputs: 1, outputChannelCount: [1], processorOptions: { module, profile: bytes, setup, values }
  })
  let now = options
  const set = async (parameters) => {
    const wanted = changed(now, parameters), live = await liveOf(wanted)
    now = wanted
    node.port.postMessage(live.values)
  }
  return Object.assign(node, { latency, set })
}
