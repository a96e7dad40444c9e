// Editing on the picture and by the numbers beside it: pointer, keyboard, fields.

import { number, t } from './text.js'
import { valueAt } from './curve.js'
import { addPoint, lanesOf, movePoint, pointsOf, removePoint } from './edits.js'

const tapReach = 10 // pixels that a finger may move and still has tapped

/**
 * `state`: what is shown, with `clip`, `lane` and `selected`. `change(what, edited, burst)` takes what a function of edits.js
 * gives, `withdraw(burst)` takes it back, `look()` draws anew, `playhead()` tells where new points go, `say(text)` reads aloud.
 */
export const startEditing = ({ canvas, lanes, state, change, withdraw, look, playhead, say, element }) => {
  let dragged // which drag, while there is one
  let released = Promise.resolve(), release
  const points = () => pointsOf(state.clip, state.lane)
  const described = () => {
    const point = points()[state.selected]
    if (!point) return t('Nothing is selected.')
    const values = [state.selected + 1, points().length, number(point.time, 3), number(point.amplitude, 2)]
    return state.lane === 'events' ? t('Event {0} of {1}: {2} s, amplitude {3}, sharpness {4}', ...values, number(point.sharpness, 2))
      : t('Point {0} of {1}: {2} s, amplitude {3}', ...values)
  }

  const showFields = () => {
    const select = element('lane'), lanesNow = lanesOf(state.clip)
    select.replaceChildren(...lanesNow.map(({ key, title }) => new Option(title, String(key))))
    if (!lanesNow.some(({ key }) => key === state.lane)) state.lane = lanesNow.at(lanesNow.length > 1 ? 1 : 0).key
    select.value = String(state.lane)
    if (!dragged) lanes.fit(state.clip, state.lane)
    if (state.selected >= points().length) state.selected = points().length - 1
    const point = points()[state.selected]
    for (const id of ['time', 'amplitude', 'sharpness', 'remove'])
      element(id).disabled = !point || (id === 'sharpness' && state.lane !== 'events')
    element('time').value = point ? +point.time.toFixed(4) : ''
    element('time').max = state.clip.duration
    element('amplitude').value = point ? +point.amplitude.toFixed(3) : ''
    element('sharpness').value = point && state.lane === 'events' ? +point.sharpness.toFixed(3) : ''
    element('selected').textContent = described()
  }
  let selections = 0 // what happens to one selected point by the same key is one step
  const select = (index) => {
    ++selections
    state.selected = index
    showFields()
    look()
  }
  const move = (to, burst) => {
    if (!points()[state.selected]) return
    const moved = movePoint(state.clip, state.lane, state.selected, to)
    state.selected = moved.index
    change(t('Move'), moved, burst && `${burst} ${selections}`)
    showFields()
  }
  const add = (time, amplitude) => {
    const added = addPoint(state.clip, state.lane, { time, amplitude })
    if (!added) return say(t('There is a point already.'))
    state.selected = added.index
    change(t('Add'), added)
    showFields()
  }
  const remove = () => {
    if (!points()[state.selected]) return
    const removed = removePoint(state.clip, state.lane, state.selected)
    if (!removed) return say(t('A curve keeps its ends.'))
    state.selected = removed.index
    change(t('Remove'), removed)
    showFields()
  }
  const choose = (lane) => {
    state.lane = lane
    select(0)
  }

  // ---- pointer
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect()
    return [event.clientX - left, event.clientY - top]
  }
  const found = (x, y, touch) => lanes.hit(x, y, state, touch ? 22 : 10)
  /** Selects what is at a place; whether that is a point. */
  const press = (x, y, touch) => {
    const { part, band, index } = found(x, y, touch)
    if (part === 'band') choose(band)
    else if (part !== 'edited' || index === undefined) playhead(Math.min(Math.max(lanes.timeAt(x), 0), state.clip.duration))
    else {
      select(index)
      return true
    }
    return false
  }
  const begin = (event) => {
    dragged = `drag ${event.timeStamp}`
    released = new Promise((resolve) => { release = resolve })
    canvas.setPointerCapture(event.pointerId)
    event.preventDefault()
    canvas.focus()
  }
  // A finger that swipes scrolls the page: it drags nothing but the point that was tapped last.
  let tap, tapped
  // Fingers that edit nothing: one that goes along the picture scrolls it, two zoom it.
  const fingers = new Map() // {x, y} by their pointers
  let gesture // {range, x} or {range, x, distance}: as it began
  const startGesture = () => {
    const all = [...fingers.values()], x = all.reduce((sum, one) => sum + one.x, 0) / all.length
    gesture = all.length === 0 ? undefined
      : { range: lanes.range, x, time: lanes.timeAt(x), distance: all.length > 1 ? Math.abs(all[0].x - all[1].x) : undefined }
    if (all.length > 1) tap = undefined
  }
  const goOn = () => {
    const all = [...fingers.values()], { duration } = state.clip
    lanes.range = gesture.range
    if (gesture.distance > 0) lanes.zoom(gesture.distance / Math.max(1, Math.abs(all[0].x - all[1].x)), gesture.time, duration)
    else if (!tap) lanes.scrollTo(gesture.range.from + gesture.time - lanes.timeAt(all[0].x), duration)
    look()
  }
  const lift = ({ pointerId }) => {
    if (fingers.delete(pointerId)) startGesture()
  }
  const isTapped = (x, y) => tapped === selections && found(x, y, true).part === 'edited' && found(x, y, true).index === state.selected
  canvas.addEventListener('touchstart', (event) => {
    if (event.touches.length === 1 && state.clip && isTapped(...place(event.touches[0]))) event.preventDefault()
  }, { passive: false })
  canvas.addEventListener('pointerdown', (event) => {
    tap = undefined
    if (event.button !== 0 || !state.clip) return
    const [x, y] = place(event), touch = event.pointerType === 'touch'
    if (touch && (fingers.size > 0 || !isTapped(x, y))) {
      if (dragged) return
      fingers.set(event.pointerId, { x, y })
      startGesture()
      if (event.isPrimary) tap = { id: event.pointerId, x, y }
    } else if (touch || press(x, y)) begin(event)
  })
  canvas.addEventListener('pointermove', (event) => {
    const [x, y] = place(event)
    if (tap && (tap.id !== event.pointerId || Math.hypot(x - tap.x, y - tap.y) > tapReach)) tap = undefined
    if (gesture && fingers.has(event.pointerId)) {
      fingers.set(event.pointerId, { x, y })
      goOn()
    }
    if (dragged) move({ time: lanes.timeAt(x), amplitude: lanes.amplitudeAt(y) }, dragged)
  })
  const drop = () => {
    dragged = undefined
    release()
    showFields()
    look()
  }
  canvas.addEventListener('pointerup', (event) => {
    lift(event)
    if (dragged) drop()
    else if (tap && press(tap.x, tap.y, true)) tapped = selections
    tap = undefined
  })
  // The browser took the pointer for something else.
  canvas.addEventListener('pointercancel', (event) => {
    lift(event)
    tap = undefined
    if (!dragged) return
    withdraw(`${dragged} ${selections}`)
    drop()
  })
  canvas.addEventListener('dblclick', (event) => {
    if (!state.clip) return
    const [x, y] = place(event)
    const { part, index } = found(x, y)
    if (part === 'edited' && index === undefined) add(lanes.timeAt(x), lanes.amplitudeAt(y))
  })
  canvas.addEventListener('wheel', (event) => {
    if (!state.clip || (!event.ctrlKey && !event.shiftKey && Math.abs(event.deltaX) <= Math.abs(event.deltaY))) return
    event.preventDefault()
    const length = lanes.range.to - lanes.range.from
    if (event.ctrlKey) lanes.zoom(2 ** (event.deltaY / 200), lanes.timeAt(place(event)[0]), state.clip.duration)
    else lanes.scrollTo(lanes.range.from + (event.deltaX || event.deltaY) / 800 * length, state.clip.duration)
    look()
  }, { passive: false })

  // ---- keyboard
  const middle = () => (lanes.range.from + lanes.range.to) / 2
  const keys = {
    ArrowRight: () => select(Math.min(state.selected + 1, points().length - 1)),
    ArrowLeft: () => select(Math.max(state.selected - 1, 0)),
    'Shift+ArrowRight': () => move({ time: points()[state.selected]?.time + 0.005 }, 'later'),
    'Shift+ArrowLeft': () => move({ time: points()[state.selected]?.time - 0.005 }, 'earlier'),
    ArrowUp: () => move({ amplitude: points()[state.selected]?.amplitude + 0.02 }, 'up'),
    ArrowDown: () => move({ amplitude: points()[state.selected]?.amplitude - 0.02 }, 'down'),
    PageUp: () => step(1),
    PageDown: () => step(-1),
    Insert: () => element('add').click(),
    a: () => element('add').click(),
    Delete: remove,
    Backspace: remove,
    '+': () => lanes.zoom(0.5, points()[state.selected]?.time ?? middle(), state.clip.duration),
    '-': () => lanes.zoom(2, middle(), state.clip.duration),
    0: () => lanes.showAll(state.clip.duration)
  }
  const step = (by) => {
    const all = lanesOf(state.clip).map(({ key }) => key)
    choose(all[Math.min(Math.max(all.indexOf(state.lane) + by, 0), all.length - 1)])
  }
  canvas.addEventListener('keydown', (event) => {
    if (!state.clip || event.ctrlKey || event.metaKey || event.altKey) return
    const action = keys[(event.shiftKey && event.key.startsWith('Arrow') ? 'Shift+' : '') + event.key]
    if (!action) return
    event.preventDefault()
    action()
    const point = points()[state.selected]
    if (point && (point.time < lanes.range.from || point.time > lanes.range.to))
      lanes.scrollTo(point.time - 0.5 * (lanes.range.to - lanes.range.from), state.clip.duration)
    look()
  })

  // ---- fields
  element('lane').addEventListener('change', ({ target }) =>
    choose(['events', 'total'].includes(target.value) ? target.value : Number(target.value)))
  for (const id of ['time', 'amplitude', 'sharpness'])
    element(id).addEventListener('change', ({ target }) => {
      if (target.value !== '') move({ [id]: Number(target.value) })
    })
  element('previous').addEventListener('click', keys.ArrowLeft)
  element('next').addEventListener('click', keys.ArrowRight)
  element('remove').addEventListener('click', remove)
  element('add').addEventListener('click', () => {
    // Behind the selected one, or where the sound plays from.
    const point = points()[state.selected], next = points()[state.selected + 1]
    const time = point && next ? (point.time + next.time) / 2 : playhead()
    add(time, state.lane === 'events' ? 0.8 : valueAt(points(), time))
  })
  for (const [id, work] of [['nearer', keys['+']], ['farther', keys['-']], ['all', keys[0]]])
    element(id).addEventListener('click', () => { work(); look() })
  /** `released()`: when nothing is dragged any more. */
  return { refresh: showFields, released: () => released }
}
