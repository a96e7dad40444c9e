"""End to end: pacini study, from a template to a report, and what people do wrong with it."""
import html
import json
import math
import random
import re
import statistics
import struct
import unittest
import wave

from command import SOURCE, CommandTest, sine, wav


class StudyTest(CommandTest):
    def setUp(self):
        super().setUp()
        for i, frequency in enumerate((120, 400, 900)):
            # Two partials: one band or several must make a difference.
            sound = [0.5 * (low + high) for low, high in zip(sine(frequency, 0.4, 44100), sine(0.4 * frequency, 0.4, 44100))]
            self.put(f"sounds/{'abc'[i]}.wav", wav(sound, 44100))

    #: Templates that present nothing but tones of their own.
    TONES = ("jnd", "threshold", "place", "questionnaire")

    def sounds_for(self, template):
        return () if template in self.TONES else ("sounds/",)

    def new(self, template="coherence", *more):
        self.succeeds("study", "new", "mine", "--template", template, *self.sounds_for(template), *more)
        return json.loads((self.folder / "mine/study.json").read_text())


class Steps(StudyTest):
    def test_every_template_is_written_checked_simulated_and_reported(self):
        help_text = self.succeeds("study", "new", "--help")
        templates = re.findall(r"(?m)^  ([a-z]+) {2,}\S", help_text[help_text.index("Templates:"):help_text.index("Questionnaires:")])
        self.assertEqual(len(templates), 12)
        for template in templates:
            with self.subTest(template):
                self.succeeds("study", "new", f"{template}/", "--template", template, *self.sounds_for(template), "-g", "A:3", "-g", "B:3"
                              if template != "coherence" else "C:3", *(["-g", "B:3"] if template == "coherence" else []))
                self.succeeds("study", "check", template)
                self.succeeds("study", "simulate", template, "-o", f"{template}-simulated", "--runs", "20")
                report = self.report("study", "report", f"{template}-simulated")
                self.assertEqual({entry["finished"] for entry in report["participants"].values()}, {3})
                page = (self.folder / f"{template}-simulated/report/report.md").read_text()
                self.assertIn("SIMULATED", page)
                html = (self.folder / f"{template}-simulated/report/report.html").read_text()
                self.assertEqual(html.count("<table>"), html.count("</table>"))
                # Links to all sections of a long page. Words are read from the left; what no row repeats is said once.
                sections = re.findall(r'<h2 id="([^"]+)">', html)
                self.assertEqual(re.findall(r'<a href="#([^"]+)">', html), sections if len(sections) >= 4 else [])
                for cells in re.findall(r'<td class="(.*?)">', html):
                    self.assertEqual(cells, "words")
                for table in re.findall(r"<tbody>(.*?)</tbody>", html, re.S):
                    heads = re.findall(r'<th scope="row"( class="again")?>(.*?)</th>', table)
                    for above, head in zip([("", None), *heads], heads):
                        self.assertEqual(head[0] != "", head[1] == above[1])
                    for row in re.findall(r"<tr>(.*?)</tr>", table):
                        for kind, cell in re.findall(r"<td( class=\"words\")?>(.*?)</td>", row):
                            self.assertTrue(kind or not cell or not cell[0].isalpha(), cell)
                for picture in re.findall(r"\]\(([^)]+\.svg)\)", page):
                    self.assertTrue((self.folder / f"{template}-simulated/report" / picture).exists())
                self.succeeds("study", "export", f"{template}-simulated", "-o", f"{template}-tables")
                answers = (self.folder / f"{template}-tables/answers.csv").read_text()
                self.assertGreater(answers.count("\n"), 5)
                sheets = list((self.folder / f"{template}-tables/bids").glob("sub-P*/beh/*_beh.tsv"))
                self.assertGreaterEqual(len(sheets), 6)

    def test_questionnaires_are_asked_reported_and_held_against_the_results(self):
        study = self.new("ranking", "--ask", "demographics", "--ask", "music")
        self.assertEqual([block["name"] for block in study["blocks"]], ["demographics", "music", "ranking"])
        self.fails(2, ["study", "new", "twice", "--template", "ranking", "sounds/", "--ask", "music", "--ask", "music"],
                   "is in the study already")
        self.new("coherence", "--ask", "demographics", "-y")
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        report = self.report("study", "report", "simulated")
        age = report["questionnaires"]["demographics"]["age"]
        self.assertEqual(age["n"], 33)
        answers = [json.loads(line)["items"] for path in (self.folder / "simulated/sessions").glob("*.jsonl")
                   for line in path.read_text().splitlines() if '"questionnaire"' in line]
        ages = [float(one["age"]) for one in answers]
        self.assertAlmostEqual(age["mean"], statistics.fmean(ages))
        self.assertAlmostEqual(age["sd"], statistics.stdev(ages))
        hands = report["questionnaires"]["demographics"]["handedness"]["counts"]
        self.assertEqual(hands, {hand: sum(one["handedness"] == hand for one in answers) for hand in ("right", "left", "both")})
        row = report["covariates"][0]
        self.assertEqual((row["question"], row["n"]), ("age", 33))
        self.assertTrue(row["r95"][0] <= row["r"] <= row["r95"][1])
        self.succeeds("study", "export", "simulated", "-o", "tables")
        table = (self.folder / "tables/questionnaires.csv").read_text()
        self.assertEqual(table.count("\n"), 1 + 33 * 5)
        self.assertIn("\tage\tgender\thandedness", (self.folder / "tables/bids/participants.tsv").read_text())
        # What somebody has typed into a log is no age.
        log = next((self.folder / "simulated/sessions").glob("*.jsonl"))
        log.write_text(re.sub(r'"age":"[^"]*"', '"age":"old"', log.read_text()))
        self.warns("study", "report", "simulated", "-y", says="age is 'old', which is not a number; it is left out")

    def test_places_between_actuators_are_reported_with_errors(self):
        self.new("place")
        self.succeeds("study", "check", "mine", "--profile", "l5-wristband")
        self.succeeds("study", "simulate", "mine", "-o", "simulated")
        report = self.report("study", "report", "simulated")["places"]["place"]
        answers = {}
        for path in (self.folder / "simulated/sessions").glob("*.jsonl"):
            for record in map(json.loads, path.read_text().splitlines()):
                if record.get("task") == "place":
                    answers.setdefault(record["stimuli"][0], {}).setdefault(path.name, []).append(record["value"])
        self.assertEqual(len(answers), 12)
        for stimulus, people in answers.items():
            means = [statistics.fmean(own) for own in people.values()]
            entry = report["stimuli"][stimulus]
            self.assertEqual(entry["n"], 12)
            self.assertAlmostEqual(entry["mean"], statistics.fmean(means))
            self.assertAlmostEqual(entry["sd"], statistics.stdev(means))
            self.assertAlmostEqual(entry["error"], statistics.fmean(means) - float(stimulus.split()[0]))
        # The simulated are drawn to the middle: four fifths of the row are felt.
        for way in ("level", "delay", "both"):
            self.assertAlmostEqual(report["ways"][way]["slope"]["mean"], 0.8, delta=0.15)
        self.assertEqual(len(report["comparisons"]), 3)

    def test_events_at_once_are_reported_with_chance_and_confusions(self):
        self.new("events")
        self.succeeds("study", "check", "mine")
        self.succeeds("study", "simulate", "mine", "-o", "simulated")
        report = self.report("study", "report", "simulated")
        count, which = report["events"]["count"], report["events"]["which"]
        self.assertEqual(count["byNumber"]["1"]["guessing"], 1 / 3)
        self.assertEqual(which["byNumber"]["1"]["guessing"], 1 / 8)
        for number, stimuli in (("1", 3), ("2", 3), ("3", 1)):
            self.assertEqual(sum(count["confusions"][number].values()), 12 * 3 * stimuli)
            self.assertEqual(count["byNumber"][number]["right"], count["confusions"][number][number])
        hits, all_of = which["named"]["a"]["2"]
        self.assertEqual(all_of, 12 * 3 * 2)
        self.assertAlmostEqual(hits / all_of, 0.8, delta=0.2)
        self.assertEqual(which["confusions"]["a + b"]["answers"], 36)

    def test_classes_group_and_select_the_stimuli_of_a_report(self):
        study = self.new()
        for stimulus, mass in zip(study["stimuli"], ("complex", "complex", "varying")):
            stimulus["object"] = {"mass": mass, "facture": "iterative"}
        study["stimuli"][0]["tags"] = ["wood"]
        (self.folder / "mine/study.json").write_text(json.dumps(study))
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        classes = next(iter(self.report("study", "report", "simulated")["classes"].values()))
        self.assertEqual({name: entry["stimuli"] for name, entry in classes.items()},
                         {"X''": 2, "Y''": 1, "complex": 2, "varying": 1, "iterative": 3, "wood": 1})
        only = self.report("study", "report", "simulated", "--only", "X''", "-y")
        self.assertEqual(set(next(iter(only["ratings"].values()))["everybody"]["stimuli"]), {"a", "b"})
        self.fails(1, ["study", "report", "simulated", "--only", "N'"], "'N'' is no class of the stimuli; there are")
        study["stimuli"][0]["object"]["mass"] = "heavy"
        (self.folder / "mine/study.json").write_text(json.dumps(study))
        self.fails(1, ["study", "check", "mine"], "stimuli[0].object.mass: must be definite, complex or varying")

    def test_levels_of_sounds_are_told_and_limited(self):
        self.succeeds("study", "tone", "tone.wav", "--duration", "2")
        self.fails(1, ["study", "tone", "tone.wav"], "exists")
        with wave.open(str(self.folder / "tone.wav")) as tone:
            self.assertEqual((tone.getnchannels(), tone.getframerate(), tone.getnframes()), (2, 48000, 96000))
            raw = tone.readframes(96000)
        samples = [int.from_bytes(raw[i:i + 3], "little", signed=True) / 2**23 for i in range(0, len(raw), 6)]
        self.assertAlmostEqual(20 * math.log10(math.sqrt(statistics.fmean(x * x for x in samples[4800:91200]))), -20, delta=0.01)
        study = self.new("words")
        file = self.folder / "mine/study.json"
        sounds = self.report("study", "check", "mine")["sounds"]
        self.assertEqual(len(sounds), 3)
        self.assertNotIn("soundPressure", sounds[0])
        study["calibration"] = {"tone": -20, "level": 60}
        file.write_text(json.dumps(study))
        report = self.report("study", "check", "mine")
        for sound in report["sounds"]:
            self.assertAlmostEqual(sound["soundPressure"], sound["rms"] + 80)
            self.assertLess(sound["soundPressureWeighted"], sound["soundPressure"] + 1.3)
        self.assertLess(report["groups"][0]["soundDaily"], 60)
        study["calibration"]["level"] = 100
        file.write_text(json.dumps(study))
        self.fails(1, ["study", "check", "mine"], "dB(A), 85.0 are allowed (limits.soundLevel)", lines=3)
        del study["calibration"]
        study["limits"]["soundLevel"] = 70
        file.write_text(json.dumps(study))
        self.fails(1, ["study", "check", "mine"], "without a calibration")
        study["limits"] = {"loudness": -60}
        file.write_text(json.dumps(study))
        self.fails(1, ["study", "check", "mine"], "LUFS, -60.0 are allowed (limits.loudness)", lines=3)
        study["limits"] = {"soundDaily": 90}
        file.write_text(json.dumps(study))
        self.fails(1, ["study", "check", "mine"], "limits.soundDaily: must be 0 to 87 dB(A)")

    def test_the_same_study_is_simulated_alike(self):
        # Sounds are named from the study's folder, so that both can be moved together.
        self.assertEqual({stimulus["sound"] for stimulus in self.new()["stimuli"]},
                         {f"../sounds/{name}.wav" for name in "abc"})
        texts = []
        for folder in ("one", "two"):
            self.succeeds("study", "simulate", "mine", "-o", folder, "--seed", "7", "--runs", "10")
            text = "".join(path.read_text() for path in sorted((self.folder / folder / "sessions").glob("*.jsonl")))
            texts.append(re.sub(r'"(time|started)":"[^"]*"', "", text))
        self.assertEqual(texts[0], texts[1])

    def test_words_have_categories_and_are_escaped(self):
        self.new()
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        log = next((self.folder / "simulated/sessions").glob("*.jsonl"))
        log.write_text(re.sub(r'"words":"[^"]*"', '"words":"<script>alert(1)</script>|x"', log.read_text()))
        self.put("table.csv", b"category,word\nspectral,rough\nmotion,kno*\n")
        report = self.report("study", "report", "simulated", "--categories", "table.csv")
        self.assertEqual(set(report["categories"]["A"]), {"spectral", "motion", ""})
        self.put("other.csv", b"category,word\nspectral,rough\nspectral,kno*\nspace,far\n")
        coders = self.report("study", "report", "simulated", "--categories", "table.csv", "--categories", "other.csv")["coders"]
        self.assertGreater(coders["words"], 1)
        self.assertEqual({one["first"] for one in coders["differences"]} - {"motion", ""}, set())
        self.assertEqual(len(coders["differences"]), round(coders["words"] * (1 - coders["agreement"])))
        self.assertLess(coders["kappa"], coders["agreement"])
        self.assertIn("Cohen", (self.folder / "simulated/report/report.html").read_text())
        self.fails(2, ["study", "report", "simulated", *["--categories", "table.csv"] * 3], "--categories: is given 3 times")
        self.assertNotIn("<script>", (self.folder / "simulated/report/report.html").read_text())

    def test_tables_of_ratings_of_other_programs(self):
        rows = [(person, group, stimulus, 3.5 + index % 3 + 0.5 * person)
                for index, (person, group) in enumerate([(1, "A"), (2, "A"), (3, "B"), (4, "B")]) for stimulus in "st"]
        comma = [f"P{p};{g};{s};{str(r).replace('.', ',')}" for p, g, s, r in rows]
        self.put("semi.csv", "\ufeff" + "\r\n".join(["participant;group;stimulus;rating", *comma]))
        self.put("tabs.tsv", "\n".join(["participant\tgroup\tstimulus\trating", *(c.replace(";", "\t") for c in comma)]))
        own = ["participant,group,stimulus,slider", *(f"P{p},{g},{s},{r}" for p, g, s, r in rows)]
        self.put("named.csv", "\n".join(own))
        self.put("excel.csv", "\r\n".join(["sep=;", "participant;group;stimulus;rating", *comma]))
        self.put("macintosh.csv", "\r".join(["participant;group;stimulus;rating", *comma]))
        wanted = self.report("study", "report", "semi.csv")["ratings"]
        for arguments in (["tabs.tsv"], ["named.csv", "--columns", "rating=slider"], ["excel.csv"], ["macintosh.csv"]):
            self.assertEqual(self.report("study", "report", *arguments)["ratings"], wanted)
        self.fails(1, ["study", "report", "named.csv"], "line 1: has no column 'rating'", "--columns rating=NAME")
        self.fails(2, ["study", "report", "named.csv", "--columns", "slider"], "--columns: 'slider' does not name a column")
        self.put("missing.csv", "\n".join([*own[:3], "P9,B,s,", "P9,B,t,NA", *own[3:]]))
        self.warns("study", "report", "missing.csv", "--columns", "rating=slider",
                   says="line 4: has no rating; 2 of 10 lines have none and are left out")

    def warned_report(self, named):
        """The report of a study or table about which warnings are told."""
        done = self.run_command("study", "report", named, "--json", "-y")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_lines_of_a_table_that_are_no_ones_or_of_nothing_are_left_out(self):
        rows = [("A" if p < 3 else "B", f"p{p}", s, 40 + 7 * p + 3 * i) for p in range(6) for i, s in enumerate("xyz")]
        def table(change):
            lines = [",".join(map(str, change(i, list(row)))) for i, row in enumerate(rows)]
            return self.put("table.csv", "\n".join(["group,participant,stimulus,rating", *lines]))
        for column, what in enumerate(["group", "participant", "stimulus"]):
            def without(i, row, column=column):
                return row[:column] + ["" if i in (0, 4) else row[column]] + row[column + 1:]
            table(without)
            found = self.warned_report("table.csv")
            everybody = found["ratings"]["Ratings"]
            self.assertEqual([one["group"] for one in everybody["groups"]], ["A", "B"], what)
            self.assertNotIn("", everybody["groups"][0]["stimuli"], what)
            self.assertIn(f"table: line 2: has no {what}; 2 of 18 lines have none and are left out", found["leftOut"])

    def test_lines_of_jspsych_that_are_no_ratings_are_left_out(self):
        head = "rt,stimulus,response,trial_type,subject"
        rated = [f"1,{s}.wav,{50 + 5 * p + i},audio-slider-response,p{p}" for p in range(4) for i, s in enumerate("ab")]
        self.put("plain.csv", "\n".join([head, *rated]))
        wanted = self.report("study", "report", "plain.csv")["ratings"]
        others = ["1,<p>Press</p>,0,html-button-response,p0", '1,<p>Who?</p>,"{""Q0"":""male""}",survey-text,p1']
        self.put("js.csv", "\n".join([head, *others, *rated]))
        said = self.warns("study", "report", "js.csv", "--json", "-y",
                          says="line 2: is no rating of jsPsych's sliders by its trial_type; 2 of 10 lines are none")
        self.assertEqual(json.loads(said)["ratings"], wanted)

    def test_answers_that_no_session_can_have_are_left_out_and_told(self):
        # Each template with what a damaged or edited log may hold in its first answer that counts.
        def changed(template, says, change):
            with self.subTest(template, says=says):
                folder = f"study {template}"
                if not (self.folder / folder).exists():
                    self.succeeds("study", "new", f"new {template}", "--template", template, *self.sounds_for(template))
                    self.succeeds("study", "simulate", f"new {template}", "-o", folder, "--runs", "10")
                log = sorted((self.folder / folder / "sessions").glob("*.jsonl"))[2]
                kept = log.read_text()
                lines = [json.loads(line) for line in kept.splitlines()]
                place = next(i for i, line in enumerate(lines) if line["type"] == "answer" and not line.get("training"))
                changes = change(lines[place])
                lines[place:place + 1] = [] if changes is None else [{**lines[place], **changes}]
                log.write_text("".join(json.dumps(line) + "\n" for line in lines))
                left = self.warned_report(folder)["leftOut"]
                log.write_text(kept)
                self.assertTrue(any(says in one and one.startswith(lines[0]["participant"]) for one in left), left)
        def first(line, value):
            return {"values": [value, *line["values"][1:]]}
        for value in (None, "x"):
            changed("mushra", 'its "values" cannot be read', lambda line, value=value: first(line, value))
        for value in (150, -5):
            changed("mushra", f"its value {value} is outside of the scale from 0 to 100",
                    lambda line, value=value: first(line, value))
        changed("mushra", "values for", lambda line: {"values": line["values"][1:]})
        changed("mushra", "the study has no block 'other'", lambda line: {"block": "other"})
        changed("mushra", "the study has no stimulus 'other'", lambda line: {"stimuli": ["other", *line["stimuli"][1:]]})
        changed("mushra", "is missing, the first at trial 0", lambda line: None)
        changed("ranking", "its places are not the numbers from 1 to", lambda line: first(line, 7))
        for value in (None, True, "7"):
            changed("similarity", 'its "value" cannot be read', lambda line, value=value: {"value": value})
        changed("similarity", "is outside of the scale", lambda line: {"value": 99999})
        changed("abx", "its choice 7 is none of those from 0 to 1", lambda line: {"choice": 7})
        changed("abx", 'its "choice" cannot be read', lambda line: {"choice": 1e300})
        for value in (None, "x"):
            changed("jnd", 'its "level" cannot be read', lambda line, value=value: {"level": value})
        for value in (0, -1, 1e6, 1e300):
            changed("jnd", "is outside of the range from", lambda line, value=value: {"level": value})

    def test_a_table_in_latin_1_is_read_and_told(self):
        rows = "stimulus,participant,rating\nT\u00fcr \u2013 auf,1,2\nT\u00fcr \u2013 auf,2,3\nz,1,4\nz,2,5\n"
        self.put("old.csv", rows.encode("cp1252"))
        self.put("new.csv", rows.encode())
        old = json.loads(self.warns("study", "report", "old.csv", "--json", says="was read as Latin-1 (Windows-1252)"))
        self.assertEqual(old["ratings"], self.report("study", "report", "new.csv")["ratings"])
        self.assertIn("T\u00fcr \u2013 auf", (self.folder / "old.report/report.md").read_text(encoding="utf-8"))
        self.new()
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        log = next((self.folder / "simulated/sessions").glob("*.jsonl"))
        log.write_text(re.sub(r'"words":"[^"]*"', '"words":"w\u00e4rm"', log.read_text()), encoding="utf-8")
        self.put("table.csv", "hot,w\u00e4rm\n".encode("latin-1"))
        counts = self.report("study", "report", "simulated", "--categories", "table.csv")["categories"]
        self.assertGreater(sum(group["hot"] for group in counts.values()), 0)

    def test_a_report_of_ratings_of_others(self):
        rows = [f"{group};{stimulus};{group}{person};{5 + (person + 1) * stimulus % 7 % 4 + 'ABC'.index(group)}"
                for group in "ABC" for stimulus in range(1, 11) for person in range(6)]
        self.put("others.csv", "\n".join(["Group;Stimulus;Participant;Rating", *rows]).encode())
        report = self.report("study", "report", "others.csv", "--combine", "A+B")
        comparisons = report["ratings"]["Ratings"]["comparisons"]
        self.assertEqual([(one["first"], one["second"]) for one in comparisons],
                         [("A", "B"), ("A", "C"), ("B", "C"), ("{A+B}", "C")])
        self.assertAlmostEqual(comparisons[1]["byParticipant"]["pooled"]["difference"], -2.0)
        # Numbers in their order: 2 before 10.
        page = (self.folder / "others.report/report.md").read_text()
        self.assertLess(page.index("| 2 |"), page.index("| 10 |"))


