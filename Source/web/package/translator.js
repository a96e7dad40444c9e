// The live translator as a node of Web Audio.

import { compile, Instance, PaciniError } from './module.js'
import profileTable from './profiles.js'

const profileBytes = (profile) => {
  if (profile === undefined) return new Uint8Array()
  const known = typeof profile === 'string' && Object.hasOwn(profileTable, profile) ? profileTable[profile] : profile
  return new TextEncoder().encode(typeof known === 'string' ? known : JSON.stringify(known))
}

/** How late it is, frames. Offline contexts begin nothing before they render, so this is asked here, not in the worklet. */
const latencyOf = (module, rate, bytes) => {
  const { exports } = new Instance(module)
  const address = exports.allocate(bytes.length)
  new Uint8Array(exports.memory.buffer, address, bytes.length).set(bytes)
  const handle = exports.translatorCreate(rate, address, bytes.length)
  if (handle === 0)
    throw new PaciniError({ code: 'invalidArgument', where: 'profile', message: `this profile, or sound at ${rate} Hz, cannot be played` })
  return exports.translatorLatency(handle)
}

/**
 * A node that turns the sound that is led to it into the drive signal of an actuator, one channel, `latency` frames late.
 * `profile`: a name, or the object or text of a profile; none: a plain drive.
 */
export const createTranslator = async (context, { profile } = {}) => {
  const module = await compile('translator')
  await context.audioWorklet.addModule(new URL('./translator-worklet.js', import.meta.url))
  const bytes = profileBytes(profile)
  const latency = latencyOf(module, context.sampleRate, bytes)
  const node = new AudioWorkletNode(context, 'pacini-translator', {
    numberOfInputs: 1, numberOfOutputs: 1, outputChannelCount: [1], processorOptions: { module, profile: bytes }
  })
  return Object.assign(node, { latency })
}
