// WAV and AIFF files, read in parts: a long sound needs the memory of the part that is read.

import { PaciniError } from './module.js'

const bad = (message) => new PaciniError({ code: 'invalidData', where: 'sound file', message })

// ---- samples of G.711 and ADPCM, as libsndfile has them

const muLaw = Float32Array.from({ length: 256 }, (_, code) => {
  const bits = ~code & 255, size = ((bits & 15) * 8 + 132) << ((bits & 112) >> 4)
  return (bits & 128 ? 132 - size : size - 132) / 32768
})
const aLaw = Float32Array.from({ length: 256 }, (_, code) => {
  const bits = code ^ 85, segment = (bits & 112) >> 4
  const size = segment === 0 ? (bits & 15) * 16 + 8 : ((bits & 15) * 16 + 264) << (segment - 1)
  return (bits & 128 ? size : -size) / 32768
})

/** Step sizes and their changes of IMA ADPCM. Source: IMA Digital Audio Focus Group, Recommended Practices, 1992. */
const imaSteps = [7, 8, 9, 10, 11, 12, 13, 14, 16, 17, 19, 21, 23, 25, 28, 31, 34, 37, 41, 45, 50, 55, 60, 66, 73, 80, 88, 97, 107, 118, 130,
  143, 157, 173, 190, 209, 230, 253, 279, 307, 337, 371, 408, 449, 494, 544, 598, 658, 724, 796, 876, 963, 1060, 1166, 1282, 1411, 1552, 1707,
  1878, 2066, 2272, 2499, 2749, 3024, 3327, 3660, 4026, 4428, 4871, 5358, 5894, 6484, 7132, 7845, 8630, 9493, 10442, 11487, 12635, 13899, 15289,
  16818, 18500, 20350, 22385, 24623, 27086, 29794, 32767]
const imaChanges = [-1, -1, -1, -1, 2, 4, 6, 8]
const clamped = (value) => Math.min(32767, Math.max(-32768, value))

/** A block of IMA ADPCM: a header for each channel, then four bytes of each by turns. */
const imaBlock = (view, channels, frames, into, at) => {
  for (let c = 0; c < channels; ++c) {
    let value = view.getInt16(4 * c, true), index = Math.min(88, view.getUint8(4 * c + 2))
    into[c][at] = value / 32768
    for (let n = 1; n < frames; ++n) {
      const position = 4 * channels + Math.floor((n - 1) / 8) * 4 * channels + 4 * c + (((n - 1) % 8) >> 1)
      if (position >= view.byteLength) return
      const byte = view.getUint8(position), code = (n - 1) % 2 === 0 ? byte & 15 : byte >> 4, step = imaSteps[index]
      const size = (step >> 3) + (code & 1 ? step >> 2 : 0) + (code & 2 ? step >> 1 : 0) + (code & 4 ? step : 0)
      value = clamped(code & 8 ? value - size : value + size)
      index = Math.min(88, Math.max(0, index + imaChanges[code & 7]))
      into[c][at + n] = value / 32768
    }
  }
}

const microsoftSteps = [230, 230, 230, 230, 307, 409, 512, 614, 768, 614, 512, 409, 307, 230, 230, 230]

/** A block of Microsoft's ADPCM: two samples as they are, then four bits of each channel by turns. */
const microsoftBlock = (coefficients) => (view, channels, frames, into, at) => {
  const all = (offset) => Array.from({ length: channels }, (_, c) => view.getInt16(offset + 2 * c, true))
  const chosen = Array.from({ length: channels }, (_, c) => coefficients[view.getUint8(c)] ?? coefficients[0])
  const steps = all(channels), newest = all(3 * channels), older = all(5 * channels)
  for (let c = 0; c < channels; ++c) {
    into[c][at] = older[c] / 32768
    if (frames > 1) into[c][at + 1] = newest[c] / 32768
  }
  for (let i = 0; i < (frames - 2) * channels; ++i) {
    const position = 7 * channels + (i >> 1)
    if (position >= view.byteLength) return
    const byte = view.getUint8(position), code = i % 2 === 0 ? byte >> 4 : byte & 15, c = i % channels
    const guess = (newest[c] * chosen[c][0] + older[c] * chosen[c][1]) >> 8
    const value = clamped(guess + (code & 8 ? code - 16 : code) * steps[c])
    steps[c] = Math.max(16, microsoftSteps[code] * steps[c] >> 8)
    older[c] = newest[c]
    newest[c] = value
    into[c][at + 2 + Math.floor(i / channels)] = value / 32768
  }
}

/** Readers of one sample, by what it is and its bits; `little` is the order of bytes. */
const samplesAre = {
  'unsigned/8': (view, at) => (view.getUint8(at) - 128) / 128,
  'integer/8': (view, at) => view.getInt8(at) / 128,
  'integer/16': (view, at, little) => view.getInt16(at, little) / 32768,
  'integer/24': (view, at, little) => (little ? view.getUint8(at) | view.getUint8(at + 1) << 8 | view.getInt8(at + 2) << 16
    : view.getInt8(at) << 16 | view.getUint8(at + 1) << 8 | view.getUint8(at + 2)) / 8388608,
  'integer/32': (view, at, little) => Math.fround(view.getInt32(at, little) / 2147483648),
  'float/32': (view, at, little) => view.getFloat32(at, little),
  'float/64': (view, at, little) => view.getFloat64(at, little),
  'mulaw/8': (view, at) => muLaw[view.getUint8(at)],
  'alaw/8': (view, at) => aLaw[view.getUint8(at)]
}

