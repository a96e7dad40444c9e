#!/usr/bin/env python3
"""Makes the pictures of the clip editor beside this file, on a screen that nobody sees.

make_editor_pictures.py [PROGRAM]    PROGRAM: PaciniEditor, else that of build/release. Exit 77 when Xvfb, xdotool,
ImageMagick or JACK is not there. A sound server without a sound card runs beside it, so that the pictures show a device.
"""
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(ROOT / "Tests" / "hosts"))

from check_editor import EditorScreen  # noqa: E402
from host_test import needs, picture, until  # noqa: E402

DEMO = ROOT / "Resources" / "demo" / "drums_tabla_pattern.flac"
ACTUATOR_CHOICE = (1000, 26 + 21)  # in the toolbar
DOWN_TO_ACTUATOR = 8  # a phone, in the list behind «none»: it has few voices and a narrow range
FORMAT_CHOICE = (640, 212)  # in the sheet
DOWN_TO_FORMAT = 3  # .haptic, which keeps little
FILE_FIELD = (640, 332)
NOWHERE = (1150, 560)


def settings(home, dark):
    """Light or dark, as the program keeps it."""
    folder = home / ".config" / "pacini-editor"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "editor.settings").write_text(
        f'<?xml version="1.0"?>\n<PROPERTIES>\n  <VALUE name="dark" val="{int(dark)}"/>\n</PROPERTIES>\n')


def take(screen, name):
    """The window as PICTURE.png."""
    with tempfile.TemporaryDirectory() as folder:
        whole = Path(folder) / "screen.png"
        picture(screen.display, whole)
        subprocess.run(["convert", str(whole), "-crop", f"1280x800+{screen.left}+{screen.top}", "+repage", "-strip",
                        "-define", "png:compression-level=9", str(HERE / f"{name}.png")], check=True)
    print(HERE / f"{name}.png")


def run(program, dark, names, files):
    """Starts the program with `files` and takes the pictures `names`."""
    with tempfile.TemporaryDirectory() as home, EditorScreen(home) as screen:
        settings(Path(home), dark)
        screen.environment.pop("XDG_CONFIG_HOME", None)
        screen.start_sound_server(screen.environment)
        screen.start(program, "--device-type", "JACK", *files, env=screen.environment)
        if not until(screen.find_window):
            sys.exit("the window did not open")
        time.sleep(4)
        screen.focus()
        if not files:
            take(screen, names[0])
            return
        screen.move(*ACTUATOR_CHOICE)
        screen.tool("click", 1)
        time.sleep(0.7)
        screen.keys(*["Down"] * DOWN_TO_ACTUATOR, "Return")
        screen.focus()
        screen.keys("alt+3", "End")
        screen.keys(*["ctrl+Left"] * 3)
        screen.move(*NOWHERE)
        time.sleep(6)  # the actuator's rows and the spectrogram are made in the background
        take(screen, names[0])
        if len(names) > 1:
            screen.keys("ctrl+e")
            time.sleep(1)
            screen.move(*FORMAT_CHOICE)
            screen.tool("click", 1)
            time.sleep(0.7)
            screen.keys(*["Down"] * DOWN_TO_FORMAT, "Return")
            screen.move(*FILE_FIELD)
            screen.tool("click", 1)
            screen.keys("ctrl+a")
            screen.type("~/clips/drums.haptic")
            screen.move(*NOWHERE)
            time.sleep(1.5)
            take(screen, names[1])


def main():
    needs("jackd", "jack_lsp")
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/plugins/Standalone/PaciniEditor"
    run(program, True, ["editor", "editor-export"], [DEMO])
    run(program, False, ["editor-light"], [DEMO])
    run(program, True, ["editor-empty"], [])


if __name__ == "__main__":
    main()
