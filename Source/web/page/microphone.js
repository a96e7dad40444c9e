// The microphone, for as long as it is wanted.

/** What it hears, until `signal` ends it, also while people are still asked; then it rejects with an AbortError. */
export const microphone = async (audio, signal) => {
  const stream = await navigator.mediaDevices.getUserMedia({ audio })
  const end = () => stream.getTracks().forEach((track) => track.stop())
  if (signal.aborted) end()
  signal.throwIfAborted()
  signal.addEventListener('abort', end, { once: true })
  return stream
}
