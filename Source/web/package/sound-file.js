// WAV and AIFF files, read in parts: a long sound needs the memory of the part that is read.

import { PaciniError } from './module.js'
import { ByteWindow, bitsOfAifcCodec, chunksOf, findAudioChunk, frameBytesOf, layoutAt, stretchOf, tagBytesAt } from './sound-header.js'
import { addMarkers, hasChapters, keptMarkers, markersOf } from './sound-markers.js'
import { fixed, sampleReading } from './sound-words.js'

const bad = (message) => new PaciniError({ code: 'invalidData', where: 'sound file', message })

// ---- codecs: G.711 and ADPCM, as libsndfile has them

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

/** Of its predictors. libsndfile takes these, whatever a header states. */
const microsoftCoefficients = [[256, 0], [512, -256], [0, 0], [192, 64], [240, 0], [460, -208], [392, -232]]
const microsoftSteps = [230, 230, 230, 230, 307, 409, 512, 614, 768, 614, 512, 409, 307, 230, 230, 230]

/** A block of Microsoft's ADPCM: two samples as they are, then four bits of each channel by turns. */
const microsoftBlock = (view, channels, frames, into, at) => {
  const all = (offset) => Array.from({ length: channels }, (_, c) => view.getInt16(offset + 2 * c, true))
  const chosen = Array.from({ length: channels }, (_, c) => microsoftCoefficients[view.getUint8(c)] ?? microsoftCoefficients[0])
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

const wavKinds = { 1: 'integer', 3: 'float', 6: 'alaw', 7: 'mulaw' }
const unread = (code, bits) => bad(`has a format that is not read here (${code}, ${bits} bits)`)

/** The chunk of that name of the file at `begin`, in front of its audio or behind it. */
const describing = (file, layout, begin, chunk, audioEnd, name, least) => {
  const is = ({ offset, bytes }) => file.has(offset, name) && bytes >= least
  return chunksOf(file, layout, begin, chunk.sizeField, 0).find(is) ?? chunksOf(file, layout, begin, file.size, audioEnd).find(is)
}

const wavFormat = (file, layout, begin, chunk, audioEnd) => {
  const found = describing(file, layout, begin, chunk, audioEnd, 'fmt ', 16)
  if (!found) throw bad('has a damaged header')
  const at = (place, count = 2) => place + count <= found.bytes ? file.number(found.content + place, count, layout.isBig) : 0
  const channels = at(2), sampleRate = at(4, 4), blockBytes = at(12), bits = at(14)
  const code = at(0) === 0xfffe && found.bytes >= 26 ? at(24) : at(0)
  if (channels < 1 || sampleRate < 1) throw bad('has a damaged header')
  // The channel of low-frequency effects, by the map of those that name their channels.
  const mask = at(0) === 0xfffe && channels > 2 ? at(20, 4) : 0, before = [1, 2, 4].filter((bit) => mask & bit).length
  const common = { little: !layout.isBig, channels, sampleRate, lowFrequency: mask & 8 && before < channels ? before : undefined }
  if (code === 2 || code === 17) {
    const least = (code === 2 ? 7 : 4) * channels, blockFrames = at(18)
    const fitting = (blockBytes - least) * 2 / channels + (code === 2 ? 2 : 1)
    if (blockBytes < least || blockFrames < 1 || blockFrames > fitting) throw bad('has a damaged header')
    return { ...common, blockBytes, blockFrames, block: code === 2 ? microsoftBlock : imaBlock, blockLeast: least }
  }
  const width = Math.ceil(bits / 8)
  return { ...common, kind: code === 1 && width === 1 ? 'unsigned' : wavKinds[code], width, name: code, bits }
}

const tagAt = (bytes) => String.fromCharCode(...bytes.subarray(0, 4))
/** An IEEE 754 number of 80 bits, as AIFF has rates. */
const extended = (view, at) => {
  const exponent = (view.getUint16(at) & 0x7fff) - 16383
  return view.getUint32(at + 2) * 2 ** (exponent - 31) + view.getUint32(at + 6) * 2 ** (exponent - 63)
}
const aiffKinds = { 'NONE': 'integer', 'twos': 'integer', 'sowt': 'integer', 'in24': 'integer', 'in32': 'integer', 'raw ': 'unsigned', 'fl32': 'float', 'FL32': 'float',
  'fl64': 'float', 'FL64': 'float', 'ulaw': 'mulaw', 'ULAW': 'mulaw', 'alaw': 'alaw', 'ALAW': 'alaw' }

const aiffFormat = (file, layout, begin, chunk, audioEnd) => {
  const found = describing(file, layout, begin, chunk, audioEnd, 'COMM', 18)
  if (!found) throw bad('has a damaged header')
  const bytes = file.at(found.content, 22), view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)
  const kind = file.has(begin + 8, 'AIFC') && found.bytes >= 22 ? tagAt(bytes.subarray(18)) : 'NONE'
  const channels = view.getUint16(0), sampleRate = Math.trunc(extended(view, 8))
  if (channels < 1 || !(sampleRate >= 1)) throw bad('has a damaged header')
  const bits = /^[au]law$/i.test(kind) ? 8 : bitsOfAifcCodec(file, found) ?? view.getUint16(6)
  return { little: kind === 'sowt', channels, sampleRate, kind: aiffKinds[kind], width: Math.ceil(bits / 8), name: kind, bits }
}

