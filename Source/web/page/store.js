// The document, which outlives a reload: in IndexedDB.

const open = () => new Promise((resolve, reject) => {
  const request = indexedDB.open('pacini', 1)
  request.onupgradeneeded = () => request.result.createObjectStore('documents')
  request.onsuccess = () => resolve(request.result)
  request.onerror = () => reject(request.error)
})

const run = async (mode, work) => {
  const database = await open()
  try {
    return await new Promise((resolve, reject) => {
      const transaction = database.transaction('documents', mode)
      const request = work(transaction.objectStore('documents'))
      transaction.oncomplete = () => resolve(request.result)
      transaction.onabort = transaction.onerror = () => reject(transaction.error ?? request.error)
    })
  } finally {
    database.close()
  }
}

let soundKept // that of the document, which is large and stays while the clip changes

/** The document, and its sound beside it where that is another one: both or neither. */
export const keep = async ({ sound, ...rest }) => {
  await run('readwrite', (documents) => {
    if (sound !== soundKept || sound === undefined) documents.put(sound ?? null, 'sound')
    return documents.put(rest, 'current')
  })
  soundKept = sound
}
export const kept = async () => {
  const document = await run('readonly', (documents) => documents.get('current'))
  return document && { ...document, sound: (await run('readonly', (documents) => documents.get('sound'))) ?? undefined }
}
