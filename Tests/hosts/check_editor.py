#!/usr/bin/env python3
"""The clip editor on a screen that nobody sees, used with mouse and keys.

check_editor.py PROGRAM DEMO [PICTURE [QUESTION]]    DEMO: a sound; PICTURE: where a picture of the window goes;
QUESTION: one of the question before a file is replaced. Exit 0, 1 on a failed check, 77 when Xvfb, xdotool or
ImageMagick is not there.
"""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from host_test import check, failures, needs, picture, until
from screen import Screen

needs("Xvfb", "xdotool", "import", "convert", "compare")

# Where things are in a window of 1280 x 800: the head of a row, then the plot.
PLOT_LEFT, ENVELOPE_TOP, ENVELOPE_HEIGHT = 144, 26 + 42 + 26 + 72 + 72 + 48, 71


class EditorScreen(Screen):
    """A screen with the editor's window."""

    def find_window(self):
        return super().find_window("Pacini Editor", 1280)

    def export(self, path, rendered=False):
        """The shown clip as a file: the path."""
        self.keys("ctrl+e")
        time.sleep(0.5)
        if rendered:
            self.keys("Tab", "Down", "Down", "shift+Tab")
        self.keys("ctrl+a")
        self.type(str(path))
        self.keys("Return")
        check(f"{path.name} is exported", until(path.exists, 30))
        time.sleep(0.5)
        return path


def main():
    program, demo = sys.argv[1], sys.argv[2]
    with tempfile.TemporaryDirectory() as folder, EditorScreen(folder) as screen:
        folder = Path(folder)
        app = screen.start(program, "--fresh", demo, env=screen.environment)
        check("the window opens", until(screen.find_window))
        time.sleep(3)  # the analysis of a short sound
        screen.focus()

        def clip(path):
            return json.loads(path.read_text()) if path.exists() else {}

        before = clip(screen.export(folder / "before.json"))
        check("the demo sound has become a clip", len(before.get("bands", [])) > 3,
              f"{len(before.get('envelope', []))} points of the envelope")

        x, y = PLOT_LEFT + 500, ENVELOPE_TOP + 12
        screen.move(x, y)
        screen.tool("click", "--repeat", 2, "--delay", 80, 1)
        time.sleep(0.5)
        with_point = clip(screen.export(folder / "point.json"))
        added = [p for p in with_point["envelope"] if p not in before["envelope"]]
        check("a double-click adds one point", len(added) == 1, str(added))
        screen.drag(x, y, x + 60, y + 20)
        dragged = clip(screen.export(folder / "dragged.json"))
        moved = [p for p in dragged["envelope"] if p not in before["envelope"]]
        per_pixel = 1.02 * before["duration"] / (1280 - 248 - 144 - 10)
        check("a drag moves it", len(moved) == 1 and
              abs(moved[0]["time"] - added[0]["time"] - 60 * per_pixel) < 8 * per_pixel, str(moved))
        check("and makes it softer by the right amount", len(moved) == 1 and
              abs(moved[0]["amplitude"] / added[0]["amplitude"] - 10 ** (-60 * 20 / ENVELOPE_HEIGHT / 20)) < 0.01)
        check("and changes nothing else", {k: v for k, v in dragged.items() if k != "envelope"} ==
              {k: v for k, v in before.items() if k != "envelope"})
        if len(sys.argv) > 3:
            picture(screen.display, folder / "window.png")
            subprocess.run(["convert", str(folder / "window.png"), "-crop", f"1280x800+{screen.left}+{screen.top}",
                            "+repage", sys.argv[3]], check=True)
        screen.keys("ctrl+z")
        screen.export(folder / "undone.json")
        check("undo brings it back where it was", (folder / "undone.json").read_bytes() == (folder / "point.json").read_bytes())
        screen.keys("ctrl+z")
        screen.export(folder / "first.json")
        check("and again, to the very file of the beginning",
              (folder / "first.json").read_bytes() == (folder / "before.json").read_bytes())

        plain = screen.export(folder / "plain.wav", rendered=True)
        # The actuator is the last menu of the toolbar, before its strength.
        screen.move(1000, 26 + 21)
        screen.tool("click", 1)
        time.sleep(0.5)
        screen.keys("Down", "Down", "Down", "Return")
        time.sleep(0.5)
        screen.focus()
        fitted = screen.export(folder / "fitted.wav")  # the format of the last export is chosen already
        check("another actuator gives another drive signal",
              plain.exists() and fitted.exists() and plain.read_bytes() != fitted.read_bytes())

        hers = folder / "hers.wav"
        hers.write_text("not a sound of ours")
        screen.keys("ctrl+e")
        time.sleep(0.5)
        screen.keys("ctrl+a")
        screen.type(str(hers))
        screen.keys("Return")
        time.sleep(1.5)
        if len(sys.argv) > 4:
            picture(screen.display, Path(sys.argv[4]))
        screen.keys("Return")  # in a hurry: the question keeps the file
        time.sleep(1)
        check("a file that exists is kept", hers.read_text() == "not a sound of ours")
        screen.keys("Return")
        time.sleep(1.5)
        screen.keys("Tab", "Return")
        check("and replaced once that was said", until(lambda: hers.read_bytes() == fitted.read_bytes(), 30))
        check("the program still runs", app.poll() is None)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
