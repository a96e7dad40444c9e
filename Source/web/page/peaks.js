// Smallest and largest samples of a sound, halved level by level, so that any stretch is drawn as fast as any other.

const finest = 64 // samples

export class Peaks {
  #samples
  #levels = [] // [low, high, low, high...]

  constructor(samples) {
    this.#samples = samples
    const first = new Float32Array(2 * Math.ceil(samples.length / finest))
    for (let i = 0; i < first.length / 2; ++i) {
      let low = 0, high = 0
      const end = Math.min(samples.length, (i + 1) * finest)
      for (let n = i * finest; n < end; ++n) {
        const value = samples[n]
        if (value < low) low = value
        else if (value > high) high = value
      }
      first[2 * i] = low
      first[2 * i + 1] = high
    }
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

  get length() { return this.#samples.length }

  /** Of the samples from `begin` to `end`, as `[low, high]`. */
  between(begin, end) {
    let low = 0, high = 0
    const take = (values, from, to) => {
      for (let i = Math.max(0, from); i < Math.min(to, values.length); ++i) {
        if (values[i] < low) low = values[i]
        if (values[i] > high) high = values[i]
      }
    }
    const level = Math.floor(Math.log2((end - begin) / finest))
    if (level < 0) take(this.#samples, Math.floor(begin), Math.max(Math.floor(begin) + 1, Math.floor(end)))
    else {
      const index = Math.min(level, this.#levels.length - 1), width = finest * 2 ** index
      take(this.#levels[index], 2 * Math.floor(begin / width), 2 * Math.max(Math.floor(begin / width) + 1, Math.floor(end / width)))
    }
    return [low, high]
  }
}
