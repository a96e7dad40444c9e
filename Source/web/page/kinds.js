// The gallery by kinds of sound.

const kinds = {
  'Hits': ['knock_wood_bridge', 'impact_boom', 'explosion', 'weapon'],
  'Clicks and messages': ['click_clock', 'ui_click', 'notification'],
  'Rhythms': ['drums_tabla_pattern', 'iter_drum_roll', 'footsteps', 'heartbeat'],
  'Music': ['pluck_guitar_harmonics', 'music_bed'],
  'Textures and machines': ['texture_river', 'rain', 'texture', 'engine_loop'],
  'Movements': ['sweep_spring_up']
}

/** `[kind, files]` of a gallery; what has no kind comes last. */
export const byKind = (files) => {
  const nameOf = (file) => file.replace(/\.pacb$/, '')
  const known = new Set(Object.values(kinds).flat())
  return [...Object.entries(kinds), ['Others', files.map(nameOf).filter((name) => !known.has(name))]]
    .map(([kind, names]) => [kind, names.map((name) => `${name}.pacb`).filter((file) => files.includes(file))])
    .filter(([, there]) => there.length > 0)
}
