// Markers of a WAV or AIFF file: cues with their labels, and loops. The same as Source/io/SoundCues.cpp and the loops of
// SoundMarkers.cpp, which are the measure: Tests/web/check_sounds.mjs compares both.

import { ByteWindow, tagBytesAt } from './sound-header.js'

const mostMarkers = 10000, mostBytes = 100000 // as FoundMarkers.h has them

const isUtf8 = (bytes) => {
  try {
    return new TextDecoder('utf-8', { fatal: true, ignoreBOM: true }).decode(bytes)
  } catch {
    return undefined
  }
}
// Bytes 0x80 to 0x9F of Windows-1252. Decoders of Node.js take them for controls.
const others = '\u20ac\x81\u201a\u0192\u201e\u2026\u2020\u2021\u02c6\u2030\u0160\u2039\u0152\x8d\u017d\x8f\x90\u2018\u2019\u201c\u201d\u2022\u2013\u2014\u02dc\u2122\u0161\u203a\u0153\x9d\u017e\u0178'
/** A text that is UTF-8, perhaps cut within a character, or else Windows-1252. */
const textOf = (bytes) => {
  const end = bytes.indexOf(0), text = end < 0 ? bytes : bytes.subarray(0, end), whole = isUtf8(text)
  if (whole !== undefined) return whole
  for (let cut = 1; cut < 4 && cut < text.length; ++cut) {
    const rest = text.subarray(0, text.length - cut), shorter = rest.every((byte) => byte < 128) ? undefined : isUtf8(rest)
    if (shorter !== undefined) return shorter
  }
  return Array.from(text, (byte) => byte >= 0x80 && byte < 0xa0 ? others[byte - 0x80] : String.fromCharCode(byte)).join('')
}
const textAt = (file, offset, bytes) => textOf(file.at(offset, Math.min(bytes, ByteWindow.most)))

const readCues = (list, file, { content, bytes }, isBig) => {
  if (bytes < 4) return
  const stated = file.number(content, 4, isBig), there = Math.floor((bytes - 4) / 24)
  list.stated += Math.max(stated, there)
  list.uncounted += Math.max(0, there - stated)
  for (let i = 0; i < there; ++i) {
    const cue = content + 4 + 24 * i
    list.cues.push({ id: file.number(cue, 4, isBig), played: file.number(cue + 4, 4, isBig), frame: file.number(cue + 20, 4, isBig) })
  }
}

const readLabels = (list, file, { content, bytes }, isBig) => {
  if (!file.has(content, 'adtl')) return
  const end = content + bytes
  const isText = (place) => ['labl', 'note', 'ltxt'].some((id) => file.has(place, id))
  for (let offset = content + 4; offset + 12 <= end;) {
    const length = Math.min(file.number(offset + 4, 4, isBig), end - offset - 8), id = file.number(offset + 8, 4, isBig)
    if (file.has(offset, 'labl') && length > 4) list.names.set(id, textAt(file, offset + 12, length - 4))
    else if (file.has(offset, 'note') && length > 4) list.notes.set(id, textAt(file, offset + 12, length - 4))
    else if (file.has(offset, 'ltxt') && length >= 8) {
      list.regions += file.number(offset + 12, 4, isBig) > 0 ? 1 : 0
      if (length > 20 && !list.notes.has(id)) list.notes.set(id, textAt(file, offset + 28, length - 20))
    }
    offset += 8 + length
    if (length % 2 !== 0 && (isText(offset + 1) || !isText(offset))) ++offset
  }
}

const readAiffMarkers = (list, file, { content, bytes }) => {
  if (bytes < 2) return
  const end = content + bytes, stated = file.number(content, 2, true)
  list.stated += stated
  for (let i = 0, offset = content + 2; i < stated && offset + 7 <= end; ++i) {
    const frame = file.number(offset + 2, 4, true), length = file.number(offset + 6, 1, true)
    list.names.set(list.cues.length, textAt(file, offset + 7, Math.min(length, end - offset - 7)))
    list.cues.push({ id: list.cues.length, played: frame, frame })
    offset += 7 + length + (length + 1) % 2
  }
}

