#!/usr/bin/env python3
"""Fits how strong, fast and rough people call a vibration, and says how far it can be believed.

Reads the ratings of VibViz (energy, tempo and roughness from -3 to 3) from a folder with vibrationAnnotations*.csv and
wav/, lets `pacini compare` measure all vibrations, and fits each rating by ridge regression. Figures are of vibrations
that the fit has not seen: ten-fold.

    python3 Tests/human/fit_impression.py --pacini build/release/bin/pacini ../shared/human/vibviz

Needs NumPy. The ratings are not part of this repository.
"""

import argparse
import csv
import json
import os
import subprocess
from pathlib import Path

import numpy as np
from fit_match import spearman

MODELS = {  # what feltImpression() of FeltImpression.h uses
    "energy": ("strength", ["level", "octave"]),
    "tempo": ("tempo", ["pulses", "level", "octave"]),
    "roughness": ("roughness", ["fluctuation", "octave", "meanLevel"]),
}
RIDGE = 5.0
FOLDS = 10


def fit(x, rating):
    mean, scale = x.mean(axis=0), x.std(axis=0)
    z = (x - mean) / scale
    weights = np.linalg.solve(z.T @ z + RIDGE * np.eye(x.shape[1]), z.T @ (rating - rating.mean())) / scale
    return weights, rating.mean() - weights @ mean


def unseen(x, rating):
    """Each tenth predicted from the others."""
    fold = np.arange(len(rating)) % FOLDS
    predicted = np.empty(len(rating))
    for k in range(FOLDS):
        weights, constant = fit(x[fold != k], rating[fold != k])
        predicted[fold == k] = x[fold == k] @ weights + constant
    return predicted


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the folder with vibrationAnnotations*.csv and wav/")
    parser.add_argument("--pacini", default=os.environ.get("PACINI_COMMAND", "pacini"), help="the command (pacini)")
    options = parser.parse_args()
    with open(next(options.folder.glob("vibrationAnnotations*.csv")), newline="", errors="replace") as file:
        rated = {row["id"]: row for row in csv.DictReader(file)}
    folder = str(options.folder / "wav")
    done = subprocess.run([options.pacini, "compare", folder, folder, "--json"], stdout=subprocess.PIPE, check=True)
    files = {Path(file["candidate"]).stem: file["impression"] for file in json.loads(done.stdout)["files"]}
    names = [name for name in rated if name in files]
    generator = np.random.default_rng(1)
    print(f"{len(names)} vibrations\n\n| rating | Spearman, unseen | as built in | shuffled | fit |\n|---|---|---|---|---|")
    for rating, (built, parts) in MODELS.items():
        y = np.array([float(rated[name][rating]) for name in names])
        x = np.array([[files[name]["parts"][part] for part in parts] for name in names])
        shuffled = np.mean([spearman(unseen(x, z), z) for z in (generator.permutation(y) for _ in range(100))])
        weights, constant = fit(x, y)
        terms = " ".join(f"{weight:+.3f} {part}" for part, weight in zip(parts, weights))
        inside = spearman([files[name][built] for name in names], y)
        print(f"| {rating} | {spearman(unseen(x, y), y):.2f} | {inside:.2f} | {shuffled:.2f} | {constant:.2f} {terms} |")


if __name__ == "__main__":
    main()
