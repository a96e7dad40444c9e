// Two signals, left and right, by Web Audio, in parts: a long one needs the memory of a part.

let context

/** How many channels the sound device has. */
export const channelCount = () => {
  context ??= new AudioContext()
  return Math.max(2, context.destination.maxChannelCount)
}

const partLength = 20 // s

/** A signal whose samples are at hand, as playPair() takes it. */
export const wholeSignal = (samples, sampleRate) => ({ sampleRate, frames: samples.length, read: (from, count) => samples.subarray(from, from + count) })

/** Calls `work(part)` for each part of a signal from `from` s on: its buffer, and when it begins after the first one, s. */
const eachPart = async ({ sampleRate, frames, read }, from, signal, work) => {
  const step = Math.round(partLength * sampleRate)
  for (let at = Math.round(from * sampleRate), begins = 0; at < frames && !signal.aborted; at += step, begins += step / sampleRate) {
    const samples = await read(at, Math.min(step, frames - at))
    const buffer = new AudioBuffer({ length: Math.max(1, samples.length), sampleRate })
    buffer.copyToChannel(samples, 0)
    if (!signal.aborted) await work(buffer, begins)
  }
}

/** A clock by `coarse`, s, which moves in steps of a buffer: the page's own clock between, put right when they differ by 40 ms. */
const smoothClock = (coarse) => {
  let anchor = performance.now() / 1000 - coarse()
  return () => {
    const now = performance.now() / 1000
    if (Math.abs(now - anchor - coarse()) > 0.04) anchor = now - coarse()
    return now - anchor
  }
}

/**
 * Plays from `from` s until they end or `signal` stops them, the second on `channel`, 1 being the right one. A signal is
 * `{sampleRate, frames, read(from, count)}`; a signal given twice is read once. `moved(time)` is called for every picture, and
 * `started(clock)` when it begins: `now()`, s of the signal as it is heard, and its `speed`.
 */
export const playPair = async (left, right, { from = 0, signal, moved = () => {}, started = () => {}, channel: touch = 1 }) => {
  const channels = channelCount()
  await context.resume()
  if (signal.aborted) return
  if (touch > 1) {
    context.destination.channelCount = channels
    context.destination.channelInterpretation = 'discrete'
  }
  const merger = new ChannelMergerNode(context, { numberOfInputs: Math.max(2, touch + 1) })
  merger.connect(context.destination)
  const pair = left === right ? [[left, [0, touch]]] : [[left, [0]], [right, [touch]]]
  let start // of the first parts, which begin together
  const sources = new Set()
  signal.addEventListener('abort', () => sources.forEach((source) => source.stop()), { once: true })
  const rested = (until) => new Promise((resolve) => {
    const timer = setTimeout(resolve, 1000 * Math.max(0, until - context.currentTime))
    signal.addEventListener('abort', () => { clearTimeout(timer); resolve() }, { once: true })
  })
  const begin = (buffer, outputs, at) => {
    const source = new AudioBufferSourceNode(context, { buffer })
    for (const output of outputs) source.connect(merger, 0, output)
    source.start(at)
    sources.add(source)
    source.onended = () => sources.delete(source)
  }
  // The first parts of both are there before either sounds.
  const firsts = []
  let ready
  const both = new Promise((resolve) => { ready = resolve })
  const playing = pair.map(([part, outputs]) => {
    let isFirst = true
    const first = () => {
      if (!isFirst) return
      isFirst = false
      if (firsts.push(part) === pair.length) ready()
    }
    return eachPart(part, from, signal, async (buffer, begins) => {
      first()
      await both
      start ??= context.currentTime + 0.05
      begin(buffer, outputs, start + begins)
      await rested(start + begins + partLength / 2) // the next part is read while this one sounds
    }).finally(first)
  })
  await Promise.race([both, ...playing.map((one) => one.then(() => both))])
  if (signal.aborted) return merger.disconnect()
  start ??= context.currentTime + 0.05
  started({ now: smoothClock(() => from + context.currentTime - start - (context.outputLatency || 0)), speed: 1 })
  const end = Math.max(...pair.map(([{ frames, sampleRate }]) => frames / sampleRate))
  await new Promise((resolve) => {
    const tick = () => {
      const time = from + context.currentTime - start
      if (signal.aborted || time > end) return resolve()
      moved(Math.max(from, time))
      requestAnimationFrame(tick)
    }
    tick()
  })
  await Promise.all(playing)
  merger.disconnect()
}
