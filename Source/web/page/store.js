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

export const keep = (value) => run('readwrite', (documents) => documents.put(value, 'current'))
export const kept = () => run('readonly', (documents) => documents.get('current'))
