"""End to end: pacini live with an accelerometer in a channel of its sound. The loop is closed by pipes: what it writes
moves an actuator under a strap, whose sensor is in the second channel of what it reads."""
import json
import math
import random
import struct
import subprocess
import unittest

from command import COMMAND, CommandTest, float_wav, sine

BLOCK = 400


class Rig:
    """Noise in steps as sound, and a wearer whose strap takes some dB of what is driven."""

    def __init__(self, folder, *options):
        self.process = subprocess.Popen(
            [COMMAND, "live", "-", "--raw", "f32", "--rate", "8000", "--channels", "2", "-o", "-", "--json",
             "--follow-input", "2", "--follow-delay", "50", "--follow-time", "2", *options],
            cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.random = random.Random(1)
        self.line = [0.0] * (2 * BLOCK)
        self.frame = 0
        self.process.stdout.read(44)

    def play(self, seconds, loss=0.0, sensor=None):
        """The RMS of the drive in the last two seconds."""
        gain = 0.5 * 10 ** (-loss / 20)
        recent = []
        for _ in range(round(seconds * 8000 / BLOCK)):
            sound = []
            for i in range(BLOCK):
                loud = self.frame // 2000 % 2 == 0
                felt = self.line[i] + self.random.gauss(0, 1e-4)
                back = felt if sensor is None else sensor(felt, self.frame)
                tone = sum(math.sin(2 * math.pi * f * self.frame / 8000) for f in (60, 110, 190, 310)) / 4
                sound += [(0.3 if loud else 0.03) * (tone + 0.3 * self.random.gauss(0, 1)), back]
                self.frame += 1
            self.process.stdin.write(struct.pack(f"<{len(sound)}f", *sound))
            self.process.stdin.flush()
            drive = struct.unpack(f"<{BLOCK}f", self.process.stdout.read(4 * BLOCK))
            self.line = self.line[BLOCK:] + [gain * x for x in drive]
            recent = (recent + list(drive))[-16000:]
        return math.sqrt(sum(x * x for x in recent) / len(recent))

    def end(self):
        self.process.stdin.close()
        self.process.stdout.read()
        said = self.process.stderr.read().decode()
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()
        return said


class Follow(CommandTest):
    def levels(self, *steps):
        """dB between the drive after the first step and after each of the others, and what was said at the end."""
        rig = Rig(self.folder)
        try:
            first = rig.play(*steps[0])
            found = [20 * math.log10(rig.play(*step) / first) for step in steps[1:]]
        finally:
            said = rig.end()
        return found, said

    def test_a_tightened_strap_is_followed_and_garbage_holds_what_there_was(self):
        found, said = self.levels((12.0, 0.0), (14.0, 5.0), (14.0, 5.0, lambda felt, n: float("nan")),
                                  (14.0, 5.0, lambda felt, n: 0.0), (14.0, 5.0, lambda felt, n: 1.0 if felt > 0 else -1.0),
                                  (14.0, 5.0, lambda felt, n: 0.01 * math.sin(2 * math.pi * 50 * n / 8000)))
        self.assertAlmostEqual(found[0], 5.0, delta=1.5)
        for held in found[1:]:
            self.assertAlmostEqual(held, found[0], delta=1.5)
        self.assertIn("accelerometer does not follow the drive", said)
        self.assertIn("--follow-delay", said)

    def test_without_a_sensor_nothing_is_raised(self):
        found, said = self.levels((4.0, 0.0, lambda felt, n: 0.0), (20.0, 0.0, lambda felt, n: 0.0))
        self.assertAlmostEqual(found[0], 0.0, delta=0.5)
        self.assertIn("accelerometer does not move", said)

    def test_its_state_is_told_in_json(self):
        interleaved = [x for pair in zip(sine(70, 3.0, rate=8000, level=0.3), sine(70, 3.0, rate=8000, level=0.1)) for x in pair]
        self.put("a.wav", float_wav(interleaved, rate=8000, channels=2))
        report = self.report("live", "a.wav", "-o", "out.wav", "--follow-input", "2")
        follow = report["follow"]
        self.assertEqual(len(follow["bands"]), 12)
        self.assertEqual(set(follow["bands"][0]), {"frequency", "gain", "held"})
        self.assertGreaterEqual(follow["heldSeconds"], 0.0)

    def test_wrong_usage_is_told(self):
        self.put("mono.wav", float_wav(sine(70, 0.5, rate=8000), rate=8000))
        self.put("two.wav", float_wav(sine(70, 0.5, rate=8000), rate=8000, channels=2))
        for arguments, words in ((("mono.wav", "--follow-input", "1"), "one channel"),
                                 (("two.wav", "--follow-input", "3"), "there are 2 channels"),
                                 (("two.wav", "--follow-input", "2", "--profile", "erm-coin"), "motor")):
            done = self.run_command("live", *arguments, "-o", "out.wav")
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, done.stderr.decode(), arguments)
        done = self.run_command("live", "two.wav", "-o", "out.wav", "--follow-delay", "10")
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main()
