"""End to end: pacini lint says what a format will lose, and can gate."""
import json
import unittest

from command import CommandTest


class Lint(CommandTest):
    def losses(self, *arguments):
        return self.report("lint", *arguments)["files"][0]["losses"]

    def test_the_targets_are_listed(self):
        text = self.succeeds("lint", "--targets")
        self.assertRegex(text, r"(?m)^haptic +\.haptic ")
        self.assertRegex(text, r"(?m)^ahap +\.ahap ")

    def test_a_clip_that_fits_loses_nothing(self):
        self.clip(transients=[])
        self.assertEqual(self.losses("clip.json", "--target", "haptic"), [])
        self.assertIn("loses nothing", self.succeeds("lint", "clip.json", "--target", "haptic"))

    def test_losses_have_a_place_and_a_size(self):
        band = {"lowFrequency": 80, "centreFrequency": 100, "highFrequency": 125, "priority": 0,
                "amplitude": [{"time": 0, "amplitude": 0.5}, {"time": 2, "amplitude": 0.5}], "pitch": []}
        high = dict(band, lowFrequency=700, centreFrequency=800, highFrequency=900,
                    amplitude=[{"time": 0, "amplitude": 0}, {"time": 1, "amplitude": 0}, {"time": 1, "amplitude": 0.5},
                               {"time": 2, "amplitude": 0.5}])
        self.clip(seconds=2.0, envelope=[], bands=[band, high], markers=[{"time": 0.5, "name": "here"}],
                  transients=[{"time": 0.5, "amplitude": 1, "sharpness": 0.5},
                              {"time": 0.504, "amplitude": 1, "sharpness": 0.5}])
        losses = {loss["kind"]: loss for loss in self.losses("clip.json", "--target", "haptic")}
        self.assertTrue({"bands", "text", "transient"} <= set(losses), losses)
        self.assertAlmostEqual(losses["bands"]["time"], 1.0, places=3)
        self.assertAlmostEqual(losses["bands"]["error"], 0.5, places=2)
        self.assertAlmostEqual(losses["transient"]["time"], 0.504, places=3)
        self.assertEqual(losses["transient"]["error"], 1)
        merged = {loss["kind"]: loss for loss in self.losses("clip.json", "--target", "haptic", "--events", "merged")}
        self.assertAlmostEqual(merged["crowding"]["time"], 0.504, places=3)
        low = dict(band, amplitude=[{"time": 0, "amplitude": 0.5}, {"time": 1, "amplitude": 0.5},
                                    {"time": 1, "amplitude": 0}, {"time": 2, "amplitude": 0}])
        self.clip(seconds=2.0, envelope=[], bands=[low, high], transients=[])  # the voice has to follow the high one
        losses = {loss["kind"]: loss for loss in self.losses("clip.json", "--target", "haptic")}
        self.assertEqual(set(losses), {"frequency"})
        self.assertAlmostEqual(losses["frequency"]["time"], 1.0, places=3)
        self.assertAlmostEqual(losses["frequency"]["error"], 2.0, places=3)  # 800 Hz are two octaves above 200 Hz

    def only(self, kind, target, *arguments):
        """The one loss of a kind that the clip has in a format."""
        found = [loss for loss in self.losses("clip.json", "--target", target, *arguments) if loss["kind"] == kind]
        self.assertEqual(len(found), 1, found)
        return found[0]

    def test_too_dense_parts_are_said_where_they_are(self):
        dense = [{"time": 1 + i / 500, "amplitude": 0.2 + 0.6 * (i % 2)} for i in range(501)]
        self.clip(seconds=4.0, transients=[], envelope=[{"time": 0, "amplitude": 0.2}] + dense
                  + [{"time": 4, "amplitude": 0.2}])
        for target in ("haptic", "ahap", "haps", "android"):
            with self.subTest(target):
                losses = [loss for loss in self.losses("clip.json", "--target", target) if loss["kind"] == "points"
                          and not loss["message"].startswith(("waveform", "envelopes"))]
                self.assertTrue(losses)
                self.assertGreaterEqual(min(loss["time"] for loss in losses), 0.9)
                self.assertLessEqual(max(loss["time"] + loss["duration"] for loss in losses), 2.3)
                self.assertGreater(max(loss["error"] for loss in losses), 0.2)

    def test_parts_too_weak_to_be_felt_are_said_where_they_are(self):
        levels = [(0, 0.5), (1, 0.5), (1, 0.002), (2.5, 0.002), (2.5, 0.5), (3, 0.5)]
        self.clip(seconds=3.0, transients=[],
                  envelope=[{"time": time, "amplitude": level} for time, level in levels])
        for target in ("haptic", "ahap", "haps", "android", "tact"):
            with self.subTest(target):
                empty = self.only("empty", target)
                self.assertAlmostEqual(empty["time"], 1.0, places=3)
                self.assertAlmostEqual(empty["duration"], 1.5, places=3)
                self.assertAlmostEqual(empty["error"], 0.002, places=4)
        self.clip(bands=[], transients=[], envelope=[])
        self.assertEqual(self.only("empty", "haptic")["duration"], 1.0)

    def test_lengths_times_and_amplitudes_that_cannot_be_said_have_their_size(self):
        self.clip(seconds=0.004, transients=[],
                  envelope=[{"time": 0, "amplitude": 0.5}, {"time": 0.004, "amplitude": 0.5}])
        self.assertAlmostEqual(self.only("length", "haptic")["error"], 0.006)
        self.fails(1, ["lint", "clip.json", "--target", "haptic", "--max-time", "0.001"], "more than is allowed")
        self.clip()
        self.assertAlmostEqual(self.only("timeStep", "tact")["error"], 0.010)
        self.clip(transients=[], envelope=[{"time": 0, "amplitude": 0.5}, {"time": 0.5, "amplitude": 1.5},
                                                     {"time": 1, "amplitude": 0.5}])
        for target in ("haptic", "ahap", "haps", "android", "tact"):
            with self.subTest(target):
                above = self.only("amplitude", target)
                self.assertAlmostEqual(above["time"], 0.5, places=3)
                self.assertAlmostEqual(above["error"], 0.5, places=3)

    def test_noise_is_said_where_it_sounds_and_how_strong(self):
        levels = [(0, 0), (1, 0), (1, 0.3), (2, 0.3), (2, 0), (3, 0)]
        self.clip(seconds=3.0, transients=[],
                  noise=[{"lowFrequency": 100, "highFrequency": 200,
                          "amplitude": [{"time": time, "amplitude": level} for time, level in levels]}])
        for target in ("haptic", "ahap", "haps", "android", "tact", "hjif"):
            with self.subTest(target):
                noise = self.only("noise", target)
                self.assertAlmostEqual(noise["time"], 1.0, places=3)
                self.assertAlmostEqual(noise["duration"], 1.0, places=3)
                self.assertAlmostEqual(noise["error"], 0.3, places=3)
        self.fails(1, ["lint", "clip.json", "--target", "haptic", "--fail-on", "noise"], "more than is allowed")
        self.clip(transients=[])
        self.assertNotIn("noise", [loss["kind"] for loss in self.losses("clip.json", "--target", "hjif")])

    def test_what_events_lose_is_said_where_they_are_and_how_much(self):
        steady = {"lowFrequency": 80, "centreFrequency": 100, "highFrequency": 125, "priority": 0,
                  "amplitude": [{"time": 0, "amplitude": 0.8}, {"time": 1, "amplitude": 0.8}], "pitch": []}
        weak = [{"time": 0.25, "amplitude": 0.9, "sharpness": 0.5}, {"time": 0.5, "amplitude": 0.3, "sharpness": 0.5}]
        self.clip(envelope=[], bands=[steady], transients=weak)  # one voice: keeps all events
        raised = self.only("event", "haptic")  # no emphasis may be weaker than its point
        self.assertAlmostEqual(raised["time"], 0.5, places=3)
        self.assertAlmostEqual(raised["error"], 0.5, places=3)
        self.fails(1, ["lint", "clip.json", "--target", "haptic", "--max-error", "0.4"], "more than is allowed")
        self.succeeds("lint", "clip.json", "--target", "haptic", "--max-error", "0.6")
        for target in ("haps", "tact", "android"):  # no sharpness
            with self.subTest(target):
                lost = self.only("event", target)
                self.assertAlmostEqual(lost["time"], 0.25, places=3)
                self.assertAlmostEqual(lost["duration"], 0.25, places=3)
                self.assertEqual(lost["error"], 0)
        dull = [loss for loss in self.losses("clip.json", "--target", "hjif") if loss["kind"] == "event"]
        self.assertAlmostEqual(dull[0]["time"], 0.25, places=3)
        self.assertIn("22 ms", dull[0]["message"])
        train = [dict(weak[0], time=0.25 + 0.03 * i) for i in range(3)]
        self.clip(envelope=[], bands=[steady], transients=train)
        waves = self.only("event", "hjif", "--events", "merged")
        self.assertAlmostEqual(waves["time"], 0.25, places=3)
        self.assertIn("short waves", waves["message"])
        several = [dict(steady, lowFrequency=70 * i, centreFrequency=75 * i, highFrequency=80 * i)
                   for i in range(1, 8)]
        self.clip(bands=several, transients=[])
        self.assertRegex(self.only("bands", "hjif")["message"], "^7 bands share [456] voices$")  # what is most alike
        self.clip(envelope=[], bands=several, transients=[])  # nothing to level: bands stay as they are
        self.assertNotIn("bands", [loss["kind"] for loss in self.losses("clip.json", "--target", "hjif")])
        self.clip(transients=[weak[0], dict(weak[1], amplitude=0.2)])  # the second is reached by the envelope
        left = self.only("transient", "ahap", "--events", "merged")
        self.assertAlmostEqual(left["time"], 0.5, places=3)
        self.assertIn("dropped: ", left["message"])

    def test_a_limit_gates(self):
        points = [{"time": i / 1000, "amplitude": i % 2} for i in range(1001)]
        self.clip(envelope=points)
        self.succeeds("lint", "clip.json", "--target", "haptic")
        self.fails(1, ["lint", "clip.json", "--target", "haptic", "--max-error", "0.1"], "more than is allowed")
        self.succeeds("lint", "clip.json", "--target", "haptic", "--max-error", "2")
        self.fails(1, ["lint", "clip.json", "--target", "haptic", "--fail-on", "points"], "more than is allowed")
        done = self.run_command("lint", "clip.json", "--target", "haptic", "--max-error", "0.1", "--json")
        self.assertFalse(json.loads(done.stdout)["files"][0]["ok"])

    def test_wrong_usage_and_bad_files_are_said(self):
        self.clip()
        self.fails(2, ["lint", "clip.json"], "needs --target")
        self.fails(2, ["lint", "--target", "haptic"], "missing")
        self.fails(2, ["lint", "clip.json", "--target", "nothing"], "--target")
        self.fails(2, ["lint", "clip.json", "--points", "9"], "--points: needs a format to check", "--target")
        self.fails(2, ["lint", "clip.json", "--target", "tact", "--points", "9"], "--points: has no effect in tact")
        self.put("bad.haptic", "[]")
        self.fails(1, ["lint", "bad.haptic", "--target", "ahap"], "bad.haptic: ")


if __name__ == "__main__":
    unittest.main()
