// Changes of a clip's points and events: each gives a new clip, leaves the old one as it is, and says what was done as an
// edit of a project file, which reapply() of the package takes to another analysis.

import { number, t } from './text.js'

const shortest = 0.001 // s between two points
const clamp = (value, low, high) => Math.min(high, Math.max(low, value))
const rounded = (value) => Math.round(value * 1e6) / 1e6

/** The lanes of a clip: its events, its total, its bands. */
export const lanesOf = (clip) => [
  { key: 'events', title: t('Events ({0})', clip.transients.length) },
  ...(clip.envelope.length > 0 ? [{ key: 'total', title: t('Total amplitude') }] : []),
  ...clip.bands.map((band, i) => ({ key: i, title: t('Band {0}: {1} Hz', i + 1, number(band.centreFrequency, 0)) }))
]

/** The points of a lane: `{time, amplitude}`, events also with `sharpness`. */
export const pointsOf = (clip, lane) => lane === 'events' ? clip.transients
  : lane === 'total' ? clip.envelope : clip.bands[lane]?.amplitude ?? []

const withPoints = (clip, lane, points) => {
  if (lane === 'events') return { ...clip, transients: points }
  if (lane === 'total') return { ...clip, envelope: points }
  return { ...clip, bands: clip.bands.map((band, i) => i === lane ? { ...band, amplitude: points } : band) }
}

/** The edit that gives a lane of `clip` the points of `edited` from one time to another. */
const pointsEdit = (clip, edited, lane, from, to) => ({
  kind: 'points', ...(lane === 'total' ? { lane: 'envelope' } : { lane: 'amplitude', band: lane }), from, to,
  points: pointsOf(edited, lane).filter(({ time }) => time >= from && time <= to).map(({ time, amplitude }) => ({ time, value: amplitude })),
  frequencies: [{ frequency: lane === 'total' ? 0 : clip.bands[lane].centreFrequency }], clipDuration: clip.duration
})
const eventEdit = (clip, before, after) => ({ kind: 'transient', before, after, frequencies: [], clipDuration: clip.duration })

const isSame = (a, b) => a.time === b.time && a.amplitude === b.amplitude && a.sharpness === b.sharpness

/** A list of edits and one more: what changes the same points or the same event again takes the last one's place. */
export const withEdit = (edits, edit) => {
  const last = edits.at(-1), others = edits.slice(0, -1)
  if (last?.kind === 'points' && ['kind', 'lane', 'band', 'from', 'to'].every((key) => last[key] === edit[key])) return [...others, edit]
  if (last?.kind === 'transient' && edit.kind === 'transient' && last.after && edit.before && isSame(last.after, edit.before))
    return last.before || edit.after ? [...others, { ...edit, before: last.before }] : others
  return [...edits, edit]
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
  const points = pointsOf(clip, lane), old = points[index]
  const point = {
    ...old,
    time: rounded(placeOf(clip, lane, index, time ?? old.time)),
    amplitude: rounded(clamp(amplitude ?? old.amplitude, 0, 1)),
    ...(sharpness === undefined || lane !== 'events' ? {} : { sharpness: rounded(clamp(sharpness, 0, 1)) })
  }
  const moved = points.with(index, point)
  if (lane === 'events') moved.sort((a, b) => a.time - b.time)
  const edited = withPoints(clip, lane, moved)
  return {
    clip: edited, index: moved.indexOf(point),
    edit: lane === 'events' ? eventEdit(clip, old, point)
      : pointsEdit(clip, edited, lane, (points[index - 1] ?? old).time, (points[index + 1] ?? old).time)
  }
}

/** With one point more; nothing where another one is as good as there. */
export const addPoint = (clip, lane, { time, amplitude, sharpness = 0.5 }) => {
  const points = pointsOf(clip, lane)
  const at = rounded(clamp(time, 0, clip.duration))
  if (points.some((point) => Math.abs(point.time - at) < shortest)) return undefined
  const point = {
    time: at, amplitude: rounded(clamp(amplitude, 0, 1)),
    ...(lane === 'events' ? { sharpness: rounded(clamp(sharpness, 0, 1)) } : {})
  }
  const more = [...points, point].sort((a, b) => a.time - b.time), index = more.indexOf(point)
  const edited = withPoints(clip, lane, more)
  return {
    clip: edited, index,
    edit: lane === 'events' ? eventEdit(clip, undefined, point)
      : pointsEdit(clip, edited, lane, (more[index - 1] ?? point).time, (more[index + 1] ?? point).time)
  }
}

/** Without a point; nothing where a curve would lose its end. */
export const removePoint = (clip, lane, index) => {
  const points = pointsOf(clip, lane)
  if (lane !== 'events' && (index === 0 || index === points.length - 1)) return undefined
  const edited = withPoints(clip, lane, points.toSpliced(index, 1))
  return {
    clip: edited, index: Math.max(0, Math.min(index, points.length - 2)),
    edit: lane === 'events' ? eventEdit(clip, points[index], undefined)
      : pointsEdit(clip, edited, lane, points[index - 1].time, points[index + 1].time)
  }
}
