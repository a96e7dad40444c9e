#!/usr/bin/env python3
"""The delay between sound and touch, measured in the window over cables whose delay is known.

check_latency.py PROGRAM PACINI JACKDELAY [SECONDS]
    SECONDS: by the command too, for so long, as between two devices (3600 for an hour). Exit 0, 1 on a failed check, 77
    when Xvfb, xdotool or JACK is not there.
"""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from check_study import Window, make_study
from host_test import RATE, check, failures, needs, until

needs("Xvfb", "xdotool", "jackd", "jack_lsp", "jack_connect", "jack_disconnect", sys.argv[3])

DELAY = 333  # frames
MEASURE_PAGE, MEASURE = (316, 560), (260, 422)  # buttons, in the window as it opens


def measured(study):
    file = study / "latency.json"
    return json.loads(file.read_text())["measurements"] if file.exists() else []


def main():
    program, pacini, jackdelay = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as name, Window(name) as window:
        folder = Path(name)
        study, _ = make_study(pacini, folder)
        def jack(command, *arguments):
            done = subprocess.run([command, *arguments], env=window.environment, capture_output=True, text=True)
            return done.stdout if done.returncode == 0 else ""

        check("the sound server runs", window.start_sound_server(window.environment))
        window.start(jackdelay, str(DELAY), env=window.environment)
        window.start(program, "--fresh", "--device-type", "JACK", "--study", study, env=window.environment)
        check("the window opens", until(window.find_window))
        check("on its outputs", until(lambda: "JUCEJack:out_3" in jack("jack_lsp")))
        time.sleep(1)
        window.focus()
        window.move(*MEASURE_PAGE)
        window.tool("click", 1)
        check("its inputs are opened", until(lambda: "JUCEJack:in_2" in jack("jack_lsp")))
        time.sleep(1)

        def measure(label, cables, number):
            for source, target in cables:
                jack("jack_connect", source, target)
            time.sleep(0.3)
            window.focus()
            window.move(*MEASURE)
            window.tool("click", 1)
            there = until(lambda: len(measured(study)) == number, 20)
            if picture := os.environ.get("PACINI_STUDY_PICTURE"):
                subprocess.run(["import", "-window", "root", f"{picture}-{number}.png"], env=window.environment)
            for source, target in cables:
                jack("jack_disconnect", source, target)
            check(f"{label}: a result is kept", there)
            return measured(study)[-1] if there else None

        outs = ("JUCEJack:out_1", "JUCEJack:out_3")
        through = [(outs[0], "JUCEJack:in_1"), (outs[1], "delay:in"), ("delay:out", "JUCEJack:in_2")]
        for label, cables, wanted in (
                ("one device", [(outs[0], "JUCEJack:in_1"), (outs[1], "JUCEJack:in_2")], 0.0),
                ("the touch late", through, DELAY / int(RATE)),
                ("the sound late", [(outs[1], "JUCEJack:in_2"), (outs[0], "delay:in"), ("delay:out", "JUCEJack:in_1")],
                 -DELAY / int(RATE))):
            found = measure(label, cables, len(measured(study)) + 1)
            if found:
                check(f"{label}: within .01 ms", abs(found["delay"] - wanted) < 1e-5,
                      f"{1000 * found['delay']:.4f} ms, {1000 * wanted:.4f} ms wanted, SD {1000 * found['deviation']:.4f} ms")
        # A cable that is not there is told, and nothing is kept.
        before = len(measured(study))
        jack("jack_connect", outs[0], "JUCEJack:in_1")
        window.move(*MEASURE)
        window.tool("click", 1)
        time.sleep(12.5)
        if picture := os.environ.get("PACINI_STUDY_PICTURE"):
            subprocess.run(["import", "-window", "root", f"{picture}-missing.png"], env=window.environment)
        check("without a cable nothing is kept", len(measured(study)) == before)
        jack("jack_disconnect", outs[0], "JUCEJack:in_1")

        # Escape ends the bursts, and leads back.
        for source, target in through:
            jack("jack_connect", source, target)
        window.move(*MEASURE)
        window.tool("click", 1)
        time.sleep(2)
        window.keys("Escape")
        check("Escape closes the inputs", until(lambda: "JUCEJack:in_2" not in jack("jack_lsp"), 5))
        time.sleep(10)
        check("and nothing is kept of what was stopped", len(measured(study)) == before)

        if len(sys.argv) > 4:
            seconds = int(sys.argv[4])
            probe, recorded = folder / "probe.wav", folder / "recorded.wav"
            subprocess.run([pacini, "study", "latency", study, "--probe", probe, "--duration", str(seconds), "-q"],
                           check=True)
            recorder = window.start("jack_rec", "-f", recorded, "-d", str(seconds), "-b", "24", "delay:out",
                                    "system:capture_1", env=window.environment)
            # The player is found by its ports, and both of its channels are led to the recorder.
            window.start("jack-play", "-u", probe, env=window.environment)
            check("it plays", until(lambda: ":out_2" in jack("jack_lsp", "jack-play")))
            player = [port for port in jack("jack_lsp", "jack-play").split() if "out_" in port]
            taken = [port for port in jack("jack_lsp", "jackrec").split()]
            jack("jack_disconnect", "system:capture_1", taken[1])
            jack("jack_connect", player[0], taken[1])
            jack("jack_connect", player[1], "delay:in")
            recorder.wait(seconds + 60)
            told = subprocess.run([pacini, "study", "latency", study, recorded, "--sound", "2", "--touch", "1", "--json"],
                                  capture_output=True, text=True)
            found = json.loads(told.stdout)
            check(f"over {seconds} s: within .01 ms", abs(found["delay"] - DELAY / int(RATE)) < 1e-5,
                  f"{1000 * found['delay']:.4f} ms, SD {1000 * found['deviation']:.4f}, largest {1000 * found['largest']:.4f}, "
                  f"drift {1000 * found['drift']:.4f} ms/h, {found['bursts']} bursts, {found['missed']} missed")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
