// Calls of the worker. A call that a newer one of its kind makes pointless is ended with the worker.

export class Core {
  #worker
  #waiting = new Map()
  #next = 1
  /** Called with the share that is done of a call that says it, 0 to 1. */
  progress = () => {}
  /** ms that the last call took in the worker. */
  took = 0

  #start() {
    this.#worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' })
    this.#worker.onmessage = ({ data: { number, result, error, share, took } }) => {
      const asked = this.#waiting.get(number)
      if (!asked) return
      if (share !== undefined) return this.progress(share)
      this.#waiting.delete(number)
      this.took = took
      if (error) asked.reject(Object.assign(new Error(error.message), error))
      else asked.resolve(result)
    }
    this.#worker.onerror = (event) => {
      for (const { reject } of this.#waiting.values()) reject(new Error(event.message || 'The page\'s module cannot be loaded. Load the page again.'))
      this.#waiting.clear()
      this.#worker = undefined
    }
  }

  /** What the call of the package gives; rejects with `superseded` when cancel() came first. */
  call(name, ...parameters) {
    if (!this.#worker) this.#start()
    const number = this.#next++
    return new Promise((resolve, reject) => {
      this.#waiting.set(number, { resolve, reject })
      this.#worker.postMessage({ number, name, parameters })
    })
  }

  /** Gives the memory of the worker back, where it works for nothing: the next call starts another. Resolves when it is given. */
  rest() {
    if (this.#waiting.size > 0 || !this.#worker) return undefined
    this.#worker.terminate()
    this.#worker = undefined
    return new Promise((resolve) => setTimeout(resolve, 100)) // browsers do not tell when
  }

  cancel() {
    if (this.#waiting.size === 0) return
    this.#worker.terminate()
    this.#worker = undefined
    for (const { reject } of this.#waiting.values()) reject(Object.assign(new Error('superseded'), { superseded: true }))
    this.#waiting.clear()
  }
}
