/**
 * Pacini's runtime for Node.js: haptic clips that play at once on several actuators. Needs koffi and libpacini.
 *
 *     import { Clip, Engine } from 'pacini';
 *     const engine = new Engine({ actuators: [{ profile: 'lra-175' }] });
 *     engine.play(Clip.load('knock.pacb'));
 *     const drive = engine.render(new Float32Array(256));
 *
 * What fails throws a PaciniError with the reason in words. Engines and clips that nothing refers to any more are destroyed
 * and released by the garbage collector, or earlier by destroy() and release().
 *
 * SPDX-License-Identifier: MIT
 */
import koffi from 'koffi';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

/** The library: where PACINI_LIBRARY says, beside this file, or where the system looks for libraries. */
function loadLibrary() {
  const name = { win32: 'pacini.dll', darwin: 'libpacini.dylib' }[process.platform] ?? 'libpacini.so';
  const beside = fileURLToPath(new URL(name, import.meta.url));
  return koffi.load(process.env.PACINI_LIBRARY || (existsSync(beside) ? beside : name));
}

const library = loadLibrary();
const apiVersion = library.func('uint32_t pacini_api_version()');
if (apiVersion() < 1005 || apiVersion() >= 2000) {
  throw new Error(`libpacini has the interface ${apiVersion() / 1000}, this module is for 1.5 or a newer 1.x`);
}

// What pacini.h 1.5 declares.
// Handles are structs of one uint64_t to C, passed as that number is; here they are the number, a BigInt.
for (const kind of ['clip', 'texture', 'engine', 'play', 'controller']) koffi.alias(`pacini_${kind}`, 'uint64_t');
const structs = {};
structs.pacini_clip_info = koffi.struct('pacini_clip_info', {
  struct_size: 'uint32_t', events: 'uint32_t', duration: 'double', bytes: 'uint64_t', name: koffi.array('char', 64, 'String'),
});
structs.pacini_marker_info = koffi.struct('pacini_marker_info', {
  struct_size: 'uint32_t', index: 'uint32_t', time: 'double', name: koffi.array('char', 128, 'String'),
});
structs.pacini_actuator = koffi.struct('pacini_actuator', { profile: 'const char *', gain: 'double', delay: 'double' });
structs.pacini_engine_config = koffi.struct('pacini_engine_config', {
  struct_size: 'uint32_t', actuator_count: 'uint32_t', sample_rate: 'double',
  actuators: koffi.array('pacini_actuator', 16), pan_law: 'int32_t', protect: 'int32_t', pan_delay: 'double',
  longest_delay: 'double', strength: 'double', max_plays: 'uint32_t', max_commands: 'uint32_t', budget: 'double',
  budget_frames: 'uint32_t', budget_voices: 'uint32_t',
});
structs.pacini_engine_info = koffi.struct('pacini_engine_info', {
  struct_size: 'uint32_t', latency: 'uint32_t', frame: 'int64_t', playing: 'uint32_t', left_out: 'uint32_t',
  cost: 'double', left_out_error: 'double', gain_reduction: 'double',
});
structs.pacini_play_settings = koffi.struct('pacini_play_settings', {
  struct_size: 'uint32_t', group: 'uint32_t', frame: 'int64_t', gain: 'double', intensity: 'double', pan: 'double',
  delay: 'double', transposition: 'double', speed: 'double', from: 'double', loop: 'double', passes: 'uint32_t',
  priority: 'int32_t', headroom: 'double', fade_in: 'double', variation: 'double', seed: 'uint64_t',
});
structs.pacini_play_info = koffi.struct('pacini_play_info', { struct_size: 'uint32_t', state: 'int32_t', position: 'double' });
structs.pacini_controller_info = koffi.struct('pacini_controller_info', {
  struct_size: 'uint32_t', haptics: 'int32_t', connection: 'int32_t', name: koffi.array('char', 128, 'String'),
  path: koffi.array('char', 256, 'String'),
});
structs.pacini_attach_settings = koffi.struct('pacini_attach_settings', { struct_size: 'uint32_t', stop_on_crash: 'int32_t' });
structs.pacini_attachment_info = koffi.struct('pacini_attachment_info', {
  struct_size: 'uint32_t', state: 'int32_t', controller: 'pacini_controller', sent: 'uint64_t',
  failure: koffi.array('char', 128, 'String'),
});