class Methods(StudyTest):
    """The report's section to cite."""

    TESTS = ("Mann-Whitney", "Welch", "Wilcoxon", "Hedges", "Bonferroni", "Holm", "ICC(2,1)", "Kendall", "Friedman", "Korn",
             "Pearson", "stress-1")

    def methods(self, name, folder, *more):
        """The methods of a report; each test that its page names is among them, and no other."""
        said = self.report("study", "report", name, "-y", *more)["methods"]
        page = (self.folder / folder / "report.md").read_text()
        results, section = page[:page.index("## What was left out")], page[page.index("## Methods"):]
        for paragraph in said:
            self.assertIn(paragraph, section)
        for test in self.TESTS:
            # Pairs of stimuli have a table only where some differ.
            tested = test in results or (test == "Wilcoxon" and "pairs of stimuli 0 differ" in results)
            self.assertEqual(tested, test in section, test)
        cited = (SOURCE / "CITATION.cff").read_text()
        for key in ("title", "version", "- name", "license"):
            self.assertIn(re.search(rf'(?m)^ *{key}: "?([^"\n]+)', cited)[1], said[-1])
        return said

    def test_every_template_has_methods_that_name_its_tests(self):
        for template in ("coherence", "mushra", "abx", "jnd", "threshold", "similarity", "ranking", "place", "events",
                         "questionnaire"):
            with self.subTest(template):
                groups = () if template == "coherence" else ("-g", "all:5")
                asked = () if template == "questionnaire" else (*groups, "--ask", "music")
                self.succeeds("study", "new", template, "--template", template, *self.sounds_for(template), *asked)
                self.succeeds("study", "simulate", template, "-o", f"{template}-simulated", "--runs", "10")
                said = " ".join(self.methods(f"{template}-simulated", f"{template}-simulated/report"))
                self.assertNotIn("{}", said)
                for word in ("will be", "are rated", "is rated"):
                    self.assertNotIn(word, said)

    def test_the_methods_tell_people_tasks_and_trials(self):
        made = self.new("coherence", "-g", "A:4", "-g", "C:3", "--profile", "l5-wristband")
        for block in made["blocks"]:
            if block["name"] == "coherence, at once":
                block.update(repeats=2, order="latinSquare", replays=1, training=["a"], stimuli=["a", "b", "c"])
        self.put("mine/study.json", json.dumps(made))
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        next((self.folder / "simulated/sessions").glob("P005*")).unlink()
        people, setting, tasks, tests, _ = self.methods("simulated", "simulated/report")
        self.assertRegex(people, r"^6 people took part \(\d in group A and \d in group C; assigned at random\); 6 finished\. 7 were planned\.$")
        self.assertEqual(setting, "There were 3 stimuli, made for the actuator profile l5-wristband. Sessions were run with "
                                  "Pacini, simulated; orders followed from the seed 1.")
        self.assertIn('In the part "coherence, at once", group C rated 3 stimuli on a scale from 0 (not at all) to 10 (perfectly), '
                      "heard and felt at once, in orders balanced for carry-over (Williams 1949): 6 trials for each person, "
                      "after 1 trial of practice. A presentation could be repeated 1 time.", tasks)
        self.assertIn("heard, then felt after a pause of 0.5 s, in a random order", tasks)
        self.assertIn("Groups were compared by a mean for each person", tests)
        self.assertIn("in pairs of the same stimulus", tests)
        self.assertIn("as independent samples", " ".join(self.methods("simulated", "simulated/report", "--unpaired")))

    def test_parts_that_are_alike_and_screening_are_told_once(self):
        rows = [f"{p},page{b},{s},{v}" for p in "abc" for b in "12" for s, v in (("r", 60 if p == "c" else 95), ("s", 40 + ord(p) % 7))]
        self.put("table.csv", "\n".join(["participant,block,stimulus,rating", *rows]))
        said = json.loads(self.warns("study", "report", "table.csv", "--reference", "r", "--json", says="1 of 3"))["methods"]
        self.assertEqual(said[0], "8 ratings of 2 stimuli by 2 people were analysed.")
        self.assertIn("were left out (ITU-R BS.1534-3): 1 of 3.", said[1])
        self.new("mushra", "-g", "all:3")
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        said = " ".join(self.methods("simulated", "simulated/report"))
        self.assertIn('In each of the parts "a", "b" and "c", everybody rated 3 stimuli beside each other with a hidden reference '
                      "and 1 anchor on a scale from 0 (bad) to 100 (excellent) in steps of 1 (MUSHRA)", said)
        self.assertEqual(said.count("beside each other"), 1)


