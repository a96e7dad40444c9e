#!/usr/bin/env python3
"""LV2 and VST3 in Ardour: sidechain from one track, haptic output recorded on another.

check_ardour.py FOLDER_OF_PLUGINS     exit 0, 1 on a failed check, 77 when Ardour is not there
"""
import contextlib
import io
import os
import shutil
import signal
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
ATTEMPTS = 4  # Ardour without a screen crashes now and then while it starts
WITH_PLUGIN, DONE = "stage: with the plugin", "stage: done"  # as the scripts print


def find(pattern):
    for folder in ("/usr/bin", "/usr/local/bin", "/usr/lib/ardour7", "/usr/lib/ardour8", "/usr/lib/x86_64-linux-gnu/ardour7"):
        for path in sorted(Path(folder).glob(pattern)):
            return str(path)
    return shutil.which(pattern.rstrip("*"))


LUA = find("ardour?-lua")
if not LUA:
    skip("ardour is missing")


def how_it_ended(code, text):
    """None when the script came to its end, else what went wrong."""
    if code is None:
        return "hangs"
    if code < 0:
        return f"crashes ({signal.Signals(-code).name})"
    if code != 0 or DONE not in text:
        return f"gives up (exit {code})"
    return None


def attempts(execute, script):
    """Yields before each try; `execute` returns the exit code, None after a hang, and what was printed. Ardour may fail to
    start, and is then started anew; once it has the plugin, whatever fails is the plugin's until shown otherwise."""
    for attempt in range(1, ATTEMPTS + 1):
        yield attempt
        code, text = execute()
        wrong = how_it_ended(code, text)
        print(f"   {script}, attempt {attempt}: {wrong or 'done'}", flush=True)
        if wrong is None:
            return
        print("\n".join(text.splitlines()[-8:]), flush=True)
        if WITH_PLUGIN in text:
            check(f"{script}: Ardour keeps running with the plugin", False, wrong)
            return
    check(f"{script}: Ardour starts", False, f"not in {ATTEMPTS} attempts")


def run(script, environment):
    def execute():
        try:
            done = subprocess.run([LUA, str(HERE / script)], env=environment, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, errors="replace", timeout=180)
        except subprocess.TimeoutExpired as error:
            return None, (error.stdout or b"").decode(errors="replace")
        return done.returncode, done.stdout

    return attempts(execute, script)


def check_the_check():
    """A crash with the plugin is not tried again, one before it is."""
    def tries(*ends):
        left = list(ends)
        with contextlib.redirect_stdout(io.StringIO()):
            count = len(list(attempts(lambda: left.pop(0), "script")))
        found = bool(failures)
        failures.clear()
        return count, found

    crash, fine = -signal.SIGSEGV, (0, WITH_PLUGIN + DONE)
    assert tries(fine) == (1, False)
    assert tries((crash, "starting"), fine) == (2, False)
    assert tries((crash, WITH_PLUGIN), fine) == (1, True)
    assert tries((crash, WITH_PLUGIN + DONE), fine) == (1, True)
    assert tries((None, WITH_PLUGIN), fine) == (1, True)
    assert tries((0, WITH_PLUGIN), fine) == (1, True), "an assertion of the script"
    assert tries(*[(crash, "starting")] * ATTEMPTS) == (ATTEMPTS, True)


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
        check_the_check()
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