const c = {
  resultText: library.func('const char *pacini_result_text(int result)'),
  lastError: library.func('size_t pacini_last_error(uint8_t *text, size_t size)'),
  clipLoad: library.func('int pacini_clip_load(const void *bytes, size_t size, _Out_ pacini_clip *clip)'),
  clipLoadFile: library.func('int pacini_clip_load_file(const char *path, _Out_ pacini_clip *clip)'),
  textureLoad: library.func('int pacini_texture_load(const void *bytes, size_t size, _Out_ pacini_texture *texture)'),
  textureLoadFile: library.func('int pacini_texture_load_file(const char *path, _Out_ pacini_texture *texture)'),
  textureRelease: library.func('int pacini_texture_release(pacini_texture texture)'),
  textureStart: library.func(
    'int pacini_texture_start(pacini_engine engine, pacini_texture texture, double speed, double force, pacini_play_settings *settings, _Out_ pacini_play *play)'),
  clipReload: library.func('int pacini_clip_reload(pacini_clip clip, const void *bytes, size_t size)'),
  clipInfoInit: library.func('void pacini_clip_info_init(_Out_ pacini_clip_info *info)'),
  clipGetInfo: library.func('int pacini_clip_get_info(pacini_clip clip, _Inout_ pacini_clip_info *info)'),
  clipCountMarkers: library.func('int pacini_clip_count_markers(pacini_clip clip, _Out_ uint32_t *count)'),
  markerInfoInit: library.func('void pacini_marker_info_init(_Out_ pacini_marker_info *info)'),
  clipGetMarker: library.func(
    'int pacini_clip_get_marker(pacini_clip clip, uint32_t index, _Inout_ pacini_marker_info *info)'),
  clipFindMarker: library.func(
    'int pacini_clip_find_marker(pacini_clip clip, const char *name, uint32_t index, _Inout_ pacini_marker_info *info)'),
  clipRelease: library.func('int pacini_clip_release(pacini_clip clip)'),
  engineConfigInit: library.func('void pacini_engine_config_init(_Out_ pacini_engine_config *config)'),
  engineCreate: library.func('int pacini_engine_create(pacini_engine_config *config, _Out_ pacini_engine *engine)'),
  engineCreateScene: library.func(
    'int pacini_engine_create_scene(pacini_engine_config *config, const char *scene_path, _Out_ pacini_engine *engine)'),
  engineDestroy: library.func('int pacini_engine_destroy(pacini_engine engine)'),
  renderInterleaved: library.func(
    'int pacini_render_interleaved(pacini_engine engine, _Inout_ float *samples, uint32_t channel_count, uint32_t frames)'),
  engineInfoInit: library.func('void pacini_engine_info_init(_Out_ pacini_engine_info *info)'),
  engineGetInfo: library.func('int pacini_engine_get_info(pacini_engine engine, _Inout_ pacini_engine_info *info)'),
  engineSetBudget: library.func(
    'int pacini_engine_set_budget(pacini_engine engine, double microseconds, uint32_t frames, uint32_t voices)'),
  engineCalibrate: library.func('int pacini_engine_calibrate(pacini_engine engine, double factor, _Out_ double *used)'),
  engineSetActuatorGain: library.func(
    'int pacini_engine_set_actuator_gain(pacini_engine engine, uint32_t actuator, double gain, double glide, int64_t frame)'),
  playSettingsInit: library.func('void pacini_play_settings_init(_Out_ pacini_play_settings *settings)'),
  playStart: library.func(
    'int pacini_play_start(pacini_engine engine, pacini_clip clip, pacini_play_settings *settings, _Out_ pacini_play *play)'),
  playSet: library.func('int pacini_play_set(pacini_play play, int32_t control, double value, double glide, int64_t frame)'),
  playStop: library.func('int pacini_play_stop(pacini_play play, double fade, int64_t frame)'),
  playPause: library.func('int pacini_play_pause(pacini_play play, double fade, int64_t frame)'),
  playResume: library.func('int pacini_play_resume(pacini_play play, double fade, int64_t frame)'),
  playSeek: library.func('int pacini_play_seek(pacini_play play, double position, int64_t frame)'),
  playInfoInit: library.func('void pacini_play_info_init(_Out_ pacini_play_info *info)'),
  playGetInfo: library.func('int pacini_play_get_info(pacini_play play, _Inout_ pacini_play_info *info)'),
  groupSet: library.func(
    'int pacini_group_set(pacini_engine engine, uint32_t group, int32_t control, double value, double glide, int64_t frame)'),
  groupStop: library.func('int pacini_group_stop(pacini_engine engine, uint32_t group, double fade, int64_t frame)'),
  controllersFind: library.func(
    'int pacini_controllers_find(_Out_ pacini_controller *controllers, uint32_t capacity, _Out_ uint32_t *count)'),
  controllerInfoInit: library.func('void pacini_controller_info_init(_Out_ pacini_controller_info *info)'),
  controllerGetInfo: library.func('int pacini_controller_get_info(pacini_controller controller, _Inout_ pacini_controller_info *info)'),
  attachSettingsInit: library.func('void pacini_attach_settings_init(_Out_ pacini_attach_settings *settings)'),
  engineAttach: library.func(
    'int pacini_engine_attach(pacini_engine engine, pacini_controller controller, pacini_attach_settings *settings)'),
  engineDetach: library.func('int pacini_engine_detach(pacini_engine engine)'),
  attachmentInfoInit: library.func('void pacini_attachment_info_init(_Out_ pacini_attachment_info *info)'),
  engineGetAttachment: library.func('int pacini_engine_get_attachment(pacini_engine engine, _Inout_ pacini_attachment_info *info)'),
};

