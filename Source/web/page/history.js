// What was done, to be undone: states that are never changed, only replaced.

export class History {
  #states = []
  #at = -1
  static #most = 200

  /** Whether what was done last belongs to a burst. */
  #isOf(burst) { return burst !== undefined && this.#at > 0 && this.#states[this.#at].burst === burst }

  get now() { return this.#states[this.#at]?.state }
  get undoes() { return this.#at > 0 ? this.#states[this.#at].what : undefined }
  get redoes() { return this.#states[this.#at + 1]?.what }

  /** A new state. Of several with the same `burst`, which is no text that people see, the last takes the others' place. */
  push(what, state, burst) {
    this.#states.length = this.#at + 1
    if (this.#isOf(burst)) --this.#at
    this.#states[++this.#at] = { what, state, burst }
    this.#states.length = this.#at + 1
    if (this.#states.length > History.#most) {
      this.#states.shift()
      --this.#at
    }
  }

  /** The state that the changes of a burst begin with. */
  before(burst) { return this.#states[this.#isOf(burst) ? this.#at - 1 : this.#at]?.state }

  /** Takes back what a burst has changed, if it is the last that was done. */
  withdraw(burst) {
    if (!this.#isOf(burst)) return
    --this.#at
    this.#states.length = this.#at + 1
  }

  undo() {
    if (this.#at > 0) --this.#at
    return this.now
  }

  redo() {
    if (this.#at + 1 < this.#states.length) ++this.#at
    return this.now
  }
}
