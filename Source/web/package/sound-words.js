// How samples lie in the words of a WAV or AIFF file, where its header does not say it or says something else. The same as
// Source/io/SampleWords.cpp, which is the measure, with the same warnings: Tests/web/check_sounds.mjs compares both.

import { bitsOfAifcCodec, ByteWindow, chunksOf } from './sound-header.js'

/** A number with so many digits, as C++ prints it: halves go to the even neighbour. */
export const fixed = (value, digits) => {
  if (Math.abs(value) >= 1e21) return BigInt(value).toString()
  const isTie = Math.abs(value * 2 ** (digits + 1) % 2) === 1
  const text = value.toFixed(digits), below = Math.floor(value * 10 ** digits)
  return isTie && below % 2 === 0 ? (below / 10 ** digits).toFixed(digits) : text
}

const wordsOfWave = (file, format, isBig) => {
  const at = (place) => file.number(format.content + place, 2, isBig)
  const isLong = at(0) === 0xfffe && format.bytes >= 26
  const codec = isLong ? at(24) : at(0), channels = at(2), frame = at(12), bits = at(14)
  if ((codec !== 1 && codec !== 3) || channels === 0 || bits === 0) return undefined
  const words = { bytes: Math.ceil(bits / 8), bits, isFloat: codec === 3, isBig, isMisread: false, canBeFloat: true }
  if (frame % channels === 0 && frame / channels > words.bytes && frame / channels <= 4) {
    words.bytes = frame / channels
    words.isMisread = true
  }
  const valid = isLong ? at(18) : 0
  if (valid > 0 && valid < words.bits) words.bits = valid
  return words
}

const wordsOfAiff = (file, comm) => {
  const is = (name) => comm.bytes >= 22 && file.has(comm.content + 18, name)
  const bits = bitsOfAifcCodec(file, comm) ?? file.number(comm.content + 6, 2, true)
  const isFloat = ['fl32', 'FL32', 'fl64', 'FL64'].some(is)
  const isPlain = comm.bytes < 22 || isFloat || ['NONE', 'twos', 'sowt', 'in24', 'in32'].some(is)
  return isPlain ? { bytes: Math.ceil(bits / 8), bits, isFloat, isBig: !is('sowt'), isMisread: false, canBeFloat: false } : undefined
}

/** The words of the file at `begin` by its header, which ends at `headerEnd`. */
const wordsOf = (file, layout, begin, headerEnd) => {
  for (const chunk of chunksOf(file, layout, begin, headerEnd, 0)) {
    if (file.has(chunk.offset, 'fmt ') && chunk.bytes >= 16) return wordsOfWave(file, chunk, layout.isBig)
    if (file.has(chunk.offset, 'COMM') && chunk.bytes >= 18) return wordsOfAiff(file, chunk)
  }
  return undefined
}

/** What the words of a file have in common. */
class WordScan {
  areWhole = true
  areFinite = true
  peak = 0
  sounding = 0
  #any = 0
  #magnitude = 0
  #exponents = new Set()
  #unusual = 0
  #hasBelow = false
  #hasAbove = false
  #double = new DataView(new ArrayBuffer(8))

  constructor(words) { this.words = words }