/** Of the tests: the structs as koffi lays them out. */
export const layout = structs;
/** Version of the interface of the library: major * 1000 + minor. */
export const version = apiVersion();

const codes = ['ok', 'invalid', 'stale', 'bad data', 'newer', 'too many', 'io', 'no memory', 'internal', 'busy'];
const controls = { gain: 0, intensity: 1, pan: 2, delay: 3, transposition: 4, speed: 5, priority: 6,
  tones: 7, events: 8, noise: 9, textureSpeed: 10, textureForce: 11 };
const panLaws = { power: 0, delay: 1, both: 2 };
const states = ['ended', 'waiting', 'playing', 'paused', 'left out'];
const haptics = ['HD rumble', 'DualShock 4', 'DualSense', 'Xbox', 'waveforms', 'Steam Controller', 'Steam Deck'];
const connections = ['unknown', 'USB', 'Bluetooth', 'receiver'];
const attachments = ['detached', 'attached', 'gone'];
// Keys of objects to fields of structs.
const configFields = {
  sampleRate: 'sample_rate', panDelay: 'pan_delay', longestDelay: 'longest_delay', strength: 'strength',
  maxPlays: 'max_plays', maxCommands: 'max_commands', budget: 'budget', budgetFrames: 'budget_frames',
  budgetVoices: 'budget_voices',
};
const settingFields = {
  group: 'group', frame: 'frame', gain: 'gain', intensity: 'intensity', pan: 'pan', delay: 'delay',
  transposition: 'transposition', speed: 'speed', from: 'from', loop: 'loop', passes: 'passes', priority: 'priority',
  headroom: 'headroom', fadeIn: 'fade_in', variation: 'variation', seed: 'seed',
};

/** `code` is one of 'invalid', 'stale', 'bad data', 'newer', 'too many', 'io', 'no memory', 'internal', 'busy'. */
export class PaciniError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'PaciniError';
    this.code = code;
  }
}

