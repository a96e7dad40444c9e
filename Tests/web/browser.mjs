// What the tests in a browser share: claims, waiting, the browser of the system, a phone that notes what it is told.
import { spawn } from 'node:child_process'
import { existsSync, rmSync } from 'node:fs'
import { join } from 'node:path'
import { fileURLToPath } from 'node:url'

let failed = 0
export const failures = () => failed
export const check = (what, holds, detail = '') => {
  console.log(`${holds ? 'ok  ' : 'FAIL'} ${what} ${detail ?? ''}`)
  if (!holds) ++failed
}

export const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds))
export const until = async (condition, seconds = 20) => {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await wait(40)) if (await condition()) return true
  return false
}

/** Chromium by puppeteer-core, which is in `modules`; further arguments and options may follow. */
export const launch = async (modules, args = [], options = {}) => {
  const folder = join(modules, 'node_modules/puppeteer-core/lib')
  const entry = ['puppeteer/puppeteer-core.js', 'esm/puppeteer/puppeteer-core.js'].map((path) => join(folder, path)).find(existsSync)
  const { default: puppeteer } = await import(entry)
  return puppeteer.launch({
    executablePath: ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync),
    args: ['--no-sandbox', '--headless=new', '--disable-gpu', ...args], ...options
  })
}

/** The server of the page's folder, on a port of this machine. */
export const serve = (page, port) =>
  spawn('python3', ['-B', fileURLToPath(new URL('../../Source/web/serve.py', import.meta.url)), page, String(port)])

/** Ends what a test started, and removes its folder. */
export const tidyUp = async (folder, browser, ...servers) => {
  for (const server of servers) server.kill()
  await browser.close()
  rmSync(folder, { recursive: true, force: true })
}

/** From the next page on, `vibrations` holds what a page made the phone do: `{at: ms since 1970, pattern}`. */
export const noteVibrations = (page) => page.evaluateOnNewDocument(() => {
  globalThis.vibrations = []
  navigator.vibrate = (pattern) => {
    globalThis.vibrations.push({ at: performance.timeOrigin + performance.now(), pattern: [pattern].flat() })
    return true
  }
})
