// The live translator: what the microphone hears, as touch on the sound output.

import { createTranslator } from './pacini/translator.js'

export class Live {
  #context
  #stream
  #node

  get isOn() { return this.#context !== undefined }
  /** Of the translator itself, s. */
  get latency() { return this.isOn ? this.#node.latency / this.#context.sampleRate : 0 }

  async start(profile) {
    this.#stream = await navigator.mediaDevices.getUserMedia({
      audio: { echoCancellation: false, noiseSuppression: false, autoGainControl: false }
    })
    const context = new AudioContext({ latencyHint: 'interactive' })
    try {
      this.#node = await createTranslator(context, { profile })
      context.createMediaStreamSource(this.#stream).connect(this.#node).connect(context.destination)
      this.#context = context
    } catch (error) {
      await context.close()
      this.#stream.getTracks().forEach((track) => track.stop())
      throw error
    }
  }

  async stop() {
    const context = this.#context
    this.#context = undefined
    this.#stream?.getTracks().forEach((track) => track.stop())
    await context?.close()
  }
}
