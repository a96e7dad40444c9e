#!/usr/bin/env python3
"""The predicted match agrees with people on kinds of sound that it was not fitted to, and with shuffled ratings it does not."""

import json
import subprocess
import sys
from pathlib import Path

pacini, folder = sys.argv[1:]
fit = Path(__file__).with_name("fit_match.py")
done = subprocess.run([sys.executable, "-B", fit, "--pacini", pacini, "--json", folder], stdout=subprocess.PIPE, check=True)
report = json.loads(done.stdout)
least = [0.35, 0.40, 0.65, 0.20]  # all pairs, within a sound, kinds x algorithms, without the weakest algorithm
print("unseen kinds:", [round(figure, 3) for figure in report["unseen"]], "at least", least)
print("shuffled:", [round(figure, 3) for figure in report["shuffled"]])
print("means:", {name: round(mean, 1) for name, mean in report["means"].items()})
vibrations = Path(folder).parent / "vibviz"
impression = Path(__file__).with_name("fit_impression.py")
table = subprocess.run([sys.executable, "-B", impression, "--pacini", pacini, vibrations], stdout=subprocess.PIPE, check=True).stdout.decode()
print(table)
unseen = {row[1].strip(): float(row[2]) for row in (line.split("|") for line in table.splitlines()[4:]) if len(row) > 2}
assert unseen["energy"] >= 0.6 and unseen["tempo"] >= 0.55 and unseen["roughness"] >= 0.5
assert all(figure >= bound for figure, bound in zip(report["unseen"], least))
assert all(abs(figure) < 0.1 for figure in report["shuffled"])
assert max(report["means"], key=report["means"].get) == "pitchmatch"
assert min(report["means"], key=report["means"].get) == "percept"
