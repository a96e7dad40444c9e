// The gallery by kinds of sound.

import { t } from './text.js'

const kinds = {
  'Hits': { knock_wood_bridge: 'Knock on wood', impact_boom: 'Boom', explosion: 'Explosion', weapon: 'Shot' },
  'Clicks and messages': { click_clock: 'Clock', ui_click: 'Button', notification: 'Notification' },
  'Rhythms': { drums_tabla_pattern: 'Tabla', iter_drum_roll: 'Drum roll', footsteps: 'Footsteps', heartbeat: 'Heartbeat' },
  'Music': { pluck_guitar_harmonics: 'Guitar', music_bed: 'Synthesizer' },
  'Textures and machines': { texture_river: 'River', rain: 'Rain', texture: 'Texture', engine_loop: 'Engine' },
  'Movements': { sweep_spring_up: 'Spring' }
}
const nameOf = (file) => file.replace(/\.flac$/, '')

/** The name of a file of the gallery, for people. */
export const titleOf = (file) => t(Object.assign({}, ...Object.values(kinds))[nameOf(file)] ?? nameOf(file).replaceAll('_', ' '))

/** `[kind, files]` of a gallery; what has no kind comes last. */
export const byKind = (files) => {
  const known = new Set(Object.values(kinds).flatMap(Object.keys))
  const others = files.map(nameOf).filter((name) => !known.has(name))
  return [...Object.entries(kinds).map(([kind, titles]) => [kind, Object.keys(titles)]), ['Others', others]]
    .map(([kind, names]) => [kind, names.map((name) => `${name}.flac`).filter((file) => files.includes(file))])
    .filter(([, there]) => there.length > 0)
}
