// The page in German and Japanese: the language of the browser and a chooser, a translation for every text that people see or hear,
// decimal commas, nothing cut on phones, tablets and large screens.
//
// check_language.mjs PAGE MODULES SOUND.wav [PICTURES]    PAGE: the built folder; MODULES: the folder with puppeteer-core and axe-core;
// PICTURES: a folder for pictures. Exit 0, 1 on a failed check.
import { cpSync, mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'

import { check, failures, launch, serve, tidyUp, until, wait } from './browser.mjs'

const [page, modules, sound, pictures] = process.argv.slice(2)
const folder = mkdtempSync(join(tmpdir(), 'pacini-language-'))
const port = 20000 + process.pid % 20000
const place = `http://127.0.0.1:${port}/`
// A copy whose translations stand between brackets each, so that what has none is seen.
const marked = join(folder, 'marked'), markedPlace = `http://127.0.0.1:${port + 1}/`
cpSync(page, marked, { recursive: true, filter: (path) => !/\.(br|gz)$/.test(path) })
const table = JSON.parse(readFileSync(join(page, 'texts/de.js'), 'utf8').replace(/^[^{]*/, ''))
writeFileSync(join(marked, 'texts/de.js'), `export default ${JSON.stringify(Object.fromEntries(Object.entries(table)
  .map(([key, value]) => [key, key === ', ' ? value : `⟦${value}⟧`])))}`)
const servers = [serve(page, port), serve(marked, port + 1)]
const browser = await launch(modules, ['--autoplay-policy=no-user-gesture-required'], { userDataDir: join(folder, 'profile') })
const problems = []

/** A tab in a browser of its own. */
const visit = async (address, { width = 1280, height = 900, languages } = {}) => {
  const own = await browser.createBrowserContext(), tab = await own.newPage()
  tab.on('pageerror', (error) => problems.push(error.message))
  await tab.setViewport({ width, height })
  if (languages) await tab.evaluateOnNewDocument((given) => Object.defineProperty(navigator, 'languages', { get: () => given }), languages)
  await tab.goto(address)
  await tab.waitForFunction(() => document.documentElement.dataset.ready === 'true')
  const text = (id) => tab.$eval(`#${id}`, (element) => element.textContent)
  const open = async (path) => {
    await (await tab.$('#file')).uploadFile(path)
    return until(() => tab.evaluate(() => document.getElementById('figures').textContent.length > 10 && !document.getElementById('status').textContent.includes('...')))
  }
  return { tab, text, open, context: own, close: () => own.close() }
}

/** Texts, names and titles that people see or hear and that are between no brackets. */
const unmarked = ({ tab }, without = '#name, #page > :not(.figure), [lang]:not(html)') => tab.evaluate((without) => {
  const found = []
  const look = (given) => {
    let text = given
    for (let before; before !== text;) {
      before = text
      text = text.replace(/⟦[^⟦⟧]*⟧/gu, ' ')
    }
    // Names, units, extensions of files.
    const rest = text.replace(/\b(Pacini|HTS|ZIP|knock|garbage|cut|dB|Hz|ms|s|PM|AM)\b|\(\.[\w. ]+\)|\b\w+\.(wav|flac|json|pacb|zip)\b/gu, ' ')
    if (/\p{L}{2,}/u.test(rest)) found.push(given.replace(/\s+/g, ' ').trim().slice(0, 100))
  }
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT)
  while (walker.nextNode()) {
    const { data, parentElement } = walker.currentNode
    if (!parentElement.closest(`script, style, ${without}`)) look(data)
  }
  for (const name of ['aria-label', 'aria-roledescription', 'title'])
    for (const element of document.querySelectorAll(`[${name}]`))
      if (!element.closest(without) || name === 'aria-label') look(element.getAttribute(name))
  look(document.title)
  return [...new Set(found)]
}, without)

/** What lies outside of the window or of its own box. */
const cut = ({ tab }) => tab.evaluate(() => {
  const found = [], say = (element, why) => found.push(`${why}: ${element.tagName} ${element.id || element.className} "${element.textContent.trim().slice(0, 40)}"`)
  if (document.documentElement.scrollWidth > innerWidth) found.push(`the page is ${document.documentElement.scrollWidth} wide`)
  const context = document.createElement('canvas').getContext('2d')
  for (const element of document.querySelectorAll('button, .button, label, legend, summary, h1, h2, h3, p, a, td, th, caption, output, select, li')) {
    if (!element.checkVisibility() || element.closest('#pages')) continue
    const { left, right, width } = element.getBoundingClientRect()
    if (width > 0 && (right > innerWidth + 1 || left < -1)) say(element, 'outside')
    if (element.scrollWidth > element.clientWidth + 1 && ['BUTTON', 'LABEL', 'SUMMARY', 'LEGEND', 'LI'].includes(element.tagName)) say(element, 'wider than its box')
    if (element.scrollHeight > element.clientHeight + 2 && element.tagName === 'BUTTON') say(element, 'higher than its box')
    if (element.tagName === 'SELECT' && element.selectedIndex >= 0) {
      const style = getComputedStyle(element)
      context.font = `${style.fontSize} ${style.fontFamily}`
      const room = element.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 16
      if (context.measureText(element.selectedOptions[0].text).width > room + 1) say(element, `its choice needs more than ${room.toFixed(0)}`)
    }
  }
  return found
})

try {
  for (const one of [place, markedPlace]) await until(async () => (await fetch(one).catch(() => undefined))?.ok)

  // ---- which language
  for (const [languages, wanted, heading] of [[['de-AT', 'en'], 'de', 'Klang'], [['ja'], 'ja', '音'], [['fr', 'ja-JP', 'en'], 'ja', '音'], [['fr'], 'en', 'Sound'], [['en-GB', 'de'], 'en', 'Sound']]) {
    const one = await visit(`${place}?fresh`, { languages })
    check(`the language of the browser, ${languages.join(' ')}`, await one.tab.$eval('html', ({ lang }) => lang) === wanted && await one.text('source-title') === heading)
    await one.close()
  }
  const chooser = await visit(place, { languages: ['en'] })
  await Promise.all([chooser.tab.waitForNavigation(), chooser.tab.select('#language', 'de')])
  await chooser.tab.waitForFunction(() => document.documentElement.dataset.ready === 'true')
  check('a language is chosen', await chooser.text('record') === 'Aufnehmen' && await chooser.tab.$eval('#language', ({ value }) => value) === 'de')
  check('and it names itself', (await chooser.tab.title()).includes('fühlbar') && await chooser.tab.$eval('html', ({ lang }) => lang) === 'de')
  await chooser.open(sound)
  check('numbers have the commas of the language', /^\d+,\d\d s/.test(await chooser.text('figures')) && !/\d\.\d/.test(await chooser.text('figures')), await chooser.text('figures'))
  check('also in what is made by the core', !/\d\.\d/.test(await chooser.text('status')) && (await chooser.text('status')).startsWith('In '), await chooser.text('status'))
  await chooser.tab.goto(`${place}guide.html`)
  await chooser.tab.waitForFunction(() => document.documentElement.dataset.ready === 'true')
  check('the guide has it too', await chooser.tab.$eval('#page h1', ({ textContent }) => textContent) === 'Was die Bänder tun')
  // Without a network: what the worker keeps is in this language.
  await chooser.tab.waitForFunction(async () => (await navigator.serviceWorker.getRegistration())?.active?.scriptURL.includes('language=de'))
  await until(() => chooser.tab.evaluate(async () => (await caches.match('texts/de.js')) !== undefined))
  await chooser.tab.setOfflineMode(true)
  await (await chooser.tab.target().createCDPSession()).send('Network.emulateNetworkConditions', { offline: true, latency: 0, downloadThroughput: 0, uploadThroughput: 0 })
  await chooser.tab.goto(`${place}guide.html#protection`)
  check('and is there without a network', await until(() => chooser.tab.$eval('#page', ({ textContent }) => textContent.includes('Verstärkung erhöhen'))))
  await chooser.close()
  const lost = await browser.createBrowserContext(), without = await lost.newPage()
  await without.setRequestInterception(true)
  without.on('request', (request) => /texts\//.test(request.url()) ? request.abort() : request.continue())
  await without.goto(`${place}?fresh&language=de`)
  await without.waitForFunction(() => document.documentElement.dataset.ready === 'true')
  check('without its table the page is English', await without.$eval('#record', ({ textContent }) => textContent) === 'Record' &&
    await without.$eval('html', ({ lang, className }) => lang === 'en' && !className.includes('translating')))
  await lost.close()

  // ---- every text
  const shown = await visit(`${markedPlace}?fresh&language=de`)
  const nothing = async (where, one = shown) => {
    const found = await unmarked(one)
    check(`all is translated: ${where}`, found.length === 0, found.join(' | '))
  }
  await nothing('first visit')
  await shown.tab.$eval('.card .feel', (button) => button.click())
  await until(async () => (await shown.text('examples-status')).length > 0)
  await nothing('an example')
  await shown.tab.evaluate(() => document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true })))
  const named = join(folder, 'knock.wav'), bytes = readFileSync(sound)
  writeFileSync(named, bytes)
  check('a sound is analysed', await shown.open(named), await shown.text('error'))
  for (const id of ['edit', 'comparison']) await shown.tab.$eval(`#${id}`, (element) => { element.open = true })
  await until(() => shown.tab.$eval('#measures', ({ hidden }) => !hidden))
  await nothing('a clip')
  const formats = await shown.tab.$$eval('#format option', (options) => options.map(({ value }) => value))
  const lossy = []
  for (const format of formats) {
    await shown.tab.select('#format', format)
    await wait(150)
    const found = await unmarked(shown)
    if (found.length > 0) lossy.push(`${format}: ${found.join(' | ')}`)
  }
  check('all is translated: what formats keep and lose', lossy.length === 0 && formats.length > 15, lossy.join('\n'))
  await shown.tab.select('#lane', 'events')
  for (const id of ['add', 'next']) await shown.tab.$eval(`#${id}`, (button) => button.click())
  await nothing('an event')
  await shown.tab.$eval('#bands', (input) => { input.value = '3'; input.dispatchEvent(new Event('input', { bubbles: true })) })
  await until(async () => (await shown.text('status')).includes('⟦In '))
  for (const id of ['share', 'save-all', 'feel', 'play-both', 'stop']) {
    await shown.tab.$eval(`#${id}`, (button) => button.click())
    await wait(700)
    await nothing(id)
  }
  writeFileSync(join(folder, 'garbage.wav'), 'no sound at all')
  writeFileSync(join(folder, 'cut.wav'), bytes.subarray(0, bytes.length >> 1))
  await (await shown.tab.$('#file')).uploadFile(join(folder, 'garbage.wav'))
  await until(async () => (await shown.text('error')).length > 0)
  await nothing('an error')
  await shown.open(join(folder, 'cut.wav'))
  await until(async () => (await shown.text('status')).includes('abgeschnitten'))
  await nothing('a cut-off sound')
  await shown.tab.evaluate(() => { location.hash = '#c=%%' })
  await until(async () => (await shown.text('error')).length > 0)
  await nothing('a damaged link')
  await shown.close()
  const guide = await visit(`${markedPlace}guide.html?language=de`)
  for (const name of readdirSync(join(page, 'guide')).filter((file) => file.endsWith('.html')).map((file) => file.slice(0, -5))) {
    await guide.tab.evaluate((name) => { location.hash = `#${name}` }, name)
    await until(() => guide.tab.evaluate(() => document.querySelector('.ways button')?.disabled === false && /[:.]/.test(document.querySelector('.figure .words').textContent)), 60)
    await nothing(`the guide, ${name}`, guide)
  }
  await guide.close()

  // ---- nothing is cut
  for (const code of ['en', 'de', 'ja'])
    for (const width of [360, 768, 1440]) {
      const one = await visit(`${place}?fresh&language=${code}`, { width, height: 900 })
      const found = await cut(one)
      const picture = (name) => pictures ? one.tab.screenshot({ path: join(pictures, `${code}-${width}-${name}.png`), fullPage: true }) : undefined
      await picture('welcome')
      await one.open(sound)
      for (const id of ['edit', 'comparison']) await one.tab.$eval(`#${id}`, (element) => { element.open = true })
      await until(() => one.tab.$eval('#measures', ({ hidden }) => !hidden))
      found.push(...await cut(one))
      await picture('clip')
      await one.tab.goto(`${place}guide.html?language=${code}`)
      await until(() => one.tab.evaluate(() => document.querySelector('.ways button')?.disabled === false))
      found.push(...await cut(one))
      await picture('guide')
      check(`nothing is cut in ${code} at ${width} points`, found.length === 0, found.join('\n'))
      await one.close()
    }
  const looked = await visit(`${place}?fresh&language=ja`)
  await looked.tab.evaluate(readFileSync(join(modules, 'node_modules/axe-core/axe.min.js'), 'utf8'))
  const violations = await looked.tab.evaluate(async () => (await globalThis.axe.run()).violations.map(({ id }) => id))
  check('axe finds nothing', violations.length === 0, violations.join(' '))
  check('no errors in the browser', problems.length === 0, problems.join('\n'))
} finally {
  await tidyUp(folder, browser, ...servers)
}
process.exit(failures() ? 1 : 0)
