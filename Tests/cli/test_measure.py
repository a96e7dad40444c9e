"""End to end: pacini measure, from a sweep over simulated wearers to an actuator that is proven flat."""
import json
import math
import random
import re
import struct
import unittest
import wave

from command import SOURCE, SANITIZED, CommandTest, sine, wav


def peaking(section, f, fs):
    """dB of a section at f by the formulas of Robert Bristow-Johnson's cookbook."""
    w0 = 2 * math.pi * section["frequency"] / fs
    a = 10 ** (section["gain"] / 40)
    alpha = math.sin(w0) / (2 * section["q"])
    cos, root = math.cos(w0), 2 * math.sqrt(a) * alpha
    if section["type"] == "peak":
        top, bottom = (1 + alpha * a, -2 * cos, 1 - alpha * a), (1 + alpha / a, -2 * cos, 1 - alpha / a)
    elif section["type"] == "lowShelf":
        top = (a * (a + 1 - (a - 1) * cos + root), 2 * a * (a - 1 - (a + 1) * cos), a * (a + 1 - (a - 1) * cos - root))
        bottom = (a + 1 + (a - 1) * cos + root, -2 * (a - 1 + (a + 1) * cos), a + 1 + (a - 1) * cos - root)
    else:
        assert section["type"] == "highShelf", section
        top = (a * (a + 1 + (a - 1) * cos + root), -2 * a * (a - 1 + (a + 1) * cos), a * (a + 1 + (a - 1) * cos - root))
        bottom = (a + 1 - (a - 1) * cos + root, 2 * (a - 1 - (a + 1) * cos), a + 1 - (a - 1) * cos - root)
    z = complex(math.cos(2 * math.pi * f / fs), -math.sin(2 * math.pi * f / fs))
    value = (top[0] + top[1] * z + top[2] * z * z) / (bottom[0] + bottom[1] * z + bottom[2] * z * z)
    return 20 * math.log10(abs(value))


def csv(frequencies, levels):
    return "frequency,dB\n" + "".join(f"{f!r},{level!r}\n" for f, level in zip(frequencies, levels))


class MeasureTest(CommandTest):
    def refused(self, pattern, *arguments):
        """Runs; exit 1 and one message that matches."""
        self.assertRegex(self.fails(1, arguments).stderr.decode(), pattern)

    def warned(self, *arguments):
        """Runs with --json; the object on stdout, and the warnings, of which there are some."""
        done = self.run_command(*arguments, "--json")
        warnings = done.stderr.decode()
        for line in warnings.splitlines():
            self.assertRegex(line, r"^pacini: .*: warning: ")
        return done.returncode, json.loads(done.stdout), warnings


