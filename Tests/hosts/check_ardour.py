#!/usr/bin/env python3
"""LV2 and VST3 in Ardour: sidechain from one track, haptic output recorded on another.

check_ardour.py FOLDER_OF_PLUGINS     exit 0, 1 on a failed check, 77 when Ardour is not there
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from host_test import RATE, check, failures, skip

try:
    import numpy as np
    import soundfile
except ImportError as error:
    skip(error)

HERE = Path(__file__).resolve().parent
ATTEMPTS = 4  # Ardour without a screen crashes now and then by itself


def find(pattern):
    for folder in ("/usr/bin", "/usr/local/bin", "/usr/lib/ardour7", "/usr/lib/ardour8", "/usr/lib/x86_64-linux-gnu/ardour7"):
        for path in sorted(Path(folder).glob(pattern)):
            return str(path)
    return shutil.which(pattern.rstrip("*"))


LUA = find("ardour?-lua")
if not LUA:
    skip("ardour is missing")


def run(script, environment):
    for attempt in range(ATTEMPTS):
        yield attempt
        done = subprocess.run([LUA, str(HERE / script)], env=environment, capture_output=True, text=True, timeout=180)
        print(f"   {script}, attempt {attempt + 1}: exit {done.returncode}")
        if done.returncode == 0 and "assertion failed" not in done.stdout + done.stderr:
            return
        print("\n".join((done.stdout + done.stderr).splitlines()[-8:]))


def tone(samples, frequency):
    """Amplitude of a tone in the middle of what is not silent."""
    heard = np.flatnonzero(np.abs(samples) > 1e-5)
    if len(heard) < RATE:
        return 0.0
    part = samples[heard[0] + RATE // 4 : heard[0] + RATE]
    t = np.arange(len(part)) / RATE
    window = np.hanning(len(part))
    return 2 * abs(np.sum(part * window * np.exp(-2j * np.pi * frequency * t))) / window.sum()


def main():
    plugins = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        lv2 = [str(p) for p in [plugins / "LV2", *sorted(Path("/usr/lib").glob("*/lv2")), Path("/usr/lib/lv2")]]
        environment = dict(os.environ, HOME=str(folder), XDG_CONFIG_HOME=str(folder / "config"),
                           SESSION_DIR=str(folder / "session"), LV2_PATH=os.pathsep.join(lv2),
                           VST3_PATH=str(plugins / "VST3"))
        scanner = find("ardour-vst3-scanner*")
        if scanner:
            scanned = subprocess.run([scanner, "-f", str(plugins / "VST3" / "Pacini.vst3")], timeout=120,
                                     env=dict(environment, LD_LIBRARY_PATH=str(Path(scanner).parent)),
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            check("Ardour scans the VST3", scanned.returncode == 0)
        for _ in run("ardour_make.lua", environment):
            shutil.rmtree(folder / "session", ignore_errors=True)
        sounds = folder / "session" / "interchange" / "session" / "audiofiles"
        for pattern, frequency in (("*Music*L.wav", 80), ("*Music*R.wav", 240), ("*SC*.wav", 150)):
            for path in sounds.glob(pattern):
                info = soundfile.info(str(path))
                t = np.arange(info.frames) / RATE
                soundfile.write(str(path), (0.25 * np.sin(2 * np.pi * frequency * t)).astype(np.float32), RATE,
                                subtype="FLOAT")
        check("Ardour makes a session", len(list(sounds.glob("*.wav"))) == 3)
        if failures:
            return 1

        # The LV2's settings are no control ports, which is all that the script can set.
        for kind, name, source in (("LV2", "urn:pacini:translator", ""), ("VST3", "Pacini", "0.5")):
            session = folder / kind / "session"  # of the same name, which its folders bear
            here = dict(environment, SESSION_DIR=str(session), PLUGIN_ID=name, PLUGIN_KIND=kind, SOURCE=source)
            for _ in run("ardour_play.lua", here):
                shutil.rmtree(session, ignore_errors=True)
                shutil.copytree(folder / "session", session)

            def recorded(pattern):
                found = sorted((session / "interchange" / "session" / "audiofiles").glob(pattern))
                return soundfile.read(str(found[-1]))[0] if found else np.zeros(1)

            felt, heard = recorded("*HapticRec*.wav"), recorded("*MainRec*.wav")
            levels = {f: round(float(tone(felt, f)), 3) for f in (80, 240, 150)}
            if source:
                check(f"{kind}: the sidechain's tone is felt, and only that", levels[150] > 0.1
                      and max(levels[80], levels[240]) < 0.01, str(levels))
            else:
                check(f"{kind}: both channels of the sound are felt, the sidechain is not",
                      min(levels[80], levels[240]) > 0.05 and levels[150] < 0.01, str(levels))
            check(f"{kind}: the sound passes", abs(tone(heard, 80) - 0.25) < 0.01 and tone(heard, 150) < 0.001,
                  f"{tone(heard, 80):.3f}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
