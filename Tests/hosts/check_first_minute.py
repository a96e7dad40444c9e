#!/usr/bin/env python3
"""A sound of one's own becomes touch, and a file for games, in few actions: counted, with a clock beside them.

check_first_minute.py PROGRAM SOUND    SOUND: a file. The program runs on a screen that nobody sees and a sound server
without a sound card, whose third channel is recorded. An action is opening the sound with the
program, a shortcut, or a text that is typed and confirmed.
Exit 0, 1 on a failed check, 77 when Xvfb, xdotool or JACK is not there.
"""
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from check_editor import EditorScreen
from host_test import check, failures, listed, needs, skip, until

try:
    import numpy as np
    import soundfile
except ImportError as error:
    skip(error)
needs("jackd", "jack_lsp", "jack_rec")

MOST_TO_FEEL, MOST_TO_EXPORT = 4, 3


def main():
    program, sound = sys.argv[1], Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder, EditorScreen(folder) as screen:
        folder = Path(folder)
        check("the sound server runs", screen.start_sound_server(screen.environment))
        began = time.monotonic()
        screen.start(program, "--fresh", "--device-type", "JACK", sound, env=screen.environment)
        check("the window opens", until(screen.find_window))
        check("on its outputs", until(lambda: "JUCEJack:out_3" in listed(screen.environment)))
        time.sleep(1)
        screen.focus()
        actions = 1  # opening the sound with the program

        def act(*keys, text=None):
            nonlocal actions
            actions += 1
            if text is not None:
                screen.keys("ctrl+a")
                screen.type(text)
            screen.keys(*keys)

        act("space")
        felt = folder / "felt.wav"
        subprocess.run(["jack_rec", "-f", str(felt), "-d", "2", "-b", "24", "JUCEJack:out_3"], env=screen.environment,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60)
        peak = np.abs(soundfile.read(felt)[0]).max() if felt.exists() else 0.0
        check(f"an own sound is felt after {actions} actions", actions <= MOST_TO_FEEL and peak > 0.05,
              f"peak {peak:.2f} on the haptic channel, {time.monotonic() - began:.1f} s with a recording of 2 s")
        actions = 0
        act("ctrl+e")
        time.sleep(0.5)
        made = folder / "mine.haptic"
        act("Return", text=str(made))
        there = until(made.exists, 20)
        check(f"a .haptic is on the disk after {actions} more", there and actions <= MOST_TO_EXPORT,
              f"{time.monotonic() - began:.1f} s in all")
        check("and it is one", there and "signals" in json.loads(made.read_text()))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