class Fit(MeasureTest):
    def cases(self):
        return json.loads((SOURCE / "Tests/golden/eq_cases.json").read_text())

    def test_what_is_reported_is_what_the_sections_do(self):
        cases = self.cases()
        frequencies = cases["frequencyHz"]
        for index, rate in ((0, 48000), (6, 8000), (10, 3000), (15, 48000)):
            case = cases["cases"][index]
            self.put("response.csv", csv(frequencies, case["responseDb"]).encode())
            for sections in ("3", "auto"):
                report = self.report("measure", "fit", "response.csv", "--sections", sections, "--rate", str(rate))
                curve = [sum(peaking(s, f, rate) for s in report["sections"]) for f in frequencies]
                flat = [level + eq for level, eq in zip(case["responseDb"], curve)]
                mean = sum(flat) / len(flat)
                rms = math.sqrt(sum((x - mean) ** 2 for x in flat) / len(flat))
                self.assertAlmostEqual(report["rms"], rms, delta=0.01)
                self.assertAlmostEqual(report["max"], max(abs(x - mean) for x in flat), delta=0.01)
                self.assertLessEqual(max(sum(peaking(s, f, rate) for s in report["sections"])
                                         for f in (10 * 1.01 ** i for i in range(500)) if f < 0.49 * rate), 12.2)
                self.assertGreater(report["milliseconds"], 0)
                if sections == "3":
                    self.assertLessEqual(len(report["sections"]), 3)

    def test_a_flat_response_needs_no_section(self):
        self.put("flat.csv", csv(range(30, 130), [3.5] * 100).encode())
        report = self.report("measure", "fit", "flat.csv")
        self.assertEqual(report["sections"], [])
        self.assertEqual((report["rms"], report["max"]), (0, 0))

    def test_bad_responses_are_refused_at_their_place(self):
        good = "".join(f"{10 * i},{i}\n" for i in range(1, 10))
        for text, where in (("10,0\n20,0\n", "points"), (good + "5,0\n", "line 10: frequency"),
                            (good + "100,nan\n", "line 10: level"), (good + "100\n", "line 10: level"),
                            ("10,1\n" * 9, "line 2: frequency"), ("", "points")):
            self.put("bad.csv", text.encode())
            self.refused(r"bad\.csv: " + where, "measure", "fit", "bad.csv")
        self.refused(r"none\.csv: ", "measure", "fit", "none.csv")
        self.refused(r"measurement: is missing", "measure", "fit", "l5-wristband")

    def test_the_equaliser_goes_into_a_profile(self):
        self.put("r.csv", csv(*zip(*((f, -6 * math.log2(f / 100)) for f in range(30, 1000, 10)))).encode())
        self.succeeds("measure", "fit", "r.csv", "--profile", "l5-test-jig", "-o", "mine.json", "--plot", "mine.svg")
        profile = json.loads((self.folder / "mine.json").read_text())
        self.assertTrue(profile["equalizer"])
        self.assertIn("r.csv", profile["sources"]["equalizer"])
        self.assertIn(b"<svg", (self.folder / "mine.svg").read_bytes()[:400])


