// The live translator as a node of Web Audio.

import { compile, PaciniError } from './module.js'
import profileTable from './profiles.js'

/**
 * A node that turns the sound that is led to it into the drive signal of an actuator, one channel, `latency` frames late.
 * `profile`: a name, or the object or text of a profile; none: a plain drive.
 */
export const createTranslator = async (context, { profile } = {}) => {
  const module = await compile('translator')
  await context.audioWorklet.addModule(new URL('./translator-worklet.js', import.meta.url))
  let text = profile
  if (typeof profile === 'string' && Object.hasOwn(profileTable, profile)) text = profileTable[profile]
  if (text !== undefined && typeof text !== 'string') text = JSON.stringify(text)
  const node = new AudioWorkletNode(context, 'pacini-translator', {
    numberOfInputs: 1,
    numberOfOutputs: 1,
    outputChannelCount: [1],
    processorOptions: { module, profile: text === undefined ? undefined : new TextEncoder().encode(text) }
  })
  const told = await new Promise((resolve) => { node.port.onmessage = ({ data }) => resolve(data) })
  if (told.failed) throw new PaciniError({ code: 'invalidArgument', where: 'profile', message: told.failed })
  return Object.assign(node, { latency: told.latency })
}
