#!/usr/bin/env python3
"""The npm package in Node.js, the page and a phone in Chromium.

check_web.py package|page|work|visit|language|phone PACINI LIVE_REFERENCE

Exit 0, 1 on a failed check, 77 when build/web, Node.js, Chromium or their modules are not there; `bash cmake/bootstrap.sh
slow-tests` brings them all.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WEB, MODULES = ROOT / "build/web", ROOT / "build/web-node"


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(77)


def write_kinds(sound, place):
    """One sound in every encoding of WAV and AIFF that the page reads by itself."""
    place.mkdir()
    samples, rate = soundfile.read(sound)
    common = ["PCM_U8", "PCM_16", "PCM_24", "PCM_32", "FLOAT", "DOUBLE", "ULAW", "ALAW"]
    kinds = {"WAV": [*common, "IMA_ADPCM", "MS_ADPCM"], "RF64": ["PCM_16"], "AIFF": [*common, "PCM_S8"]}
    for container, subtypes in kinds.items():
        for subtype in subtypes:
            name = f"{container}_{subtype}.{'aiff' if container == 'AIFF' else 'wav'}"
            soundfile.write(place / name, samples, rate, subtype=subtype, format=container)
    for subtype in ("IMA_ADPCM", "MS_ADPCM", "PCM_16"):
        stereo = numpy.stack([samples, .7 * numpy.roll(samples, 500)], axis=1)
        soundfile.write(place / f"stereo_{subtype}.wav", stereo, rate, subtype=subtype)


what, program, live = sys.argv[1:4]
try:
    import numpy
    import soundfile
except ImportError as error:
    skip(error)
if what != "phone" and not (WEB / "package/encode.wasm").exists():
    skip("build/web is not built")
if not shutil.which("npm") or not (MODULES / "modules").exists() or (what != "package" and not shutil.which("chromium")):
    skip("Node.js, its modules or Chromium are missing")
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    for path in sorted((ROOT / "Resources/demo").glob("*.flac")):
        samples, rate = soundfile.read(path, dtype="int16")
        soundfile.write(folder / f"{path.stem}.wav", samples, rate, subtype="PCM_16")
    kinds = folder / "kinds"
    if what == "visit":
        write_kinds(folder / "knock_wood_bridge.wav", kinds)
        os.environ["PACINI_PYTHON"] = sys.executable
    script = ROOT / "Tests/web" / f"check_{what}.mjs"
    sound = folder / "knock_wood_bridge.wav"
    pictures = [os.environ["PACINI_WEB_PICTURES"]] if "PACINI_WEB_PICTURES" in os.environ else []
    arguments = {"package": [WEB / "package", MODULES, program, live, folder],
                 "page": [WEB / "page", MODULES, program, live, sound, *pictures],
                 "work": [WEB / "page", MODULES, program, sound, folder / "drums_tabla_pattern.wav", *pictures],
                 "visit": [WEB / "page", MODULES, program, kinds, *pictures],
                 "language": [WEB / "page", MODULES, sound, *pictures],
                 "phone": [MODULES, program, sound]}[what]
    sys.exit(subprocess.run(["node", script, *arguments]).returncode)