// ---- headers

const tagAt = (view, at) => String.fromCharCode(view.getUint8(at), view.getUint8(at + 1), view.getUint8(at + 2), view.getUint8(at + 3))

/** Calls `work(tag, at, length, view)` for each chunk of a file, `view` having its first bytes, until that returns something. */
const chunksOf = (viewAt, size, little, work) => {
  for (let at = 12; at + 8 <= size;) {
    const head = viewAt(at, 8), tag = tagAt(head, 0), length = head.getUint32(4, little)
    const found = work(tag, at + 8, length, viewAt(at + 8, Math.min(length, 1024, size - at - 8)))
    if (found) return found
    at += 8 + length + (length & 1)
  }
  throw bad('has no samples')
}

const wavKinds = { 1: 'integer', 3: 'float', 6: 'alaw', 7: 'mulaw' }

const wavLayout = (viewAt, size) => {
  let format, large
  return chunksOf(viewAt, size, true, (tag, at, length, view) => {
    if (tag === 'ds64' && view.byteLength >= 16) large = Number(view.getBigUint64(8, true))
    if (tag === 'fmt ' && view.byteLength >= 16) {
      format = { code: view.getUint16(0, true), channels: view.getUint16(2, true), sampleRate: view.getUint32(4, true),
        blockBytes: view.getUint16(12, true), bits: view.getUint16(14, true), view }
      if (format.code === 0xfffe && view.byteLength >= 26) format.code = view.getUint16(24, true)
    }
    if (tag !== 'data') return undefined
    if (!format || format.channels < 1 || format.sampleRate < 1) throw bad('has a damaged header')
    const { code, bits, channels, sampleRate, blockBytes, view: rest } = format
    const bytes = length === 0xffffffff && large !== undefined ? large : length
    const common = { little: true, start: at, bytes, channels, sampleRate }
    if (code === 2 || code === 17) {
      const least = (code === 2 ? 7 : 4) * channels
      const blockFrames = rest.byteLength >= 20 ? rest.getUint16(18, true) : 0
      const fitting = (blockBytes - least) * 2 / channels + (code === 2 ? 2 : 1)
      if (blockBytes < least || blockFrames < 1 || blockFrames > fitting) throw bad('has a damaged header')
      const count = code === 2 && rest.byteLength >= 22 ? rest.getUint16(20, true) : 0
      if (code === 2 && (count < 1 || rest.byteLength < 22 + 4 * count)) throw bad('has a damaged header')
      const pairs = Array.from({ length: count }, (_, i) => [rest.getInt16(22 + 4 * i, true), rest.getInt16(24 + 4 * i, true)])
      return { ...common, blockBytes, blockFrames, block: code === 2 ? microsoftBlock(pairs) : imaBlock }
    }
    const kind = code === 1 && bits === 8 ? 'unsigned' : wavKinds[code]
    const sample = samplesAre[`${kind}/${bits}`]
    if (!sample) throw bad(`has a format that is not read here (${code}, ${bits} bits)`)
    // Which bytes of longer words the samples are cannot be told from the header.
    if (blockBytes !== channels * bits / 8)
      throw bad(`has frames of ${blockBytes} bytes for ${channels} x ${bits} bits, which is not read here; 'pacini encode' reads it`)
    return { ...common, sample, width: bits / 8 }
  })
}

/** An IEEE 754 number of 80 bits, as AIFF has rates. */
const extended = (view, at) => {
  const exponent = (view.getUint16(at) & 0x7fff) - 16383
  return view.getUint32(at + 2) * 2 ** (exponent - 31) + view.getUint32(at + 6) * 2 ** (exponent - 63)
}
const aiffKinds = { 'NONE': 'integer', 'twos': 'integer', 'sowt': 'integer', 'in24': 'integer', 'in32': 'integer', 'raw ': 'unsigned', 'fl32': 'float', 'FL32': 'float',
  'fl64': 'float', 'FL64': 'float', 'ulaw': 'mulaw', 'ULAW': 'mulaw', 'alaw': 'alaw', 'ALAW': 'alaw' }
const aiffBits = { in24: 24, in32: 32, fl32: 32, FL32: 32, fl64: 64, FL64: 64, ulaw: 8, ULAW: 8, alaw: 8, ALAW: 8 }

