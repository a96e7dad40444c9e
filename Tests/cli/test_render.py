"""End to end: pacini render."""
import json
import math
import os
import unittest

from command import SOURCE, CommandTest, read_float_wav, rms


def level_at(samples, rate, frequency):
    """The amplitude of the sine of `frequency` in `samples`, by correlation under a Hann window."""
    n = len(samples)
    real = imag = weight = 0.0
    for i, x in enumerate(samples):
        w = 0.5 - 0.5 * math.cos(2 * math.pi * i / n)
        phase = 2 * math.pi * frequency * i / rate
        real += w * x * math.cos(phase)
        imag += w * x * math.sin(phase)
        weight += w
    return 2 * math.hypot(real, imag) / weight


class Render(CommandTest):
    def steady(self, **changes):
        """A clip of one steady band at 100 Hz without events."""
        curve = [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}]
        band = {"lowFrequency": 80, "centreFrequency": 100, "highFrequency": 125, "priority": 0, "amplitude": curve,
                "pitch": []}
        return self.clip(envelope=curve, bands=[band], transients=[], **changes)

    def rendered(self, *options, name="out.wav"):
        self.succeeds("render", "clip.json", "-o", name, *options)
        return read_float_wav(self.folder / name)

    def test_the_result_lies_beside_the_clip_and_is_as_long(self):
        self.clip(seconds=1.5)
        text = self.succeeds("render", "clip.json")
        self.assertRegex(text, r"^wrote clip\.haptic\.wav: 1\.50 s\n1 rendered: 1\.50 s, \d+ times real time\n$")
        rate, samples = read_float_wav(self.folder / "clip.haptic.wav")
        self.assertEqual((rate, len(samples)), (48000, 72000))
        self.assertGreater(rms(samples), 0.05)

    def test_every_rate_of_the_range_gives_the_same_signal(self):
        self.steady()
        for rate in (2000, 8000, 44100, 48000, 192000, 768000):
            got, samples = self.rendered("--rate", str(rate))
            self.assertEqual((got, len(samples)), (rate, rate))
            self.assertAlmostEqual(level_at(samples, rate, 100.0), 0.5, delta=0.02)

    def test_the_same_seed_gives_the_same_bytes_and_another_does_not(self):
        self.clip()
        bytes_of = lambda *options: (self.rendered(*options), (self.folder / "out.wav").read_bytes())[1]
        plain = bytes_of()
        self.assertEqual(plain, bytes_of())
        self.assertEqual(plain, bytes_of("--seed", "7"))
        seven = bytes_of("--variation", "0.5", "--seed", "7")
        self.assertEqual(seven, bytes_of("--variation", "0.5", "--seed", "7"))
        self.assertNotEqual(seven, bytes_of("--variation", "0.5", "--seed", "8"))
        self.assertNotEqual(seven, plain)
        bytes_of("--seed", str(2 ** 64 - 1))

    def test_transposing_moves_pitch_and_stretching_moves_time(self):
        self.steady()
        _, samples = self.rendered("--rate", "4000", "--transpose", "12")
        self.assertEqual(len(samples), 4000)
        self.assertGreater(level_at(samples, 4000, 200.0), 0.4)
        self.assertLess(level_at(samples, 4000, 100.0), 0.02)
        _, samples = self.rendered("--rate", "4000", "--stretch", "2.5")
        self.assertEqual(len(samples), 10000)
        self.assertGreater(level_at(samples, 4000, 100.0), 0.4)
        _, samples = self.rendered("--rate", "4000", "--delay", "0.25")
        self.assertEqual(rms(samples[:990]), 0.0)

    def test_a_profile_is_found_by_name_and_by_path_and_changes_the_signal(self):
        self.clip()
        flat = self.rendered()[1]
        by_name = self.rendered("--profile", "l5-wristband")[1]
        by_path = self.rendered("--profile", str(SOURCE / "profiles/l5-wristband.json"))[1]
        self.assertEqual(by_name, by_path)
        self.assertNotEqual(by_name, flat)
        self.fails(1, ["render", "clip.json", "--profile", "l6"], "pacini: l6: is neither a file nor a shipped profile",
                   "l5-wristband")

    def test_what_was_designed_on_one_actuator_feels_alike_on_another(self):
        """A tone within both ranges, which nothing limits: the skin moves as strongly."""
        soft = [{"time": 0, "amplitude": 0.02}, {"time": 1, "amplitude": 0.02}]
        band = {"lowFrequency": 80, "centreFrequency": 100, "highFrequency": 125, "priority": 0, "amplitude": soft,
                "pitch": []}
        self.clip(envelope=soft, bands=[band], transients=[])
        designed = ["--designed-for", "quest-controller"]

        def felt(*options):
            rate, samples = self.rendered("--felt", "--rate", "8000", *options, name="felt.wav")
            return 20 * math.log10(level_at(samples[rate // 2:], rate, 100))

        wanted = felt("--profile", "quest-controller")
        self.assertGreater(abs(felt("--profile", "l5-wristband") - wanted), 6)
        self.assertAlmostEqual(felt("--profile", "l5-wristband", *designed), wanted, delta=0.7)
        report = self.report("render", "clip.json", "-o", "out.wav", "--profile", "l5-wristband", *designed, "--explain")
        self.assertIn("levels are those that are felt on", json.dumps(report))

        self.steady()
        done = self.run_command("render", "clip.json", "-o", "out.wav", "--profile", "phone-taptic", "--designed-for",
                                "l5-wristband")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr.decode(), r"clip\.json: warning: is felt [0-9.]+ dB weaker than where it was designed")
        self.fails(1, ["render", "clip.json", "-o", "o.wav", "--profile", "lra-175", "--designed-for", "erm-coin"],
                   "--designed-for: technology: is a motor")
        self.fails(1, ["render", "clip.json", "-o", "o.wav", "--profile", "flat-pcm", "--designed-for", "lra-175"],
                   "--profile: body: is missing")
        self.fails(2, ["render", "clip.json", "--designed-for", "lra-175"], "--designed-for needs --profile")
        self.fails(2, ["render", "clip.json", "--designed-for", "lra-175", "--profile", "piezo", "--no-adapt"], "excludes")
        self.assertFalse((self.folder / "o.wav").exists())

    def test_another_actuator_of_the_design_renders_anew(self):
        self.steady()
        for name in ("l5-test-jig", "piezo", "piezo"):
            with self.subTest(name):
                self.succeeds("render", "clip.json", "--profile", "l5-wristband", "--designed-for", name)
        one = (self.folder / "clip.haptic.wav").read_bytes()
        self.succeeds("render", "clip.json", "--profile", "l5-wristband", "--designed-for", "l5-test-jig")
        self.assertNotEqual((self.folder / "clip.haptic.wav").read_bytes(), one)

    def test_a_folder_of_clips_of_both_formats_is_rendered(self):
        self.clip("in/a.json")
        self.clip("b.json")
        self.succeeds("convert", "b.json", "in/b.pacb")
        report = self.report("render", "in", "-o", "out", "-j", "2", "--rate", "8000")
        self.assertEqual([file["output"] for file in report["files"]], ["out/a.wav", "out/b.wav"])
        for file in report["files"]:
            self.assertEqual(file["bytes"], (self.folder / file["output"]).stat().st_size)
            self.assertEqual(file["duration"], 1.0)
            self.assertGreater(file["seconds"], 0)
            self.assertGreater(file["timesRealTime"], 0)

    def test_integer_samples_and_flac_are_written_and_clipping_is_told(self):
        self.steady()
        self.succeeds("render", "clip.json", "-o", "out.flac", "--encoding", "pcm16")
        self.assertEqual((self.folder / "out.flac").read_bytes()[:4], b"fLaC")
        sound = self.report("info", "out.flac")
        self.assertEqual((sound["frames"], sound["sampleRate"]), (48000, 48000))
        self.fails(0, ["render", "clip.json", "-o", "out.wav", "--encoding", "pcm16", "--gain", "20",
                       "--no-protection"], "warning: ", "samples were clipped", "--gain")

    def test_nothing_exceeds_full_drive_unasked(self):
        self.steady()
        _, plain = self.rendered()
        _, loud = self.rendered("--gain", "20", "--no-protection")
        self.assertAlmostEqual(max(map(abs, loud[24000:])), 5.0, delta=0.2)
        over = 20 * math.log10(max(map(abs, loud)))
        self.fails(0, ["render", "clip.json", "-o", "out.wav", "--gain", "20"],
                   "warning: ", f"the limiter takes back up to {over:.1f} of the 20.0 dB of --gain")
        _, kept = read_float_wav(self.folder / "out.wav")
        self.assertLessEqual(max(map(abs, kept)), 1.0)
        self.assertGreater(level_at(kept[24000:], 48000, 100.0), 0.9)
        report = json.loads(self.fails(0, ["render", "clip.json", "-o", "out.wav", "--gain", "20", "--json"],
                                       "warning: ").stdout)
        self.assertAlmostEqual(report["files"][0]["gainReduction"], over, delta=0.01)
        report = json.loads(self.succeeds("render", "clip.json", "-o", "out.wav", "--json"))
        self.assertEqual(report["files"][0]["gainReduction"], 0.0)
        self.assertEqual(read_float_wav(self.folder / "out.wav")[1], plain)
        self.assertEqual(plain, self.rendered("--no-protection")[1])

    def test_explain_names_what_is_left_out(self):
        self.clip()
        text = self.succeeds("render", "clip.json", "--explain")
        for part in ("1 sinusoid at an inner rate of 4000 Hz, levelled to the envelope, 1 pulse",
                     "nothing is left out", "1 rendered"):
            self.assertIn(part, text)
        curve = [{"time": 0, "amplitude": 0.5}]
        bands = [{"lowFrequency": f, "centreFrequency": f, "highFrequency": f,
                  "amplitude": [{"time": 0, "amplitude": level}]} for f, level in ((100, 0.5), (200, 0), (300, 1e-5))]
        self.clip(envelope=curve, bands=bands)
        text = self.succeeds("render", "clip.json", "--explain")
        self.assertIn("plays[0].bands[1] is silent: nothing lost", text)
        self.assertRegex(text, r"plays\[0\]\.bands\[2\] is too weak to be perceived: -\d\d\.\d dB")
        self.assertNotIn("left out:", self.succeeds("render", "clip.json", "--explain", "--everything"))

    def test_a_bad_clip_does_not_stop_the_others(self):
        self.clip("a.json")
        self.put("b.json", "{}")
        self.put("c.json", "")
        self.clip("d.json")
        done = self.fails(1, ["render", "a.json", "b.json", "c.json", "d.json", "-o", "out", "--json"],
                          "pacini: b.json: ", "pacini: c.json: is empty", lines=2)
        report = json.loads(done.stdout)
        self.assertEqual([file["output"] for file in report["files"]], ["out/a.wav", "out/d.wav"])
        self.assertEqual([failure["input"] for failure in report["failures"]], ["b.json", "c.json"])

    def test_empty_and_shortest_clips_render(self):
        for seconds, frames in ((0, 0), (1 / 48000, 1), (1e-9, None)):
            self.clip(seconds=seconds, envelope=[], bands=[], transients=[])
            _, samples = self.rendered()
            if frames is not None:
                self.assertEqual(len(samples), frames)
            self.assertEqual(rms(samples), 0.0)

    def test_wrong_options_are_usage_errors_that_name_the_range(self):
        self.clip()
        for option, value, says in (("--rate", "1999", "2000 to 768000"), ("--rate", "768001", "2000 to 768000"),
                                    ("--rate", "nan", "2000 to 768000"), ("--stretch", "nan", "0.01 to 100"),
                                    ("--stretch", "0", "0.01 to 100"), ("--gain", "inf", "-120 to 60"),
                                    ("--transpose", "nan", "-96 to 96"), ("--delay", "-1", "0 to 3600"),
                                    ("--variation", "1.01", "0 to 1"), ("--seed", "-1", "0 to 2^64 - 1"),
                                    ("--seed", "1e3", "0 to 2^64 - 1"), ("--seed", str(2 ** 64), "--seed"),
                                    ("--encoding", "mp3", "pcm16"), ("--pulse-frequency", "0", "1 to 2000")):
            self.fails(2, ["render", "clip.json", option, value], option, says, "pacini render --help")
        self.assertEqual(self.names(), ["clip.json"])

    def test_options_without_effect_are_usage_errors_that_say_what_to_do(self):
        self.clip()
        for option in (["--strength", "1"], ["--max-boost", "3"], ["--mapping", "fold"], ["--no-adapt"]):
            self.fails(2, ["render", "clip.json", *option], f"{option[0]} needs --profile")
            if option != ["--no-adapt"]:
                self.fails(2, ["render", "clip.json", "--profile", "lra-175", "--no-adapt", *option],
                           option[0], " excludes ", "--no-adapt")
        for option in ("--pulse-frequency", "--pulse-cycles"):
            for shape in ([], ["--pulse", "adaptive"]):
                self.fails(2, ["render", "clip.json", option, "2", *shape], f"{option}: is for square and sine pulses",
                           "--pulse")
            self.succeeds("render", "clip.json", option, "2", "--pulse", "sine")

    def test_a_signal_of_days_is_refused_instead_of_filling_the_disk(self):
        self.clip(seconds=86400)
        self.fails(1, ["render", "clip.json", "--stretch", "100", "--rate", "2000"], "clip.json: would last 2400.0 hours",
                   "--stretch")
        self.assertEqual(self.names(), ["clip.json"])

    def test_wrong_outputs_are_named(self):
        self.clip()
        self.fails(1, ["render", "clip.json", "-o", "out.mp3"], "pacini: clip.json: out.mp3: ", ".wav or .flac")
        self.fails(1, ["render", "clip.json", "-o", "out.flac"], "out.flac: FLAC does not support float samples")
        self.fails(1, ["render", "clip.json", "-o", "clip.json"], "is also the input")
        self.assertEqual(self.names(), ["clip.json"])


class Part(CommandTest):
    """A part of a render is that part of the whole, sample by sample."""

    def part_of(self, file, start, end, *options):
        for render in (["whole.wav"], ["part.wav", "--from", str(start), "--to", str(end)]):
            done = self.run_command("render", file, "-q", *options, "-o", *render)  # a gain may be too much: a warning
            self.assertEqual(done.returncode, 0, done.stderr)
        rate, whole = read_float_wav(self.folder / "whole.wav")
        _, part = read_float_wav(self.folder / "part.wav")
        self.assertEqual(len(part), min(round(end * rate), len(whole)) - round(start * rate))
        self.assertGreater(max(map(abs, part)), 1e-4)
        self.assertEqual(part, whole[round(start * rate):round(start * rate) + len(part)])
        return len(part) / rate

    def test_of_a_clip_wherever_it_starts_and_ends(self):
        self.clip(seconds=2.0)
        for start, end in ((0, 0.5), (0.1, 0.10005), (0.4999, 1.7), (0.7, 2.0), (1.2, 50), (0.08533, 0.17067)):
            self.part_of("clip.json", start, end)

    def test_with_state_that_was_built_up_before(self):
        self.clip(seconds=2.0)
        for options in (["--profile", "l5-wristband"], ["--profile", "erm-coin"], ["--profile", "lra-175", "--gain",
                        "12"], ["--variation", "0.5", "--seed", "3"], ["--profile", "l5-wristband", "--felt"],
                        ["--stretch", "1.7", "--delay", "0.3", "--rate", "8000", "--pulse", "square"]):
            self.part_of("clip.json", 0.613, 1.91, *options)

    def test_of_a_scene(self):
        self.clip(seconds=1.0)
        self.put("s.scene.json", json.dumps({
            "format": "pacini.scene", "version": 1, "clips": ["clip.json"],
            "plays": [{"clip": 0}, {"clip": 0, "start": 0.5, "transposition": 7, "variation": {"amount": 0.3}},
                      {"clip": 0, "start": 1.1, "stretch": 2}],
            "changes": [{"time": 0.8, "play": 2, "parameter": "gain", "value": -6, "glide": 0.5}]}))
        self.part_of("s.scene.json", 0.9, 2.2)

    def test_its_length_is_reported_and_nonsense_is_refused(self):
        self.clip(seconds=2.0)
        report = self.report("render", "clip.json", "-o", "part.wav", "--from", "0.5", "--to", "1.25")["files"][0]
        self.assertAlmostEqual(report["duration"], 0.75, places=4)
        self.assertEqual(report["clippedSamples"], 0)
        os.remove(self.folder / "part.wav")
        self.fails(2, ["render", "clip.json", "--from", "1", "--to", "1"], "--from must be before --to")
        self.fails(2, ["render", "clip.json", "--from", "-1"], "--from: '-1' is not a number from 0 to 86400 s")
        self.fails(2, ["render", "clip.json", "--to", "nan"], "--to: 'nan' is not a number")
        self.fails(1, ["render", "clip.json", "--from", "9"], "clip.json: has nothing from 9 s on; it lasts 2.")
        self.assertEqual(self.names(), ["clip.json"])


if __name__ == "__main__":
    unittest.main()
