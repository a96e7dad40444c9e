// Where the audio of a WAV or AIFF file is, whatever its header says of that. The same as Source/io/AudioHeader.cpp, SoundTags.cpp
// and the part of SoundParts.cpp for files of chunks, which are the measure: Tests/web/check_sounds.mjs compares both.

const letters = (bytes) => String.fromCharCode(...bytes)

/** Bytes at any place of a file, read in pieces. */
export class ByteWindow {
  static most = 65536 // bytes that can be seen at once
  #bytesAt
  #start = 0
  #bytes = new Uint8Array()

  constructor(bytesAt, size) {
    this.#bytesAt = bytesAt
    this.size = size
  }

  /** `count` bytes, at most `most`; fewer at the end. */
  at(offset, count) {
    if (offset >= this.size) return this.#bytes.subarray(0, 0)
    const last = offset + Math.min(count, ByteWindow.most, this.size - offset)
    if (offset < this.#start || last > this.#start + this.#bytes.length) {
      this.#start = offset
      this.#bytes = this.#bytesAt(offset, Math.min(ByteWindow.most, this.size - offset))
    }
    return this.#bytes.subarray(offset - this.#start, last - this.#start)
  }
  has(offset, text) { return letters(this.at(offset, text.length)) === text }
  /** 0 where the file has ended. */
  number(offset, count, isBig) {
    const bytes = this.at(offset, count)
    let value = 0
    if (bytes.length === count) for (let i = 0; i < count; ++i) value = 256 * value + bytes[isBig ? i : count - 1 - i]
    return value
  }
  /** The next place of `text` in [from, to), or `to`. */
  find(text, from, to) {
    while (from < to) {
      const piece = this.at(from, Math.min(to - from, ByteWindow.most))
      if (piece.length < text.length) return to
      for (let i = piece.indexOf(text.charCodeAt(0)); i >= 0 && i + text.length <= piece.length; i = piece.indexOf(text.charCodeAt(0), i + 1))
        if (letters(piece.subarray(i, i + text.length)) === text) return from + i
      from += piece.length - (text.length - 1)
    }
    return to
  }
}

// ---- tags: ID3, APE, Lyrics3

export const tagBytesAt = (file, offset) => {
  if (file.has(offset, 'ID3')) {
    const head = file.at(offset, 10)
    if (head.length < 10 || head[3] === 255 || head[4] === 255) return 0
    return (head[5] & 16 ? 20 : 10) + ((head[6] & 127) << 21 | (head[7] & 127) << 14 | (head[8] & 127) << 7 | (head[9] & 127))
  }
  if (file.has(offset, 'TAG')) return 128
  if (file.has(offset, 'APETAGEX')) return file.number(offset + 12, 4, false) + 32
  if (file.has(offset, 'LYRICSBEGIN')) {
    const last = offset + 1000000, end = file.find('LYRICS200', offset, Math.min(last, file.size))
    return end < last && file.has(end, 'LYRICS200') ? end + 9 - offset : 0
  }
  return 0
}

/** Bytes of the tag that ends at `end`, or 0. */
const tagBytesBefore = (file, begin, end) => {
  const room = end - begin
  if (room >= 128 && file.has(end - 128, 'TAG')) return 128
  if (room >= 32 && file.has(end - 32, 'APETAGEX'))
    return file.number(end - 20, 4, false) + (file.number(end - 12, 4, false) >= 0x80000000 ? 32 : 0)
  if (room >= 15 && file.has(end - 9, 'LYRICS200')) {
    const digits = letters(file.at(end - 15, 6))
    return (/^\d{6}$/.test(digits) ? Number(digits) : 0) + 15
  }
  if (room >= 9 && file.has(end - 9, 'LYRICSEND')) return end - file.find('LYRICSBEGIN', Math.max(begin, end - 5100), end)
  if (room >= 10 && file.has(end - 10, '3DI')) {
    const [a, b, c, d] = file.at(end - 4, 4)
    return 20 + ((a & 127) << 21 | (b & 127) << 14 | (c & 127) << 7 | (d & 127))
  }
  return 0
}

const endBeforeTags = (file, begin, end) => {
  for (;;) {
    const bytes = tagBytesBefore(file, begin, end)
    if (bytes === 0 || bytes > end - begin) return end
    end -= bytes
  }
}

// ---- chunks

