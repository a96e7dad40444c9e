#!/usr/bin/env python3
"""pacini live on a PulseAudio server of its own that ends, or whose sink goes, while it plays.

check_pulse.py PACINI   exit 1 when a claim fails, 77 when PulseAudio or RtAudio is missing
"""
import array
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from host_test import Processes, check, failures, needs, skip, until

COMMAND = sys.argv[1]
LONGEST = 30  # s; a hang fails the test


def server(processes, folder):
    """A server with two sinks that nobody hears."""
    process = processes.start("pulseaudio", "-n", "--daemonize=no", "--use-pid-file=no", "--exit-idle-time=-1", "-L",
                              f"module-native-protocol-unix auth-anonymous=1 socket={folder}/native", "-L",
                              "module-null-sink sink_name=one", "-L", "module-null-sink sink_name=two")
    if not until(lambda: subprocess.run(["pactl", "info"], capture_output=True).returncode == 0, 15):
        skip("PulseAudio does not start")
    return process


def live(folder, *arguments):
    return subprocess.Popen([COMMAND, "live", *arguments, "--json"], cwd=folder, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def ended(process):
    try:
        out, error = process.communicate(timeout=LONGEST)
    except subprocess.TimeoutExpired:
        process.kill()
        out, error = process.communicate()
        check("pacini ends", False, error)
    return process.returncode, out, error


def seconds_of(path):
    return (path.stat().st_size - 44) / 4 / 48000 if path.exists() else 0.0


def check_input(processes, folder):
    for what, end in (("its server ends", lambda pulse: pulse.send_signal(signal.SIGKILL)),
                      ("its sink goes", lambda _: subprocess.run(["pactl", "unload-module", "module-null-sink"]))):
        for length in ([], ["--duration", "60"]):
            pulse = server(processes, folder)
            kept = folder / "kept.wav"
            kept.unlink(missing_ok=True)
            process = live(folder, "--sound-input", "pulse:one.monitor", "-o", kept.name, *length)
            time.sleep(3)
            end(pulse)
            begun = time.monotonic()
            code, out, _ = ended(process)
            told = json.loads(out)
            check(f"input, {what} {length}: an error, soon", code == 1 and time.monotonic() - begun < 10
                  and "does not answer any more" in out, out)
            check(f"input, {what} {length}: what was recorded is kept, and little else", 1.0 < seconds_of(kept) < 6.0
                  and "kept.wav" in json.dumps(told), f"{seconds_of(kept):.2f} s")
            pulse.kill()
            pulse.wait()


def check_output(processes, folder):
    tone = array.array("f", (0.5 * math.sin(2 * math.pi * 100 * i / 48000) for i in range(48000 * 14)))
    (folder / "tone.raw").write_bytes(tone.tobytes())
    pulse = server(processes, folder)
    with open(folder / "tone.raw", "rb") as sound:
        process = subprocess.Popen([COMMAND, "live", "-", "--raw", "f32", "--channels", "1", "--sound-output", "pulse:two",
                                    "--json"], stdin=sound, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    time.sleep(3)
    pulse.kill()
    pulse.wait()
    time.sleep(2)
    server(processes, folder)
    code, out, error = ended(process)
    told = json.loads(out)
    check("output: a server that ends is told", any("does not answer any more" in w["message"] for w in told["warnings"]), out)
    check("output: it plays again when the server is back", code == 0 and told["outputs"][0]["connections"] == 2, out + error)


if __name__ == "__main__":
    needs("pulseaudio", "pactl")
    with tempfile.TemporaryDirectory() as name, Processes() as running:
        os.environ.update(PULSE_SERVER=f"unix:{name}/native", XDG_RUNTIME_DIR=name, HOME=name)
        if "needs RtAudio" in ended(live(Path(name), "--sound-input", "pulse:one", "-o", "-"))[1]:
            skip("librtaudio-dev was missing when pacini was built")
        check_input(running, Path(name))
        check_output(running, Path(name))
    sys.exit(1 if failures else 0)
