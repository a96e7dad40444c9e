// Before the first picture: the language, and whoever has work here sees its place, not the welcome, so that nothing moves later.
{
  const { documentElement: page } = document
  const asked = [new URLSearchParams(location.search).get('language')]
  try {
    asked.push(localStorage.getItem('pacini language'))
    if (localStorage.getItem('pacini returns') && !location.hash) page.classList.add('returning')
  } catch { /* A browser without storage. */ }
  page.lang = [...asked, ...navigator.languages].map((code) => code?.slice(0, 2)).find((code) => ['en', 'de', 'ja'].includes(code)) ?? 'en'
  if (page.lang !== 'en') page.classList.add('translating') // nothing is seen until it is in this language
}
