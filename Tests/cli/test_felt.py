"""End to end: what a body model says is felt, from pacini render --felt, and actuators from pacini plot."""
import cmath
import json
import math
import unittest
from xml.etree import ElementTree

from command import SOURCE, CommandTest, read_float_wav, rms
from test_scenes import read_channels

SVG = "{http://www.w3.org/2000/svg}"
RATE = 48000
FULL_SCALE = 100  # m/s^2, the default
WITH_WAVES = ["l5-wristband", "l5-test-jig", "lra-175", "quest-controller", "wideband-exciter"]  # bodies without a motor


def profile_of(name):
    return json.loads((SOURCE / f"profiles/{name}.json").read_text())


def solved(matrix, right):
    """Gaussian elimination with the largest pivot."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    n = len(rows)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    x = [0j] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def skin_acceleration(profile, frequency):
    """m/s^2 of the skin for a force of `body.force`, from the equations of motion (Weber 2020, Fig. 3.2): in the coil,
    or on the device with its eccentric mass when the profile is a motor's."""
    body, resonance = profile["body"], profile["resonance"]
    s = 2j * math.pi * frequency
    w = 2 * math.pi * resonance["frequency"]
    moving, device, skin = body["movingMass"], body["deviceMass"], body["skinMass"]
    hanging = moving * w * w + s * moving * w / resonance["q"]
    joint = body["jointStiffness"] + s * body["jointDamping"]
    tissue = body["skinStiffness"] + s * body["skinDamping"]
    force = body["force"]
    if profile["technology"] == "erm":
        x = solved([[(moving + device) * s * s + joint, -joint], [-joint, skin * s * s + joint + tissue]], [force, 0])
    else:
        x = solved([[moving * s * s + hanging, -hanging, 0],
                    [-hanging, device * s * s + hanging + joint, -joint],
                    [0, -joint, skin * s * s + joint + tissue]], [force, -force, 0])
    return x[-1] * s * s


def phasor(samples, frequency):
    """Complex amplitude of the sine of `frequency` in a last second of samples; whole periods need no window."""
    step = cmath.exp(-2j * math.pi * frequency / RATE)
    total, turn = 0j, 1 + 0j
    for i, x in enumerate(samples[-RATE:]):
        if i % 1000 == 0:
            turn = cmath.exp(-2j * math.pi * frequency * i / RATE)  # rounding must not add up
        total += x * turn
        turn *= step
    return 2 * total / RATE


def rising_crossings(samples):
    """Where, in samples, the signal passes zero upwards."""
    return [i + a / (a - b) for i, (a, b) in enumerate(zip(samples, samples[1:])) if a < 0 <= b]


