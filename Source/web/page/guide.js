// The guide: pages of text with figures that the core computes while they are read.

import { figures } from './figures.js'
import pages from './guide/list.js'
import { language, startPage, t } from './text.js'
import { plainWords } from './words.js'

const element = (id) => document.getElementById(id)
startPage()
let leave = new AbortController()

const show = async () => {
  leave.abort()
  leave = new AbortController()
  const name = location.hash.slice(1) || pages[0].name
  const page = pages.find((one) => one.name === name) ?? pages[0]
  const answer = await fetch(`guide/${language === 'en' ? '' : `${language}/`}${page.name}.html`)
  element('page').innerHTML = answer.ok ? await answer.text() : `<p role="alert">${t('This page is not there.')}</p>`
  document.title = `Pacini: ${t(page.title)}`
  const at = pages.indexOf(page)
  element('steps').replaceChildren(...[[pages[at - 1], t('Back'), 'prev'], [pages[at + 1], t('Next'), 'next']].filter(([other]) => other)
    .map(([other, word, rel]) => Object.assign(document.createElement('a'), { href: `#${other.name}`, textContent: `${word}: ${t(other.title)}`, className: 'button', rel })),
  ...(at === pages.length - 1 ? [Object.assign(document.createElement('a'), { href: './', textContent: t('Try it with your own sound'), className: 'button primary' })] : []))
  for (const link of document.querySelectorAll('#pages a'))
    if (link.hash === `#${page.name}`) {
      link.setAttribute('aria-current', 'page')
      link.scrollIntoView({ inline: 'center', block: 'nearest' })
    } else link.removeAttribute('aria-current')
  for (const place of document.querySelectorAll('.figure'))
    figures[place.dataset.figure](place, leave.signal).catch((error) => {
      if (leave.signal.aborted || error?.superseded) return
      const told = document.createElement('p')
      told.role = 'alert'
      told.textContent = plainWords(error)
      place.append(told)
    })
}

element('pages').append(...pages.map(({ name, title }) => {
  const item = document.createElement('li'), link = document.createElement('a')
  link.href = `#${name}`
  link.textContent = t(title)
  item.append(link)
  return item
}))
addEventListener('hashchange', () => show().then(() => {
  scrollTo(0, 0)
  element('page').focus({ preventScroll: true })
}))
show().then(() => { document.documentElement.dataset.ready = 'true' })