class People(StudyTest):
    """People are the sample."""

    def table(self, name, rows):
        self.put(name, "\n".join(["group,participant,stimulus,rating", *(",".join(map(str, row)) for row in rows)]))
        return name

    def test_pairs_of_any_number_of_stimuli_are_compared_and_in_the_report(self):
        source = random.Random(3)
        rows = [("A", f"P{p}", f"S{s:02}", s % 5 + source.randrange(4)) for p in range(9) for s in range(14)]
        found = self.report("study", "report", self.table("many.csv", rows))["ratings"]["Ratings"]["pairs"]
        self.assertEqual(len(found), 91)
        self.assertTrue(all(one["holm"] >= one["p"] and {"t", "degrees", "difference95", "wilcoxonP"} <= set(one)
                            for one in found))
        differ = sum(one["holm"] <= 0.05 for one in found)
        page = (self.folder / "many.report/report.md").read_text()
        self.assertIn(f"Of 91 pairs of stimuli {differ} differ after Holm's correction", page)
        self.assertEqual(len(re.findall(r"(?m)^\| S\d", page)), 14 + differ)
        # Where everybody lacks something, pairs are of those who answered for both.
        rows = [row for row in rows if (int(row[1][1:]), int(row[2][1:])) not in {(p, p) for p in range(9)}]
        self.table("gaps.csv", rows)
        found = json.loads(self.warns("study", "report", "gaps.csv", "--json",
                                      says="9 of 9 participants have not answered for every stimulus"))["ratings"]["Ratings"]
        self.assertEqual([one["degrees"] for one in found["pairs"][:1] + found["pairs"][-1:]], [6, 8])
        self.assertEqual(len(found["notes"]), 1)

    def test_groups_that_rate_the_same_stimuli_are_compared_in_pairs_of_them(self):
        rows = [(g, f"{g}{p}", s, 2 * s + (g == "B") * (1 + s % 2) + p)
                for g in "AB" for p in range(4) for s in range(8)]
        def means(*more):
            done = self.run_command("study", "report", self.table("two.csv", rows), "--json", *more)
            return json.loads(done.stdout)["ratings"]["Ratings"]["comparisons"][0]["byStimulus"]
        paired, independent = means(), means("--unpaired")
        self.assertEqual((paired["paired"], paired["degrees"]), (True, 7))
        self.assertEqual((independent["paired"], independent["degrees"]), (False, 14))
        self.assertLess(paired["p"], 0.001)
        self.assertGreater(independent["p"], 0.3)
        self.assertIn("| independent |", (self.folder / "two.report/report.md").read_text())
        # Other stimuli are independent ones.
        rows = [row for row in rows if row[0] == "A" or row[2] != 3]
        self.assertEqual(means()["paired"], False)

    def test_several_answers_of_one_person_are_no_sample(self):
        rows = [("A", f"P{p}", s, 3 + p % 4 + s % 2) for p in range(12) for s in range(6) for _ in range(2)]
        everybody = self.report("study", "report", self.table("again.csv", rows))["ratings"]["Ratings"]["everybody"]
        self.assertEqual((everybody["total"]["n"], everybody["answers"]["n"]), (12, 72))
        self.assertAlmostEqual(everybody["total"]["sd"], 1.1677, places=4)

    def test_one_person_has_no_deviation_and_no_interval(self):
        self.table("one.csv", [("A", "P1", s, 3 + s) for s in range(4)])
        everybody = self.report("study", "report", "one.csv")["ratings"]["Ratings"]["everybody"]
        for found in (everybody["total"], *everybody["stimuli"].values()):
            self.assertEqual((found["n"], found["sd"], found["mean95"]), (1, None, None))
        self.assertGreater(everybody["answers"]["sd"], 1.0)  # four answers
        page = (self.folder / "one.report/report.md").read_text()
        self.assertRegex(page, r"(?m)^\| 0 \| 3\.00 \| +\| +\|$")
        self.assertNotIn("0.00", page.split("## Methods")[0].replace("10.00", ""))

    def test_groups_that_are_combined_must_be_there(self):
        rows = [(g, p, s, p + 3 * s % 5) for g in "AB" for p in (1, 2, 3) for s in range(4)]
        self.table("groups.csv", rows)
        for union, says in (("A+Z", "'Z' is no group; there are A, B"), ("A+A", "names 'A' twice")):
            self.fails(1, ["study", "report", "groups.csv", "--combine", union], f"--combine: {says}")
            self.assertFalse((self.folder / "groups.report").exists())

    def test_who_may_be_one_person_is_told(self):
        answers = [4, 7, 2, 9, 3, 8, 5, 6]
        rows = [("A", p, s, answer + p * s % 4) for p in (1, 2, 3) for s, answer in enumerate(answers)]
        rows += [("B", p, s, answer - (p + s) % 3) for p in (3, 4, 5) for s, answer in enumerate(answers)]
        self.warns("study", "report", self.table("both.csv", rows), says="3 is in several groups (A, B)")
        rows = [row for row in rows if row[:2] != ("B", 3)]
        rows += [("B", 6, s, answer + 2 * s % 4) for s, answer in enumerate(answers)]
        self.warns("study", "report", self.table("copy.csv", rows), says="6 of B has the same answers as 2 of A")
        self.put("nobody.csv", "stimulus,rating\n1,2\n2,3\n1,4\n")
        self.warns("study", "report", "nobody.csv", says="there are no participants")

    def test_a_copied_session_counts_once(self):
        self.new()
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        wanted = self.report("study", "report", "simulated")
        sessions = self.folder / "simulated/sessions"
        log = (sessions / "P002.jsonl").read_text()
        (sessions / "P002 (copy).jsonl").write_text(log)
        self.warns("study", "report", "simulated", says="P002.jsonl: is a copy of P002 (copy).jsonl and left out")
        def ratings(says):
            return json.loads(self.warns("study", "report", "simulated", "--json", says=says))["ratings"]
        self.assertEqual(ratings("is a copy of P002 (copy).jsonl"), wanted["ratings"])
        # The longer one counts; another session of the same person is told.
        lines = log.splitlines()
        (sessions / "P002 (copy).jsonl").write_text("\n".join([*lines[:-4], lines[-1]]) + "\n")
        self.assertEqual(ratings("P002 (copy).jsonl: is a copy of P002.jsonl and left out"), wanted["ratings"])
        (sessions / "P002 (copy).jsonl").write_text(re.sub(r'"started":"[^"]*"', '"started":"2020-01-01T00:00:00Z"', log))
        self.warns("study", "report", "simulated", says="P002.jsonl: is another session of P002")

    def test_all_that_is_warned_of_is_in_the_report(self):
        def warned(name, where):
            # Each warning is a sentence of the page, of its Markdown and of its JSON.
            done = self.run_command("study", "report", name, "--json", "-y")
            said = [line.split(": warning: ", 1)[1]
                    for line in done.stderr.decode().splitlines() if ": warning: " in line]
            self.assertGreater(len(said), 0)
            report = json.loads(done.stdout)
            for page in ("report.md", "report.html"):
                text = html.unescape((self.folder / where / page).read_text(encoding="utf-8"))
                section = text[text.index("What was left out or assumed"):]
                for one in [*said, *report["leftOut"]]:
                    self.assertIn(one, section)
            return report["leftOut"]
        # A table: Latin-1, a line without a rating, and who has not rated all.
        self.put("old.csv", "stimulus,participant,rating\nT\u00fcr,1,2\nT\u00fcr,2,3\nz,1,4\nz,2,NA\n".encode("cp1252"))
        self.assertEqual(len(warned("old.csv", "old.report")), 3)
        # A study: a session that breaks off, one that is none, one of another version, one copied, an age that is none.
        self.new("ranking", "--ask", "demographics")
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        self.assertEqual(self.report("study", "report", "simulated")["leftOut"], [])
        self.assertIn("Nothing.", (self.folder / "simulated/report/report.md").read_text())
        sessions = self.folder / "simulated/sessions"
        logs = sorted(sessions.glob("*.jsonl"))
        (sessions / "P000.jsonl").write_text(logs[0].read_text())
        logs[1].write_text("".join(logs[1].read_text().splitlines(True)[:-1]))
        logs[2].write_text("none\n")
        logs[3].write_text(re.sub(r'"studySha256":"[^"]*"', '"studySha256":"0"', logs[3].read_text()))
        logs[4].write_text(re.sub(r'"age":"[^"]*"', '"age":"old"', logs[4].read_text()))
        found = warned("simulated", "simulated/report")
        for part in ("is a copy of", "is not finished", logs[2].name, "another version", "'old'"):
            self.assertTrue(any(part in one for one in found), part)

    def test_who_does_not_hear_the_hidden_reference_is_left_out(self):
        # Twenty trials of each: 3 below 90 are 15 %, which is not more; 4 are 20 %.
        heading = "session_test_id,session_uuid,trial_id,rating_stimulus,rating_score"
        def rows(below):
            return [f"t,{name},page{page},{stimulus},{score}" for name, misses in below.items() for page in range(20)
                    for stimulus, score in (("reference", 89 if page < misses else 90), ("C1", 50 + 3 * page % 7),
                                            ("anchor35", 10 + page % 3))]
        self.put("mushra.csv", "\n".join([heading, *rows({"ann": 0, "bob": 3, "cid": 4, "dot": 20})]))
        found = json.loads(self.warns("study", "report", "mushra.csv", "--json",
                                      says="2 of 4 listeners rated the hidden reference below 90 in more than 15 %"))
        screening = found["screening"]
        self.assertEqual((screening["hiddenReferences"], screening["leftOut"]), (["reference"], 2))
        self.assertEqual([(one["participant"], one["trials"], one["below90"]) for one in screening["failed"]],
                         [("cid", 20, 4), ("dot", 20, 20)])
        self.assertEqual([one["share"] for one in screening["listeners"]], [0, 0.15, 0.2, 1])
        self.assertTrue(all(one["everybody"]["participants"] == 2 for one in found["ratings"].values()))
        self.assertIn("cid (4 of 20 trials), dot (20 of 20 trials)", " ".join(found["leftOut"]))
        for page in ("report.md", "report.html"):
            text = (self.folder / "mushra.report" / page).read_text()
            self.assertIn("Of 4 listeners 2 rated it below 90 in more than 15 % of the trials and are left out", text)
            self.assertIn("cid (4 of 20 trials)", text)
        kept = self.report("study", "report", "mushra.csv", "--keep-everybody")
        self.assertEqual((kept["screening"]["leftOut"], len(kept["screening"]["failed"])), (0, 2))
        self.assertTrue(all(one["everybody"]["participants"] == 4 for one in kept["ratings"].values()))
        # Other tables say which stimulus it is; without that nobody is screened.
        self.put("plain.csv", "\n".join(["a,participant,block,stimulus,rating", *rows({"ann": 0, "bob": 20})]))
        self.assertNotIn("screening", self.report("study", "report", "plain.csv"))
        self.warns("study", "report", "plain.csv", "--reference", "reference", says="1 of 2 listeners")
        self.fails(1, ["study", "report", "plain.csv", "--reference", "Reference"],
                   "--reference: 'Reference' is no stimulus of the table; there are C1, anchor35, reference")
        self.put("ten.csv", "stimulus,participant,rating\nr,1,90\ns,1,101\n")
        self.fails(1, ["study", "report", "ten.csv", "--reference", "r"], "needs ratings from 0 to 100")
        # Nobody would remain.
        self.put("none.csv", "\n".join([heading, *rows({"ann": 9, "bob": 9})]))
        found = json.loads(self.warns("study", "report", "none.csv", "--json", says="as nobody would remain, all count"))
        self.assertTrue(all(one["everybody"]["participants"] == 2 for one in found["ratings"].values()))

    def test_listeners_of_a_study_are_screened_by_the_reference_of_each_page(self):
        made = self.new("mushra", "-g", "all:5")
        for block in made["blocks"]:
            block["scale"].update(low=10, high=20, step=0)
        self.put("mine/study.json", json.dumps(made))
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        whole = self.report("study", "report", "simulated")
        self.assertEqual((whole["screening"]["hiddenReferences"], whole["screening"]["leftOut"]), (["a", "b", "c"], 0))
        log = self.folder / "simulated/sessions/P003.jsonl"
        lines = []
        for line in log.read_text().splitlines():
            record = json.loads(line)
            if record.get("task") == "multiStimulus" and record["block"] == "b":
                record["values"][record["stimuli"].index("b")] = 18.9
            lines.append(json.dumps(record))
        log.write_text("\n".join(lines) + "\n")
        found = json.loads(self.warns("study", "report", "simulated", "--json", "-y", says="1 of 5 listeners"))
        [failed] = found["screening"]["failed"]
        self.assertEqual((failed["participant"], failed["trials"], failed["below90"]), ("P003", 3, 1))
        self.assertEqual({one["everybody"]["participants"] for one in found["ratings"].values()}, {4})
        self.fails(1, ["study", "report", "simulated", "--reference", "a"], "name theirs in study.json")

    def test_two_sessions_of_one_person_are_one_threshold(self):
        self.succeeds("study", "new", "felt", "--template", "threshold", "-g", "all:3")
        self.succeeds("study", "simulate", "felt", "-o", "simulated", "--runs", "10")
        log = (self.folder / "simulated/sessions/P002.jsonl").read_text()
        (self.folder / "simulated/sessions/P002b.jsonl").write_text(
            re.sub(r'"started":"[^"]*"', '"started":"2020-01-01T00:00:00Z"', log))
        found = json.loads(self.warns("study", "report", "simulated", "--json", says="is another session of P002"))
        self.assertEqual({one["n"] for one in found["thresholds"]["thresholds"].values()}, {3})

    def test_choices_have_an_interval_of_people(self):
        self.succeeds("study", "new", "abx", "--template", "abx", "sounds/a.wav", "-g", "all:6")
        self.succeeds("study", "simulate", "abx", "-o", "simulated", "--runs", "10")
        # Three people are always right, three always wrong.
        for i, log in enumerate(sorted((self.folder / "simulated/sessions").glob("*.jsonl"))):
            log.write_text(re.sub(r'"correct":(true|false)', '"correct":' + ("true" if i % 2 else "false"), log.read_text()))
        [[found]] = [block.values() for block in self.report("study", "report", "simulated")["choices"].values()]
        self.assertEqual((found["people"], found["trials"], found["share"]), (6, 96, 0.5))
        self.assertLess(found["share95"][0], 0.15)
        self.assertGreater(found["share95"][1], 0.85)

    def test_rankings_are_compared_by_ranks(self):
        self.succeeds("study", "new", "order", "--template", "ranking", "sounds/", "-g", "A:8", "-g", "B:8")
        self.succeeds("study", "simulate", "order", "-o", "simulated", "--runs", "10")
        [found] = self.report("study", "report", "simulated")["ranks"].values()
        for absent in ("icc", "total", "byParticipant", "byStimulus", "pooled", '"t"', "mean95", "hedgesG"):
            self.assertNotIn(absent, json.dumps(found))
        self.assertEqual(len(found["pairs"]), 3)
        self.assertEqual({"first", "second", "n", "difference", "wilcoxonW", "wilcoxonP", "holm"}, set(found["pairs"][0]))
        self.assertEqual(set(found["comparisons"][0]["stimuli"]["a"]), {"u", "mannWhitneyP", "holm", "bonferroni"})
        page = (self.folder / "simulated/report/report.md").read_text()
        self.assertIn("Places: median", page)
        self.assertIn("Friedman", page)
        self.assertNotIn("t-test", page)