class Felt(CommandTest):
    def steady(self, frequency=100, level=0.5, seconds=2.0):
        curve = [{"time": 0, "amplitude": level}, {"time": seconds, "amplitude": level}]
        band = {"lowFrequency": frequency, "centreFrequency": frequency, "highFrequency": frequency, "priority": 0,
                "amplitude": curve, "pitch": []}
        self.clip(seconds=seconds, envelope=curve, bands=[band], transients=[])

    def rendered(self, profile, *options, name="out.wav", clip="clip.json"):
        self.succeeds("render", clip, "-o", name, "--profile", profile, *options)
        return read_float_wav(self.folder / name)[1]

    def test_strength_wins_back_what_flattening_costs_and_0_is_as_flat_as_can_be(self):
        self.succeeds("encode", str(SOURCE / "Resources/demo/iter_drum_roll.flac"), "-o", "roll.json", "--audible", "0")
        for profile in ("lra-175", "lra-235-narrow", "phone-taptic"):
            def level(*options):
                return 20 * math.log10(rms(self.rendered(profile, "--felt", "-f", *options, clip="roll.json")))

            plain = level("--max-boost", "0")
            levels = [level("--strength", strength) for strength in ("0", "0.2", "0.4", "0.6", "0.8", "1")]
            self.assertEqual(levels, sorted(levels), profile)
            self.assertLess(levels[0], plain - 4, profile)
            self.assertGreater(level(), plain - 3, profile)  # the default
            self.assertEqual(level(), levels[2], profile)
        for strength in ("-0.1", "1.1", "nan", "strong"):
            self.fails(2, ["render", "roll.json", "--profile", "lra-175", "--strength", strength], "--strength")

    def test_strength_leaves_a_motor_and_a_plain_signal_as_they_are(self):
        self.steady()
        for profile in ("erm-coin", "flat-pcm"):
            self.assertEqual(self.rendered(profile, "-f", "--strength", "0"),
                             self.rendered(profile, "-f", "--strength", "1"), profile)

    def test_a_demo_sound_is_felt_on_a_voice_coil_and_on_a_motor(self):
        self.succeeds("encode", str(SOURCE / "Resources/demo/knock_wood_bridge.flac"), "-o", "knock.json")
        for profile in ("l5-wristband", "erm-coin"):
            drive = self.rendered(profile, clip="knock.json")
            report = self.report("render", "knock.json", "-o", "felt.wav", "--profile", profile, "--felt")["files"][0]
            felt = read_float_wav(self.folder / "felt.wav")[1]
            self.assertEqual(len(felt), len(drive))
            self.assertTrue(all(math.isfinite(x) for x in felt))
            peak = max(map(abs, felt))
            self.assertAlmostEqual(report["peak"], peak, delta=1e-6 * peak)
            self.assertAlmostEqual(report["feltPeak"], FULL_SCALE * peak, delta=1e-3 * peak)
            self.assertEqual((report["feltFullScale"], report["wearer"]), (FULL_SCALE, 0))
            # No more than the force on the skin alone, no less than a hundredth of it on everything.
            body = profile_of(profile)["body"]
            masses = body["movingMass"] + body["deviceMass"] + body["skinMass"]
            self.assertGreater(report["feltPeak"], 0.01 * body["force"] / masses)
            self.assertLess(report["feltPeak"], body["force"] / body["skinMass"])
            text = self.succeeds("render", "knock.json", "-o", "felt.wav", "--profile", profile, "--felt")
            self.assertRegex(text, rf", peak {report['feltPeak']:.3g} m/s2\n$")

    def test_a_tone_is_felt_as_the_equations_of_motion_say_and_when_they_say(self):
        self.steady(100)
        for name in WITH_WAVES:
            profile = profile_of(name)
            options = ("--no-adapt", "--no-protection")
            drive = phasor(self.rendered(name, *options), 100) * profile["drive"]["overdrive"]
            felt = phasor(self.rendered(name, "--felt", *options), 100) * FULL_SCALE
            wanted = drive * skin_acceleration(profile, 100)
            self.assertGreater(abs(drive), 0.01)
            self.assertAlmostEqual(abs(felt) / abs(wanted), 1.0, delta=1e-4, msg=name)
            # One frame late would be 0.013 rad.
            self.assertAlmostEqual(cmath.phase(felt / wanted), 0.0, delta=1e-4, msg=name)

    def test_a_motor_that_turns_steadily_is_felt_at_the_frequency_and_strength_of_its_speed(self):
        profile = profile_of("erm-coin")
        for level in (1.0, 0.5):
            self.steady(160, level)
            speed = self.rendered("erm-coin")[-1] * profile["drive"]["overdrive"]
            self.assertGreater(speed, 0.3)
            felt = self.rendered("erm-coin", "--felt")[-RATE:]
            crossings = rising_crossings(felt)
            frequency = RATE * (len(crossings) - 1) / (crossings[-1] - crossings[0])
            self.assertAlmostEqual(frequency / (speed * profile["resonance"]["frequency"]), 1.0, delta=1e-3)
            wanted = speed ** 2 * abs(skin_acceleration(profile, frequency))
            self.assertAlmostEqual(FULL_SCALE * math.sqrt(2) * rms(felt) / wanted, 1.0, delta=0.01)

    def test_full_scale_divides(self):
        self.clip()
        plain = self.rendered("lra-175", "--felt")
        tenth = self.rendered("lra-175", "--felt", "--felt-full-scale", "1000")
        self.assertLess(max(abs(a - 10 * b) for a, b in zip(plain, tenth)), 1e-6 * max(map(abs, plain)))
        report = self.report("render", "clip.json", "--profile", "lra-175", "--felt", "--felt-full-scale", "20.5")
        self.assertEqual(report["files"][0]["feltFullScale"], 20.5)
        self.assertAlmostEqual(report["files"][0]["feltPeak"], FULL_SCALE * max(map(abs, plain)), places=3)

    def test_wearers_differ_and_stay_the_same_people(self):
        self.clip(seconds=0.2)
        of = lambda wearer: self.rendered("l5-wristband", "--felt", "--wearer", str(wearer))
        wearers = [of(wearer) for wearer in range(15)]
        self.assertEqual(wearers[0], self.rendered("l5-wristband", "--felt"))
        self.assertEqual(wearers[9], of(9))
        self.assertEqual(len(set(wearers)), 15)
        report = self.report("render", "clip.json", "--profile", "l5-wristband", "--felt", "--wearer", "9")
        self.assertEqual(report["files"][0]["wearer"], 9)

    def test_each_actuator_of_a_scene_is_felt_by_itself(self):
        self.clip()
        alone = self.rendered("l5-wristband", "--felt")
        self.put("two.scene.json", json.dumps({"format": "pacini.scene", "version": 1, "actuators": 2,
                                               "clips": ["clip.json"], "plays": [{"clip": "clip.json", "pan": 1}]}))
        self.succeeds("render", "two.scene.json", "-o", "two.wav", "--profile", "l5-wristband", "--felt", "--measured")
        left, right = read_channels(self.folder / "two.wav")[1]
        self.assertEqual(max(map(abs, left)), 0.0)
        difference = max(abs(a - b) for a, b in zip(alone, right))
        self.assertLess(difference, 1e-3 * max(map(abs, alone)))

    def test_clipping_of_integer_samples_is_told_and_its_cure_works(self):
        self.steady(100, 1.0, 0.5)
        options = ["render", "clip.json", "-o", "out.wav", "--profile", "l5-wristband", "--felt", "--encoding", "pcm16"]
        done = self.fails(0, [*options, "--felt-full-scale", "1"], "warning: ", "samples were clipped",
                          "--felt-full-scale ")
        cure = done.stderr.decode().split("--felt-full-scale ")[1].split()[0]
        self.succeeds(*options, "--felt-full-scale", cure)

    def test_a_profile_without_a_body_and_wrong_options_are_one_line(self):
        self.clip()
        self.fails(1, ["render", "clip.json", "-o", "out.wav", "--profile", "flat-pcm", "--felt"],
                   "pacini: flat-pcm: body: is missing", "l5-wristband", "erm-coin")
        self.fails(2, ["render", "clip.json", "--felt"], "--felt", "--profile", "pacini render --help")
        for option, value in (("--wearer", "15"), ("--wearer", "-1"), ("--wearer", "light"),
                              ("--felt-full-scale", "0"), ("--felt-full-scale", "nan")):
            self.fails(2, ["render", "clip.json", "--profile", "l5-wristband", "--felt", option, value], option)
        for option in ("--wearer", "--felt-full-scale"):
            self.fails(2, ["render", "clip.json", "--profile", "l5-wristband", option, "1"], option, "--felt")
        self.assertEqual(self.names(), ["clip.json"])


