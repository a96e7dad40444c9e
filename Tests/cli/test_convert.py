"""End to end: pacini convert between formats, in folders and again, and encode and info for formats of others."""
import hashlib
import json
import os
import struct
import unittest

from command import SOURCE, CommandTest, noise, read_float_wav, sine, wav

HAPTIC = {"version": {"major": 1, "minor": 0, "patch": 0}, "signals": {"continuous": {"envelopes": {
    "amplitude": [{"time": 0, "amplitude": 0.2, "emphasis": {"amplitude": 0.5, "frequency": 0.4}},
                  {"time": 0.5, "amplitude": 0.8}, {"time": 1.25, "amplitude": 0, "emphasis": {"amplitude": 1, "frequency": 0.6}}],
    "frequency": [{"time": 0, "frequency": 0.25}, {"time": 1.25, "frequency": 0.75}]}}}}


def envelopes(path):
    return json.loads(path.read_text())["signals"]["continuous"]["envelopes"]


class Convert(CommandTest):
    def test_a_clip_becomes_haptic_and_comes_back(self):
        self.clip()
        self.succeeds("convert", "clip.json", "clip.haptic")
        points = envelopes(self.folder / "clip.haptic")["amplitude"]
        self.assertEqual(points[0]["time"], 0)
        self.assertEqual(points[-1]["time"], 1)
        self.succeeds("convert", "clip.haptic", "back.json")
        back = json.loads((self.folder / "back.json").read_text())
        self.assertEqual((back["format"], back["duration"], len(back["bands"])), ("pacini.clip", 1, 1))

    def test_one_format_of_others_becomes_another_and_keeps_its_events(self):
        self.put("a.haptic", json.dumps(HAPTIC))
        self.succeeds("convert", "a.haptic", "a.ahap")
        pattern = json.loads((self.folder / "a.ahap").read_text())["Pattern"]
        kinds = [entry["Event"]["EventType"] for entry in pattern if "Event" in entry]
        self.assertEqual(kinds.count("HapticTransient"), 2)
        self.succeeds("convert", "a.ahap", "-o", "b.haptic")
        points = envelopes(self.folder / "b.haptic")["amplitude"]
        self.assertEqual(sum("emphasis" in point for point in points), 2)

    def test_a_split_pair_is_read_as_one_clip(self):
        self.put("a.haptic", json.dumps(HAPTIC))
        report = self.report("convert", "a.haptic", "a.ahap", "--split")
        self.assertEqual([output["file"] for output in report["outputs"]], ["a.ahap", "a-transients.ahap"])
        self.succeeds("convert", "a.ahap", "b.haptic")
        self.assertEqual(sum("emphasis" in p for p in envelopes(self.folder / "b.haptic")["amplitude"]), 2)
        # In a folder the second file is no clip of its own.
        self.put("in/a.ahap", (self.folder / "a.ahap").read_bytes())
        self.put("in/a-transients.ahap", (self.folder / "a-transients.ahap").read_bytes())
        report = self.report("convert", "in", "out", "--format", "haptic")
        self.assertEqual(len(report["files"]), 1)

    def test_a_split_leaves_out_what_is_empty_and_tells_of_a_file_that_is_left(self):
        self.clip(envelope=[{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5}], transients=[])
        report = self.report("convert", "clip.json", "a.ahap", "--split")
        self.assertEqual([output["file"] for output in report["outputs"]], ["a.ahap"])
        self.put("a.haptic", json.dumps(HAPTIC))
        self.succeeds("convert", "a.haptic", "a.ahap", "--split", "-y")
        kept = (self.folder / "a-transients.ahap").read_bytes()
        done = self.run_command("convert", "clip.json", "a.ahap", "--split", "-y")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: a-transients.ahap: exists already", done.stderr.decode())
        self.assertEqual((self.folder / "a-transients.ahap").read_bytes(), kept)

    def test_events_alone_are_one_file(self):
        self.clip(envelope=[], bands=[], transients=[{"time": 0.5, "amplitude": 0.8, "sharpness": 0.5}])
        report = self.report("convert", "clip.json", "a.ahap", "--split")
        self.assertEqual([output["file"] for output in report["outputs"]], ["a.ahap"])
        self.assertIn("HapticTransient", (self.folder / "a.ahap").read_text())

    def test_points_and_profiles_change_what_is_written(self):
        points = [{"time": i / 1000, "amplitude": (i * 7919 % 1000) / 1000} for i in range(1001)]
        self.clip(envelope=points)
        self.succeeds("convert", "clip.json", "few.haptic", "--points", "10")
        self.succeeds("convert", "clip.json", "usual.haptic")
        few, usual = (len(envelopes(self.folder / name)["amplitude"]) for name in ("few.haptic", "usual.haptic"))
        self.assertLessEqual(few, 11)
        self.assertGreater(usual, 30)
        self.succeeds("convert", "clip.json", "other.haptic", "--profile", "l5-wristband")
        self.assertNotEqual(envelopes(self.folder / "other.haptic")["frequency"],
                            envelopes(self.folder / "usual.haptic")["frequency"])

    def test_quick_hjif_is_another_file_and_recorded_as_such(self):
        wave = [{"time": i / 50, "amplitude": 0.4 + 0.3 * (i * 7 % 5) / 5} for i in range(51)]
        bands = [{"lowFrequency": 0.8 * f, "centreFrequency": f, "highFrequency": 1.2 * f, "amplitude": wave,
                  "pitch": [{"time": 0, "frequency": f}]} for f in (60, 90, 130, 180, 250, 350)]
        self.clip("in/clip.json", envelope=wave, bands=bands)
        arguments = ["convert", "in", "out", "--format", "hjif"]
        searched = self.report(*arguments)["files"][0]
        quick = self.report(*arguments, "--quick")["files"][0]
        self.assertFalse(quick["upToDate"])
        self.assertNotEqual(quick["outputs"], searched["outputs"])
        self.assertTrue(self.report(*arguments, "--quick")["files"][0]["upToDate"])
        self.assertGreater(self.report("info", "out/clip.hjif")["duration"], 0.9)

    def test_a_folder_is_converted_once_and_recorded(self):
        for name in ("a", "b", "sub/c"):
            self.put(f"in/{name}.haptic", json.dumps(HAPTIC))
        self.clip("in/d.json")
        self.put("in/bad.haptic", "{}")
        arguments = ["convert", "in", "out", "--format", "ahap", "-j", "2"]
        self.fails(1, arguments, "bad.haptic: version: is missing")
        manifest = (self.folder / "out/pacini.manifest.json").read_bytes()
        files = {entry["input"]: entry for entry in json.loads(manifest)["files"]}
        self.assertEqual(sorted(files), ["a.haptic", "b.haptic", "bad.haptic", "d.json", "sub/c.haptic"])
        self.assertIn("version: is missing", files["bad.haptic"]["error"])
        for name, entry in files.items():
            for output in entry["outputs"]:
                content = (self.folder / "out" / output["file"]).read_bytes()
                self.assertEqual((len(content), hashlib.sha256(content).hexdigest()),
                                 (output["bytes"], output["sha256"]))
        self.assertEqual(files["sub/c.haptic"]["outputs"][0]["file"], "sub/c.ahap")

        os.remove(self.folder / "in/bad.haptic")
        os.remove(self.folder / "out/b.ahap")
        self.put("in/a.haptic", json.dumps(HAPTIC | {"metadata": {"project": "new"}}))
        done = {f["input"]: f["upToDate"] for f in self.report(*arguments)["files"]}
        self.assertEqual(done, {"in/a.haptic": False, "in/b.haptic": False, "in/d.json": True,
                                "in/sub/c.haptic": True})
        self.assertTrue(all(f["upToDate"] for f in self.report(*arguments)["files"]))
        self.assertFalse(any(f["upToDate"] for f in self.report(*arguments, "--split")["files"]))
        self.assertFalse(any(f["upToDate"] for f in self.report(*arguments, "--split", "--force")["files"]))

    def test_a_run_that_was_killed_is_taken_up_where_it_was(self):
        for i in range(200):
            self.clip(f"in/{i:03}.json", seconds=20)
        arguments = ["convert", "in", "out", "--format", "haptic", "-j", "1"]
        manifest = self.folder / "out/pacini.manifest.json"
        # Each file has an entry before the run begins, and one with its output when it is done.
        process = self.started(
            *arguments, until=lambda: manifest.exists() and manifest.read_bytes().count(b'"file"') >= 20)
        process.kill()
        process.communicate()
        with open(manifest, "ab") as file:
            file.write(b'{"input": "torn')
        done = [f["upToDate"] for f in self.report(*arguments)["files"]]
        self.assertEqual(len(done), 200)
        self.assertGreater(sum(done), 15)
        self.assertLess(sum(done), 200)
        self.assertEqual(len(json.loads(manifest.read_bytes())["files"]), 200)
        self.assertTrue(all(f["upToDate"] for f in self.report(*arguments)["files"]))

    def test_the_record_of_a_folder_is_no_clip_of_it(self):
        self.clip("in/a.json")
        self.succeeds("convert", "in", "out", "--format", "json")
        self.assertIn("out/pacini.manifest.json", self.names())
        self.assertEqual(len(self.report("render", "out")["files"]), 1)
        self.assertEqual(len(self.report("convert", "out", "again", "--format", "packed")["files"]), 1)

    def test_the_record_of_a_folder_keeps_what_other_runs_made(self):
        for name in "ab":
            self.clip(f"{name}.json")
            self.succeeds("convert", f"{name}.json", "-o", "out/", "--format", "haptic")
        self.assertEqual(len(json.loads((self.folder / "out/pacini.manifest.json").read_bytes())["files"]), 2)
        self.clip("a.json", seconds=2)
        self.succeeds("convert", "a.json", "-o", "out/", "--format", "haptic")

    def test_the_same_folder_gives_the_same_bytes(self):
        for name in ("a", "bb", "ccc"):
            self.clip(f"in/{name}.json", seconds=1 + len(name))
        for out, jobs in (("one", "1"), ("two", "3")):
            self.succeeds("convert", "in", out, "--format", "ahap", "-j", jobs)
        for name in ("a.ahap", "bb.ahap", "ccc.ahap", "pacini.manifest.json"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes())

    def test_wrong_usage_is_said(self):
        self.clip()
        self.put("in/clip.json", (self.folder / "clip.json").read_bytes())
        self.fails(2, ["convert", "in", "out"], "--format")
        self.fails(2, ["convert", "clip.json", "x.haptic", "--quantise", "8"], "--quantise")
        self.fails(2, ["convert", "clip.json", "x.pacb", "--points", "8"], "--points")
        self.fails(2, ["convert", "clip.json", "x.haptic", "--format", "nothing"], "--format")
        for name, option, value, instead in (("x.tact", "--events", "merged", "haptic, ahap, hjif"),
                                             ("x.hjif", "--profile", "lra-175", "haptic, ahap, haps"),
                                             ("x.haptic", "--sample-rate", "4000", "wav8"),
                                             ("x.csv", "--points", "8", "android-xml"),
                                             ("x.haptic", "--split", None, "one of ahap, android-xml"),
                                             ("x.ahap", "--quick", None, "one of hjif")):
            self.fails(2, ["convert", "clip.json", name, option] + ([value] if value else []),
                       f"pacini: {option}: has no effect in {name[2:]}", instead)
        self.fails(2, ["convert", "clip.json", "x.haptic", "--profile", "lra-175", "--strength", "0"],
                   "--strength: has no effect in haptic")
        self.fails(2, ["convert", "clip.json", "x.wav", "--strength", "0"], "--strength needs --profile")

    def test_strength_is_that_of_render_and_recorded(self):
        self.succeeds("encode", str(SOURCE / "Resources/demo/iter_drum_roll.flac"), "-o", "in/", "--format", "json")
        (self.folder / "in/iter_drum_roll.json").rename(self.folder / "in/roll.json")
        written = {}
        for options in ([], ["--strength", "0"], ["--strength", "0.4"], ["--strength", "1"]):
            self.succeeds("convert", "in", "out", "--format", "wav16", "--profile", "lra-175", *options)  # made anew
            written["".join(options[1:])] = (self.folder / "out/roll.wav").read_bytes()
            self.succeeds("render", "in/roll.json", "-o", "own.wav", "--rate", "8000", "--profile", "lra-175", *options, "-f")
            _, own = read_float_wav(self.folder / "own.wav")
            samples = struct.unpack(f"<{len(own)}h", written["".join(options[1:])][44:44 + 2 * len(own)])
            self.assertLess(max(abs(a - 32768 * b) for a, b in zip(samples, own)), 1.01, options)
        self.assertEqual(written[""], written["0.4"])  # the default
        self.assertEqual(len(set(written.values())), 3)
        drum = str(SOURCE / "Resources/demo/iter_drum_roll.flac")
        self.succeeds("encode", drum, "-o", "straight.wav", "--format", "wav16", "--profile", "lra-175", "--strength", "1")
        self.assertEqual((self.folder / "straight.wav").read_bytes(), written["1"])
        lost = [self.report("lint", "in/roll.json", "--target", "wav16", "--profile", "lra-175", "--strength", strength)
                for strength in ("0", "1")]
        self.assertTrue(all(report["files"][0]["ok"] for report in lost))

    def test_bad_files_of_others_say_where(self):
        broken = json.loads(json.dumps(HAPTIC))
        broken["signals"]["continuous"]["envelopes"]["amplitude"][1]["amplitude"] = 2
        for name, content, says in (
                ("a.haptic", json.dumps(broken), "signals.continuous.envelopes.amplitude[1].amplitude: is outside"),
                ("b.haptic", "\ufeff{" + json.dumps(HAPTIC), "line 1, column 2"),
                ("c.haptic", json.dumps(HAPTIC).encode("utf-16"), "UTF-16"),
                ("d.ahap", '{"Pattern": [{"Event": {"Time": -1, "EventType": "HapticTransient"}}]}',
                 "Pattern[0].Event.Time: is before 0"),
                ("e.ahap", "", "is empty")):
            self.put(name, content)
            self.fails(1, ["convert", name, "out.json"], f"pacini: {name}: ", says)
            self.fails(1, ["info", name], f"pacini: {name}: ")

    def test_several_files_do_not_go_to_standard_output(self):
        self.clip("hit.json", transients=[{"time": 0.25, "amplitude": 1, "sharpness": 0.5}])
        self.put("knock.wav", wav([0.0] * 4800 + [(1 - i / 480) * x for i, x in enumerate(noise(480, level=0.9))]
                                  + [0.0] * 19200))
        before = self.names()
        for arguments in (["convert", "hit.json", "-o", "-", "--format", "ahap"],
                          ["convert", "hit.json", "-o", "/dev/stdout", "--format", "ahap"],
                          ["convert", "hit.json", "-o", "-", "--format", "android-xml"],
                          ["encode", "knock.wav", "-o", "-", "--format", "ahap", "--audible", "0", "-q"]):
            with self.subTest(arguments=arguments):
                done = self.fails(1, [*arguments, "--split"], ": takes one file, but this clip becomes ",
                                  "; name a file with -o, or leave out --split")
                self.assertEqual(done.stdout, b"")
        self.assertEqual(self.names(), before)
        self.assertEqual(json.loads(self.succeeds("convert", "hit.json", "-o", "-", "--format", "haptic"))["version"]["major"], 1)

    def test_a_sound_goes_straight_to_a_format_of_others(self):
        self.put("tone.wav", wav(sine(120, 1.0)))
        self.succeeds("encode", "tone.wav", "-o", "tone.haptic")
        self.assertGreaterEqual(len(envelopes(self.folder / "tone.haptic")["amplitude"]), 2)
        report = self.report("encode", "tone.wav", "--format", "ahap", "--split")
        self.assertEqual(report["files"][0]["output"], "tone.ahap")
        self.assertIn("tone-transients.ahap", self.names())  # that it begins is an event
        self.put("knock.wav", wav([0.0] * 4800 + [(1 - i / 480) * x for i, x in enumerate(noise(480, level=0.9))]
                                  + [0.0] * 19200))
        # Driven by loudness, its voice would reach this one too.
        self.succeeds("encode", "knock.wav", "--format", "ahap", "--split", "--audible", "0")
        self.assertIn("knock-transients.ahap", self.names())
        self.fails(2, ["encode", "tone.wav", "-o", "x.json", "--points", "5"], "--points")

    def test_info_reads_formats_of_others(self):
        self.put("a.haptic", json.dumps(HAPTIC))
        report = self.report("info", "a.haptic")
        self.assertEqual((report["kind"], report["format"], report["transients"]), ("clip", "haptic", 2))
        # The file ends at 1.25 s with an emphasis, which then sounds for 2 periods of 100 * 2.8^0.6 Hz.
        self.assertAlmostEqual(report["duration"], 1.25 + 2 / (100 * 2.8 ** 0.6), delta=1e-4)
        self.assertIn("Haptics Studio", self.succeeds("info", "a.haptic"))


if __name__ == "__main__":
    unittest.main()
