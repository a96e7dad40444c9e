import type { Parameter, ProfileInput } from './index.js'

/** Parameters of the live translator, which change while it runs. */
export interface TranslatorParameters {
  // parameters: live
  /** Gain of the sound before analysis (-60 to 48 dB) [0] */
  inputGain?: number
  /** Gain of the drive (-60 to 24 dB) [0] */
  intensity?: number
  /** Level of sound above 320 Hz, played as a tone of 200 Hz as far as `audible` is below 1; the lowest value switches it off (-60 to 12 dB) [-6] */
  brightness?: number
  /** Amount of sound above the range of touch that is felt in addition to the low part (hi-hats, rain, ticks); 0: none (0 to 1) [1] */
  audible?: number
  /** Amount of speech that is felt; below 1, what sounds like speech is turned down above 75 Hz (0 to 1) [1] */
  speech?: number
  /** Shift in pitch (-48 to 48 semitones) [0] */
  transposition?: number
  /** Share of the band's own signal against its carrier, where the actuator can reproduce it (0 to 1) [1] */
  direct?: number
  /** Attack of the carriers' envelopes (0 to 200 ms) [1] */
  attack?: number
  /** Release of the carriers' envelopes (0 to 1000 ms) [8] */
  release?: number
  /** Sensitivity to events; higher values also turn weaker events into pulses (0 to 1) [0.5] */
  transientSensitivity?: number
  /** Shift in the sharpness of pulses, from duller (-1, 100 Hz) to crisper (1, 280 Hz) (-1 to 1) [0] */
  transientSharpness?: number
  /** Level below which the gate closes (-120 to 0 dB) [-75] */
  gateThreshold?: number
  /** Time that the gate stays open below the threshold (1 to 2000 ms) [60] */
  gateRelease?: number
  /** Level of bands below 100 Hz (-60 to 24 dB) [0] */
  rumble?: number
  /** Mute the bands below 100 Hz [off] */
  rumbleMuted?: boolean
  /** Level of the other bands (-60 to 24 dB) [0] */
  texture?: number
  /** Mute the other bands [off] */
  textureMuted?: boolean
  /** Level of the pulses of events (-60 to 24 dB) [0] */
  transients?: number
  /** Mute the pulses of events [off] */
  transientsMuted?: boolean
  /** Pass the input through, delayed by the latency of the translator [off] */
  bypass?: boolean
  // end
}
export interface TranslatorOptions extends TranslatorParameters {
  /** The actuator; none: a plain drive. */
  profile?: ProfileInput
  /** Settings with the part `live`, as the plugin saves presets: an object, or the text of a file. Parameters come before it. */
  settings?: object | string
  /** Number of bands, 1 to 12. */
  bands?: number
  /** As of render(). */
  maxBoost?: number
  strength?: number
}

/** The live translator, block by block. */
export class Translator {
  private constructor()
  static create(options?: TranslatorOptions & {
    /** Hz: 48000. */
    sampleRate?: number
  }): Promise<Translator>
  /** Delay of the drive against the sound, frames. */
  readonly latency: number
  /** The drive of the next block of mono sound: as many frames. */
  process(block: Float32Array): Float32Array
  /** Changes parameters smoothly; right after reset() at once. */
  set(parameters: TranslatorParameters): Promise<void>
  /** As if nothing was heard yet. */
  reset(): void
}

/** A node that turns sound into the drive signal of an actuator, one channel, `latency` frames late; set() changes parameters smoothly. */
export function createTranslator(
  context: BaseAudioContext,
  options?: TranslatorOptions
): Promise<AudioWorkletNode & { readonly latency: number, set(parameters: TranslatorParameters): Promise<void> }>

/** Of the live translator. */
export function translatorParameters(): Promise<Parameter[]>
