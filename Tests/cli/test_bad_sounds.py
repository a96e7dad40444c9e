"""End to end: sounds that are damaged, hostile or odd."""
import array
import json
import math
import random
import re
import shutil
import struct
import unittest

from command import SANITIZED, SOURCE, CommandTest, float_wav, noise, sine, wav, wav_header

TEST_SOUNDS = SOURCE / "Tests/io/audio"


class BadSounds(CommandTest):
    def refused(self, name, content, *says, options=()):
        """encode and info refuse it in one line each, and no clip appears."""
        path = self.put(name, content)
        self.fails(1, ["encode", name, *options], f"pacini: {name}: ", *says)
        if not options:
            self.fails(1, ["info", name], f"pacini: {name}: ", *says)
        self.assertEqual(self.names(), [name])
        path.unlink()

    def test_files_that_are_no_sound(self):
        self.refused("a.wav", b"", "is empty")
        self.refused("a.wav", b"This is text, not sound.\n" * 100, "is not audio in a supported format")
        for clip in (b'{"format": "pacini.clip"}', b'\xef\xbb\xbf\n  {"Version": 1.0, "Pattern": []}'):
            self.put("a.json", clip)
            self.fails(1, ["encode", "a.json", "-o", "b.json"], "pacini: a.json: ",
                       "holds JSON, not sound; a clip is for 'pacini render'")
            self.assertEqual(self.names(), ["a.json"])
        (self.folder / "a.json").unlink()
        self.refused("a.wav", bytes(range(256)) * 40, "is not audio in a supported format")
        self.refused("a.flac", b"fLaC", "")
        self.refused("a.wav", b"RIFF", "")
        self.refused("a.wav", wav([])[:30], "")

    def test_a_sound_behind_a_few_other_bytes_is_read_with_a_word(self):
        fronts = (bytes(333), b"HTTP/1.1 200 OK\r\nContent-Type: audio/wav\r\n\r\n", random.Random(1).randbytes(1000))
        sounds = {name: (TEST_SOUNDS / name).read_bytes()
                  for name in ("tone.flac", "tone.mp3", "tone.ogg", "ramp.aiff", "ramp.caf", "ramp.au")}
        sounds["sine.wav"] = wav(sine(100, 0.5))

        def figures(said):
            found = json.loads(said)
            return [found[key] for key in ("duration", "sampleRate", "channels", "frames", "peak")]
        for name, whole in sounds.items():
            self.put(name, whole)
            if b"supported format" in self.run_command("info", name).stderr:
                continue  # this libsndfile does not read it
            wanted = figures(self.succeeds("info", name, "--json"))
            for front in fronts:
                self.put(name, front + whole)
                said = self.warns("info", name, "--json", says=f"{len(front)} bytes are no sound")
                self.assertEqual(figures(said), wanted, (name, front[:8]))

    def test_headers_without_a_rate_or_channels_are_called_damaged(self):
        data = bytes(2000)
        for content in (wav_header(2000, rate=0) + data, wav_header(2000, channels=0) + data,
                        b".snd" + struct.pack(">5I", 24, 2000, 3, 0, 1) + data,
                        b".snd" + struct.pack(">5I", 24, 2000, 3, 8000, 0) + data):
            self.put("a.wav", content)
            text = self.fails(1, ["encode", "a.wav"], "pacini: a.wav: ", "get a complete copy").stderr.decode()
            self.assertNotRegex(text, r"\b0 (Hz|channels)|internal error")

    def test_nothing_but_our_own_messages_is_printed_of_damaged_mp3_files(self):
        whole = (TEST_SOUNDS / "tone.mp3").read_bytes()
        self.put("whole.mp3", whole)
        if b"supported format" in self.run_command("info", "whole.mp3").stderr:
            self.skipTest("this libsndfile reads no MP3")
        for seed in range(60):
            source = random.Random(seed)
            content = bytearray(whole)
            for _ in range(source.choice((1, 3, 10, 60))):
                content[source.randrange(len(content))] = source.randrange(256)
            self.put(f"in/{seed}.mp3", bytes(content[source.choice((0, source.randrange(900))):]))
        done = self.run_command("encode", "in", "-o", "out", "-j", "4")
        lines = done.stderr.decode().splitlines()
        self.assertGreater(len(lines), 3)
        self.assertEqual([line for line in lines if not re.match(r"pacini: in/\d+\.mp3: ", line)], [])

    def test_advice_names_options_that_the_command_has(self):
        self.put("a.wav", wav(sine(100, 0.5))[:10000])
        self.put("whole.wav", wav(sine(100, 0.5)))
        self.put("nan.wav", float_wav([0.1, math.nan] * 4800))
        self.fails(1, ["encode", "a.wav"], "get a complete copy, or use the remaining part with --allow-truncated")
        self.fails(1, ["compare", "whole.wav", "a.wav"], "or use the remaining part with --allow-truncated")
        self.fails(1, ["encode", "nan.wav"], "repair the file, or replace such samples by 0 with --allow-nan")
        for command in (["info", "a.wav"], ["info", "nan.wav"]):
            self.assertNotIn(b"allow", self.run_command(*command).stderr)

    def test_files_that_are_cut_off(self):
        whole = wav(sine(100, 0.5))
        self.refused("a.wav", whole[:10000], "is truncated: it has ", " frames of ")
        for name in ("tone.flac", "tone.ogg"):
            content = (TEST_SOUNDS / name).read_bytes()
            for part in (0.3, 0.9):
                self.refused(name, content[:int(part * len(content))], "")
        self.put("a.wav", whole[:10000])
        report = json.loads(self.run_command("encode", "a.wav", "--allow-truncated", "--json").stdout)
        self.assertAlmostEqual(report["files"][0]["duration"], (10000 - 44) / 2 / 48000, delta=1e-9)
        self.fails(0, ["encode", "a.wav", "-o", "b.json", "--allow-truncated"],
                   "a.wav: warning: is cut off: 0.104 s of 0.500 s are there")

    def test_a_size_that_is_wrong_is_a_warning_of_every_command(self):
        whole = wav(sine(100, 0.5))
        self.put("a.wav", whole[:40] + bytes(4) + whole[44:])
        self.put("whole.wav", whole)
        for command in (["encode", "a.wav"], ["info", "a.wav"], ["compare", "whole.wav", "a.wav"],
                        ["plot", "a.wav", "-o", "a.svg"]):
            self.fails(0, command, "a.wav: warning: has a header that states 0.000 s, but 0.500 s are there")

    def test_samples_that_are_no_numbers_are_named_by_frame(self):
        for value, name in ((math.nan, "NaN"), (math.inf, "infinite"), (-math.inf, "infinite")):
            samples = sine(100, 0.5)
            samples[1001] = value
            samples[1500] = value
            content = float_wav(samples, channels=2)
            self.refused("a.wav", content, "frame 500, channel 1: is " + name)
            self.put("a.wav", content)
            self.fails(0, ["encode", "a.wav", "--allow-nan"], "a.wav: warning: 2 samples are not finite")
            self.assertNotIn("nan", (self.folder / "a.json").read_text().lower())
            (self.folder / "a.json").unlink()
        self.refused("a.wav", float_wav([0.5, 1e30, 1e30]), "frame 1, channel 0: is 1e+30, far beyond full scale")

    def test_headers_that_lie(self):
        data = bytes(2000)
        self.refused("a.wav", wav_header(2000, channels=10_000_000) + data, "")
        self.refused("a.wav", wav_header(2000, channels=65535) + data, "")
        self.refused("a.wav", wav_header(2000, channels=65) + data, "has 65 channels, but only 1 to 64 are supported")
        self.refused("a.wav", wav_header(2000, channels=0) + data, "")
        much = 2 ** 31 + 2 ** 28
        self.refused("a.wav", wav_header(much) + data, f"is truncated: it has 1000 frames of {much // 2}")
        self.refused("a.wav", wav_header(2000, rate=0) + data, "")
        self.refused("a.wav", wav_header(2000, rate=10 ** 9) + data, "1000 to 768000 Hz")
        self.refused("a.wav", wav_header(2000, rate=999) + data, "has a sample rate of 999 Hz, but only 1000 to 768000 Hz")
        self.refused("a.wav", wav_header(2000, rate=768001) + data, "1000 to 768000 Hz")
        self.refused("a.wav", wav_header(2000, bits=0) + data, "")
        aiff = b"FORM" + struct.pack(">I", 2 ** 31) + b"AIFFCOMM" + struct.pack(">IhIh", 18, 1, 2 ** 31, 16)
        aiff += bytes([0x40, 0x0E, 0xAC, 0x44] + [0] * 6) + b"SSND" + struct.pack(">III", much, 0, 0)
        self.refused("a.aiff", aiff + data, "")

    def test_every_byte_of_a_header_may_be_wrong(self):
        # No crash and no hang, whatever comes of it.
        whole = wav(sine(100, 0.02, rate=8000), rate=8000)
        for place in range(44):
            for value in (0x00, 0x7F, 0xFF):
                changed = bytearray(whole)
                changed[place] = value
                self.put(f"{place}-{value}.wav", bytes(changed))
        done = self.run_command("encode", ".", "-o", "out", "--json")
        self.assertIn(done.returncode, (0, 1))
        report = json.loads(done.stdout)
        self.assertEqual(len(report["files"]) + len(report["failures"]), 3 * 44)
        errors = [line for line in done.stderr.decode().splitlines() if ": warning: " not in line]
        self.assertEqual(len(errors), len(report["failures"]))


