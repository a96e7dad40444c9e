// Sounds of the page: files of which parts are read, kept as Blobs, so that neither length nor Undo takes memory.

import { t } from './text.js'
import { Core } from './core.js'
import { newId } from './store.js'

const reader = new Core() // reads parts while others compute
const copied = 32e6 // bytes of a file up to which the page has its own copy: larger ones are read where they lie
const heldFrames = 6e6 // of a sound whose samples the page has at hand: 24 MB

/** Samples of `channels` (arrays) as a WAV file of floating point, in parts. */
export const wavOf = (channels, sampleRate) => {
  const head = new DataView(new ArrayBuffer(44)), frames = channels[0].length, size = frames * channels.length * 4
  const words = [[0, 'RIFF'], [8, 'WAVE'], [12, 'fmt '], [36, 'data']]
  for (const [at, word] of words) [...word].forEach((letter, i) => head.setUint8(at + i, letter.charCodeAt(0)))
  const numbers = [[4, 4, 36 + size], [16, 4, 16], [20, 2, 3], [22, 2, channels.length], [24, 4, sampleRate], [28, 4, sampleRate * channels.length * 4],
    [32, 2, 4 * channels.length], [34, 2, 32], [40, 4, size]]
  for (const [at, bytes, value] of numbers) bytes === 4 ? head.setUint32(at, value, true) : head.setUint16(at, value, true)
  const parts = [head.buffer]
  for (let from = 0; from < frames; from += 1e6) {
    const count = Math.min(1e6, frames - from), part = new Float32Array(count * channels.length)
    channels.forEach((channel, c) => {
      for (let n = 0; n < count; ++n) part[n * channels.length + c] = channel[from + n]
    })
    parts.push(new Blob([part])) // out of this thread's memory
  }
  return new Blob(parts)
}

/** A sound that was opened: `{id, blob, sampleRate, channels, frames, promised, warnings}`. */
const opened = async (blob) => ({ id: newId(), blob, ...await reader.call('open', blob) })

/**
 * The sound in a file. WAV and AIFF are read sample for sample as the program reads them; everything else by the browser, at the
 * rate of its own choice, and of that it needs all at once. `file` is its name.
 */
export const soundOf = async (blob, file) => {
  if (await reader.call('isSound', blob))
    return opened(blob.size > copied ? blob : new Blob([await blob.arrayBuffer()], { type: `audio/x-own-${newId()}` }))
  const context = new OfflineAudioContext(1, 1, 48000)
  let buffer
  try {
    buffer = await context.decodeAudioData(await blob.arrayBuffer())
  } catch {
    throw new Error(t('{0} cannot be opened. Try WAV, FLAC or MP3.', file))
  }
  if (buffer.length === 0) throw new Error(t('{0} has no samples.', file))
  return opened(wavOf(Array.from({ length: buffer.numberOfChannels }, (_, c) => buffer.getChannelData(c)), buffer.sampleRate))
}

/** A sound as it was kept once: samples. */
export const soundOfSamples = ({ samples, sampleRate }) => opened(wavOf(Array.isArray(samples) ? samples : [samples], sampleRate))

/** Samples of a sound, the mean of its channels. */
export const monoOf = ({ blob }, from, count) => reader.call('mono', blob, from, count)

/** Whether the page may have all samples of it at hand. */
export const isHeld = ({ frames }) => frames <= heldFrames

/** Samples of all of it then; nothing of a long one. */
export const heldMono = (sound) => isHeld(sound) ? monoOf(sound, 0, sound.frames) : undefined

/** Smallest and largest samples of a long sound: see Peaks. */
export const peaksOf = ({ blob }) => reader.call('peaks', blob).finally(() => reader.rest())
