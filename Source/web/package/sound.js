// Sounds as they come: arrays of samples, and WAV files.

import { PaciniError } from './module.js'

const wrong = (where, message) => new PaciniError({ code: 'invalidArgument', where, message })

/**
 * A sound that is read from its start: `{sampleRate, channels, frames, reader()}`.
 * `sound`: `{samples, sampleRate}` with a Float32Array for one channel or an array of them, or an AudioBuffer.
 */
export const soundOf = (sound) => {
  if (sound && typeof sound.getChannelData === 'function')
    return soundOf({
      samples: Array.from({ length: sound.numberOfChannels }, (_, c) => sound.getChannelData(c)),
      sampleRate: sound.sampleRate
    })
  if (!sound || !(sound.sampleRate > 0)) throw wrong('sampleRate', 'is missing')
  const channels = (Array.isArray(sound.samples) ? sound.samples : [sound.samples]).map((channel) => {
    if (channel instanceof Float64Array) return Float32Array.from(channel)
    if (!(channel instanceof Float32Array)) throw wrong('samples', 'must be a Float32Array, or an array of one for each channel')
    return channel
  })
  if (channels.length === 0) throw wrong('samples', 'has no channel')
  const frames = channels[0].length
  if (channels.some((channel) => channel.length !== frames)) throw wrong('samples', 'has channels of different lengths')
  return {
    sampleRate: sound.sampleRate,
    channels: channels.length,
    frames,
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

/** The sound in a WAV file (16, 24 or 32 bits, or floating point), sample for sample as other programs have it. */
export const readWav = (bytes) => {
  const bad = (message) => new PaciniError({ code: 'invalidData', where: '', message })
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)
  const tag = (at) => String.fromCharCode(...bytes.subarray(at, at + 4))
  if (bytes.length < 12 || tag(0) !== 'RIFF' || tag(8) !== 'WAVE') throw bad('is no WAV file')
  let format
  for (let at = 12; at + 8 <= bytes.length;) {
    const length = view.getUint32(at + 4, true)
    if (tag(at) === 'fmt ' && length >= 16 && at + 24 <= bytes.length) {
      format = {
        code: view.getUint16(at + 8, true),
        channels: view.getUint16(at + 10, true),
        rate: view.getUint32(at + 12, true),
        bits: view.getUint16(at + 22, true)
      }
      if (format.code === 0xfffe && length >= 26) format.code = view.getUint16(at + 32, true)
    }
    if (tag(at) === 'data') {
      if (!format || format.channels < 1) throw bad('has a damaged header')
      const width = format.bits / 8
      const at24 = (i) => (view.getUint8(i) | view.getUint8(i + 1) << 8 | view.getInt8(i + 2) << 16) / 8388608
      const at32 = (i) => Math.fround(view.getInt32(i, true) / 2147483648)
      const sample = {
        '1/16': (i) => view.getInt16(i, true) / 32768, '1/24': at24, '1/32': at32,
        '3/32': (i) => view.getFloat32(i, true), '3/64': (i) => view.getFloat64(i, true)
      }[`${format.code}/${format.bits}`]
      if (!sample) throw bad(`has a format that is not read here (${format.code}, ${format.bits} bits)`)
      const start = at + 8
      const frames = Math.floor(Math.min(length, bytes.length - start) / (width * format.channels))
      const samples = Array.from({ length: format.channels }, () => new Float32Array(frames))
      for (let n = 0; n < frames; ++n)
        for (let c = 0; c < format.channels; ++c)
          samples[c][n] = sample(start + (n * format.channels + c) * width)
      return { samples: format.channels === 1 ? samples[0] : samples, sampleRate: format.rate }
    }
    at += 8 + length + (length & 1)
  }
  throw bad('has no samples')
}