/** Whether a WAV says twice how its samples look, and differently. */
const hasOtherFormat = (file, layout, begin, chunk) => {
  const [first, ...others] = chunksOf(file, layout, begin, chunk.sizeField, 0).filter(({ offset }) => file.has(offset, 'fmt '))
    .map(({ content, bytes }) => String.fromCharCode(...file.at(content, Math.min(bytes, 4096))))
  return others.some((other) => other !== first)
}

const chapters = 'has chapters in an ID3 tag, which are not read here'
const mostParts = 1000, mostChannels = 64, slowest = 1000, fastest = 768000, slowestEncoded = 8000 // as AudioReader.h has them

/** The sound of the file at `begin`: its format, its stretches of audio, and where another sound begins. */
const soundAt = (file, begin) => {
  const end = file.size, layout = layoutAt(file, begin)
  if (!layout) throw bad('is neither WAV nor AIFF')
  const first = findAudioChunk(file, layout, begin, end)
  if (!first) throw bad('has no samples')
  const audio = []
  for (let chunk = first; chunk; chunk = audio.at(-1).later) {
    if (audio.length === mostParts) {
      audio.at(-1).leftOut += end - chunk.start
      break
    }
    audio.push(stretchOf(file, layout, chunk, begin, end))
  }
  const format = (layout.isWave ? wavFormat : aiffFormat)(file, layout, begin, first, first.start + audio[0].bytes)
  const reading = sampleReading(file, layout, begin, first.sizeField, audio)
  const { name, bits, channels, block } = format
  const stated = frameBytesOf(file, layout, begin, first.sizeField)
  if (reading.as) {
    format.kind = reading.as
    format.width = reading.bytes
  } else if (reading.isUnclear)
    throw bad(`has frames of ${stated} bytes for ${channels} x ${bits} bits, which is not read here; 'pacini encode' reads it`)
  format.gain = reading.gain
  if (channels > mostChannels) throw bad(`has ${channels} channels, but only 1 to ${mostChannels} are supported; mix it down`)
  if (format.sampleRate < slowest || format.sampleRate > fastest)
    throw bad(`has a sample rate of ${format.sampleRate} Hz, but only ${slowest} to ${fastest} Hz are supported; resample it`)
  format.sample = block ? undefined : samplesAre[`${format.kind}/${8 * format.width}`]
  if (!format.sample && !block) throw unread(name, bits)
  const lasting = audio[0].end - begin, frames = block ? Math.ceil(audio[0].bytes / format.blockBytes) * format.blockFrames : Math.floor(lasting / format.width / channels)
  const { next } = audio.at(-1), until = next ?? end
  const chunks = chunksOf(file, layout, begin, until, audio[0].bytes > 0 ? first.start + audio[0].bytes : 0)
  const found = markersOf(file, layout, chunks, format.sampleRate)
  if (chunks.some(({ offset, content, bytes }) => /^id3 $/i.test(tagAt(file.at(offset, 4))) && hasChapters(file, content, content + bytes)) ||
    hasChapters(file, audio.at(-1).end, until))
    found.warnings.push(chapters)
  return { begin, format, audio, stated, warning: reading.warning, hasOtherFormat: hasOtherFormat(file, layout, begin, first), seconds: frames / format.sampleRate,
    found, next }
}

