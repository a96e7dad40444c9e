"""End to end: what pacini render does to an overdriven actuator, by equations of motion and heat of this file."""
import json
import math
import unittest

from command import CommandTest, read_float_wav

FREQUENCY, Q, EXCURSION, OVERDRIVE, TIME, RATE = 175, 10, 2e-4, 3, 0.2, 16000
# 2 % above the worst that the rated drive can do: a drive that changes its sign with the velocity, and one that stays.
TRAVEL = 1.02 * EXCURSION / math.tanh(math.pi / 2 * 0.05 / math.sqrt(1 - 0.05**2))
POWER = 1.02 * 2 / 8
PROFILE = {
    "format": "pacini.profile", "version": 1, "name": "Overdriven", "technology": "lra",
    "resonance": {"frequency": FREQUENCY, "q": Q}, "range": {"lowFrequency": 100, "highFrequency": 300, "dynamicRange": 60},
    "drive": {"impedance": 8, "maxVoltageRms": 1, "maxPower": POWER, "thermalTime": TIME, "excursion": EXCURSION,
              "maxExcursion": TRAVEL, "overdrive": OVERDRIVE}}


def strain(samples):
    """Travel and heat over their limits: symplectic steps, eight a sample."""
    w, steps = 2 * math.pi * FREQUENCY, 8
    h = 1 / (RATE * steps)
    x = v = farthest = heat = hottest = 0.0
    for sample in samples:
        rest = EXCURSION * OVERDRIVE * sample
        for _ in range(steps):
            v += h * (w * w * (rest - x) - w / Q * v)
            x += h * v
            farthest = max(farthest, abs(x))
        heat += (2 / 8 * (OVERDRIVE * sample)**2 - heat) / (TIME * RATE)
        hottest = max(hottest, heat)
    return farthest / TRAVEL, hottest / POWER


class Limits(CommandTest):
    def setUp(self):
        super().setUp()
        self.put("lra.json", json.dumps(PROFILE))
        tone = {"lowFrequency": 150, "centreFrequency": FREQUENCY, "highFrequency": 200, "priority": 0,
                "amplitude": [{"time": 0, "amplitude": 1}, {"time": 2, "amplitude": 1}]}
        self.clip(seconds=2.0, bands=[tone], envelope=[], transients=[])

    def rendered(self, *options):
        render = ["render", "clip.json", "-o", "out.wav", "--profile", "lra.json", "--rate", str(RATE), "--gain", "12",
                  "--explain", *options]
        flat = options == ("--strength", "0")  # then a tone on the resonance is too weak for the limits
        held_back = not flat and "--no-protection" not in options
        text = self.warns(*render, says="the limiter takes back up to") if held_back else self.succeeds(*render)
        return text, strain(read_float_wav(self.folder / "out.wav")[1])

    def test_an_overdriven_actuator_keeps_its_limits_and_the_plan_says_so(self):
        for options in (["--no-adapt"], ["--max-boost", "0"], [], ["--strength", "0"], ["--strength", "1"]):
            text, (travel, heat) = self.rendered(*options)
            self.assertLess(travel, 1.005, options)
            self.assertLess(heat, 1.001, options)
            if options != ["--strength", "0"]:
                self.assertGreater(max(travel, heat), 0.9, options)
            self.assertIn("protection: travel is kept within its limit; heat is kept within its limit\n", text)

    def test_without_protection_it_does_not_and_the_plan_says_so(self):
        text, (travel, heat) = self.rendered("--no-adapt", "--no-protection")
        self.assertGreater(travel, 2)
        self.assertGreater(heat, 4)
        self.assertIn("protection: is off: the limits of the profile are not enforced", text)


if __name__ == "__main__":
    unittest.main()