/** Throws what the library says of a call that failed. */
function check(result) {
  if (result === 0) return;
  const text = new Uint8Array(c.lastError(null, 0));
  c.lastError(text, text.length);
  // What C calls max_plays is maxPlays here.
  const said = new TextDecoder().decode(text.subarray(0, -1))
    .replace(/^[a-z]+(_[a-z]+)+(?=:)/, (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase()));
  throw new PaciniError(codes[result], said || c.resultText(result));
}

function filled(init) {
  const struct = {};
  init(struct);
  return struct;
}

function fill(struct, fields, given, what) {
  for (const [key, value] of Object.entries(given)) {
    if (!(key in fields)) throw new PaciniError('invalid', `${what} has no '${key}'`);
    struct[fields[key]] = value;
  }
  return struct;
}

function number(names, given, what) {
  if (!(given in names)) throw new PaciniError('invalid', `there is no ${what} '${given}'`);
  return names[given];
}

/** A value of one class; another, whose memory the library would read in its own way, is refused. */
function needs(value, type, what) {
  if (!(value instanceof type))
    throw new PaciniError('invalid', `${what} must be a ${type.name}, not ${value?.constructor?.name ?? value}`);
  return value;
}

const clips = new FinalizationRegistry((handle) => c.clipRelease(handle));
const textures = new FinalizationRegistry((handle) => c.textureRelease(handle));
const engines = new FinalizationRegistry((handle) => c.engineDestroy(handle));

/** What a hand feels of a surface: made of a recording by `pacini texture analyse`, played by speed and force. */
export class Texture {
  #handle;

  constructor(handle) {
    this.#handle = handle;
    textures.register(this, handle, this);
  }

  /** From a file. */
  static load(path) {
    const out = [0n];
    check(c.textureLoadFile(path, out));
    return new Texture(out[0]);
  }

  /** From the bytes of such a file, a Uint8Array. */
  static fromBytes(bytes) {
    needs(bytes, Uint8Array, 'bytes');
    const out = [0n];
    check(c.textureLoad(bytes, bytes.length, out));
    return new Texture(out[0]);
  }

