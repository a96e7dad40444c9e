"""Statistics of the report of a study against SciPy, statsmodels and pingouin: twenty studies with gaps and uneven
groups."""

import json
import os
import random
import subprocess
import sys
import tempfile
import unittest
from itertools import combinations
from pathlib import Path

try:
    import numpy as np
    import pandas as pd
    import pingouin as pg
    from scipy import stats
    from statsmodels.stats.multitest import multipletests
except ImportError as error:
    print(f"there is no {error.name}")
    sys.exit(77)

PACINI = os.environ["PACINI_COMMAND"]


def simulated(seed):
    """Rows of group, participant, stimulus and rating; answers of a person come twice at times, or are missing."""
    source = random.Random(seed)
    stimuli = [f"s{i:02}" for i in range(source.randint(3, 14))]
    effects = {name: source.gauss(5, 1) for name in stimuli}
    rows = []
    for group in "AB"[: source.randint(1, 2)]:
        for person in range(source.randint(4, 15)):
            own = source.gauss(0, 1)
            for name in stimuli:
                if source.random() < 0.1:
                    continue
                for _ in range(2 if source.random() < 0.2 else 1):
                    value = effects[name] + own + (group == "B") * 0.7 + source.gauss(0, 1)
                    # Some scales are coarse, so that there are ties.
                    rows.append((group, f"{group}{person}", name, round(value) if seed % 2 else round(value, 6)))
    return rows


def people(rows):
    """The mean of each person and stimulus: {group: {person: {stimulus: mean}}}."""
    answers = {}
    for group, person, stimulus, value in rows:
        answers.setdefault(group, {}).setdefault(person, {}).setdefault(stimulus, []).append(value)
    return {
        group: {person: {name: float(np.mean(own)) for name, own in told.items()} for person, told in all_.items()}
        for group, all_ in answers.items()
    }


