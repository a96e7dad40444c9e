"""End to end: scenes with pacini render."""
import json
import math
import signal
import struct
import unittest
from pathlib import Path

from command import SANITIZED, SOURCE, CommandTest, read_float_wav, rms
from test_memory import peak_of

RATE = 8000


def read_channels(path):
    """(rate, [samples of each channel]) of a float WAV; finds its chunks by itself."""
    content = Path(path).read_bytes()
    offset = 12
    while offset + 8 <= len(content):
        size = struct.unpack_from("<I", content, offset + 4)[0]
        if content[offset:offset + 4] == b"fmt ":
            kind, channels, rate = struct.unpack_from("<HHI", content, offset + 8)
            if kind == 0xFFFE:  # extensible: more than two channels
                kind = struct.unpack_from("<H", content, offset + 8 + 24)[0]
            assert kind == 3, kind
        if content[offset:offset + 4] == b"data":
            samples = struct.unpack_from(f"<{size // 4}f", content, offset + 8)
            return rate, [samples[c::channels] for c in range(channels)]
        offset += 8 + size + size % 2
    raise AssertionError("no data chunk")


class Scenes(CommandTest):
    def tone(self, name="tone.json", seconds=1.0, frequency=100, amplitude=0.5):
        """Writes a clip of one steady band."""
        curve = [{"time": 0, "amplitude": amplitude}, {"time": seconds, "amplitude": amplitude}]
        band = {"lowFrequency": frequency, "centreFrequency": frequency, "highFrequency": frequency,
                "amplitude": curve, "pitch": []}
        content = self.clip(name, seconds, envelope=[], bands=[band], transients=[])
        self.put(name, json.dumps({**content, "name": Path(name).stem}))

    def scene(self, name="a.scene.json", **members):
        self.put(name, json.dumps({"format": "pacini.scene", "version": 1, **members}))

    def rendered(self, *options, name="a.scene.json"):
        self.succeeds("render", name, "-o", "out.wav", "--rate", str(RATE), *options)
        return read_channels(self.folder / "out.wav")[1]

    def level(self, samples, start, end):
        return rms(samples[round(start * RATE):round(end * RATE)])

    def test_a_loop_a_pan_over_three_actuators_and_changes(self):
        self.tone("clips/tone.json")
        self.tone("clips/high.json", frequency=200)
        self.scene(duration=4.0, actuators=3, clips=["clips/tone.json", {"file": "clips/high.json"}], plays=[
            {"name": "hum", "clip": "tone.json", "loop": True, "pan": 0},
            {"name": "late", "clip": 1, "start": 3.0, "pan": 1}], changes=[
                {"time": 1.0, "play": "hum", "parameter": "pan", "value": 0.5, "glide": 0.1},
                {"time": 2.0, "play": "hum", "parameter": "gain", "value": -6.0206, "glide": 0},
                {"time": 3.0, "play": 0, "parameter": "gain", "value": -120}])
        left, middle, right = self.rendered()
        self.assertEqual([len(c) for c in (left, middle, right)], [4 * RATE] * 3)
        full = 0.5 / math.sqrt(2)
        self.assertAlmostEqual(self.level(left, 0.1, 0.9), full, delta=0.01)
        self.assertEqual(self.level(middle, 0.1, 0.9), 0.0)
        self.assertAlmostEqual(self.level(middle, 1.2, 1.9), full, delta=0.01)
        self.assertLess(self.level(left, 1.2, 1.9), 1e-3)
        self.assertAlmostEqual(self.level(middle, 2.1, 2.9), full / 2, delta=0.01)
        self.assertEqual(self.level(right, 0.0, 2.9), 0.0)
        self.assertAlmostEqual(self.level(right, 3.1, 3.9), full, delta=0.01)
        self.assertLess(self.level(middle, 3.1, 3.9), 1e-3)

    def test_a_clip_is_rendered_as_a_scene_in_which_it_plays_once(self):
        self.clip("clip.json")
        self.scene(plays=[{"clip": "clip.json"}])
        scene = self.rendered("--everything")
        self.succeeds("render", "clip.json", "-o", "clip.wav", "--rate", str(RATE), "--everything")
        self.assertEqual(read_float_wav(self.folder / "clip.wav")[1], scene[0])

    def test_the_options_of_clips_work_on_the_whole_scene(self):
        self.tone()
        self.scene(gain=-6.0206, plays=[{"clip": "tone.json", "start": 0.5}])
        plain = self.rendered()[0]
        full = 0.25 / math.sqrt(2)
        self.assertEqual(len(plain), 1.5 * RATE)
        self.assertAlmostEqual(self.level(plain, 0.6, 1.4), full, delta=0.005)
        louder = self.rendered("--gain", "6.0206")[0]
        self.assertAlmostEqual(self.level(louder, 0.6, 1.4), 2 * full, delta=0.01)
        moved = self.rendered("--delay", "1", "--stretch", "2")[0]
        self.assertEqual(len(moved), 4 * RATE)
        self.assertEqual(self.level(moved, 0.0, 1.99), 0.0)
        self.assertAlmostEqual(self.level(moved, 2.1, 3.9), full, delta=0.005)
        crossings = lambda samples: sum(a < 0 <= b for a, b in zip(samples, samples[1:]))
        octave = self.rendered("--transpose", "12")[0]
        self.assertAlmostEqual(crossings(octave), 2 * crossings(plain), delta=4)
        self.assertNotEqual(self.rendered("--variation", "0.5")[0], plain)
        self.assertEqual(self.rendered("--variation", "0.5", "--seed", "3"),
                         self.rendered("--variation", "0.5", "--seed", "3"))

    def test_what_is_left_out_is_named_with_its_reason_and_costs_less_than_predicted(self):
        self.tone()
        self.tone("high.json", frequency=250)
        self.scene(duration=1.0, plays=[{"clip": "tone.json"}, {"clip": "high.json", "gain": -80},
                                        {"clip": "tone.json", "gain": -120}] +
                   [{"clip": "tone.json", "start": 2.0}] * 30)
        report = self.report("render", "a.scene.json", "--explain", "--measured")["files"][0]
        plan = report["plan"]
        self.assertEqual(report["kind"], "scene")
        self.assertEqual((plan["givenPlays"], plan["keptPlays"], plan["mostSounding"]), (33, 1, 1))
        self.assertEqual([play["play"] for play in plan["plays"]], [0])
        self.assertEqual(plan["plays"][0]["carriers"], 1)
        left = {item["where"]: item for item in plan["leftOut"]}
        self.assertEqual(left["plays[1]"]["reason"], "is too weak to be perceived")
        self.assertEqual(left["plays[2]"], {"where": "plays[2]", "reason": "is muted", "error": None})
        self.assertEqual(len(left), plan["leftOutCount"])
        self.assertLess(plan["predictedError"], -60)
        self.assertLessEqual(plan["measuredError"], plan["predictedError"])
        self.assertAlmostEqual(plan["measuredError"], -80, delta=1.5)
        text = self.succeeds("render", "a.scene.json", "--measured")
        for part in ("a.scene.json:\n  1 of 33 plays on 1 actuator, at most 1 decoder at a time",
                     'plays[0] "tone": 1.000 s from 0.000 s on; 1 sinusoid at an inner rate of',
                     "plays[1] is too weak to be perceived: -8", "plays[2] is muted: nothing lost",
                     "and 10 more of the same kind", "(tolerance -60.0 dB); measured: -8"):
            self.assertIn(part, text)
        everything = self.report("render", "a.scene.json", "--everything")["files"][0]["plan"]
        self.assertEqual((everything["leftOutCount"], everything["predictedError"]), (0, None))
        strict = self.report("render", "a.scene.json", "--tolerance", "-100", "--explain")["files"][0]["plan"]
        self.assertEqual(strict["keptPlays"], 2)
        self.fails(2, ["render", "a.scene.json", "--everything", "--tolerance", "-40"], "--everything")
        self.fails(2, ["render", "a.scene.json", "--tolerance", "3"], "--tolerance", "-300 to 0")

    def test_clips_and_scenes_are_rendered_together(self):
        self.tone("in/tone.json")
        self.scene("in/two.scene.json", actuators=2, plays=[{"clip": "tone.json"}])
        report = self.report("render", "in", "-o", "out")
        self.assertEqual([(f["output"], f["kind"]) for f in report["files"]],
                         [("out/tone.wav", "clip"), ("out/two.scene.wav", "scene")])
        self.assertEqual(report["files"][1]["plan"]["actuators"], 2)

    def test_clips_are_found_in_a_folder_that_is_named(self):
        self.tone("elsewhere/tone.json")
        self.scene(plays=[{"clip": "tone.json"}])
        self.fails(1, ["render", "a.scene.json"],
                   "pacini: a.scene.json: plays[0].clip: tone.json: is not one of the scene's clips")
        self.succeeds("render", "a.scene.json", "--clips", "elsewhere")

    def test_errors_name_their_place_and_leave_no_output(self):
        self.tone()
        play = {"clip": "tone.json"}
        for members, says in (
                ({"clips": ["tone.json", "door.pacb"]}, "clips[1]: door.pacb: does not exist"),
                ({"plays": [play, {"clip": 4}]}, "plays[1].clip: is 4, but the scene has 0 clips"),
                ({"plays": [play, {**play, "loop": True}]}, "plays[1].passes: is needed"),
                ({"plays": [{**play, "pan": 2}]}, "plays[0].pan: must be 0 to 1"),
                ({"plays": [{**play, "gain": "loud"}]}, "plays[0].gain: is a text; a number is needed"),
                ({"plays": [play], "changes": [{"time": 0, "play": "x", "parameter": "gain", "value": 0}]},
                 "changes[0].play: is \"x\", which no play is called"),
                ({"actuators": 99}, "actuators: is 99; a whole number from 1 to 16 is needed"),
                ({"version": 2}, "version: was written by a newer version (2)"),
                ({"duration": 90000}, "duration: is outside"),
                ({"x": json.loads("[" * 40 + "]" * 40)}, "more than 32 levels of objects and lists")):
            self.scene(**members)
            self.fails(1, ["render", "a.scene.json", "-o", "out.wav"], "pacini: a.scene.json: " if members.get("x") is None
                       else "a.scene.json", says)
            self.assertNotIn("out.wav", self.names())
        self.put("a.scene.json", '{"format": "pacini.scene", "version": 1, "gain": NaN}')
        self.fails(1, ["render", "a.scene.json"], "a.scene.json: line 1, column ")
        self.tone("tone.json", seconds=-1)
        self.scene(clips=["tone.json"])
        self.fails(1, ["render", "a.scene.json"], "a.scene.json: clips[0]: tone.json: duration: is outside")

    def test_a_bad_scene_does_not_stop_the_others(self):
        self.tone()
        self.scene("a.scene.json", plays=[{"clip": "none.json"}])
        self.scene("b.scene.json", plays=[{"clip": "tone.json"}])
        done = self.fails(1, ["render", "a.scene.json", "b.scene.json", "-o", "out", "--json"], "plays[0].clip")
        report = json.loads(done.stdout)
        self.assertEqual([f["output"] for f in report["files"]], ["out/b.scene.wav"])
        self.assertEqual(report["failures"][0]["where"], "plays[0].clip")

    def test_a_signal_half_way_leaves_no_output(self):
        self.tone()
        self.scene(duration=3600, actuators=8, plays=[{"clip": "tone.json", "loop": True}] * 4)
        process = self.started("render", "a.scene.json", "-o", "out.wav", until=self.writes)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGTERM)
        self.assertEqual(self.names(), ["a.scene.json", "tone.json"])

    if not SANITIZED:  # sanitizers need memory of their own

        def test_ten_thousand_plays_stay_in_bounded_memory(self):
            self.tone("click.json", seconds=0.05)
            self.scene(plays=[{"clip": "click.json", "start": 0.01 * i, "pan": (i % 7) / 6} for i in range(10000)],
                       actuators=2)
            peak = peak_of(["render", "a.scene.json", "-o", "out.wav", "--rate", str(RATE)], self.folder)
            # The plan takes a few kB for each play; ten thousand decoders would take a gigabyte.
            self.assertLess(peak, 150_000_000)
            self.assertEqual(len(read_channels(self.folder / "out.wav")[1][0]), round(100.04 * RATE))

    def test_the_shipped_scene_plays_the_demo_sounds(self):
        self.succeeds("encode", str(SOURCE / "Resources/demo"), "-o", "clips", "--format", "packed")
        scene = SOURCE / "Resources/demo/workshop.scene.json"
        report = self.report("render", str(scene), "-o", "out.wav", "--clips", "clips", "--measured")["files"][0]
        self.assertEqual(report["plan"]["actuators"], 3)
        self.assertLess(report["plan"]["predictedError"] or -999, -60)
        rate, channels = read_channels(self.folder / "out.wav")
        self.assertTrue(all(rms(channel) > 0.01 for channel in channels))
        self.assertLessEqual(report["peak"], 1.0)


if __name__ == "__main__":
    unittest.main()
