#!/usr/bin/env python3
"""Sizes of the modules for the web, and how long their functions take beside the program's: a table for web.md.

measure.py [PACINI]    of build/web and, unless another program is named, build/release/bin/pacini. The sound is the drum
pattern of the demo, over and over for ten minutes; times are those of the processor, the best of three, the
program's with its start and its files.
"""
import gzip
import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import soundfile

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "build/web/package"
SCRIPT = """
import { compare, encode, felt, read, render, write, readWav, memoryInUse } from '%s/index.js'
import { readFileSync } from 'node:fs'
const sound = readWav(readFileSync('sound.wav')), clip = readFileSync('clip.json'), drive = readWav(readFileSync('drive.wav'))
const sampleRate = sound.sampleRate
const calls = {
  encode: () => encode(sound, { format: 'packed' }),
  render: () => render(clip, { sampleRate }),
  'render for an actuator': () => render(clip, { sampleRate, profile: 'l5-wristband' }),
  felt: () => felt(clip, { sampleRate, profile: 'l5-wristband' }),
  'write AHAP': () => write(clip, { format: 'ahap', profile: 'l5-wristband' }),
  compare: () => compare(sound, drive)
}
const seconds = {}
for (const [name, call] of Object.entries(calls)) {
  seconds[name] = Infinity
  for (let run = 0; run < 3; ++run) {
    const started = process.cpuUsage()
    await call()
    const { user, system } = process.cpuUsage(started)
    seconds[name] = Math.min(seconds[name], (user + system) / 1e6)
  }
}
console.log(JSON.stringify({ seconds, memory: memoryInUse() }))
"""


def main():
    program = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/bin/pacini").resolve()
    print("| module | bytes | gzipped |\n|---|---|---|")
    for path in [*sorted(PACKAGE.glob("*.wasm")), ROOT / "build/web/page/visit.wasm"]:
        content = path.read_bytes()
        print(f"| `{path.name}` | {len(content)} | {len(gzip.compress(content, 9))} |")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        samples, rate = soundfile.read(ROOT / "Resources/demo/drums_tabla_pattern.flac", dtype="int16")
        with soundfile.SoundFile(folder / "sound.wav", "w", rate, 1, "PCM_16") as file:
            for _ in range(600 * rate // len(samples)):
                file.write(samples)

        def run(*words):
            best = float("inf")
            for _ in range(3):
                started = resource.getrusage(resource.RUSAGE_CHILDREN)
                subprocess.run([str(program), *words, "-q"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
                ended = resource.getrusage(resource.RUSAGE_CHILDREN)
                best = min(best, ended.ru_utime + ended.ru_stime - started.ru_utime - started.ru_stime)
            return best

        native = {"encode": run("encode", "sound.wav", "-o", "clip.pacb", "--format", "packed", "--force", "-y")}
        run("encode", "sound.wav", "-o", "clip.json", "-y")
        native["render"] = run("render", "clip.json", "-o", "drive.wav", "--rate", str(rate), "--force", "-y")
        actuator = ("--rate", str(rate), "--profile", "l5-wristband", "--force", "-y")
        native["render for an actuator"] = run("render", "clip.json", "-o", "own.wav", *actuator)
        native["felt"] = run("render", "clip.json", "-o", "felt.wav", "--felt", *actuator)
        native["write AHAP"] = run("convert", "clip.json", "-o", "clip.ahap", "--profile", "l5-wristband", "--force", "-y")
        native["compare"] = run("compare", "sound.wav", "drive.wav")
        (folder / "web.mjs").write_text(SCRIPT % PACKAGE)
        done = subprocess.run(["node", "web.mjs"], cwd=folder, check=True, capture_output=True, text=True)
        web = json.loads(done.stdout)
    print("\n| of ten minutes | program, s | web, s | times real time | speed of the program |\n|---|---|---|---|---|")
    for function, seconds in web["seconds"].items():
        print(f"| {function} | {native[function]:.2f} | {seconds:.2f} | {600 / seconds:.0f} | {native[function] / seconds:.2f} |")
    print(f"\nMemory of all modules after that: {web['memory'] / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