  get handle() { return this.#handle; }

  /** What plays of it goes on. */
  release() {
    check(c.textureRelease(this.#handle));
    textures.unregister(this);
    this.#handle = 0n;
  }
}

/** A haptic clip in memory. It can play as often as one likes, on any engine. */
export class Clip {
  #handle;

  constructor(handle) {
    this.#handle = handle;
    clips.register(this, handle, this);
  }

  /** From a file of any format that Pacini reads. */
  static load(path) {
    const out = [0n];
    check(c.clipLoadFile(path, out));
    return new Clip(out[0]);
  }

  /** From the bytes of such a file, a Uint8Array. */
  static fromBytes(bytes) {
    needs(bytes, Uint8Array, 'bytes');
    const out = [0n];
    check(c.clipLoad(bytes, bytes.length, out));
    return new Clip(out[0]);
  }

  /** Clips of several such files' bytes, Uint8Arrays: all, or none and an error about the first that is none. */
  static allFromBytes(all) {
    const clips = [];
    try {
      for (const bytes of all) clips.push(Clip.fromBytes(bytes));
    } catch (error) {
      for (const clip of clips) clip.release();
      throw new PaciniError(error.code, `bytes[${clips.length}]: ${error.message}`);
    }
    return clips;
  }

  get handle() { return this.#handle; }

  /** Puts other content in its place; what plays of it fades over. */
  reload(bytes) { check(c.clipReload(this.#handle, needs(bytes, Uint8Array, 'bytes'), bytes.length)); }

  /** name, duration (s), events, bytes */
  get info() {
    const info = filled(c.clipInfoInit);
    check(c.clipGetInfo(this.#handle, info));
    return { name: info.name, duration: info.duration, events: info.events, bytes: Number(info.bytes) };
  }

  /** In order of time: index (from 0), time (s) and name of each. A loop of a WAV is two: 'loop start' and 'loop end'. */
  get markers() {
    const count = [0];
    check(c.clipCountMarkers(this.#handle, count));
    return Array.from({ length: count[0] }, (_, index) => {
      const info = filled(c.markerInfoInit);
      check(c.clipGetMarker(this.#handle, index, info));
      return { index: info.index, time: info.time, name: info.name };
    });
  }

  /** The first marker with this name, from the marker `index` on. */
  findMarker(name, index = 0) {
    const info = filled(c.markerInfoInit);
    check(c.clipFindMarker(this.#handle, name, index, info));
    return { index: info.index, time: info.time, name: info.name };
  }

  /** What plays of it goes on to its end. */
  release() {
    check(c.clipRelease(this.#handle));
    clips.unregister(this);
    this.#handle = 0n;
  }
}

/** Plays clips on up to 16 actuators. */
export class Engine {
  #handle;
  #actuators;

  /**
   * May have sampleRate, actuators (each with profile, gain, delay), panLaw ('power', 'delay', 'both'), protect, panDelay,
   * longestDelay, strength, maxPlays, maxCommands, budget, budgetFrames, budgetVoices, and scene, the path of a scene file
   * that plays by itself.
   */
  constructor({ actuators = [{}], panLaw, protect, scene, ...rest } = {}) {
    const config = fill(filled(c.engineConfigInit), configFields, rest, 'the configuration of an engine');
    if (panLaw !== undefined) config.pan_law = number(panLaws, panLaw, 'pan law');
    if (protect !== undefined) config.protect = protect ? 1 : 0;
    config.actuator_count = actuators.length;
    actuators.slice(0, 16).forEach((actuator, i) => {
      fill(config.actuators[i], { profile: 'profile', gain: 'gain', delay: 'delay' }, actuator, 'an actuator');
    });
    const out = [0n];
    check(scene === undefined ? c.engineCreate(config, out) : c.engineCreateScene(config, scene, out));
    this.#handle = out[0];
    this.#actuators = actuators.length;
    engines.register(this, out[0], this);
  }

  /**
   * Starts a clip. `settings` may have group, frame, gain, intensity, pan, delay, transposition, speed, from, loop, passes,
   * priority, headroom, fadeIn, variation and seed.
   */
  play(clip, settings = {}) {
    const struct = fill(filled(c.playSettingsInit), settingFields, settings, 'a play');
    const out = [0n];
    check(c.playStart(this.#handle, needs(clip, Clip, 'clip').handle, struct, out));
    return new Play(out[0]);
  }

  /** Starts a texture, which plays until it is stopped; set 'textureSpeed' and 'textureForce' (0 to 1) while it does. */
  playTexture(texture, speed = 0, force = 1, settings = {}) {
    const struct = fill(filled(c.playSettingsInit), settingFields, settings, 'a play');
    const out = [0n];
    check(c.textureStart(this.#handle, needs(texture, Texture, 'texture').handle, speed, force, struct, out));
    return new Play(out[0]);
  }

  /** Fills a Float32Array with the next frames: samples[frame * channels + actuator]; returns it. */
  render(samples, channels = this.#actuators) {
    needs(samples, Float32Array, 'samples');
    const result = c.renderInterleaved(this.#handle, samples, channels, Math.floor(samples.length / channels));
    // It does not write down why, as it is for audio threads.
    if (result !== 0) throw new PaciniError(codes[result], `engine: ${c.resultText(result)}`);
    return samples;
  }

  /** frame, latency, playing, leftOut, cost (microseconds), leftOutError and gainReduction (dB) */
  get info() {
    const info = filled(c.engineInfoInit);
    check(c.engineGetInfo(this.#handle, info));
    return {
      frame: Number(info.frame), latency: info.latency, playing: info.playing, leftOut: info.left_out, cost: info.cost,
      leftOutError: info.left_out_error, gainReduction: info.gain_reduction,
    };
  }

  /** What may play at a time: microseconds for a block of so many frames, and voices; 0: all. */
  setBudget(microseconds, frames = 512, voices = 0) {
    check(c.engineSetBudget(this.#handle, microseconds, frames, voices));
  }

  /** How many times as long as predicted blocks take on this machine; 0 measures it of the last ones. Returns it. */
  calibrate(factor = 0) {
    const used = [0];
    check(c.engineCalibrate(this.#handle, factor, used));
    return used[0];
  }

  /** Gain of an actuator, the first is 0, behind its protection. */
  setActuatorGain(actuator, gain, glide = 0, frame = 0) {
    check(c.engineSetActuatorGain(this.#handle, actuator, gain, glide, frame));
  }

  /** A control of all plays of a group, 0 to 31. */
  setGroup(group, control, value, glide = 0, frame = 0) {
    check(c.groupSet(this.#handle, group, number(controls, control, 'control'), value, glide, frame));
  }

  stopGroup(group, fade = 0, frame = 0) { check(c.groupStop(this.#handle, group, fade, frame)); }

  /**
   * Plays on one of controllers() from now on, on a thread of the library; render() throws, with the code 'busy', meanwhile.
   * `stopOnCrash` silences it when the program crashes, by handlers of signals.
   */
  attach(controller, { stopOnCrash = false } = {}) {
    const settings = filled(c.attachSettingsInit);
    settings.stop_on_crash = stopOnCrash ? 1 : 0;
    check(c.engineAttach(this.#handle, controller.handle, settings));
  }

  /** Silences the controller and gives the engine back to render(). */
  detach() { check(c.engineDetach(this.#handle)); }

  /** state ('detached', 'attached', 'gone'), sent (reports), failure (why it is gone) */
  get attachment() {
    const info = filled(c.attachmentInfoInit);
    check(c.engineGetAttachment(this.#handle, info));
    return { state: attachments[info.state], sent: Number(info.sent), failure: info.failure };
  }

  /** Ends it and all its plays. */
  destroy() {
    check(c.engineDestroy(this.#handle));
    engines.unregister(this);
    this.#handle = 0n;
  }
}

/** A clip that plays. When it has ended, everything but `info` throws, with the code 'stale'. */
export class Play {
  #handle;

  constructor(handle) { this.#handle = handle; }

  /** 'gain', 'intensity', 'pan', 'delay', 'transposition', 'speed', 'priority', 'tones', 'events', 'noise', 'textureSpeed' or 'textureForce',
   * in a glide (s), from a frame on. */
  set(control, value, glide = 0, frame = 0) {
    check(c.playSet(this.#handle, number(controls, control, 'control'), value, glide, frame));
  }

  stop(fade = 0, frame = 0) { check(c.playStop(this.#handle, fade, frame)); }
  pause(fade = 0, frame = 0) { check(c.playPause(this.#handle, fade, frame)); }
  resume(fade = 0, frame = 0) { check(c.playResume(this.#handle, fade, frame)); }
  seek(position, frame = 0) { check(c.playSeek(this.#handle, position, frame)); }

  /** state ('ended', 'waiting', 'playing', 'paused', 'left out') and position (s of the clip) */
  get info() {
    const info = filled(c.playInfoInit);
    check(c.playGetInfo(this.#handle, info));
    return { state: states[info.state], position: info.position };
  }
}

/** The game controllers, and other haptic devices, that are connected: handle, name, path, haptics, connection of each. */
export function controllers() {
  const handles = new Array(32).fill(0n);
  const count = [0];
  check(c.controllersFind(handles, handles.length, count));
  return handles.slice(0, Math.min(handles.length, count[0])).map((handle) => {
    const info = filled(c.controllerInfoInit);
    check(c.controllerGetInfo(handle, info));
    return {
      handle, name: info.name, path: info.path, haptics: haptics[info.haptics] ?? 'unknown',
      connection: connections[info.connection] ?? 'unknown',
    };
  });
}
