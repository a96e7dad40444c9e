#!/usr/bin/env python3
"""The clip editor is killed while something is not saved, and gives it back.

check_recovery.py PROGRAM DEMO [FOLDER]    DEMO: a sound; FOLDER: where pictures of the questions go. Exit 0, 1 on a
failed check, 77 when Xvfb, xdotool or ImageMagick is not there.
"""
import json
import signal
import sys
import tempfile
import time
from pathlib import Path

from check_editor import ENVELOPE_TOP, PLOT_LEFT, EditorScreen
from host_test import check, failures, picture, until

SAVED_WITHIN = 5  # s


def main():
    program, demo = sys.argv[1], sys.argv[2]
    with tempfile.TemporaryDirectory() as folder, EditorScreen(folder) as screen:
        folder = Path(folder)

        def look(name):
            if len(sys.argv) > 3:
                picture(screen.display, Path(sys.argv[3]) / name)

        def start(*arguments):
            app = screen.start(program, *arguments, env=screen.environment)
            check("the window opens", until(screen.find_window))
            time.sleep(4)  # the analysis of a short sound
            screen.focus()
            return app

        def text(path):
            return path.read_bytes() if path.exists() else b""

        app = start(demo)
        first = screen.export(folder / "first.json")
        screen.move(PLOT_LEFT + 500, ENVELOPE_TOP + 12)
        screen.tool("click", "--repeat", 2, "--delay", 80, 1)
        edited_at = time.monotonic()
        edited = screen.export(folder / "edited.json")
        check("an edit is made", text(edited) not in (b"", text(first)))
        time.sleep(max(0.0, edited_at + SAVED_WITHIN - time.monotonic()))
        app.send_signal(signal.SIGKILL)
        app.wait()

        app = start()
        look("recovery.png")
        screen.keys("Return")  # restore
        time.sleep(1)
        restored = screen.export(folder / "restored.json")
        check("the clip is what it was when the program was killed", text(restored) == text(edited),
              f"{len(text(restored))} and {len(text(edited))} bytes")
        if text(restored):
            check("with its sound's name", json.loads(text(restored))["source"]["file"] == Path(demo).name)

        screen.keys("ctrl+q")
        time.sleep(1)
        look("save.png")
        check("closing asks about what is not saved", app.poll() is None)
        screen.keys("Escape")
        time.sleep(0.5)
        check("Escape stays", app.poll() is None)
        screen.keys("ctrl+q")
        time.sleep(0.5)
        screen.keys("shift+Tab", "Return")  # don't save
        check("not saving closes", until(lambda: app.poll() is not None, 10))

        start()
        look("after.png")
        recovery = folder / ".config/pacini-editor/recovery"
        check("and nothing is left to restore", not recovery.exists() or not any(recovery.glob("*.pacini*")),
              str([p.name for p in recovery.glob("*")] if recovery.exists() else ""))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