const layouts = {
  RIFF: { isBig: false, dataId: 'data', headerOfData: 0 }, RIFX: { isBig: true, dataId: 'data', headerOfData: 0 },
  RF64: { isBig: false, dataId: 'data', headerOfData: 0, isLong: true }, BW64: { isBig: false, dataId: 'data', headerOfData: 0, isLong: true },
  FORM: { isBig: true, dataId: 'SSND', headerOfData: 8 }
}
/** How the file at `begin` lays out its chunks; nothing where it is neither WAV nor AIFF. */
export const layoutAt = (file, begin) => {
  const id = letters(file.at(begin, 4)), layout = Object.hasOwn(layouts, id) ? layouts[id] : undefined
  const isSound = id === 'FORM' ? /^AIF[FC]$/.test(letters(file.at(begin + 8, 4))) : file.has(begin + 8, 'WAVE')
  return layout && isSound ? { ...layout, id, isWave: id !== 'FORM' } : undefined
}

const maxChunks = 10000
/** Sizes that writers leave behind when they cannot seek back: see AudioHeader.cpp. */
const isLeftOpen = (size) => (size <= 0x80000000 && size >= 0x80000000 - 65536) || size >= 0x100000000 - 65536 ||
  (size >= 1e9 && size % 1e8 === 0)
const isLeftOpen64 = (size) => size >= 2 ** 62 || (size <= 0xffffffff && isLeftOpen(size))

const hasId = (file, offset) => {
  const id = file.at(offset, 4)
  return id.length === 4 && id[0] !== 0x20 && id.every((c) => c >= 0x20 && c < 0x7f)
}
const aligned = (offset, begin) => begin + 2 * Math.ceil((offset - begin) / 2)
const nextChunk = (file, layout, offset, end) => {
  if (end < 8 || offset > end - 8) return undefined
  const size = file.number(offset + 4, 4, layout.isBig)
  return size > end ? undefined : offset + 8 + size
}
const insideWaves = (file, layout, offset) =>
  layout.isWave && file.has(offset, 'LIST') && file.has(offset + 8, 'wavl') ? offset + 12 : undefined
const silenceAt = (file, layout, offset) => layout.isWave && file.has(offset, 'slnt') ? file.number(offset + 8, 4, layout.isBig) : 0
const behindPadding = (file, next, begin) => {
  const padded = aligned(next, begin)
  return padded === next || hasId(file, padded) || !hasId(file, next) ? padded : next
}

/** The chunks of the file at `begin`, `{offset, content, bytes}`, without its audio, which lasts until `audioEnd`. */
export const chunksOf = (file, layout, begin, end, audioEnd) => {
  const chunks = []
  for (let offset = begin + 12; offset < end && hasId(file, offset) && chunks.length < maxChunks;) {
    const isAudio = file.has(offset, layout.dataId) && audioEnd > offset
    const next = isAudio ? audioEnd : nextChunk(file, layout, offset, end) ?? end
    const content = Math.min(end, offset + 8)
    if (!isAudio) chunks.push({ offset, content, bytes: Math.min(next, end) - content })
    offset = behindPadding(file, next, begin)
  }
  return chunks
}

const aifcBits = { in24: 24, in32: 32, fl32: 32, FL32: 32, fl64: 64, FL64: 64 }
/** The bits that the codec of an AIFC has; nothing where its own number counts. */
export const bitsOfAifcCodec = (file, comm) => comm.bytes >= 22 ? aifcBits[letters(file.at(comm.content + 18, 4))] : undefined

const statedByAiff = (file, layout, begin, end) => {
  for (const chunk of chunksOf(file, layout, begin, end, 0)) {
    if (!file.has(chunk.offset, 'COMM') || chunk.bytes < 18) continue
    if (chunk.bytes >= 22 && /^(ima4|GSM |agsm|DWVW|\.mp.|MAC.)/.test(letters(file.at(chunk.content + 18, 4)))) return undefined
    const bits = bitsOfAifcCodec(file, chunk) ?? file.number(chunk.content + 6, 2, true)
    return file.number(chunk.content + 2, 4, true) * file.number(chunk.content, 2, true) * Math.ceil(bits / 8)
  }
  return undefined
}

const present = (chunk, end) => Math.max(0, end - chunk.start)

const isTrueOffset = (file, layout, begin, end, chunk, offset) => {
  const there = Math.min(chunk.promise ?? Infinity, present(chunk, end))
  if (offset > there) return false
  const stated = statedByAiff(file, layout, begin, chunk.sizeField)
  if (!(stated > 0)) return offset <= 65536
  return there >= stated ? there - stated >= offset : offset <= 4096
}

