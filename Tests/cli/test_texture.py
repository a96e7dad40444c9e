"""End to end: pacini texture, from the recording of a stroke to a drive signal that follows speed and force."""
import json
import math
import os
import random
import unittest

from command import CommandTest, noise, read_float_wav, rms, sine, wav

RATE = 8000


def strokes(speeds, seconds=2.0, seed=3):
    """Noise around 100 Hz at speed 1, passed at each of the speeds, with a level in proportion to the speed."""
    source = random.Random(seed)
    samples = []
    for speed in speeds:
        f, one, two = 200 * speed, 0.0, 0.0
        radius = math.exp(-2 * math.pi * 0.1 * f / RATE)
        for _ in range(round(seconds * RATE)):
            x = source.gauss(0, 1) * math.sqrt(f / 200)
            x += 2 * radius * math.cos(2 * math.pi * f / RATE) * one - radius ** 2 * two
            one, two = x, one
            samples.append(0.004 * speed ** 2 * x)
    return samples


def table(speeds, seconds=2.0, scale=1.0, more=""):
    return "time,speed\n" + "".join(f"{time},{scale * speed}{more}\n" for i, speed in enumerate(speeds)
                                    for time in (i * seconds, (i + 1) * seconds - 1e-3))


class Texture(CommandTest):
    SPEEDS = (0.25, 0.5, 1.0)

    def setUp(self):
        super().setUp()
        self.put("stroke.wav", wav(strokes(self.SPEEDS), RATE))
        self.put("hand.csv", table(self.SPEEDS, scale=120))

    def analysed(self, *more):
        self.succeeds("texture", "analyse", "stroke.wav", "--speed", "hand.csv", "-o", "wood.texture.json", *more)
        return json.loads((self.folder / "wood.texture.json").read_text())

    def rendered(self, *more):
        self.succeeds("texture", "render", "wood.texture.json", "-o", "drive.wav", "-y", *more)
        return read_float_wav(self.folder / "drive.wav")


class Analyse(Texture):
    def test_a_table_of_speeds_gives_nodes_and_laws(self):
        texture = self.analysed()
        self.assertEqual((texture["format"], texture["name"], texture["fullSpeed"]), ("pacini.texture", "stroke", 120))
        self.assertEqual(len(texture["nodes"]), 3)
        for node, speed in zip(texture["nodes"], self.SPEEDS):
            self.assertAlmostEqual(node["speed"], speed, delta=0.05 * speed)
            self.assertEqual(len(node["reflection"]), 32)
        self.assertGreater(texture["pitch"], 0.8)
        report = self.report("texture", "analyse", "stroke.wav", "--speed", "hand.csv", "-o", "wood.texture.json")
        self.assertEqual([node["speed"] for node in report["nodes"]], [node["speed"] for node in texture["nodes"]])

    def test_options_are_kept_to(self):
        texture = self.analysed("--order", "8", "--pitch", "0.25", "--full-speed", "240", "--name", "oak")
        self.assertEqual(len(texture["nodes"][0]["reflection"]), 8)
        self.assertEqual((texture["pitch"], texture["fullSpeed"], texture["name"]), (0.25, 240, "oak"))
        self.assertAlmostEqual(texture["nodes"][-1]["speed"], 0.5, delta=0.03)
        self.succeeds("texture", "analyse", "stroke.wav", "-o", "one.texture.json", "--recorded-speed", "0.3")
        one = json.loads((self.folder / "one.texture.json").read_text())
        self.assertEqual([node["speed"] for node in one["nodes"]], [0.3])

    def test_the_same_recording_gives_the_same_bytes(self):
        self.analysed()
        first = (self.folder / "wood.texture.json").read_bytes()
        self.analysed()
        self.assertEqual((self.folder / "wood.texture.json").read_bytes(), first)

    def test_what_is_no_stroke_is_refused_with_its_place(self):
        self.put("short.wav", wav(sine(100, 0.1, RATE), RATE))
        self.put("silent.wav", wav([0.0] * RATE, RATE))
        analyse = ["texture", "analyse"]
        self.fails(1, [*analyse, "short.wav", "-o", "x.json"], "short.wav: is too short")
        self.fails(1, [*analyse, "silent.wav", "-o", "x.json"], "silent.wav: is silent")
        self.fails(1, [*analyse, "none.wav", "-o", "x.json"], "none.wav: ")
        self.fails(2, [*analyse, "stroke.wav"], "--output is missing")
        self.fails(2, [*analyse, "stroke.wav", "-o", "x.json", "--order", "65"], "1 to 64")
        for text, says in (("", "has no line"), ("0,1\nx,2\n", "line 2: time: 'x' is not a number"),
                           ("0,1\n1\n", "line 2: speed: is missing"), ("0,1\n1,-2\n", "line 2: speed: must be"),
                           ("1,1\n1,2\n", "line 2: time: must be later"), ("0,1,1\n1,2\n", "line 2: force: is missing"),
                           ("0,1\n1,inf\n", "line 2: speed"), ("0,0\n9,0\n", "at rest"),
                           ("0,1e300\n6,1\n", "speed: must have numbers from 0 to 1e9")):
            with self.subTest(text):
                self.put("bad.csv", text)
                self.fails(1, [*analyse, "stroke.wav", "--speed", "bad.csv", "-o", "x.json"], says)
        self.assertNotIn("x.json", self.names())


