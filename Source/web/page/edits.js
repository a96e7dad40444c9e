// Changes of a clip's points and events: each gives a new clip and leaves the old one as it is.

const shortest = 0.001 // s between two points
const clamp = (value, low, high) => Math.min(high, Math.max(low, value))
const rounded = (value) => Math.round(value * 1e6) / 1e6

/** The lanes of a clip: its events, its total, its bands. */
export const lanesOf = (clip) => [
  { key: 'events', title: `Events (${clip.transients.length})` },
  ...(clip.envelope.length > 0 ? [{ key: 'total', title: 'Total amplitude' }] : []),
  ...clip.bands.map((band, i) => ({ key: i, title: `Band ${i + 1}: ${Math.round(band.centreFrequency)} Hz` }))
]

/** The points of a lane: `{time, amplitude}`, events also with `sharpness`. */
export const pointsOf = (clip, lane) => lane === 'events' ? clip.transients
  : lane === 'total' ? clip.envelope : clip.bands[lane]?.amplitude ?? []

const withPoints = (clip, lane, points) => {
  if (lane === 'events') return { ...clip, transients: points }
  if (lane === 'total') return { ...clip, envelope: points }
  return { ...clip, bands: clip.bands.map((band, i) => i === lane ? { ...band, amplitude: points } : band) }
}

/** Where a point may be: between its neighbours, an event anywhere. The ends of curves stay where they are. */
const placeOf = (clip, lane, index, time) => {
  if (lane === 'events') return clamp(time, 0, clip.duration)
  const points = pointsOf(clip, lane)
  if (index === 0 || index === points.length - 1) return points[index].time
  return clamp(time, points[index - 1].time + shortest, points[index + 1].time - shortest)
}

/** With a point elsewhere, and where it stands in its lane then: events change places when they pass each other. */
export const movePoint = (clip, lane, index, { time, amplitude, sharpness }) => {
  const old = pointsOf(clip, lane)[index]
  const point = {
    ...old,
    time: rounded(placeOf(clip, lane, index, time ?? old.time)),
    amplitude: rounded(clamp(amplitude ?? old.amplitude, 0, 1)),
    ...(sharpness === undefined || lane !== 'events' ? {} : { sharpness: rounded(clamp(sharpness, 0, 1)) })
  }
  const points = pointsOf(clip, lane).map((other, i) => i === index ? point : other)
  if (lane === 'events') points.sort((a, b) => a.time - b.time)
  return { clip: withPoints(clip, lane, points), index: points.indexOf(point) }
}

/** With one point more; nothing where another one is as good as there. */
export const addPoint = (clip, lane, { time, amplitude, sharpness = 0.5 }) => {
  const points = pointsOf(clip, lane)
  const at = clamp(time, 0, clip.duration)
  if (points.some((point) => Math.abs(point.time - at) < shortest)) return undefined
  const point = {
    time: rounded(at), amplitude: rounded(clamp(amplitude, 0, 1)),
    ...(lane === 'events' ? { sharpness: rounded(clamp(sharpness, 0, 1)) } : {})
  }
  const more = [...points, point].sort((a, b) => a.time - b.time)
  return { clip: withPoints(clip, lane, more), index: more.indexOf(point) }
}

/** Without a point; nothing where a curve would lose its end. */
export const removePoint = (clip, lane, index) => {
  const points = pointsOf(clip, lane)
  if (lane !== 'events' && (index === 0 || index === points.length - 1)) return undefined
  return { clip: withPoints(clip, lane, points.filter((_, i) => i !== index)), index: Math.max(0, Math.min(index, points.length - 2)) }
}
