#!/usr/bin/env python3
"""The published translations are those that people rated: envelopes of `encode --method` and of the rated vibrations are
the same. And of Pacini's own clips most are predicted to match better than the best of the four: a prediction, no rating.
"""

import csv
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

import numpy
import soundfile

pacini, folder = sys.argv[1], Path(sys.argv[2])
# Mean and least correlation over the sounds. Of pitchmatch the published loudness of frames of 10 ms, which are shorter
# than a period of its lowest bands, leaves open how those bands are measured.
BOUNDS = {"hapticgen": (0.999, 0.97), "freqshift": (0.999, 0.97), "percept": (0.999, 0.97), "pitchmatch": (0.96, 0.6)}


def envelope(file, step=0.05):
    signal, rate = soundfile.read(file)
    length = round(step * rate)
    return numpy.sqrt((signal[: len(signal) // length * length].reshape(-1, length) ** 2).mean(1))


def agreement(a, b):
    a, b = (envelope(file) for file in (a, b))
    frames = min(len(a), len(b))
    return numpy.corrcoef(a[:frames], b[:frames])[0, 1]


def run(*arguments):
    return subprocess.run([pacini, *map(str, arguments)], stdout=subprocess.PIPE, check=True).stdout


with open(folder / "pairs.csv", newline="") as file:
    pairs = list(csv.DictReader(file))
with tempfile.TemporaryDirectory() as made:
    made = Path(made)
    for method, (mean, least) in BOUNDS.items():
        run("encode", folder / "audio", "-o", made / method, "--method", method)
        found = [agreement(folder / pair["vibration"], made / method / (Path(pair["audio"]).stem + ".wav"))
                 for pair in pairs if pair["algorithm"] == method]
        print(f"{method}: mean {numpy.mean(found):.4f}, least {min(found):.4f}, "
              f"{sum(figure >= 0.97 for figure in found)} of {len(found)} at least .97")
        assert len(found) == 120 and numpy.mean(found) >= mean and min(found) >= least

    rated = defaultdict(list)
    for pair in pairs:
        report = json.loads(run("compare", folder / pair["audio"], folder / pair["vibration"], "--json"))
        rated[Path(pair["audio"]).stem].append(report["files"][0]["match"])
    run("encode", folder / "audio", "-o", made / "clips", "--format", "packed")
    run("render", made / "clips", "-o", made / "drive")
    own = {Path(file["candidate"]).stem: file["match"]
           for file in json.loads(run("compare", folder / "audio", made / "drive", "--json"))["files"]}
    size = sum(path.stat().st_size for path in (made / "clips").glob("*.pacb")) / (5 * len(own))
    better = sum(own[name] > max(others) for name, others in rated.items())
    print(f"a2vt is predicted above the best of the four for {better} of {len(rated)} sounds, at {size:.0f} B/s")
    assert better >= 0.7 * len(rated) and size <= 230
