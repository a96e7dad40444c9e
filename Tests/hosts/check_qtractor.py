#!/usr/bin/env python3
"""The CLAP plugin in qtractor: found, loaded with the state of a session, and heard through JACK.

check_qtractor.py PLUGIN.clap SEQUENCER     exit 0, 1 on a failed check, 77 when something is not there

SEQUENCER is what no_sequencer.c makes: qtractor does not start without ALSA's.
"""

import base64
import os
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from host_test import RATE, Processes, check, failures, listed, needs, skip, until

try:
    import numpy as np
    import soundfile
    from clap_host import Library, Plugin
    from host_sounds import sounds
except ImportError as error:
    skip(error)

SESSION = """<!DOCTYPE qtractorSession>
<session version="Qtractor 0.9.31" name="pacini">
 <properties><directory>{folder}</directory><sample-rate>48000</sample-rate></properties>
 <devices><audio-engine>
  <audio-bus name="Master" mode="duplex">
   <monitor>1</monitor><channels>2</channels><auto-connect>0</auto-connect>
   <input-gain>1</input-gain><output-gain>1</output-gain>
   <input-plugins/>
   <output-plugins>
    <plugin type="CLAP">
     <filename>{plugin}</filename><index>0</index><label>Pacini</label><activated>1</activated>
     <configs><config key="state">{state}</config></configs>
    </plugin>
   </output-plugins>
  </audio-bus>
 </audio-engine></devices>
</session>
"""
PORTS = [f"Qtractor:Master/{way}_{channel}" for way in ("in", "out") for channel in (1, 2)]


def saved(path, mode):
    """A state of the plugin as qtractor writes it: its size, and compressed."""
    plugin = Plugin(Library(path))
    plugin.set("Main output", mode)
    data = plugin.save()
    plugin.destroy()
    return base64.b64encode(len(data).to_bytes(4, "big") + zlib.compress(data)).decode()


def heard(processes, environment, folder, path, sequencer, mode):
    """What comes out of qtractor while two seconds of sound are played into it."""
    session = folder / f"mode{mode}.qtr"
    session.write_text(SESSION.format(folder=folder, plugin=path, state=saved(path, mode)))
    host = processes.start("qtractor", session, env={**environment, "LD_PRELOAD": sequencer}, cwd=folder)
    there = until(lambda: all(port in listed(environment) for port in PORTS))
    check("qtractor starts with its bus", there)
    wave = folder / "in.wav"
    soundfile.write(wave, np.tile(sounds()[:2].T, (3, 1)), RATE, subtype="FLOAT")
    player = processes.start("jack-play", wave, env={**environment, "JACK_PLAY_CONNECT_TO": PORTS[0][:-1] + "%d"})
    until(lambda: "jack-play" in listed(environment).split(PORTS[0])[1].split("Qtractor:")[0], 10)
    out = folder / f"out{mode}.wav"
    recorder = ["jack_rec", "-f", out, "-d", "3", "-b", "32", *PORTS[2:]]
    subprocess.run([str(part) for part in recorder], env=environment, check=False, timeout=60, capture_output=True)
    for process in (player, host):
        process.kill()  # it would ask whether to save
        process.wait()
    until(lambda: PORTS[0] not in listed(environment), 20)
    return soundfile.read(out, dtype="float32", always_2d=True)[0].T if out.exists() else np.zeros((2, 1), np.float32)


def main():
    needs("qtractor", "Xvfb", "jackd", "jack-play", "jack_rec", "jack_lsp")
    path, sequencer = (str(Path(argument).resolve()) for argument in sys.argv[1:3])
    with Processes() as processes, tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o700)
        environment = dict(
            os.environ,
            DISPLAY=processes.start_screen(),
            HOME=name,
            XDG_CONFIG_HOME=f"{name}/.config",
            XDG_RUNTIME_DIR=name,
            CLAP_PATH=str(Path(path).parent),
        )
        check("a sound server", processes.start_sound_server(environment))
        sound = heard(processes, environment, folder, path, sequencer, 0)
        felt = heard(processes, environment, folder, path, sequencer, 1)
        check("the sound passes", np.abs(sound).max() > 0.2 and not np.array_equal(sound[0], sound[1]))
        check("with the session's state, the haptic signal replaces it", np.array_equal(felt[0], felt[1]))
        check("and moves within full drive", 0.05 < np.abs(felt).max() <= 1.0, f"peak {np.abs(felt).max():.3f}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
