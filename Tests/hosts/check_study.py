#!/usr/bin/env python3
"""A study with people, on a screen that nobody sees: simulated persons answer with the keyboard alone.

check_study.py PROGRAM PACINI    Exit 0, 1 on a failed check, 77 when Xvfb, xdotool or JACK is not there.

Three persons, one for each group; PACINI_STUDY_PERSONS=33 for a study of the size of Weber (2020). One of them is
killed in the middle and goes on. The program plays on a sound server without a sound card, where sound and touch are
recorded: they are the same file, and have to be the same samples.
"""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from host_test import RATE, check, failures, needs, skip, until
from screen import Screen

try:
    import numpy as np
    import soundfile
except ImportError as error:
    skip(error)
needs("Xvfb", "xdotool", "jackd", "jack_lsp", "jack_rec")

PERSONS = max(3, int(os.environ.get("PACINI_STUDY_PERSONS", "3")) // 3 * 3)
CONTINUE = 479, 448  # where the button of an unfinished session is, in the window as it opens


def make_study(pacini, folder):
    """The study of the template, with touches that are the sounds themselves; the number of its trials per person."""
    rng = np.random.default_rng(20)
    sounds = []
    for name in ("knock", "scrape", "hum"):
        sounds.append(folder / f"{name}.wav")
        soundfile.write(sounds[-1], 0.3 * rng.standard_normal(int(0.25 * int(RATE))), int(RATE), subtype="FLOAT")
    size = PERSONS // 3
    groups = [f"--group={name}:{size}" for name in "ABC"]
    study = folder / "coherence"
    subprocess.run([pacini, "study", "new", study, "--template", "coherence", *groups, *sounds, "-q"], check=True)
    document = json.loads((study / "study.json").read_text())
    for stimulus in document["stimuli"]:
        stimulus["drive"] = stimulus["sound"]
    for block in document["blocks"]:
        block["masking"] = False
    (study / "study.json").write_text(json.dumps(document))
    return study, 2 * len(sounds)


class Window(Screen):
    def find_window(self):
        return super().find_window("^coherence$")


def records(log):
    """Whole lines of a session that are answers."""
    if not log.exists():
        return []
    lines = [line for line in log.read_text().split("\n")[:-1] if line]
    return [record for record in map(json.loads, lines) if record["type"] == "answer"]


def answer(window, log, number):
    """One trial by the keyboard: it is played, then described or rated."""
    before = len(records(log))
    window.keys("space")
    words = before < 3
    for attempt in range(20):
        # Keys do nothing until it was played to its end.
        time.sleep(0.5 if attempt == 0 else 0.2)
        if attempt % 8 == 7:
            window.tool("windowfocus", window.window)
            window.keys("Escape", "Return", "space")  # it was interrupted
            time.sleep(1.5)
        if words:
            window.type("rough,")
            window.keys("Tab", "Return")
        else:
            window.keys(*["Right"] * (1 + number % 3), "Return")
        if until(lambda: len(records(log)) > before, 0.5):
            return True
    return False


def main():
    program, pacini = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as name, Window(name) as window:
        folder = Path(name)
        study, trials = make_study(pacini, folder)
        def ports():
            listed = subprocess.run(["jack_lsp"], env=window.environment, capture_output=True, text=True)
            return listed.stdout if listed.returncode == 0 else ""

        def begin():
            process = window.start(program, "--fresh", "--device-type", "JACK", "--study", study,
                                   env=window.environment)
            check("the window opens", until(window.find_window))
            check("on its outputs", until(lambda: "JUCEJack:out_3" in ports()))
            time.sleep(1)
            window.focus()
            return process

        check("the sound server runs", window.start_sound_server(window.environment))
        process = begin()
        for person in range(PERSONS):
            log = study / "sessions" / f"P{person + 1:03}.jsonl"
            window.keys("Return", "Return", "Return")  # a new participant, welcome, consent
            check(f"person {person + 1} has begun", until(log.exists))
            time.sleep(0.5)
            for trial in range(trials):
                if person == 1 and trial == 4:
                    process.kill()
                    process.wait()
                    until(lambda: "JUCEJack" not in ports())
                    kept = records(log)
                    process = begin()
                    window.move(*CONTINUE)
                    window.tool("click", 1)
                    time.sleep(0.8)
                    check("after kill -9 nothing is lost", len(kept) == 4, f"{len(kept)} answers")
                if person == 0 and trial == trials - 1:
                    # What comes out while the last touch of the first person is felt.
                    heard = folder / "heard.wav"
                    recorder = window.start("jack_rec", "-f", str(heard), "-d", "3", "-b", "24", "JUCEJack:out_1",
                                            "JUCEJack:out_3", env=window.environment)
                    time.sleep(0.7)
                if not answer(window, log, trial):
                    check(f"person {person + 1}, trial {trial + 1} is answered", False)
                    if picture := os.environ.get("PACINI_STUDY_PICTURE"):
                        subprocess.run(["import", "-window", "root", picture], env=window.environment)
                    return 1
                if person == 0 and trial == trials - 1:
                    recorder.wait(60)
            check(f"person {person + 1} has answered {trials} times", len(records(log)) == trials,
                  json.loads(log.read_text().split("\n")[0])["group"])
            window.keys("Return")  # close the last page
            time.sleep(0.3)

        samples = soundfile.read(folder / "heard.wav")[0]
        sound, touch = (np.flatnonzero(samples[:, c]) for c in (0, 1))
        check("sound and touch came out", len(sound) > 1000 and len(touch) > 1000)
        group = json.loads((study / "sessions" / "P001.jsonl").read_text().split("\n")[0])["group"]
        apart = int(touch[0]) - int(sound[0]) if len(sound) and len(touch) else -1
        # One after the other with half a second between; at once in group C. 1 ms is that of the limiter's look-ahead,
        # which is taken out.
        wanted = 0 if group == "C" else int((0.25 + 0.5) * int(RATE))
        check("at the right sample", apart == wanted, f"touch {apart} samples after sound, {wanted} wanted")

        report = subprocess.run([pacini, "study", "report", study, "--json"], capture_output=True, text=True)
        found = json.loads(report.stdout)
        check("the report has everybody", all(entry["finished"] == PERSONS // 3
                                              for entry in found["participants"].values()), report.stderr)
        check("and what they said", all("rough" in words for words in found["words"].values()), found["words"])
        if picture := os.environ.get("PACINI_STUDY_REPORT"):
            subprocess.run(["cp", "-r", study / "report", picture], check=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
