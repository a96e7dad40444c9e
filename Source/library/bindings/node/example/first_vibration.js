// The first vibration: loads a clip, plays it and writes what drives the actuator as raw 32-bit floats.
import { Clip, Engine } from 'pacini';

const engine = new Engine({ actuators: [{ profile: 'lra-175' }] });
const knock = Clip.load(process.argv[2]);
engine.play(knock);
const drive = new Float32Array(256);
for (let block = 0; block < 188; ++block) { // a second at 48 kHz
  engine.render(drive);
  process.stdout.write(new Uint8Array(drive.slice().buffer));
}