/** Frames, and what is told of them, in the order in which the program tells it. */
const framesOf = ({ begin, format, audio, stated, warning, hasOtherFormat }, isFirst) => {
  const { block, blockBytes, blockFrames, channels, sampleRate, width } = format
  const frameBytes = width * channels, told = [], stretches = []
  let promised = 0
  audio.forEach((part, i) => {
    const frames = block ? Math.ceil(part.bytes / blockBytes) * blockFrames : Math.floor(part.bytes / frameBytes)
    const seconds = (bytes) => (block ? bytes / Math.max(1, part.end - begin) * frames : Math.floor(bytes / frameBytes)) / sampleRate
    const short = (value) => fixed(value, 3)
    const isBroken = part.promised !== undefined && !part.isWhole && (block || frames !== Math.floor(part.promised / frameBytes))
    const before = [], behind = []
    if (isBroken) before.push(`is cut off: ${short(seconds(part.bytes))} s of ${short(seconds(part.promised))} s are there`)
    else if (part.promised !== undefined && part.isWhole && seconds(part.promised) !== seconds(part.bytes)) {
      const [claim, there] = [seconds(part.promised), seconds(part.bytes)], digits = short(claim) === short(there) ? 6 : 3
      before.push(`has a header that states ${fixed(claim, digits)} s, but ${fixed(there, digits)} s are there and all of them are read; save it anew`)
    }
    if (i === 0 && !block && stated > 0 && stated !== frameBytes)
      before.push(`has a header that states frames of ${stated} bytes, but its samples make frames of ${frameBytes}; read by these it lasts ${short(frames / sampleRate)} s, by the others it would last ${short(Math.floor(part.bytes / stated) / sampleRate)} s; save it anew`)
    if (i === 0 && warning) before.push(warning)
    if (i === 0 && hasOtherFormat)
      before.push(`has two descriptions of its samples that differ; it is read by the first, as ${channels} channels at ${sampleRate} Hz, and lasts ${short(frames / sampleRate)} s; save it anew`)
    if (i === 0 && isFirst && sampleRate < slowestEncoded) // which encode() raises
      before.push(`is sampled at ${sampleRate} Hz, so all above ${Math.floor(sampleRate / 2)} Hz is missing; it is read at ${sampleRate * Math.ceil(slowestEncoded / sampleRate)} Hz`)
    if (part.leftOut > 0)
      behind.push(`has ${part.leftOut} bytes behind its sound that are left out; as sound they would be ${short(seconds(part.leftOut))} s`)
    if (part.silence > 0) stretches.push({ frames: part.silence, isSilent: true })
    stretches.push({ frames, start: part.start, bytes: part.bytes, format })
    promised += part.silence + (isBroken ? Math.round(seconds(part.promised) * sampleRate) : frames)
    told.push(...before, ...behind)
  })
  return { stretches, promised, told }
}

const behindTags = (file) => {
  let begin = 0
  while (file.has(begin, 'ID3') || file.has(begin, 'APETAGEX')) {
    const tag = tagBytesAt(file, begin)
    if (tag === 0) break
    begin += tag
  }
  return begin
}

/** The stretches of all sounds of one kind that lie one behind the other in a file, with what is told of them. */
const planOf = (file) => {
  const first = soundAt(file, behindTags(file)), { channels, sampleRate, lowFrequency } = first.format
  const plan = { channels, sampleRate, lowFrequency, stretches: [], frames: 0, promised: 0, warnings: [] }
  const found = { markers: [], warnings: hasChapters(file, 0, first.begin) ? [chapters] : [] }
  const add = (sound) => {
    const { stretches, promised, told } = framesOf(sound, sound === first)
    addMarkers(found, sound.found, (plan.frames + sound.audio[0].silence) / sampleRate)
    for (const stretch of stretches) {
      plan.stretches.push({ ...stretch, first: plan.frames })
      plan.frames += stretch.frames
    }
    plan.promised += promised
    plan.warnings.push(...told)
  }
  add(first)
  for (let next = first.next, sounds = 1; next !== undefined && sounds < mostParts; ++sounds) {
    const from = fixed(plan.frames / sampleRate, 3)
    let sound
    try {
      sound = soundAt(file, next)
    } catch (error) {
      if (!(error instanceof PaciniError)) throw error
      plan.warnings.push(`has another sound behind ${from} s, which is left out: it ${error.message.slice('sound file: '.length)} (${file.size - next} bytes)`)
      break
    }
    if (sound.format.sampleRate === sampleRate && sound.format.channels === channels) add(sound)
    else {
      const { channels: count, sampleRate: other } = sound.format
      plan.warnings.push(`has another sound behind ${from} s, which is left out: it has ${count} channels at ${other} Hz (${fixed(sound.seconds, 3)} s); save it as a file of its own`)
    }
    next = sound.next
  }
  const { markers, warnings } = keptMarkers(found, plan.frames / sampleRate)
  plan.warnings.push(...warnings)
  return { ...plan, markers }
}