class Told(Texture):
    def test_a_table_that_does_not_cover_the_recording_is_told(self):
        for rows, says in (("0,1\n0.1,1\n", "hand.csv: warning: speed: is stated from 0.00 to 0.10 s, but the recording "
                                            "lasts 6.00 s; the rest counts as the nearest value"),
                           ("5,1\n6,1\n", "speed: is stated from 5.00 to 6.00 s"),
                           ("0,1,1\n0.1,1,1\n", "force: is stated from 0.00 to 0.10 s")):
            with self.subTest(rows):
                self.put("hand.csv", rows)
                done = self.run_command("texture", "analyse", "stroke.wav", "--speed", "hand.csv", "-o", "x.json", "-y")
                self.assertEqual(done.returncode, 0)
                self.assertIn(says, done.stderr.decode())

    def test_info_tells_of_a_texture(self):
        made = self.analysed()
        told = self.report("info", "wood.texture.json")
        self.assertEqual((told["kind"], told["name"], told["pitch"], len(told["nodes"])),
                         ("texture", made["name"], made["pitch"], len(made["nodes"])))
        self.assertIn("texture", self.succeeds("info", "wood.texture.json").splitlines()[0])
        self.put("bad.json", '{"format": "pacini.texture", "version": 1}')
        self.fails(1, ["info", "bad.json"], 'bad.json: format: is "pacini.texture"')


class Render(Texture):
    def setUp(self):
        super().setUp()
        self.analysed()

    def test_the_drive_follows_the_speed(self):
        rate, samples = self.rendered("--speed", "0:0 1:0 1:1 3:1 3:0 4:0", "--rate", "8000")
        self.assertEqual((rate, len(samples)), (8000, 32000))
        self.assertEqual(max(map(abs, samples[:7900])), 0.0)
        self.assertGreater(rms(samples[9000:23000]), 0.01)
        self.assertLess(max(map(abs, samples[25000:])), 1e-6)  # the limiter's high-passes may ring
        _, slow = self.rendered("--speed", "0.25", "--duration", "4", "--rate", "8000")
        _, fast = self.rendered("--speed", "1", "--duration", "4", "--rate", "8000")
        recorded = strokes(self.SPEEDS)
        for played, part in ((slow, recorded[1000:15000]), (fast, recorded[33000:47000])):
            self.assertAlmostEqual(20 * math.log10(rms(played) / rms(part)), 0.0, delta=1.5)
        self.assertGreater(rms(fast), 2 * rms(slow))

    def test_force_gain_and_files_of_motion_count(self):
        loud = rms(self.rendered("--speed", "0.5", "--duration", "2")[1])
        soft = rms(self.rendered("--speed", "0.5", "--duration", "2", "--force", "0.25")[1])
        self.assertAlmostEqual(soft / loud, 0.5, delta=0.05)  # the assumed law is a root
        less = rms(self.rendered("--speed", "0.5", "--duration", "2", "--gain", "-6")[1])
        self.assertAlmostEqual(less / loud, 0.5, delta=0.02)
        self.assertEqual(max(map(abs, self.rendered("--speed", "0.5", "--duration", "1", "--force", "0")[1])), 0.0)
        self.put("motion.csv", "0,60\n2,60\n")  # half of the full speed of hand.csv
        self.assertAlmostEqual(rms(self.rendered("--speed", "motion.csv")[1]), loud, delta=0.05 * loud)
        self.put("fast.csv", "0,60\n2,130\n")
        self.warns("texture", "render", "wood.texture.json", "--speed", "fast.csv", "-o", "fast.wav",
                   says="fast.csv: warning: goes beyond the full speed of the texture, 120")

    def test_the_same_seed_gives_the_same_bytes_at_any_rate(self):
        for rate in ("2000", "8000", "44100", "768000"):
            more = ["--speed", "0:0.2 0.2:1", "--rate", rate]
            self.rendered(*more)
            first = (self.folder / "drive.wav").read_bytes()
            self.rendered(*more)
            self.assertEqual((self.folder / "drive.wav").read_bytes(), first)
            self.rendered(*more, "--seed", "2")
            self.assertNotEqual((self.folder / "drive.wav").read_bytes(), first)

    def test_profiles_keep_the_drive_within_their_limits_and_motors_are_refused(self):
        for profile in ("l5-wristband", "lra-175"):
            _, samples = self.rendered("--speed", "1", "--duration", "2", "--profile", profile, "--gain", "40")
            self.assertLessEqual(max(map(abs, samples)), 1.0)
            self.assertGreater(rms(samples), 0.01)
        self.fails(1, ["texture", "render", "wood.texture.json", "--speed", "1", "--duration", "1", "-o", "x.wav",
                       "--profile", "erm-coin"], "is a motor")
        self.assertNotIn("x.wav", self.names())

    def test_wrong_words_and_files_are_refused(self):
        render = ["texture", "render", "wood.texture.json", "-o", "x.wav"]
        for speed, says in (("fast", "--speed: 'fast' is not a point"), ("0:2", "from 0 to 1"), ("1:0 0:1", "earlier"),
                            ("", "--speed"), ("0:nan", "from 0 to 1"), ("0.5", "--duration: is missing"),
                            ("0:0 1e300:1", "--speed: ends after 1e+300 s, but textures are rendered for 0.001 to 86400 s"),
                            ("0:0 1e9:1", "--speed: ends after 1e+09 s")):
            with self.subTest(speed):
                self.fails(2, [*render, "--speed", speed], says)
        self.fails(1, [*render, "--speed", "none.csv"], "none.csv: ")
        self.fails(2, [*render, "--speed", "1", "--duration", "1", "--force", "2"], "--force: '2' must have a value")
        self.put("bad.json", '{"format": "pacini.texture", "version": 1}')
        self.fails(1, ["texture", "render", "bad.json", "--speed", "0:0 1:1", "-o", "x.wav"],
                   "bad.json: pitch: is missing")
        self.fails(1, ["texture", "render", "stroke.wav", "--speed", "0:0 1:1", "-o", "x.wav"], "stroke.wav: ")
        self.fails(1, [*render[:-1], "x.txt", "--speed", "0:0 1:1"], "x.txt")
        self.assertEqual([name for name in self.names() if name.startswith("x.")], [])
        texture = json.loads((self.folder / "wood.texture.json").read_text())
        self.put("odd.json", json.dumps({**texture, "ptich": 1}))
        self.warns("texture", "render", "odd.json", "--speed", "0:0 1:1", "-o", "odd.wav", says="ptich")
        self.fails(1, ["texture", "render", "odd.json", "--speed", "0:0 1:1", "-o", "odd2.wav", "--strict"], "ptich")