class OddSounds(CommandTest):
    def clip_of(self, content, *options, name="a.wav"):
        self.put(name, content)
        self.succeeds("encode", name, "-o", "a.json", "--force", *options)
        clip = json.loads((self.folder / "a.json").read_text())
        self.succeeds("render", "a.json", "-o", "a-out.wav", "--rate", "8000")
        return clip

    def loudest(self, clip):
        return max((point["amplitude"] for point in clip["envelope"]), default=0)

    def test_no_sound_at_all_and_one_sample(self):
        self.assertEqual(self.clip_of(wav([]))["duration"], 0)
        for value in (0.5, 0.0):
            clip = self.clip_of(wav([value]))
            self.assertAlmostEqual(clip["duration"], 1 / 48000, delta=1e-4)

    def test_silence_and_a_constant_have_their_duration_and_nothing_to_feel(self):
        for value in (0.0, 0.9):
            clip = self.clip_of(wav([value] * 48000), "--keep-level")
            self.assertEqual(clip["duration"], 1.0)
            self.assertEqual(clip["transients"] if value == 0.0 else [], [])
            middle = [point["amplitude"] for point in clip["envelope"] if 0.3 < point["time"] < 0.7]
            self.assertLess(max(middle, default=0), 0.01)

    def test_a_clipped_square_stays_within_full_drive(self):
        clip = self.clip_of(wav([1.0 if (i // 400) % 2 else -1.0 for i in range(48000)]))
        self.assertLessEqual(self.loudest(clip), 1.001)
        self.assertGreater(self.loudest(clip), 0.5)

    def test_samples_far_beyond_full_scale_and_far_below(self):
        for level in (9e11, 1e-4):
            self.put("far.wav", float_wav(sine(100, 0.5, level=level)))
            done = self.run_command("encode", "far.wav", "-o", "far.json", "-y")
            self.assertEqual((done.returncode, b"times full scale" in done.stderr), (0, level > 1), done.stderr)
            clip = json.loads((self.folder / "far.json").read_text())
            self.assertGreater(self.loudest(clip), 0.5)
            self.assertLessEqual(self.loudest(clip), 1.001)
        self.clip_of(float_wav([1e-42] * 4800))

    def test_the_lowest_and_highest_rates_and_64_channels(self):
        for rate in (8000, 768000):
            clip = self.clip_of(wav(sine(100, 0.5, rate=rate), rate=rate))
            self.assertEqual(clip["duration"], 0.5)
            loud = max(clip["bands"], key=lambda band: max((p["amplitude"] for p in band["amplitude"]), default=0))
            self.assertLess(loud["lowFrequency"], 100)
            self.assertGreater(loud["highFrequency"], 100)
        clip = self.clip_of(wav([x for x in sine(100, 0.2, level=0.1) for _ in range(64)], channels=64))
        self.assertEqual((clip["duration"], clip["source"]["channels"]), (0.2, 64))


if __name__ == "__main__":
    unittest.main()
