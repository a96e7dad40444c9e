#!/usr/bin/env python3
"""The LV2 in jalv: a state at its start, a preset and a switch by its commands, and the samples of the host on lilv.

check_jalv.py JACKRENDER LV2RENDER FOLDER_OF_LV2     exit 0, 1 on a failed check, 77 when something is not there
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from host_test import RATE, Processes, check, failures, listed, needs, skip, until

try:
    import numpy as np
    from host_sounds import sounds
except ImportError as error:
    skip(error)
for tool in sys.argv[1:3]:
    if not Path(tool).exists():
        skip("libjack-jackd2-dev or liblilv-dev was missing when this was built")

URI = "urn:pacini:translator"
BLOCK = 1024
INPUTS = [f"pacini:audio_in_{channel}" for channel in (1, 2, 3)]
OUTPUTS = [f"pacini:audio_out_{channel}" for channel in (1, 2, 3)]
PROMPT = "> "
# lilv writes states as text without them.
PREFIXES = "".join(f"@prefix {name}: <{uri}> .\n" for name, uri in (
    ("lv2", "http://lv2plug.in/ns/lv2core#"), ("pset", "http://lv2plug.in/ns/ext/presets#"),
    ("state", "http://lv2plug.in/ns/ext/state#"), ("xsd", "http://www.w3.org/2001/XMLSchema#")))


class Jalv:
    """jalv with the plugin as the client `pacini`, without a window."""

    def __init__(self, processes, environment, log, state):
        self.log, self.environment = log, environment
        with open(log, "wb") as said:
            self.process = processes.start("jalv", "-x", "-n", "pacini", *(["-l", state] if state else []), URI,
                                           env=environment, stdin=subprocess.PIPE, stdout=said,
                                           stderr=subprocess.STDOUT)
        self.there = until(lambda: all(port in listed(environment) for port in INPUTS + OUTPUTS))

    def said(self):
        return Path(self.log).read_text(errors="replace")

    def command(self, text):
        """Waits until jalv asks for the next one; False where it did not take this one."""
        asked = self.said().count(PROMPT)
        self.process.stdin.write(f"{text}\n".encode())
        self.process.stdin.flush()
        # What it has printed may still be in its buffer.
        until(lambda: self.said().count(PROMPT) > asked, 2)
        return self.process.poll() is None and "error" not in self.said()

    def end(self):
        self.process.stdin.close()
        self.process.terminate()
        self.process.wait(20)
        until(lambda: INPUTS[0] not in listed(self.environment), 20)


def main():
    needs("jalv", "jackd", "jack_lsp")
    player, renderer, folder = (str(Path(argument).resolve()) for argument in sys.argv[1:4])
    specifications = [str(path) for path in sorted(Path("/usr/lib").glob("*/lv2")) + [Path("/usr/lib/lv2")]]
    environment = dict(os.environ, LV2_PATH=os.pathsep.join([folder, *specifications]))
    environment.pop("DISPLAY", None)
    with Processes() as processes, tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        sound = np.tile(sounds(), (1, 2))
        np.ascontiguousarray(sound.T).tofile(scratch / "in")

        def reference(*options):
            subprocess.run([renderer, URI, str(RATE), str(BLOCK), str(scratch / "in"), str(scratch / "out"), *options],
                           env=environment, check=True, capture_output=True, timeout=120)
            return np.fromfile(scratch / "out", dtype=np.float32).reshape(-1, 3).T

        check("a sound server", processes.start_sound_server(environment))
        # jalv has no other way to set properties: its -c and its commands do not reach the plugin without a window.
        state = scratch / "state"
        state.mkdir()
        settings = ("--set", f"{URI}:intensity=-6", "--set", f"{URI}:source=1")
        reference(*settings, "--save", str(scratch / "saved"))
        saved = (scratch / "saved").read_text().replace("<urn:lv2render:state>", "<>")
        (state / "state.ttl").write_text(PREFIXES + saved)
        plays = {}
        for what, loaded, command, options in (
                ("as it is loaded", None, None, ()),
                ("a preset", None, f"preset {URI}:preset2", ("--preset", f"{URI}:preset2")),
                ("a state", state, None, settings),
                ("the host's switch", None, "set enabled 0", ("--port", "enabled=0"))):
            host = Jalv(processes, environment, scratch / "said", loaded)
            check(f"{what}: jalv has the plugin's six ports", host.there, "" if host.there else host.said()[-300:])
            if not host.there:
                break
            if command:
                check(f"{what}: jalv takes it", host.command(command), host.said()[-200:])
            done = subprocess.run([player, str(scratch / "in"), str(scratch / "played"), *INPUTS, "--", *OUTPUTS],
                                  env=environment, capture_output=True, text=True, timeout=120)
            check(f"{what}: it is played", done.returncode == 0, done.stderr)
            host.end()
            if done.returncode:
                break
            played = plays[what] = np.fromfile(scratch / "played", dtype=np.float32).reshape(-1, 3).T
            due = reference(*options)
            # The player is in front of the plugin and behind it, which takes a block.
            shifts = [shift for shift in range(0, 4 * BLOCK + 1, BLOCK)
                      if np.array_equal(played[0, shift + RATE // 10 : shift + RATE], due[0, RATE // 10 : RATE])]
            check(f"{what}: the sound passes bit by bit", len(shifts) == 1, shifts)
            if not shifts:
                break
            start, end = RATE // 2, sound.shape[1] - 4 * BLOCK
            apart = np.abs(played[2, start + shifts[0] : end + shifts[0]] - due[2, start:end]).max()
            check(f"{what}: the haptic signal is that of the other host", apart < 1e-6
                  and (np.abs(due[2]).max() > 0.02) != (what == "the host's switch"),
                  f"largest difference {apart:.1e}, peak {np.abs(due[2]).max():.3f}")
        usual = plays.get("as it is loaded")
        check("and each of these is felt", usual is not None and len(plays) == 4 and all(
            np.abs(one[2] - usual[2]).max() > 0.01 for what, one in plays.items() if one is not usual))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
