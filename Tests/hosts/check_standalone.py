#!/usr/bin/env python3
"""The standalone program on a screen that nobody sees and a sound server without a sound card.

check_standalone.py PROGRAM [PICTURE]    PICTURE: where a picture of the window goes. Exit 0, 1 on a failed check, 77
when Xvfb, ImageMagick or JACK is not there.
"""
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from host_test import RATE, Processes, check, failures, listed, needs, picture, skip, until

try:
    import numpy as np
    import soundfile
except ImportError as error:
    skip(error)
needs("Xvfb", "import", "convert", "jackd", "jack_lsp", "jack_rec")


def pixels(path):
    raw = subprocess.run(["convert", str(path), "-depth", "8", "gray:-"], capture_output=True, timeout=60, check=True).stdout
    return np.frombuffer(raw, dtype=np.uint8).reshape(960, 1280).astype(int)


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder, Processes() as processes:
        folder = Path(folder)
        display = processes.start_screen()
        environment = dict(os.environ, HOME=str(folder), DISPLAY=display)
        check("the sound server runs", processes.start_sound_server(environment))
        app = processes.start(program, "--fresh", "--device-type", "JACK", "--test-signal", "--haptic-output", "3",
                              env=environment)
        check("the program takes the interface", until(lambda: "JUCEJack:out_4" in listed(environment), 60))
        check("its third output is wired to the third of the interface",
              until(lambda: "system:playback_3\n   JUCEJack:out_3" in listed(environment)))
        time.sleep(7)
        for name in ("first.png", "second.png"):
            check(f"{name} is taken", picture(display, folder / name))
            time.sleep(1.5)
        first, second = pixels(folder / "first.png"), pixels(folder / "second.png")
        lit = (first > 20).mean()
        check("the window is there and not black", lit > 0.3, f"{100 * lit:.0f} % of the screen")
        check("it shows many things", len(np.unique(first)) > 40, f"{len(np.unique(first))} shades")
        moved = (np.abs(first - second) > 10).sum()
        check("its meters move", moved > 500, f"{moved} pixels")
        if len(sys.argv) > 2:
            subprocess.run(["convert", str(folder / "second.png"), "-trim", "+repage", sys.argv[2]], check=True)

        for channel in (1, 3, 4):
            subprocess.run(["jack_rec", "-f", str(folder / f"{channel}.wav"), "-d", "3", "-b", "24",
                            f"JUCEJack:out_{channel}"], env=environment, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, timeout=60)
        recorded = {}
        for channel in (1, 3, 4):
            path = folder / f"{channel}.wav"
            recorded[channel] = soundfile.read(path)[0] if path.exists() else np.zeros(1)
            print("   output", channel, "peak", np.abs(recorded[channel]).max())
        check("the sound is on the first output", np.abs(recorded[1]).max() > 0.1)
        check("the haptic signal is on the third", 0.05 < np.abs(recorded[3]).max() <= 1.0)
        # A server without a clock drops frames now and then, so this asks for no more than where half of it lies.
        spectrum = np.cumsum(np.abs(np.fft.rfft(recorded[3])) ** 2)
        middle = np.searchsorted(spectrum, 0.5 * spectrum[-1]) * RATE / len(recorded[3])
        check("and most of it can be felt", middle < 600, f"half of it below {middle:.0f} Hz")
        check("the fourth is silent", np.abs(recorded[4]).max() == 0)
        check("the program still runs", app.poll() is None)
        app.terminate()
        check("and ends when asked to", until(lambda: app.poll() is not None, 10))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