class Profile(StudyTest):
    def test_thresholds_make_a_profile_of_ones_own(self):
        self.succeeds("study", "new", "felt", "--template", "threshold", "--profile", "l5-wristband", "-g", "all:1")
        self.succeeds("study", "simulate", "felt", "-o", "simulated", "--runs", "10", "--threshold", "-55")
        report = self.report("study", "profile", "simulated", "P001", "-o", "mine.json")
        self.assertEqual(json.loads((self.folder / "mine.json").read_text())["range"]["dynamicRange"], report["dynamicRange"])
        self.clip()
        self.succeeds("render", "clip.json", "--profile", "mine.json", "-o", "mine.wav")
        # A file is found from the study's folder, wherever that is seen from.
        self.succeeds("study", "new", "own", "--template", "threshold", "--profile", "mine.json", "-g", "all:2")
        self.assertEqual(json.loads((self.folder / "own/study.json").read_text())["profile"], "../mine.json")
        self.succeeds("study", "check", "own")
        self.succeeds("study", "simulate", "own", "-o", "deeper/simulated", "--runs", "10")
        self.succeeds("study", "check", "deeper/simulated")
        self.fails(1, ["study", "profile", "simulated", "P999", "-o", "other.json"], "P999")
        self.assertFalse((self.folder / "other.json").exists())
        # A session that cannot be read is named, as by study report and study export.
        (self.folder / "simulated/sessions/P777.jsonl").write_text("torn\n")
        for step in (["profile", "simulated", "P001", "-o", "again.json"], ["export", "simulated", "-o", "tables"]):
            done = self.run_command("study", *step)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(b"P777.jsonl", done.stderr, step)


