// The picture of a clip: the sound, its bands, its events, and what the actuator plays.

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim()

/** Largest and smallest sample of each of `count` stretches. */
const extremes = (samples, count) => {
  const pairs = []
  for (let i = 0; i < count; ++i) {
    const begin = Math.floor((i / count) * samples.length), end = Math.max(begin + 1, Math.floor(((i + 1) / count) * samples.length))
    // At most 200 of each: a picture, not a measurement.
    const step = Math.max(1, Math.floor((end - begin) / 200))
    let low = 0, high = 0
    for (let n = begin; n < end && n < samples.length; n += step) {
      if (samples[n] < low) low = samples[n]
      if (samples[n] > high) high = samples[n]
    }
    pairs.push([low, high])
  }
  return pairs
}

const waveform = (context, samples, box, fill) => {
  context.fillStyle = fill
  const middle = box.y + box.height / 2
  extremes(samples, Math.ceil(box.width)).forEach(([low, high], i) => {
    const top = middle - Math.min(1, high) * box.height / 2, bottom = middle - Math.max(-1, low) * box.height / 2
    context.fillRect(box.x + i, top, 1, Math.max(1, bottom - top))
  })
}

const curve = (context, points, duration, box, fill) => {
  if (points.length === 0) return
  const x = (time) => box.x + (time / duration) * box.width
  const y = (value) => box.y + box.height * (1 - Math.min(1, value))
  context.beginPath()
  context.moveTo(x(points[0].time), box.y + box.height)
  for (const { time, amplitude } of points) context.lineTo(x(time), y(amplitude))
  context.lineTo(x(points.at(-1).time), box.y + box.height)
  context.closePath()
  context.globalAlpha = 0.45
  context.fillStyle = fill
  context.fill()
  context.globalAlpha = 1
  context.strokeStyle = fill
  context.stroke()
}

/** Draws `{clip, mono, drive}` with a playhead at `time`, or none. */
export const draw = (canvas, { clip, mono, drive }, time) => {
  const scale = window.devicePixelRatio || 1
  const width = canvas.clientWidth, height = canvas.clientHeight
  if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
    canvas.width = Math.round(width * scale)
    canvas.height = Math.round(height * scale)
  }
  const context = canvas.getContext('2d')
  context.setTransform(scale, 0, 0, scale, 0, 0)
  context.clearRect(0, 0, width, height)
  const left = 8, right = width - 8
  const box = (from, to) => ({ x: left, y: from * height, width: right - left, height: (to - from) * height })
  const label = (text, at) => {
    context.font = '12px system-ui, sans-serif'
    context.fillStyle = colour('background')
    context.globalAlpha = 0.8
    context.fillRect(at.x, at.y, context.measureText(text).width + 8, 17)
    context.globalAlpha = 1
    context.fillStyle = colour('dim')
    context.fillText(text, at.x + 4, at.y + 13)
  }
  const soundBox = box(0.02, 0.22), bandBox = box(0.25, 0.72), driveBox = box(0.77, 0.97)
  if (mono) waveform(context, mono, soundBox, colour('sound'))
  label('sound', soundBox)
  const bands = clip.bands.length > 0 ? clip.bands : [{ amplitude: clip.envelope }]
  bands.forEach((band, i) => {
    const each = bandBox.height / bands.length
    curve(context, band.amplitude, clip.duration,
      { x: bandBox.x, y: bandBox.y + bandBox.height - (i + 1) * each, width: bandBox.width, height: each * 0.92 }, colour('accent'))
  })
  context.fillStyle = colour('event')
  for (const { time: at, amplitude } of clip.transients) {
    const x = left + (at / clip.duration) * (right - left)
    context.globalAlpha = 0.35 + 0.65 * Math.min(1, amplitude)
    context.fillRect(x - 1, bandBox.y, 2, bandBox.height)
    context.beginPath()
    context.arc(x, bandBox.y, 4, 0, 2 * Math.PI)
    context.fill()
  }
  context.globalAlpha = 1
  label(bands.length === 1 ? '1 band' : `${bands.length} bands, high ones on top`, bandBox)
  if (drive) waveform(context, drive, driveBox, colour('drive'))
  label('what the actuator plays', driveBox)
  if (time !== undefined) {
    context.fillStyle = colour('text')
    context.fillRect(left + (time / clip.duration) * (right - left), 0, 1.5, height)
  }
}
