// Texts in the language of the page. English texts are their own keys; each other language has a table, loaded when it is needed.

/** Code of the language, which early.js has chosen. */
export const language = document.documentElement.lang

let table = {}
if (language !== 'en')
  try {
    ({ default: table } = await import(`./texts/${language}.js`))
  } catch { // Without its table the page is English.
    document.documentElement.lang = 'en'
  }

const formats = new Map()
/** A number as the language writes it, with so many decimals; as many as it has without `digits`. */
export const number = (value, digits) => {
  if (!formats.has(digits))
    formats.set(digits, new Intl.NumberFormat(document.documentElement.lang, digits === undefined ? { maximumFractionDigits: 6 }
      : { minimumFractionDigits: digits, maximumFractionDigits: digits }))
  return formats.get(digits).format(value)
}
const shown = (value) => typeof value === 'number' ? number(value) : value

/** A text, with `{0}`, `{1}`... replaced by values. Values that are texts stay as they are. */
export const t = (english, ...values) => (table[english] ?? english).replace(/\{(\d)(?::text)?\}/g, (_, which) => shown(values[which]))

/** "1 point", "3 points": one of two templates with the number as `{0}`. */
export const counted = (count, one, many, ...values) => t(count === 1 ? one : many, count, ...values)

/** Parts of a sentence in a row, such as "a, b and c" without the "and". */
export const listed = (texts) => texts.join(t(', '))

const escaped = (text) => text.replace(/[\\^$.*+?()[\]{}|]/g, '\\$&')
let templates
/** Keys with values in them as patterns, the more specific ones first. */
const templatesNow = () => templates ??= Object.keys(table).filter((key) => key.includes('{') && /\p{L}{2}/u.test(key.replace(/\{[^}]*\}/g, '')))
  .map((key) => ({ key, fixed: key.replace(/\{[^}]*\}/g, ''), marks: [...key.matchAll(/\{(\d)(:text)?\}/g)] }))
  .sort((a, b) => b.fixed.length - a.fixed.length)
  .map(({ key, marks }) => ({ key, marks, pattern: new RegExp(`^${key.split(/\{[^}]*\}/).map(escaped).join('(.+?)')}$`, 'su') }))

/**
 * A text that was put together in English elsewhere (by the core, or in the markup): by its key, or by a template that it fits.
 * Numbers are written as the language does; `{0:text}` stands for a value that is a text in turn.
 */
export const told = (english) => {
  if (table[english] !== undefined) return table[english]
  for (const { key, marks, pattern } of language === 'en' ? [] : templatesNow()) {
    const found = pattern.exec(english)
    if (!found) continue
    const values = []
    marks.forEach(([, which, isText], i) => {
      const value = found[i + 1]
      values[which] = isText ? told(value) : /^-?\d+\.\d+$/.test(value) ? number(Number(value), value.split('.')[1].length) : value
    })
    return t(key, ...values)
  }
  // A place or a name may come first.
  const [place, ...rest] = english.split(': ')
  return rest.length > 0 && told(rest.join(': ')) !== rest.join(': ') ? `${place}: ${told(rest.join(': '))}` : english
}

const attributes = ['aria-label', 'aria-roledescription', 'title', 'content', 'label', 'data-drop']
/** Puts the markup within an element into the language. */
export const translate = (root) => {
  if (language === 'en') return
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT)
  while (walker.nextNode()) {
    const node = walker.currentNode, key = node.data.replace(/\s+/g, ' ').trim()
    if (/\p{L}/u.test(key) && !node.parentElement.closest('script, style, [lang]:not(html)')) node.data = node.data.replace(/\S[\s\S]*\S|\S/u, () => told(key))
  }
  for (const name of attributes)
    for (const element of [root, ...root.querySelectorAll(`[${name}]`)])
      if (element.hasAttribute(name) && (name !== 'content' || element.name === 'description')) element.setAttribute(name, told(element.getAttribute(name)))
}

/** The whole page, and its chooser of languages; from then on it is seen. */
export const startPage = () => {
  translate(document.documentElement)
  document.documentElement.classList.remove('translating')
  const chooser = document.getElementById('language')
  chooser.value = language
  chooser.addEventListener('change', () => {
    const address = new URL(location.href)
    address.searchParams.delete('language')
    try {
      localStorage.setItem('pacini language', chooser.value)
    } catch { // A browser without storage.
      address.searchParams.set('language', chooser.value)
    }
    window.history.replaceState(null, '', address)
    location.reload() // the work is kept
  })
}