const loopsOf = (file, { content, bytes }, isBig, sampleRate) => {
  const found = { markers: [], warnings: [] }
  if (bytes < 36) return found
  const stated = file.number(content + 28, 4, isBig), there = Math.min(stated, Math.floor((bytes - 36) / 24), mostMarkers)
  let broken = stated - there
  for (let i = 0; i < there; ++i) {
    const loop = content + 36 + 24 * i, first = file.number(loop + 8, 4, isBig), last = file.number(loop + 12, 4, isBig)
    if (last < first) {
      ++broken
      continue
    }
    const name = i === 0 ? 'loop' : `loop ${i + 1}`
    found.markers.push({ time: first / sampleRate, name: `${name} start` }, { time: (last + 1) / sampleRate, name: `${name} end` })
  }
  if (broken > 0) found.warnings.push(`has ${broken} loops that are damaged and left out`)
  return found
}

/** Adds markers, `offset` s later, that are not there yet, by their times in ms and names. */
export const addMarkers = (all, found, offset) => {
  const key = (name, ms) => `${ms} ${name}`, there = new Set(all.markers.map(({ time, name }) => key(name, Math.round(time * 1000))))
  const fresh = found.markers.map(({ time, name }) => ({ time: time + offset, name })).filter(({ time, name }) => {
    const ms = Math.round(time * 1000)
    return ![ms - 1, ms, ms + 1].some((one) => there.has(key(name, one)))
  })
  all.markers = [...all.markers, ...fresh].sort((a, b) => a.time - b.time)
  all.warnings.push(...found.warnings)
}

/** The markers among the chunks of the file at `begin`: `{markers, warnings}`. */
export const markersOf = (file, layout, chunks, sampleRate) => {
  const list = { cues: [], names: new Map(), notes: new Map(), stated: 0, regions: 0, uncounted: 0 }
  const loops = { markers: [], warnings: [] }, { isBig, isWave } = layout
  for (const chunk of chunks) {
    if (isWave && file.has(chunk.offset, 'cue ')) readCues(list, file, chunk, isBig)
    else if (isWave && file.has(chunk.offset, 'LIST')) readLabels(list, file, chunk, isBig)
    else if (!isWave && file.has(chunk.offset, 'MARK')) readAiffMarkers(list, file, chunk)
    else if (file.has(chunk.offset, 'smpl')) {
      const { markers, warnings } = loopsOf(file, chunk, layout.id === 'RIFX', sampleRate)
      loops.markers.push(...markers)
      loops.warnings.push(...warnings)
    }
  }
  const { cues, names, notes, stated, uncounted, regions } = list
  // Some programs count the frames only in the order of play.
  const byPlay = cues.every(({ frame }) => frame === 0)
  const found = {
    markers: cues.map(({ id, played, frame }, i) => ({ time: (byPlay ? played : frame) / sampleRate, name: names.get(id) || notes.get(id) || String(i + 1) })),
    warnings: []
  }
  if (cues.length < stated) found.warnings.push(`states ${stated} markers, of which ${cues.length} can be read`)
  if (uncounted > 0) found.warnings.push(`states ${stated - uncounted} markers, but has ${stated}, which are all read`)
  if (regions > 0) found.warnings.push(`has ${regions} regions, whose starts are read as markers, but not how long they last`)
  addMarkers(found, loops, 0)
  return found
}

/** Those that lie within `duration` s, as many as a clip takes, with what is told of the others. */
export const keptMarkers = ({ markers, warnings }, duration) => {
  const kept = [], coder = new TextEncoder()
  let behind = 0, bytes = 0
  for (const marker of markers) {
    const length = coder.encode(marker.name).length
    if (marker.time > duration) ++behind
    else if (kept.length < mostMarkers && bytes + length <= mostBytes) {
      bytes += length
      kept.push(marker)
    }
  }
  const told = [...warnings], left = markers.length - behind - kept.length
  if (behind === 1) told.push('has a marker behind the end of its sound, which is left out')
  else if (behind > 1) told.push(`has ${behind} markers behind the end of its sound, which are left out`)
  if (left > 0) told.push(`has more markers than the ${mostMarkers} or the ${mostBytes} bytes of names that a clip takes; ${left} are left out`)
  return { markers: kept, warnings: told }
}

/** Whether an ID3 tag from one place to another has chapters, which are not read here. */
export const hasChapters = (file, from, until) => {
  const bytes = file.has(from, 'ID3') ? tagBytesAt(file, from) : 0
  return bytes > 0 && file.find('CHAP', from, Math.min(until, from + bytes)) < Math.min(until, from + bytes)
}
