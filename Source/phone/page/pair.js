import { translate } from './texts.js'

translate()
// A second tap would find its code used.
document.querySelector('form').addEventListener('submit', () => { document.getElementById('pair').disabled = true })
