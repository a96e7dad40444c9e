// The WebAssembly modules and calls of them: a name, options and buffers in; a value and buffers out. Each is loaded when
// one of its calls is made.

/** What is wrong, where, and the kind of error. */
export class PaciniError extends Error {
  constructor({ code, where, message }) {
    super(where ? `${where}: ${message}` : message)
    this.name = 'PaciniError'
    this.code = code
    this.where = where
  }
}

/** What an error is about that names no place: the input of a call. */
const subjects = { encode: 'sound', translate: 'sound', spectrogram: 'sound', compare: 'sound', profile: 'profile', reapply: 'edits', live: 'settings' }

const noImports = (module) => {
  // The C library closes, seeks and writes standard output when it ends, which never happens.
  const wasi = {}
  for (const { module: from, name } of WebAssembly.Module.imports(module))
    if (from === 'wasi_snapshot_preview1') wasi[name] = () => 0
  return wasi
}

const loading = new Map()
let place

/** From another place than beside this file: the URL of a folder, or an object of compiled modules by their names. */
export const loadFrom = (from) => {
  place = from
  loading.clear()
}

/** Where the modules are: beside this file. Each is written out, as that is what bundlers find and take along. */
const beside = {
  devices: () => new URL('./devices.wasm', import.meta.url),
  encode: () => new URL('./encode.wasm', import.meta.url),
  formats: () => new URL('./formats.wasm', import.meta.url),
  render: () => new URL('./render.wasm', import.meta.url),
  research: () => new URL('./research.wasm', import.meta.url),
  translator: () => new URL('./translator.wasm', import.meta.url)
}

const load = async (name) => {
  if (place?.[name] instanceof WebAssembly.Module) return place[name]
  const url = place instanceof URL ? new URL(`./${name}.wasm`, place) : beside[name]()
  if (url.protocol === 'file:') {
    const files = 'node:fs/promises' // of Node.js alone, which bundlers need not know
    const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ files)
    return WebAssembly.compile(await readFile(url))
  }
  const answer = await fetch(url)
  if (!answer.ok) throw new PaciniError({ code: 'io', where: String(url), message: `cannot be loaded (${answer.status}); it must lie beside the script, or where loadFrom() says` })
  return WebAssembly.compile(await answer.arrayBuffer())
}

/** The module of that name, compiled once, however often it is asked for. */
export const compile = (name) => {
  if (!loading.has(name)) {
    const compiled = load(name)
    loading.set(name, compiled)
    compiled.catch(() => loading.delete(name))
  }
  return loading.get(name)
}

/** An instance; one call at a time, since all of it is synchronous. */
export class Instance {
  #exports
  #pull = () => 0

  constructor(module) {
    const instance = new WebAssembly.Instance(module, {
      pacini: { pull: (address, frames) => this.#pull(address, frames) },
      wasi_snapshot_preview1: noImports(module)
    })
    this.#exports = instance.exports
    this.#exports._initialize()
  }

  get memoryBytes() { return this.#exports.memory.buffer.byteLength }
  get exports() { return this.#exports }

  #bytes(address, length) { return new Uint8Array(this.#exports.memory.buffer, address, length) }

  #put(bytes) {
    const address = this.#exports.allocate(bytes.length)
    if (address === 0) throw new PaciniError({ code: 'tooLarge', where: 'memory', message: 'the module cannot get as much as this call needs; take a shorter sound or clip' })
    this.#bytes(address, bytes.length).set(bytes)
    return address
  }

  /**
   * @param {string} name
   * @param {object} options
   * @param {(Uint8Array|Float32Array)[]} inputs
   * @param {{channels: number, read: (into: Float32Array) => number}} [sound] filled by read(), which says how many
   *   samples came
   */
  call(name, options = {}, inputs = [], sound = { channels: 1, read: () => 0 }) {
    const { allocate, release } = this.#exports
    const held = []
    const hold = (bytes) => {
      const address = this.#put(bytes)
      held.push(address)
      return address
    }
    this.#pull = (address, frames) => {
      const into = new Float32Array(this.#exports.memory.buffer, address, frames * sound.channels)
      return sound.read(into) / sound.channels
    }
    try {
      const coder = new TextEncoder()
      const nameBytes = coder.encode(name)
      const optionBytes = coder.encode(JSON.stringify(options))
      const table = new Uint32Array(inputs.flatMap((input) => {
        const bytes = new Uint8Array(input.buffer, input.byteOffset, input.byteLength)
        return [hold(bytes), bytes.length]
      }))
      const failed = this.#exports.call(hold(nameBytes), nameBytes.length, hold(optionBytes), optionBytes.length,
        hold(new Uint8Array(table.buffer)), inputs.length, sound.channels)
      const text = JSON.parse(new TextDecoder().decode(
        this.#bytes(this.#exports.replyText(), this.#exports.replyTextLength())))
      if (failed) throw new PaciniError({ ...text, where: text.where || (subjects[name] ?? 'clip') })
      const outputs = []
      for (let i = 0; i < this.#exports.replyOutputs(); ++i)
        outputs.push(this.#bytes(this.#exports.replyOutput(i), this.#exports.replyOutputLength(i)).slice())
      return { value: text, outputs }
    } finally {
      for (const address of held) release(address)
      this.#pull = () => 0
    }
  }
}
