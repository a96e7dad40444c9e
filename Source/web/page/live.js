// The live translator: what the microphone hears, as touch on the sound output.

import { microphone } from './microphone.js'
import { createTranslator } from './pacini/translator.js'

export class Live {
  #control // AbortController, from the wish on
  #changed
  /** Of the translator itself, s; 0 until it runs. */
  latency = 0

  /** `changed()` is called whenever it is switched on, runs, or is switched off, by whomever. */
  constructor(changed) {
    this.#changed = changed
  }

  get isOn() { return this.#control !== undefined }

  async start(profile) {
    this.stop()
    const { signal } = this.#control = new AbortController()
    this.#changed()
    try {
      const stream = await microphone({ echoCancellation: false, noiseSuppression: false, autoGainControl: false }, signal)
      for (const track of stream.getTracks()) track.addEventListener('ended', () => { if (!signal.aborted) this.stop() })
      const context = new AudioContext({ latencyHint: 'interactive' })
      signal.addEventListener('abort', () => context.close(), { once: true })
      const node = await createTranslator(context, { profile })
      signal.throwIfAborted()
      context.createMediaStreamSource(stream).connect(node).connect(context.destination)
      this.latency = node.latency / context.sampleRate
      this.#changed()
    } catch (error) {
      if (signal.aborted) return // switched off before it ran
      this.stop()
      throw error
    }
  }

  stop() {
    if (!this.isOn) return
    this.#control.abort()
    this.#control = undefined
    this.latency = 0
    this.#changed()
  }
}
