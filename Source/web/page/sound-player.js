// Two signals, left and right, by Web Audio.

let context

/** Plays from `from` s until they end or `signal` stops them; `moved(time)` is called for every picture. */
export const playPair = async (left, right, { from = 0, signal, moved }) => {
  context ??= new AudioContext()
  await context.resume()
  if (signal.aborted) return
  const merger = new ChannelMergerNode(context, { numberOfInputs: 2 })
  merger.connect(context.destination)
  const sources = [left, right].map(({ samples, sampleRate }, channel) => {
    const buffer = new AudioBuffer({ length: Math.max(1, samples.length), sampleRate })
    buffer.copyToChannel(samples, 0)
    const source = new AudioBufferSourceNode(context, { buffer })
    source.connect(merger, 0, channel)
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
