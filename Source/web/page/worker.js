// Encoding, rendering and formats, beside the page's own thread. One request after another, each with its number.

import { defaults, encode, formats, read, render, write, compare, profileInfo } from './pacini/index.js'

const calls = { defaults, encode, formats, read, render, write, compare, profileInfo }

self.onmessage = async ({ data: { number, name, parameters } }) => {
  try {
    const result = await calls[name](...parameters)
    self.postMessage({ number, result })
  } catch (error) {
    self.postMessage({ number, error: { message: error.message, where: error.where ?? '', code: error.code ?? '' } })
  }
}