const aiffLayout = (viewAt, size, isCompressed) => {
  let format
  return chunksOf(viewAt, size, false, (tag, at, length, view) => {
    if (tag === 'COMM' && view.byteLength >= 18) {
      const kind = isCompressed && view.byteLength >= 22 ? tagAt(view, 18) : 'NONE'
      format = { channels: view.getUint16(0), frames: view.getUint32(2), bits: aiffBits[kind] ?? view.getUint16(6), sampleRate: extended(view, 8), kind }
    }
    if (tag !== 'SSND' || view.byteLength < 8) return undefined
    if (!format || format.channels < 1 || !(format.sampleRate >= 1)) throw bad('has a damaged header')
    const { kind, channels, sampleRate } = format, width = Math.ceil(format.bits / 8)
    const sample = samplesAre[`${aiffKinds[kind]}/${8 * width}`]
    if (!sample) throw bad(`has a format that is not read here (${kind}, ${format.bits} bits)`)
    return { little: kind === 'sowt', start: at + 8 + view.getUint32(0), bytes: format.frames * width * channels, channels, sampleRate, sample, width }
  })
}

/** Whether a file that begins with these bytes is read here. */
export const isSoundFile = (bytes) => {
  const text = String.fromCharCode(...bytes.subarray(0, 12))
  return /^(RIFF|RF64|BW64)....WAVE$/s.test(text) || /^FORM....AIF[FC]$/s.test(text)
}

/**
 * A WAV or AIFF file (8 to 32 bits, floating point, mu-law, A-law; in WAV also IMA's and Microsoft's ADPCM), sample for sample as
 * other programs have it. `bytesAt(at, length)` gives bytes of the file, `size` is how many it has. Returns
 * `{sampleRate, channels, frames, promised, read(from, count), reader()}`: `promised` frames are stated where fewer are there,
 * `read` gives an array of samples for each channel, `reader` is what encode() takes.
 */
export const openSound = (bytesAt, size) => {
  const viewAt = (at, length) => {
    const bytes = bytesAt(at, Math.max(0, Math.min(length, size - at)))
    return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)
  }
  const start = bytesAt(0, Math.min(12, size))
  if (!isSoundFile(start)) throw bad('is neither WAV nor AIFF')
  const isWav = start[0] !== 70 // F
  const layout = isWav ? wavLayout(viewAt, size) : aiffLayout(viewAt, size, start[11] === 67)
  const { channels, sampleRate, little, sample, width, block, blockFrames, blockBytes } = layout
  const there = Math.max(0, Math.min(layout.bytes, size - layout.start))
  const framesIn = (bytes) => block ? Math.ceil(bytes / blockBytes) * blockFrames : Math.floor(bytes / (width * channels))
  const frames = framesIn(there)
  // Writers that do not know how long a stream gets state no length, or the largest.
  const isStated = layout.bytes > 0 && layout.bytes < 0xfffffff0
  const promised = isStated ? Math.max(frames, block ? frames : framesIn(layout.bytes)) : frames
  const read = (from, count, parts) => {
    const first = Math.min(frames, Math.max(0, from)), last = Math.min(frames, first + Math.max(0, count))
    if (block) {
      const begin = Math.floor(first / blockFrames), end = Math.ceil(last / blockFrames)
      const whole = Array.from({ length: channels }, () => new Float32Array((end - begin) * blockFrames))
      const bytes = viewAt(layout.start + begin * blockBytes, Math.min((end - begin) * blockBytes, there - begin * blockBytes))
      for (let i = 0; begin + i < end; ++i) {
        const length = Math.min(blockBytes, bytes.byteLength - i * blockBytes)
        if (length < (layout.block === imaBlock ? 4 : 7) * channels) break
        block(new DataView(bytes.buffer, bytes.byteOffset + i * blockBytes, length), channels, blockFrames, whole, i * blockFrames)
      }
      return whole.map((one) => one.subarray(first - begin * blockFrames, last - begin * blockFrames))
    }
    const view = viewAt(layout.start + first * width * channels, (last - first) * width * channels)
    return Array.from({ length: channels }, (_, c) => {
      const into = parts?.[c].length === last - first ? parts[c] : new Float32Array(last - first)
      for (let n = 0, at = c * width; n < into.length; ++n, at += width * channels) into[n] = sample(view, at, little)
      return into
    })
  }
  return {
    sampleRate, channels, frames, promised, read,
    reader: () => {
      let done = 0, part, begin = 0 // what was read last, and where it begins
      return (into) => {
        const wanted = Math.min(into.length / channels, frames - done)
        for (let n = 0; n < wanted;) {
          if (!part || done - begin >= part[0].length) {
            begin = done
            part = read(begin, 65536, part) // in the same memory
          }
          const at = done - begin, count = Math.min(wanted - n, part[0].length - at)
          if (channels === 1) into.set(part[0].subarray(at, at + count), n)
          else
            part.forEach((channel, c) => {
              for (let i = 0; i < count; ++i) into[(n + i) * channels + c] = channel[at + i]
            })
          n += count
          done += count
        }
        return wanted * channels
      }
    }
  }
}

/** The sound in the bytes of a WAV or AIFF file. */
export const readSound = (bytes) => {
  const file = openSound((at, length) => bytes.subarray(at, at + length), bytes.length)
  const samples = file.read(0, file.frames)
  return { samples: file.channels === 1 ? samples[0] : samples, sampleRate: file.sampleRate }
}
