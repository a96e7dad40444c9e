#!/usr/bin/env python3
"""A phone feels what the clip editor plays: the picture in the window is scanned, and the page in Chromium notes what it
is told to vibrate.

check_phone.py PROGRAM SOUND [PICTURE]    PICTURE: where a picture of the window goes. Exit 0, 1 on a failed check, 77
when Xvfb, xdotool, ImageMagick, jackd, zbar, Node.js, Chromium or puppeteer-core is not there.
"""
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from check_editor import EditorScreen
from host_test import RATE, check, failures, needs, picture, skip, until

needs("Xvfb", "xdotool", "import", "jackd", "zbarimg", "node", "chromium")
ROOT = Path(__file__).resolve().parents[2]
MODULES = ROOT / "build/web-node"
if not (MODULES / "modules").exists():
    skip("build/web-node is missing")


class Phone:
    def __init__(self, screen, address):
        self.process = screen.start("node", ROOT / "Tests/web/phone.mjs", MODULES, address, stdin=subprocess.PIPE,
                                    stdout=subprocess.PIPE, text=True)
        self.first = self.process.stdout.readline()

    def ask(self, what):
        self.process.stdin.write(what + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def vibrations(self):
        return [one for one in json.loads(self.ask("tell")) if one["pattern"][0] > 0]


def main():
    program, sound = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as name, EditorScreen(name) as screen:
        folder = Path(name)
        check("the sound server runs", screen.start_sound_server(screen.environment))
        app = screen.start(program, "--fresh", "--device-type", "JACK", sound, env=screen.environment)
        check("the window opens", until(screen.find_window))
        time.sleep(3)
        screen.focus()

        # By the command's name, as people find it.
        screen.keys("ctrl+shift+p")
        screen.type("feel on a phone")
        screen.keys("Return")
        time.sleep(1)
        window = folder / "window.png"
        picture(screen.display, window)
        if len(sys.argv) > 3:
            subprocess.run(["convert", str(window), "-crop", f"1280x800+{screen.left}+{screen.top}", "+repage", sys.argv[3]],
                           check=True)
        scanned = subprocess.run(["zbarimg", "-q", "--raw", str(window)], capture_output=True, text=True, timeout=60).stdout.strip()
        check("the picture in the window is an address", scanned.startswith("http://") and "code=" in scanned, scanned)
        if failures:
            return 1
        phone = Phone(screen, scanned)
        check("the phone is let in and has the clip", Path(sound).stem in phone.first, phone.first.strip())
        time.sleep(1)
        picture(screen.display, window)
        again = subprocess.run(["zbarimg", "-q", "--raw", str(window)], capture_output=True, text=True, timeout=60).stdout.strip()
        check("the next phone needs another code", again.startswith("http://") and again != scanned)
        screen.keys("Escape")
        check("nothing is felt while nothing plays", phone.vibrations() == [])

        screen.focus()
        pressed = 1000 * time.time()
        screen.keys("space")
        time.sleep(1.5)
        felt = phone.vibrations()
        # A figure, not a bar: the key, the window and the sound device have their times too.
        check("it feels what plays", len(felt) > 0, f"{len(felt)} patterns, the first "
              f"{felt[0]['at'] - pressed if felt else 0:.0f} ms after the key")
        time.sleep(2.5)
        felt += phone.vibrations()
        time.sleep(1)
        check("and nothing when that is over", phone.vibrations() == [])

        app.terminate()
        check("the page ends with the program", phone.ask("ended") == "ended")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
