"""End to end: pacini info and pacini convert, and what clips and profiles may do wrong."""
import copy
import json
import os
import unittest

from command import SANITIZED, SOURCE, CommandTest, sine, wav


class Info(CommandTest):
    def test_a_clip_is_described_in_words_and_as_json(self):
        self.clip(seconds=2.0)
        text = self.succeeds("info", "clip.json")
        for part in ('clip.json: haptic clip "made", 2.00 s', "bands         1 from 80 to 125 Hz", "transients    1"):
            self.assertIn(part, text)
        report = self.report("info", "clip.json")
        self.assertEqual((report["duration"], report["bands"], report["transients"]), (2.0, 1, 1))
        self.assertEqual(report["breakpoints"], 6)
        self.assertEqual(set(report["bytes"]), {"json", "packed", "thesisBits"})
        self.succeeds("convert", "clip.json", "clip.pacb")
        self.assertEqual(report["bytes"]["packed"], (self.folder / "clip.pacb").stat().st_size)
        # The thesis counts 12 bits for a value: each point has a time and an amplitude, each event a time too.
        self.assertGreater(report["bytes"]["thesisBits"], 8 * 3)
        both = self.report("info", "clip.json", "clip.pacb")
        self.assertEqual([entry["duration"] for entry in both["files"]], [2.0, 2.0])

    def test_the_json_size_is_that_of_the_written_file(self):
        self.put("a.wav", wav(sine(100, 0.5)))
        self.succeeds("encode", "a.wav")
        self.assertEqual(self.report("info", "a.json")["bytes"]["json"], (self.folder / "a.json").stat().st_size)

    def test_a_sound_is_described_too(self):
        self.put("a.wav", wav(sine(100, 0.5, rate=8000), rate=8000))
        self.assertEqual(self.succeeds("info", "a.wav"), "a.wav: sound, 0.50 s, 8000 Hz, 1 channel, peak 0.500\n")
        report = self.report("info", "a.wav")
        self.assertEqual((report["kind"], report["frames"], report["sampleRate"]), ("audio", 4000, 8000))

    def test_what_a_clip_says_cannot_reach_the_terminal(self):
        self.clip("clip.json")
        self.put("clip.json", json.dumps(self.clip(**{"name": "clip.json"}) | {"name": "\x1b[2Jgone\n"}))
        text = self.succeeds("info", "clip.json")
        self.assertNotIn("\x1b", text)
        self.assertIn("\\x1b[2Jgone\\n", text)

    def test_bad_files_are_named_and_the_others_described(self):
        self.clip()
        done = self.fails(1, ["info", "missing", "clip.json", "."], "pacini: missing: does not exist",
                          "pacini: .: is a folder", lines=2)
        self.assertIn(b"clip.json: haptic clip", done.stdout)


class Convert(CommandTest):
    def test_there_and_back_again_is_identical(self):
        self.put("a.wav", wav(sine(100, 0.5)))
        self.succeeds("encode", "a.wav", "-o", "a.json")
        self.succeeds("encode", "a.wav", "-o", "a.pacb")
        self.succeeds("convert", "a.json", "b.pacb")
        self.succeeds("convert", "b.pacb", "b.json")
        self.assertEqual((self.folder / "b.pacb").read_bytes(), (self.folder / "a.pacb").read_bytes())
        self.assertEqual((self.folder / "b.json").read_bytes(), (self.folder / "a.json").read_bytes())

    def test_both_forms_of_a_clip_render_to_the_same_bytes(self):
        self.put("a.wav", wav(sine(100, 0.5)))
        for form in ("a.json", "a.pacb"):
            self.succeeds("encode", "a.wav", "-o", form)
            self.succeeds("render", form, "-o", form + ".wav")
        self.assertEqual((self.folder / "a.json.wav").read_bytes(), (self.folder / "a.pacb.wav").read_bytes())

    def test_the_report_and_the_options(self):
        self.clip()
        report = self.report("convert", "clip.json", "x.bin", "--format", "packed", "--quantise", "16")
        self.assertEqual(report["bytes"], (self.folder / "x.bin").stat().st_size)
        self.assertEqual(report["duration"], 1.0)
        self.fails(2, ["convert", "clip.json", "x.mid"], "x.mid: has an unknown extension; use .json, .pacb")
        self.fails(2, ["convert", "clip.json"], "missing")
        self.fails(1, ["convert", "missing.json", "x.pacb"], "pacini: missing.json: does not exist")
        self.assertEqual(self.names(), ["clip.json", "x.bin"])

    def test_a_clip_is_not_converted_onto_itself(self):
        self.clip()
        before = (self.folder / "clip.json").read_bytes()
        os.symlink("clip.json", self.folder / "link.json")
        for output in ("clip.json", "./clip.json", "link.json"):
            self.fails(1, ["convert", "clip.json", output], "is also the input")
        self.assertEqual((self.folder / "clip.json").read_bytes(), before)