class Latency(StudyTest):
    def recorded(self, name, delay, channels=2, level=0.3):
        """What two inputs hear of the probe: the first now, the second `delay` frames later."""
        with wave.open(str(self.folder / "probe.wav")) as probe:
            self.assertEqual((probe.getnchannels(), probe.getsampwidth()), (2, 3))
            rate, frames = probe.getframerate(), probe.readframes(probe.getnframes())
        samples = [int.from_bytes(frames[i:i + 3], "little", signed=True) for i in range(0, len(frames), 6)]
        self.assertEqual(samples, [int.from_bytes(frames[i + 3:i + 6], "little", signed=True)
                                   for i in range(0, len(frames), 6)])
        late = [0] * delay + samples[:len(samples) - delay]
        with wave.open(str(self.folder / name), "wb") as file:
            file.setnchannels(channels)
            file.setsampwidth(2)
            file.setframerate(rate)
            file.writeframes(b"".join(
                struct.pack(f"<{channels}h", *([0] * (channels - 2)), now >> 8, int(level * (then >> 8)))
                for now, then in zip(samples, late)))

    def test_a_delay_is_measured_and_kept(self):
        self.new()
        self.succeeds("study", "latency", "mine", "--probe", "probe.wav", "--duration", "4", "--profile", "l5-wristband")
        self.recorded("back.wav", 110)
        report = self.report("study", "latency", "mine", "back.wav")
        self.assertAlmostEqual(report["delay"], 110 / 48000, delta=1e-5)
        self.assertLess(report["deviation"], 1e-5)
        self.assertGreaterEqual(report["bursts"], 3)
        self.recorded("four.wav", 4800, channels=4)
        self.fails(1, ["study", "latency", "mine", "four.wav"], "--sound: there is no burst")
        self.fails(2, ["study", "latency", "mine", "four.wav", "--touch", "5"], "there are only 4 channels")
        self.succeeds("study", "latency", "mine", "four.wav", "--sound", "4", "--touch", "3", "--dry-run")
        self.succeeds("study", "latency", "mine", "four.wav", "--sound", "4", "--touch", "3")
        kept = json.loads((self.folder / "mine/latency.json").read_text())["measurements"]
        self.assertEqual([round(one["delay"], 3) for one in kept], [0.002, -0.1])
        self.fails(2, ["study", "latency", "mine"], "--probe OUT")
        self.fails(2, ["study", "latency", "mine", "--probe", "x.wav", "--duration", "1"], "--duration")
        self.fails(2, ["study", "latency", "mine", "sounds/a.wav"], "only 1 channel")
        # Somebody's notes in its place are not written over.
        self.put("mine/latency.json", b"my notes")
        self.fails(1, ["study", "latency", "mine", "back.wav"], "latency.json")
        self.assertEqual((self.folder / "mine/latency.json").read_text(), "my notes")


