"""End to end: settings files, and that every door says the same of each parameter."""
import json
import re
import subprocess
import sys
import unittest

from command import COMMAND, SOURCE, CommandTest, noise, sine, wav


def words(name, between):
    return re.sub("[A-Z]", lambda found: between + found[0].lower(), name)


class Settings(CommandTest):
    def settings(self, name="mine.json", **parts):
        self.put(name, json.dumps({"format": "pacini.settings", "version": 1, **parts}))

    def test_what_is_printed_is_read_and_changes_nothing(self):
        self.put("a.wav", wav(noise(24000)))
        for method in ("a2vt", "thesis", "decomposition", "envelope-sine", "centroid-flatness"):
            with self.subTest(method):
                self.put("mine.json", self.succeeds("encode", "--print-settings", "--method", method))
                self.succeeds("encode", "a.wav", "-o", "plain.json", "--method", method)
                self.succeeds("encode", "a.wav", "-o", "set.json", "--settings", "mine.json")
                plain, chosen = (json.loads((self.folder / name).read_text()) for name in ("plain.json", "set.json"))
                if method == "a2vt":
                    self.assertEqual(plain, chosen)
                for clip in (plain, chosen):  # a record names what was chosen
                    del clip["encoder"]
                self.assertEqual(plain, chosen)
        self.assertEqual(self.report("encode", "--print-settings")["settings"]["encode"]["bands"], 12)

    def test_a_file_does_what_its_options_do(self):
        self.put("a.wav", wav([a + b for a, b in zip(sine(90, 1.0, level=0.3), noise(48000, level=0.3))]))
        values = {"bands": 5, "breakpoints": 7.5, "quantise": 8, "low": 40, "high": 700, "spacing": "linear", "sensitivity": 2,
                  "audible": 0.25, "heard": "instead", "speech": 0.5, "keepLevel": True, "minimumGap": 0.05, "maskMargin": 3, "maskSlope": 0.1,
                  "maskRecovery": 50, "maskLimit": 20, "silence": -40}
        described = self.report("encode", "--print-settings")["parameters"]["encode"]
        self.assertEqual(set(values), {one["name"] for one in described if "a2vt" in one["methods"]})
        options = []
        for name, value in values.items():
            options += [f"--{words(name, '-')}"] + ([] if value is True else [str(value)])
        self.succeeds("encode", "a.wav", "-o", "options.pacb", *options)
        self.settings(encode=values)
        self.succeeds("encode", "a.wav", "-o", "file.pacb", "--settings", "mine.json")
        self.assertEqual((self.folder / "file.pacb").read_bytes(), (self.folder / "options.pacb").read_bytes())
        record = self.report("info", "file.pacb")
        for name, value in values.items():
            self.assertIn(words(name, "") if False else name if name != "keepLevel" else "normalise", json.dumps(record))

    def test_a_preset_is_the_same_at_every_place_of_the_command(self):
        self.put("a.wav", wav([a + b for a, b in zip(sine(90, 1.0, level=0.3), noise(48000, level=0.3))]))
        presets = self.report("encode", "--print-settings")["presets"]
        self.assertEqual(presets[0], {"name": "effects", "purpose": "Good for most sounds", "values": {}})
        made = set()
        for preset in presets:
            options = [word for name, value in preset["values"].items() for word in (f"--{words(name, '-')}", str(value))]
            self.succeeds("encode", "a.wav", "-o", "options.pacb", "-y", *options)
            self.succeeds("encode", "a.wav", "-o", "preset.pacb", "-y", "--preset", preset["name"])
            self.settings(encode={"preset": preset["name"]})
            self.succeeds("encode", "a.wav", "-o", "file.pacb", "-y", "--settings", "mine.json")
            self.settings(encode={"bands": 3, "audible": 0.25, "heard": "instead"})
            self.succeeds("encode", "a.wav", "-o", "over.pacb", "-y", "--settings", "mine.json", "--preset", preset["name"])
            for name in ("preset", "file", "over"):
                self.assertEqual((self.folder / f"{name}.pacb").read_bytes(), (self.folder / "options.pacb").read_bytes())
            made.add((self.folder / "preset.pacb").read_bytes())
        self.assertEqual(len(made), len(presets))
        self.fails(2, ["encode", "a.wav", "--preset", "musik"], "--preset", "did you mean music?")
        self.fails(2, ["encode", "a.wav", "--preset", "music", "--method", "thesis"], "--preset", "is for the method a2vt")

    def test_what_no_option_reached_before_changes_a_clip_and_stands_in_its_record(self):
        hits = [0.0] * 48000
        for k in range(20):
            for i in range(200):
                hits[2000 * k + i] = (0.2, 0.9, 0.2, 0.6)[k % 4] * (-1) ** (i // 20) * (1 - i / 200)
        self.put("a.wav", wav(hits))
        for method, parameter, value in (("a2vt", "minimumGap", 0.1), ("a2vt", "silence", -10), ("a2vt", "maskLimit", 1),
                                         ("envelope-sine", "attack", 0.05), ("envelope-sine", "hold", 0.2),
                                         ("envelope-sine", "release", 0.5), ("envelope-sine", "crestAdaptive", True),
                                         ("envelope-sine", "lowLimit", 500), ("envelope-sine", "highLimit", 100),
                                         ("thesis", "transientThreshold", 5), ("thesis", "minimumGap", 0.3),
                                         ("thesis", "transientAmplitude", 0.99)):
            with self.subTest(f"{method} {parameter}"):
                self.settings(encode={"method": method, parameter: value})
                self.succeeds("encode", "a.wav", "-o", "set.json", "--settings", "mine.json", "-y")
                self.succeeds("encode", "a.wav", "-o", "plain.json", "--method", method, "-y")
                chosen, plain = (json.loads((self.folder / name).read_text()) for name in ("set.json", "plain.json"))
                self.assertEqual(chosen["encoder"][parameter], value)
                curves = ("envelope", "bands", "transients")
                self.assertNotEqual([chosen[name] for name in curves], [plain[name] for name in curves])
                # A clip of other settings is not up to date.
                self.assertIn("1 encoded", self.succeeds("encode", "a.wav", "-o", "set.json", "--method", method, "-y"))

    def test_options_come_before_the_file(self):
        self.settings(encode={"bands": 5, "quantise": 8})
        printed = json.loads(self.succeeds("encode", "--settings", "mine.json", "--bands", "3", "--print-settings"))
        self.assertEqual((printed["encode"]["bands"], printed["encode"]["quantise"]), (3, 8))
        self.settings(encode={"method": "thesis"})
        self.assertEqual(json.loads(self.succeeds("encode", "--settings", "mine.json", "--print-settings"))["encode"]["bands"], 6)

    def test_what_is_wrong_with_a_file_is_told(self):
        self.put("a.wav", wav(sine(100, 0.2)))
        self.settings(encode={"bnads": 3})
        self.warns("encode", "a.wav", "--settings", "mine.json", says='encode.bnads: is unknown; did you mean "bands"?')
        self.fails(1, ["--strict", "encode", "a.wav", "--settings", "mine.json"], "mine.json: encode.bnads")
        self.settings(encode={"bands": 99})
        self.fails(1, ["encode", "a.wav", "--settings", "mine.json"], "mine.json: encode.bands: must be 1 to 32")
        self.put("mine.json", "{")
        self.fails(1, ["encode", "a.wav", "--settings", "mine.json"], "mine.json: line 1")
        self.fails(1, ["encode", "a.wav", "--settings", "none.json"], "none.json")

    def test_presets_of_the_editor_are_settings_without_a_word(self):
        self.put("a.wav", wav(noise(24000)))
        self.succeeds("encode", "a.wav", "-o", "plain.pacb", "--bands", "5")
        outputs = [{"channel": 3, "gain": -3.5, "delay": 0, "position": 0.5, "actuator": "lra-175"}]
        character = {"gain": -6.5, "intensity": 0.7, "transposition": 7, "speed": 0.5}
        self.settings(encode={"bands": 5}, pan="constantPower", outputs=outputs, character=character)
        self.succeeds("--strict", "encode", "a.wav", "-o", "set.pacb", "--settings", "mine.json")
        self.assertEqual((self.folder / "set.pacb").read_bytes(), (self.folder / "plain.pacb").read_bytes())
        for parts, says in (({"character": {"gain": "loud"}}, "character.gain: must be a number"),
                            ({"outputs": [{"chanel": 1}]}, "outputs[0].chanel: is unknown"),
                            ({"outputs": 3}, "outputs: must be a list of outputs")):
            self.settings(**parts)
            self.fails(1, ["--strict", "encode", "a.wav", "--settings", "mine.json"], says)

    def test_exports_take_what_their_format_has(self):
        self.put("a.wav", wav(noise(24000)))
        self.settings(export={"points": 5, "sampleRate": 4000})
        self.succeeds("encode", "a.wav", "-o", "set.haptic", "--settings", "mine.json")
        self.succeeds("encode", "a.wav", "-o", "option.haptic", "--points", "5")
        sizes = [len(json.loads((self.folder / name).read_text())["signals"]["continuous"]["envelopes"]["amplitude"])
                 for name in ("set.haptic", "option.haptic")]
        self.assertEqual(*sizes)


class Doors(CommandTest):
    """Ranges, defaults, units and names of every parameter over all doors."""

    def described(self):
        return self.report("encode", "--print-settings")["parameters"]

    def test_help_texts_say_what_is_described(self):
        described = self.described()
        self.assertGreater(len(described["encode"]), 20)
        for part, commands in (("encode", ["encode"]), ("export", ["encode", "convert", "lint"]), ("render", ["render"]),
                               ("felt", ["render"])):
            for command in commands:
                entries = re.split(r"\n(?= {2,6}-)", self.succeeds("help", command))
                for one in described[part]:
                    limits = f"({one['lowest']} to {one['highest']}{' ' + one['unit'] if one['unit'] else ''})" if "lowest" in one else ""
                    usual = f"[{one['default']}]" if one["kind"] != "truth" and "default" in one else ""
                    usual = usual or (f"[{one['usually']}]" if "usually" in one and one["kind"] != "truth" else "")
                    with self.subTest(f"{command} {one['option']}"):
                        [entry] = [" ".join(each.split()) for each in entries if re.match(rf" +{one['option']}\s", each)]
                        self.assertIn(one["text"].split(" (")[0][:30], entry)
                        self.assertIn(limits, entry)
                        self.assertIn(usual, entry)

    def test_documentation_schema_and_types_are_made_from_the_description(self):
        done = subprocess.run([sys.executable, SOURCE / "Resources/docs/make_parameters.py", "--check", "--program", COMMAND],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stdout + done.stderr)

    def test_ends_of_ranges_are_taken_and_what_is_beyond_is_not(self):
        self.clip()
        for part, format in (("encode", None), ("export", "openxr"), ("render", None), ("felt", None)):
            for one in self.described()[part]:
                if "lowest" not in one or (format and format not in one["formats"]):
                    continue
                for value, allowed in ((one["lowest"], True), (one["highest"], True), (one["lowest"] - 1, False),
                                       (one["highest"] + 1, False)):
                    if (one["option"], value) in (("--from", one["highest"]), ("--to", one["lowest"])):
                        continue  # nothing would be left
                    with self.subTest(f"{one['option']} {value}"):
                        if part == "encode":
                            words = ["encode", "--print-settings", one["option"], str(value)]
                            if one["name"] == "low":
                                words += ["--high", "1800"]
                            if one["name"] == "high":
                                words += ["--low", "1"]
                            if "a2vt" not in one["methods"]:
                                words += ["--method", one["methods"][0]]
                        elif part in ("render", "felt"):
                            words = ["render", "clip.json", "-o", "out.wav", "--dry-run", "--profile", "lra-175", "--felt",
                                     one["option"], str(value)]
                            if one["name"] == "start":
                                words += ["--to", "86400"]
                            if one["name"].startswith("pulse"):
                                words += ["--pulse", "sine"]
                        else:
                            words = ["convert", "clip.json", "out.h", "--format", format, one["option"], str(value), "-y"]
                            if one["name"] == "strength":
                                words += ["--profile", "lra-175"]
                        done = self.run_command(*words)
                        self.assertEqual(done.returncode, 0 if allowed else 2, done.stderr.decode())


if __name__ == "__main__":
    unittest.main()
