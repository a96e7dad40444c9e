// What was done, to be undone: states that are never changed, only replaced.

export class History {
  #states = []
  #at = -1
  static #most = 200

  get now() { return this.#states[this.#at]?.state }
  get undoes() { return this.#at > 0 ? this.#states[this.#at].what : undefined }
  get redoes() { return this.#states[this.#at + 1]?.what }

  /** A new state. Of several with the same `burst`, which is no text that people see, the last takes the others' place. */
  push(what, state, burst) {
    this.#states.length = this.#at + 1
    if (burst !== undefined && this.#at > 0 && this.#states[this.#at].burst === burst) --this.#at
    this.#states[++this.#at] = { what, state, burst }
    this.#states.length = this.#at + 1
    if (this.#states.length > History.#most) {
      this.#states.shift()
      --this.#at
    }
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
