// Several files as one: a ZIP archive that stores them as they are, since clips are small. Source: PKWARE, APPNOTE.TXT.

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let bit = 0; bit < 8; ++bit) n = n & 1 ? 0xEDB88320 ^ (n >>> 1) : n >>> 1
  return n >>> 0
})
const crc32 = (bytes) => {
  let crc = 0xFFFFFFFF
  for (const byte of bytes) crc = table[(crc ^ byte) & 255] ^ (crc >>> 8)
  return (crc ^ 0xFFFFFFFF) >>> 0
}

/** Numbers of two bytes, or four where they are written as [number]. */
const fields = (...values) => {
  const bytes = []
  for (const value of values) {
    const [number, count] = Array.isArray(value) ? [value[0], 4] : [value, 2]
    for (let i = 0; i < count; ++i) bytes.push((number >>> (8 * i)) & 255)
  }
  return Uint8Array.from(bytes)
}

/** The archive of `{name, bytes}`, as parts of a Blob. */
export const zip = (files, when = new Date()) => {
  const time = (when.getHours() << 11) | (when.getMinutes() << 5) | (when.getSeconds() >> 1)
  const day = ((when.getFullYear() - 1980) << 9) | ((when.getMonth() + 1) << 5) | when.getDate()
  const utf8 = 0x0800, version = 20
  const parts = [], directory = []
  let at = 0, directorySize = 0
  for (const { name, bytes } of files) {
    const nameBytes = new TextEncoder().encode(name)
    const common = fields(version, utf8, 0, time, day, [crc32(bytes)], [bytes.length], [bytes.length], nameBytes.length, 0)
    parts.push(fields([0x04034b50]), common, nameBytes, bytes)
    const entry = [fields([0x02014b50], version), common, fields(0, 0, 0, [0], [at]), nameBytes]
    directory.push(...entry)
    at += 4 + common.length + nameBytes.length + bytes.length
    directorySize += entry.reduce((sum, part) => sum + part.length, 0)
  }
  return [...parts, ...directory, fields([0x06054b50], 0, 0, files.length, files.length, [directorySize], [at], 0)]
}
