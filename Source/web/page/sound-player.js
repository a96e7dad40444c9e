// Two signals, left and right, by Web Audio.

let context

/** How many channels the sound device has. */
export const channelCount = () => {
  context ??= new AudioContext()
  return Math.max(2, context.destination.maxChannelCount)
}

/**
 * Plays from `from` s until they end or `signal` stops them, the second on `channel`, 1 being the right one; `moved(time)` is
 * called for every picture.
 */
export const playPair = async (left, right, { from = 0, signal, moved, channel: touch = 1 }) => {
  const channels = channelCount()
  await context.resume()
  if (signal.aborted) return
  if (touch > 1) {
    context.destination.channelCount = channels
    context.destination.channelInterpretation = 'discrete'
  }
  const merger = new ChannelMergerNode(context, { numberOfInputs: Math.max(2, touch + 1) })
  merger.connect(context.destination)
  const sources = [left, right].map(({ samples, sampleRate }, i) => {
    const buffer = new AudioBuffer({ length: Math.max(1, samples.length), sampleRate })
    buffer.copyToChannel(samples, 0)
    const source = new AudioBufferSourceNode(context, { buffer })
    source.connect(merger, 0, i === 0 ? 0 : touch)
    return source
  })
  const start = context.currentTime + 0.05
  for (const source of sources) source.start(start, Math.min(from, source.buffer.duration))
  signal.addEventListener('abort', () => sources.forEach((source) => source.stop()), { once: true })
  const end = Math.max(...sources.map(({ buffer }) => buffer.duration))
  await new Promise((resolve) => {
    const tick = () => {
      const time = from + context.currentTime - start
      if (signal.aborted || time > end) return resolve()
      moved(Math.max(from, time))
      requestAnimationFrame(tick)
    }
    tick()
  })
  merger.disconnect()
}
