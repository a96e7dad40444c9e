#!/usr/bin/env python3
"""Fits the predicted match to ratings by people, and says how far it can be believed.

Reads the ratings "how well does this vibration match this sound" of a folder with pairs.csv (id, class, algorithm,
rating, audio, vibration), lets `pacini compare` measure all pairs, and fits the rating by ridge regression on the parts.
Every figure is of kinds of sound that the fit has not seen: each kind is predicted from the others.

    python3 Tests/human/fit_match.py --pacini build/release/bin/pacini ../shared/human/sound2hap

Needs NumPy. The ratings are not part of this repository: their licence is unsettled.
"""

import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

PARTS = ["attacks", "envelope", "roughness", "brightness", "movement", "silence"]
CHOSEN = ["attacks", "envelope"]  # what predictedMatch() of MatchParts.h uses
RIDGE = 20.0  # pairs' worth of belief that a part says nothing
ROUNDS = 1000  # of the bootstrap


def ranks(values):
    """Ranks from 0, the mean of them for ties."""
    values = np.asarray(values)
    order = np.argsort(values, kind="stable")
    sorted_values = values[order]
    first = np.searchsorted(sorted_values, sorted_values, side="left")
    last = np.searchsorted(sorted_values, sorted_values, side="right")
    result = np.empty(len(values))
    result[order] = (first + last - 1) / 2
    return result


def spearman(x, y):
    """Rank correlation; 0 when one side says the same of everything."""
    x, y = ranks(x), ranks(y)
    x, y = x - x.mean(), y - y.mean()
    power = np.sqrt((x * x).sum() * (y * y).sum())
    return float((x * y).sum() / power) if power > 0 else 0.0


def means_of(values, keys):
    """The mean of each key, and its index for each value."""
    _, index = np.unique(keys, return_inverse=True)
    sums = np.bincount(index, values)
    return sums / np.bincount(index), index


def measure(pacini, folder, pairs):
    """Measures of `pacini compare` for all pairs, in their order."""
    with tempfile.TemporaryDirectory() as place:
        for i, pair in enumerate(pairs):
            for side, file in (("sounds", pair["audio"]), ("vibrations", pair["vibration"])):
                path = Path(place, side, f"{i:05}{Path(file).suffix}")
                path.parent.mkdir(exist_ok=True)
                shutil.copyfile(folder / file, path)  # four pairs share a sound, which would be measured once if linked
        done = subprocess.run(
            [pacini, "compare", str(Path(place, "sounds")), str(Path(place, "vibrations")), "--json"],
            stdout=subprocess.PIPE,
            check=True,
        )
    report = json.loads(done.stdout)
    files = sorted(report["files"], key=lambda file: Path(file["reference"]).name)
    if len(files) != len(pairs):
        sys.exit(f"{len(pairs)} pairs, but {len(files)} were compared")
    return files, report["timesRealTime"]


def fit(x, rating):
    """Weights of the columns and the constant."""
    mean, scale = x.mean(axis=0), x.std(axis=0) + 1e-9
    z = (x - mean) / scale
    weights = np.linalg.solve(z.T @ z + RIDGE * np.eye(x.shape[1]), z.T @ (rating - rating.mean())) / scale
    return weights, rating.mean() - weights @ mean


def predict_unseen(x, rating, kinds):
    """Each kind predicted from the others."""
    predicted = np.empty(len(rating))
    for kind in np.unique(kinds):
        unseen = kinds == kind
        weights, constant = fit(x[~unseen], rating[~unseen])
        predicted[unseen] = x[unseen] @ weights + constant
    return predicted


class Judgement:
    """Agreement of a prediction with the ratings, in the four ways that the pages state."""

    NAMES = ["all pairs", "within a sound", "kinds x algorithms", "without the weakest"]

    def __init__(self, rating, kinds, algorithms, sounds):
        self.rating, self.kinds, self.algorithms, self.sounds = rating, kinds, algorithms, sounds

    def of(self, predicted, chosen=None):
        chosen = np.arange(len(self.rating)) if chosen is None else chosen
        p, r = predicted[chosen], self.rating[chosen]
        kinds, algorithms, sounds = self.kinds[chosen], self.algorithms[chosen], self.sounds[chosen]
        of_sound_p, index = means_of(p, sounds)
        of_sound_r, _ = means_of(r, sounds)
        cells = np.char.add(np.char.add(kinds, "/"), algorithms)
        strong = algorithms != self.weakest()
        return [
            spearman(p, r),
            spearman(p - of_sound_p[index], r - of_sound_r[index]),
            spearman(means_of(p, cells)[0], means_of(r, cells)[0]),
            spearman(p[strong], r[strong]),
        ]

    def weakest(self):
        means, index = means_of(self.rating, self.algorithms)
        return self.algorithms[np.flatnonzero(index == means.argmin())[0]]

    def interval(self, predicted, generator):
        """95 % of what other draws of sounds would give."""
        names = np.unique(self.sounds)
        places = {name: np.flatnonzero(self.sounds == name) for name in names}
        rounds = [
            self.of(predicted, np.concatenate([places[name] for name in generator.choice(names, len(names))]))
            for _ in range(ROUNDS)
        ]
        return np.percentile(rounds, [2.5, 97.5], axis=0)