class Plans(StudyTest):
    def test_groups_have_sizes_and_the_blocks_of_their_own(self):
        self.assertIn("--group NAME:SIZE ", self.succeeds("study", "new", "--help"))
        made = self.new("coherence", "-g", "A:10", "-g", "B:10")
        self.assertEqual([block["name"] for block in made["blocks"]],
                         ["words of sounds", "words of touches", "coherence, one after the other"])
        self.succeeds("study", "check", "mine")
        # Others do the blocks by their place, and any number of them: the fourth does those of the first.
        def blocks(*groups):
            made = self.new("coherence", *(word for name in groups for word in ("-g", f"{name}:4")), "-y")
            self.succeeds("study", "check", "mine")
            self.assertEqual([group["name"] for group in made["groups"]], list(groups))
            return {block["name"]: "".join(block["groups"]) for block in made["blocks"]}
        one_after, at_once = "coherence, one after the other", "coherence, at once"
        self.assertEqual(blocks("D"), {"words of sounds": "D", one_after: "D"})
        self.assertEqual(blocks(*"XYZ"), {"words of sounds": "X", "words of touches": "Y", "words of both": "Z",
                                          one_after: "XY", at_once: "Z"})
        self.assertEqual(blocks(*"ABCDEFG"), {"words of sounds": "ADG", "words of touches": "BE", "words of both": "CF",
                                              one_after: "ABDEG", at_once: "CF"})
        self.assertEqual(blocks("C", "D")[at_once], "C")
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        found = self.report("study", "report", "simulated")
        self.assertEqual(set(found["participants"]), {"C", "D"})

    def test_exposure_is_that_of_the_part_which_the_actuator_shakes(self):
        for profile, part, daily in (("seat-shaker", "wholeBody", 0.5), ("bass-shaker", "wholeBody", 0.5),
                                     ("l5-wristband", "hand", 2.5), ("phone-erm", "hand", 2.5)):
            with self.subTest(profile):
                limits = self.new("jnd", "--profile", profile, "-y")["limits"]
                self.assertEqual((limits["part"], limits["daily"]), (part, daily))
                findings = json.loads(self.run_command("study", "check", "mine", "--json").stdout)["findings"]
                self.assertEqual([one for one in findings if one["where"] == "limits.part"], [])
        # What was made for another is told, both ways.
        self.new("words", "-y")
        self.warns("study", "check", "mine", "--profile", "bass-shaker",
                   says="limits.part: is the hand, but 'Puck bass shaker below a seat' shakes the whole body, whose "
                        "exposure ISO 2631-1 limits to 0.5 m/s2")
        self.new("words", "-y", "--profile", "bass-shaker")
        self.warns("study", "check", "mine", "--profile", "l5-wristband", says="limits.part: is the whole body")
        self.fails(1, ["study", "new", "other", "--template", "jnd", "--profile", "gone.json"], "gone.json")

    def test_minutes_of_the_templates_are_those_of_the_check(self):
        self.new("threshold")
        said = re.search(r"some (\w+) minutes", (self.folder / "mine/study.json").read_text())[1]
        page = (SOURCE / "Resources/docs/study.md").read_text()
        self.assertIn(f"at eight frequencies; some {said} minutes", page)
        [group] = self.report("study", "check", "mine")["groups"]
        self.assertEqual(said, ["eight", "nine", "ten"][round(group["minutes"]) - 8])

    def test_the_check_tells_the_power_of_the_design(self):
        self.new("coherence", "-g", "A:10", "-g", "C:10")
        told = self.succeeds("study", "check", "mine")
        self.assertEqual(told, self.succeeds("study", "check", "mine"))
        groups, *stimuli = self.report("study", "check", "mine")["power"]
        self.assertEqual((groups["first"], groups["second"], groups["people"], groups["trials"]), ("A", "C", [10, 10], 3))
        self.assertEqual([one["d"] for one in groups["effects"]], [0.2, 0.4, 0.6, 0.8, 1, 1.2])
        self.assertEqual([one["people"] for one in stimuli], [10, 10])
        for design in (groups, *stimuli):
            power = [one["power"] for one in design["effects"]]
            self.assertEqual(power, sorted(power))
        self.assertIn("Power of A against C (10 and 10 people, 3 ratings each): d 0.2 (", told)
        self.assertIn('Power of two stimuli of "coherence, at once" (10 people, 1 rating of each): d 0.2 (', told)
        one = self.report("study", "check", "mine", "--effect", "1")["power"][0]["effects"]
        predicted = self.report("study", "simulate", "mine", "--effect", "1", "--runs", "10")["power"][0]["analytic"]
        self.assertEqual([effect["points"] for effect in one], [1])
        self.assertAlmostEqual(one[0]["power"], predicted, places=12)
        self.new("threshold", "-y")
        self.assertEqual(self.report("study", "check", "mine")["power"], [])

    def test_half_an_hour_without_a_break_is_told(self):
        made = self.new("abx")
        made["blocks"][0]["repeats"] = 500
        self.put("mine/study.json", json.dumps(made).encode())
        self.warns("study", "check", "mine", says="are 532 trials and some 54 minutes in group all without a break")
        made["blocks"][0]["breakAfter"] = 100
        self.put("mine/study.json", json.dumps(made).encode())
        self.succeeds("study", "check", "mine")