  take(bytes) {
    const { bytes: width, isBig, isFloat } = this.words
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)
    for (let at = 0; at + width <= bytes.length; at += width) {
      let bits = 0
      if (width === 8) bits = view.getUint32(at, false) | view.getUint32(at + 4, false) // whether there are any
      else for (let i = 0; i < width; ++i) bits = (bits << 8 | bytes[at + (isBig ? i : width - 1 - i)]) >>> 0
      if (bits === 0) continue
      ++this.sounding
      if (width === 8) this.#takeNumber(view.getFloat64(at, !isBig))
      else if (width === 4) this.#takeNumber(view.getFloat32(at, !isBig))
      if (!isFloat) this.#takeInteger(bits, 8 * width)
    }
  }

  get integerBits() { return 33 - Math.clz32(this.#magnitude) }
  get lowZeros() { return 31 - Math.clz32(this.#any & -this.#any) }
  get isSilent() { return this.sounding === 0 }
  get areNumbers() {
    return this.areFinite && this.sounding >= 64 && this.#unusual <= Math.floor(this.sounding / 50) && this.#hasBelow && this.#hasAbove &&
      this.#exponents.size >= 4
  }

  #takeNumber(value) {
    if (!Number.isFinite(value)) {
      this.areWhole = this.areFinite = false
      return
    }
    const size = Math.abs(value)
    this.peak = Math.max(this.peak, size)
    this.areWhole &&= Math.trunc(value) === value
    this.#double.setFloat64(0, size)
    const exponent = (this.#double.getUint16(0) >> 4) - 1023
    if (exponent >= -30 && exponent <= 25) this.#exponents.add(exponent)
    else ++this.#unusual
    if (value < 0) this.#hasBelow = true
    else this.#hasAbove = true
  }

  #takeInteger(bits, width) {
    this.#any |= bits
    const all = width === 32 ? 0xffffffff : 2 ** width - 1
    this.#magnitude |= bits > all / 2 ? ~bits & all : bits
  }
}

const judge = (words, scan) => {
  if (words.isFloat) {
    if (!scan.areFinite || scan.sounding < 64) return 'as stated'
    if (scan.areWhole && scan.peak >= 16) return 'whole'
    return scan.peak > 256 ? 'loud' : 'as stated'
  }
  if (words.bytes === 4 && scan.areNumbers) return 'number'
  if (scan.isSilent) return words.isMisread ? 'high' : 'as stated'
  const spare = 8 * words.bytes - words.bits
  if (spare === 0) return words.bytes === 4 && scan.integerBits <= 24 && scan.lowZeros === 0 && scan.sounding >= 64 ? 'quiet' : 'as stated'
  const fitsLow = scan.integerBits <= words.bits
  if (scan.lowZeros >= spare) return fitsLow ? 'quiet' : 'high'
  return fitsLow ? 'low' : 'as stated'
}

const scanAll = (file, audio, words) => {
  const scan = new WordScan(words), piece = Math.floor(ByteWindow.most / words.bytes) * words.bytes
  for (const { start, bytes } of audio)
    for (let at = 0; at < bytes; at += piece) scan.take(file.at(start + at, Math.min(piece, bytes - at)))
  return scan
}
/** Some pieces, which mostly show that all is as stated. */
const scanSome = (file, [first], words) => {
  const scan = new WordScan(words)
  for (let i = 0; first && i < 16; ++i) {
    const from = Math.floor(Math.floor(first.bytes / 16) * i / words.bytes) * words.bytes
    scan.take(file.at(first.start + from, Math.min(4096, first.bytes - from)))
  }
  return scan
}

const decibels = (bits) => fixed(20 * Math.log10(2) * bits, 0)

const readingOf = (words, found, scan) => {
  const width = 8 * words.bytes, asInteger = words.isMisread ? 'integer' : undefined
  switch (found) {
    case 'low':
      return { as: 'integer', gain: 2 ** (width - words.bits), warning: `has samples of ${words.bits} bits at the low end of words of ${width} bits, not at the high end; they are read there, ${decibels(width - words.bits)} dB louder than other programs may play them; save it anew` }
    case 'high':
      return { as: asInteger, gain: 1 }
    case 'quiet':
      return { as: asInteger, gain: 1, warning: `uses ${scan.integerBits} of the ${width} bits of its samples, at the low end; it is read as its header has it, ${decibels(width - scan.integerBits)} dB below full scale; if that is too soft, save it anew with the right number of bits` }
    case 'number': {
      if (!words.canBeFloat)
        return { gain: 1, warning: `states integers of ${words.bits} bits, but seems to have floating-point numbers, which this format does not have; it is read as stated, which may be noise; save it anew` }
      const scale = scan.peak <= 8 ? 0 : words.bits === 24 || scan.peak > 131072 ? 23 : 15
      const warning = scale === 0 ? `states integers of ${words.bits} bits, but has floating-point numbers; it is read as these; save it anew`
        : `states integers of ${words.bits} bits, but has floating-point numbers whose full scale is ${2 ** scale}; it is read as these; save it anew`
      return { as: 'float', gain: 2 ** -scale, warning }
    }
    case 'whole': {
      const scale = scan.peak <= 32768 ? 15 : scan.peak <= 8388608 ? 23 : 31
      return { gain: 2 ** -scale, warning: `has floating-point samples that are all whole numbers, up to ${fixed(scan.peak, 0)}; they are read as integers of ${scale + 1} bits, with a full scale of ${2 ** scale}; save it anew` }
    }
    case 'loud':
      return { gain: 1, warning: `has floating-point samples up to ${fixed(scan.peak, 0)} times full scale, which are read as they are; scale them to 1 if that is not meant` }
  }
  return { gain: 1, isUnclear: words.isMisread }
}

/**
 * How the samples in the stretches `audio` are read: `{as, bytes, gain, warning}`, `as` full words of so many bytes where that is not
 * what the header says. `isUnclear`: words that only a guess could read.
 */
export const sampleReading = (file, layout, begin, headerEnd, audio) => {
  const words = wordsOf(file, layout, begin, headerEnd)
  if (!words || words.bits > 8 * words.bytes) return { gain: 1 }
  const asStated = { gain: 1, isUnclear: words.isMisread }
  const isKnown = words.isFloat ? words.bytes === 4 || words.bytes === 8 : words.bytes >= 2 && words.bytes <= 4
  if (!isKnown || (words.isFloat && words.isMisread)) return asStated
  if (!words.isFloat && words.bytes < 4 && words.bits === 8 * words.bytes) return asStated
  const some = scanSome(file, audio, words)
  if (judge(words, some) === 'as stated' && !some.isSilent) return asStated
  const all = scanAll(file, audio, words)
  return { bytes: words.bytes, ...readingOf(words, judge(words, all), all) }
}
