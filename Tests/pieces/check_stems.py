#!/usr/bin/env python3
"""What of each stem is felt: of twelve pieces whose stems are known, the share of the drive that moves with each.

check_stems.py PACINI

The envelope (RMS of 20 ms) of the drive is fitted by those of the stems, with weights of 0 or more. The share of a stem
is its part of the sum of the fitted envelope. Prints the table of Resources/docs/quality.md and checks what it shows:
music is led by its beat, and what is only heard does not push it aside. Needs NumPy and soundfile.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
import soundfile
from pieces import RATE, pieces

PRESETS = ("as-recorded", "music", "effects", "everything-heard")
LOW = {"kick", "bass", "drone", "hits", "boom"}


def envelope(samples, rate=RATE):
    step = round(0.02 * rate)
    whole = samples[: len(samples) // step * step].reshape(-1, step)
    return numpy.sqrt((whole**2).mean(1))


def not_negative(columns, wanted):
    """Least squares with weights of 0 or more, over every choice of columns: there are at most five."""
    best, weights = numpy.inf, numpy.zeros(columns.shape[1])
    for choice in range(1, 2 ** columns.shape[1]):
        chosen = [i for i in range(columns.shape[1]) if choice >> i & 1]
        found = numpy.linalg.lstsq(columns[:, chosen], wanted, rcond=None)[0]
        error = ((columns[:, chosen] @ found - wanted) ** 2).sum()
        if (found >= 0).all() and error < best:
            best, weights = error, numpy.zeros(columns.shape[1])
            weights[chosen] = found
    return weights


def shares(stems, drive, rate):
    columns = numpy.stack([envelope(samples) for samples in stems.values()], 1)
    wanted = envelope(drive, rate)[: len(columns)]
    columns = columns[: len(wanted)]
    parts = not_negative(columns, wanted) * columns.sum(0)
    return dict(zip(stems, parts / parts.sum()))


def main():
    pacini = sys.argv[1]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, stems in pieces():
            sound = Path(folder) / "piece.wav"
            soundfile.write(sound, sum(stems.values()), RATE, subtype="PCM_16")
            found = {}
            for preset in PRESETS:
                for words in (("encode", sound, "-o", f"{folder}/clip.pacb", "--preset", preset),
                              ("render", f"{folder}/clip.pacb", "-o", f"{folder}/drive.wav")):
                    subprocess.run([pacini, *map(str, words), "-q", "-y"], check=True)
                found[preset] = shares(stems, *soundfile.read(Path(folder) / "drive.wav"))
            rows.append((name, found))
    print(f"| piece | {' | '.join(f'`{preset}`' for preset in PRESETS)} |\n|---|{'---|' * len(PRESETS)}")
    for name, found in rows:
        told = (", ".join(f"{stem} {100 * share:.0f}" for stem, share in found[preset].items()) for preset in PRESETS)
        print(f"| {name} | {' | '.join(told)} |")
    led = {preset: numpy.mean([sum(share for stem, share in found[preset].items() if stem in LOW)
                               for _, found in rows if LOW & found[preset].keys()]) for preset in PRESETS}
    print(f"| mean of low stems | {' | '.join(f'{100 * led[preset]:.0f}' for preset in PRESETS)} |")
    assert led["as-recorded"] >= led["music"] >= led["effects"] > led["everything-heard"]
    assert led["effects"] >= 0.6
    for name, found in rows:
        if "kick" in found["effects"]:
            assert found["effects"]["kick"] >= 0.75 * found["as-recorded"]["kick"], name


if __name__ == "__main__":
    main()
