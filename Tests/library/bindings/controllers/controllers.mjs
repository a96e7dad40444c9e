// Plays short.json on the first controller and prints what happens.
import assert from 'node:assert/strict';
import { Clip, Engine, controllers } from 'pacini';

const [controller, ...others] = controllers();
assert.equal(others.length, 0);
console.log(controller.name, controller.haptics, controller.connection);
const engine = new Engine({ actuators: [{}, {}] });
engine.attach(controller);
assert.throws(() => engine.render(new Float32Array(8)), { code: 'busy' });
const play = engine.play(Clip.load('short.json'));
while (play.info.state !== 'ended') await new Promise((done) => setTimeout(done, 10));
const { state, sent, failure } = engine.attachment;
assert.ok(sent > 20 && failure === '');
console.log(state);
engine.detach();
console.log(engine.attachment.state);
engine.render(new Float32Array(8));
assert.throws(() => engine.detach(), { code: 'invalid' });
