// Curves of breakpoints.

/** What a curve is at a time. */
export const valueAt = (points, time) => {
  if (points.length === 0) return 0
  let low = 0, high = points.length // the first point behind `time`
  while (low < high) {
    const middle = (low + high) >> 1
    if (points[middle].time > time) high = middle
    else low = middle + 1
  }
  if (low === 0) return points[0].amplitude
  if (low === points.length) return points.at(-1).amplitude
  const a = points[low - 1], b = points[low]
  return a.amplitude + (b.amplitude - a.amplitude) * (time - a.time) / (b.time - a.time)
}