class Actuators(CommandTest):
    def groups(self, path):
        """Name of each group of an SVG with the points of the paths that lie directly in it."""
        found = {}
        for group in ElementTree.parse(path).getroot().iter(SVG + "g"):
            title = group.find(SVG + "title")
            for drawn in group.findall(SVG + "path") if title is not None else []:
                points = [tuple(map(float, pair.split()))
                          for pair in drawn.get("d").replace("M", "L").strip("LZ").split("L")]
                found.setdefault(title.text, []).append(points)
        return found

    def test_every_shipped_profile_is_drawn(self):
        for path in sorted((SOURCE / "profiles").glob("*.json")):
            profile = json.loads(path.read_text())
            report = self.report("plot", path.stem, "-o", f"{path.stem}.png", "--size", "800x500")
            picture = (self.folder / f"{path.stem}.png").read_bytes()
            self.assertEqual((picture[:4], len(picture)), (b"\x89PNG", report["bytes"]))
            self.succeeds("plot", str(path), "-o", "p.svg", "--dark")
            self.assertEqual(ElementTree.parse(self.folder / "p.svg").getroot().find(SVG + "title").text,
                             profile["name"])
            names = self.groups(self.folder / "p.svg")
            motor = profile["technology"] == "erm"
            self.assertEqual("14 other wearers" in names, "body" in profile, path.stem)
            self.assertEqual("drive to skin" in names, "body" in profile and not motor, path.stem)
            self.assertEqual("motor to skin" in names, motor, path.stem)
            self.assertEqual("output filter" in names, not motor, path.stem)
            self.assertTrue(any(name.startswith("range ") for name in names), path.stem)

    def test_the_curve_is_the_response_of_the_body(self):
        for name in [*WITH_WAVES, "erm-coin"]:
            profile = profile_of(name)
            self.succeeds("plot", name, "-o", "p.svg")
            names = self.groups(self.folder / "p.svg")
            motor = profile["technology"] == "erm"
            ground = next(points[0] for key, points in names.items() if key.startswith("range "))
            span = [profile["range"]["lowFrequency"], profile["range"]["highFrequency"]]
            left, right = min(x for x, _ in ground), max(x for x, _ in ground)
            points = names["motor to skin" if motor else "drive to skin"][0]
            wanted, found = [], []
            for x, y in points:
                f = span[0] * (span[1] / span[0]) ** ((x - left) / (right - left))
                if not 25 <= f <= 1000:
                    continue
                force = (f / profile["resonance"]["frequency"]) ** 2 if motor else 1.0
                wanted.append(20 * math.log10(force * abs(skin_acceleration(profile, f))))
                found.append(y)
            self.assertGreater(len(wanted), 200)
            # Whatever the axis: a straight line from decibels to pixels.
            n = len(wanted)
            mean_w, mean_f = sum(wanted) / n, sum(found) / n
            slope = (sum((w - mean_w) * (f - mean_f) for w, f in zip(wanted, found))
                     / sum((w - mean_w) ** 2 for w in wanted))
            self.assertLess(slope, 0)
            worst = max(abs(mean_w + (f - mean_f) / slope - w) for w, f in zip(wanted, found))
            self.assertLess(worst, 0.1, name)  # dB; a pixel is about 0.1

    def test_what_belongs_to_clips_is_a_usage_error(self):
        for option in (["--from", "1"], ["--to", "1"], ["--sound", "a.wav"], ["--profile", "piezo"]):
            self.fails(2, ["plot", "l5-wristband", *option], "pacini: l5-wristband: is a profile", option[0])
        content = profile_of("lra-175")
        content["technology"] = "motor"
        self.put("p.json", json.dumps(content))
        self.fails(1, ["plot", "p.json", "-o", "p.png"], "pacini: p.json: technology: must be ")
        self.assertEqual(self.names(), ["p.json"])


if __name__ == "__main__":
    unittest.main()
