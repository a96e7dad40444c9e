"""End to end: no command writes over a file that it was not told to by name, unless Pacini made it from the same input."""
import json
import os
import unittest

from command import SOURCE, CommandTest, noise, sine, wav


class Overwrite(CommandTest):
    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def keeps(self, name, arguments, *says, code=1):
        """Fails with one line that says how to go on; the file stays to the byte, and with -y the command works."""
        before = self.bytes_of(name)
        done = self.fails(code, arguments, *says, "-y replaces it")
        self.assertEqual(self.bytes_of(name), before)
        return done

    def edit(self, name):
        """As a person does: one event more, and the file written anew by another program."""
        clip = json.loads((self.folder / name).read_text())
        clip["transients"] = [{"time": 0.01, "amplitude": 0.5, "sharpness": 0.5}]
        self.put(name, json.dumps(clip, indent=4))


class Recordings(Overwrite):
    def test_a_recording_survives_encoding_and_rendering_beside_it(self):
        recording = self.put("bell.wav", wav(sine(100, 0.3))).read_bytes()
        self.succeeds("encode", "bell.wav")
        self.succeeds("render", "bell.json")
        self.assertEqual(self.bytes_of("bell.wav"), recording)
        self.assertEqual(self.names(), ["bell.haptic.wav", "bell.json", "bell.wav"])

    def test_what_is_no_sound_is_said_to_be_none_with_and_without_an_output(self):
        self.put("bell.wav", wav(sine(100, 0.3)))
        self.succeeds("encode", "bell.wav", "-o", "clip.json")
        self.put("empty.json", "")
        self.put("x.texture.json", json.dumps({"format": "pacini.texture", "version": 1}))
        for name in ("clip.json", "empty.json", "x.texture.json"):
            said = self.fails(1, ["encode", name, "-o", "out.json"]).stderr
            self.assertEqual(self.fails(1, ["encode", name]).stderr, said)
            self.assertNotIn(b"also the input", said)
        self.fails(1, ["encode", "bell.wav", "-o", "bell.wav", "--format", "json"],
                   "bell.wav: is also the input; choose another output with -o")

    def test_whole_trees_of_recordings_survive(self):
        names = ["s/a.wav", "s/deep/b.wav", "s/deep/c.wav"]
        for i, name in enumerate(names):
            self.put(name, wav(sine(80 + 20 * i, 0.2)))
        before = {name: self.bytes_of(name) for name in names}
        for _ in range(2):  # what was rendered is no recording the next time
            self.succeeds("encode", "s")
            self.succeeds("render", "s")
        self.succeeds("render", "s", "-o", "s")
        self.assertEqual({name: self.bytes_of(name) for name in names}, before)
        self.assertEqual(len(self.names()), 9, self.names())

    def test_a_folder_of_recordings_as_output_is_no_leave_to_replace_them(self):
        self.put("sounds/a.wav", wav(sine(100, 0.2)))
        self.succeeds("encode", "sounds", "-o", "clips")
        self.keeps("sounds/a.wav", ["render", "clips", "-o", "sounds"], "clips/a.json: sounds/a.wav: exists")
        self.keeps("sounds/a.wav", ["render", "clips/a.json", "-o", "sounds/"], "exists")
        self.succeeds("render", "clips", "-o", "sounds", "-y")

    def test_a_named_file_is_replaced_but_never_an_input(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        other = self.put("other.wav", wav(sine(200, 0.2))).read_bytes()
        self.succeeds("encode", "a.wav")
        self.succeeds("render", "a.json", "-o", "other.wav")
        self.assertNotEqual(self.bytes_of("other.wav"), other)
        clip = self.bytes_of("a.json")
        os.symlink("a.json", self.folder / "link.json")
        (self.folder / "sub").mkdir()
        for name in ("a.json", "./a.json", str(self.folder / "a.json"), "sub/../a.json", "link.json"):
            for more in ([], ["-y"]):
                self.fails(1, ["convert", "a.json", "-o", name, "--format", "packed", *more], "is also the input")
                self.assertEqual(self.bytes_of("a.json"), clip)
        self.succeeds("convert", "a.json", "a.pacb")
        self.fails(1, ["convert", "a.json", "a.pacb", "-o", ".", "--format", "packed", "-y"],
                   "would overwrite a.pacb, which is an input too", lines=2)

    def test_the_recording_of_a_clip_is_kept_although_named(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.succeeds("encode", "a.wav")
        self.keeps("a.wav", ["render", "a.json", "-o", "a.wav"], "is the recording of this clip")
        self.keeps("a.wav", ["render", str(self.folder / "a.json"), "-o", "./a.wav"], "is the recording")
        (self.folder / "drives").mkdir()
        for _ in range(2):  # of the same name elsewhere it is only a drive signal
            self.succeeds("render", "a.json", "-o", "drives/a.wav")
        self.succeeds("render", "a.json", "-o", "a.wav", "-y")

    def test_a_drive_signal_that_was_worked_on_is_kept(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.succeeds("encode", "a.wav")
        self.succeeds("render", "a.json")
        changed = bytearray(self.bytes_of("a.haptic.wav"))
        changed[-1] ^= 1
        self.put("a.haptic.wav", bytes(changed))
        self.keeps("a.haptic.wav", ["render", "a.json"], "was changed since")
        self.succeeds("render", "a.json", "-y")
        self.assertNotEqual(self.bytes_of("a.haptic.wav"), bytes(changed))

    def test_what_was_made_from_the_same_clip_is_made_anew_and_from_another_is_kept(self):
        self.clip("a.json")
        self.succeeds("render", "a.json")
        first = self.bytes_of("a.haptic.wav")
        self.clip("a.json", seconds=2)
        self.succeeds("render", "a.json")
        self.assertNotEqual(self.bytes_of("a.haptic.wav"), first)
        self.succeeds("convert", "a.json", "a.pacb")
        self.keeps("a.haptic.wav", ["render", "a.pacb"], "was made from a.json")
        for folder in ("one", "two"):
            self.clip(folder + "/a.json")
        self.succeeds("render", "one", "-o", "out")
        self.keeps("out/a.wav", ["render", "two", "-o", "out"], "was made from another a.json")

    def test_what_is_felt_has_a_name_and_a_mark_of_its_own(self):
        self.clip("a.json")
        felt = ["render", "a.json", "--profile", "l5-wristband", "--felt"]
        self.succeeds(*felt)
        self.succeeds(*felt, "--gain", "-3")
        self.assertEqual(self.names(), ["a.felt.wav", "a.json"])
        self.assertIn(b"Made by Pacini from \"a.json\"", self.bytes_of("a.felt.wav")[:4096])

    def test_signals_of_other_methods_keep_to_the_rule(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.put("a.lowpass.wav", wav(sine(300, 0.2)))
        self.keeps("a.lowpass.wav", ["encode", "a.wav", "--method", "lowpass"], "exists")
        for _ in range(2):
            self.succeeds("encode", "a.wav", "--method", "pitch-shift")

    def test_a_link_is_not_followed_to_what_is_not_ours(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.put("precious.json", '{"mine": 1}')
        os.symlink("precious.json", self.folder / "a.json")
        self.keeps("precious.json", ["encode", "a.wav"], "a.json: exists")
        self.assertTrue((self.folder / "a.json").is_symlink())

    def test_a_hard_link_of_a_recording_keeps_it(self):
        recording = self.put("a.wav", wav(sine(100, 0.2))).read_bytes()
        os.link(self.folder / "a.wav", self.folder / "a.haptic.wav")
        self.succeeds("encode", "a.wav")
        self.keeps("a.haptic.wav", ["render", "a.json"], "exists")
        self.succeeds("render", "a.json", "-y")
        self.assertEqual(self.bytes_of("a.wav"), recording)


class EditedClips(Overwrite):
    def setUp(self):
        super().setUp()
        self.put("a.wav", wav([x + y for x, y in zip(sine(100, 0.3), noise(14400, level=0.1))]))

    def test_a_clip_as_it_was_encoded_is_encoded_anew(self):
        for name in ("a.json", "a.pacb"):
            self.succeeds("encode", "a.wav", "-o", name)
            self.succeeds("encode", "a.wav", "-o", name, "--bands", "6")
            self.succeeds("encode", "a.wav", "-o", name, "--force")
        self.succeeds("encode", "a.wav", "--bands", "3")
        self.assertEqual(len(json.loads(self.bytes_of("a.json"))["bands"]), 3)

    def test_an_edited_clip_is_kept_whatever_the_options(self):
        self.succeeds("encode", "a.wav")
        self.edit("a.json")
        for more in ([], ["--bands", "6"], ["--force"], ["-o", "a.json"], ["-o", "."]):
            self.keeps("a.json", ["encode", "a.wav", *more], "was edited since it was encoded")
        self.succeeds("encode", "a.wav", "--overwrite")
        self.assertNotEqual(json.loads(self.bytes_of("a.json"))["transients"],
                            [{"time": 0.01, "amplitude": 0.5, "sharpness": 0.5}])

    def test_an_edited_clip_is_recognised_in_the_other_form_too(self):
        self.succeeds("encode", "a.wav", "-o", "a.pacb")
        self.succeeds("convert", "a.pacb", "a.json")
        self.succeeds("encode", "a.wav", "--bands", "6")  # still as encoded, though converted
        self.edit("a.json")
        self.succeeds("convert", "a.json", "-o", "a.pacb")
        self.keeps("a.pacb", ["encode", "a.wav", "-o", "a.pacb"], "was edited since it was encoded")

    def test_a_clip_without_a_seal_is_left_unless_it_is_up_to_date(self):
        self.succeeds("encode", "a.wav")
        clip = json.loads(self.bytes_of("a.json"))
        del clip["encoder"]["seal"]
        self.put("a.json", json.dumps(clip))
        self.assertTrue(self.report("encode", "a.wav")["files"][0]["upToDate"])
        self.keeps("a.json", ["encode", "a.wav", "--bands", "6"], "may have been edited")
        self.succeeds("encode", "a.wav", "--bands", "6", "-y")

    def test_what_is_no_clip_of_this_sound_is_kept(self):
        for content in ('{"format": "pacini.scene"}', "my notes", "{ half a cl"):
            self.put("a.json", content)
            self.keeps("a.json", ["encode", "a.wav"], "exists and is not a clip")
            self.succeeds("encode", "a.wav", "-o", "a.json")
        self.put("a.json", '{"format": "pacini.clip", "version": 1, "duration": 1, "bands": [] "transients": []}')
        for more in ([], ["-o", "a.json"]):  # a comma is missing, which a person forgot
            self.keeps("a.json", ["encode", "a.wav", *more], "is not a clip that pacini encoded")
        os.remove(self.folder / "a.json")
        self.put("b.wav", wav(sine(100, 0.2)))
        self.succeeds("encode", "b.wav", "-o", "a.json")
        self.keeps("a.json", ["encode", "a.wav"], "was encoded from b.wav")
        self.succeeds("encode", "a.wav", "-o", "a.json")  # by name, and nobody edited it

    def test_files_of_other_formats_are_kept_unless_named_or_the_same(self):
        self.put("in/a.wav", self.bytes_of("a.wav"))
        encode = ["encode", "in", "-o", "out", "--format", "haptic"]
        for _ in range(2):
            self.succeeds(*encode)
        self.put("out/a.haptic", "{}")
        self.keeps("out/a.haptic", encode, "exists with other content")
        self.succeeds(*encode, "-y")
        for _ in range(2):
            self.succeeds("encode", "a.wav", "-o", "a.haptic")

    def test_no_overwrite_skips_what_exists_and_says_so(self):
        self.put("b.wav", wav(sine(100, 0.2)))
        self.put("a.json", "mine")
        self.assertRegex(self.succeeds("encode", "a.wav", "b.wav", "-n"), r"(?m)^1 encoded, 1 exists and was kept: ")
        self.assertEqual(self.bytes_of("a.json"), b"mine")
        report = self.report("encode", "a.wav", "b.wav", "--no-overwrite")
        self.assertEqual((report["files"], report["failures"]), ([], []))
        self.assertEqual(report["skipped"][0], {"input": "a.wav", "output": "a.json"})
        self.clip("c.json")
        self.put("c.haptic.wav", "mine")
        self.assertIn("1 exists and was kept", self.succeeds("render", "c.json", "-n"))
        self.put("c.pacb", "mine")
        self.assertIn("c.pacb exists and was kept", self.succeeds("convert", "c.json", "c.pacb", "-n"))
        self.assertEqual((self.bytes_of("c.haptic.wav"), self.bytes_of("c.pacb")), (b"mine", b"mine"))
        for command in (["encode", "a.wav"], ["render", "c.json"], ["convert", "c.json", "c.pacb"]):
            self.fails(2, [*command, "-n", "-y"], "overwrite")


class Converted(Overwrite):
    def test_a_forgotten_output_does_not_cost_the_last_clip(self):
        self.clip("a.json")
        self.clip("b.json", seconds=2)
        for name in "ab":
            self.succeeds("convert", f"{name}.json", f"{name}.pacb")
        self.keeps("b.pacb", ["convert", "a.pacb", "b.pacb"], "b.pacb: exists with other content")
        self.keeps("b.json", ["convert", "a.pacb", "b.json"], "b.json: exists with other content")
        self.clip("c.json")
        before = self.bytes_of("c.json")
        self.fails(2, ["convert", "a.json", "b.json", "c.json"], "c.json: is not a folder", "several inputs")
        self.assertEqual(self.bytes_of("c.json"), before)
        self.succeeds("convert", "a.pacb", "a.json", "-y")
        self.succeeds("convert", "a.json", "a.pacb")  # the same as before
        self.succeeds("convert", "a.pacb", "-o", "b.json")

    def test_a_profile_is_not_written_over_another(self):
        self.put("mine.acf", "mine")
        self.put("p.json", (SOURCE / "profiles/l5-wristband.json").read_bytes())
        self.keeps("mine.acf", ["convert", "p.json", "mine.acf"], "exists")
        for arguments in (["-o", "mine.acf"], ["mine.acf"], ["mine.acf", "-y"]):
            self.assertEqual(self.run_command("convert", "p.json", *arguments).returncode, 0)

    def test_edited_results_of_a_folder_are_kept(self):
        for name in ("a", "b"):
            self.clip(f"in/{name}.json")
        convert = ["convert", "in", "out", "--format", "haptic"]
        self.succeeds(*convert)
        self.put("out/b.haptic", "edited")
        self.clip("in/a.json", seconds=2)
        self.keeps("out/b.haptic", convert, "b.json: out/b.haptic: exists with other content")
        self.assertTrue(self.report(*convert, "-n")["skipped"])
        self.keeps("out/b.haptic", convert)
        self.succeeds(*convert, "-y")

    def test_a_manifest_is_not_written_over_other_things(self):
        self.clip("in/a.json")
        for content in ("[1, 2]", "notes\n", '{"format": "pacini.profile"}'):
            self.put("out/pacini.manifest.json", content)
            self.fails(1, ["convert", "in", "out", "--format", "haptic"], "not a manifest of conversions")
            self.assertEqual(self.bytes_of("out/pacini.manifest.json"), content.encode())


class Measured(Overwrite):
    def test_a_sweep_is_described_beside_it_but_not_over_other_things(self):
        sweep = ["measure", "sweep", "--duration", "1"]
        self.clip("door.json")
        self.keeps("door.json", [*sweep, "-o", "door.wav"], "door.json: exists and is not the description of a sweep; name another output")
        self.assertEqual(self.names(), ["door.json"])
        self.put("sweep.wav", wav(sine(100, 0.2)))
        self.keeps("sweep.wav", sweep, "sweep.wav: exists")  # the usual name is none that was given
        os.remove(self.folder / "sweep.wav")
        for _ in range(2):
            self.succeeds(*sweep)
            self.succeeds(*sweep, "-o", "other.wav")

    def test_recordings_of_many_wearers_are_not_written_over_real_ones(self):
        self.succeeds("measure", "sweep", "--duration", "1", "--levels=-24")
        self.put("rec-02.wav", wav(sine(100, 0.2)))
        simulate = ["measure", "simulate", "sweep.wav", "-o", "rec.wav", "--wearers", "2"]
        self.keeps("rec-02.wav", simulate, "rec-02.wav: exists")
        os.remove(self.folder / "rec-02.wav")
        for _ in range(2):
            self.succeeds(*simulate)

    def test_a_description_of_a_sweep_is_not_its_result(self):
        self.succeeds("measure", "sweep", "--duration", "1")
        before = self.bytes_of("sweep.json")
        self.fails(2, ["measure", "analyse", "sweep.wav", "--sweep", "sweep.json", "-o", "./sweep.json"],
                   "is the description of the sweep")
        self.assertEqual(self.bytes_of("sweep.json"), before)

    def test_no_result_of_a_measurement_is_written_over_what_it_is_made_of(self):
        self.succeeds("measure", "sweep", "--duration", "1", "-o", "sweep.wav")
        self.succeeds("measure", "simulate", "sweep.wav", "-o", "rec.wav")
        os.symlink("rec.wav", self.folder / "same.wav")
        before = {name: self.bytes_of(name) for name in ("sweep.json", "sweep.wav", "rec.wav")}
        for result, words in (("rec.wav", "is a recording to be analysed"), ("same.wav", "is a recording"),
                              ("./sweep.wav", "is the sound of the sweep")):
            for sweep in ("sweep.json", "sweep.wav"):
                self.fails(2, ["measure", "analyse", "rec.wav", "--sweep", sweep, "--impulse", result], words)
        self.fails(2, ["measure", "analyse", "rec.wav", "--sweep", "sweep.wav", "-o", "sweep.json"],
                   "is the description of the sweep")
        self.assertEqual({name: self.bytes_of(name) for name in before}, before)

    def test_a_picture_beside_its_clip_is_not_drawn_over_another(self):
        self.clip("a.json")
        self.put("a.png", "a photograph")
        self.keeps("a.png", ["plot", "a.json"], "exists with other content")
        self.assertIn("a.png exists and was kept", self.succeeds("plot", "a.json", "-n"))
        os.remove(self.folder / "a.png")
        for arguments in ([], [], ["-o", "a.png", "--dark"], ["-y"]):
            self.succeeds("plot", "a.json", *arguments)

    def test_tables_of_measurements_are_written_over_earlier_ones_only(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.put("out/decimate.csv", "mine")
        bench = ["bench", "decimate", "a.wav", "-o", "out", "--repeat", "1"]
        self.keeps("out/decimate.csv", bench, "decimate.csv: exists")
        self.succeeds(*bench, "-y")
        self.succeeds(*bench)


class Names(Overwrite):
    def test_a_name_that_says_something_else_is_an_error_that_says_what_to_do(self):
        self.put("x.wav", wav(sine(100, 0.2)))
        self.put("y.wav", wav(sine(150, 0.2)))
        for name in ("y.foo", "y", "y.txt"):
            self.fails(2, ["encode", "x.wav", "-o", name], "has an unknown extension", ".json", ".pacb", "--format")
        for name in ("y.mp3", "z.wav", "y.flac"):
            self.fails(2, ["encode", "x.wav", "-o", name], "has the extension of a sound", ".json", ".pacb")
        for name in ("two.json", "two.pacb", "two.haptic"):
            self.fails(2, ["encode", "x.wav", "y.wav", "-o", name], "looks like a file", f"-o {name}/")
            self.fails(2, ["encode", ".", "-o", name], "looks like a file")
        self.assertEqual(self.names(), ["x.wav", "y.wav"])
        self.succeeds("encode", "x.wav", "-o", "y.foo", "--format", "packed")
        self.succeeds("encode", "x.wav", "y.wav", "-o", "two.json/")
        self.fails(2, ["render", "two.json", "-o", "one.wav"], "looks like a file")
        self.fails(2, ["render", "two.json", "-o", "y.foo"], "is not a folder")
        self.fails(2, ["convert", "two.json", "one.haptic"], "looks like a file")


if __name__ == "__main__":
    unittest.main()