// ---- samples

const readPlain = ({ format }, view, count, into, at) => {
  const { sample, width, channels, little, gain } = format
  into.forEach((channel, c) => {
    for (let n = 0, place = c * width; n < count; ++n, place += width * channels) channel[at + n] = gain === 1 ? sample(view, place, little) : gain * Math.fround(sample(view, place, little))
  })
}

const readBlocks = ({ start, bytes, format }, viewAt, first, count, into, at) => {
  const { block, blockBytes, blockFrames, blockLeast, channels } = format
  const begin = Math.floor(first / blockFrames), end = Math.ceil((first + count) / blockFrames)
  const whole = Array.from({ length: channels }, () => new Float32Array((end - begin) * blockFrames))
  const view = viewAt(start + begin * blockBytes, Math.min((end - begin) * blockBytes, bytes - begin * blockBytes))
  for (let i = 0; begin + i < end; ++i) {
    const length = Math.min(blockBytes, view.byteLength - i * blockBytes)
    if (length < blockLeast) break
    block(new DataView(view.buffer, view.byteOffset + i * blockBytes, length), channels, blockFrames, whole, i * blockFrames)
  }
  into.forEach((channel, c) => channel.set(whole[c].subarray(first - begin * blockFrames, first - begin * blockFrames + count), at))
}

/** Whether the file, of which `bytesAt(at, length)` gives bytes, is read here. */
export const isSoundFile = (bytesAt, size) => {
  const file = new ByteWindow(bytesAt, size)
  return layoutAt(file, behindTags(file)) !== undefined
}

/**
 * A WAV or AIFF file (8 to 32 bits, floating point, mu-law, A-law; in WAV also IMA's and Microsoft's ADPCM), sample for sample as
 * other programs have it. `bytesAt(at, length)` gives bytes of the file, `size` is how many it has. Returns
 * `{sampleRate, channels, frames, promised, warnings, markers, lowFrequency, read(from, count), reader()}`: `promised` frames are
 * stated where fewer are there, `warnings` are what the program says of the file, `lowFrequency` is the channel of low-frequency
 * effects of a file that names its channels, `read` gives an array of samples for each channel, `reader` is what encode() takes.
 */
export const openSound = (bytesAt, size) => {
  const viewAt = (at, length) => {
    const bytes = bytesAt(at, Math.max(0, Math.min(length, size - at)))
    return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)
  }
  const { channels, sampleRate, frames, promised, warnings, markers, lowFrequency, stretches } = planOf(new ByteWindow(bytesAt, size))
  const read = (from, count, parts) => {
    const first = Math.min(frames, Math.max(0, from)), last = Math.min(frames, first + Math.max(0, count))
    const into = parts?.[0].length === last - first ? parts : Array.from({ length: channels }, () => new Float32Array(last - first))
    for (const stretch of stretches) {
      const begin = Math.max(first, stretch.first), length = Math.min(last, stretch.first + stretch.frames) - begin
      if (length <= 0) continue
      const inside = begin - stretch.first, at = begin - first
      if (stretch.isSilent) for (const channel of into) channel.fill(0, at, at + length)
      else if (stretch.format.block) readBlocks(stretch, viewAt, inside, length, into, at)
      else {
        const frameBytes = stretch.format.width * channels
        readPlain(stretch, viewAt(stretch.start + inside * frameBytes, length * frameBytes), length, into, at)
      }
    }
    return into
  }
  return {
    sampleRate, channels, frames, promised, warnings, markers, lowFrequency, read,
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
  return { samples: file.channels === 1 ? samples[0] : samples, sampleRate: file.sampleRate, warnings: file.warnings, markers: file.markers, lowFrequency: file.lowFrequency }
}
