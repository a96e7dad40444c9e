// The picture of a clip: the sound, the lane that is edited, its bands, its events, and what the actuator plays.

import { valueAt } from './curve.js'
import { counted, number, t } from './text.js'
import { pointsOf } from './edits.js'

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()
const left = 8 // pixels at both sides
const parts = { sound: [0.01, 0.17], edited: [0.205, 0.45], bands: [0.47, 0.79], drive: [0.815, 0.985] }

export class Lanes {
  #canvas
  #colours = {}
  /** What is shown, s. */
  range = { from: 0, to: 1 }
  /** The amplitude at the top of the edited lane: bands are much weaker than their sum. */
  top = 1

  constructor(canvas) {
    this.#canvas = canvas
  }

  get #width() { return this.#canvas.clientWidth - 2 * left }
  timeAt(x) { return this.range.from + (x - left) / this.#width * (this.range.to - this.range.from) }
  xAt(time) { return left + (time - this.range.from) / (this.range.to - this.range.from) * this.#width }
  #box(part) {
    const [from, to] = parts[part], height = this.#canvas.clientHeight
    return { x: left, y: from * height, width: this.#width, height: (to - from) * height }
  }
  amplitudeAt(y) {
    const { y: top, height } = this.#box('edited')
    return this.top * (1 - (y - top) / height)
  }
  #heightOf(amplitude) { return 1 - Math.min(1, amplitude / this.top) }

  /** Chooses the top for a lane; not while a point of it is dragged. */
  fit(clip, lane) {
    const most = pointsOf(clip, lane).reduce((largest, { amplitude }) => Math.max(largest, amplitude), 0)
    this.top = typeof lane === 'number' ? [0.01, 0.02, 0.05, 0.1, 0.2, 0.5].find((one) => one >= 1.1 * most) ?? 1 : 1
  }

  /** All of a clip. */
  showAll(duration) { this.range = { from: 0, to: Math.max(duration, 0.01) } }

  /** Nearer or farther about a time, which stays where it is. */
  zoom(factor, time, duration) {
    const length = Math.min(Math.max((this.range.to - this.range.from) * factor, 0.02), Math.max(duration, 0.02))
    const share = (time - this.range.from) / (this.range.to - this.range.from)
    this.scrollTo(time - share * length, duration, length)
  }
  scrollTo(from, duration, length = this.range.to - this.range.from) {
    const begin = Math.max(0, Math.min(from, duration - length))
    this.range = { from: begin, to: begin + length }
  }

  /** What is at a place of the canvas: a point of the edited lane, a band, or nothing; `near` in pixels. */
  hit(x, y, { clip, lane }, near = 10) {
    const edited = this.#box('edited'), bands = this.#box('bands')
    if (y >= edited.y - near && y <= edited.y + edited.height + near) {
      let best, distance = near
      pointsOf(clip, lane).forEach((point, index) => {
        const away = Math.hypot(this.xAt(point.time) - x, edited.y + this.#heightOf(point.amplitude) * edited.height - y)
        if (away <= distance) [best, distance] = [index, away]
      })
      return { part: 'edited', index: best }
    }
    if (y > bands.y && y < bands.y + bands.height && clip.bands.length > 0)
      return { part: 'band', band: clip.bands.length - 1 - Math.min(clip.bands.length - 1, Math.floor((y - bands.y) / bands.height * clip.bands.length)) }
    return { part: y < edited.y ? 'sound' : 'drive' }
  }

  /** Draws `{clip, lane, selected, sound, drive, picture}` (peaks, a canvas of a spectrogram) with a playhead at `time`. */
  draw({ clip, lane, selected, sound, drive, picture, soundRate, driveRate }, time) {
    const canvas = this.#canvas, scale = window.devicePixelRatio || 1
    const width = canvas.clientWidth, height = canvas.clientHeight
    if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
      canvas.width = Math.round(width * scale)
      canvas.height = Math.round(height * scale)
    }
    for (const name of ['background', 'line', 'text', 'dim', 'accent', 'sound', 'event', 'drive']) this.#colours[name] = colour(name)
    const context = canvas.getContext('2d')
    context.setTransform(scale, 0, 0, scale, 0, 0)
    context.clearRect(0, 0, width, height)
    const soundBox = this.#box('sound'), edited = this.#box('edited'), bandBox = this.#box('bands'), driveBox = this.#box('drive')
    if (picture) this.#picture(context, picture, soundBox)
    else if (sound) this.#wave(context, sound, soundRate, soundBox, this.#colours.sound)
    context.strokeStyle = this.#colours.line
    context.strokeRect(edited.x, edited.y, edited.width, edited.height)
    context.save()
    context.beginPath()
    context.rect(left - 6, 0, this.#width + 12, height)
    context.clip()
    if (lane !== 'events') {
      this.#curve(context, pointsOf(clip, lane), edited, this.#colours.accent, this.top)
      this.#events(context, clip, edited, 0.35)
    } else {
      this.#curve(context, clip.envelope, edited, this.#colours.line, 1)
      this.#events(context, clip, edited, 1)
    }
    this.#handles(context, pointsOf(clip, lane), selected, edited, this.#colours[lane === 'events' ? 'event' : 'accent'])
    const loudest = clip.bands.reduce((most, { amplitude }) => amplitude.reduce((m, point) => Math.max(m, point.amplitude), most), 1e-3)
    const each = bandBox.height / Math.max(1, clip.bands.length)
    clip.bands.forEach((band, i) => this.#heat(context, band.amplitude,
      { x: left, y: bandBox.y + bandBox.height - (i + 1) * each, width: this.#width, height: each }, loudest, i === lane))
    if (drive) this.#wave(context, drive, driveRate, driveBox, this.#colours.drive)
    if (time !== undefined) {
      context.fillStyle = this.#colours.text
      context.fillRect(this.xAt(time), 0, 1.5, height)
    }
    context.restore()
    this.#label(context, picture ? t('sound, 20 Hz to 2 kHz') : sound ? t('sound') : t('no sound with this clip'), soundBox)
    this.#label(context, lane === 'events' ? t('events, 0 to {0}', this.top) : lane === 'total' ? t('total amplitude, 0 to {0}', this.top)
      : t('band {0}, 0 to {1}', lane + 1, this.top), edited)
    this.#label(context, this.#bandsText(clip.bands), bandBox)
    this.#label(context, t('what the actuator plays'), driveBox)
    this.#times(context, clip.duration)
  }

  #label(context, text, at) {
    context.font = '12px system-ui, sans-serif'
    context.fillStyle = this.#colours.background
    context.globalAlpha = 0.8
    context.fillRect(at.x, at.y, context.measureText(text).width + 8, 17)
    context.globalAlpha = 1
    context.fillStyle = this.#colours.dim
    context.fillText(text, at.x + 4, at.y + 13)
  }

  /** Seconds, above the edited lane. */
  #times(context, duration) {
    const { y } = this.#box('edited')
    const length = this.range.to - this.range.from
    const step = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60, 120, 300, 600]
      .find((one) => one * this.#width / length > 70) ?? 1200
    context.fillStyle = this.#colours.dim
    context.font = '11px system-ui, sans-serif'
    for (let i = Math.ceil(this.range.from / step); i * step <= Math.min(this.range.to, duration); ++i) {
      const x = this.xAt(i * step)
      context.fillRect(x, y - 4, 1, 4)
      const text = `${number(+(i * step).toFixed(3))} s`, size = context.measureText(text).width
      context.fillText(text, Math.min(x + 3, left + this.#width - size), y - 3)
    }
  }

  #wave(context, peaks, rate, box, fill) {
    context.fillStyle = fill
    const middle = box.y + box.height / 2, columns = Math.ceil(box.width)
    const first = this.range.from * rate, per = (this.range.to - this.range.from) * rate / columns
    for (let i = 0; i < columns; ++i) {
      const begin = first + i * per
      if (begin >= peaks.length) break
      const [low, high] = peaks.between(begin, begin + per)
      const top = middle - Math.min(1, high) * box.height / 2, bottom = middle - Math.max(-1, low) * box.height / 2
      context.fillRect(box.x + i, top, 1, Math.max(1, bottom - top))
    }
  }

  #picture(context, { canvas, from, to }, box) {
    const begin = this.xAt(from), end = this.xAt(to)
    context.save()
    context.beginPath()
    context.rect(box.x, box.y, box.width, box.height)
    context.clip()
    context.drawImage(canvas, begin, box.y, end - begin, box.height)
    context.restore()
  }

  /** Filled, `top` being the amplitude at the top of the box. */
  #curve(context, points, box, fill, top) {
    if (points.length === 0) return
    const { from, to } = this.range
    const y = (value) => box.y + box.height * (1 - Math.min(1, value / top))
    const begin = Math.max(from, points[0].time), end = Math.min(to, points.at(-1).time)
    if (end < begin) return
    context.beginPath()
    context.moveTo(this.xAt(begin), y(0))
    context.lineTo(this.xAt(begin), y(valueAt(points, begin)))
    for (const { time, amplitude } of points) if (time > begin && time < end) context.lineTo(this.xAt(time), y(amplitude))
    context.lineTo(this.xAt(end), y(valueAt(points, end)))
    context.lineTo(this.xAt(end), y(0))
    context.closePath()
    context.globalAlpha = 0.45
    context.fillStyle = fill
    context.fill()
    context.globalAlpha = 1
    context.strokeStyle = fill
    context.stroke()
  }

  /** A band as a row, the brighter the stronger: 48 dB below the loudest is dark. */
  #heat(context, points, box, loudest, isEdited) {
    context.fillStyle = this.#colours.accent
    const end = points.at(-1)?.time ?? 0
    for (let x = Math.max(0, this.xAt(0) - box.x); x < box.width; x += 2) {
      const time = this.timeAt(box.x + x + 1)
      if (time > end) break
      const amplitude = points.length > 0 && time >= points[0].time ? valueAt(points, time) : 0
      const level = 1 + 20 * Math.log10(Math.max(amplitude, 1e-9) / loudest) / 48
      if (level <= 0) continue
      context.globalAlpha = Math.min(1, level) ** 1.5
      context.fillRect(box.x + x, box.y, 2, box.height - 1)
    }
    context.globalAlpha = 1
    if (!isEdited) return
    context.strokeStyle = this.#colours.text
    context.strokeRect(box.x, box.y - 0.5, box.width, box.height)
  }

