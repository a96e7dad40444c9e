// The npm package in Node: the same bytes as the program, errors as they are documented, the examples of its README.
//
// check_package.mjs PACKAGE MODULES PACINI LIVE SOUNDS    PACKAGE: the built folder; MODULES: where TypeScript is; LIVE:
// pacini_live_reference; SOUNDS: a folder of WAV files. Exit 0, 1 on a failed check.
import { execFileSync, spawn } from 'node:child_process'
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { basename, join } from 'node:path'
import { gzipSync } from 'node:zlib'

import { launch, until } from './browser.mjs'

const [packageFolder, modules, program, live, sounds] = process.argv.slice(2)
const folder = mkdtempSync(join(tmpdir(), 'pacini-web-'))
let failures = 0
const check = (what, holds, detail = '') => {
  console.log(`${holds ? 'ok  ' : 'FAIL'} ${what} ${detail}`)
  if (!holds) ++failures
}
const native = (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] })
const same = (a, b) => Buffer.compare(Buffer.from(a.buffer, a.byteOffset, a.byteLength), b) === 0
const fails = async (work) => {
  try {
    await work()
  } catch (error) {
    return error
  }
  return undefined
}

try {
  // As users have it: packed, then installed in a clean folder.
  const packed = execFileSync('npm', ['pack', '--silent', '--pack-destination', folder], { cwd: packageFolder, encoding: 'utf8' })
    .trim().split('\n').at(-1)
  writeFileSync(join(folder, 'package.json'), '{"type": "module", "private": true}')
  execFileSync('npm', ['install', '--silent', '--no-audit', '--no-fund', join(folder, packed)], { cwd: folder })
  const installed = join(folder, 'node_modules/pacini')
  const pacini = await import(join(installed, 'index.js'))
  const { encode, read, write, lint, render, felt, compare, formats, profileNames, profileInfo, readWav, reports, spectrogram, parameters, exportParameters, PaciniError } = pacini

  let differing = 0, rendered = 0
  const names = readdirSync(sounds).filter((name) => name.endsWith('.wav')).sort()
  for (const file of names) {
    const path = join(sounds, file), name = basename(file, '.wav')
    const sound = readWav(readFileSync(path))
    native('encode', path, '-o', 'native.pacb', '--format', 'packed', '-y')
    native('encode', path, '-o', 'native.json', '-y')
    const packedClip = await encode(sound, { name, source: file, format: 'packed' })
    const text = await encode(sound, { name, source: file, format: 'text' })
    const nativePacked = readFileSync(join(folder, 'native.pacb')), nativeText = readFileSync(join(folder, 'native.json'))
    if (!same(packedClip, nativePacked) || !same(new TextEncoder().encode(text), nativeText)) {
      ++differing
      console.log(`     ${name}: ${packedClip.length} and ${nativePacked.length} bytes packed, text ${same(new TextEncoder().encode(text), nativeText) ? 'the same' : 'differs'}`)
    }
    for (const profile of ['l5-wristband', 'lra-175', 'erm-coin']) {
      native('render', 'native.json', '-o', 'native.wav', '--profile', profile, '-y')
      const heard = readWav(readFileSync(join(folder, 'native.wav')))
      const drive = await render(text, { profile, sampleRate: heard.sampleRate })
      let largest = drive.samples.length === heard.samples.length ? 0 : 1
      for (let n = 0; n < heard.samples.length; ++n) largest = Math.max(largest, Math.abs(heard.samples[n] - drive.samples[n]))
      rendered = Math.max(rendered, largest)
    }
  }
  check(`clips of ${names.length} sounds are those of the program, byte for byte`, names.length > 0 && differing === 0, `${differing} differ`)
  check('and so are drive signals for three actuators', rendered === 0, `largest difference ${rendered}`)

  // The way through all formats that are written and read.
  const sound = readWav(readFileSync(join(sounds, names[0])))
  const clip = await encode(sound)
  const all = await formats()
  for (const format of all.filter((one) => one.writes)) {
    const { files } = await write(clip, { format: format.name, ...(format.samples ? { profile: 'l5-wristband' } : {}) })
    const nonEmpty = files.length > 0 && files.every(({ bytes }) => bytes.length > 0)
    let back = true
    if (format.reads) {
      const again = await fails(async () => { back = (await read(files[0].bytes, { extension: format.extension })).clip.duration > 0 })
      if (again) back = again.message
    }
    check(`format ${format.name}`, nonEmpty && back === true, back === true ? '' : back)
  }
  const losses = await lint(clip, { format: 'android-basic' })
  check('losses are told', losses.length > 0 && losses.every(({ kind, message }) => kind && message), `${losses.length} losses`)

  const skin = await felt(clip, { profile: 'l5-wristband' })
  check('what is felt has samples', skin.samples.some((value) => value !== 0))
  const drive = await render(clip, { sampleRate: sound.sampleRate })
  const figures = await compare(sound, drive)
  check('a comparison has its figures', figures.hts > 0 && figures.match > 0, `HTS ${figures.hts}, match ${figures.match}`)
  const tone = Float32Array.from({ length: 48000 }, (_, n) => Math.sin(2 * Math.PI * 200 * n / 48000))
  const picture = await spectrogram({ samples: tone, sampleRate: 48000 }, { columns: 40 })
  const light = (y) => picture.pixels[4 * (y * picture.width + 20)] + picture.pixels[4 * (y * picture.width + 20) + 1]
  const brightest = Array.from({ length: picture.height }, (_, y) => y).reduce((best, y) => light(y) > light(best) ? y : best, 0)
  const hertz = picture.low * (picture.high / picture.low) ** ((picture.height - brightest - 0.5) / picture.height)
  check('a spectrogram shows a tone where it is', picture.width === 40 && Math.abs(hertz / 200 - 1) < 0.05, `${hertz.toFixed(0)} Hz of 200`)
  check('actuators are there', profileNames().length === 20 && (await profileInfo('lra-175')).high > 0)
  const controllers = [['switch', 0x057e, 0x2009, true], ['switch-usb', 0x057e, 0x2009, false],
    ['dualsense', 0x054c, 0x0ce6, false], ['dualsense-bluetooth', 0x054c, 0x0ce6, true],
    ['dualshock4', 0x054c, 0x09cc, false], ['xbox', 0x045e, 0x0b13, true], ['steamdeck', 0x28de, 0x1205, false],
    ['steam', 0x28de, 0x1302, false]]
  native('encode', join(sounds, names[0]), '-o', 'native.json', '-y')
  for (const [like, vendor, product, bluetooth] of controllers) {
    const listed = JSON.parse(native('play', 'native.json', '--dry-run', '--like', like, '--json')).packets
    const { reports: own, stops } = await reports(clip, { vendor, product, bluetooth })
    const hex = (bytes) => Buffer.from(bytes).toString('hex')
    const same = own.length === listed.length &&
      own.every(({ time, bytes }, i) => Math.abs(time - listed[i].time) < 1e-9 && hex(bytes) === listed[i].bytes.replaceAll(' ', '').toLowerCase())
    check(`reports to ${like} are those of the program`, same && stops.length >= 16, `${own.length} and ${listed.length}`)
  }
  // Edits by hand over one analysis, taken to another: what the editor's document does.
  const { reapply } = pacini
  const fewer = await encode(sound, { bands: 4 })
  const added = { time: 0.2, amplitude: 0.7, sharpness: 0.4 }
  const edit = (more) => ({ frequencies: [], clipDuration: clip.duration, ...more })
  const far = clip.bands.at(-1)
  const moved = await reapply(clip, fewer, [
    edit({ kind: 'transient', after: added }),
    edit({ kind: 'points', lane: 'amplitude', band: 0, from: 0.1, to: 0.2, points: [{ time: 0.15, value: 0.5 }], frequencies: [{ frequency: clip.bands[0].centreFrequency }] }),
    edit({ kind: 'transient', before: { time: clip.duration - 0.001, amplitude: 0.123, sharpness: 0.5 } }),
    edit({ kind: 'points', lane: 'amplitude', band: 0, from: 0, to: 0.1, points: [{ time: 0.05, value: 0.5 }], frequencies: [{ frequency: far.highFrequency * 9 }] })])
  check('edits are taken to another analysis', moved.clip.bands.length === 4 && moved.clip.transients.length === fewer.transients.length + 1 &&
    moved.clip.transients.some(({ amplitude }) => amplitude === 0.7) && moved.clip.bands[0].amplitude.some(({ amplitude }) => amplitude === 0.5))
  check('and what does not fit waits', moved.edits.length === 4 && moved.unfitting.map(({ edit: index }) => index).join() === '2,3' &&
    moved.unfitting.every(({ reason }) => reason.length > 5), JSON.stringify(moved.unfitting))
  check('none gives the analysis', JSON.stringify((await reapply(clip, fewer, [])).clip) === JSON.stringify(fewer))
  const scene = { format: 'pacini.scene', version: 1, duration: 1, clips: [{ file: '0' }], plays: [{ clip: 0, start: 0.1 }] }
  const sceneDrive = await fails(async () => check('a scene is rendered', (await render(scene, { clips: [clip] })).samples.length > 0))
  if (sceneDrive) check('a scene is rendered', false, sceneDrive.message)

  // Parameters are described as the program describes them, and settings are options.
  const settings = (encode) => ({ format: 'pacini.settings', version: 1, encode })
  const told = JSON.parse(native('encode', '--print-settings', '--json')).parameters
  check('parameters are described as by the program', told.encode.length > 20 && JSON.stringify(await parameters()) === JSON.stringify(told.encode), `${told.encode.length} parameters`)
  // Bundles of Pulsar need a library that is not on the page.
  const here = new Set((await formats()).map(({ name }) => name))
  const missing = JSON.parse(native('lint', '--targets', '--json')).targets.map(({ name }) => name).filter((name) => !here.has(name))
  check('it has the formats of the program', missing.join() === 'pulsar', missing.join())
  const exports = told.export.map((one) => one.formats ? { ...one, formats: one.formats.filter((name) => here.has(name)) } : one)
  check('and so are those of exports', exports.length > 9 && JSON.stringify(await exportParameters()) === JSON.stringify(exports), `${exports.length} parameters`)
  const chosen = { bands: 4, minimumGap: 0.05, spacing: 'linear', keepLevel: true }
  const byOptions = await encode(sound, { ...chosen, format: 'packed' })
  check('settings do what options do', same(byOptions, await encode(sound, { settings: settings(chosen), format: 'packed' })))
  check('options come before settings', same(byOptions, await encode(sound, { ...chosen, settings: settings({ bands: 9 }), format: 'packed' })))
  for (const [at, { name }] of JSON.parse(native('encode', '--print-settings', '--json')).presets.entries()) {
    native('encode', join(sounds, names[0]), '-o', 'preset.pacb', '--preset', name, '-y')
    const wanted = readFileSync(join(folder, 'preset.pacb'))
    const options = { name: basename(names[0], '.wav'), source: names[0], format: 'packed' }
    const first = readWav(readFileSync(join(sounds, names[0])))
    check(`the preset ${name} is that of the program`, same(await encode(first, { ...options, preset: name }), wanted) &&
      (at > 0 || same(await encode(first, { ...options, preset: name, settings: settings({ audible: 0.25 }) }), wanted)))
  }
  check('a method of settings is that of the option', (await encode(sound, { settings: settings({ method: 'thesis', attack: 0.1 }) })).encoder.attack === 0.1)

  // A file that is read in parts gives the same bytes, whatever the parts are.
  const bytesOfFile = new Uint8Array(readFileSync(join(sounds, names[0])))
  let asked = 0
  const inParts = pacini.openSound((at, length) => { asked = Math.max(asked, length); return bytesOfFile.slice(at, at + length) }, bytesOfFile.length)
  check('a sound is read in parts', same(await encode(inParts, { format: 'packed' }), await encode(readWav(bytesOfFile), { format: 'packed' })) &&
    inParts.frames === inParts.promised && asked <= 4 * 65536, `${asked} bytes at most`)
  const cutOff = bytesOfFile.subarray(0, 1044), short = pacini.openSound((at, length) => cutOff.subarray(at, at + length), cutOff.length)
  check('and says what it lacks', short.frames === 500 && short.promised === inParts.frames, `${short.frames} of ${short.promised}`)

  const spaced = bytesOfFile.slice()
  new DataView(spaced.buffer).setUint16(32, 8, true) // frames of 8 bytes
  const { warnings } = readWav(spaced)
  check('and what a header says that is not so', warnings.length === 1 && warnings[0].startsWith('has a header that states frames of 8 bytes'), warnings.join(' '))

  const slow = bytesOfFile.slice()
  new DataView(slow.buffer).setUint32(24, 3000, true)
  writeFileSync(join(folder, 'slow.wav'), slow)
  native('encode', 'slow.wav', '-o', 'slow.pacb', '--format', 'packed', '-y', '-q')
  check('a slow sound gives the clip of the program', same(await encode(readWav(slow), { name: 'slow', source: 'slow.wav', format: 'packed' }), readFileSync(join(folder, 'slow.pacb'))))

  // Markers, and six channels with their places.
  const { samples: one } = readWav(bytesOfFile), frames = 20000, six = Buffer.alloc(68 + 12 * frames)
  six.write('RIFF', 0)
  six.writeUInt32LE(60 + 12 * frames, 4)
  six.write('WAVEfmt ', 8)
  for (const [at, value] of [[16, 40], [20, 0xfffe | 6 << 16], [24, 48000], [28, 576000], [32, 12 | 16 << 16], [36, 22 | 16 << 16], [40, 0x3f], [44, 1], [48, 0x00100000], [52, 0xaa000080], [56, 0x719b3800], [64, 12 * frames]])
    six.writeUInt32LE(value >>> 0, at)
  six.write('data', 60)
  for (let n = 0; n < frames; ++n) for (let c = 0; c < 6; ++c) six.writeInt16LE(Math.round(6000 * Math.sin(n * (c + 1) / 90) + 2000 * one[n]), 68 + 12 * n + 2 * c)
  const cue = Buffer.alloc(80)
  cue.write('cue ', 0)
  for (const [at, value] of [[4, 52], [8, 2], [12, 1], [32, 4800], [36, 2], [56, 9000]]) cue.writeUInt32LE(value, at)
  cue.write('LIST', 60)
  cue.writeUInt32LE(12, 64)
  cue.write('adtllabl', 68)
  const marked = Buffer.concat([bytesOfFile, cue])
  for (const [name, bytes] of [['six', six], ['marked', marked]]) {
    writeFileSync(join(folder, `${name}.wav`), bytes)
    native('encode', `${name}.wav`, '-o', `${name}.pacb`, '--format', 'packed', '-y', '-q')
    const wanted = readFileSync(join(folder, `${name}.pacb`)), options = { name, source: `${name}.wav`, format: 'packed' }
    const whole = readWav(bytes), parts = pacini.openSound((at, length) => bytes.subarray(at, at + length), bytes.length)
    check(`a sound with ${name === 'six' ? 'six channels' : 'markers'} gives the clip of the program`, same(await encode(whole, options), wanted) && same(await encode(parts, options), wanted) &&
      (name === 'six' ? whole.lowFrequency === 3 : whole.markers.length === 2))
  }

  // The live translator with its parameters, whichever way they come: the samples of the program.
  const { Translator, translatorParameters } = await import(join(installed, 'translator.js'))
  const { default: profiles } = await import(join(installed, 'profiles.js'))
  const { samples: mono, sampleRate: spokenRate } = readWav(readFileSync(new URL('../analysis/spoken_sentence.wav', import.meta.url)))
  writeFileSync(join(folder, 'l5.json'), JSON.stringify(profiles['l5-wristband']))
  const driven = (...words) => execFileSync(live, [String(spokenRate), 'l5.json', ...words],
    { cwd: folder, input: new Uint8Array(mono.buffer, mono.byteOffset, mono.byteLength), maxBuffer: 1e8 })
  const translated = async (options, change = () => {}) => {
    const translator = await Translator.create({ sampleRate: spokenRate, profile: 'l5-wristband', ...options })
    await change(translator)
    const drive = new Float32Array(mono.length)
    for (let done = 0, block = 1; done < mono.length; done += block, block = block * 7 % 4099 + 1) drive.set(translator.process(mono.subarray(done, done + block)), done)
    return drive
  }
  const usualDrive = driven()
  check('the live translator gives the samples of the program', same(await translated({}), usualDrive))
  for (const one of [{ speech: 0 }, { audible: 0.1 }, { intensity: -12, inputGain: 6 }, { rumble: -60, transientsMuted: true }, { transposition: 7, direct: 0 }]) {
    const name = Object.keys(one).join(', '), document = { format: 'pacini.settings', version: 1, live: one }
    writeFileSync(join(folder, 'live.json'), JSON.stringify(document))
    const wanted = driven('live.json'), other = { ...document, live: { ...one, [Object.keys(one)[0]]: 0.5 } }
    const ways = [one, { settings: document }, { settings: JSON.stringify(document) }, { settings: other, ...one }]
    const drives = await Promise.all(ways.map((options) => translated(options)))
    drives.push(await translated({}, (translator) => translator.set(one)))
    check(`and with ${name}`, drives.every((drive) => same(drive, wanted)) && wanted.compare(usualDrive) !== 0,
      drives.map((drive) => same(drive, wanted)).join())
  }
  const described = await translatorParameters(), ranges = JSON.parse(native('encode', '--print-settings', '--json')).play.live
  check('parameters of the live translator are those of the program', JSON.stringify(described) === JSON.stringify(ranges))
  const beyond = described.filter(({ highest }) => highest !== undefined)
  const refusals = await Promise.all(beyond.map(({ name, highest }) => fails(() => Translator.create({ [name]: highest + 1 }))))
  check('and have their ranges', beyond.length >= 13 && refusals.every((error, i) => error instanceof PaciniError && error.where === beyond[i].name), refusals[0]?.message)

  // What is wrong.
  const broken = (value) => {
    const samples = Float32Array.from(Array.isArray(sound.samples) ? sound.samples[0] : sound.samples)
    samples[1000] = value
    return { samples, sampleRate: sound.sampleRate }
  }
  check('samples that are no numbers count as silence where that is asked for',
    (await compare(sound, broken(1e30), { allowNan: true })).notFinite === 1)
  const wrong = [
    ['no rate', () => encode({ samples: new Float32Array(10) }), 'sampleRate'],
    ['no samples', () => encode({ samples: 'x', sampleRate: 48000 }), 'samples'],
    ['not a number', () => encode({ samples: new Float32Array([0, NaN]), sampleRate: 48000 }), 'frame 1, channel 0'],
    ['an absurd number', () => encode({ samples: new Float32Array([0, 1e30]), sampleRate: 48000 }), 'frame 1, channel 0'],
    ['a comparison with what is not a number', () => compare(sound, broken(NaN)), 'candidate[1000]'],
    ['a comparison of what is not a number', () => compare(broken(Infinity), sound), 'reference[1000]'],
    ['a comparison with what is no sound', () => compare(sound, broken(1e30)), 'candidate[1000]'],
    ['an unknown method', () => encode(sound, { method: 'x' }), 'method'],
    ['an option out of range', () => encode(sound, { bands: 33 }), 'bands'],
    ['an option of another method', () => encode(sound, { method: 'decomposition', bands: 4 }), 'bands'],
    ['an option that is not known', () => encode(sound, { bnads: 4 }), 'bnads'],
    ['a choice that is not known', () => encode(sound, { spacing: 'linaer' }), 'spacing'],
    ['settings of another kind', () => encode(sound, { settings: { format: 'pacini.clip', version: 1 } }), 'settings.format'],
    ['a wrong preset', () => encode(sound, { preset: 'musik' }), 'preset'],
    ['a wrong setting', () => encode(sound, { settings: settings({ bands: 99 }) }), 'settings.encode.bands'],
    ['an absurdly large sample', () => encode({ samples: new Float32Array([0, 1e30]), sampleRate: 48000 }), 'frame 1, channel 0'],
    ['an export option that changes nothing', () => write(clip, { format: 'haptic', sampleRate: 4000 }), 'sampleRate'],
    ['an export option of Pacini\'s own format', () => write(clip, { points: 4 }), 'points'],
    ['a sample rate that the writer does not take', () => write(clip, { format: 'openxr', sampleRate: 100000 }), 'sampleRate'],
    ['no points', () => write(clip, { format: 'haptic', points: 0 }), 'points'],
    ['garbage', () => read(new Uint8Array([1, 2, 3])), 'clip'],
    ['nothing', () => encode(), 'sound'],
    ['a marker without a name', () => encode({ ...sound, markers: [{ time: 0 }] }), 'markers[0].name'],
    ['a channel that is not there', () => encode({ ...sound, lowFrequency: 7 }), 'lowFrequency'],
    ['bytes for a sound', () => encode(bytesOfFile), 'sound'],
    ['a number for a sound', () => encode(4), 'sound'],
    ['an unknown option of render', () => render(clip, { gian: 3 }), 'gian'],
    ['an unknown option of write', () => write(clip, { format: 'ahap', pionts: 3 }), 'pionts'],
    ['a render option out of range', () => render(clip, { strength: 2 }), 'strength'],
    ['a strength without an actuator', () => render(clip, { strength: 0.5 }), 'strength'],
    ['a mapping where nothing is adapted', () => render(clip, { profile: 'lra-175', adapt: false, mapping: 'fold' }), 'mapping'],
    ['a frequency of no pulses', () => render(clip, { pulseFrequency: 40 }), 'pulseFrequency'],
    ['a wearer of a drive', () => render(clip, { profile: 'l5-wristband', wearer: 3 }), 'wearer'],
    ['an end before the start', () => render(clip, { start: 0.2, end: 0.1 }), 'end'],
    ['an unknown choice of render', () => render(clip, { mapping: 'flod' }), 'mapping'],
    ['samples that are no samples', () => compare(sound, { samples: [1, 2], sampleRate: 48000 }), 'samples'],
    ['an unknown format', () => write(clip, { format: 'x' }), 'format'],
    ['an edit of an unknown kind', () => pacini.reapply(clip, clip, [{ kind: 'x' }]), 'edits[0].kind'],
    ['an edit that is no number', () => pacini.reapply(clip, clip, [{ kind: 'points', lane: 'envelope', from: 0, to: 'x', points: [], frequencies: [], clipDuration: 1 }]), 'edits[0].to'],
    ['an unknown profile', () => render(clip, { profile: 'x' }), 'profile'],
    ['reports of an unknown controller', () => reports(clip, { vendor: 1, product: 2 }), '0001:0002'],
    ['an unknown parameter of the live translator', () => Translator.create({ spech: 0 }), 'spech'],
    ['live settings without live parameters', () => Translator.create({ settings: { format: 'pacini.settings', version: 1 } }), 'settings.live'],
    ['a live parameter of settings out of range', () => Translator.create({ settings: { format: 'pacini.settings', version: 1, live: { speech: 2 } } }), 'settings.live.speech'],
    ['live settings that are no JSON', () => Translator.create({ settings: '{' }), 'settings'],
    ['live settings that are none', () => Translator.create({ settings: '[]' }), 'settings'],
    ['too many bands of the live translator', () => Translator.create({ bands: 13 }), 'bands'],
    ['half a band of the live translator', () => Translator.create({ bands: 1.5 }), 'bands'],
    ['too much boost in the live translator', () => Translator.create({ maxBoost: 41 }), 'maxBoost'],
    ['a strength that is none', () => Translator.create({ strength: '1' }), 'strength'],
    ['a profile of the live translator that is none', () => Translator.create({ profile: '{}' }), 'profile'],
    ['a change of what is fixed', async () => (await Translator.create()).set({ bands: 2 }), 'bands'],
    ['a change out of range', async () => (await Translator.create()).set({ attack: -1 }), 'attack'],
    ['a block that is none', async () => (await Translator.create()).process([1]), 'block'],
    ['no WAV', async () => readWav(new Uint8Array(50)), 'sound file'],
    ['a WAV without samples', async () => readWav(new TextEncoder().encode('RIFF....WAVE')), 'sound file']
  ]
  for (const [what, work, where] of wrong) {
    const error = await fails(work)
    check(`error: ${what}`, error instanceof PaciniError && error.where !== '' && error.where.startsWith(where) && error.message.startsWith(`${error.where}: `) && error.code.length > 0, error?.message)
  }
  const stopped = new AbortController()
  const long = { samples: new Float32Array(480000), sampleRate: 48000 }
  const reason = await fails(() => encode(long, { signal: stopped.signal, progress: () => stopped.abort() }))
  check('a signal stops a call', reason?.name === 'AbortError')
  check('and the next one works', (await encode(sound)).duration === clip.duration)

  // Memory of ten minutes, and speed beside the program's.
  const ten = new Float32Array(600 * 44100)
  const source = sound.samples instanceof Float32Array ? sound.samples : sound.samples[0]
  for (let n = 0; n < ten.length; ++n) ten[n] = source[n % source.length]
  const started = performance.now()
  await encode({ samples: ten, sampleRate: 44100 })
  const seconds = (performance.now() - started) / 1000
  const megabytes = pacini.memoryInUse() / 1e6
  check('ten minutes take less than 100 MB', megabytes < 100, `${megabytes.toFixed(1)} MB, ${(600 / seconds).toFixed(0)} times real time`)
  for (const file of readdirSync(installed).filter((name) => name.endsWith('.wasm'))) {
    const wasm = readFileSync(join(installed, file))
    console.log(`     ${file}: ${wasm.length} bytes, ${gzipSync(wasm, { level: 9 }).length} gzipped`)
  }

  // The types, read by the compiler that people have: two settings of how modules are found.
  cpSync(new URL('types.ts', import.meta.url), join(folder, 'types.ts'))
  for (const [module, resolution] of [['nodenext', 'nodenext'], ['esnext', 'bundler']]) {
    let said = ''
    try {
      execFileSync('node', [join(modules, 'node_modules/typescript/bin/tsc'), '--strict', '--noEmit', '--target', 'es2022',
        '--module', module, '--moduleResolution', resolution, '--lib', 'es2022,dom', 'types.ts'], { cwd: folder, encoding: 'utf8' })
    } catch (error) {
      said = error.stdout
    }
    check(`types, modules found as ${resolution} does`, said === '', said)
  }

  // In browsers: by bundlers as their users set them up, and by an import map. What comes out must run, with its modules beside it.
  const site = join(folder, 'site')
  mkdirSync(site)
  const readme = readFileSync(join(installed, 'README.md'), 'utf8')
  const said = (language, mark) => [...readme.matchAll(/```(\w+)\n(.*?)```/gs)].find(([, name, text]) => name === language && text.includes(mark))?.[2] ?? ''
  const script = "import { encode, felt } from 'pacini'\nimport { createTranslator } from 'pacini/translator'\n" +
    "const samples = Float32Array.from({ length: 24000 }, (_, n) => Math.sin(n / 30) * Math.exp(-n / 4000))\n" +
    "const clip = await encode({ samples, sampleRate: 48000 })\nconst skin = await felt(clip, { profile: 'lra-175' })\n" +
    "const node = await createTranslator(new OfflineAudioContext(1, 480, 48000), { profile: 'lra-175' })\n" +
    "globalThis.done = { duration: clip.duration, felt: skin.samples.some((value) => value !== 0), late: node.latency }\n"
  const page = (head) => `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">${head}`
  const tools = join(modules, 'node_modules'), run = (tool, ...words) => execFileSync('node', [join(tools, tool), ...words], { cwd: site, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] })
  mkdirSync(join(site, 'node_modules'))
  cpSync(installed, join(site, 'node_modules/pacini'), { recursive: true })
  writeFileSync(join(site, 'package.json'), '{"type": "module", "private": true}')
  writeFileSync(join(site, 'main.js'), script)
  writeFileSync(join(site, 'index.html'), page('<script type="module" src="./main.js"></script>'))
  const ways = {
    vite: () => {
      writeFileSync(join(site, 'vite.config.js'), said('js', 'optimizeDeps'))
      run('vite/bin/vite.js', 'build', '--outDir', 'vite', '--base', './', '--logLevel', 'error')
      return 'vite/index.html'
    },
    esbuild: () => {
      const [, ...words] = said('sh', 'esbuild').match(/esbuild ([^\n]*)/)[1].split(' ')
      execFileSync(join(tools, '.bin/esbuild'), ['main.js', ...words, '--log-level=error'], { cwd: site })
      mkdirSync(join(site, 'out'), { recursive: true })
      for (const command of said('sh', 'esbuild').trim().split('\n').slice(1)) execFileSync('sh', ['-c', command], { cwd: site })
      writeFileSync(join(site, 'out/index.html'), page('<script type="module" src="./main.js"></script>'))
      return 'out/index.html'
    },
    rollup: () => {
      writeFileSync(join(site, 'rollup.config.js'), said('js', 'nodeResolve').replaceAll("'@rollup/plugin-node-resolve'", JSON.stringify(join(tools, '@rollup/plugin-node-resolve/dist/es/index.js'))))
      run('rollup/dist/bin/rollup', '--config', '--silent')
      for (const command of said('sh', 'rollup').trim().split('\n').slice(1)) execFileSync('sh', ['-c', command], { cwd: site })
      writeFileSync(join(site, 'rolled/index.html'), page('<script type="module" src="./main.js"></script>'))
      return 'rolled/index.html'
    },
    'an import map': () => {
      writeFileSync(join(site, 'map.html'), page(`${said('html', 'importmap')}<script type="module" src="./main.js"></script>`))
      return 'map.html'
    }
  }
  if (existsSync(join(modules, 'node_modules/puppeteer-core'))) {
    const port = 20000 + process.pid % 20000
    const server = spawn('python3', ['-m', 'http.server', '--bind', '127.0.0.1', String(port)], { cwd: site, stdio: 'ignore' })
    const browser = await launch(modules)
    try {
      await until(async () => (await fetch(`http://127.0.0.1:${port}/`).catch(() => undefined))?.ok)
      for (const [name, build] of Object.entries(ways)) {
        const path = await fails(async () => { ways[name].path = build() }) ?? ways[name].path
        if (path instanceof Error) {
          check(`${name} as the README shows it`, false, path.stderr ?? path.message)
          continue
        }
        const tab = await browser.newPage(), problems = []
        tab.on('pageerror', (error) => problems.push(error.message))
        tab.on('response', (response) => { if (response.status() >= 400) problems.push(`${response.status()} ${response.url()}`) })
        await tab.goto(`http://127.0.0.1:${port}/${path}`)
        await until(() => tab.evaluate(() => globalThis.done !== undefined))
        const done = await tab.evaluate(() => globalThis.done)
        check(`${name} as the README shows it`, done?.duration === 0.5 && done.felt && done.late > 0, problems.join(' '))
        await tab.close()
      }
    } finally {
      await browser.close()
      server.kill()
    }
  }

  // The README, as printed.
  const work = join(folder, 'readme')
  mkdirSync(work)
  cpSync(join(sounds, names[0]), join(work, 'knock.wav'))
  const examples = [...readme.matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]).filter((text) => text.includes("from 'pacini'"))
  check('the README has examples', examples.length >= 4)
  examples.forEach((example, i) => {
    writeFileSync(join(work, 'example.mjs'), example)
    try {
      execFileSync('node', ['example.mjs'], { cwd: work, stdio: ['ignore', 'pipe', 'pipe'] })
      check(`example ${i + 1} of the README`, true)
    } catch (error) {
      check(`example ${i + 1} of the README`, false, error.stderr)
    }
  })
  check('what the first one wrote is there', statSync(join(work, 'knock.json')).size > 100)
} finally {
  rmSync(folder, { recursive: true, force: true })
}
process.exit(failures ? 1 : 0)
