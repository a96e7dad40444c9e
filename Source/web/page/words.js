// What browsers say of errors, in the words of the page.

import { t, told } from './text.js'

const words = {
  NotAllowedError: 'The browser does not let this page use that. Allow the microphone or the controller in the address bar, then try again.',
  NotFoundError: 'No microphone or controller was found. Connect one, then try again.',
  NotReadableError: 'It cannot be read: another program uses it, or the file was moved. Try again.',
  OverconstrainedError: 'This microphone cannot be used. Choose another one in the browser.',
  SecurityError: 'The browser allows this on https pages and on this machine alone.',
  QuotaExceededError: 'The browser has no room for this.',
  RangeError: 'This is too large for the memory of the browser. Take a shorter sound.'
}

/** An error for people; `where` of the package comes first, as it names what is wrong. */
export const plainWords = (error) => {
  if (error instanceof TypeError && /fetch|load/i.test(error.message)) return t('A part of the page cannot be loaded. Is the network there?')
  return told(words[error?.name] ?? error?.message ?? String(error))
}
