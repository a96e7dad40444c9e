// Sliders and numbers that a scroll of the page does not change.

const reach = 10 // pixels from which on a finger slides

/** A slider: what a finger sets that then scrolls is taken back, and nobody hears of it. To be called before others listen. */
export const guardSlider = (input) => {
  let before // {value, x} while it is open what a finger does
  const hear = () => {
    if (!before) return
    const { value } = before
    before = undefined
    if (input.value !== value) input.dispatchEvent(new Event('input', { bubbles: true }))
  }
  input.addEventListener('pointerdown', ({ pointerType, clientX }) => {
    before = pointerType === 'touch' ? { value: input.value, x: clientX } : undefined
  })
  input.addEventListener('input', (event) => { if (before) event.stopImmediatePropagation() })
  input.addEventListener('pointermove', ({ clientX }) => { if (before && Math.abs(clientX - before.x) > reach) hear() })
  input.addEventListener('pointerup', hear)
  input.addEventListener('pointercancel', () => {
    if (before) input.value = before.value
    before = undefined
  })
}

/** A number: a wheel scrolls the page, although it has the focus. */
export const guardNumber = (input) => input.addEventListener('wheel', () => input.blur(), { passive: true })