class Mistakes(StudyTest):
    def test_what_is_wrong_is_said(self):
        self.fails(2, ["study", "new", "x", "--template", "coherense", "sounds/"], "did you mean coherence?")
        self.fails(2, ["study", "new", "x", "--template", "coherence"], "needs 2 at least")
        self.fails(2, ["study", "new", "x", "--template", "jnd", "-g", "A"], "A:11")
        self.fails(1, ["study", "new", "x", "--template", "coherence", "gone.wav", "sounds/"], "gone.wav")
        self.fails(1, ["study", "check", "nowhere"], "nowhere")
        self.fails(1, ["study", "report", "nowhere"], "nowhere")
        self.new()
        self.fails(1, ["study", "report", "mine"], "no session")
        self.fails(2, ["study", "report", "mine", "--combine", "A"], "A+B")
        self.put("bad.csv", b"stimulus,rating\n1,x\n")
        self.fails(1, ["study", "report", "bad.csv"], "line 2: 'x' is not a rating")
        document = json.loads((self.folder / "mine/study.json").read_text())
        document["stimuli"][1]["sound"] = "gone.wav"
        self.put("mine/study.json", json.dumps(document).encode())
        self.fails(1, ["study", "check", "mine"], 'stimuli[1] ("b"): gone.wav')
        document["blocks"][0]["replay"] = 1
        self.put("mine/study.json", json.dumps(document).encode())
        self.fails(1, ["--strict", "study", "check", "mine"], '"replays"')

    def test_no_sound_is_left_out(self):
        for template, takes, *given in (
                ("place", "takes no sounds, but 1 was given", "sounds/a.wav"),
                ("threshold", "takes no sounds, but 3 were given", "sounds/"), ("jnd", "takes no sounds", "sounds/"),
                ("questionnaire", "takes no sounds", "sounds/"),
                ("events", "takes none, or 2 to 4 sounds, but 1 was given", "sounds/a.wav"),
                ("events", "but 6 were given", "sounds/", "more/")):
            with self.subTest((template, given)):
                for name in "def":
                    self.put(f"more/{name}.wav", wav(sine(100, 0.1)))
                self.fails(2, ["study", "new", "x", "--template", template, *given], takes,
                           "another template: coherence (2 or more), words (1 or more)", "events (none, or 2 to 4)")
        self.assertFalse((self.folder / "x").exists())
        self.assertIn("(sounds: none, or 2 to 4)", self.succeeds("study", "new", "--help"))

    def test_tables_are_replaced_only_on_request(self):
        self.new("words")
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        self.succeeds("study", "export", "simulated", "-o", "tables")
        self.put("tables/answers.csv", b"mine")
        self.fails(1, ["study", "export", "simulated", "-o", "tables"], "-y replaces its tables")
        self.assertIn("was kept", self.succeeds("study", "export", "simulated", "-o", "tables", "-n"))
        self.assertEqual((self.folder / "tables/answers.csv").read_bytes(), b"mine")
        self.succeeds("study", "export", "simulated", "-o", "tables", "-y")
        self.assertNotEqual((self.folder / "tables/answers.csv").read_bytes(), b"mine")

    def test_nothing_of_the_users_is_lost(self):
        self.new()
        self.fails(1, ["study", "new", "mine", "--template", "jnd"], "exists; -y replaces it")
        self.assertEqual(json.loads((self.folder / "mine/study.json").read_text())["name"], "coherence")
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        self.fails(1, ["study", "simulate", "mine", "-o", "simulated"], "not empty")
        self.succeeds("study", "report", "simulated")
        self.succeeds("study", "report", "simulated")  # its own is written anew
        mine = self.folder / "simulated/report/report.md"
        mine.write_text(mine.read_text() + "\nWhat I think of it.\n")
        self.fails(1, ["study", "report", "simulated"], "report.md")
        self.assertIn("What I think", mine.read_text())
        self.succeeds("study", "report", "simulated", "-y")
        self.assertNotIn("What I think", mine.read_text())

    def test_a_person_is_forgotten_only_when_that_is_sure(self):
        self.new()
        self.succeeds("study", "simulate", "mine", "-o", "simulated", "--runs", "10")
        log = self.folder / "simulated/sessions/P007.jsonl"
        self.succeeds("study", "forget", "simulated", "P007")
        self.assertTrue(log.exists())
        self.succeeds("study", "forget", "simulated", "P007", "--yes")
        self.assertFalse(log.exists())
        self.fails(1, ["study", "forget", "simulated", "P007", "--yes"], "no session of 'P007'")
        self.fails(1, ["study", "forget", "simulated", "../study", "--yes"], "no session")


if __name__ == "__main__":
    unittest.main()