class BrokenClips(CommandTest):
    def refused(self, content, *says):
        """All three commands refuse the content in one line each; nothing is written."""
        path = self.put("bad.json", content)
        for arguments in (["info", "bad.json"], ["render", "bad.json", "-o", "out.wav"],
                          ["convert", "bad.json", "out.pacb"]):
            self.fails(1, arguments, "pacini: bad.json: ", *says)
        self.assertEqual(self.names(), ["bad.json"])
        path.unlink()

    def test_each_fault_is_named_with_its_place(self):
        good = self.clip("good.json")
        (self.folder / "good.json").unlink()

        def changed(change):
            content = copy.deepcopy(good)
            change(content)
            return json.dumps(content)

        points = lambda content: content["bands"][0]["amplitude"]
        for change, *says in (
                (lambda c: c.pop("duration"), "duration", "missing"),
                (lambda c: c.update(duration="1"), "duration"),
                (lambda c: c.update(version=2), "version", "newer"),
                (lambda c: c.update(format="pacini.other"), "format"),
                (lambda c: points(c).reverse(), "bands[0].amplitude[1].time", "earlier"),
                (lambda c: points(c)[1].update(time=None), "bands[0].amplitude[1].time"),
                (lambda c: points(c)[1].update(amplitude=float("nan")), "line 1, column"),
                (lambda c: points(c)[1].update(amplitude=float("inf")), "line 1, column"),
                (lambda c: points(c)[2].update(time=5), "bands[0].amplitude[2].time", "later"),
                (lambda c: c.update(bands={}), "bands"),
                (lambda c: c["transients"][0].pop("sharpness"), "transients[0].sharpness", "missing")):
            self.refused(changed(change), *says)
        text = json.dumps(good)
        self.refused(text + "x", "line 1, column")
        self.refused(text + text, "line 1, column")
        self.refused(text[:-2], "line 1, column")
        self.refused(text.replace('"version": 1', '"version": 1, "version": 1'), "version")
        self.refused(text.replace("0.5", "1e999"), "beyond the range")
        self.refused(text.encode("utf-16"), "UTF-16")

    def test_what_is_no_clip_is_said_to_be_none(self):
        for content in (b"", b"RIFF", b"hello", b"[1, 2]", b"\x00" * 100, b"PACB", b"PACB" + b"\xff" * 50):
            path = self.put("bad.json", content)
            self.fails(1, ["render", "bad.json"], "pacini: bad.json: ")
            path.unlink()

    def test_a_packed_clip_that_lost_or_changed_bytes_is_refused(self):
        self.clip()
        self.succeeds("convert", "clip.json", "clip.pacb")
        (self.folder / "clip.json").unlink()
        whole = (self.folder / "clip.pacb").read_bytes()
        (self.folder / "clip.pacb").unlink()
        for size in range(len(whole)):
            self.put("cut.pacb", whole[:size])
            self.fails(1, ["render", "cut.pacb"], "pacini: cut.pacb: ")
        for place in range(0, len(whole), 3):
            changed = bytearray(whole)
            changed[place] ^= 0x55
            self.put("cut.pacb", bytes(changed))
            self.fails(1, ["render", "cut.pacb"], "pacini: cut.pacb: ")
        self.put("cut.pacb", whole + b"x")
        self.fails(1, ["render", "cut.pacb"], "pacini: cut.pacb: ")
        self.assertEqual(self.names(), ["cut.pacb"])

    def test_hundreds_of_megabytes_of_brackets_are_refused_soon(self):
        size = 200_000_000
        for start in (b"[", b'{"a":'):
            with open(self.folder / "deep.json", "wb") as file:
                file.write(start)
                for _ in range(100):
                    file.write(b"[" * (size // 100))
            # The file itself is the memory that may be needed, half as much again is not.
            limit = [] if SANITIZED else ["bash", "-c", 'ulimit -v 400000; exec "$0" "$@"']
            for command in (["info", "deep.json"], ["render", "deep.json"],
                            ["render", "deep.json", "--profile", "deep.json"]):
                self.fails_limited(limit, command)

    def fails_limited(self, limit, command):
        if not limit:
            self.fails(1, command, "pacini: deep.json: ")
            return
        import subprocess
        from command import COMMAND
        done = subprocess.run([*limit, COMMAND, *command], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr.decode(), r"^pacini: deep\.json: [^\n]+\n$")
        self.assertNotIn(b"memory", done.stderr)


class BrokenProfiles(CommandTest):
    def refused(self, content, *says):
        self.clip()
        self.put("p.json", content if isinstance(content, (str, bytes)) else json.dumps(content))
        self.fails(1, ["render", "clip.json", "--profile", "p.json"], "pacini: p.json: ", *says)
        self.assertEqual(self.names(), ["clip.json", "p.json"])

    def test_each_fault_is_named_with_its_place(self):
        good = json.loads((SOURCE / "profiles/l5-wristband.json").read_text())

        def changed(change):
            content = copy.deepcopy(good)
            change(content)
            return content

        section = lambda content: content["equalizer"][0]
        for change, *says in (
                (lambda c: c.update(format="pacini.clip"), "format: "),
                (lambda c: c.pop("format"), "format: is missing"),
                (lambda c: c.update(version=2), "version: ", "newer"),
                (lambda c: c.update(version=0), "version: "),
                (lambda c: c.update(version=1.5), "version: "),
                (lambda c: c.update(version="1"), "version: "),
                (lambda c: c.pop("name"), "name: is missing"),
                (lambda c: c.update(resonance=67), "resonance: "),
                (lambda c: c["resonance"].update(frequency="67"), "resonance.frequency: "),
                (lambda c: c["resonance"].update(frequency=1e300), "resonance"),
                (lambda c: c.update(equalizer={}), "equalizer: "),
                (lambda c: c.update(equalizer=[section(c)] * 17), "equalizer: ", "16"),
                (lambda c: section(c).update(type="notch"), "equalizer[0].type: "),
                (lambda c: section(c).pop("frequency"), "equalizer[0].frequency: is missing"),
                (lambda c: section(c).update(q=0), "equalizer[0]"),
                (lambda c: c["equalizer"].append({"type": "highpass", "frequency": 20, "order": 2.5}), "order"),
                (lambda c: c["equalizer"].append(7), "equalizer[")):
            self.refused(changed(change), *says)

    def test_faults_of_the_text_are_named_with_line_and_column(self):
        text = (SOURCE / "profiles/l5-wristband.json").read_text()
        self.refused(text + "x", "line ", "column ")
        self.refused(text[:-3], "line ", "column ")
        self.refused(text.replace('"version": 1', '"version": 1, "version": 1'), "version: ", "twice")
        self.refused(text.replace('"frequency": ', '"frequency": 1e999, "x": ', 1), "beyond the range")
        self.refused("", "is empty")
        self.refused(b"\xff\xfe{", "UTF-16")
        self.refused("[" * 100000, "line 1, column 33", "32 levels of objects and lists")
        self.refused("[]", "object")
        self.refused(" " * (2 << 20), "larger")


if __name__ == "__main__":
    unittest.main()
