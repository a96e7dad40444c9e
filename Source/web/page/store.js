// What was worked on, which outlives a reload: in IndexedDB, each work with its own sound. Tabs have works of their own.

const mostWorks = 30 // the oldest are forgotten

const asked = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result)
  request.onerror = () => reject(request.error)
})

/** Name for a new work or sound, which no other tab gives. */
export const newId = () => `${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}`

let database
const opened = () => {
  database ??= (async () => {
    const request = indexedDB.open('pacini', 2)
    request.onupgradeneeded = () => {
      const works = request.result.createObjectStore('works'), sounds = request.result.createObjectStore('sounds')
      if (!request.result.objectStoreNames.contains('documents')) return
      // One document for all tabs, as it was once.
      const documents = request.transaction.objectStore('documents')
      documents.get('current').onsuccess = ({ target: { result: work } }) => {
        documents.get('sound').onsuccess = ({ target: { result: sound } }) => {
          if (work) works.put({ ...work, id: 'first', changed: Date.now(), soundId: sound ? 'first' : undefined }, 'first')
          if (work && sound) sounds.put({ ...sound, id: 'first' }, 'first')
          request.result.deleteObjectStore('documents')
        }
      }
    }
    const result = await asked(request)
    result.onversionchange = () => { // of a newer page in another tab
      result.close()
      database = undefined
    }
    return result
  })()
  database.catch(() => { database = undefined })
  return database
}

/** What `work(works, sounds)` promises, when all of it is done: all or nothing. */
const run = async (mode, work) => {
  const transaction = (await opened()).transaction(['works', 'sounds'], mode)
  const done = new Promise((resolve, reject) => {
    transaction.oncomplete = resolve
    transaction.onabort = () => reject(transaction.error)
  })
  try {
    const result = await work(transaction.objectStore('works'), transaction.objectStore('sounds'))
    await done
    return result
  } catch (error) {
    done.catch(() => {})
    try { transaction.abort() } catch { /* It has ended by itself. */ }
    throw error
  }
}

/** Keeps a work under its `id`, and its sound, which is large and has an `id` too, where it is not there yet. */
export const keep = ({ sound, ...work }) => run('readwrite', async (works, sounds) => {
  if (sound && await asked(sounds.getKey(sound.id)) === undefined) await asked(sounds.put(sound, sound.id))
  const isNew = await asked(works.getKey(work.id)) === undefined
  await asked(works.put({ ...work, soundId: sound?.id, changed: Date.now() }, work.id))
  if (!isNew) return
  // A clip that was only opened can be opened again.
  const worth = ({ id, soundId: has, edits, changed }) => id === work.id ? Infinity : has || edits?.length > 0 ? changed : changed / 1e6
  const all = (await asked(works.getAll())).sort((a, b) => worth(b) - worth(a))
  await Promise.all(all.slice(mostWorks).map(({ id }) => asked(works.delete(id))))
  const needed = new Set(all.slice(0, mostWorks).map(({ soundId }) => soundId))
  for (const id of await asked(sounds.getAllKeys())) if (!needed.has(id)) await asked(sounds.delete(id))
})

/** The works that are kept, the newest first, without their sounds. */
export const keptWorks = async () => (await run('readonly', (works) => asked(works.getAll()))).sort((a, b) => b.changed - a.changed)

/** One of them with its sound; nothing where it is not there. */
export const kept = (id) => run('readonly', async (works, sounds) => {
  const { soundId, ...work } = await asked(works.get(id)) ?? {}
  return work.id && { ...work, sound: soundId && await asked(sounds.get(soundId)) }
})

const claimed = new Set()

/**
 * Whether a work is this tab's from now on: no other tab has it. After a reload the page before may still hold it; `wait`
 * ms are given to that.
 */
export const claim = (id, wait = 0) => !navigator.locks || claimed.has(id) ? Promise.resolve(true) : new Promise((resolve) => {
  const options = wait > 0 ? { signal: AbortSignal.timeout(wait) } : { ifAvailable: true }
  navigator.locks.request(`pacini work ${id}`, options, (lock) => {
    resolve(lock !== null)
    if (lock === null) return undefined
    claimed.add(id)
    return new Promise(() => {}) // until the tab is closed
  }).catch(() => resolve(false))
})
