/** Pacini for JavaScript: sounds to haptic clips, clips to what actuators play, and to every format. */

/** What is wrong (message), where, and the kind of error. */
export class PaciniError extends Error {
  readonly code: 'invalidArgument' | 'invalidData' | 'unsupportedVersion' | 'tooLarge' | 'truncated' | 'notFinite' | 'io' | 'diskFull'
  readonly where: string
}

/** Samples within ±1, a Float32Array for one channel or one for each; or what Web Audio decoded. */
export type Sound =
  | { samples: Float32Array | Float64Array | (Float32Array | Float64Array)[], sampleRate: number } & SoundNotes
  | { getChannelData(channel: number): Float32Array, numberOfChannels: number, sampleRate: number }
  | SoundStream

/** What a clip has of a sound beside its samples. */
export interface SoundNotes {
  /** In order of time, s. */
  markers?: Marker[]
  /** The channel of low-frequency effects, from 0, which counts 10 dB more than the others. */
  lowFrequency?: number
}

/** A sound that is read in parts: what openSound() gives, or one's own. */
export interface SoundStream extends SoundNotes {
  sampleRate: number
  channels: number
  frames: number
  /** Begins at the start: a function that fills an array with interleaved samples and returns how many came. */
  reader(): (into: Float32Array) => number
}

/** A WAV or AIFF file that is read in parts. */
export interface SoundFile extends SoundStream {
  /** Frames that the file states, where fewer are there. */
  promised: number
  /** What the program says of the file: sizes and samples that are not as its header has them. */
  warnings: string[]
  /** Samples of each channel. */
  read(from: number, count: number): Float32Array[]
}

/** A named point of time, s. */
export interface Marker {
  time: number
  name: string
}

/** A point of a curve: s, and linear, 1 is full drive. */
export interface AmplitudePoint {
  time: number
  amplitude: number
}

/** A point of a curve: s and Hz. */
export interface FrequencyPoint {
  time: number
  frequency: number
}

/** A band of a clip, which is played as one sinusoid. */
export interface Band {
  /** Hz. */
  lowFrequency: number
  centreFrequency: number
  highFrequency: number
  /** Which bands are kept when voices run out: 0 longest. */
  priority?: number
  amplitude: AmplitudePoint[]
  pitch?: FrequencyPoint[]
  /** Of the carrier at the start, cycles. */
  phase?: number
}

/** A short event: s, linear, and from 0 (dull) to 1 (crisp). */
export interface Transient {
  time: number
  amplitude: number
  sharpness: number
}