def row(name, figures, interval=None):
    cells = [f"{figure:5.2f}" for figure in figures]
    if interval is not None:
        cells = [f"{cell} [{low:.2f}, {high:.2f}]" for cell, low, high in zip(cells, *interval)]
    print(f"| {name} | " + " | ".join(cells) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the folder with pairs.csv")
    parser.add_argument("--pacini", default=os.environ.get("PACINI_COMMAND", "pacini"), help="the command (pacini)")
    parser.add_argument("--json", action="store_true", help="only the figures of the prediction, as JSON")
    options = parser.parse_args()
    with open(options.folder / "pairs.csv", newline="") as file:
        pairs = list(csv.DictReader(file))
    files, speed = measure(options.pacini, options.folder, pairs)
    rating = np.array([float(pair["rating"]) for pair in pairs])
    kinds = np.array([pair["class"] for pair in pairs])
    algorithms = np.array([pair["algorithm"] for pair in pairs])
    sounds = np.array([pair["id"] for pair in pairs])
    parts = {part: np.array([file["matchParts"][part] for file in files]) for part in PARTS}
    judgement = Judgement(rating, kinds, algorithms, sounds)
    generator = np.random.default_rng(1)

    def unseen(names, of=rating):
        return predict_unseen(np.column_stack([parts[name] for name in names]), of, kinds)

    chosen = unseen(CHOSEN)
    shuffled = [judgement.of(unseen(CHOSEN, generator.permutation(rating))) for _ in range(100)]
    means, index = means_of(chosen, algorithms)
    order = {algorithms[np.flatnonzero(index == i)[0]]: float(mean) for i, mean in enumerate(means)}
    if options.json:
        json.dump({"unseen": judgement.of(chosen), "shuffled": list(np.mean(shuffled, axis=0)), "means": order}, sys.stdout)
        return
    print(f"{len(pairs)} ratings of {len(np.unique(sounds))} sounds of {len(np.unique(kinds))} kinds\n")
    print("Spearman's correlation, each kind predicted from the others [95 %, bootstrap over sounds]\n")
    print("| measure | " + " | ".join(Judgement.NAMES) + " |")
    print("|---|" + "---|" * len(Judgement.NAMES))
    row("predicted match", judgement.of(chosen), judgement.interval(chosen, generator))
    for key, name, sign in (("hts", "HTS", 1), ("lsd", "LSD", -1), ("wideSnr", "wide SNR", 1), ("bandSnr", "band SNR", 1)):
        other = sign * np.array([file[key] for file in files])
        row(name, judgement.of(other), judgement.interval(other, generator))
    for part in PARTS:
        row(f"{part} alone, not fitted", judgement.of(parts[part]))
    for part in CHOSEN:
        row(f"match without {part}", judgement.of(unseen([name for name in CHOSEN if name != part])))
    for part in PARTS:
        if part not in CHOSEN:
            row(f"match with {part}", judgement.of(unseen(CHOSEN + [part])))
    row("match of all parts", judgement.of(unseen(PARTS)))
    row("shuffled ratings (mean of 100)", np.mean(shuffled, axis=0))
    others = (means_of(rating, np.char.add(kinds, algorithms))[0][means_of(rating, np.char.add(kinds, algorithms))[1]])
    counts = np.array([(np.char.add(kinds, algorithms) == cell).sum() for cell in np.char.add(kinds, algorithms)])
    row("ceiling: mean of the cell's other ratings", judgement.of((others * counts - rating) / (counts - 1)))
    print("\nMeans of the algorithms, predicted and rated:")
    for name in sorted(order, key=order.get, reverse=True):
        print(f"    {name:12} {order[name]:5.1f}   {rating[algorithms == name].mean():5.1f}")
    weights, constant = fit(np.column_stack([parts[name] for name in CHOSEN]), rating)
    terms = " + ".join(f"{weight:.1f} {name}" for name, weight in zip(CHOSEN, weights))
    print(f"\nFitted to all kinds: {constant:.1f} + {terms}")
    print(f"pacini compare: {speed:.0f} times real time")


if __name__ == "__main__":
    main()
