// The first part of a long clip, for what would take long of all of it.

const between = (a, b, time) => {
  const share = (time - a.time) / (b.time - a.time)
  return Object.fromEntries(Object.keys(a).map((key) => [key, key === 'time' ? time : a[key] + share * (b[key] - a[key])]))
}

const cut = (value, end, isCurve = false) => {
  if (!value || typeof value !== 'object') return value
  if (!Array.isArray(value)) return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, cut(one, end, key !== 'transients' && key !== 'markers')]))
  const next = value.findIndex(({ time }) => time > end)
  if (next < 0) return value.map((one) => cut(one, end))
  return [...value.slice(0, next), ...(isCurve && next > 0 && value[next - 1].time < end ? [between(value[next - 1], value[next], end)] : [])]
}

/** A clip until `end` s; itself where it is no longer. */
export const firstPart = (clip, end) => clip.duration <= end ? clip : { ...cut(clip, end), duration: end }
