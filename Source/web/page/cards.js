// Example cards: each is opened, heard or felt where it stands.

import { describeFeel, feelsNow, prepareFeel } from './feel.js'
import { playPair, wholeSignal } from './sound-player.js'
import { t } from './text.js'
import { heldMono, soundOf } from './sounds.js'

/**
 * `cards`: elements with the buttons open, play and feel. `bytesOf(file)` loads a sound, `open(file)` opens it, `playThat(work)`
 * plays until it ends or `stop()`, `call` calls the core, `drive()` gives options of rendering, `say(text)` reads aloud.
 */
export const startCards = ({ cards, bytesOf, open, playThat, stop, call, drive, say, complain }) => {
  const loaded = new Map() // promises of {sound, signal, clip} by files
  const load = (file) => {
    if (!loaded.has(file)) {
      const loading = (async () => {
        const sound = await soundOf(new Blob([await bytesOf(file)]), file)
        return { sound, signal: wholeSignal(await heldMono(sound), sound.sampleRate) }
      })()
      loaded.set(file, loading)
      loading.catch(() => loaded.delete(file))
    }
    return loaded.get(file)
  }
  const clipOf = async (file) => {
    const example = await load(file)
    return example.clip ??= call('encode', { blob: example.sound.blob }, { name: file.replace(/\.[^.]+$/, ''), source: file })
  }

  let pressed // the button that plays
  const release = () => {
    pressed?.setAttribute('aria-pressed', 'false')
    pressed = undefined
  }
  const toggle = (button, work) => button.addEventListener('click', async () => {
    const again = pressed === button
    stop()
    release()
    if (again) return
    pressed = button
    button.setAttribute('aria-pressed', 'true')
    try {
      await playThat(async (how) => {
        await work(how)
        return false // once, also when Loop is on
      })
    } catch (error) {
      complain(error)
    } finally {
      if (pressed === button) release()
    }
  })
  for (const card of cards) {
    const { file } = card.dataset, name = card.querySelector('strong').textContent
    card.querySelector('.open').addEventListener('click', () => {
      stop()
      open(file)
    })
    const play = card.querySelector('.play'), feeler = card.querySelector('.feel')
    for (const button of [play, feeler]) button.setAttribute('aria-pressed', 'false')
    toggle(play, async (how) => {
      const { signal } = await load(file)
      say(t('{0}: the sound.', name))
      await playPair(signal, signal, { ...how, from: 0 })
    })
    toggle(feeler, async (how) => {
      const clip = await clipOf(file), { signal } = await load(file)
      if (feelsNow()) {
        say(t('{0}: sound and haptics together. {1}', name, describeFeel()))
        const touch = await prepareFeel(clip, call)
        let feeling
        await playPair(signal, signal, { ...how, from: 0, started: (clock) => { feeling = touch(how.signal, clock) } })
        await feeling
        return
      }
      say(t('{0}: you hear the haptics, as nothing to feel with is connected. {1}', name, describeFeel()))
      const { samples } = await call('render', clip, { ...drive(), sampleRate: 48000 })
      const driven = wholeSignal(samples, 48000)
      await playPair(driven, driven, { ...how, from: 0 })
    })
  }
}
