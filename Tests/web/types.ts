// What the package says of its types, read by a compiler: each line that must be refused stands under its mark.
import { encode, felt, formats, lint, openSound, PaciniError, profileNames, read, reapply, render, reports, rumble, touch, write } from 'pacini'
import type { Clip, Loss, Marker, RumblePlan, Sound, TouchPlan } from 'pacini'
import { createTranslator, Translator } from 'pacini/translator'

const sound: Sound = { samples: new Float32Array(4800), sampleRate: 48000 }
const decoded: Sound = new AudioBuffer({ length: 1, sampleRate: 48000 })

export const use = async (context: AudioContext): Promise<number> => {
  const clip: Clip = await encode(sound, { bands: 8, signal: new AbortController().signal, progress: (share: number) => share })
  const packed: Uint8Array = await encode(decoded, { format: 'packed' })
  const inParts: Clip = await encode(openSound((at: number, length: number) => new Uint8Array(length - at), 44))
  const loop: Marker | undefined = clip.markers?.find(({ name }) => name === 'loop start')
  const strongest: number = Math.max(...clip.bands.flatMap(({ amplitude }) => amplitude.map((point) => point.amplitude)), loop?.time ?? 0)
  // @ts-expect-error a clip has markers
  clip.markrs?.length
  const text: string = await encode(sound, { format: 'text' })
  const drive = await render(packed, { profile: 'l5-wristband' })
  const skin = await felt(text, { profile: profileNames()[0] })
  const losses: Loss[] = await lint(clip, { format: 'ahap' })
  const { files } = await write(clip, { format: (await formats())[0].name })
  const { reports: bytes } = await reports(clip, { vendor: 0x054c, product: 0x0ce6 })
  const { motors }: RumblePlan = await rumble(packed)
  const { touches }: TouchPlan = await touch(packed)
  const node: AudioWorkletNode = await createTranslator(context, { profile: 'lra-175', settings: '{}', speech: 0 })
  const translator = await Translator.create({ sampleRate: 44100, bands: 4, rumbleMuted: true })
  await translator.set({ audible: 0.5 })
  const block: Float32Array = translator.process(new Float32Array(128))
  // @ts-expect-error parameters have names
  await translator.set({ audibel: 0.5 })
  const { unfitting } = await reapply(clip, packed, [{ kind: 'transient', after: { time: 0, amplitude: 1, sharpness: 0 }, frequencies: [], clipDuration: 1 }])
  const { warnings } = await read(files[0].bytes)
  // @ts-expect-error bands are a number
  await encode(sound, { bands: 'many' })
  // @ts-expect-error a sound has a rate
  await encode({ samples: new Float32Array(1) })
  // @ts-expect-error what is felt needs an actuator
  await felt(clip)
  // @ts-expect-error a controller has numbers
  await reports(clip, {})
  const wrong: unknown = new Error()
  const where: string = wrong instanceof PaciniError ? wrong.where : ''
  return inParts.duration + unfitting.length + drive.frames + skin.frames + losses.length + bytes.length + node.numberOfOutputs + warnings.length + where.length + block.length + strongest
}