const audioChunkAt = (file, layout, begin, offset, end, longSize) => {
  const found = { sizeField: offset + 4, start: offset + 8 + layout.headerOfData, silence: 0 }
  const size = file.number(found.sizeField, 4, layout.isBig)
  if (size === 0xffffffff && longSize !== undefined) {
    if (!isLeftOpen64(longSize)) found.promise = longSize
  } else if (!isLeftOpen(size)) found.promise = size - Math.min(size, layout.headerOfData)
  if (layout.isWave) return found
  const skipped = file.number(offset + 8, 4, true)
  if (skipped === 0 || (found.promise === 0 ? skipped > 4096 : !isTrueOffset(file, layout, begin, end, found, skipped))) return found
  found.start += skipped
  if (found.promise !== undefined) found.promise -= Math.min(found.promise, skipped)
  return found
}

export const startsSound = (file, offset) => {
  if (['RIFF', 'RIFX', 'RF64', 'BW64'].some((id) => file.has(offset, id))) return file.has(offset + 8, 'WAVE')
  if (file.has(offset, 'FORM')) return file.has(offset + 8, 'AIF')
  if (file.has(offset, 'dns.')) return file.number(offset + 4, 4, false) < 65536
  return ['caff\0\x01', 'riff\x2e\x91\xcf\x11', '.snd\0\0', 'fLaC\0\0\0', 'OggS\0'].some((id) => file.has(offset, id))
}

/** The next audio of the same file, if nothing but chunks lie between it and `offset`. */
const nextAudioChunk = (file, layout, begin, offset, end) => {
  let silence = 0
  for (let chunk = 0; chunk < maxChunks && offset < end; ++chunk) {
    if (!hasId(file, offset) || startsSound(file, offset)) return undefined
    const inside = insideWaves(file, layout, offset)
    if (inside !== undefined) {
      offset = inside
      continue
    }
    silence += silenceAt(file, layout, offset)
    if (file.has(offset, layout.dataId)) {
      const found = { ...audioChunkAt(file, layout, begin, offset, end), silence }
      return present(found, end) > 0 ? found : undefined
    }
    const next = nextChunk(file, layout, offset, end)
    if (next === undefined) return undefined
    offset = behindPadding(file, next, begin)
  }
  return undefined
}

/** The audio of the file at `begin`: `{sizeField, start, promise, silence}`, `promise` bytes unless the writer left them open. */
export const findAudioChunk = (file, layout, begin, end) => {
  let longSize, silence = 0
  for (let chunk = 0, offset = begin + 12; chunk < maxChunks && offset + 8 <= end; ++chunk) {
    if (layout.isLong && file.has(offset, 'ds64') && offset + 24 <= end) longSize = file.number(offset + 16, 8, false)
    if (file.has(offset, layout.dataId)) {
      const found = audioChunkAt(file, layout, begin, offset, end, longSize)
      // An empty one, and the audio in another behind it.
      const later = found.promise === 0 ? nextAudioChunk(file, layout, begin, found.start, end) : undefined
      return later && later.promise !== 0 ? later : { ...found, silence }
    }
    const inside = insideWaves(file, layout, offset)
    if (inside !== undefined) {
      offset = inside
      continue
    }
    silence += silenceAt(file, layout, offset)
    const next = nextChunk(file, layout, offset, end)
    if (next === undefined) return undefined
    offset = behindPadding(file, next, begin)
  }
  return undefined
}

const areZeros = (file, offset, end) => {
  while (offset < end) {
    const piece = file.at(offset, Math.min(end - offset, 4096))
    if (piece.length === 0 || piece.some((c) => c !== 0)) return false
    offset += piece.length
  }
  return true
}

/** `{next, tag}`: the end if nothing but chunks lie from `offset` to there, where another sound begins, or nothing; the first tag. */
const endOfChunks = (file, layout, offset, end) => {
  let tag
  for (let chunk = 0; chunk < maxChunks; ++chunk) {
    if (offset >= end) return { next: end, tag }
    if (startsSound(file, offset)) return { next: offset, tag }
    if (chunk > 0 && areZeros(file, offset, end)) return { next: end, tag }
    const bytes = file.has(offset, 'ID3') ? tagBytesAt(file, offset) : 0
    if (bytes > 0 && bytes <= end - offset && !hasId(file, offset)) {
      tag ??= offset
      offset += bytes
      continue
    }
    if (!hasId(file, offset) || file.has(offset, layout.dataId)) return {}
    const next = nextChunk(file, layout, offset, end)
    if (next === undefined || next > end) return {}
    const padded = aligned(next, 0)
    offset = padded >= end ? padded : behindPadding(file, next, 0)
  }
  return {}
}

const lastIds = ['LIST', 'id3 ', 'ID3 ', 'bext', 'cue ', 'smpl', 'fact', 'PEAK', 'iXML', 'JUNK', 'junk', 'axml', 'chna', 'inst', 'acid', '_PMX', 'NAME',
  'AUTH', 'ANNO', 'MARK', 'COMM', 'INST', 'info', 'free']