  /** How many bands there are and where they lie, such as "12 bands, 30 to 1000 Hz from below". */
  #bandsText(bands) {
    const edges = bands.flatMap(({ lowFrequency, highFrequency }) => [lowFrequency, highFrequency]).filter(Number.isFinite)
    return bands.length < 2 || edges.length === 0 ? counted(bands.length, '{0} band', '{0} bands')
      : t('{0} bands, {1} to {2} Hz from below', bands.length, `${Math.round(Math.min(...edges))}`, `${Math.round(Math.max(...edges))}`)
  }

  #events(context, clip, box, opacity) {
    context.fillStyle = this.#colours.event
    for (const { time, amplitude } of clip.transients) {
      if (time < this.range.from || time > this.range.to) continue
      context.globalAlpha = opacity * (0.4 + 0.6 * Math.min(1, amplitude))
      const top = box.y + box.height * (1 - Math.min(1, amplitude))
      context.fillRect(this.xAt(time) - 1, top, 2, box.y + box.height - top)
    }
    context.globalAlpha = 1
  }

  /** Points that can be taken hold of, where they are far enough apart to be seen. */
  #handles(context, points, selected, box, fill) {
    const visible = points.filter(({ time }) => time >= this.range.from && time <= this.range.to).length
    const many = visible > this.#width / 6
    points.forEach(({ time, amplitude }, index) => {
      if (time < this.range.from || time > this.range.to || (many && index !== selected)) return
      const x = this.xAt(time), y = box.y + box.height * this.#heightOf(amplitude)
      context.beginPath()
      context.arc(x, y, index === selected ? 7 : 3.5, 0, 2 * Math.PI)
      context.fillStyle = index === selected ? this.#colours.text : fill
      context.fill()
      if (index !== selected) return
      context.strokeStyle = this.#colours.background
      context.lineWidth = 2
      context.stroke()
      context.lineWidth = 1
    })
  }
}
