/** Pacini for JavaScript: sounds to haptic clips, clips to what actuators play, and to every format. */

/** What is wrong (message), where, and the kind of error. */
export class PaciniError extends Error {
  readonly code: 'invalidArgument' | 'invalidData' | 'unsupportedVersion' | 'tooLarge' | 'truncated' | 'notFinite' | 'io' | 'diskFull'
  readonly where: string
}

/** Samples within ±1, a Float32Array for one channel or one for each; or what Web Audio decoded. */
export type Sound =
  | { samples: Float32Array | Float64Array | (Float32Array | Float64Array)[], sampleRate: number }
  | { getChannelData(channel: number): Float32Array, numberOfChannels: number, sampleRate: number }

/** A clip as it stands in a `.json` file: see the documentation of the format. */
export interface Clip {
  format: 'pacini.clip'
  version: number
  name?: string
  duration: number
  [key: string]: unknown
}

/** A clip: its object, the text of a `.json` file, or the bytes of a file of any format. */
export type ClipInput = Clip | string | Uint8Array | ArrayBuffer

/** An actuator: a name (see profileNames), or the object or text of a profile. */
export type ProfileInput = string | object

interface Stoppable {
  /** Stops a call that has not begun, or that takes in a sound. */
  signal?: AbortSignal
}

export interface EncodeOptions extends Stoppable {
  /** How the result comes: an object, the text of a `.json` file, or the bytes of a `.pacb` file. */
  format?: 'json' | 'text' | 'packed'
  /** `a2vt` unless another one is named. */
  method?: string
  bands?: number
  /** Per second and band. */
  breakpoints?: number
  /** Bits. */
  quantise?: number
  /** Hz. */
  low?: number
  /** Hz. */
  high?: number
  spacing?: 'log' | 'linear'
  /** 0 to 1. */
  audible?: number
  /** Of events, 0.25 to 4: above 1 there are more. */
  sensitivity?: number
  keepLevel?: boolean
  /** Of the clip. */
  name?: string
  /** Of the sound's file. */
  source?: string
  /** Called with the share of the sound that was taken in, 0 to 1. */
  progress?: (share: number) => void
}

/** Methods that make a drive signal give a Float32Array. */
export function encode(sound: Sound, options: EncodeOptions & { format: 'packed' }): Promise<Uint8Array>
export function encode(sound: Sound, options: EncodeOptions & { format: 'text' }): Promise<string>
export function encode(sound: Sound, options?: EncodeOptions): Promise<Clip>

/** An edit as project files have it: points of a lane between two times replaced, an event added, removed or changed, and others. */
export interface Edit {
  kind: string
  /** Of the band of each lane that it names, Hz. */
  frequencies: { frequency: number }[]
  /** Of the clip that was edited, s. */
  clipDuration: number
  [key: string]: unknown
}
/** Edits over the clip `before`, applied to `after`, another analysis of its sound; those that do not fit wait among `edits`. */
export function reapply(before: ClipInput, after: ClipInput, edits: Edit[], options?: Stoppable):
  Promise<{ clip: Clip, edits: Edit[], unfitting: { edit: number, reason: string }[] }>

/** What encode() and render() do unless they are told otherwise. */
export function defaults(options?: Stoppable): Promise<{ bands: number, breakpoints: number, sensitivity: number, strength: number }>

export interface ReadOptions extends Stoppable {
  /** With its dot: tells formats apart that have no mark. */
  extension?: string
  /** Doubts are errors. */
  strict?: boolean
}
export function read(bytes: ClipInput, options?: ReadOptions): Promise<{ clip: Clip, format: string, warnings: string[] }>