/** A clip as it stands in a `.json` file. */
export interface Clip {
  format: 'pacini.clip'
  version: number
  name?: string
  /** s. */
  duration: number
  /** The sound that it was made of. */
  source?: { file?: string, sampleRate?: number, channels?: number }
  /** What the encoder was told. */
  encoder?: Record<string, number | boolean | string>
  /** Total amplitude, to which the sum of the bands is levelled. */
  envelope?: AmplitudePoint[]
  centroid?: FrequencyPoint[]
  bands: Band[]
  transients?: Transient[]
  noise?: { lowFrequency: number, highFrequency: number, amplitude: AmplitudePoint[] }[]
  /** In order of time. A loop of a WAV is two of them, "loop start" and "loop end", then "loop 2 start" and so on. */
  markers?: Marker[]
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
  /** As `pacini encode --print-settings` writes it; the other options come before it. */
  settings?: object
  // presets
  /** Values for a kind of sound; other options override it. */
  preset?: 'effects' | 'fine-detail' | 'small-file' | 'transients-first' | 'steady-texture' | 'low-rumble' | 'as-recorded' | 'music' | 'everything-heard' | 'voice-off'
  // end of presets
  // parameters: encode
  /** Number of frequency bands (1 to 32) [12] */
  bands?: number
  /** Maximum number of breakpoints; simple sounds need fewer (0.5 to 1000 per second and band) [20] */
  breakpoints?: number
  /** Resolution of each value (4 to 16 bits) [6] */
  quantise?: number
  /** Lower end of the bands (1 to 1700 Hz) [30] */
  low?: number
  /** Upper end of the bands (2 to 1800 Hz) [1000] */
  high?: number
  /** Spacing of the bands: log or linear [log] */
  spacing?: 'log' | 'linear'
  /** Sensitivity to events; above 1 weaker events also become transients, below 1 only stronger ones (0.25 to 4) [1] */
  sensitivity?: number
  /** Amount of sound above the range of touch that is felt (hi-hats, rain, ticks); 0: none (0 to 1) [1] */
  audible?: number
  /** How that sound is added: beside the low part, which stays as it is, or instead of it where most of the sound lies above touch [beside] */
  heard?: 'beside' | 'instead'
  /** Amount of speech that is felt; below 1, what sounds like speech is turned down above 75 Hz (0 to 1) [1] */
  speech?: number
  /** Keep the level of the sound instead of raising it to full drive [off] */
  keepLevel?: boolean
  /** Minimum time between two events; an event that follows sooner is dropped (0 to 1 s) [0.01] */
  minimumGap?: number
  /** Level difference to louder neighbours up to which an event is not masked (0 to 120 dB) [8] */
  maskMargin?: number
  /** Rise of the detection threshold for each dB beyond the mask margin, as a fraction of the threshold (0 to 1 per dB) [0.06] */
  maskSlope?: number
  /** Decay of masking with the time between two events (20 to 1000 dB/s) [20] */
  maskRecovery?: number
  /** Level difference to louder neighbours above which an event is always dropped (0 to 120 dB) [27] */
  maskLimit?: number
  /** Level below which events are dropped (-120 to 0 dB) [-90] */
  silence?: number
  /** Attack of the envelope follower (0 to 10 s) [the method's own] */
  attack?: number
  /** Hold time of the envelope follower (0 to 10 s) [the method's own] */
  hold?: number
  /** Release of the envelope follower (0 to 10 s) [the method's own] */
  release?: number
  /** Shorten attack and release by the crest factor of the sound; the given times are the longest [the method's own] */
  crestAdaptive?: boolean
  /** Time constant of the averages of which the crest factor is computed (0.001 to 10 s) [the method's own] */
  crestMemory?: number
  /** High-pass before the analysis; 0 switches it off (0 to 1000 Hz) [the method's own] */
  lowLimit?: number
  /** Low-pass before the analysis; near half the sample rate and above it is off (10 to 384000 Hz) [the method's own] */
  highLimit?: number
  /** Threshold for transients: difference of a fast and a slow envelope (0 to 10) [the method's own] */
  transientThreshold?: number
  /** Peak below which transients are dropped (0 to 1) [the method's own] */
  transientAmplitude?: number
  // end
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
/** What can be set, as it is described everywhere. */
export interface Parameter {
  name: string
  /** Of the command. */
  option: string
  kind: 'number' | 'whole' | 'truth' | 'choice' | 'profile'
  unit: string
  choices?: string[]
  lowest?: number
  highest?: number
  /** Missing where each method has its own. */
  default?: number | boolean | string
  text: string
  group: string
  since: string
  /** Of encoding, that have it. */
  methods?: string[]
  /** Of exports, that have it. */
  formats?: string[]
}
/** Of encode(). */
export function parameters(options?: Stoppable): Promise<Parameter[]>

/** Values of encode() for a kind of sound. */
export interface Preset {
  name: NonNullable<EncodeOptions['preset']>
  purpose: string
  values: Required<Pick<EncodeOptions, 'bands' | 'breakpoints' | 'quantise' | 'low' | 'high' | 'sensitivity' | 'audible' | 'heard' | 'speech'>>
}

/** The presets of encode(); the first is the default. */
export const presets: readonly Preset[]
/** Of write() and lint(), beside the format. */
export function exportParameters(options?: Stoppable): Promise<Parameter[]>

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
  // parameters: export
  /** Maximum number of amplitude points; by default a clip with one voice keeps its points (0.5 to 10000 per second) [the format's own] */
  points?: number
  /** Maximum number of frequency points (0.5 to 10000 per second) [three quarters of the amplitude points] */
  frequencyPoints?: number
  /** Write several files, in formats that allow one or several [off] */
  split?: boolean
  /** Skip the search for the best file (hjif, hmpg): much faster, usually a little less like the sound [off] */
  quick?: boolean
  /** How events are written (haptic, ahap, hjif, hmpg, pulsar): as transients, with the voice ducked around them, or merged into the voice where it is as strong [transients; merged in hjif and hmpg] */
  events?: 'transients' | 'merged'
  /** Maximum number of control points in an Android envelope, at any cost in detail (2 to 1000) [any number] */
  maxPoints?: number
  /** Minimum time between control points; all devices support 20 (1 to 10000 ms) [1] */
  minSegment?: number
  /** Maximum time between control points; all devices support 1000 (2 to 100000 ms) [1000] */
  maxSegment?: number
  /** Sample rate, in formats that contain samples (2000 to 48000 Hz) [the format's own] */
  sampleRate?: number
  /** Balance of fidelity and felt level on resonant actuators, in formats that contain samples: 0 plays as flat as possible, 1 plays everything on the resonance (0 to 1) [0.4] */
  strength?: number
  // end
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
  profile?: ProfileInput
  /** Of a scene, which names them "0", "1" and so on. */
  clips?: ClipInput[]
  leaveOut?: boolean
  adapt?: boolean
  protect?: boolean
  // parameters: render
  /** Sample rate of the output (2000 to 768000 Hz) [48000] */
  sampleRate?: number
  /** Gain; the limiter keeps the result within full drive (1) and the limits of the profile (-120 to 60 dB) [0] */
  gain?: number
  /** Transposition, without a change of length (-96 to 96 semitones) [0] */
  transpose?: number
  /** Length factor, without a change of pitch (0.01 to 100) [1] */
  stretch?: number
  /** Silence before the start (0 to 3600 s) [0] */
  delay?: number
  /** Start of the part to render; earlier parts still shape its beginning (0 to 86400 s) [0] */
  start?: number
  /** End of the part to render (0 to 86400 s) [the end] */
  end?: number
  /** Random variation of the bands; in a scene, for plays without a variation of their own (0 to 1) [0] */
  variation?: number
  /** Scope of the variation: one random factor per breakpoint or per band [breakpoint] */
  variationPer?: 'breakpoint' | 'band'
  /** Frequencies of the sinusoids: fixed centres, pitch curves, or moving with the centroid [as the clip was made] */
  carriers?: 'fixed' | 'pitch' | 'centroid'
  /** Match the sum of the bands to the total envelope [as the clip was made] */
  followEnvelope?: boolean
  /** Waveform of events [as the clip was made] */
  pulse?: 'adaptive' | 'square' | 'sine'
  /** Frequency of square and sine pulses (1 to 2000 Hz) [the actuator's resonance] */
  pulseFrequency?: number
  /** Periods of square and sine pulses (0.1 to 100) [1] */
  pulseCycles?: number
  /** Largest total error from skipping inaudible and imperceptible parts, relative to the whole (-300 to 0 dB) [-60] */
  tolerance?: number
  /** Mapping of frequencies outside the actuator's range: clamped to its ends, rescaled to fit, or folded by octaves [as the profile says] */
  mapping?: 'clamp' | 'rescale' | 'fold'
  /** Largest boost for flattening the actuator's resonance; 0 leaves the resonance as it is (0 to 40 dB) [6] */
  maxBoost?: number
  /** Balance of fidelity and felt level on resonant actuators: 0 plays as flat as possible, 1 plays everything on the resonance (0 to 1) [0.4] */
  strength?: number
  // end
}
export interface FeltOptions extends RenderOptions {
  profile: ProfileInput
  // parameters: felt
  /** Acceleration that a sample of 1 stands for (0.001 to 1000000 m/s^2) [100] */
  fullScale?: number
  /** Wearer: 0 has the skin of the profile, 1 to 14 are simulated people with half to twice its mass, stiffness and damping (assumed) (0 to 14) [0] */
  wearer?: number
  // end
}
export interface Rendered {
  /** One for each actuator where a scene has several. */
  samples: Float32Array | Float32Array[]
  sampleRate: number
  actuators: number
  frames: number
  /** dB, the most that was taken to keep the actuator whole. */
  reduction: number
  /** dB below the whole, of all that is not played: what nobody feels, and what the actuator cannot play. */
  predictedError: number
  leftOut: { where: string, reason: string, error: number, unplayable: boolean }[]
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

/**
 * A WAV or AIFF file (8 to 32 bits, floating point, mu-law, A-law, in WAV also ADPCM) that is read in parts, sample for sample as
 * other programs have it: `bytesAt` gives bytes of the file from a place on, `size` is how many it has. Throws a PaciniError with
 * `where: 'sound file'`.
 */
export function openSound(bytesAt: (at: number, length: number) => Uint8Array, size: number): SoundFile
/** All of such a file. */
export function readSound(bytes: Uint8Array): { samples: Float32Array | Float32Array[], sampleRate: number, warnings: string[] } & SoundNotes
/** The same, by its older name. */
export function readWav(bytes: Uint8Array): { samples: Float32Array | Float32Array[], sampleRate: number, warnings: string[] } & SoundNotes

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

export interface RumblePlan {
  /** Numbers for a strong and a weak motor by turns, 0 to 1, by the curves of an Xbox controller. */
  motors: Float32Array
  /** Seconds from one pair of levels to the next. */
  interval: number
}
/** What the two motors of a controller play of a clip, of which no more than an hour is felt. */
export function rumble(clip: ClipInput, options?: Stoppable): Promise<RumblePlan>

export interface TouchPlan {
  /** When the motor is on: start and end, ms. */
  touches: [number, number][]
  /** Events of the clip, and those of them that come too soon after another to be a touch of their own. */
  events: number
  leftOut: number
}
/** When a motor that is only on or off, such as a phone's, is on while a clip plays, of which no more than an hour is felt. */
export function touch(clip: ClipInput, options?: Stoppable): Promise<TouchPlan>

/** From another place than beside this package: the URL of a folder, or compiled modules by name. Before the first call. */
export function loadFrom(place: URL | Record<string, WebAssembly.Module>): void

/** What the modules take of memory, bytes. */
export function memoryInUse(): number
