// Every function, in use and with what is not in use any more; run by Node's own test runner.
import assert from 'node:assert/strict';
import test from 'node:test';
import { writeFileSync } from 'node:fs';
import koffi from 'koffi';
import { Clip, Engine, PaciniError, layout, version } from 'pacini';

const hum = `{"format": "pacini.clip", "version": 1, "name": "hüm", "duration": 1, "bands": [{"lowFrequency": 90,
 "centreFrequency": 100, "highFrequency": 110, "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}]}]}`;
const bytes = (text) => new TextEncoder().encode(text);

function largest(engine, frames) {
  const samples = engine.render(new Float32Array(2 * frames));
  const of = (channel) => samples.reduce((most, x, i) => (i % 2 === channel ? Math.max(most, Math.abs(x)) : most), 0);
  return [of(0), of(1)];
}

const fails = (code, words, work) => assert.throws(work, (error) => {
  assert.ok(error instanceof PaciniError);
  assert.equal(error.code, code);
  assert.ok(error.message.includes(words), error.message);
  return true;
});

test('a value of another class is refused', () => {
  const engine = new Engine({ sampleRate: 8000 });
  for (const samples of [new Float64Array(256), new Uint8Array(256), [0, 0], undefined])
    fails('invalid', 'samples must be a Float32Array', () => engine.render(samples));
  for (const clip of [undefined, null, {}, bytes(hum)]) fails('invalid', 'clip must be a Clip', () => engine.play(clip));
  fails('invalid', 'texture must be a Texture', () => engine.playTexture(Clip.fromBytes(bytes(hum))));
  for (const text of [hum, new Float32Array(8), undefined])
    fails('invalid', 'bytes must be a Uint8Array', () => Clip.fromBytes(text));
  assert.ok(Clip.fromBytes(Buffer.from(hum)).info.bytes > 20);
  engine.destroy();
});

test('a clip plays and is changed; what is stale throws', () => {
  assert.ok(version >= 1000);
  const clip = Clip.fromBytes(bytes(hum));
  assert.equal(clip.info.name, 'hüm');
  assert.equal(clip.info.duration, 1);
  assert.ok(clip.info.bytes > 20);
  assert.deepEqual(Clip.allFromBytes([bytes(hum), bytes(hum)]).map((one) => one.info.name), ['hüm', 'hüm']);
  fails('bad data', 'bytes[1]: ', () => Clip.allFromBytes([bytes(hum), bytes('none')]));
  fails('invalid', 'maxPlays: must be', () => new Engine({ maxPlays: 1e6 }));
  const engine = new Engine({ sampleRate: 8000, actuators: [{}, { gain: 0.5 }], maxPlays: 8, panLaw: 'power', protect: true });
  const play = engine.play(clip, { loop: -1, pan: 0, frame: 1000 });
  assert.equal(play.info.state, 'waiting');
  assert.deepEqual(largest(engine, 1000), [0, 0]);
  assert.ok(largest(engine, 1000)[0] > 0.4);
  assert.equal(play.info.state, 'playing');
  assert.ok(Math.abs(play.info.position - 0.125) < 0.01);
  play.set('pan', 1);
  largest(engine, 1000);
  const [left, right] = largest(engine, 1000);
  assert.equal(left, 0);
  assert.ok(right > 0.2 && right < 0.26);
  engine.setActuatorGain(1, 0);
  largest(engine, 1000);
  assert.deepEqual(largest(engine, 1000), [0, 0]);
  engine.setActuatorGain(1, 1);
  clip.reload(bytes(hum.replaceAll('0.5', '0.1')));
  largest(engine, 1000);
  const faint = largest(engine, 1000)[1];
  assert.ok(faint > 0.05 && faint < 0.15);
  play.set('noise', 0.5);
  play.set('events', 0.5);
  engine.setGroup(0, 'tones', 0); // all that is in this clip
  largest(engine, 1000);
  assert.deepEqual(largest(engine, 1000), [0, 0]);
  play.seek(0.5);
  play.pause(0.01);
  largest(engine, 1000);
  assert.equal(play.info.state, 'paused');
  play.resume(0.01);
  largest(engine, 1000);
  assert.equal(play.info.state, 'playing');
  assert.equal(engine.info.playing, 1);
  assert.equal(engine.info.frame, 12000);
  assert.equal(engine.info.latency, 8);
  engine.setBudget(0, 512, 1);
  assert.equal(engine.calibrate(2.5), 2.5);
  const second = engine.play(clip, { priority: 5 });
  largest(engine, 100);
  assert.equal(second.info.state, 'left out');
  play.stop(0.01);
  engine.stopGroup(0);
  largest(engine, 1000);
  assert.equal(play.info.state, 'ended');

  fails('stale', 'play: has ended', () => play.set('gain', 1));
  fails('invalid', "there is no control 'volume'", () => play.set('volume', 1));
  fails('invalid', "a play has no 'lop'", () => engine.play(clip, { lop: 1 }));
  fails('invalid', 'loop', () => engine.play(clip, { loop: 5 }));
  fails('invalid', "'lra-176' is no profile", () => new Engine({ actuators: [{ profile: 'lra-176' }] }));
  fails('invalid', 'actuatorCount', () => new Engine({ actuators: new Array(17).fill({}) }));
  fails('io', 'dört/none', () => Clip.load('dört/none'));
  fails('bad data', 'is not a clip', () => Clip.fromBytes(bytes('nonsense')));
  clip.release();
  fails('stale', 'clip is not in use', () => clip.release());
  fails('stale', 'clip is not in use', () => engine.play(clip));
  engine.destroy();
  fails('stale', 'engine: a handle is not in use', () => engine.render(new Float32Array(8)));
  fails('stale', 'engine is not in use', () => engine.stopGroup(0));
  fails('stale', 'engine of the play', () => play.stop());
});

test('a clip has markers', () => {
  const clip = Clip.fromBytes(bytes(hum.replace('"duration": 1,', `"duration": 1, "markers": [
    {"time": 0.25, "name": "schön"}, {"time": 0.5, "name": "step"}, {"time": 0.75, "name": "step"}],`)));
  assert.deepEqual(clip.markers.map(({ index, name }) => [index, name]), [[0, 'schön'], [1, 'step'], [2, 'step']]);
  assert.ok(Math.abs(clip.findMarker('schön').time - 0.25) < 1e-3);
  assert.deepEqual(clip.findMarker('step', 2), clip.markers[2]);
  fails('invalid', "no marker 'schön'", () => clip.findMarker('schön', 1));
  assert.deepEqual(Clip.fromBytes(bytes(hum)).markers, []);
});

test('what nothing refers to is collected', async () => {
  for (let i = 0; i < 200; ++i) { // 64 at a time
    new Engine({ sampleRate: 8000, maxPlays: 4 });
    if (i % 20 === 19) {
      global.gc();
      await new Promise((done) => setTimeout(done, 1));
    }
  }
});

test('structs can be compared with those of the C compiler', () => {
  const lines = [];
  for (const [name, type] of Object.entries(layout)) {
    lines.push(`${name} ${koffi.sizeof(type)}`);
    for (const field of Object.keys(koffi.introspect(type).members)) {
      lines.push(`${name}.${field} ${koffi.offsetof(type, field)}`);
    }
  }
  writeFileSync('layout.txt', lines.join('\n'));
});

test('a scene is what the command renders', () => {
  const engine = new Engine({ actuators: [{}, {}], scene: 'two.scene.json' });
  writeFileSync('two.raw', engine.render(new Float32Array(2 * 72000)));
});
