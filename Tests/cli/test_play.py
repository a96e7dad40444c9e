"""End to end: what pacini play would send. What is really sent is tried in hid/check_play.py."""
import unittest

from command import CommandTest

# kind: (s between packets, bytes of a report, reports before the first packet, after the last silent one)
KINDS = {"switch": (0.015, 10, 1, 0), "switch-usb": (0.015, 10, 3, 0), "dualshock4": (0.010, 32, 0, 0),
         "dualshock4-bluetooth": (0.010, 78, 0, 0), "dualsense": (0.010, 48, 0, 1),
         "dualsense-bluetooth": (0.032 / 3, 142, 1, 1), "xbox": (0.016, 9, 0, 0), "waveforms": (0.020, 6, 0, 0)}


class Play(CommandTest):
    def listed(self, *arguments):
        """[(time, bytes)] that would be sent."""
        lines = self.succeeds("play", "clip.json", "--dry-run", *arguments).splitlines()
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

    def test_packets_as_json_are_those_of_the_list(self):
        self.clip()
        report = self.report("play", "clip.json", "--dry-run", "--like", "switch")
        self.assertEqual([bytes.fromhex(packet["bytes"]) for packet in report["packets"]],
                         [report for _, report in self.listed("--like", "switch")])

    def test_wrong_usage_is_told(self):
        self.clip()
        self.fails(2, ["play"], "the input file is missing")
        self.fails(2, ["play", "clip.json", "--dry-run", "--loop"], "--loop has no end")
        self.fails(2, ["play", "clip.json", "--like", "switch"], "--like needs --dry-run")
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "stone"], "--like")
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "xbox", "--device", "1"], "--like and --device exclude each other")
        self.fails(2, ["play", "clip.json", "--dry-run", "--like", "xbox", "--wait"], "--wait and --dry-run exclude each other")
        self.fails(1, ["play", "clip.json", "--dry-run", "--like", "xbox", "--from", "3"], "clip.json", "nothing between")
        self.fails(1, ["play", "none.json", "--dry-run", "--like", "xbox"], "none.json")


if __name__ == "__main__":
    unittest.main()
