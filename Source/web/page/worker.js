// Encoding, rendering and formats, beside the page's own thread. One request after another, each with its number.

import { compare, defaults, encode, exportParameters, felt, formats, profileInfo, read, reapply, render, reports, rumble, spectrogram, touch, write } from './pacini/index.js'

const calls = { compare, defaults, encode, exportParameters, felt, formats, profileInfo, read, reapply, render, reports, rumble, spectrogram, touch, write }

self.onmessage = async ({ data: { number, name, parameters } }) => {
  try {
    const result = await calls[name](...parameters)
    self.postMessage({ number, result })
  } catch (error) {
    self.postMessage({ number, error: { message: error.message, where: error.where ?? '', code: error.code ?? '' } })
  }
}
