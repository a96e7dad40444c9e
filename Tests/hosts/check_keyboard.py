#!/usr/bin/env python3
"""Each window as it opens, by the keyboard alone: Tab goes into it and every stop is seen.

check_keyboard.py PACINI EDITOR COMMAND DEMO    PACINI, EDITOR: the programs with windows; COMMAND: pacini; DEMO: a
sound. Exit 0, 1 on a failed check, 77 when Xvfb, xdotool or ImageMagick is not there.
"""
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from host_test import check, failures, needs, picture, until
from screen import Screen

needs("Xvfb", "xdotool", "import", "compare")


def main():
    pacini, editor, command, demo = sys.argv[1:5]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        study = folder / "study"
        subprocess.run([command, "study", "new", study, "--template", "abx", demo, "-q"], check=True)
        windows = (("the editor's start page", "Pacini Editor", [editor, "--fresh"], 15),
                   ("the editor with a sound", "Pacini Editor", [editor, "--fresh", demo], 40),
                   ("the standalone", "Pacini", [pacini, "--fresh"], 25),
                   ("a study", "abx", [editor, "--fresh", "--study", study], 6))
        for name, title, arguments, stops in windows:
            with Screen(folder) as screen:
                app = screen.start(*arguments, env=screen.environment)
                check(f"{name}: the window opens", until(lambda: screen.find_window(title)))
                time.sleep(3)  # the analysis of a short sound
                screen.focus()
                unseen = screen.unseen_stops(folder, stops)
                check(f"{name}: Tab goes on and is seen", not unseen, f"{len(unseen)} of {stops} are not: {unseen}")
                check(f"{name}: still runs", app.poll() is None)
        with Screen(folder) as screen:
            screen.start(pacini, "--fresh", env=screen.environment)
            check("the standalone opens again", until(lambda: screen.find_window("Pacini")))
            time.sleep(3)
            screen.focus()
            before, after = folder / "before.png", folder / "help.png"
            picture(screen.display, before)
            screen.keys("F1")

            def is_shown():
                picture(screen.display, after)
                return screen.difference(before, after) > 50000

            check("F1 opens the help as the first key of all", until(is_shown, 5))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
