// The phone: plays what the program at the other end plays, as near to its time as the clocks are known.

import { atSpeed, follow } from './film.js'
import { seconds, t, translate } from './texts.js'
import { touchesOf, vibrateBy } from './vibration.js'

translate()

const element = (id) => document.getElementById(id)
const say = (text) => { element('status').textContent = text }
const canVibrate = typeof navigator.vibrate === 'function'

let touches = [], name = ''
let playing // AbortController
let ready = false
let offset, bestDelay = Infinity // the other end's clock less this one's, ms, and how well it is known

const stop = () => {
  playing?.abort()
  playing = undefined
}
const play = async (now) => {
  stop()
  const own = playing = new AbortController()
  await vibrateBy(now, touches, own.signal)
  if (playing === own) playing = undefined
}

const stateNow = () => !canVibrate ? 'cannot' : ready ? 'feels' : 'waits'
let ping = () => {} // asks for the time at the other end, and says whether this phone feels
let lost = 0 // tries since the connection was there

const connect = () => {
  const socket = new WebSocket(`ws://${location.host}/events`)
  let timer
  ping = () => { if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ ping: performance.now(), state: stateNow() })) }
  socket.onopen = () => {
    lost = 0
    bestDelay = Infinity
    say(!canVibrate ? t('Connected, but this browser cannot vibrate: those of iPhones and Firefox cannot. Chrome on Android can.')
      : ready ? t('Connected again. Feels what is played.') : t('Connected. Touch the button once; browsers vibrate only then.'))
    for (let i = 0; i < 5; ++i) setTimeout(ping, 100 * i)
    timer = setInterval(ping, 5000)
  }
  let goodbye
  socket.onclose = () => {
    clearInterval(timer)
    stop()
    if (goodbye) return say(goodbye)
    ++lost
    element('others').hidden = true
    say(lost < 2 ? t('The connection is lost. Trying again...')
      : t('The session has ended, or the network is away. Trying again... Scan the new code for another session.'))
    if (lost < 60) setTimeout(connect, Math.min(1000 * 2 ** Math.min(lost - 1, 4), 15000))
  }
  socket.onmessage = ({ data }) => {
    const message = JSON.parse(data)
    if (message.kind === 'pong') {
      const now = performance.now(), delay = now - message.ping
      // The quickest answer knows best; a little forgetful, since clocks drift.
      if (delay <= bestDelay) {
        bestDelay = delay
        offset = message.now - (now + message.ping) / 2
      }
      bestDelay += 0.5
    } else if (message.kind === 'clip') {
      stop()
      touches = touchesOf(message.touches)
      name = message.name || 'clip'
      const { duration, longest, leftOut } = message
      element('clip').textContent = [t('{0}, {1} s', name, seconds(duration)), ...(duration > longest ? [t('The first hour is felt.')] : []),
        ...(leftOut === 0 ? [] : leftOut === 1 ? [t('{0} event is left out: it comes too soon after another for a phone.', leftOut)]
          : [t('{0} events are left out: they come too soon after others for a phone.', leftOut)])].join('. ').replaceAll('..', '.')
      element('alone').disabled = !canVibrate
      if (message.film && !film.src) {
        film.src = '/film'
        film.hidden = false
      }
    } else if (message.kind === 'play' && ready && canVibrate) {
      // At `at` of the other end's clock, `from` s of the clip were played there.
      const began = message.at - (offset ?? message.now - performance.now()) - 1000 * message.from
      play(() => (performance.now() - began) / 1000)
    } else if (message.kind === 'code') {
      // On the machine that plays, for others to scan; the program says it whenever there is another one.
      element('code').src = `/code.svg?${message.number}`
      element('others').hidden = false
    } else if (message.kind === 'stop') stop()
    else if (message.kind === 'full') goodbye = t('{0} phones are connected already. Load this page again when one of them has left.', message.most)
  }
}

// A film that is shown here leads, and nothing else is played then.
const film = element('film')
follow(film, ({ now, speed }, signal) => {
  stop()
  if (canVibrate) vibrateBy(() => now() / speed, atSpeed(touches, speed), signal)
})

element('ready').addEventListener('click', () => {
  ready = !ready
  element('ready').setAttribute('aria-pressed', String(ready))
  if (!ready) stop()
  ping()
  if (canVibrate) {
    navigator.vibrate(30)
    say(ready ? t('Feels what is played.') : t('Feels nothing until you touch the button again.'))
  }
})
element('ready').setAttribute('aria-pressed', 'false')
element('ready').disabled = !canVibrate
element('alone').addEventListener('click', () => {
  const started = performance.now()
  play(() => (performance.now() - started) / 1000)
})
connect()