export interface Loss {
  kind: string
  /** Seconds. */
  time: number
  /** Seconds. */
  duration: number
  error: number
  message: string
}
export interface WriteOptions extends Stoppable {
  /** A name that formats() lists: `json` unless another one is named. */
  format?: string
  name?: string
  profile?: ProfileInput
  amplitudePoints?: number
  frequencyPoints?: number
  /** Hz, of formats that are samples. */
  sampleRate?: number
  split?: boolean
  /** Of drive signals for the profile, 0 to 1. */
  strength?: number
  extension?: string
}
export function write(clip: ClipInput, options?: WriteOptions): Promise<{ files: { suffix: string, bytes: Uint8Array }[], losses: Loss[] }>
export function lint(clip: ClipInput, options?: WriteOptions): Promise<Loss[]>

export interface Format {
  name: string
  title: string
  extension: string
  keeps: string
  reads: boolean
  writes: boolean
  samples: boolean
}
export function formats(options?: Stoppable): Promise<Format[]>

export interface RenderOptions extends Stoppable {
  /** Hz: 48000. */
  sampleRate?: number
  profile?: ProfileInput
  /** Of a scene, which names them "0", "1" and so on. */
  clips?: ClipInput[]
  leaveOut?: boolean
  adapt?: boolean
  /** 0 to 1. */
  strength?: number
  /** dB. */
  gain?: number
  /** Semitones. */
  transpose?: number
  stretch?: number
  protect?: boolean
}
export interface FeltOptions extends RenderOptions {
  profile: ProfileInput
  /** 0 to 14: which of the simulated people. */
  wearer?: number
  /** m/s² of a sample of 1: 100. */
  fullScale?: number
}
export interface Rendered {
  /** One for each actuator where a scene has several. */
  samples: Float32Array | Float32Array[]
  sampleRate: number
  actuators: number
  frames: number
  /** dB, the most that was taken to keep the actuator whole. */
  reduction: number
  predictedError: number
  leftOut: { where: string, reason: string, error: number }[]
  adaptations: { where: string, what: string }[]
}
export function render(clip: ClipInput, options?: RenderOptions): Promise<Rendered>
export function felt(clip: ClipInput, options: FeltOptions): Promise<Rendered>

export interface CompareOptions extends Stoppable {
  /** Samples that are no numbers, or far beyond full scale, count as silence (`notFinite` tells how many), and are no error. */
  allowNan?: boolean
}

/** All measures, by their names; null where one says nothing. */
export function compare(sound: Sound, candidate: Sound, options?: CompareOptions): Promise<Record<string, unknown>>

export function profileNames(): string[]
export function profileInfo(profile: ProfileInput, options?: Stoppable): Promise<{ name: string, low: number, high: number, dynamicRange: number, felt: boolean }>

/** The sound in a WAV file, sample for sample as other programs have it. */
export function readWav(bytes: Uint8Array): { samples: Float32Array | Float32Array[], sampleRate: number }

export interface SpectrogramOptions extends Stoppable {
  /** Seconds: the whole sound. */
  from?: number
  to?: number
  /** Pixels: 800. */
  columns?: number
  /** Hz at the top: 2000. */
  high?: number
  dark?: boolean
}
/** The picture of a stretch of a sound: four bytes a pixel, the highest frequency first. */
export function spectrogram(sound: Sound, options?: SpectrogramOptions): Promise<{ width: number, height: number, low: number, high: number, pixels: Uint8Array }>

export interface ReportsOptions extends Stoppable {
  /** USB numbers of the controller's maker and product, which it has on Bluetooth too. */
  vendor: number
  product: number
  bluetooth?: boolean
  /** dB. */
  gain?: number
}
export interface Report {
  /** Seconds from the start. */
  time: number
  /** A feature report. */
  feature: boolean
  /** The first is the report's number. */
  bytes: Uint8Array
}
/** The HID reports that play a clip on a game controller, and those that silence it at any moment. */
export function reports(clip: ClipInput, options: ReportsOptions): Promise<{ reports: Report[], stops: Report[] }>

/** From another place than beside this package: the URL of a folder, or compiled modules by name. Before the first call. */
export function loadFrom(place: URL | Record<string, WebAssembly.Module>): void

/** What the modules take of memory, bytes. */
export function memoryInUse(): number
