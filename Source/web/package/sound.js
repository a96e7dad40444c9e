// Sounds as they come: arrays of samples, AudioBuffers, and what reads a sound in parts.

import { PaciniError } from './module.js'

export { readSound as readWav } from './sound-file.js'

const wrong = (where, message) => new PaciniError({ code: 'invalidArgument', where, message })

/**
 * A sound that is read from its start: `{sampleRate, channels, frames, reader()}`.
 * `sound`: `{samples, sampleRate}` with a Float32Array for one channel or an array of them, an AudioBuffer, or what openSound()
 * gives.
 */
export const soundOf = (sound) => {
  if (sound && typeof sound.getChannelData === 'function')
    return soundOf({
      samples: Array.from({ length: sound.numberOfChannels }, (_, c) => sound.getChannelData(c)),
      sampleRate: sound.sampleRate
    })
  if (!sound || typeof sound !== 'object') throw wrong('sound', 'must be an object with samples and sampleRate, or an AudioBuffer')
  if (sound instanceof ArrayBuffer || ArrayBuffer.isView(sound))
    throw wrong('sound', 'is bytes, and not a sound: readSound() reads those of WAV and AIFF files, decodeAudioData() of browsers those of others')
  if (!(sound.sampleRate > 0)) throw wrong('sampleRate', 'is missing: it must be a number of Hz above 0')
  if (typeof sound.reader === 'function') return sound
  const channels = (Array.isArray(sound.samples) ? sound.samples : [sound.samples]).map((channel) => {
    if (channel instanceof Float64Array) return Float32Array.from(channel)
    if (!(channel instanceof Float32Array)) throw wrong('samples', 'must be a Float32Array, or an array of one for each channel')
    return channel
  })
  if (channels.length === 0) throw wrong('samples', 'must have at least one channel')
  const frames = channels[0].length
  if (channels.some((channel) => channel.length !== frames)) throw wrong('samples', 'must be channels of one length')
  return {
    sampleRate: sound.sampleRate,
    channels: channels.length,
    frames,
    markers: sound.markers,
    lowFrequency: sound.lowFrequency,
    reader: () => {
      let done = 0
      return (into) => {
        const count = Math.min(into.length / channels.length, frames - done)
        if (channels.length === 1) into.set(channels[0].subarray(done, done + count))
        else
          channels.forEach((channel, c) => {
            for (let n = 0; n < count; ++n) into[n * channels.length + c] = channel[done + n]
          })
        done += count
        return count * channels.length
      }
    }
  }
}

/** All channels as one: their mean. */
export const monoOf = (sound) => {
  const { channels, frames, reader } = soundOf(sound)
  const read = reader()
  const mono = new Float32Array(frames)
  const block = new Float32Array(4096 * channels)
  for (let done = 0; done < frames;) {
    const count = read(block) / channels
    for (let n = 0; n < count; ++n) {
      let sum = 0
      for (let c = 0; c < channels; ++c) sum += block[n * channels + c]
      mono[done + n] = sum / channels
    }
    done += count
  }
  return mono
}
