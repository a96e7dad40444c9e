// Encoding, rendering and formats, beside the page's own thread. One request after another, each with its number. Sounds come as
// Blobs of WAV or AIFF files, of which parts are read: a long one needs no memory.

import { compare, defaults, encode, exportParameters, felt, formats, loadFrom, openSound, profileInfo, read, reapply, render, reports, rumble, spectrogram,
  touch, write } from './pacini/index.js'
import { isSoundFile } from './pacini/sound-file.js'
import { FirstLevel } from './peaks.js'

let module
/** What a visit needs is one module; those of the package hold the rest. */
const loaded = () => module ??= (async () => {
  const answer = await fetch('visit.wasm')
  if (!answer.ok) throw new Error(`The page's module cannot be loaded (${answer.status}). Load the page again.`)
  const visit = await WebAssembly.compile(await answer.arrayBuffer())
  loadFrom({ encode: visit, render: visit, research: visit, devices: visit })
})()

const bytesOf = (blob) => (at, length) => {
  try {
    return new Uint8Array(new FileReaderSync().readAsArrayBuffer(blob.slice(at, at + length)))
  } catch {
    throw new Error(`${blob.name ?? 'The sound'} cannot be read any more: it was moved or changed. Open it again.`)
  }
}
const known = new Map() // files that were opened: some are read whole to tell how their samples lie
/** What tells a file from others; nothing where that cannot be told. */
const keyOf = (blob) => blob instanceof File ? `${blob.name} ${blob.size} ${blob.lastModified}` : /^audio\/x-own-/.test(blob.type) && blob.type
const fileOf = (blob) => {
  const key = keyOf(blob)
  if (known.has(key)) return known.get(key)
  const file = openSound(bytesOf(blob), blob.size)
  if (key) known.set(key, file)
  if (known.size > 4) known.delete(known.keys().next().value)
  return file
}
/** The mean of all channels, from one frame to another. */
const monoOf = (file, from, count) => {
  const [mono, ...others] = file.read(from, count)
  for (const channel of others) for (let n = 0; n < mono.length; ++n) mono[n] += channel[n]
  if (others.length > 0) for (let n = 0; n < mono.length; ++n) mono[n] /= file.channels
  return mono
}
/** `{blob, from, count}` as the package takes sounds. */
const partOf = (sound) => {
  if (!sound.blob) return sound
  const file = fileOf(sound.blob)
  return { samples: monoOf(file, sound.from ?? 0, sound.count ?? file.frames), sampleRate: file.sampleRate }
}

/** A sound that notes its smallest and largest samples while it is read, so that a long one is read once. */
const notedPeaks = (file) => {
  const { channels, frames } = file, peaks = new FirstLevel(frames)
  return {
    peaks: peaks.values,
    sound: {
      sampleRate: file.sampleRate, channels, frames, markers: file.markers, lowFrequency: file.lowFrequency,
      reader: () => {
        const read = file.reader()
        let mono = new Float32Array(0)
        return (into) => {
          const count = read(into) / channels
          if (mono.length < count) mono = new Float32Array(count)
          for (let n = 0; n < count; ++n) {
            let sum = 0
            for (let c = 0; c < channels; ++c) sum += into[n * channels + c]
            mono[n] = sum / channels
          }
          peaks.add(mono.subarray(0, count))
          return count * channels
        }
      }
    }
  }
}

const calls = {
  defaults, exportParameters, felt, formats, profileInfo, read, reapply, render, reports, rumble, touch, write,
  encode: async (sound, options, progress) => {
    if (!sound.blob) return encode(sound, { ...options, progress })
    const file = fileOf(sound.blob)
    if (!sound.peaks) return encode(file, { ...options, progress })
    const noted = notedPeaks(file)
    return { clip: await encode(noted.sound, { ...options, progress }), peaks: noted.peaks }
  },
  compare: (sound, candidate) => compare(partOf(sound), candidate),
  spectrogram: (sound, options) => spectrogram(partOf(sound), options),
  open: (blob) => {
    const { sampleRate, channels, frames, promised, warnings } = fileOf(blob)
    return { sampleRate, channels, frames, promised, warnings }
  },
  isSound: (blob) => isSoundFile(bytesOf(blob), blob.size),
  mono: (blob, from, count) => {
    const mono = monoOf(fileOf(blob), from, count)
    return mono.byteLength < mono.buffer.byteLength ? mono.slice() : mono
  },
  peaks: (blob, progress) => {
    const file = fileOf(blob)
    const peaks = new FirstLevel(file.frames)
    for (let from = 0; from < file.frames; from += 65536) {
      peaks.add(monoOf(file, from, 65536))
      progress(from / file.frames)
    }
    return peaks.values
  }
}
const needsNoModule = new Set(['open', 'isSound', 'mono', 'peaks'])
const buffersOf = (result) => [result, ...Object.values(result ?? {})].filter((one) => ArrayBuffer.isView(one)).map(({ buffer }) => buffer)

self.onmessage = async ({ data: { number, name, parameters } }) => {
  let told = 0
  const progress = (share) => {
    if (performance.now() < told + 100) return
    told = performance.now()
    self.postMessage({ number, share })
  }
  try {
    if (!needsNoModule.has(name)) await loaded()
    const started = performance.now()
    const result = await calls[name](...parameters, ...(['encode', 'peaks'].includes(name) ? [progress] : []))
    self.postMessage({ number, result, took: performance.now() - started }, [...new Set(buffersOf(result))])
  } catch (error) {
    self.postMessage({ number, error: { message: error.message, where: error.where ?? '', code: error.code ?? '' } })
  }
}
