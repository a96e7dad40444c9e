// A phone that is not there: opens an address, notes what it is told to vibrate, and says that after a line of input.
//
// phone.mjs MODULES URL    prints what the page says, line by line, and at the end [{"at": ms since 1970, "pattern": [...]}]
import { existsSync } from 'node:fs'
import { createInterface } from 'node:readline'
import { join } from 'node:path'

const [modules, url] = process.argv.slice(2)
const { default: puppeteer } = await import(join(modules, 'node_modules/puppeteer-core/lib/puppeteer/puppeteer-core.js')).catch(() =>
  import(join(modules, 'node_modules/puppeteer-core/lib/esm/puppeteer/puppeteer-core.js')))
const browser = await puppeteer.launch({
  executablePath: ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync),
  args: ['--no-sandbox', '--headless=new', '--disable-gpu']
})
const phone = await browser.newPage()
await phone.evaluateOnNewDocument(() => {
  globalThis.vibrations = []
  navigator.vibrate = (pattern) => {
    globalThis.vibrations.push({ at: performance.timeOrigin + performance.now(), pattern: [pattern].flat() })
    return true
  }
})
await phone.goto(url)
const said = (words) => phone.waitForFunction((words) => document.body.textContent.includes(words), { timeout: 20000 }, words)
await said('Connected')
await phone.click('#ready')
await phone.evaluate(() => new Promise((resolve) => setTimeout(resolve, 800)))
await phone.evaluate(() => { globalThis.vibrations = [] })
console.log(await phone.$eval('#clip', ({ textContent }) => textContent))
for await (const line of createInterface({ input: process.stdin })) {
  if (line === 'end') break
  if (line === 'tell') console.log(JSON.stringify(await phone.evaluate(() => globalThis.vibrations.splice(0))))
  if (line === 'ended') await said('ended').then(() => console.log('ended'), () => console.log('goes on'))
}
await browser.close()
