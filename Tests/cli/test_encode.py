"""End to end: pacini encode."""
import json
import os
import re
import shutil
import struct
import unittest

from command import SOURCE, CommandTest, noise, sine, wav

DEMO = SOURCE / "Resources/demo"


class Encode(CommandTest):
    def test_a_file_becomes_a_clip_beside_it(self):
        self.put("door.wav", wav(sine(100, 0.5)))
        text = self.succeeds("encode", "door.wav")
        self.assertEqual(self.names(), ["door.json", "door.wav"])
        self.assertRegex(text, r"^wrote door\.json: [\d.]+ k?B\n1 encoded: 0\.50 s of sound in [\d.]+ k?B, \d+ B/s, \d+ times real time\n$")
        clip = json.loads((self.folder / "door.json").read_text())
        self.assertEqual((clip["format"], clip["version"], clip["name"]), ("pacini.clip", 1, "door"))
        self.assertEqual(clip["duration"], 0.5)
        self.assertEqual(clip["source"], {"file": "door.wav", "sampleRate": 48000, "channels": 1})

    def test_the_output_may_be_named_and_its_extension_chooses_the_format(self):
        self.put("door.wav", wav(sine(100, 0.5)))
        self.succeeds("encode", "door.wav", "-o", "a.pacb")
        self.succeeds("encode", "door.wav", "--output=b.json")
        self.succeeds("encode", "door.wav", "-o", "c.bin", "--format", "packed")
        self.assertEqual((self.folder / "a.pacb").read_bytes()[:4], b"PACB")
        self.assertEqual((self.folder / "b.json").read_bytes()[:1], b"{")
        self.assertEqual((self.folder / "c.bin").read_bytes(), (self.folder / "a.pacb").read_bytes())

    def test_a_folder_is_encoded_with_all_below_it(self):
        self.put("in/a.wav", wav(sine(100, 0.2)))
        self.put("in/deep/b.WAV", wav(sine(150, 0.2)))
        self.put("in/.hidden.wav", b"passed over")
        self.put("in/.folder/c.wav", b"passed over")
        self.put("in/notes.txt", b"passed over")
        report = self.report("encode", "in", "-o", "out/", "--format", "packed")
        self.assertEqual([file["output"] for file in report["files"]], ["out/a.pacb", "out/deep/b.pacb"])
        self.assertTrue((self.folder / "out/deep/b.pacb").exists())

    def test_a_link_in_a_folder_is_encoded_where_it_stands(self):
        self.put("elsewhere/long.wav", wav(sine(100, 0.2)))
        (self.folder / "in").mkdir()
        (self.folder / "in/link.wav").symlink_to(self.folder / "elsewhere/long.wav")
        for folder, out in (("in", "out"), ("./in/", "out2")):
            self.succeeds("encode", folder, "-o", out, "--format", "packed")
            self.assertEqual([path.name for path in (self.folder / out).iterdir()], ["link.pacb"])
        self.assertEqual([path.name for path in (self.folder / "elsewhere").iterdir()], ["long.wav"])

    def test_nothing_readable_of_a_folder_is_passed_over(self):
        names = [f"{i}{extension}" for i, extension in enumerate((
            ".wav", ".voc", ".mts", ".mpeg", ".vob", ".mp2", ".m4b", ".adts", ".ismv", ".NIST", ".avr",
            ".8svx"))]
        for name in names:
            self.put(f"in/{name}", wav(sine(100, 0.2)))  # found by their names, read by what they are
        found = self.report("encode", "in", "-o", "out")["files"]
        self.assertEqual(sorted(os.path.basename(file["input"]) for file in found), sorted(names))
        self.put("code/main.ts", b"export const strength = 0.4;\n")
        self.put("code/a.wav", wav(sine(100, 0.2)))
        self.assertEqual(len(self.report("encode", "code", "-o", "out2")["files"]), 1)
        (self.folder / "in/gone.wav").symlink_to(self.folder / "elsewhere/gone.wav")
        (self.folder / "in/gone.txt").symlink_to(self.folder / "elsewhere/gone.txt")
        self.fails(1, ["encode", "in", "-o", "out", "-y", "-q"],
                   "pacini: in/gone.wav: is a link to a file that is not there")

    def test_several_files_go_into_a_folder_that_is_made(self):
        for name in ("a.wav", "b.wav"):
            self.put(name, wav(sine(100, 0.2)))
        self.succeeds("encode", "a.wav", "b.wav", "-o", "made/for/it")
        self.assertEqual(self.names(), ["a.wav", "b.wav", "made/for/it/a.json", "made/for/it/b.json"])

    def test_less_of_speech_makes_speech_weaker_and_leaves_a_tone_as_it_is(self):
        self.put("spoken.wav", (SOURCE / "Tests/analysis/spoken_sentence.wav").read_bytes())
        self.put("tone.wav", wav(sine(100, 1.0)))
        for sound, check in (("spoken", lambda with_it, without: self.assertLess(without, 0.5 * with_it)),
                             ("tone", lambda with_it, without: self.assertEqual(without, with_it))):
            sums = []
            for name, options in (("with", ()), ("without", ("--preset", "voice-off")), ("same", ("--speech", "0"))):
                self.succeeds("encode", f"{sound}.wav", "-o", f"{sound}-{name}.json", *options)
                clip = json.loads((self.folder / f"{sound}-{name}.json").read_text())
                sums.append(sum(point["amplitude"] ** 2 for band in clip["bands"] for point in band["amplitude"]))
            check(sums[0], sums[1])
            self.assertEqual(sums[1], sums[2])
        self.fails(2, ("encode", "tone.wav", "--speech", "2", "-o", "no.json"), "--speech")

    def test_the_demo_sounds_encode_and_the_number_of_jobs_does_not_matter(self):
        for jobs in ("1", "3"):
            self.succeeds("encode", str(DEMO), "-o", jobs, "--format", "packed", "-j", jobs)
        sounds = sorted(path.stem for path in DEMO.glob("*.flac"))
        self.assertGreater(len(sounds), 4)
        for sound in sounds:
            one, three = ((self.folder / jobs / (sound + ".pacb")).read_bytes() for jobs in ("1", "3"))
            self.assertEqual(one, three, sound)

    def test_the_report_has_the_promised_fields(self):
        self.put("a.wav", wav(sine(100, 0.5)))
        report = self.report("encode", "a.wav", "-o", "a.pacb")
        self.assertEqual(report["failures"], [])
        file, = report["files"]
        self.assertEqual((file["input"], file["output"], file["duration"]), ("a.wav", "a.pacb", 0.5))
        self.assertEqual(file["bytes"], (self.folder / "a.pacb").stat().st_size)
        self.assertGreater(file["seconds"], 0)
        self.assertAlmostEqual(file["timesRealTime"], file["duration"] / file["seconds"], delta=1e-6 * file["timesRealTime"])

    def test_what_is_up_to_date_is_passed_over_until_forced_or_changed(self):
        source = self.put("a.wav", wav(sine(100, 0.2)))
        fresh = lambda *more: self.report("encode", "a.wav", *more)["files"][0]["upToDate"]
        self.assertFalse(fresh())
        self.assertTrue(fresh())
        self.assertIn("0 encoded, 1 up to date", self.succeeds("encode", "a.wav"))
        self.assertFalse(fresh("--force"))
        self.assertTrue(fresh())
        self.assertFalse(fresh("--bands", "3"))
        self.assertTrue(fresh("--bands", "3"))
        self.assertFalse(fresh("--bands", "3", "-o", "a.json", "--format", "packed"))
        self.assertFalse(fresh("--bands", "3"))
        later = (self.folder / "a.json").stat().st_mtime + 10
        os.utime(source, (later, later))
        self.assertFalse(fresh("--bands", "3"))
        self.put("a.json", b"{ damaged")
        self.fails(1, ["encode", "a.wav"], "a.wav: a.json: exists and is not a clip", "-y replaces it")
        self.assertFalse(fresh("-y"))

    def test_a_bad_file_does_not_stop_the_others_and_every_failure_is_listed(self):
        for name in ("a.wav", "c.wav"):
            self.put(name, wav(sine(100, 0.2)))
        self.put("b.wav", b"")
        self.put("d.wav", b"no sound at all")
        done = self.fails(1, ["encode", "a.wav", "b.wav", "c.wav", "d.wav", "missing.wav", "--json"],
                          "pacini: b.wav: ", "pacini: d.wav: ", "pacini: missing.wav: does not exist", lines=3)
        report = json.loads(done.stdout)
        self.assertEqual([file["input"] for file in report["files"]], ["a.wav", "c.wav"])
        self.assertEqual([failure["input"] for failure in report["failures"]], ["b.wav", "d.wav", "missing.wav"])
        self.assertTrue(all(failure["message"] for failure in report["failures"]))
        self.assertTrue((self.folder / "c.json").exists())
        done = self.run_command("encode", "a.wav", "b.wav", "c.wav", "--force")
        self.assertTrue(done.stdout.decode().splitlines()[-1].startswith("2 encoded, 1 failed: "), done.stdout)

    def test_quiet_leaves_only_results_and_errors(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.assertEqual(self.succeeds("encode", "a.wav", "--quiet"), "")
        self.assertEqual(self.succeeds("-q", "encode", "a.wav"), "")
        self.assertEqual(len(self.report("encode", "a.wav", "-q")["files"]), 1)
        self.fails(1, ["encode", "missing.wav", "-q"], "missing.wav: does not exist")

    def test_one_result_for_two_inputs_is_an_error_however_they_are_spelled(self):
        self.put("door.wav", wav(sine(100, 0.2)))
        shutil.copy(DEMO / "knock_wood_bridge.flac", self.folder / "door.flac")
        for second in ("door.flac", "./door.flac", str(self.folder / "door.flac")):
            done = self.fails(1, ["encode", "door.wav", second, "--force", "--json"], "door.flac: would be written to",
                              "rename one of them")
            self.assertEqual([file["input"] for file in json.loads(done.stdout)["files"]], ["door.wav"])
            self.assertEqual(json.loads((self.folder / "door.json").read_text())["source"]["file"], "door.wav")
        self.fails(1, ["encode", "door.wav", "door.flac", "-o", "out"], "would be written to")

    def test_a_file_named_twice_is_encoded_once(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        for again in ("a.wav", "./a.wav", "."):
            self.assertEqual(len(self.report("encode", "a.wav", again)["files"]), 1, again)

    def test_limits_that_leave_nothing_are_refused_at_every_door(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        both = {"lowLimit": 500, "highLimit": 100}
        says = "must be below the high limit, or nothing is left"
        for method in ("thesis", "envelope-sine", "vocoder16"):
            self.fails(2, ["encode", "a.wav", "--method", method, "--low-limit", "500", "--high-limit", "100"],
                       "--low-limit: " + says)
        self.put("own.json", json.dumps({"format": "pacini.settings", "version": 1,
                                         "encode": {"method": "thesis", **both}}))
        self.assertIn(says, self.run_command("encode", "a.wav", "--settings", "own.json").stderr.decode())
        self.assertEqual(self.names(), ["a.wav", "own.json"])
        self.succeeds("encode", "a.wav", "--method", "thesis", "--low-limit", "100", "--high-limit", "500")

    def test_a_sound_is_never_overwritten_by_its_clip(self):
        content = wav(sine(100, 0.2))
        self.put("a.wav", content)
        os.symlink("a.wav", self.folder / "link.wav")
        for output in ("a.wav", "./a.wav", "link.wav"):
            self.fails(2, ["encode", "a.wav", "-o", output], "has the extension of a sound")
            self.fails(1, ["encode", "a.wav", "-o", output, "--format", "json"], "is also the input; choose another output with -o")
        self.assertEqual((self.folder / "a.wav").read_bytes(), content)

    def test_opposite_channels_do_not_cancel(self):
        mono = [a + b for a, b in zip(sine(90, 1.0, level=0.3), noise(48000, level=0.05))]
        self.put("mono.wav", wav(mono))
        self.put("anti.wav", wav([x for m in mono for x in (m, -m)], channels=2))
        clips = []
        for name in ("mono", "anti"):
            self.succeeds("encode", name + ".wav", "--keep-level")
            clips.append(json.loads((self.folder / (name + ".json")).read_text()))
        peaks = [max(point["amplitude"] for point in clip["envelope"]) for clip in clips]
        self.assertLess(max(peaks) / min(peaks), 10 ** (1 / 20))
        for one, other in zip(clips[0]["bands"], clips[1]["bands"]):
            level = [max((point["amplitude"] for point in band["amplitude"]), default=0) for band in (one, other)]
            if min(level) > 0.01:
                self.assertLess(max(level) / min(level), 10 ** (1 / 20), one["centreFrequency"])

    def test_wrong_options_are_usage_errors_that_name_the_range(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        for option, value, says in (("--bands", "0", "1 to 32"), ("--bands", "33", "1 to 32"),
                                    ("--bands", "six", "1 to 32"), ("--breakpoints", "nan", "0.5 to 1000"),
                                    ("--breakpoints", "0", "0.5 to 1000"), ("--quantise", "3", "4 to 16"),
                                    ("--low", "0", "1 to 1700"), ("--high", "1e9", "2 to 1800"),
                                    ("-j", "0", "1 to 256"), ("-j", "-1", "1 to 256"), ("--format", "midi", "json"),
                                    ("--spacing", "bark", "linear")):
            self.fails(2, ["encode", "a.wav", option, value], says, "pacini encode --help")
        self.fails(2, ["encode", "a.wav", "--low", "500", "--high", "100"], "--low: must be lower than high")
        self.assertEqual(self.names(), ["a.wav"])

    def test_a_clip_from_before_the_effects_channel_counted_more_is_made_anew_once(self):
        """As versions without it did, the first clip is made of a sound that does not name its channels."""
        samples = [x for value in sine(60, 0.5) for x in (0.0, value * 0.5, value)]
        plain = wav(samples, channels=3)
        head, data = plain[:plain.index(b"data")], plain[plain.index(b"data"):]
        rate, = struct.unpack("<I", head[24:28])
        extensible = struct.pack("<HHIIHHHHIH14s", 0xFFFE, 3, rate, rate * 6, 6, 16, 22, 16, 0xB, 1,
                                 bytes.fromhex("000000001000800000aa00389b71"))
        named = b"RIFF" + struct.pack("<I", 20 + len(extensible) + len(data)) + b"WAVEfmt " + \
            struct.pack("<I", len(extensible)) + extensible + data
        self.put("film.wav", plain)
        os.utime(self.folder / "film.wav", (1, 1))
        self.succeeds("encode", "film.wav", "--keep-level")
        old = json.loads((self.folder / "film.json").read_text())
        self.assertNotIn("lowFrequencyEffects", old["encoder"])
        self.assertIn("1 up to date", self.succeeds("encode", "film.wav", "--keep-level"))
        self.put("film.wav", named)
        os.utime(self.folder / "film.wav", (1, 1))
        self.assertIn("1 encoded", self.succeeds("encode", "film.wav", "--keep-level"))
        new = json.loads((self.folder / "film.json").read_text())
        self.assertEqual(new["encoder"]["lowFrequencyEffects"], 10)
        self.assertGreater(max(point["amplitude"] for point in new["envelope"]),
                           1.4 * max(point["amplitude"] for point in old["envelope"]))
        self.assertIn("1 up to date", self.succeeds("encode", "film.wav", "--keep-level"))


class CommandLine(CommandTest):
    def test_every_command_has_help_with_its_options(self):
        text = self.succeeds("--help")
        commands = re.findall(r"^  ([a-z]+)  ", text.split("Commands:")[1].split("\n\n")[0], re.M)
        self.assertTrue({"encode", "render", "info", "convert"} <= set(commands), commands)
        for command in commands:
            text = self.succeeds(command, "--help")
            self.assertIn("--help", text)
            self.assertIn("--quiet", text)
            self.assertNotIn("\x1b", text)

    def test_the_version_is_told_and_the_commit(self):
        [version] = re.findall(r"project\(Pacini VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())
        known = (SOURCE / ".git").exists() or "Format" not in (SOURCE / "cmake/commit.txt").read_text()
        commit = r" \(commit [0-9a-f]{12}(, changed)?\)" if known else ""
        self.assertRegex(self.succeeds("--version"), rf"^pacini {re.escape(version)}{commit}\n$")

    def test_wrong_usage_is_one_line_that_says_where_to_read_on(self):
        self.fails(2, [], "a command is missing", "encode, render, info, convert", "pacini --help")
        self.fails(2, ["frobnicate"], "unknown command 'frobnicate'", "encode, render, info, convert")
        self.fails(2, ["--frobnicate"], "pacini --help")
        for command in ("encode", "render", "info", "convert"):
            self.fails(2, [command], command + ": the input file is missing", f"pacini {command} --help")
        for command in ("encode", "render", "info", "convert"):
            self.fails(2, [command, "x", "y", "--frobnicate"], "--frobnicate", f"pacini {command} --help")


if __name__ == "__main__":
    unittest.main()