/** Where the chunks begin that follow audio of unknown size. */
const startOfLastChunks = (file, layout, from, end) => {
  let first = end
  const begin = Math.max(from, end > 32768 ? end - 32768 : 0)
  for (const id of lastIds)
    for (let place = file.find(id, begin, end); place < end; place = file.find(id, place + 1, end))
      if (place < first && endOfChunks(file, layout, place, end).next === end) first = place
  return first
}

/** Bytes of a frame as the header states them; 0 where nothing tells. */
export const frameBytesOf = (file, layout, begin, end) => {
  for (const chunk of chunksOf(file, layout, begin, end, 0)) {
    if (file.has(chunk.offset, 'fmt ') && chunk.bytes >= 16)
      return [1, 3, 0xfffe].includes(file.number(chunk.content, 2, layout.isBig)) ? file.number(chunk.content + 12, 2, layout.isBig) : 0
    if (file.has(chunk.offset, 'COMM') && chunk.bytes === 18)
      return file.number(chunk.content, 2, true) * Math.ceil(file.number(chunk.content + 6, 2, true) / 8)
  }
  return 0
}

// ---- one stretch of audio, and what lies behind it

const isWholeAnyway = (file, layout, chunk, begin, end) => {
  const there = present(chunk, end), excess = chunk.promise - there
  if (there === 0) return false
  if (excess <= 64 || excess === chunk.start - begin || (chunk.promise + 64 >= 2 * there && chunk.promise <= 2 * there + 64)) return true
  if (layout.isLong) return false
  const whole = file.number(begin + 4, 4, layout.isBig) + 8
  return whole === end - begin || whole + 1 === end - begin
}

/** The end, or where another sound begins, behind nothing but tags. */
const behindLastTags = (file, begin, end) => {
  let offset = begin
  while (offset < end) {
    if (offset > begin && startsSound(file, offset)) return offset
    const tag = tagBytesAt(file, offset)
    if (tag === 0 || tag > end - offset) return undefined
    offset += tag
  }
  return offset
}

/**
 * What is read of `chunk`, of the file at `begin`: `{start, bytes, silence, promised, isWhole, leftOut, end, later, next}`: `promised`
 * bytes where a header is wrong about them, `later` is more audio of the same file, `next` where another sound begins.
 */
export const stretchOf = (file, layout, chunk, begin, end) => {
  const part = { start: chunk.start, silence: chunk.silence, isWhole: true, leftOut: 0, end }
  const soundEnd = endBeforeTags(file, Math.min(chunk.start, end), end)
  const endAt = (audioEnd) => {
    part.end = audioEnd
    part.bytes = present(chunk, audioEnd)
    return part
  }
  const beforeLastChunks = () => startOfLastChunks(file, layout, Math.min(chunk.start, soundEnd), soundEnd)
  const { promise } = chunk
  if (promise === undefined) return endAt(beforeLastChunks())
  if (promise > present(chunk, end)) {
    part.promised = promise
    part.isWhole = isWholeAnyway(file, layout, chunk, begin, end)
    return endAt(part.isWhole ? beforeLastChunks() : end)
  }
  part.bytes = promise
  const stop = chunk.start + promise, last = Math.max(stop, soundEnd)
  if (layout.isWave && layout.id !== 'RIFF') part.end = stop
  if (stop >= last) return part
  // Odd sizes are followed by a byte of padding, which some writers leave out.
  for (let pad = 0; pad < 2; ++pad) {
    const behind = Math.min(stop + pad, last), { next, tag } = endOfChunks(file, layout, behind, last)
    if (next !== undefined && next >= last) {
      part.end = tag ?? part.end
      return part
    }
    if (next !== undefined || startsSound(file, behind)) {
      part.next = part.end = next ?? behind
      return part
    }
    const tagged = behindLastTags(file, behind, last)
    if (tagged !== undefined) {
      part.end = behind
      part.next = tagged < last ? tagged : undefined
      return part
    }
    part.later = nextAudioChunk(file, layout, begin, behind, last)
    if (part.later) return endAt(stop)
  }
  if (promise > 0 && last - stop <= 65536 && areZeros(file, stop, last)) {
    part.leftOut = last - stop
    return part
  }
  // A few bytes that make no whole frame, behind a stated end that does.
  const frame = last - stop < 64 ? frameBytesOf(file, layout, begin, chunk.sizeField) : 0
  if (frame > 1 && promise > 0 && promise % frame === 0 && (last - stop) % frame !== 0) {
    part.leftOut = last - stop
    return endAt(stop)
  }
  part.promised = promise
  return endAt(beforeLastChunks())
}