class Statistics(unittest.TestCase):
    def near(self, found, wanted):
        self.assertAlmostEqual(found, wanted, delta=1e-9 * max(1.0, abs(wanted)))

    def report(self, rows, *more):
        with tempfile.TemporaryDirectory() as folder:
            lines = ["group,participant,stimulus,rating", *(",".join(map(str, row)) for row in rows)]
            Path(folder, "table.csv").write_text("\n".join(lines))
            command = [PACINI, "study", "report", "table.csv", "--json", *more]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["ratings"]["Ratings"]

    def check_pairs(self, found, means, stimuli):
        everybody = [told for group in means.values() for told in group.values()]
        wanted = []
        for first, second in combinations(stimuli, 2):
            both = [(told[first], told[second]) for told in everybody if first in told and second in told]
            if len(both) > 1:
                wanted.append((first, second, np.array(both).T))
        self.assertEqual([(one["first"], one["second"]) for one in found], [one[:2] for one in wanted])
        tests = [stats.ttest_rel(a, b) for _, _, (a, b) in wanted]
        corrected = multipletests([test.pvalue for test in tests], method="holm")[1]
        for one, test, holm, (_, _, (a, b)) in zip(found, tests, corrected, wanted):
            self.near(one["t"], test.statistic)
            self.near(one["p"], test.pvalue)
            self.near(one["holm"], holm)
            low, high = test.confidence_interval()
            self.near(one["difference95"][0], low)
            self.near(one["difference95"][1], high)
            d = (a - b)[a != b]
            tied = len(set(np.abs(d))) < len(d)
            if len(d) and (not tied or len(d) <= 13):  # above, SciPy has no exact test of ties
                exact = stats.PermutationMethod(n_resamples=np.inf) if tied else "exact"
                self.near(one["wilcoxonP"], stats.wilcoxon(d, method=exact).pvalue)

    def check_group(self, found, told, stimuli):
        sample = [np.mean(list(own.values())) for own in told.values()]
        self.assertEqual((found["participants"], found["total"]["n"]), (len(sample), len(sample)))
        for entry, values in [
            (found["total"], sample),
            *(
                (found["stimuli"][name], [own[name] for own in told.values() if name in own])
                for name in stimuli
                if name in found["stimuli"]
            ),
        ]:
            self.near(entry["mean"], np.mean(values))
            if len(values) > 1 and np.std(values) > 0:
                self.near(entry["sd"], np.std(values, ddof=1))
                low, high = stats.t.interval(0.95, len(values) - 1, np.mean(values), stats.sem(values))
                self.near(entry["mean95"][0], low)
                self.near(entry["mean95"][1], high)

    def check_groups(self, comparison, first, second, stimuli, paired):
        a, b = ([np.mean(list(own.values())) for own in told.values()] for told in (first, second))
        of_people = comparison["byParticipant"]
        self.near(of_people["pooled"]["p"], stats.ttest_ind(a, b).pvalue)
        self.near(of_people["welch"]["p"], stats.ttest_ind(a, b, equal_var=False).pvalue)
        self.near(of_people["hedgesG"], pg.compute_effsize(a, b, eftype="hedges"))
        for name, one in comparison["stimuli"].items():
            both = [[own[name] for own in told.values() if name in own] for told in (first, second)]
            if np.var(both[0]) + np.var(both[1]) > 0:
                self.near(one["hedgesG"], pg.compute_effsize(*both, eftype="hedges"))
        ties = len(set(a + b)) < len(a + b)
        if not ties:
            self.near(of_people["mannWhitneyP"], stats.mannwhitneyu(a, b, method="exact").pvalue)
        columns = [
            [np.mean([own[name] for own in told.values() if name in own]) for name in stimuli]
            for told in (first, second)
        ]
        test = (stats.ttest_rel if paired else stats.ttest_ind)(*columns)
        self.assertEqual(comparison["byStimulus"]["paired"], paired)
        self.near(comparison["byStimulus"]["t"], test.statistic)
        self.near(comparison["byStimulus"]["p"], test.pvalue)

    def check_agreement(self, found, whole, stimuli):
        """Of those who have answered for every stimulus: raters of stimuli, both random."""
        table = pd.DataFrame(whole, columns=stimuli)
        long = table.reset_index(names="person").melt("person", var_name="stimulus", value_name="rating")
        icc = pg.intraclass_corr(long, targets="stimulus", raters="person", ratings="rating").set_index("Type")
        names = {name.replace(" ", ""): name for name in icc.index}
        single = icc.loc[names.get("ICC2", names.get("ICC(A,1)"))]
        mean = icc.loc[names.get("ICC2k", names.get("ICC(A,k)"))]
        self.near(found["icc"]["single"], single["ICC"])
        self.near(found["icc"]["mean"], mean["ICC"])
        order = pg.friedman(long, dv="rating", within="stimulus", subject="person")
        self.near(found["friedman"]["kendallsW"], order["W"].iloc[0])
        self.near(found["friedman"]["chiSquared"], order["Q"].iloc[0])

    def test_twenty_simulated_studies(self):
        for seed in range(20):
            with self.subTest(seed):
                rows = simulated(seed)
                means, stimuli = people(rows), sorted({row[2] for row in rows})
                found = self.report(rows)
                self.check_pairs(found["pairs"], means, stimuli)
                for entry in found["groups"]:
                    self.check_group(entry, means[entry["group"]], stimuli)
                self.check_group(found["everybody"], {p: own for g in means.values() for p, own in g.items()}, stimuli)
                whole = [own for g in means.values() for own in g.values() if len(own) == len(stimuli)]
                if len(whole) > 1:
                    self.check_agreement(found, whole, stimuli)
                if len(whole) > 2:
                    order = stats.friedmanchisquare(*([own[name] for own in whole] for name in stimuli))
                    self.near(found["friedman"]["chiSquared"], order.statistic)
                    self.near(found["friedman"]["p"], order.pvalue)
                if len(means) == 2:
                    self.check_groups(found["comparisons"][0], means["A"], means["B"], stimuli, True)
                    unpaired = self.report(rows, "--unpaired")
                    self.check_groups(unpaired["comparisons"][0], means["A"], means["B"], stimuli, False)


if __name__ == "__main__":
    unittest.main()
