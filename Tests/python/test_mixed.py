"""Mixed models in the report of a study, which Python's statsmodels fits for the command."""

import json
import os
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import statsmodels  # noqa: F401
except ImportError:
    print("there is no statsmodels")
    sys.exit(77)

PACINI = os.environ["PACINI_COMMAND"]


class MixedModels(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        source = random.Random(5)
        lines = ["group,participant,stimulus,rating"]
        stimuli = [source.gauss(0, 1) for _ in range(8)]
        for group, mean in (("A", 5.0), ("B", 5.5), ("C", 7.5)):
            for person in range(10):
                own = source.gauss(0, 1)
                lines += [
                    f"{group},{person},s{i},{mean + own + effect + source.gauss(0, 1):.4f}"
                    for i, effect in enumerate(stimuli)
                ]
        (self.folder / "ratings.csv").write_text("\n".join(lines))

    def run_pacini(self, *arguments, path=None):
        environment = {**os.environ, "PATH": path or f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
        return subprocess.run(
            [PACINI, *arguments], cwd=self.folder, env=environment, capture_output=True, text=True, timeout=300
        )

    def test_balanced_ratings_give_what_the_analysis_of_variance_gives(self):
        done = self.run_pacini("--json", "study", "report", "ratings.csv", "--mixed")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["ratings"]["Ratings"]
        model = found["mixedModel"]
        self.assertTrue(model["converged"])
        groups = model["groups"]
        comparisons = {(one["first"], one["second"]): one["byParticipant"] for one in found["comparisons"]}
        # With as many ratings of everybody, the difference is that of the participants' means. Its error pools all
        # three groups, so that of two of them alone is near it, not the same.
        for other in "BC":
            pooled = comparisons["A", other]["pooled"]
            self.assertAlmostEqual(groups[other]["estimate"], -pooled["difference"], places=3)
            alone = abs(pooled["difference"] / pooled["t"])
            self.assertLess(abs(groups[other]["error"] / alone - 1.0), 0.35)
        # And it is the error that the variances give: 2 (person / n + rest / (n m)).
        expected = (2 * (model["participantVariance"] / 10 + model["residualVariance"] / 80)) ** 0.5
        self.assertAlmostEqual(groups["B"]["error"], expected, delta=0.02 * expected)
        self.assertAlmostEqual(groups["B"]["error"], groups["C"]["error"], places=6)
        self.assertLess(groups["C"]["p"], 0.005)
        # As it was made: all three are 1; three standard errors of so many.
        self.assertLess(abs(model["residualVariance"] - 1.0), 0.3)
        self.assertLess(abs(model["participantVariance"] - 1.0), 1.0)
        self.assertEqual(len(model["stimuli"]), 8)
        page = (self.folder / "ratings.report/report.md").read_text()
        self.assertIn("Mixed model: groups", page)
        self.assertIn("statsmodels", page)

    def test_one_group_and_no_model_are_told(self):
        text = (self.folder / "ratings.csv").read_text().splitlines()
        (self.folder / "one.csv").write_text("\n".join(line for line in text if line[0] not in "BC"))
        done = self.run_pacini("--json", "study", "report", "one.csv", "--mixed")
        self.assertEqual(done.returncode, 0, done.stderr)
        model = json.loads(done.stdout)["ratings"]["Ratings"]["mixedModel"]
        self.assertEqual(list(model["groups"]), ["A"])
        (self.folder / "few.csv").write_text("stimulus,rating\na,1\nb,2\n")
        done = self.run_pacini("study", "report", "few.csv", "--mixed")
        self.assertEqual(done.returncode, 1)
        self.assertIn("pacini: few.csv: ", done.stderr)

    def test_a_python_that_is_not_there_is_told(self):
        done = self.run_pacini("study", "report", "ratings.csv", "--mixed", path=str(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertIn("python3: cannot be started", done.stderr)
        # One without statsmodels.
        fake = self.folder / "bin"
        fake.mkdir()
        (fake / "python3").write_text(f'#!/bin/sh\nexec "{os.path.realpath(sys.executable)}" -I -S "$@"\n')
        (fake / "python3").chmod(0o755)
        done = self.run_pacini("study", "report", "ratings.csv", "--mixed", path=str(fake))
        self.assertEqual(done.returncode, 1)
        self.assertIn("pip install statsmodels", done.stderr)


if __name__ == "__main__":
    unittest.main()