class Scenes(Texture):
    def test_a_scene_plays_it_and_what_a_motor_cannot_do_is_told(self):
        self.analysed()
        self.put("rub.json", json.dumps({"format": "pacini.scene", "version": 1, "plays": [
            {"texture": "wood.texture.json", "duration": 1, "speed": 0.5}]}))
        self.succeeds("render", "rub.json", "-o", "rub.wav")
        play = self.report("info", "rub.json")["plays"][0]
        self.assertEqual((play["texture"], play["speed"], play["force"]), (0, 0.5, 1))
        said = self.succeeds("info", "rub.json")
        self.assertRegex(said, r"textures\[0\].*: 3 speeds, \d+ tones?\n")
        self.assertRegex(said, r"plays\[0\]: textures\[0\]")
        self.assertNotIn("bands", said)
        self.warns("render", "rub.json", "-o", "motor.wav", "--profile", "erm-coin",
                   says="rub.json: warning: plays[0] is a texture, which a motor cannot follow, so it is left out")
        said = self.warns("render", "rub.json", "-o", "motor.wav", "-y", "--profile", "erm-coin", "--measured",
                          says="plays[0] is a texture, which a motor cannot follow, so it is left out")
        self.assertIn("predicted error: 0.0 dB, as the actuator cannot play everything; of the rest: nothing lost", said)
        self.assertIn("plays[0] is a texture, which a motor cannot follow: 0.0 dB", said)


class Overwriting(Texture):
    def test_inputs_are_never_written_over_and_n_keeps_everything(self):
        self.analysed()
        before = {name: (self.folder / name).read_bytes() for name in self.names()}
        render = ["texture", "render", "wood.texture.json"]
        os.symlink("stroke.wav", self.folder / "link.wav")
        for more in ([], ["-y"]):
            for output in ("stroke.wav", "./stroke.wav", "link.wav", "hand.csv"):
                self.fails(1, ["texture", "analyse", "stroke.wav", "--speed", "hand.csv", "-o", output, *more],
                           "is also the input; choose another output with -o")
            self.fails(1, [*render, "--speed", "0:0 1:1", "-o", "wood.texture.json", *more], "is also the input")
        self.succeeds("texture", "analyse", "stroke.wav", "-o", "wood.texture.json", "-n")
        self.assertEqual({name: (self.folder / name).read_bytes() for name in before}, before)
        self.succeeds(*render, "--speed", "0:0 1:1", "-o", "drive.wav")
        drive = (self.folder / "drive.wav").read_bytes()
        self.succeeds(*render, "--speed", "1", "--duration", "2", "-o", "drive.wav", "-n")
        self.assertEqual((self.folder / "drive.wav").read_bytes(), drive)
        self.succeeds(*render, "--speed", "1", "--duration", "2", "-o", "drive.wav")
        self.assertNotEqual((self.folder / "drive.wav").read_bytes(), drive)


if __name__ == "__main__":
    unittest.main()
