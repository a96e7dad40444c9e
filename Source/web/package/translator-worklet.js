// Audio worklet of the live translator: sound in, drive signal out, block by block. Nothing is allocated while it runs.

class PaciniTranslator extends AudioWorkletProcessor {
  constructor({ processorOptions }) {
    super()
    const { module, profile, setup, values } = processorOptions
    const wasi = {}
    for (const one of WebAssembly.Module.imports(module))
      if (one.module === 'wasi_snapshot_preview1') wasi[one.name] = () => 0
    const { exports } = new WebAssembly.Instance(module, { pacini: { pull: () => 0 }, wasi_snapshot_preview1: wasi })
    exports._initialize()
    const address = exports.allocate(profile.length)
    new Uint8Array(exports.memory.buffer, address, profile.length).set(profile)
    this.handle = exports.translatorCreate(sampleRate, address, profile.length, ...setup)
    exports.release(address)
    this.exports = exports
    this.from = new Float32Array(exports.memory.buffer, exports.translatorIn(this.handle), 1024)
    this.to = new Float32Array(exports.memory.buffer, exports.translatorOut(this.handle), 1024)
    const set = (given) => {
      new Float64Array(exports.memory.buffer, exports.translatorValues(this.handle), given.length).set(given)
      exports.translatorSet(this.handle)
    }
    if (values) {
      set(values)
      exports.translatorReset(this.handle)
    }
    this.port.onmessage = ({ data }) => set(data)
  }

  process([input], [output]) {
    const to = output[0]
    const count = to.length
    const scale = 1 / Math.max(1, input.length)
    for (let n = 0; n < count; ++n) {
      let sum = 0
      for (let c = 0; c < input.length; ++c) sum += input[c][n]
      this.from[n] = scale * sum
    }
    this.exports.translatorProcess(this.handle, count)
    for (let n = 0; n < count; ++n) to[n] = this.to[n]
    return true
  }
}

registerProcessor('pacini-translator', PaciniTranslator)
