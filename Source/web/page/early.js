// Before the first picture: whoever has work here sees its place, not the welcome, so that nothing moves when it comes.
try {
  if (localStorage.getItem('pacini returns') && !location.hash) document.documentElement.classList.add('returning')
} catch { /* A browser without storage. */ }