class EndToEnd(MeasureTest):
    def test_several_files_do_not_go_to_standard_output(self):
        self.fails(2, ["measure", "sweep", "-o", "-"], "-: takes one file, but a sweep is a sound and its description")
        self.fails(2, ["measure", "simulate", "sweep.wav", "-o", "-", "--wearers", "2"], "-: takes one file, but --wearers")
        self.assertEqual(self.names(), [])

    def test_one_wearer_and_several_exclude_each_other(self):
        self.fails(2, ["measure", "simulate", "sweep.wav", "-o", "rec.wav", "--wearers", "2", "--wearer", "1"],
                   "--wearers", " excludes ")

    def test_fourteen_wearers_become_flat(self):
        seconds = "2" if SANITIZED else "6"
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", seconds, "--rate", "8000", "--levels", "-12")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--wearers", "12")
        for loose in (13, 14):
            self.succeeds("measure", "simulate", "sweep.wav", "-o", f"rec-{loose}.wav", "--wearer", str(loose),
                          "--contact", "-6")
        recordings = [f"rec-{i:02}.wav" for i in range(1, 15)]
        code, report, warnings = self.warned("measure", "analyse", *recordings, "--sweep", "sweep.json", "--full-scale",
                                             "5g", "-o", "mine.json", "--name", "Mine", "--plot", "mine.svg")
        self.assertEqual(code, 0)
        self.assertRegex(warnings, r"rec-01\.wav and 13 more: warning: clock: .* 50 ppm")
        self.assertEqual(sorted(entry["input"] for entry in report["outliers"]), ["rec-13.wav", "rec-14.wav"])
        for entry in report["recordings"]:
            self.assertAlmostEqual(entry["driftPpm"], 50, delta=2)
            self.assertAlmostEqual(entry["latency"], 0.012, delta=0.002)

        fit = self.report("measure", "fit", "mine.json", "-o", "mine.json", "--rate", "8000", "--goal",
                          "0.5")
        self.assertLess(fit["max"], 0.5)
        self.succeeds("measure", "sweep", "-o", "flat.wav", "--duration", seconds, "--rate", "8000", "--levels", "-15",
                      "--profile", "mine.json")
        self.succeeds("measure", "simulate", "flat.wav", "-o", "after.wav", "--wearers", "12")
        after = [f"after-{i:02}.wav" for i in range(1, 13)]
        code, verified, _ = self.warned("measure", "verify", *after, "--sweep", "flat.wav", "--full-scale", "5g",
                                        "--profile", "mine.json", "--tolerance", "1", "--plot", "after.svg")
        self.assertEqual(code, 0)
        self.assertTrue(verified["passed"])
        self.assertLessEqual(abs(verified["worstDeviation"]), 1)
        each = sorted(abs(entry["worstDeviation"]) for entry in verified["recordings"])
        self.assertLessEqual(each[9], 3)  # the two most unlike the average have skins at the ends of the assumed range
        self.assertLessEqual(each[11], 4)
        profile = json.loads((self.folder / "mine.json").read_text())
        self.assertEqual(profile["measurement"]["fittings"], 12)
        self.assertEqual(profile["measurement"]["linearity"]["worstDeviation"], verified["worstDeviation"])
        self.succeeds("info", "mine.json")

    def test_impulse_response_group_delay_and_each_order_are_reported(self):
        """A cubic a x^3 at full drive has the third order at a / 4 of 1 + 3 a / 4."""
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "4", "--rate", "8000", "--levels", "0")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--wearers", "2", "--range", "30", "--noise",
                      "10", "--bits", "16", "--distortion", "0.2", "--profile", "wideband-exciter")
        analyse = ["measure", "analyse", "rec-01.wav", "rec-02.wav", "--sweep", "sweep.json", "--full-scale", "30g"]
        code, report, _ = self.warned(*analyse, "--impulse", "impulse.wav", "--plot", "r.svg", "-o", "r.csv")
        self.assertEqual(code, 0)
        # The harmonic is above the fundamental by the response's rise from f to 3 f.
        rows = [line.split(",") for line in (self.folder / "r.csv").read_text().splitlines()]
        table = {name: [float(row[i]) if row[i] else math.nan for row in rows[1:]] for i, name in enumerate(rows[0])}
        frequency, level = table["frequency"], table["dB 1"]

        def at(values, wanted):
            return values[min(range(len(frequency)), key=lambda i: abs(math.log(frequency[i] / wanted)))]

        for f in (150, 200, 300):
            expected = 20 * math.log10(0.2 / 4 / (1 + 0.75 * 0.2)) + at(level, 3 * f) - at(level, f)
            self.assertAlmostEqual(at(table["order 3 dB 1"], f), expected, delta=1)
        orders = {peak["order"]: peak for peak in report["harmonics"]}
        self.assertEqual(sorted(orders), [2, 3, 4, 5])
        felt = report["felt"]
        for order in orders:
            inside = [max(one, two) for f, one, two in zip(frequency, table[f"order {order} dB 1"],
                                                          table[f"order {order} dB 2"])
                      if felt["lowFrequency"] <= f <= felt["highFrequency"] and not math.isnan(one)]
            self.assertAlmostEqual(orders[order]["level"], max(inside), delta=0.01)
        self.assertGreater(orders[3]["level"], orders[5]["level"] + 10)
        delays = sorted(at(table[f"group delay ms {i}"], report["resonance"]["frequency"]) for i in (1, 2))
        self.assertTrue(delays[0] - 0.2 < 1e3 * report["groupDelay"] < delays[1] + 0.2, (delays, report["groupDelay"]))
        picture = (self.folder / "r.svg").read_text()
        for word in ("Group delay", "order 2", "order 5", "all harmonics"):
            self.assertIn(word, picture)
        text = self.run_command(*analyse).stdout.decode()
        self.assertRegex(text, r"group delay [0-9.]+ ms at the resonance")
        self.assertRegex(text, r"by order, re the fundamental: 2 -?[0-9.]+ dB at \d+ Hz, 3 ")

        rate, channels, samples = self.floats("impulse.wav")
        self.assertEqual((rate, channels), (report["impulse"]["sampleRate"], 2))
        arrival = round(report["impulse"]["arrival"] * rate)
        for channel in (0, 1):
            h = samples[channel::2]
            strongest = max(range(len(h)), key=lambda i: abs(h[i]))
            self.assertLess(abs(strongest - arrival), 0.003 * rate)
            for f in (80, 200, 700):  # its Fourier transform is the response
                turns = [2 * math.pi * f * i / rate for i in range(len(h))]
                gain = math.hypot(sum(x * math.cos(t) for x, t in zip(h, turns)),
                                  sum(x * math.sin(t) for x, t in zip(h, turns)))
                self.assertAlmostEqual(20 * math.log10(gain), at(table[f"dB {channel + 1}"], f), delta=0.7)

    def floats(self, name):
        """Rate, channels and samples of a WAV of 32-bit floats."""
        data = (self.folder / name).read_bytes()
        form = data.index(b"fmt ") + 8
        code, channels, rate = struct.unpack_from("<HHI", data, form)
        self.assertEqual(code, 3)
        start = data.index(b"data") + 8
        size = struct.unpack_from("<I", data, start - 4)[0]
        return rate, channels, struct.unpack_from(f"<{size // 4}f", data, start)

    def test_a_report_has_what_standards_and_guides_ask(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "4", "--levels", "-10")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "heavy.wav", "--mass", "100")
        measured = ["--sweep", "sweep.json", "--full-scale", "5g"]
        report, warnings = self.warned("measure", "report", "rec.wav", *measured, "--volts", "2.5", "--worn", "heavy.wav",
                                       "--mass", "100", "--name", "Band <b> & more", "-o", "report.html")[1:]
        self.assertEqual((report["mass"], report["volts"], report["wornRecordings"]), (100, 2.5, ["heavy.wav"]))
        self.assertAlmostEqual(report["strongest"]["perVolt"], report["strongest"]["acceleration"] / 2.5)
        self.assertLess(report["bandwidth10"]["lowFrequency"], report["bandwidth3"]["lowFrequency"])
        self.assertGreater(report["bandwidth10"]["highFrequency"], report["bandwidth3"]["highFrequency"])
        self.assertGreater(report["worn"]["atStrongest"], 3.0)
        self.assertGreater(report["edges"]["rise"], 0.01)
        page = (self.folder / "report.html").read_text()
        # One file: nothing is fetched, and names are text.
        self.assertEqual(re.findall(r"(?i)(?:href|src) *=(?!\"#section-)|@import|url\((?!#clip\d+\))", page), [])
        self.assertEqual(set(re.findall(r"https?:[^\"' <]*", page)), {"http://www.w3.org/2000/svg"})
        self.assertIn("Band &lt;b&gt; &amp; more", page)
        for words in ("Rise, 10 to 90 %", "Acceleration at 1 V", "ISO 9241-940", "IEEE 1918.1.1", "VT-1", "Immersion",
                      "not public", "100 g"):
            self.assertIn(words, page)
        # The voltage of a profile is that of full drive, and the figures are also a file.
        same = self.warned("measure", "report", "rec.wav", *measured, "--profile", "l5-wristband", "-o", "r.json")[1]
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["resonance"], same["resonance"])
        self.assertEqual(same["resonance"], report["resonance"])
        self.assertNotIn("worn", same)

    def test_levels_without_a_calibration_are_no_accelerations(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--levels", "-10")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav")
        relative = ["--sweep", "sweep.json", "--volts", "2.8"]
        report = self.warned("measure", "report", "rec.wav", *relative, "-o", "report.json")[1]
        self.assertEqual(list(report["strongest"]), ["frequency"])
        self.assertEqual(json.loads((self.folder / "report.json").read_text())["strongest"], report["strongest"])
        printed = self.run_command("measure", "report", "rec.wav", *relative, "-o", "report.html").stdout.decode()
        page = (self.folder / "report.html").read_text()
        for name in ("Acceleration at full drive", "Acceleration at 1 V"):
            self.assertIn(f"{name}: not known without --full-scale", printed)
        self.assertEqual(page.count("not known without --full-scale"), 2)
        self.assertNotIn("dB re 1 m/s", page)
        self.warned("measure", "analyse", "rec.wav", "--sweep", "sweep.json", "--plot", "r.svg")
        self.assertNotIn("dB re 1 m/s", (self.folder / "r.svg").read_text())
        # One m/s^2 of full scale is a calibration, too.
        known = self.warned("measure", "report", "rec.wav", *relative, "--full-scale", "1", "-o", "known.json")[1]
        self.assertAlmostEqual(known["strongest"]["perVolt"], known["strongest"]["acceleration"] / 2.8)

    def test_a_measured_profile_says_what_is_felt_where_its_levels_are_known(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "4", "--levels", "-20")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--profile", "l5-wristband")
        self.warned("measure", "analyse", "rec.wav", "--sweep", "sweep.json", "--full-scale", "5g", "-o", "mine.json")
        self.warned("measure", "analyse", "rec.wav", "--sweep", "sweep.json", "-o", "relative.json")
        points = json.loads((self.folder / "mine.json").read_text())["measurement"]["points"]

        def measured(frequency):
            """m/s^2 at full drive."""
            return 10 ** (min(points, key=lambda point: abs(point["frequency"] - frequency))["level"] / 20)

        # The acceleration that is felt of a tone is the measured one.
        for frequency in (40, 80, 160, 320):
            curve = [{"time": 0, "amplitude": 0.2}, {"time": 4, "amplitude": 0.2}]
            self.put("tone.json", json.dumps({
                "format": "pacini.clip", "version": 1, "name": "tone", "duration": 4, "envelope": [], "transients": [],
                "bands": [{"lowFrequency": 0.9 * frequency, "centreFrequency": frequency, "highFrequency": 1.1 * frequency,
                           "priority": 0, "amplitude": curve, "pitch": []}]}))
            as_is = ["render", "tone.json", "--profile", "mine.json", "--no-adapt"]
            self.succeeds(*as_is, "-o", "drive.wav")
            self.succeeds(*as_is, "--felt", "-o", "felt.wav")
            levels = []
            for name in ("drive.wav", "felt.wav"):
                rate, channels, samples = self.floats(name)
                self.assertEqual(len(samples), 4 * rate)
                middle = samples[rate:3 * rate]
                levels.append((sum(x * x for x in middle) / len(middle)) ** 0.5)
            with self.subTest(frequency):
                self.assertAlmostEqual(20 * math.log10(100 * levels[1] / levels[0] / measured(frequency)), 0, delta=0.5)
        # So it serves as the actuator of a design, and limits the exposure of a study.
        for pair in (("mine.json", "lra-175"), ("lra-175", "mine.json")):
            self.assertEqual(self.run_command("render", "tone.json", "--designed-for", pair[0], "--profile", pair[1],
                                              "-o", "alike.wav", "-y").returncode, 0, pair)
        self.succeeds("study", "new", "s", "--template", "jnd", "--profile", "mine.json")
        check = json.loads(self.run_command("study", "check", "s", "--json").stdout)
        self.assertFalse(check["exposureIsAssumed"])
        # Relative levels say nothing of that, and are told so.
        self.fails(1, ["render", "tone.json", "--profile", "relative.json", "--felt", "-o", "no.wav"],
                   "body: is missing, and the measured levels are relative", "--full-scale")
        self.fails(1, ["render", "tone.json", "--profile", "lra-175", "--designed-for", "relative.json", "-o", "no.wav"],
                   "--designed-for: body: is missing, and the measured levels are relative")
        self.fails(1, ["render", "tone.json", "--profile", "mine.json", "--felt", "--wearer", "3", "-o", "no.wav"], "wearer")
        said = self.run_command("study", "check", "s", "--profile", "relative.json").stdout.decode()
        self.assertIn("(assuming 50 m/s2 at full drive, as the measured levels of the profile are relative)", said)

    def test_existing_results_are_kept_on_request(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--levels", "-10")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav")
        analysis = ["rec.wav", "--sweep", "sweep.json", "--full-scale", "5g"]
        for output, *command in (("mine.json", "analyse", *analysis), ("report.html", "report", *analysis),
                                 ("strap.wav", "compensate", "sweep.wav", "--duration", "2")):
            with self.subTest(command):
                self.put(output, b"my own")
                said = self.succeeds("measure", *command, "-o", output, "-n")
                self.assertIn(f"{output} exists and was kept", said)
                self.assertEqual((self.folder / output).read_bytes(), b"my own")
                self.assertEqual(self.run_command("measure", *command, "-o", output, "-y").returncode, 0)
                self.assertNotEqual((self.folder / output).read_bytes(), b"my own")

    def test_a_report_is_written_over_nothing_that_was_read(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--levels", "-10")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav")
        for pattern, *arguments in (
            (r"extension .html or .json", "-o", "report.wav"),
            (r"is the description of the sweep", "-o", "sweep.json"),
            (r"--mass: needs --worn", "-o", "report.html", "--mass", "3"),
        ):
            with self.subTest(pattern):
                self.assertRegex(self.fails(2, ["measure", "report", "rec.wav", "--sweep", "sweep.json", *arguments])
                                 .stderr.decode(), pattern)

    def test_compensation_gives_back_what_a_tightened_strap_takes(self):
        noise = random.Random(3)
        self.put("drive.wav", wav([0.2 * noise.gauss(0, 1) for _ in range(8000)], 8000))
        options = ["measure", "compensate", "drive.wav", "--duration", "50", "--range", "50"]
        report = self.report(*options, "-o", "strap.wav")
        self.assertGreater(report["change"], 3.0)
        self.assertLess(report["compensated"], 0.5 * report["change"])
        self.assertEqual(len(report["bands"]), 12)
        with wave.open(str(self.folder / "strap.wav")) as sound:
            self.assertEqual((sound.getnchannels(), sound.getnframes(), sound.getframerate()), (3, 400000, 8000))
        # A strap that stays as it is leaves nothing to do.
        same = self.report(*options, "--tightness", "1")
        self.assertLess(same["change"], 1e-9)
        self.assertLess(same["compensated"], 0.5)
        # Any delay that is told, and any latency.
        for latency, told in (("0", "1000"), ("1000", "0"), ("1000", "1000")):
            wrong = self.report(*options, "--time", "2", "--latency", latency, "--delay", told)
            self.assertLess(wrong["compensated"], 0.6 * wrong["change"], (latency, told))
        self.assertEqual(self.report(*options, "--limit", "0")["compensated"], report["change"])

    def test_what_cannot_be_compensated_is_said(self):
        self.put("drive.wav", wav([0.1] * 800, 8000))
        self.put("two.wav", wav([0.1] * 800, 8000, channels=2))
        self.refused(r"two.wav: must have one channel", "measure", "compensate", "two.wav")
        self.refused(r"is a motor", "measure", "compensate", "drive.wav", "--profile", "erm-coin")
        for pattern, *arguments in ((r"is the drive", "-o", "drive.wav"), (r"--bands", "--bands", "25"),
                                    (r"--time", "--time", "1.9"), (r"--delay", "--delay", "1001")):
            with self.subTest(pattern):
                self.assertRegex(self.fails(2, ["measure", "compensate", "drive.wav", *arguments]).stderr.decode(),
                                 pattern)

    def test_an_impulse_response_needs_a_wav_of_its_own(self):
        for name in ("impulse.flac", "impulse", "impulse.csv"):
            self.fails(2, ["measure", "analyse", "rec.wav", "--sweep", "sweep.json", "--impulse", name],
                       f"{name}: --impulse: must have the extension .wav")
        self.fails(2, ["measure", "analyse", *(f"{i}.wav" for i in range(65)), "--sweep", "sweep.json", "--impulse",
                       "impulse.wav"], "impulse.wav: --impulse: holds 64 recordings at most")
        self.assertEqual(self.names(), [])

    def test_what_is_not_flat_fails_and_says_where(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--rate", "8000")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav")
        self.assertEqual(self.warned("measure", "analyse", "rec.wav", "--sweep", "sweep.wav", "-o", "mine.json")[0], 0)
        done = self.run_command("measure", "fit", "mine.json", "-o", "mine.json", "--rate", "8000")
        self.assertEqual(done.returncode, 0)
        profile = json.loads((self.folder / "mine.json").read_text())
        profile["equalizer"] = [{"type": "peak", "frequency": 200, "gain": 12, "q": 2}]
        self.put("mine.json", json.dumps(profile).encode())
        self.succeeds("measure", "sweep", "-o", "flat.wav", "--duration", "2", "--rate", "8000", "--levels", "-20",
                      "--profile", "mine.json")
        self.succeeds("measure", "simulate", "flat.wav", "-o", "after.wav")
        done = self.run_command("measure", "verify", "after.wav", "--sweep", "flat.wav", "--profile", "mine.json")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout.decode(), r"FAIL within ±4 dB.*\n.* Hz: [+-]\d")

    def chain(self, length, rig):
        """The five steps; what analyse and verify have said."""
        def names(start):
            return sorted(path.name for path in self.folder.glob(f"{start}*.wav"))

        for path in self.folder.iterdir():
            path.unlink()
        self.succeeds("measure", "sweep", "-o", "sweep.wav", *length)
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", *rig)
        analysed = self.run_command("measure", "analyse", *names("rec"), "--sweep", "sweep.json", "--full-scale", "5g",
                                    "-o", "mine.json")
        self.assertEqual(analysed.returncode, 0, analysed.stderr)
        self.succeeds("measure", "fit", "mine.json", "-o", "mine.json", "--rate", "8000")
        self.succeeds("measure", "sweep", "-o", "flat.wav", "--profile", "mine.json", *length)
        self.succeeds("measure", "simulate", "flat.wav", "-o", "after.wav", *rig)
        verified = self.run_command("measure", "verify", *names("after"), "--sweep", "flat.json", "--full-scale", "5g",
                                    "--profile", "mine.json")
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)
        self.assertIn(b"PASS", verified.stdout)
        return analysed.stderr.decode() + verified.stderr.decode()

    def test_the_steps_work_at_their_defaults(self):
        """On the sensor that is simulated, worn as described, and by others."""
        length = ["--rate", "8000", *(["--duration", "4"] if SANITIZED else [])]
        for wearers in ([], ["--wearer", "10"], ["--wearers", "3"]):
            with self.subTest(wearers):
                said = self.chain(length, wearers)
                self.assertNotIn("at the limit", said)

    def test_the_steps_work_on_every_actuator_with_one_axis_and_with_three(self):
        """With a sensor that hears the weak ones in four seconds too. Nothing clips, and nobody who has made an actuator
        flat is told that it is the drive that was recorded."""
        length = ["--duration", "5", "--rate", "8000"]
        chosen = ["l5-wristband", "lra-175"] if SANITIZED else [
            "l5-wristband", "l5-test-jig", "lra-175", "lra-235-narrow", "piezo", "phone-taptic", "quest-controller",
            "dualsense-voice-coil", "joycon-hd-rumble", "wideband-exciter"]
        for number, profile in enumerate(chosen):
            for axes, seed in (("1", 1), ("3", 5 + number)):
                with self.subTest((profile, axes, seed)):
                    said = self.chain(length, ["--profile", profile, "--seed", str(seed), "--axes", axes, "--wearer",
                                               str(seed), "--noise", "10", "--bits", "16"])
                    self.assertNotIn("at the limit", said)
                    self.assertNotIn("contains the drive", said)

    def test_a_sweep_through_an_equaliser_fits_full_scale_and_says_so(self):
        profile = json.loads((SOURCE / "profiles/l5-test-jig.json").read_text())
        profile["equalizer"] = [{"type": "peak", "frequency": 200, "gain": 11.5, "q": 1}]
        self.put("mine.json", json.dumps(profile))
        sweep = ["measure", "sweep", "-o", "flat.wav", "--duration", "2", "--rate", "8000", "--profile", "mine.json"]
        text = self.succeeds(*sweep, "--levels", "-20,-2")
        self.assertRegex(text, r"through the equaliser of '.*', 10 dB lower \(-30, -12 dB\)")
        report = self.report(*sweep, "--levels", "-20,-2")
        self.assertEqual((report["lowered"], report["gain"], report["levels"]), (10, 0, [-30, -12]))
        played = json.loads((self.folder / "flat.json").read_text())
        self.assertEqual((played["levels"], played["gain"]), ([-30, -12], 0))
        self.assertTrue(0.85 < self.peak("flat.wav") <= 1)
        self.assertEqual(self.report(*sweep, "--levels", "-40")["lowered"], 0)
        self.refused(r"mine\.json: --levels: cannot be lowered", *sweep, "--levels", "-80,-2")

    def test_what_an_equaliser_leaves_soft_is_played_louder_and_measured_as_if_it_were_not(self):
        profile = json.loads((SOURCE / "profiles/l5-test-jig.json").read_text())
        profile["equalizer"] = [{"type": "highShelf", "frequency": 2, "gain": -30, "q": 0.7}]
        self.put("mine.json", json.dumps(profile))
        sweep = ["measure", "sweep", "-o", "flat.wav", "--duration", "4", "--rate", "8000", "--profile", "mine.json"]
        report = self.report(*sweep, "--levels", "-12")
        self.assertTrue(20 < report["gain"] < 31, report)  # a shelf of the second order rings where the sweep starts
        self.assertAlmostEqual(20 * math.log10(self.peak("flat.wav")), -12, delta=0.1)
        self.succeeds("measure", "simulate", "flat.wav", "-o", "rec.wav", "--profile", "l5-test-jig", "--noise", "10")
        self.succeeds("measure", "sweep", "-o", "plain.wav", "--duration", "4", "--rate", "8000", "--levels", "-12")
        self.succeeds("measure", "simulate", "plain.wav", "-o", "bare.wav", "--profile", "l5-test-jig", "--noise", "10")
        plateau = {}
        for name, of in (("rec", "flat"), ("bare", "plain")):
            code, report, _ = self.warned("measure", "analyse", f"{name}.wav", "--sweep", f"{of}.json", "--full-scale",
                                          "5g")
            self.assertEqual(code, 0)
            plateau[name] = report["plateau"]
        self.assertAlmostEqual(plateau["bare"] - plateau["rec"], 30, delta=0.5)

    def peak(self, name):
        """Of a sound of 24 bits."""
        data = (self.folder / name).read_bytes()
        data = data[data.index(b"data") + 8:]
        return max(abs(int.from_bytes(data[i:i + 3], "little", signed=True))
                   for i in range(0, len(data) - 2, 3)) / 2 ** 23

    def test_a_simulated_sensor_that_clips_says_so(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--rate", "8000", "--levels", "0")
        done = self.run_command("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--wearers", "2")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr.decode(), r"rec-01\.wav and 1 more: warning: the sensor of 5 g clips; .*--range")
        text = self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--wearers", "2", "--range", "16")
        self.assertIn("--full-scale 16g", text)

    def test_nothing_is_minus_zero(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--rate", "8000", "--levels", "-0")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav", "--range", "30", "--drift", "0", "--latency",
                      "0", "--seed", "3")
        done = self.run_command("measure", "analyse", "rec.wav", "--sweep", "sweep.json", "-o", "mine.json")
        self.assertIn(" 0.0 ppm", done.stdout.decode())
        self.assertNotRegex(done.stdout.decode(), r"-0(\.0*)?\b(?!\.\d*[1-9])")

    def test_recordings_that_cannot_be_analysed_are_named(self):
        self.succeeds("measure", "sweep", "-o", "sweep.wav", "--duration", "2", "--rate", "8000")
        self.put("tone.wav", wav(sine(200, 8, 8000), 8000))
        self.refused(r"tone\.wav: channels: contain no sweep", "measure", "analyse", "tone.wav", "--sweep", "sweep.json")
        self.put("short.wav", wav(sine(200, 1, 8000), 8000))
        self.refused(r"short\.wav: channels: ", "measure", "analyse", "short.wav", "--sweep", "sweep.json")
        self.put("slow.wav", wav(sine(200, 8, 2000), 2000))
        self.refused(r"slow\.wav: ", "measure", "analyse", "slow.wav", "--sweep", "sweep.json")
        self.refused(r"none\.json: ", "measure", "analyse", "tone.wav", "--sweep", "none.json")
        self.put("other.json", b'{"format": "pacini.sweep", "version": 1}')
        self.refused(r"other\.json: lowFrequency: is missing", "measure", "analyse", "tone.wav", "--sweep",
                        "other.json")
        self.refused(r"--channels", "measure", "analyse", "tone.wav", "--sweep", "sweep.json", "--channels", "2")


if __name__ == "__main__":
    unittest.main()
