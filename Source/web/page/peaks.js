// Smallest and largest samples of a sound, halved level by level, so that any stretch is drawn as fast as any other.

/** How many samples the finest level takes together: of a long sound more. */
const finestOf = (length) => length > 1e7 ? 256 : 64

/** Smallest and largest of a few samples at a time, `[low, high, low, high...]`, of `length` that are added one after another. */
export class FirstLevel {
  values
  #finest
  #at = 0

  constructor(length) {
    this.#finest = finestOf(length)
    this.values = new Float32Array(2 * Math.ceil(length / this.#finest))
  }

  add(samples) {
    const { values } = this
    for (let n = 0; n < samples.length; ++n) {
      const i = 2 * Math.floor((this.#at + n) / this.#finest), value = samples[n]
      if (value < values[i]) values[i] = value
      else if (value > values[i + 1]) values[i + 1] = value
    }
    this.#at += samples.length
    return this
  }
}

export class Peaks {
  #samples
  #length
  #levels = []

  /** Of samples that are at hand. */
  constructor(samples, length = samples.length, first = new FirstLevel(length).add(samples).values) {
    this.#samples = samples
    this.#length = length
    this.#levels.push(first)
    while (this.#levels.at(-1).length > 4) {
      const fine = this.#levels.at(-1), coarse = new Float32Array(2 * Math.ceil(fine.length / 4))
      for (let i = 0; i < coarse.length / 2; ++i) {
        const two = 4 * i + 2 < fine.length
        coarse[2 * i] = Math.min(fine[4 * i], two ? fine[4 * i + 2] : 0)
        coarse[2 * i + 1] = Math.max(fine[4 * i + 1], two ? fine[4 * i + 3] : 0)
      }
      this.#levels.push(coarse)
    }
  }

  /** Of the first level of a sound whose samples are elsewhere: no finer than that. */
  static ofLevel(first, length) { return new Peaks(undefined, length, first) }

  get length() { return this.#length }

  /** Of the samples from `begin` to `end`, as `[low, high]`. */
  between(begin, end) {
    let low = 0, high = 0
    const take = (values, from, to) => {
      for (let i = Math.max(0, from); i < Math.min(to, values.length); ++i) {
        if (values[i] < low) low = values[i]
        if (values[i] > high) high = values[i]
      }
    }
    const finest = finestOf(this.#length), level = Math.floor(Math.log2((end - begin) / finest))
    if (level < 0 && this.#samples) take(this.#samples, Math.floor(begin), Math.max(Math.floor(begin) + 1, Math.floor(end)))
    else {
      const index = Math.max(0, Math.min(level, this.#levels.length - 1)), width = finest * 2 ** index
      take(this.#levels[index], 2 * Math.floor(begin / width), 2 * Math.max(Math.floor(begin / width) + 1, Math.floor(end / width)))
    }
    return [low, high]
  }
}
