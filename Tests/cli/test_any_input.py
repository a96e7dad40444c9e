"""End to end: every command reads clips of every format and scenes, and says which keys it does not know."""
import json
import unittest
import xml.etree.ElementTree as ElementTree

from command import SOURCE, CommandTest, read_float_wav, rms, sine, wav

HAPTIC = {"version": {"major": 1, "minor": 0, "patch": 0}, "signals": {"continuous": {"envelopes": {
    "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.2}],
    "frequency": [{"time": 0, "frequency": 0.5}]}}}}
TAP = {"Version": 1, "Pattern": [{"Event": {"Time": 0, "EventType": "HapticTransient"}}]}


class AnyInput(CommandTest):
    def setUp(self):
        super().setUp()
        self.clip("door.json", seconds=0.5)
        self.put("rumble.haptic", json.dumps(HAPTIC))
        self.put("tap.ahap", json.dumps(TAP))

    def scene(self, name="hall.json", **members):
        self.put(name, json.dumps({"format": "pacini.scene", "version": 1, **members}))

    def info(self, name):
        return self.report("info", name)["files"][0]

    def warned(self, *arguments):
        """The warnings of a run that succeeds, without what all lines begin with."""
        done = self.run_command(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [line.removeprefix("pacini: ") for line in done.stderr.decode().splitlines()]

    def test_clips_of_other_programs_are_rendered_and_drawn(self):
        for name, length in (("rumble.haptic", 1.0), ("tap.ahap", 0.01)):
            with self.subTest(name):
                self.succeeds("render", name, "-o", "out.wav")
                rate, samples = read_float_wav(self.folder / "out.wav")
                self.assertGreaterEqual(len(samples) / rate, length)
                self.assertGreater(rms(samples), 0.05)
                self.succeeds("plot", name, "-o", "out.svg")
                ElementTree.parse(self.folder / "out.svg")
        self.put("broken.ahap", "{")
        for command in ("render", "plot", "info"):
            self.fails(1, [command, "broken.ahap"], "broken.ahap: line 1")

    def test_a_single_tap_is_a_clip_that_sounds(self):
        self.assertGreater(self.info("tap.ahap")["duration"], 0.01)
        self.succeeds("convert", "tap.ahap", "tap.json")
        self.succeeds("render", "tap.json", "-o", "out.wav")
        self.assertGreater(max(map(abs, read_float_wav(self.folder / "out.wav")[1])), 0.5)
        length = self.info("tap.json")["duration"]
        for target in ("a.ahap", "b.haptic", "c.csv", "d.ahap", "e.haptic"):
            self.succeeds("convert", "tap.json" if target == "a.ahap" else before, target)
            before = target
        self.assertAlmostEqual(self.info("e.haptic")["duration"], length, delta=0.0006)

    def test_a_folder_renders_an_export_beside_its_clip_once(self):
        for name in ("door.json", "rumble.haptic"):
            self.put(f"in/{name}", (self.folder / name).read_bytes())
        self.put("in/door.haptic", json.dumps(HAPTIC))
        report = self.report("render", "in", "-o", "out")
        self.assertEqual(sorted(f["input"] for f in report["files"]), ["in/door.json", "in/rumble.haptic"])

    def test_a_scene_may_name_clips_of_other_programs(self):
        self.scene(plays=[{"clip": "rumble.haptic"}, {"clip": "tap.ahap", "start": 0.5}])
        self.succeeds("render", "hall.json", "-o", "out.wav")
        rate, samples = read_float_wav(self.folder / "out.wav")
        self.assertAlmostEqual(len(samples) / rate, 1.0, delta=0.01)

    def test_info_says_what_a_scene_holds(self):
        self.scene(name="hall.json", duration=3, actuators=2, clips=["door.json", "rumble.haptic"], plays=[
            {"name": "hum", "clip": 1, "loop": True, "pan": 0, "gain": -6},
            {"clip": "door.json", "start": 1, "stretch": 2}, {"clip": "door.json", "start": 2.75}],
            changes=[{"time": 1, "play": "hum", "parameter": "gain", "value": -20}])
        report = self.info("hall.json")
        self.assertEqual((report["kind"], report["duration"], report["actuators"], report["changes"]), ("scene", 3, 2, 1))
        self.assertEqual([(c["duration"], c["plays"]) for c in report["clips"]], [(0.5, 2), (1.0, 1)])
        self.assertEqual([(p["start"], p["end"], p["changes"]) for p in report["plays"]],
                         [(0, 3, 1), (1, 2, 0), (2.75, 3, 0)])
        text = self.succeeds("info", "hall.json")
        for says in ("scene, 3.00 s", "actuators     2, panned by constantPower", 'plays[0] "hum": clips[1]',
                     "-6 dB", "stretched 2 times", "played 2 times"):
            self.assertIn(says, text)
        self.assertIn("clips[0]: door.json", self.fails(1, ["info", "hall.json", "--clips", "nowhere"]).stderr.decode())

    def test_plot_draws_a_scene(self):
        self.scene(name="hall.json", duration=3, actuators=3, clips=["door.json", "rumble.haptic"], plays=[
            {"name": "hum", "clip": 1, "loop": True, "pan": 0}, {"name": "knock", "clip": 0, "start": 1, "pan": 1}],
            changes=[{"time": 1, "play": "hum", "parameter": "gain", "value": -20, "glide": 1},
                     {"time": 1.2, "play": "knock", "parameter": "stretch", "value": 2}])
        self.succeeds("plot", "hall.json", "-o", "hall.svg")
        text = (self.folder / "hall.svg").read_text()
        ElementTree.fromstring(text)
        for says in ("hum", "knock", "Level at each actuator", "Gain of the plays that change it", "peak 0."):
            self.assertIn(says, text)
        self.succeeds("plot", "hall.json", "-o", "hall.png", "--from", "0.5", "--to", "1.5")
        self.fails(2, ["plot", "hall.json", "--sound", "x.wav"], "leave out --sound and --profile")
        self.fails(1, ["plot", "hall.json", "--from", "5"], "--from")
        self.scene(name="many.json", plays=[{"clip": "door.json", "start": 0.01 * i} for i in range(300)])
        self.succeeds("plot", "many.json", "-o", "many.svg")
        self.scene(name="none.json")
        self.succeeds("plot", "none.json", "-o", "none.svg")

    def test_lint_finds_what_in_a_scene_does_nothing(self):
        self.scene(name="hall.json", duration=2, clips=["door.json", "rumble.haptic"], plays=[
            {"clip": "door.json"}, {"clip": "door.json", "start": 5}, {"clip": "door.json", "gain": -200},
            {"clip": "door.json", "start": 1.8}, {"clip": "door.json", "pan": 1, "noise": -3, "events": -130}],
            changes=[{"time": 1, "play": 0, "parameter": "gain", "value": 0},
                     {"time": 2.5, "play": 0, "parameter": "gain", "value": 0}])
        report = self.report("lint", "hall.json")["files"][0]
        found = {f["where"]: f["message"] for f in report["findings"]}
        self.assertEqual(found, {
            "clips[1]": "is never played",
            "plays[1]": "is not played: it starts after the end of the scene",
            "plays[2]": "is not played: it is muted",
            "plays[3]": "is cut off by the end of the scene, 0.300 s before its own end",
            "changes[0]": "comes after plays[0], which ends at 0.500 s",
            "changes[1]": "comes after the end of the scene",
            "plays[4].pan": "has no effect: the scene has only one actuator",
            "plays[4].noise": "has no effect: the clip has none"})
        self.assertTrue(report["ok"])
        self.assertIn("hall.json: clips[1]: is never played", self.succeeds("lint", "hall.json"))
        self.fails(1, ["lint", "hall.json", "--fail-on", "scene"], "8 losses are more than is allowed")
        losses = self.report("lint", "hall.json", "--target", "tact")["files"][0]["losses"]
        self.assertEqual({loss["clip"] for loss in losses}, {0, 1})
        self.scene(name="good.json", plays=[{"clip": "door.json"}])
        self.assertIn("plays all", self.succeeds("lint", "good.json"))

    def test_keys_that_are_not_known_are_warned_of_in_every_command(self):
        self.clip("typo.json", tranients=[])
        clip = ['typo.json: warning: tranients: is unknown; did you mean "transients"?']
        self.scene(plays=[{"clip": "typo.json", "speed": 2}])
        scene = ['hall.json: warning: plays[0].speed: is unknown; did you mean "stretch"?',
                 'hall.json: warning: typo.json: tranients: is unknown; did you mean "transients"?']
        profile = json.loads((SOURCE / "profiles/lra-175.json").read_text())
        profile["resonance"]["quality"] = 3
        self.put("mine.json", json.dumps(profile))
        own = ['mine.json: warning: resonance.quality: is unknown; did you mean "q"?']
        for arguments, expected in (
                (["info", "typo.json"], clip), (["info", "hall.json"], scene), (["info", "mine.json"], own),
                (["render", "typo.json", "-o", "o.wav"], clip), (["render", "hall.json", "-o", "o.wav"], scene),
                (["plot", "typo.json", "-o", "o.svg"], clip), (["plot", "hall.json", "-o", "o.svg"], scene),
                (["plot", "mine.json", "-o", "o.svg"], own),
                (["lint", "typo.json", "--target", "ahap"], clip), (["lint", "hall.json"], scene),
                (["convert", "typo.json", "o.pacb"], clip), (["convert", "mine.json", "o.acf"], own),
                (["play", "typo.json", "--dry-run", "--like", "xbox"], clip),
                (["render", "door.json", "-o", "o.wav", "--profile", "mine.json"], own)):
            with self.subTest(arguments=arguments):
                for line in expected:
                    self.assertIn(line, self.warned(*arguments))
                (self.folder / "o.pacb").unlink(missing_ok=True)
                where = expected[0].split(": ")[2]
                done = self.fails(1, [*arguments, "--strict"], f"{where}: is unknown; did you mean")
                self.assertNotIn("warning", done.stderr.decode())

    def test_a_text_with_very_many_of_them_gives_twenty_lines_and_a_count(self):
        self.clip("typo.json", envelope=[{"time": 0, "amplitude": 0, "x": 1}] * 500)
        warnings = self.warned("info", "typo.json")
        self.assertEqual(len(warnings), 21)
        self.assertEqual(warnings[-1], "typo.json: warning: and 480 more of this kind")

    def test_a_byte_order_mark_is_no_part_of_a_text_and_utf_16_is_named(self):
        self.put("tone.wav", wav(sine(100, 0.3)))
        self.scene(plays=[{"clip": "door.json"}])
        texts = {"door.json": ["info", "{}"], "hall.json": ["render", "{}", "-o", "o.wav", "-y"],
                 "tap.ahap": ["convert", "{}", "o.csv", "-y"], "o.csv": ["info", "{}"], "rumble.haptic": ["info", "{}"],
                 "mine.json": ["render", "door.json", "-o", "o.wav", "-y", "--profile", "{}"],
                 "mine.acf": ["info", "{}"],
                 "settings.json": ["encode", "tone.wav", "-o", "o.json", "-y", "--settings", "{}"],
                 "labels.txt": ["compare", "tone.wav", "tone.wav", "--onsets", "{}"],
                 "labels.json": ["compare", "tone.wav", "tone.wav", "--onsets", "{}"],
                 "hand.csv": ["texture", "analyse", "tone.wav", "--speed", "{}", "-o", "t.json"],
                 "wood.json": ["texture", "render", "{}", "--speed", "0:0 1:1", "-o", "o.wav", "-y"],
                 "response.csv": ["measure", "fit", "{}"], "ratings.csv": ["study", "report", "{}", "-y"]}
        profile = (SOURCE / "profiles/lra-175.json").read_text()
        self.put("mine.json", profile)
        self.assertEqual(self.run_command("convert", "mine.json", "mine.acf").returncode, 0)
        self.put("settings.json", '{"format": "pacini.settings", "version": 1}')
        self.put("labels.txt", "0.1\t0.2\thit\n")
        self.put("labels.json", "[0.1]")
        self.put("hand.csv", "0,1\n1,2\n")
        self.assertEqual(self.run_command("texture", "analyse", "tone.wav", "-o", "wood.json").returncode, 0)
        self.put("response.csv", "\n".join(f"{10 * f},{f % 3}" for f in range(1, 60)))
        self.put("ratings.csv", "stimulus,rating\n" + "".join(f"{s},{r}\n" for s in "ab" for r in range(4)))
        for name, arguments in texts.items():
            with self.subTest(name):
                command = [argument.format("marked-" + name) for argument in arguments]
                text = (self.folder / name).read_bytes()
                self.put("marked-" + name, b"\xef\xbb\xbf" + text)
                self.assertEqual(self.run_command(*command).returncode, 0, self.run_command(*command).stderr)
                self.put("marked-" + name, text.decode().encode("utf-16"))
                self.fails(1, command, "marked-" + name, "UTF-16")

    def test_a_sound_is_still_a_sound(self):
        self.put("tone.wav", wav(sine(100, 0.3)))
        self.assertEqual(self.info("tone.wav")["kind"], "audio")
        self.succeeds("plot", "tone.wav", "-o", "tone.svg")


if __name__ == "__main__":
    unittest.main()
