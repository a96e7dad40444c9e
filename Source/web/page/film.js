// Touch in time with a film: a <video> or <audio> element.

const changes = ['play', 'playing', 'pause', 'waiting', 'stalled', 'seeking', 'seeked', 'ratechange', 'ended', 'emptied']

/**
 * Calls `begin(clock, signal)` whenever `media` goes on, and stops it by `signal` when it pauses, waits, is sought in or changes
 * its speed. `clock` has `now()`, s of the film by its own clock, and `speed`, film s per s. Returns a function that ends this.
 */
export const follow = (media, begin) => {
  let playing // AbortController
  const stop = () => {
    playing?.abort()
    playing = undefined
  }
  const look = ({ type }) => {
    const goes = !media.paused && !media.seeking && !media.ended && media.playbackRate > 0
    // Stalled is the network; what has come plays on.
    if (type === 'stalled' || (type === 'playing' && playing)) return
    stop()
    if (!goes || type === 'waiting' || media.readyState < 3) return
    playing = new AbortController()
    begin({ now: () => media.currentTime, speed: media.playbackRate }, playing.signal)
  }
  for (const change of changes) media.addEventListener(change, look)
  return () => {
    for (const change of changes) media.removeEventListener(change, look)
    stop()
  }
}

/** Times of `touches` by a clock that goes at `speed`, s. */
export const atSpeed = (touches, speed) => speed === 1 ? touches : touches.map(({ start, end }) => ({ start: start / speed, end: end / speed }))
