// A phone that is not there: opens an address, notes what it is told to vibrate, and says that after a line of input.
//
// phone.mjs MODULES URL    prints what the page says, line by line, and at the end [{"at": ms since 1970, "pattern": [...]}]
import { createInterface } from 'node:readline'

import { launch, noteVibrations } from './browser.mjs'

const [modules, url] = process.argv.slice(2)
const browser = await launch(modules)
const phone = await browser.newPage()
await noteVibrations(phone)
await phone.goto(url)
await phone.click('#pair')
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
