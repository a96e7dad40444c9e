#!/usr/bin/env python3
"""The clip editor is killed at random moments of one long session, and goes on where it was each time.

check_kills.py PROGRAM DEMO [COUNT [SEED]]    DEMO: a sound; COUNT: how often, 10. Each time the program is started, what
was there is restored by its own question, markers are added by mouse and keys, and it is killed with SIGKILL at a
random moment. Exit 0, 1 when a marker is lost that had been there for a second, 77 when Xvfb or xdotool is not there.
"""
import json
import random
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

from check_editor import PLOT_LEFT, EditorScreen
from host_test import check, failures, until

KEPT_AFTER = 1.0  # s: what the manual promises
LONGEST = 3.0  # s of work before a kill
RULER = 26 + 42 + 26 - 10  # y of the ruler in the window
WIDTH = 1280 - 248 - PLOT_LEFT - 20  # of the plot


def markers(folder):
    """Those of the newest recovery file; none where there is no file."""
    files = sorted((folder / ".config/pacini-editor/recovery").glob("*.pacini-recovery"),
                   key=lambda file: file.stat().st_mtime)
    if not files:
        return None
    clips = json.loads(files[-1].read_text())["clips"]
    return len(clips[0]["clip"].get("markers", [])) if clips else 0


def main():
    program, demo = sys.argv[1], sys.argv[2]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 10
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 1
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder, EditorScreen(folder) as screen:
        folder = Path(folder)
        kept, oldest, places = 0, 0.0, []
        for turn in range(count):
            begins = len(places) < 50  # else two markers would be at one place
            if begins:
                shutil.rmtree(folder / ".config/pacini-editor/recovery", ignore_errors=True)
                kept, places = 0, chance.sample(range(WIDTH), WIDTH)
            app = screen.start(program, *([demo] if begins else []), env=screen.environment)
            if not until(screen.find_window):
                check(f"the window opens for the {turn + 1}. time", False)
                break
            time.sleep(3 if begins else 0.8)
            screen.focus()
            if not begins:
                screen.keys("Return")  # restore
                time.sleep(0.7)
            made = []  # when each marker was there
            end = time.monotonic() + chance.uniform(0.05, LONGEST)
            while time.monotonic() < end and places:
                screen.tool("mousemove", screen.left + PLOT_LEFT + places.pop(), screen.top + RULER,
                            "click", 1, "key", "m")
                made.append(time.monotonic())
                time.sleep(chance.uniform(0.0, 0.2))
            killed = time.monotonic()
            app.send_signal(signal.SIGKILL)
            app.wait()
            sure = kept + sum(1 for at in made if killed - at > KEPT_AFTER)
            there = markers(folder)
            if there is None:
                check(f"kill {turn + 1} of seed {seed} leaves something to restore", not sure, f"{sure} markers")
                continue
            if there < sure or there > kept + len(made):
                check(f"kill {turn + 1} of seed {seed} loses nothing older than {KEPT_AFTER:g} s", False,
                      f"{there} markers of {kept} before and {len(made)} new ones, {sure} of them sure")
            lost = made[there - kept:] if there >= kept else []
            oldest = max(oldest, killed - lost[0] if lost else 0.0)
            kept = there
        check(f"{count} kills of a session of seed {seed}, {kept} markers at last", kept > 0,
              f"the oldest change that was lost had been made {oldest:.2f} s before")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
