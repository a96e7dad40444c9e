"""End to end: what pacini play would send. What is really sent is tried in hid/check_play.py."""
import json
import math
import unittest

from command import CommandTest

# kind: (s between packets, bytes of a report, reports before the first packet, after the last silent one)
KINDS = {"switch": (0.015, 10, 1, 0), "switch-usb": (0.015, 10, 3, 0), "dualshock4": (0.010, 32, 0, 0),
         "dualshock4-bluetooth": (0.010, 78, 0, 0), "dualsense": (0.010, 48, 0, 1),
         "dualsense-bluetooth": (0.032 / 3, 142, 1, 1), "xbox": (0.016, 9, 0, 0), "waveforms": (0.020, 6, 0, 0)}


#: What is said of a DualSense on a cable.
SOUND = r"^pacini: clip.json: warning: .* plays samples by its sound device, .*(these are the packets of|this is lost by) " \
        r"its rumble.*\n$"


class Play(CommandTest):
    def listed(self, *arguments):
        """[(time, bytes)] that would be sent."""
        done = self.run_command("play", "clip.json", "--dry-run", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        # A DualSense on a cable plays by its sound device, unless it is told otherwise.
        self.assertRegex(done.stderr.decode(), SOUND if "dualsense" in arguments and "rumble" not in arguments else "^$")
        lines = done.stdout.decode().splitlines()
        return [(float(line.split()[0]), bytes.fromhex(line.split(maxsplit=1)[1])) for line in lines]

    def test_every_kind_of_controller_gets_its_reports_at_its_times(self):
        self.clip()
        for kind, (interval, size, before, after) in KINDS.items():
            packets = self.listed("--like", kind)
            stream = packets[before:len(packets) - after]
            with self.subTest(kind):
                self.assertEqual({len(report) for _, report in stream}, {size})
                self.assertGreater(len(stream), 50)
                start = before * interval
                for time, _ in stream:
                    steps = (time - start) / interval
                    self.assertAlmostEqual(steps, round(steps), delta=0.01)
                self.assertLess(stream[-1][0], 1.3)

    def test_a_part_and_an_intensity_are_kept_to(self):
        self.clip(seconds=2.0)
        part = self.listed("--like", "xbox", "--from", "0.9", "--to", "1.1")
        self.assertLess(part[-1][0], 0.3)
        loud = max(report[4] for _, report in part)
        curve = [0.04 + 0.96 * level ** (1 / 1.5) for level in (0.5, 0.25)]  # that of the heavy motor
        self.assertAlmostEqual(loud, 100 * curve[0], delta=1)  # the clip's 0.5
        soft = max(report[4] for _, report in self.listed("--like", "xbox", "--from", "0.9", "--to", "1.1",
                                                          "--intensity", "-6"))
        self.assertAlmostEqual(soft, 100 * curve[1], delta=1)

    def test_a_dualsense_is_sent_what_it_is_told_to(self):
        self.clip()
        for way, size in (("samples", 142), ("long-samples", 398), ("rumble", 78)):
            packets = self.listed("--like", "dualsense-bluetooth", "--dualsense", way)
            self.assertEqual({len(report) for _, report in packets[1:-1]}, {size}, way)
            self.assertEqual({len(report) for _, report in self.listed("--like", "dualsense", "--dualsense", way)}, {48}, way)
        self.assertEqual(self.listed("--like", "dualsense-bluetooth"),
                         self.listed("--like", "dualsense-bluetooth", "--dualsense", "samples"))
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "dualsense", "--dualsense", "organ"], "--dualsense")

    def test_a_profile_is_what_the_drive_is_made_for(self):
        self.clip()
        plain = self.listed("--like", "steam")
        self.assertNotEqual(self.listed("--like", "steam", "--profile", "quest-controller"), plain)
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "xbox", "--profile", "phone-erm"], "--profile", "is a motor")
        self.fails(1, ["play", "clip.json", "--dry-run", "--like", "xbox", "--profile", "none.json"], "none.json")

    def test_a_clip_that_was_designed_on_another_actuator_is_played_as_it_is_rendered(self):
        self.clip()
        plain = self.listed("--like", "steam", "--profile", "l5-wristband")
        self.assertNotEqual(self.listed("--like", "steam", "--profile", "l5-wristband", "--designed-for", "bass-shaker"), plain)
        self.assertEqual(self.listed("--like", "steam", "--profile", "l5-wristband", "--designed-for", "l5-wristband"), plain)
        told = self.run_command("play", "clip.json", "--dry-run", "--like", "steam", "--profile", "lra-175",
                                "--designed-for", "l5-wristband").stderr.decode()
        self.assertIn("pacini: clip.json: warning: 1 of 1 bands lie outside of 160 to 197 Hz", told)
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "steam", "--designed-for", "lra-175"], "--profile")
        self.fails(1, ["play", "clip.json", "--dry-run", "--like", "steam", "--profile", "lra-175", "--designed-for",
                       "phone-erm"], "clip.json: --designed-for: technology")

    def test_packets_as_json_are_those_of_the_list(self):
        self.clip()
        report = self.report("play", "clip.json", "--dry-run", "--like", "switch")
        self.assertEqual([bytes.fromhex(packet["bytes"]) for packet in report["packets"]],
                         [report for _, report in self.listed("--like", "switch")])

    def losses(self, *arguments):
        """The losses of clip.json that --explain lists; the lines say the same, and nothing needs to be connected."""
        done = [self.run_command("play", "clip.json", "--explain", *arguments, *more) for more in (["--json"], [])]
        for one in done:
            self.assertEqual(one.returncode, 0, one.stderr)
            self.assertRegex(one.stderr.decode(), SOUND if "dualsense" in arguments and "rumble" not in arguments else "^$")
        report, lines = json.loads(done[0].stdout), done[1].stdout.decode().splitlines()
        self.assertEqual(len([line for line in lines if " s " in line]), len(report["losses"]))
        for loss, line in zip(report["losses"], lines):
            self.assertEqual(set(loss), {"kind", "time", "duration", "error", "message"})
            self.assertIn(loss["message"], line)
            self.assertIn(f" {loss['kind']} ", line)
        return report["losses"]

    def kinds(self, *arguments):
        return {loss["kind"] for loss in self.losses(*arguments)}

    def put_clip(self, **parts):
        content = {"format": "pacini.clip", "version": 1, "name": "x", "duration": 1.0, "envelope": [], "centroid": [],
                   "bands": [], "transients": []} | parts
        self.put("clip.json", json.dumps(content))

    @staticmethod
    def band(frequency, amplitude=0.5):
        return {"lowFrequency": 0.9 * frequency, "centreFrequency": frequency, "highFrequency": 1.1 * frequency, "priority": 0,
                "amplitude": [{"time": 0, "amplitude": amplitude}, {"time": 1, "amplitude": amplitude}], "pitch": []}

    def test_explain_says_what_a_controller_cannot_show(self):
        for kind in KINDS:
            self.put_clip(bands=[self.band(160)])
            self.assertEqual(self.losses("--like", kind), [], kind)
        # A motor has its own pitch.
        self.put_clip(bands=[self.band(60)])
        pitch = [loss for loss in self.losses("--like", "dualshock4") if loss["kind"] == "frequency"]
        self.assertEqual(len(pitch), 1)
        self.assertAlmostEqual(pitch[0]["error"], math.log2(160 / 60), delta=0.15)
        self.assertGreater(pitch[0]["duration"], 0.8)
        self.assertNotIn("frequency", self.kinds("--like", "switch"))
        # Above what is there.
        self.put_clip(bands=[self.band(2000)])
        self.assertIn("frequency", self.kinds("--like", "switch"))
        self.assertEqual(self.kinds("--like", "dualsense-bluetooth"), {"frequency"})
        self.assertEqual(self.losses("--like", "steam"), [])
        # Several bands, noise, levels beyond full drive.
        self.put_clip(bands=[self.band(f) for f in (80, 160, 320)],
                      noise=[{"lowFrequency": 80, "highFrequency": 300,
                              "amplitude": [{"time": 0, "amplitude": 0.3}, {"time": 1, "amplitude": 0.3}]}])
        for kind in ("xbox", "switch", "waveforms"):
            self.assertLessEqual({"bands", "noise"}, self.kinds("--like", kind), kind)
        self.put_clip(bands=[self.band(160)])
        for kind in ("xbox", "switch", "waveforms", "dualsense-bluetooth", "steam"):
            self.assertIn("amplitude", self.kinds("--like", kind, "--intensity", "12"), kind)
        # Events: between packets, too near, of any sharpness.
        self.put_clip(transients=[{"time": time, "amplitude": 0.8, "sharpness": 1} for time in (0.1, 0.115, 0.5)])
        for kind in ("dualshock4", "waveforms"):
            self.assertLessEqual({"timeStep", "crowding", "event"}, self.kinds("--like", kind), kind)
        self.assertNotIn("event", self.kinds("--like", "switch"))
        crowded = [loss for loss in self.losses("--like", "dualshock4") if loss["kind"] == "crowding"]
        self.assertEqual([(round(loss["time"], 3), loss["error"]) for loss in crowded], [(0.115, 0.8)])
        # A part has its own times and only its own losses.
        part = self.losses("--like", "dualshock4", "--from", "0.3", "--to", "0.7")
        self.assertNotIn("crowding", {loss["kind"] for loss in part})
        self.assertTrue(all(0.3 <= loss["time"] <= 0.7 for loss in part), part)
        # Nothing that is felt.
        self.put_clip(bands=[self.band(160, 0.001)])
        for kind in ("dualshock4", "switch", "waveforms"):
            self.assertEqual(self.kinds("--like", kind), {"empty"}, kind)

    def test_wrong_usage_is_told(self):
        self.clip()
        self.fails(2, ["play"], "the input file is missing")
        self.fails(2, ["play", "clip.json", "--dry-run", "--loop"], "--loop has no end")
        self.fails(2, ["play", "clip.json", "--like", "switch"], "--like needs --dry-run or --explain")
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "stone"], "--like")
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "xbox", "--device", "1"], "--like and --device exclude each other")
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "xbox", "--wait"], "--wait and --dry-run exclude each other")
        self.fails(2, ["play", "clip.json", "--explain", "--dry-run", "--like", "xbox"], "exclude each other")
        self.fails(2, ["play", "clip.json", "--explain", "--loop", "--like", "xbox"], "--loop has no end")
        self.fails(2, ["play", "clip.json", "--explain", "--wait"], "--wait and --explain exclude each other")
        self.fails(1, ["play", "clip.json", "--dry-run", "--like", "xbox", "--from", "3"], "clip.json", "nothing between")
        self.fails(1, ["play", "none.json", "--dry-run", "--like", "xbox"], "none.json")


if __name__ == "__main__":
    unittest.main()
