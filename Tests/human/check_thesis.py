#!/usr/bin/env python3
"""The statistics of Weber (2020), chapter 5, out of its ratings (table A.1), digit by digit, by `pacini study report`.

check_thesis.py PACINI TABLE_A1.csv

The printed tables stand here; the ratings do not: they are not part of the repository.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PACINI, TABLE = sys.argv[1:3]

# Table 5.2 as printed: for each stimulus mean and SD of A, B, C, and of all groups. The SDs of all groups repeat those
# of group C, line by line; the right ones stand in the next list. In the last line the SD of B (2.0853) is cut off, not
# rounded.
PRINTED_5_2 = """
1 5.27 1.95 6.45 2.02 7.18 1.08 6.30 1.08
2 5.55 2.42 7.00 2.45 6.09 1.92 6.21 1.92
3 7.27 2.00 7.64 2.54 8.45 1.69 7.79 1.69
4 7.09 1.51 6.27 2.15 7.55 1.21 6.97 1.21
5 8.09 1.87 8.09 2.07 8.73 1.19 8.30 1.19
6 7.18 1.89 7.55 1.86 7.64 1.12 7.45 1.12
7 7.09 1.45 6.82 2.40 7.36 1.29 7.09 1.29
8 6.64 1.86 7.09 1.45 7.45 1.75 7.06 1.75
9 5.18 2.44 6.36 2.11 8.18 1.94 6.58 1.94
10 7.55 1.63 6.55 1.57 8.82 1.33 7.64 1.33
Total 6.69 2.08 6.98 2.08 7.75 1.63 7.14 1.99
"""
RIGHT_SDS = "1.86 2.29 2.10 1.70 1.72 1.62 1.74 1.68 2.45 1.75".split()

PRINTED_5_3 = """
A B -0.78 18 0.84 0.45
A C -2.55 18 0.92 0.02
B C -2.35 18 0.73 0.03
{A+B} C -2.62 18 0.78 0.02
"""

# Table A.2 as printed: t, degrees of freedom, pooled SD, p of each stimulus. The first t of {A+B} is cut off.
PRINTED_A_2 = {
    ("A", "B"): """
1 -1.395 20 1.986 0.178
2 -1.400 20 2.436 0.177
3 -0.373 20 2.288 0.713
4 1.032 20 1.859 0.314
5 0.000 20 1.973 1.000
6 -0.455 20 1.876 0.654
7 0.323 20 1.982 0.750
8 -0.640 20 1.665 0.529
9 -1.214 20 2.282 0.239
10 1.462 20 1.604 0.159
""",
    ("A", "C"): """
1 -2.837 20 1.578 0.010
2 -0.585 20 2.187 0.565
3 -1.493 20 1.856 0.151
4 -0.777 20 1.372 0.446
5 -0.953 20 1.567 0.352
6 -0.687 20 1.552 0.500
7 -0.467 20 1.368 0.645
8 -1.062 20 1.807 0.301
9 -3.19 20 2.205 0.005
10 -2.004 20 1.489 0.059
""",
    ("B", "C"): """
1 -1.054 20 1.618 0.304
2 0.969 20 2.201 0.344
3 -0.889 20 2.160 0.385
4 -1.710 20 1.745 0.103
5 -0.883 20 1.690 0.388
6 -0.139 20 1.537 0.891
7 -0.664 20 1.926 0.514
8 -0.531 20 1.607 0.601
9 -2.104 20 2.027 0.048
10 -3.662 20 1.455 0.002
""",
    ("{A+B}", "C"): """
1 -2.00 31 1.78 0.054
2 0.21 31 2.32 0.834
3 -1.30 31 2.08 0.203
4 -1.39 31 1.68 0.174
5 -1.00 31 1.72 0.325
6 -0.45 31 1.64 0.656
7 -0.63 31 1.76 0.533
8 -0.95 31 1.68 0.348
9 -2.97 31 2.20 0.006
10 -3.09 31 1.55 0.004
""",
}


def lines(text):
    return [line.split() for line in text.strip().splitlines()]


class Thesis(unittest.TestCase):
    def setUp(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [PACINI, "study", "report", TABLE, "--combine", "A+B", "--unpaired", "-o", folder, "--json"]
            report = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
            self.page = Path(folder, "report.md").read_text()
        self.report = report["ratings"]["Ratings"]
        self.groups = {group["group"]: group for group in self.report["groups"]}
        self.everybody = self.report["everybody"]
        self.comparisons = {(one["first"], one["second"]): one for one in self.report["comparisons"]}
        self.differ = []

    def digits(self, where, printed, value):
        """Notes where a printed number is not the value, rounded to as many digits."""
        decimals = len(printed.partition(".")[2])
        found = f"{value:.{decimals}f}"
        if float(found) == 0.0:
            found = f"{0.0:.{decimals}f}"
        if found != printed:
            self.differ.append((where, printed, found))

    def test_table_5_2(self):
        for name, *numbers in lines(PRINTED_5_2):
            people = [self.groups["A"], self.groups["B"], self.groups["C"], self.everybody]
            for i, group in enumerate(people):
                sample = group["answers"] if name == "Total" else group["stimuli"][name]
                self.digits(f"{name}, {'ABC*'[i]}, mean", numbers[2 * i], sample["mean"])
                self.digits(f"{name}, {'ABC*'[i]}, SD", numbers[2 * i + 1], sample["sd"])
        # The print is wrong there, and nowhere else.
        wrong = [
            (f"{i + 1}, *, SD", printed[8], right)
            for i, (printed, right) in enumerate(zip(lines(PRINTED_5_2), RIGHT_SDS))
        ]
        self.assertEqual(self.differ, [*wrong, ("Total, B, SD", "2.08", "2.09")])
        for printed in lines(PRINTED_5_2)[:10]:
            self.assertEqual(printed[8], printed[6])

    def test_table_5_3(self):
        for first, second, t, degrees, sd, p in lines(PRINTED_5_3):
            test = self.comparisons[first, second]["byStimulus"]
            for name, printed in (("t", t), ("degrees", degrees), ("sd", sd), ("p", p)):
                self.digits(f"{first} {second} {name}", printed, test[name])
            self.assertGreater(test["equalVarianceP"], 0.05)
        self.assertEqual(self.differ, [])

    def test_table_a_2(self):
        for pair, printed in PRINTED_A_2.items():
            for stimulus, *numbers in lines(printed):
                test = self.comparisons[pair]["stimuli"][stimulus]
                for name, number in zip(("t", "degrees", "sd", "p"), numbers):
                    self.digits(f"{'-'.join(pair)} {stimulus} {name}", number, test[name])
        self.assertEqual(self.differ, [("{A+B}-C 1 t", "-2.00", "-2.01")])

    def test_a_sounder_test_says_less(self):
        found = {pair: f"{one['byParticipant']['pooled']['p']:.3f}" for pair, one in self.comparisons.items()}
        self.assertEqual(found["A", "C"], "0.010")
        self.assertEqual(found["B", "C"], "0.056")
        self.assertEqual(found["{A+B}", "C"], "0.013")
        # Of the forty tests of single stimuli nothing is left.
        corrected = [test["holm"] for one in self.comparisons.values() for test in one["stimuli"].values()]
        self.assertEqual(len(corrected), 40)
        self.assertGreater(min(corrected), 0.05)
        self.assertIn("0 after Holm's correction", self.page)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
